use super::super::tests::damaged;
use super::super::{matrix_file, read, written};
use crate::MatrixForm;
use trilith_element::SparseMatrix;

/// 3 rows: two masses between springs, and a third by itself.
const ENTRIES: [(u32, u32, f64); 5] =
    [(0, 0, 2.0), (0, 1, -2.5), (1, 0, -2.5), (1, 1, 4.0), (2, 2, 0.5)];

fn head(name: &str, rows: i64, form: i64, kind: i64, format: &str) -> String {
    format!("{:8}{rows:8}{form:8}{kind:8}{name:8}{format}\n", rows.abs())
}

fn e16(x: f64) -> String {
    let text = format!("{x:.9E}");
    let (digits, exponent) = text.split_once('E').unwrap();
    let exponent: i32 = exponent.parse().unwrap();
    format!("{:>16}", format!("{digits}E{exponent:+03}"))
}

/// Columns of values from a first row on, and the last record.
fn dense(name: &str, words: i64) -> String {
    let kind = if words == 1 { 1 } else { 2 };
    let mut text = head(name, 3, 6, kind, "1P,5E16.9");
    for (column, row, values) in [(1, 1, &[2.0, -2.5][..]), (2, 1, &[-2.5, 4.0]), (3, 3, &[0.5])] {
        text += &format!("{column:8}{row:8}{:8}\n", words * values.len() as i64);
        text += &values.iter().map(|x| e16(*x)).collect::<String>();
        text += "\n";
    }
    text + &format!("{:8}{:8}{words:8}\n{}\n", 4, 1, e16(1.0))
}

/// The same in strings; in column 1 two of one value each.
fn strings(name: &str, big: bool) -> String {
    let mut text = head(name, if big { -3 } else { 3 }, 2, 2, "1P,5E16.9");
    let columns: [&[(i64, &[f64])]; 3] =
        [&[(1, &[2.0]), (2, &[-2.5])], &[(1, &[-2.5, 4.0])], &[(3, &[0.5])]];
    for (j, own) in columns.into_iter().enumerate() {
        let wide = if big { 2 } else { 1 };
        let words: i64 = own.iter().map(|(_, v)| 2 * v.len() as i64 + wide).sum();
        text += &format!("{:8}{:8}{words:8}\n", j + 1, 0);
        for (row, values) in own {
            let length = 2 * values.len() as i64 + 1;
            text += &match big {
                true => format!("{length:8}{row:8}\n"),
                false => format!("{:12}\n", row + 65536 * length),
            };
            text += &values.iter().map(|x| e16(*x)).collect::<String>();
            text += "\n";
        }
    }
    text + &format!("{:8}{:8}{:8}\n{}\n", 4, 1, 2, e16(1.0))
}

/// What a record of Fortran is.
fn record(words: &[u8], big: bool) -> Vec<u8> {
    let length = i32::try_from(words.len()).unwrap();
    let length = if big { length.to_be_bytes() } else { length.to_le_bytes() };
    [&length[..], words, &length].concat()
}

/// The same without a format: columns of values, or strings of one of two kinds, in an order of bytes, in a precision.
fn binary(sort: &str, big_endian: bool, double: bool) -> Vec<u8> {
    let word = |x: i64| {
        let x = i32::try_from(x).unwrap();
        if big_endian { x.to_be_bytes() } else { x.to_le_bytes() }.to_vec()
    };
    let value = |x: f64| match (big_endian, double) {
        (true, true) => x.to_be_bytes().to_vec(),
        (false, true) => x.to_le_bytes().to_vec(),
        (true, false) => (x as f32).to_be_bytes().to_vec(),
        (false, false) => (x as f32).to_le_bytes().to_vec(),
    };
    let each = if double { 2 } else { 1 };
    let rows = if sort == "big" { -3 } else { 3 };
    let mut first: Vec<u8> = [3, rows, 6, each].into_iter().flat_map(word).collect();
    first.extend(b"KAA     ");
    let mut all = record(&first, big_endian);
    for (column, row, values) in [(1, 1, &[2.0, -2.5][..]), (2, 1, &[-2.5, 4.0]), (3, 3, &[0.5])] {
        let length = each * values.len() as i64 + 1;
        let mut data: Vec<u8> = match sort {
            "dense" => Vec::new(),
            "big" => [length, row].into_iter().flat_map(word).collect(),
            _ => word(row + 65536 * length),
        };
        data.extend(values.iter().flat_map(|x| value(*x)));
        let start = if sort == "dense" { row } else { 0 };
        let mut own: Vec<u8> =
            [column, start, data.len() as i64 / 4].into_iter().flat_map(word).collect();
        own.extend(data);
        all.extend(record(&own, big_endian));
    }
    let mut last: Vec<u8> = [4, 1, each].into_iter().flat_map(word).collect();
    last.extend(value(1.0));
    all.extend(record(&last, big_endian));
    all
}

