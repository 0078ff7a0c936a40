use super::super::{read, tests::damaged, written};
use super::*;

/// A rod of two lengths along X, and a turn at one end.
const SMALL: &str = "$ by hand
DMIG    KAAX    0       6       2       0
DMIG    KAAX    12      1               12      1        2.0+8          +K1
+K1     20      1       -2.0+8
DMIG    KAAX    20      1               20      1       4.D8
        31      1       -2.0E8
$
DMIG    KAAX    31      1               31      1       20000.+4
DMIG    KAAX    31      5               31      5       .5
";
const LARGE: &str = "DMIG*   KAAX                           0               6               2
*                      0
DMIG*   KAAX                          12               1
*                     12               1 2.000000000D+08
*                     20               1-2.000000000D+08
DMIG*   KAAX                          20               1
*                     20               1 4.000000000D+08
*                     31               1-2.000000000D+08
DMIG*   KAAX                          31               1                *K2
*K2                   31               1 2.000000000D+08
DMIG*   KAAX                          31               5
*                     31               5 5.000000000D-01
";
const FREE: &str = "dmig,kaax,0,6,1
dmig,kaax,12,1,,12,1,2.0+8,,+
,20,1,-2.0e+8
DMIG, KAAX, 20, 1, , 20, 1, 4.0+8, , +K
+K, 31, 1, -200000000., 0.
DMIG*,KAAX,31,1,,*
*,31,1,2.0+8
DMIG,KAAX,31,5,,31,5,5.0-1
";
const ENTRIES: [(u32, u32, f64); 8] = [
    (0, 0, 2e8),
    (0, 1, -2e8),
    (1, 0, -2e8),
    (1, 1, 4e8),
    (1, 2, -2e8),
    (2, 1, -2e8),
    (2, 2, 2e8),
    (3, 3, 0.5),
];

fn rows(all: &[(u32, Option<Dof>)]) -> Vec<MeshRow> {
    all.iter().map(|(node, dof)| MeshRow { node: *node, dof: *dof }).collect()
}

fn of(text: &str) -> Result<SparseMatrix, String> {
    read(text.as_bytes(), "wall.pch", "").map_err(|e| e.to_string())
}

#[test]
fn small_large_and_free_fields_are_one_matrix() {
    for text in [SMALL, LARGE, FREE] {
        let it = of(text).unwrap();
        assert_eq!((it.size, &it.entries[..]), (4, &ENTRIES[..]));
        let (x, ry) = (Some(Dof::Ux), Some(Dof::Ry));
        assert_eq!(it.rows, rows(&[(12, x), (20, x), (31, x), (31, ry)]));
        assert_eq!(it.row_name(3), "31.5");
        // By what stands in it, with the ends of lines of Windows.
        let windows = text.replace('\n', "\r\n");
        assert_eq!(read(windows.as_bytes(), "k.txt", "").unwrap().entries, it.entries);
        // What is written is read again.
        let again = of(&written(&it)).unwrap();
        assert_eq!((again.entries, again.rows), (it.entries, it.rows));
    }
}

