//! Text models of ETABS that are wrong: an error with line and column, or a loss by name, and no panic.

mod common;

use common::spoiled::spoiled_copies;
use std::path::Path;
use trilith_exchange::{Options, etabs};

/// A column of a storey, line by line.
const COLUMN: [&str; 17] = [
    "$ CONTROLS",
    "  UNITS  \"KN\"  \"M\"  \"C\"",
    "$ STORIES - IN SEQUENCE FROM TOP",
    "  STORY \"Top\"  HEIGHT 3",
    "  STORY \"Base\"  ELEV 0",
    "$ MATERIAL PROPERTIES",
    "  MATERIAL \"C\"  E 3E7  U 0.2",
    "$ FRAME SECTIONS",
    "  FRAMESECTION \"S\"  MATERIAL \"C\"  SHAPE \"Concrete Rectangular\"  D 0.4  B 0.3",
    "$ POINT COORDINATES",
    "  POINT \"1\"  0 0",
    "$ LINE CONNECTIVITIES",
    "  LINE \"C1\"  COLUMN  \"1\"  \"1\"  1",
    "$ LINE ASSIGNS",
    "  LINEASSIGN \"C1\"  \"Top\"  SECTION \"S\"",
    "",
    "$ END OF MODEL FILE",
];

fn text() -> String {
    COLUMN.map(|line| format!("{line}\n")).concat()
}

/// The column with one text in place of another.
fn spoiled(from: &str, to: &str) -> String {
    assert!(text().contains(from), "{from}");
    text().replacen(from, to, 1)
}

fn refused(text: &str, line: usize, column: usize, words: &str) {
    let all = match etabs::import(text.as_bytes(), &Options::default()) {
        Ok(import) => panic!("{words}: let through\n{}", import.report.text()),
        Err(refused) => refused.0,
    };
    let here = |e: &&trilith_model::Diagnostic| (e.line(), e.column()) == (line, column);
    let found = all.iter().filter(here).any(|e| e.to_string().contains(words));
    let said: Vec<String> = all.iter().map(ToString::to_string).collect();
    assert!(found, "{words} at {line}:{column} in\n{}", said.join("\n"));
}

#[test]
fn the_column_itself_is_read_without_a_loss() {
    let import = etabs::import(text().as_bytes(), &Options::default()).unwrap();
    assert_eq!(import.report.losses(), 0, "{}", import.report.text());
}

#[test]
fn what_is_wrong_is_told_at_its_place() {
    let twice = "  POINT \"1\"  0 0\n  POINT \"1\"  0 1";
    for (from, to, line, column, words) in [
        (
            "  STORY \"Top\"",
            "  STOREY \"Top\"",
            4,
            3,
            "`STOREY` is no keyword of the section STORIES",
        ),
        ("\"KN\"  \"M\"", "\"KN\"  \"Yard\"", 2, 3, "the units `KN Yard` are not known"),
        ("  POINT \"1\"  0 0", twice, 12, 3, "there are two points \"1\""),
        ("COLUMN  \"1\"  \"1\"", "COLUMN  \"1\"  \"7\"", 13, 3, "there is no point \"7\""),
        ("\"C1\"  \"Top\"", "\"C1\"  \"Roof\"", 15, 3, "there is no storey \"Roof\""),
        ("\"Top\"  SECTION \"S\"", "\"Top\"  SECTION \"T\"", 15, 35, "there is no section \"T\""),
        ("LINEASSIGN \"C1\"", "LINEASSIGN \"C2\"", 15, 3, "there is no line \"C2\""),
        ("\"1\"  1\n", "\"1\"  2\n", 15, 3, "there are not 2 storeys below Top"),
        ("\"1\"  1\n", "\"1\"  1.5\n", 13, 3, "a whole number"),
        ("HEIGHT 3", "HEIGHT tall", 4, 23, "`tall` is no number"),
        ("HEIGHT 3", "HEIGHT", 4, 16, "`HEIGHT` has no value"),
        ("HEIGHT 3", "", 4, 3, "the storey \"Top\" has no height"),
        ("\"Top\"  HEIGHT", "\"Base\"  HEIGHT", 4, 3, "two storeys \"Base\""),
        ("D 0.4  B", "D -0.4  B", 9, 3, "needs D, B above zero"),
        (
            "MATERIAL \"C\"  SHAPE",
            "MATERIAL \"X\"  SHAPE",
            9,
            3,
            "the material of this section is not",
        ),
        ("  POINT \"1\"  0 0", "  POINT \"1\"  0", 11, 3, "a point needs its X and Y"),
        ("  POINT \"1\"", "  POINT \"1", 11, 9, "quotes that do not end"),
        ("  POINT \"1\"", "  \"POINT\" \"1\"", 11, 3, "a line begins with a keyword"),
        ("  POINT \"1\"  0 0", "  POINT 1  0 0", 11, 3, "a name in quotes"),
        (
            "\"Top\"  SECTION \"S\"",
            "\"Top\"  SECTION \"S\" RELEASE \"M4I\"",
            15,
            47,
            "`M4I` is no direction",
        ),
        (
            "  LINE \"C1\"",
            "  LINE \"C1\" COLUMN \"1\" \"1\" 1\n  LINE \"C1\"",
            14,
            3,
            "two lines \"C1\"",
        ),
        ("$ END OF MODEL FILE\n", "", 15, 37, "the file ends without the line $ END"),
        (
            "$ END OF MODEL FILE\n",
            "$ END OF MODEL FILE\nmore\n",
            18,
            1,
            "there is something behind",
        ),
        ("$ CONTROLS\n", "", 1, 3, "this line stands in no section"),
        ("  UNITS  \"KN\"  \"M\"  \"C\"\n", "", 1, 1, "the file does not say its units"),
    ] {
        refused(&spoiled(from, to), line, column, words);
    }
    refused("", 1, 1, "the file ends without the line");
    refused("PK\u{3}\u{4}\0", 1, 5, "a zero byte");
    let with = |more: &str| spoiled("\n\n$ END", &format!("\n{more}\n$ END"));
    for (more, column, words) in [
        (
            "$ POINT ASSIGNS\n  POINTASSIGN \"1\"  \"Base\"  RESTRAINT \"UX TX\"",
            38,
            "`TX` is no direction",
        ),
        (
            "$ POINT ASSIGNS\n  POINTASSIGN \"9\"  \"Base\"  RESTRAINT \"UX\"",
            3,
            "there is no point \"9\"",
        ),
        (
            "$ POINT ASSIGNS\n  POINTASSIGN \"1\"  \"Top\"  DIAPH \"D7\"",
            33,
            "there is no diaphragm \"D7\"",
        ),
        (
            "$ POINT ASSIGNS\n  POINTASSIGN \"1\"  \"Top\"  SPRINGPROP \"P\"",
            38,
            "there is no point spring \"P\"",
        ),
        (
            "$ POINT OBJECT LOADS\n  POINTLOAD \"1\"  \"Top\"  LC \"D\"  FX 1",
            28,
            "there is no load pattern \"D\"",
        ),
        (
            "$ LINK ASSIGNS\n  LINKASSIGN \"K\"  \"Top\"  LINKPROP \"D\"",
            3,
            "there is no link \"K\"",
        ),
        (
            "$ LOAD CASES\n  LOADCASE \"A\"  TYPE \"Nonlinear Static\"  INITCOND \"B\"",
            51,
            "there is no load case \"B\"",
        ),
    ] {
        refused(&with(more), 17, column, words);
    }
}

