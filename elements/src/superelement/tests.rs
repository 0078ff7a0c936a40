use super::*;
use trilith_element::{Dof, FileText, SparseRow};

fn matrix(name: &str, size: usize, entries: &[(u32, u32, f64)]) -> Value {
    let (name, entries) = (name.to_owned(), entries.to_vec());
    Value::Matrix(Arc::new(SparseMatrix { name, size, entries, ..SparseMatrix::default() }))
}

const ROD: [(u32, u32, f64); 4] = [(0, 0, 2.0), (0, 1, -2.0), (1, 0, -2.0), (1, 1, 2.0)];
const TABLE: &str = "row,node,dof\n1,left,Ux\n2,right,Ux\n";

fn read(k: Value, m: Option<Value>, table: &str) -> Result<Superelement, String> {
    let file = FileText { name: "rows.csv".into(), text: table.into() };
    let labels = Value::List(["left", "right"].map(|l| Value::Text(l.into())).to_vec());
    let mut all = vec![("stiffness".into(), k), ("rows".into(), Value::File(Arc::new(file)))];
    all.push(("labels".into(), labels));
    all.extend(m.map(|m| ("mass".into(), m)));
    Superelement::read(&Values(all)).map_err(|e| e.to_string())
}

#[test]
fn rows_are_tied_by_label_and_all_others_are_inner() {
    let five: Vec<(u32, u32, f64)> = (0..5).map(|i| (i, i, 1.0)).collect();
    let table = "row;node;dof\n# the ends\n5; \"right\"; Rz\n1;left;Uy\n\n2;12;Ux\n";
    let it = read(matrix("k.mtx", 5, &five), None, table).unwrap();
    let inner = SparseRow::Inner;
    let (left, right) = (SparseRow::Node(0, Dof::Uy), SparseRow::Node(1, Dof::Rz));
    assert_eq!(it.sparse.rows, [left, inner(Some(Dof::Ux)), inner(None), inner(None), right]);
}

#[test]
fn what_is_wrong_with_a_table_is_told_with_its_line() {
    let told = |table: &str| read(matrix("k.mtx", 2, &ROD), None, table).unwrap_err();
    let with = |lines: &str| told(&format!("row,node,dof\n{lines}"));
    assert_eq!(
        told("1,left,Ux\n"),
        "`rows`: rows.csv, line 1: the heading is `1,left,Ux`: `row,node,dof` is wanted"
    );
    assert_eq!(
        with("1,left,Ux\n3,right,Ux\n"),
        "`rows`: rows.csv, line 3: there is no row `3`: the matrices have 2, counted from 1"
    );
    assert_eq!(
        with("1,left,X\n"),
        "`rows`: rows.csv, line 2: `X` is no direction: must be Ux, Uy, Uz, Rx, Ry or Rz"
    );
    assert_eq!(
        with("1,left,Ux\n\n1,right,Ux\n"),
        "`rows`: rows.csv, line 4: row 1 stands in line 2 already"
    );
    assert_eq!(
        with("1,left,Ux\n2,left,Ux\n"),
        "`rows`: rows.csv, line 3: Ux of node `left` is row 1 already"
    );
    assert_eq!(
        with("1,left\n"),
        "`rows`: rows.csv, line 2: `1,left`: a row, a node and a direction are wanted"
    );
    assert_eq!(
        with("1,left,Ux\n2,12,Ux\n"),
        "`rows`: rows.csv: no row is of a node `right`: every node of the element needs one, under its name or its label"
    );
    assert!(told("").starts_with("`rows`: rows.csv: the table is empty"));
}

#[test]
fn matrices_that_none_of_a_structure_has_are_refused_with_row_and_column() {
    let told = |size, change: &[(usize, f64)]| {
        let mut entries = ROD;
        change.iter().for_each(|(at, v)| entries[*at].2 = *v);
        read(matrix("k.mtx", size, &entries), None, TABLE).unwrap_err()
    };
    assert_eq!(
        told(2, &[(2, -1.5)]),
        "`stiffness`: k.mtx: the matrix is not symmetric: -2e0 in row 1, column 2, and -1.5e0 in row 2, column 1, a difference of 2.5e-1, the largest of all; must be symmetric"
    );
    assert_eq!(
        told(2, &[(3, -2.0)]),
        "`stiffness`: k.mtx: the diagonal entry of row 2 is -2e0: must not be negative"
    );
    assert!(told(2, &[(3, 1.9)]).contains("row 1, column 2, beside 2e0 and 1.9e0 on the diagonal"));
    assert!(told(2, &[(3, 0.0)]).contains("must be positive semi-definite"));
    assert!(told(2, &[(0, f64::NAN)]).contains("NaN in row 1, column 1"));
    let larger = matrix("m.mtx", 3, &[(0, 0, 1.0)]);
    assert_eq!(
        read(matrix("k.mtx", 2, &ROD), Some(larger), TABLE).unwrap_err(),
        "`mass`: m.mtx has 3 rows, and the stiffness of k.mtx has 2: both must be of the same rows"
    );
}

#[test]
fn rounding_is_evened_out() {
    let mut entries = ROD;
    entries[2].2 *= 1.0 + 1e-12;
    let it = read(matrix("k.mtx", 2, &entries), None, TABLE).unwrap();
    let k = &it.sparse.stiffness.entries;
    assert_eq!(k[1].2, k[2].2);
    assert!((k[1].2 + 2.0).abs() < 1e-11 && k[1].2 != -2.0);
}

#[test]
fn it_is_drawn_from_its_centre_to_its_nodes() {
    let it = read(matrix("k.mtx", 2, &ROD), None, TABLE).unwrap();
    let frame = trilith_element::Frame::of_nodes(&[[0.0; 3]], None, None).unwrap();
    let nodes = [[0.0; 3], [3.0, 0.0, 0.0], [0.0, 6.0, 0.0]];
    let outline = it.outline(&Geometry::new(&nodes, frame)).unwrap();
    assert_eq!(outline.points[0], (0, [1.0, 2.0, 0.0]));
    assert_eq!(outline.paths, [[0, 1], [0, 2], [0, 3]]);
    assert_eq!(outline.checked(3).map(|o| o.points.len()), Some(4));
}
