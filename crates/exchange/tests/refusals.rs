//! Files that are wrong: an error with line and column, or a loss by name, and no panic.

mod common;

use common::file;
use common::spoiled::spoiled_copies;
use trilith_exchange::{Fate, Options, sap2000};

const HEAD: &str = "TABLE:  \"PROGRAM CONTROL\"\n   CurrUnits=\"KN, m, C\"\n \n";
const TAIL: &str = "END TABLE DATA\n";

fn joints(rows: &str) -> String {
    format!("{HEAD}TABLE:  \"JOINT COORDINATES\"\n{rows}{TAIL}")
}

fn refused(text: &[u8], line: usize, column: usize, words: &str) {
    let all = match sap2000::import(text, &Options::default()) {
        Ok(import) => panic!("{words}: let through\n{}", import.report.text()),
        Err(refused) => refused.0,
    };
    let found = all
        .iter()
        .any(|e| (e.line(), e.column()) == (line, column) && e.to_string().contains(words));
    let said: Vec<String> = all.iter().map(ToString::to_string).collect();
    assert!(found, "{words} at {line}:{column} in\n{}", said.join("\n"));
}

#[test]
fn what_is_wrong_in_a_row_is_told_at_its_place() {
    let one = "   Joint=1   XorR=0   Y=0   Z=0\n";
    let cases: [(String, usize, usize, &str); 12] = [
        (joints("   Joint=1   XorR=zero   Y=0   Z=0\n"), 5, 14, "`zero` is no number"),
        (joints("   Joint=1   XorR=1e999   Y=0   Z=0\n"), 5, 14, "`1e999` is no number"),
        (joints("   Joint=1   XorR=0   Y=   Z=0\n"), 5, 23, "a key without a value"),
        (joints("   Joint=1   XorR   Y=0   Z=0\n"), 5, 14, "a key without a value"),
        (joints("   Joint=\"1   XorR=0   Y=0   Z=0\n"), 5, 4, "quotes that do not end"),
        (joints("   Joint=1   Joint=2   XorR=0   Y=0   Z=0\n"), 5, 14, "stands twice in this row"),
        (joints(&format!("{one}{one}")), 6, 4, "two joints \"1\""),
        (joints("   Joint=1   XorR=0   Y=0\n"), 5, 4, "has no `Z`"),
        (joints("   Joint=1   XorR=0 _\n"), 5, 21, "the line that this one continues with"),
        (
            joints("   Joint=1   CoordSys=Ö   XorR=0   Y=0   Z=0\n"),
            5,
            14,
            "no such coordinate system",
        ),
        (format!("{HEAD}Joint=1\n{TAIL}"), 4, 1, "`Joint` is not"),
        (format!("{HEAD}TABLE:  JOINTS\n{TAIL}"), 4, 1, "a table without a name"),
    ];
    for (text, line, column, words) in cases {
        if words == "`Joint` is not" {
            // A row of PROGRAM CONTROL that nobody reads, and no joints.
            refused(text.as_bytes(), 1, 1, "the file has no joints");
            continue;
        }
        refused(text.as_bytes(), line, column, words);
    }
}

#[test]
fn files_that_are_no_models_are_refused() {
    let good = joints("   Joint=1   XorR=0   Y=0   Z=0\n");
    refused(good.replace(TAIL, "").as_bytes(), 5, 31, "ends without the line END TABLE DATA");
    refused(good.replace("KN, m, C", "Ozf, m, C").as_bytes(), 2, 4, "the units `Ozf, m, C`");
    refused(good.replace("KN, m, C", "KN, m").as_bytes(), 2, 4, "the units `KN, m`");
    refused(format!("{good}more\n").as_bytes(), 7, 1, "behind END TABLE DATA");
    refused(b"PK\x03\x04\0\0", 1, 5, "a zero byte");
    refused(b"", 1, 1, "ends without the line END TABLE DATA");
    refused(b"$ File\n$ PROGRAM INFORMATION\n", 1, 1, "this is a text file of ETABS");
    let no_units = good.replace("   CurrUnits=\"KN, m, C\"\n", "");
    refused(no_units.as_bytes(), 1, 1, "does not say its units");
}

