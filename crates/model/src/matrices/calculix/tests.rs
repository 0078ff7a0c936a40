use super::super::{read, tests::damaged};

/// Column by column, the upper triangle, as the program writes it.
const ROD: &str = "1 1  2.0000000000000e+08\n1 2 -2.0000000000000e+08\n2 2  4.0000000000000e+08\n2 3 -2.0000000000000e+08\n3 3  2.0000000000000e+08\n";
const ENTRIES: [(u32, u32, f64); 7] =
    [(0, 0, 2e8), (0, 1, -2e8), (1, 0, -2e8), (1, 1, 4e8), (1, 2, -2e8), (2, 1, -2e8), (2, 2, 2e8)];

#[test]
fn either_triangle_is_read_by_the_name_of_the_file_or_by_what_stands_in_it() {
    let lower = "3 3 2e8\n2 1 -2e8\n\n1 1 2e8\r\n3 2 -2e8\n2 2 4e8\n";
    for (text, name) in [(ROD, "rod.sti"), (lower, "ROD.MAS"), (ROD, "rod.txt"), (ROD, "rod")] {
        let it = read(text.as_bytes(), name, "").unwrap();
        assert_eq!((it.size, &it.entries[..], it.rows.len()), (3, &ENTRIES[..], 0), "{name}");
    }
    // A row without mass.
    let it = read(b"1 1 5\n2 2 0\n", "rod.mas", "").unwrap();
    assert_eq!((it.size, it.entries), (2, vec![(0, 0, 5.0), (1, 1, 0.0)]));
}

#[test]
fn what_is_wrong_is_told_with_its_line() {
    let told = |text: &str| read(text.as_bytes(), "rod.sti", "").unwrap_err().to_string();
    assert_eq!(told(""), "rod.sti: the file is empty");
    assert_eq!(
        told("1 1 2e8\n1 2 2e\n2 2 1\n"),
        "rod.sti, line 2: `1 2 2e` is no entry: row, column and value are wanted"
    );
    assert_eq!(
        told("1 1 2e8\n1 2 nan\n2 2 1\n"),
        "rod.sti, line 2: entry (1, 2) is NaN: must be a finite number"
    );
    assert_eq!(
        told("1 1 2e8\n0 1 2\n"),
        "rod.sti, line 2: entry (0, 1): rows and columns count from 1"
    );
    assert_eq!(
        told("1 1 2e8\n1 4000000000 2\n2 2 1\n"),
        "rod.sti, line 2: entry (1, 4000000000): there is no row 4000000000 in a file of 3 entries, which has the diagonal entry of every row"
    );
    assert_eq!(
        told(ROD.trim_end()),
        "rod.sti, line 5: the last line does not end: the file has been cut off"
    );
    assert_eq!(
        told("1 1 2e8\n1 2 -2e8\n"),
        "rod.sti, line 2: the file ends without the diagonal entry of row 2, and has one of every row: it has been cut off"
    );
    assert_eq!(
        told("1 1 2e8\n1 2 -2e8\n\n2 1 -2e8\n2 2 2e8\n"),
        "rod.sti, line 4: the entry of rows 1 and 2 stands in line 2 already: each stands there once, in one triangle"
    );
    assert_eq!(
        read(ROD.as_bytes(), "rod.sti:KAAX", "").unwrap_err().to_string(),
        "rod.sti: its matrix has no name: leave out `:KAAX`"
    );
}

#[test]
fn no_damage_makes_it_panic() {
    damaged(ROD, "rod.sti", 5);
}