#[test]
fn unknown_sections_and_fields_are_losses() {
    let text = spoiled(
        "\"Top\"  SECTION \"S\"",
        "\"Top\"  SECTION \"S\"  TWIST 3  IDLE 0  SOMETHING \"No\"",
    );
    let text =
        text.replace("$ LINE ASSIGNS", "$ TOTALLY NEW\n  NEW 1\n$ TENDON ASSIGNS\n$ LINE ASSIGNS");
    let import = etabs::import(text.as_bytes(), &Options::default()).unwrap();
    let report = import.report.text();
    assert_eq!(import.report.losses(), 2, "{report}");
    assert!(report.contains("TOTALLY NEW") && report.contains("an unknown section"), "{report}");
    let twist = import.report.lost.iter().find(|n| n.place == "LINE ASSIGNS: TWIST");
    assert_eq!(twist.map(|n| n.which.as_slice()), Some(&["TWIST 3".to_owned()][..]), "{report}");
}

#[test]
fn numbers_with_commas_are_read_and_bytes_that_are_no_utf_8_are_told() {
    let comma = spoiled("HEIGHT 3", "HEIGHT 3,5");
    let import = etabs::import(comma.as_bytes(), &Options::default()).unwrap();
    assert!(import.draft.nodes.iter().any(|(_, at)| at[2] == 3.5), "{:?}", import.draft.nodes);
    let bytes: Vec<u8> = text()
        .replace("\"Top\"", "\"T@p\"")
        .bytes()
        .map(|b| if b == b'@' { 0xD8 } else { b })
        .collect();
    let import = etabs::import(&bytes, &Options::default()).unwrap();
    assert_eq!(import.report.otherwise.iter().filter(|n| n.place == "the file").count(), 1);
}

#[test]
fn spoiled_files_are_refused_or_read_but_never_break() {
    let hurts: [&[u8]; 12] = [
        b"-1",
        b"0",
        b"1e308",
        b"NaN",
        b"\"",
        b"$",
        b"\n",
        b"\n$ ",
        b"\xff",
        b"\"Yes\"",
        b"99999999999",
        b"",
    ];
    let mut through = 0;
    for name in ["building.e2k", "links.e2k"] {
        let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/etabs").join(name);
        let bytes = std::fs::read(path).unwrap();
        for spoiled in spoiled_copies(&bytes, 400, &hurts) {
            if let Ok(import) = etabs::import(&spoiled, &Options::default()) {
                through += 1;
                assert_eq!(import.draft.beyond(), None);
                assert!(!import.draft.to_ron().is_empty() && !import.report.text().is_empty());
            }
        }
    }
    assert!(through > 50, "{through}");
}
