//! What becomes of the tables of a file and of the fields that nobody asked for, and why.

use super::database::{Database, Row};
use super::fates::{IGNORED, LOST, READ};
use crate::report::{Fate, Report, TableReport};

/// Fields by which rows are found: a row of which nothing else was asked for defines what nothing uses.
const KEYS: &[&str] =
    &["Case", "Link", "Material", "Name", "SectionName", "ComboName", "Joint", "Frame"];

/// Tables whose rows define what others use, by the beginning of their names.
const DEFINITIONS: &[&str] = &[
    "CONSTRAINT DEFINITIONS",
    "COORDINATE SYSTEMS",
    "FRAME SECTION PROPERTIES",
    "FUNCTION",
    "LINK PROPERTY DEFINITIONS",
    "MATERIAL PROPERTIES",
];

/// Fields that change nothing, in any table.
const IDLE: &[&str] = &[
    "GUID",
    "Color",
    "Notes",
    "Length",
    "CentroidX",
    "CentroidY",
    "CentroidZ",
    "SpecialJt",
    "GlobalX",
    "GlobalY",
    "GlobalZ",
    "CaseStatus",
];

/// Fields that change nothing, by the beginning of the name of the table, and why.
const FIELDS: &[(&str, &[&str], &str)] = &[
    ("PROGRAM CONTROL", &["*"], "the program and its design codes"),
    ("PROJECT INFORMATION", &["*"], "only the name of the model goes into its title"),
    ("MATERIAL PROPERTIES 01", &["*"], "what counts are its numbers"),
    (
        "MATERIAL PROPERTIES 02",
        &["U12", "U13", "U23", "E2", "E3", "G13", "G23", "A2", "A3"],
        "frames take E1, G12 and A1",
    ),
    ("FRAME SECTION PROPERTIES 01", &["*"], "a beam takes areas, moments and their factors"),
    ("FRAME SECTION ASSIGNMENTS", &["AutoSelect", "SectionType", "DesignSect"], "design only"),
    ("FRAME AUTO MESH", &["MaxDegrees"], "curved frames are named"),
    (
        "FRAME LOADS",
        &["RelDistA", "RelDistB", "RelDist", "AbsDistA", "AbsDistB", "AbsDist"],
        "the distance that DistType does not name says the same",
    ),
    ("FRAME RELEASE", &["PartialFix"], "the table of partial fixity says it"),
    ("LINK PROPERTY DEFINITIONS 01", &["DefLength", "DefArea"], "springs of lines and areas"),
    (
        "LINK PROPERTY DEFINITIONS 01",
        &["StiffLOpt", "StiffDOpt", "StiffDFact"],
        "which stiffness linear cases and damping take",
    ),
    (
        "LINK PROPERTY DEFINITIONS",
        &["TransKE", "RotKE"],
        "stiffness of a nonlinear direction in linear cases, which are named; its law says the rest",
    ),
    (
        "LINK PROPERTY DEFINITIONS",
        &["TransCE", "RotCE"],
        "damping of a nonlinear direction in linear cases, which are named; its law says the rest",
    ),
    ("LINK PROPERTY DEFINITIONS", &["FLDamper", "Point"], "the law is that of its type"),
    ("LINK PROPERTY ASSIGNMENTS", &["LinkType", "LinkJoints"], "said by property and connectivity"),
    ("LINK PROPERTY ASSIGNMENTS", &["LinkFDProp"], "of cases in frequency, which are named"),
    ("JOINT CONSTRAINT ASSIGNMENTS", &["Type"], "the definition says it"),
    (
        "LOAD CASE DEFINITIONS",
        &["Des*", "AutoType", "RunCase", "IncludeSSI"],
        "design, and which cases were run",
    ),
    ("LOAD PATTERN DEFINITIONS", &["DesignType"], "design only"),
    ("CASE - STATIC 2", &["*"], "cases under displacement control are named"),
    ("CASE - STATIC 4", &["*"], "settings of its solver; this one has its own error control"),
    (
        "CASE - DIRECT HISTORY 5",
        &["*"],
        "settings of its solver; this one has its own error control",
    ),
    ("CASE - DIRECT HISTORY 1", &["MaxModFreq"], "modal damping in direct integration is named"),
    ("CASE - DIRECT HISTORY 3", &["*"], "factors follow from them"),
    ("CASE - MODAL HISTORY 4", &["*"], "factors follow from them"),
    ("CASE - MODAL 1", &["*"], "the basis is chosen by its own measured error"),
    ("COMBINATION DEFINITIONS", &["*"], "design only"),
    ("FUNCTION - TIME HISTORY - SINE", &["StepsPerCyc"], "the sine is smooth here"),
    ("FUNCTION - TIME HISTORY - COSINE", &["StepsPerCyc"], "the cosine is smooth here"),
    ("FUNCTION - TIME HISTORY - RAMP", &["MaxTime"], "the last value goes on"),
    (
        "FUNCTION - TIME HISTORY - FROM FILE",
        &["FormatType"],
        "columns are told by blanks and commas",
    ),
];