#[test]
fn one_of_several_is_named_and_what_else_was_punched_is_passed_over() {
    let mass = "DMIG    MAAX    0       1       1
DMIG    MAAX    31      1               12      1       1.5     0.
        31      1       4.
DMIG    MAAX    12      1               31      1       1.5
        12      1       4.
";
    let loads = "DMIG    PAX     0       9       1       0                       1\nDMIG    PAX     1       0               12      1       1.0\n";
    let more = "$TITLE = Brücke\n         1       G      0.0            0.0                 1\n-CONT-                  0.0\nGRID    12              0.0     1.0     2.0     0\nGRID*   31                              0.              1.\n*       2.              0\nGRID    99              0.      0.      0.      7\n";
    let all = format!("{more}{SMALL}{mass}{loads}$TITLE\n         1       G      0.0\n");
    let of = |name: &str| read(all.as_bytes(), name, "folder/wall.pch");
    let it = of("wall.pch:KAAX").unwrap();
    assert_eq!((it.name.as_str(), it.path.as_str()), ("wall.pch:KAAX", "folder/wall.pch:KAAX"));
    assert_eq!(it.entries, ENTRIES);
    let it = of("wall.pch:maax").unwrap();
    let entries = [(0, 0, 4.0), (0, 1, 1.5), (1, 0, 1.5), (1, 1, 4.0)];
    assert_eq!((&it.entries[..], it.row_name(1)), (&entries[..], "31.1".into()));
    let told = |name: &str| of(name).unwrap_err().to_string();
    assert_eq!(
        told("wall.pch"),
        "wall.pch: the file has the matrices KAAX, MAAX, PAX: name one of them, as in `wall.pch:KAAX`"
    );
    assert_eq!(
        told("wall.pch:BAAX"),
        "wall.pch: there is no matrix `BAAX`: the file has KAAX, MAAX, PAX"
    );
    assert_eq!(
        told("wall.pch:PAX"),
        "wall.pch, line 22: matrix PAX is rectangular (IFO 9), such as loads: a square one is wanted, IFO 6, 1 or 2"
    );
    // Loads are none of the matrices that a name is needed for.
    assert_eq!(
        super::super::read(format!("{SMALL}{loads}").as_bytes(), "k.pch", "").unwrap().size,
        4
    );
}

#[test]
fn a_matrix_that_is_not_symmetric_to_the_bit_is_written_whole() {
    let text =
        "DMIG,K,0,1,2\nDMIG,K,1,,,1,,2.\n,7,3,1.0000000000000002\nDMIG,K,7,3,,1,,1.\n,7,3,2.\n";
    let it = of(text).unwrap();
    assert_eq!(it.rows, rows(&[(1, None), (7, Some(Dof::Uz))]));
    assert_eq!(it.entries, [(0, 0, 2.0), (0, 1, 1.0), (1, 0, 1.0000000000000002), (1, 1, 2.0)]);
    let again = of(&written(&it)).unwrap();
    assert_eq!((again.entries, again.rows), (it.entries, it.rows));
}

