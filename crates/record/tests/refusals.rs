//! What is read wrong in silence elsewhere is refused here: decimal commas, counts that are not those of the
//! header, motions that overflow, what is no file.

use std::path::{Path, PathBuf};
use trilith_record::{Column, Columns, Problem, ReadOptions, parse, read};

fn path(name: &str) -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/files").join(name)
}

fn file(name: &str) -> String {
    std::fs::read_to_string(path(name)).unwrap()
}

fn told(text: &str, name: &str) -> String {
    let error = parse(text.as_bytes(), name, &ReadOptions::default()).expect_err(text);
    format!("{error}; {}", error.help().unwrap_or_default())
}

fn at2(header: &str, values: &str) -> String {
    format!("X\nEQ, STATION, 090\nACCELERATION TIME SERIES IN UNITS OF G\n{header}\n{values}\n")
}

#[test]
fn decimal_commas_of_at2_are_refused_where_they_stand() {
    let help = "numbers have a decimal point and no commas";
    for (header, values, place) in [
        ("NPTS= 4, DT= .01 SEC", " -0,005 -0,4", "a.at2:5:2: `-0,005` has a comma within a number"),
        ("NPTS= 4, DT= .01 SEC", "0,005 0,4", "a.at2:5:1: `0,005` has a comma"),
        ("NPTS= 3, DT= .01 SEC", "0.1 0,4 0.1", "a.at2:5:5: `0,4` has a comma"),
        ("NPTS= 2, DT= 1,5 SEC", "0.1 0.4", "a.at2:4:14: `1,5` has a comma"),
        ("2    1,5   NPTS, DT", "0.1 0.4", "a.at2:4:6: `1,5` has a comma"),
        ("2 points at equal spacing of 1,5 sec", "0.1 0.4", "a.at2:4: `1,5` has a comma"),
    ] {
        let text = told(&at2(header, values), "a.at2");
        assert!(text.starts_with(place) && text.contains(help), "{text}");
    }
    // Where both have a point the comma can only part them.
    let good = at2("NPTS=4,DT=.01 SEC", "0.005,0.4, -0.1,\n0.2,");
    let records = parse(good.as_bytes(), "a.at2", &ReadOptions::default()).unwrap();
    let g = 9.80665;
    assert_eq!(records[0].acceleration, [0.005 * g, 0.4 * g, -0.1 * g, 0.2 * g]);
}

#[test]
fn decimal_commas_of_other_formats_are_refused() {
    for (name, from, to, cell) in [
        ("esm.asc", "\n122.559764", "\n122,559764", "`122,559764`"),
        ("esm.asc", "_S: 0.010000", "_S: 0,010000", "`0,010000`"),
        ("csmip.v2", "  0.000000 122.55976", "  0,000000 122,55976", "`0,000000`"),
        ("csmip.v2", "spaced at  .010 sec", "spaced at 0,010 sec", "`0,010`"),
        ("cosmos.v2", "   0.00000 122.55976", "   0,00000 122,55976", "`0,00000`"),
        ("knet.NS", "    12345   134905", "    12,345  134905", "`12,345`"),
        ("one_column.txt", "# dt: 10 ms", "# dt: 0,01 s", "`0,01`"),
    ] {
        let text = file(name);
        assert!(text.contains(from), "{name}: {from}");
        let text = told(&text.replacen(from, to, 1), name);
        assert!(text.contains(&format!("{cell} has a comma within a number")), "{text}");
    }
}

#[test]
fn decimal_commas_of_columns_are_refused() {
    for (text, place) in [
        ("# unit: g\n0,00;0,1\n0,01;0,2\n", "a.csv:2:1: `0,00` has"),
        ("# unit: g\n0,00\t0,1\n0,01\t0,2\n", "a.csv:2:1: `0,00` has"),
        ("# unit: g\n0,00 0,1\n0,01 0,2\n", "a.csv:2:1: `0,00` has"),
        ("# unit: g\n0,00,0,1\n0,01,0,2\n", "a.csv:2:1: `0,00` has"),
        ("# unit: g\nt,a\n0,5,1,2\n1,0,1,3\n", "a.csv:3:1: `0,5` has"),
        ("# unit: g\n# dt: 10 ms\n0,1\n1,2\n0,3\n", "a.csv:3:1: `0,1` has"),
        ("# unit: g\nt;a\n0;0\n1;\"0,5\"\n", "a.csv:4:3: `0,5` has"),
    ] {
        let text = told(text, "a.csv");
        assert!(text.starts_with(place), "{text}");
    }
    // Whole numbers parted by commas are what they are.
    let text = "# unit: g\nt,a\n0,5\n1,0\n2,3\n";
    let records = parse(text.as_bytes(), "a.csv", &ReadOptions::default()).unwrap();
    assert_eq!((records[0].dt, records[0].acceleration.len()), (1.0, 3));
}