fn of(bytes: &[u8], name: &str) -> Result<SparseMatrix, String> {
    read(bytes, name, "").map_err(|e| e.to_string())
}

#[test]
fn columns_and_strings_are_read_from_formatted_and_unformatted_files() {
    let texts = [dense("KAA", 1), dense("KAA", 2), strings("KAA", false), strings("KAA", true)];
    for text in texts {
        let it = of(text.as_bytes(), "w.op4").unwrap_or_else(|e| panic!("{e}:\n{text}"));
        assert_eq!((it.size, &it.entries[..]), (3, &ENTRIES[..]), "{text}");
        // Windows ends lines otherwise.
        assert_eq!(of(text.replace('\n', "\r\n").as_bytes(), "w.op4").unwrap().entries, ENTRIES);
    }
    for sort in ["dense", "strings", "big"] {
        for (big_endian, double) in [(false, true), (true, true), (false, false), (true, false)] {
            let it = of(&binary(sort, big_endian, double), "w.op4");
            let it = it.unwrap_or_else(|e| panic!("{sort} {big_endian} {double}: {e}"));
            assert_eq!((it.size, &it.entries[..]), (3, &ENTRIES[..]));
        }
    }
    // Some programs count values instead of words in double precision.
    let by_values = dense("KAA", 1).replacen("       1KAA", "       2KAA", 1);
    assert_eq!(of(by_values.as_bytes(), "w.op4").unwrap().entries, ENTRIES);
    // Exponents with a D, or without a letter.
    let letters = dense("KAA", 2).replacen("2.000000000E+00", "2.000000000D+00", 1);
    assert_eq!(of(letters.as_bytes(), "w.op4").unwrap().entries, ENTRIES);
}

#[test]
fn one_of_several_matrices_is_named() {
    let mass = dense("maa", 2).replace("5.000000000E-01", "7.000000000E-01");
    let load = format!("{:8}{:8}{:8}{:8}PG      1P,5E16.9\n", 1, 3, 2, 2)
        + &format!("{:8}{:8}{:8}\n{}\n{:8}{:8}{:8}\n{}\n", 1, 2, 2, e16(9.0), 2, 1, 2, e16(1.0));
    let text = format!("{}{load}{mass}", strings("KAA", false));
    assert_eq!(of(text.as_bytes(), "w.op4:kaa").unwrap().entries, ENTRIES);
    let it = of(text.as_bytes(), "w.op4:MAA").unwrap();
    assert_eq!((it.name.as_str(), it.entries[4]), ("w.op4:MAA", (2, 2, 0.7)));
    assert_eq!(
        of(text.as_bytes(), "w.op4:BAA").unwrap_err(),
        "w.op4: there is no matrix `BAA`: the file has KAA, PG, MAA"
    );
    assert_eq!(
        of(text.as_bytes(), "w.op4").unwrap_err(),
        "w.op4: the file has the matrices KAA, PG, MAA: name one of them, as in `w.op4:KAA`"
    );
    // Of one that is square nothing has to be said.
    let text = format!("{load}{mass}");
    assert_eq!(of(text.as_bytes(), "w.op4").unwrap().entries[4], (2, 2, 0.7));
    assert_eq!(
        of(text.as_bytes(), "w.op4:PG").unwrap_err(),
        "w.op4, line 1: PG: the matrix has 3 rows and 1 columns: must be square"
    );
    let all = [binary("dense", false, true), binary("big", false, true)].concat();
    let told = of(&all, "w.op4:KAA").unwrap_err();
    assert_eq!(told, "w.op4: the file has several matrices KAA");
}

