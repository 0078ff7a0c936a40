use super::*;
use trilith_element::{Dof, FileText, MeshRow, SparseRow};

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

#[test]
fn a_table_of_calculix_has_a_line_for_every_row() {
    let five: Vec<(u32, u32, f64)> = (0..3).map(|i| (i, i, 1.0)).collect();
    let read = |text: &str| {
        let file = FileText { name: "wall.DOF".into(), text: text.into() };
        let labels = Value::List(["12", "7"].map(|l| Value::Text(l.into())).to_vec());
        let all = vec![
            ("stiffness".into(), matrix("wall.sti", 3, &five)),
            ("rows".into(), Value::File(Arc::new(file))),
            ("labels".into(), labels),
        ];
        Superelement::read(&Values(all)).map_err(|e| e.to_string())
    };
    let it = read("12.1\n113.2\n\n7.6\n").unwrap();
    let (first, last) = (SparseRow::Node(0, Dof::Ux), SparseRow::Node(1, Dof::Rz));
    assert_eq!(it.sparse.rows, [first, SparseRow::Inner(Some(Dof::Uy)), last]);
    let told = |text: &str| read(text).unwrap_err();
    assert_eq!(
        told("12.1\n7.1\n"),
        "`rows`: wall.DOF: 2 lines, and the matrices have 3 rows: a line for each row is wanted"
    );
    let wanted = "a node and its direction are wanted, as in `12.1`, 1 to 3 along X, Y and Z, 4 to 6 about them";
    for line in ["7.0", "7.7", "7", "x.1", ".1", "7.1.1", "-7.1"] {
        let error = told(&format!("12.1\n{line}\n7.2\n"));
        assert_eq!(error, format!("`rows`: wall.DOF, line 2: `{line}`: {wanted}"));
    }
    assert_eq!(
        told("12.1\n113.2\n113.2\n"),
        "`rows`: wall.DOF, line 3: `113.2` stands in line 2 already"
    );
    assert!(told("12.1\n113.2\n8.1\n").contains("no row is of a node `7`"));
}

/// Rows that only one of two matrices has are rows of zeros in the other.
#[test]
fn matrices_whose_rows_have_names_are_brought_to_the_same_rows() {
    let named = |name: &str, rows: &[(u32, Option<Dof>)], entries: &[(u32, u32, f64)]| {
        Value::Matrix(Arc::new(SparseMatrix {
            name: name.into(),
            size: rows.len(),
            entries: entries.to_vec(),
            rows: rows.iter().map(|(node, dof)| MeshRow { node: *node, dof: *dof }).collect(),
            ..SparseMatrix::default()
        }))
    };
    let (x, z) = (Some(Dof::Ux), Some(Dof::Uz));
    let k =
        named("w.pch:K", &[(7, x), (12, x), (900, None)], &[(0, 0, 1.0), (1, 1, 2.0), (2, 2, 3.0)]);
    let m = named(
        "w.pch:M",
        &[(7, x), (12, None), (12, z)],
        &[(0, 0, 4.0), (0, 2, 1.0), (2, 0, 1.0), (2, 2, 5.0)],
    );
    let labels = Value::List(["12", "7"].map(|l| Value::Text(l.into())).to_vec());
    let of = |labels: Value| {
        let all = [("stiffness", k.clone()), ("mass", m.clone()), ("labels", labels)];
        let all = all.map(|(name, value)| (name.to_owned(), value)).to_vec();
        Superelement::read(&Values(all)).map_err(|e| e.to_string())
    };
    let it = of(labels).unwrap().sparse;
    // 7.1, 12.0, 12.1, 12.3, 900.0; what has no direction is tied to no node.
    let (tied, inner) = (SparseRow::Node, SparseRow::Inner(None));
    let rows = [tied(1, Dof::Ux), inner, tied(0, Dof::Ux), tied(0, Dof::Uz), inner];
    assert_eq!(it.rows, rows);
    assert_eq!(it.stiffness.entries, [(0, 0, 1.0), (2, 2, 2.0), (4, 4, 3.0)]);
    let mass = it.mass.unwrap();
    assert_eq!(mass.entries, [(0, 0, 4.0), (0, 3, 1.0), (3, 0, 1.0), (3, 3, 5.0)]);
    assert_eq!(
        (mass.size, mass.row_name(3), it.stiffness.row_name(1)),
        (5, "12.3".into(), "12.0".into())
    );
    let error = of(Value::List(vec![Value::Text("8".into())])).unwrap_err();
    assert!(error.starts_with("`stiffness`: w.pch:K: no row is of a node `8`"), "{error}");
}