#[test]
fn what_is_wrong_is_told_with_its_line() {
    let told = |text: &str| of(text).unwrap_err();
    let with = |old: &str, new: &str| told(&SMALL.replacen(old, new, 1));
    assert_eq!(
        told("$\n"),
        "wall.pch: no matrix begins in the file: `DMIG`, its name, 0, form and type are wanted"
    );
    assert_eq!(
        told("DMIG,KAAX,0,6,2\n"),
        "wall.pch, line 1: matrix KAAX has no columns: the file has been cut off"
    );
    assert_eq!(
        with("-2.0+8", "-2.0*8"),
        "wall.pch, line 4: `-2.0*8` in row 20.1 of column 12.1: a finite number is wanted, such as 1.5, 1.5D+3 or 1.5+3"
    );
    assert!(with("-2.0+8", "+2.+999").contains("`+2.+999` in row 20.1"));
    assert!(
        with("-2.0+8", "")
            .contains("line 4: an empty field, as in a file that has been cut off, in row 20.1")
    );
    assert_eq!(
        with("+K1     20      1", "+K1     20      7"),
        "wall.pch, line 4: `7` is no component of grid 20: must be 1 to 6, or 0 of a scalar point"
    );
    assert_eq!(
        with("+K1     20 ", "+K1     -20"),
        "wall.pch, line 4: `-20` is no grid: its number is wanted, from 1"
    );
    assert_eq!(
        with("0       6       2 ", "0       6       4 "),
        "wall.pch, line 2: matrix KAAX is complex (TIN 4), and no stiffness, mass or damping: a real one is wanted, TIN 1 or 2"
    );
    assert_eq!(
        with("0       6 ", "0       3 "),
        "wall.pch, line 2: the form IFO of matrix KAAX is `3`: must be 6, 1 or 2"
    );
    assert_eq!(
        with("6       2 ", "6       R "),
        "wall.pch, line 2: the type TIN of matrix KAAX is `R`: must be 1 or 2"
    );
    assert_eq!(
        with("+K1     20 ", "+K1     12 "),
        "wall.pch, line 4: the entry of rows 12.1 and 12.1 stands in line 3 already: IFO 6 gives one triangle, each entry once"
    );
    assert_eq!(
        told(&format!("{SMALL}DMIG    KAAX    31      1               20      1       -2.0+8\n")),
        "wall.pch, line 10: the entry of rows 20.1 and 31.1 stands in line 6 already: IFO 6 gives one triangle, each entry once"
    );
    assert_eq!(
        told(&format!("{SMALL}DMIG    KAAX    0       6       2\n")),
        "wall.pch, line 10: matrix KAAX begins in line 2 already"
    );
    assert_eq!(
        told(&SMALL[..SMALL.find("$\n").unwrap()]),
        "wall.pch, line 6: row 31.1 has an entry beside the diagonal and none on it: the file has been cut off, or is none of a structure"
    );
    assert_eq!(
        told(SMALL.trim_end()),
        "wall.pch, line 9: the last line does not end: the file has been cut off"
    );
    assert_eq!(
        with("31      1               31", "31      1        6      31"),
        "wall.pch, line 8: `6` between column and first row: must be empty"
    );
    assert_eq!(
        with("20000.+4", "20000.+41.5"),
        "wall.pch, line 8: `1.5` behind the value of row 31.1: a real matrix has nothing there"
    );
    assert_eq!(
        with("12      1        2.0+8", "12\t1\t2.0+8"),
        "wall.pch, line 3: a tab among fields of 8 characters: blanks or commas are wanted"
    );
    assert_eq!(
        told("DMIG,K,0,6,2\nDMIG,K,1,1,,1,1,2.,,2,1,-2.\n"),
        "wall.pch, line 2: 11 fields in a line of at most 8"
    );
    assert_eq!(
        told(&format!("{SMALL}GRID    31              0.0     1.0     2.0     7\n")),
        "wall.pch, line 10: grid 31 has its directions in coordinate system 7: global axes are wanted, 0 in field CD"
    );
}

#[test]
fn a_square_matrix_that_is_not_symmetric_is_refused() {
    let told = |low: &str| {
        let text = format!("DMIG,K,0,1,2\nDMIG,K,1,1,,1,1,2.\n{low}DMIG,K,7,3,,1,1,1.\n,7,3,2.\n");
        of(&text).unwrap_err()
    };
    assert_eq!(
        told(",7,3,1.01\n"),
        "wall.pch, line 4: not symmetric: 1e0 in row 1.1, column 7.3, and 1.01e0 the other way round"
    );
    assert_eq!(
        told(""),
        "wall.pch, line 3: not symmetric: row 1.1 has an entry in column 7.3, and not the other way round; IFO 6 is the form of one triangle"
    );
}

#[test]
fn numbers_are_those_of_nastran() {
    let good = [("1.0", 1.0), ("-1.5-3", -1.5e-3), ("+.5D+2", 50.0), ("7", 7.0), ("1.e2", 100.0)];
    for (text, value) in good {
        assert_eq!(real(text), Some(value), "{text}");
    }
    for text in [
        "", ".", "-", "1.0E", "1.0+", "nan", "inf", "1.0DD3", "1.0+-3", "1..0", "1,0", "–1",
        "1.+400",
    ] {
        assert_eq!(real(text), None, "{text}");
    }
}

#[test]
fn no_damage_makes_it_panic() {
    let small = "DMIG    K       0       6       2\nDMIG    K       1       1               1       1       2.+8            +\n+       2       5       -1.D3\nDMIG,K,2,5,,2,5,4.\nGRID,1,,0.,1.,2.,0\n";
    let large = "DMIG*   K                              0               1               1\nDMIG*   K                              7\n*                      7                             1.5\n";
    for text in [small, large] {
        damaged(text, "wall.pch", 10);
    }
}