#[test]
fn what_is_wrong_with_a_file_is_told_with_its_line() {
    let changed = |from: &str, to: &str| {
        let text = dense("KAA", 2);
        assert!(text.contains(from), "{text}");
        of(text.replacen(from, to, 1).as_bytes(), "w.op4").unwrap_err()
    };
    assert_eq!(
        changed("       2KAA", "       4KAA"),
        "w.op4, line 1: matrix KAA is complex (type 4), and no stiffness, mass or damping: a real one is wanted, type 1 or 2"
    );
    assert_eq!(
        changed("       6       2KAA", "       3       2KAA"),
        "w.op4, line 1: the form of matrix KAA is 3: must be 6 (symmetric), 1 or 2 (square, rectangular)"
    );
    assert_eq!(
        changed("1P,5E16.9", "1P,5I16"),
        "w.op4, line 1: `1P,5I16` is no format of the values of matrix KAA: one such as 1P,5E16.9 is wanted"
    );
    assert_eq!(
        changed("       2       1       4", "       2       1       6"),
        "w.op4, line 5: 2 values in column 2 of matrix KAA, where 6 words are counted: the file may have been cut off"
    );
    assert_eq!(
        changed("       2       1       4", "       1       1       4"),
        "w.op4, line 4: column 1 of matrix KAA comes after column 1: must rise"
    );
    assert_eq!(
        changed("       3       3       2", "       3       4       2"),
        "w.op4, line 6: rows 4 to 4 in column 3 of matrix KAA, which has 3"
    );
    assert_eq!(
        changed("4.000000000E+00", "4.000000000X+00"),
        "w.op4, line 5: `4.000000000X+00` is no number of 16 characters, or has been cut off"
    );
    assert!(
        changed("       3       3       6", "       x       3       6")
            .contains("begins no matrix")
    );
    let text = dense("KAA", 2);
    let end = text.find("       4       1").unwrap();
    assert_eq!(
        of(&text.as_bytes()[..end], "w.op4").unwrap_err(),
        "w.op4, line 7: matrix KAA ends before its last record: the file has been cut off"
    );
    assert_eq!(of(b"", "w.op4").unwrap_err(), "w.op4: no matrix begins in the file");
    let bytes = binary("strings", false, true);
    assert_eq!(
        of(&bytes[..bytes.len() - 3], "w.op4").unwrap_err(),
        "w.op4: a record does not end: the file has been cut off, or is damaged"
    );
    assert_eq!(
        of(&bytes[..32], "w.op4").unwrap_err(),
        "w.op4: matrix KAA ends before its last record: the file has been cut off"
    );
    let long = [&48_i32.to_le_bytes()[..], &[0; 48], &48_i32.to_le_bytes()].concat();
    assert_eq!(
        of(&long, "w.op4").unwrap_err(),
        "w.op4: its words have eight bytes: those of four are read, or a formatted file"
    );
}

#[test]
fn damaged_files_are_read_or_refused() {
    damaged(&dense("KAA", 2), "w.op4", 99_999_999);
    damaged(&strings("KAA", false), "w.op4", 99_999_999);
    for sort in ["dense", "strings", "big"] {
        let whole = binary(sort, false, true);
        for end in 0..whole.len() {
            assert!(of(&whole[..end], "w.op4").is_err(), "{end} bytes of {sort}");
        }
        for at in 0..whole.len() {
            let mut bytes = whole.clone();
            for other in [0, 1, 3, 127, 128, 255] {
                bytes[at] = other;
                if let Ok(it) = of(&bytes, "w.op4") {
                    let within =
                        |e: &(u32, u32, f64)| (e.0.max(e.1) as usize) < it.size && e.2.is_finite();
                    assert!(it.entries.iter().all(within));
                }
            }
        }
    }
}

#[test]
fn what_is_written_is_read_again() {
    let entries = [(0, 0, 1.0 / 3.0), (0, 2, -1e-150), (2, 0, -1e-150), (2, 2, 1.7e300)];
    let name = "w.op4:KAA".to_owned();
    let it = SparseMatrix { name, size: 4, entries: entries.to_vec(), ..SparseMatrix::default() };
    let text = written(&it);
    let again = of(text.as_bytes(), "w.op4:KAA").unwrap();
    assert_eq!((again.size, &again.entries[..]), (4, &entries[..]));
    assert_eq!(matrix_file(&it, MatrixForm::Op4).unwrap(), text.as_bytes());
    // All of the same length, as a program that counts characters wants them.
    let values = text.lines().filter(|l| l.contains('.') && !l.contains("KAA"));
    assert!(values.into_iter().all(|l| l.len().is_multiple_of(24)), "{text}");
}