/// Nodes that are no rows follow these.
#[test]
fn a_node_that_follows_the_rows_needs_none_of_its_own() {
    let of = |table: &str| {
        let file = |name: &str, text: &str| {
            Value::File(Arc::new(FileText { name: name.into(), text: text.into() }))
        };
        let labels = ["left", "right", "mid"].map(|l| Value::Text(l.into())).to_vec();
        let all = vec![
            ("stiffness".into(), matrix("k.mtx", 2, &ROD)),
            ("rows".into(), file("rows.csv", TABLE)),
            ("labels".into(), Value::List(labels)),
            ("recovery".into(), file("recovery.csv", table)),
        ];
        Superelement::read(&Values(all)).map_err(|e| e.to_string())
    };
    let with = |lines: &str| of(&format!("node,dof,row,value\n{lines}"));
    let it = with("mid,Ux,1,0.25\n# and\nmid;Ux,2,0.75\n").unwrap_err();
    assert!(it.contains("line 4: `mid;Ux,2,0.75`: a node, a direction, a row and a share"), "{it}");
    let it = with("mid,Ux,2,0.75\nmid,Rz,1,-1e-3\nleft,Uy,1,2\nmid,Ux,1,0.25\n").unwrap();
    let led: Vec<_> = it.sparse.recovered.iter().map(|r| (r.node, r.dof, &r.terms[..])).collect();
    assert_eq!(
        led,
        [
            (2, Dof::Ux, &[(1, 0.75), (0, 0.25)][..]),
            (2, Dof::Rz, &[(0, -1e-3)][..]),
            (0, Dof::Uy, &[(0, 2.0)][..])
        ]
    );
    let told = |lines: &str| with(lines).unwrap_err();
    assert_eq!(
        told("far,Ux,1,1\nmid,Ux,1,1\n"),
        "`recovery`: recovery.csv, line 2: `far` is none of its nodes: those that follow rows are nodes of the element too"
    );
    assert_eq!(
        told("mid,X,1,1\n"),
        "`recovery`: recovery.csv, line 2: `X` is no direction: must be Ux, Uy, Uz, Rx, Ry or Rz"
    );
    for row in ["0", "3", "one"] {
        let line = format!("mid,Ux,{row},1\n");
        assert_eq!(
            told(&line),
            "`recovery`: recovery.csv, line 2: there is no such row: there are 2, counted from 1"
        );
    }
    for share in ["inf", "NaN", "", "1x"] {
        assert_eq!(
            told(&format!("mid,Ux,1,{share}\n")),
            format!(
                "`recovery`: recovery.csv, line 2: `{share}` is no share: a finite number is wanted"
            )
        );
    }
    assert_eq!(
        told("mid,Ux,1,1\nright,Ux,1,1\n"),
        "`recovery`: recovery.csv, line 3: Ux of node `right` is a row already"
    );
    assert_eq!(
        told("mid,Ux,1,1\nmid,Uy,1,1\nmid,Ux,1,1\n"),
        "`recovery`: recovery.csv, line 4: this share stands in line 2 already"
    );
    assert!(of("").unwrap_err().starts_with("`recovery`: recovery.csv: the table is empty"));
    assert!(of("mid,Ux,1,1\n").unwrap_err().contains("the heading is `mid,Ux,1,1`"));
    // A node with neither is still told.
    assert!(with("left,Uy,1,1\n").unwrap_err().contains("no row is of a node `mid`"));
}