#[test]
fn too_many_values_are_counted_to_their_end() {
    let text = file("peer.at2").replace("NPTS=     30", "NPTS=     23");
    let said = told(&text, "a.at2");
    assert!(said.starts_with("a.at2:4: the header states 23 values, there are 30"), "{said}");
    let text = file("cosmos.v2").replacen("     30 acceleration", "     13 acceleration", 1);
    let said = told(&text, "a.v2");
    assert!(said.contains("the header states 13 values, there are 30"), "{said}");
    let text = file("csmip.v2").replacen("    30 points of accel", "     8 points of accel", 1);
    let said = told(&text, "a.v2");
    assert!(said.contains("the header states 8 values, there are 30"), "{said}");
    let text = file("cosmos.v2").replacen(" 100 Integer-header", "  90 Integer-header", 1);
    let said = told(&text, "a.v2");
    assert!(said.starts_with("a.v2:14: the header states 90 values, there are 100"), "{said}");
    let text = file("knet.NS").replace("Duration Time(s)  1", "Duration Time(s)  0");
    let said = told(&text, "a.NS");
    assert!(said.starts_with("a.NS:12: the header states 0 values, there are 100"), "{said}");
    let said = told(&at2("NPTS= 3000000, DT= .01 SEC", "0.1 0.2"), "a.at2");
    assert!(said.starts_with("a.at2:4: there are more than 2000000 samples"), "{said}");
}

#[test]
fn motions_that_overflow_say_what_does() {
    for (header, values, what) in [
        ("NPTS= 3, DT= .01 SEC", "0 1e308 0", "the acceleration is not finite, first at sample 2"),
        ("NPTS= 3, DT= 1e6 SEC", "0 1e306 0", "the velocity is not finite, first at sample 2"),
        ("NPTS= 3, DT= 1e6 SEC", "0 1e299 0", "the displacement is not finite, first at sample 2"),
        ("NPTS= 3, DT= .01 SEC", "0 1e160 0", "the Arias intensity is not finite"),
    ] {
        let said = told(&at2(header, values), "a.at2");
        assert!(said.starts_with(&format!("a.at2: {what}")), "{said}");
    }
    for step in ["0", "1e308", "1e-308", "-0.01"] {
        let said = told(&at2(&format!("NPTS= 3, DT= {step} SEC"), "0 1 0"), "a.at2");
        assert!(
            said.contains("a time step of") && said.contains("between 1e-9 s and 1e6 s"),
            "{said}"
        );
    }
}

#[test]
fn a_file_of_anything_is_not_quoted() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("users");
    std::fs::write(&path, "root:x:0:0:root:/root:/bin/sh\nnobody:x:9:9:none:/:/bin/false\n")
        .unwrap();
    let columns = Columns::read(&path, 0).unwrap();
    let error = columns.numbers(&Column::Position(0)).unwrap_err();
    assert_eq!((error.line, error.column), (Some(2), Some(1)));
    assert!(
        error.to_string().ends_with(":2:1: a text of 30 characters is no finite number"),
        "{error}"
    );
    let error = columns.numbers(&Column::Header("time".into())).unwrap_err();
    assert_eq!(error.problem, Problem::UnknownColumn { name: "time".into(), all: Vec::new() });
    // Long enough that one control character makes no binary file of it.
    let text = format!("# {}\n0,1\n1,\u{1b}[2J\n", "-".repeat(120));
    std::fs::write(&path, text).unwrap();
    let error = Columns::read(&path, 0).unwrap().numbers(&Column::Position(1)).unwrap_err();
    assert!(error.to_string().ends_with(":3:3: `\\u{1b}[2J` is no finite number"), "{error}");
}

#[test]
fn what_is_no_regular_file_is_no_record() {
    let folder = tempfile::tempdir().unwrap();
    let error = read(folder.path(), &ReadOptions::default()).unwrap_err().to_string();
    assert!(error.ends_with("cannot be read: it is a folder, not a regular file"), "{error}");
    if cfg!(unix) {
        let error = read("/dev/zero", &ReadOptions::default()).unwrap_err().to_string();
        assert_eq!(error, "/dev/zero cannot be read: it is a device, not a regular file");
    }
}