/// Values of fields that say that nothing is asked for.
const IDLE_VALUES: &[&str] =
    &["No", "None", "0", "GLOBAL", "Zero", "N.A.", "Default", "Cartesian", "All"];

fn matches(pattern: &str, name: &str) -> bool {
    match pattern.strip_suffix('*') {
        Some(front) => name.starts_with(front),
        None => name == pattern,
    }
}

fn fate(name: &str) -> Fate {
    if READ.contains(&name) {
        return Fate::Read;
    }
    let find = |all: &'static [(&str, &'static str)]| {
        all.iter().find(|(pattern, _)| matches(pattern, name)).map(|(_, what)| *what)
    };
    match (find(IGNORED), find(LOST)) {
        (Some(why), _) => Fate::Ignored(why.into()),
        (None, Some(what)) => Fate::Lost(what.into()),
        (None, None) => Fate::Lost("an unknown table".into()),
    }
}

/// Says of every table what became of it, and of every field of those that were read that nobody asked for.
pub fn settle(db: &Database, written: &[&str], report: &mut Report) {
    for (name, rows) in &db.tables {
        let fate = if rows.is_empty() { Fate::Ignored("empty".into()) } else { fate(name) };
        report.tables.push(TableReport { name: name.clone(), rows: rows.len(), fate });
    }
    fields(db, written, report);
}

/// Says of every field of the tables that were read what became of it where nobody asked for it.
pub fn fields(db: &Database, written: &[&str], report: &mut Report) {
    for (name, rows) in db.tables.iter().filter(|(name, _)| fate(name) == Fate::Read) {
        for row in rows {
            if let Some(why) = idle(name, row, written) {
                report.ignore(name, why);
                continue;
            }
            let key = |k: &str| KEYS.contains(&k);
            for field in row.fields.iter().filter(|f| !f.used.get() && !key(&f.key)) {
                left_out(report, name, &field.key, &field.value);
            }
        }
    }
}

/// Why a whole row means nothing.
fn idle(table: &str, row: &Row, written: &[&str]) -> Option<&'static str> {
    if table.starts_with("CASE - ") {
        let case = row.fields.iter().find(|f| f.key == "Case")?;
        return (!written.contains(&case.value.as_str()))
            .then_some("rows of cases that are not written");
    }
    let touched = row.fields.iter().any(|f| f.used.get() && !KEYS.contains(&f.key.as_str()));
    let defines = DEFINITIONS.iter().any(|d| table.starts_with(d));
    (defines && !touched).then_some("definitions that nothing uses")
}

fn left_out(report: &mut Report, table: &str, key: &str, value: &str) {
    if IDLE.contains(&key) {
        return;
    }
    let place = format!("{table}: {key}");
    let known = FIELDS
        .iter()
        .find(|(of, keys, _)| table.starts_with(of) && keys.iter().any(|k| matches(k, key)));
    match known {
        Some((_, _, why)) => report.ignore(&place, why),
        None if IDLE_VALUES.contains(&value) || value.parse::<f64>() == Ok(0.0) => {}
        None => report.lose(&place, "this field is not read", &format!("{key}={value}")),
    }
}