#[test]
fn names_of_nothing_are_told() {
    let text = std::fs::read_to_string(file("oscillators.s2k")).unwrap();
    let line = |words: &str| text[..text.find(words).unwrap()].lines().count();
    for (from, to, words) in [
        ("JointJ=mass", "JointJ=nowhere", "there is no joint \"nowhere\""),
        ("LinkProp=LIN1", "LinkProp=LIN9", "there is no link property \"LIN9\""),
        ("LoadName=PUSH", "LoadName=PULL", "there is no load pattern \"PULL\""),
        ("InitialCond=HOLD", "InitialCond=AFTER", "the case before \"AFTER\" is missing"),
    ] {
        let at = line(from);
        let spoiled = text.replacen(from, to, 1);
        let all = sap2000::import(spoiled.as_bytes(), &Options::default()).unwrap_err().0;
        let found = all.iter().any(|e| e.line() == at && e.message.contains(words));
        assert!(found, "{words} in line {at}: {all:?}");
    }
    let options = Options { case: Some("NONE".into()), ..Options::default() };
    let said = sap2000::import(text.as_bytes(), &options).unwrap_err().to_string();
    assert!(said.contains("the cases are AFTER, HOLD, MODAL, STEP, FILE"), "{said}");
}

#[test]
fn unknown_tables_and_fields_are_losses_and_bytes_that_are_no_utf_8_are_told() {
    let mut text = joints("   Joint=1   XorR=0   Y=0   Z=0   Twist=3   Idle=0\n").replace(
        TAIL,
        "TABLE:  \"SOMETHING NEW\"\n   A=1\n   A=2\nTABLE:  \"CONNECTIVITY - AREA\"\n   Area=1\n\
         TABLE:  \"REBAR SIZES\"\n   RebarID=?\nTABLE:  \"SOLID LOADS - GRAVITY\"\nEND TABLE DATA\n",
    );
    let plain = sap2000::import(text.as_bytes(), &Options::default()).unwrap();
    // And what there is holds nothing.
    assert_eq!(plain.report.losses(), 4, "{}", plain.report.text());
    let fate = |name: &str| plain.report.tables.iter().find(|t| t.name == name).unwrap();
    assert_eq!(fate("SOMETHING NEW").fate, Fate::Lost("an unknown table".into()));
    assert_eq!(fate("SOMETHING NEW").rows, 2);
    assert!(matches!(fate("CONNECTIVITY - AREA").fate, Fate::Lost(_)));
    assert_eq!(fate("SOLID LOADS - GRAVITY").fate, Fate::Ignored("empty".into()));
    let twist = plain.report.lost.iter().find(|n| n.place == "JOINT COORDINATES: Twist");
    assert_eq!(twist.map(|n| n.which.as_slice()), Some(&["Twist=3".to_owned()][..]));
    assert_eq!(plain.report.otherwise.iter().filter(|n| n.place == "the file").count(), 0);
    text = text.replace("RebarID=?", "RebarID=6@");
    let bytes: Vec<u8> = text.bytes().map(|b| if b == b'@' { 0xD8 } else { b }).collect();
    let latin = sap2000::import(&bytes, &Options::default()).unwrap();
    assert_eq!(latin.report.otherwise.iter().filter(|n| n.place == "the file").count(), 1);
}

#[test]
fn spoiled_files_are_refused_or_read_but_never_break() {
    let hurts: [&[u8]; 12] = [
        b"-1",
        b"0",
        b"1e308",
        b"NaN",
        b"\"",
        b"=",
        b" _\n",
        b"\n",
        b"\xff",
        b"Yes",
        b"99999999999",
        b"",
    ];
    let mut through = 0;
    for name in ["cantilevers.s2k", "oscillators.s2k", "links.s2k"] {
        let bytes = std::fs::read(file(name)).unwrap();
        for spoiled in spoiled_copies(&bytes, 700, &hurts) {
            if let Ok(import) = sap2000::import(&spoiled, &Options::default()) {
                through += 1;
                assert_eq!(import.draft.beyond(), None);
                assert!(!import.draft.to_ron().is_empty() && !import.report.text().is_empty());
            }
        }
    }
    assert!(through > 50, "{through}");
}
