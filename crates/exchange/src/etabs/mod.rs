//! Text models of ETABS (`.e2k`, `.$et`).
//!
//! A building in storeys becomes the tables of a text model of SAP2000, whose program solves both, and those are read as
//! such. What becomes of every section, keyword and field of the file is said in its own words.

mod cases;
mod fates;
mod frames;
mod functions;
mod links;
mod loads;
mod materials;
mod plan;
mod points;
mod text;
mod words;

use crate::report::{Fate, Note, Report, TableReport, Things};
use crate::sap2000::{self, Database};
use crate::{Import, Options, Refused};
use std::cell::RefCell;
use std::sync::Arc;
use text::{Line, Section};
use trilith_model::{Diagnostic, STANDARD_GRAVITY, Source};
use words::File;

/// Sections that stand for tables, by the beginning of their names.
const SECTIONS: &[(&str, &str)] = &[
    ("ACTIVE DEGREES OF FREEDOM", "ANALYSIS OPTIONS"),
    ("CASE - ", "LOAD CASES"),
    ("LOAD CASE DEFINITIONS", "LOAD CASES"),
    ("COMBINATION DEFINITIONS", "LOAD COMBINATIONS"),
    ("CONNECTIVITY - FRAME", "LINE CONNECTIVITIES"),
    ("CONNECTIVITY - LINK", "LINK CONNECTIVITIES"),
    ("CONSTRAINT DEFINITIONS", "DIAPHRAGM NAMES"),
    ("FRAME SECTION ASSIGNMENTS", "LINE ASSIGNS"),
    ("FRAME SECTION PROPERTIES", "FRAME SECTIONS"),
    ("FRAME LOADS", "FRAME OBJECT LOADS"),
    ("FRAME ", "LINE ASSIGNS"),
    ("FUNCTION", "FUNCTIONS"),
    ("JOINT COORDINATES", "POINT COORDINATES"),
    ("JOINT LOADS", "POINT OBJECT LOADS"),
    ("JOINT ", "POINT ASSIGNS"),
    ("LINK PROPERTY DEFINITIONS", "LINK PROPERTIES"),
    ("LINK ", "LINK ASSIGNS"),
    ("LOAD PATTERN DEFINITIONS", "LOAD PATTERNS"),
    ("MATERIAL PROPERTIES", "MATERIAL PROPERTIES"),
    ("PROGRAM CONTROL", "CONTROLS"),
];

/// Reads a text model of ETABS.
///
/// # Errors
/// All errors of the file: what is no section, keyword, number, unit; points, storeys, lines, sections and cases that are
/// named twice or not there.
pub fn import(bytes: &[u8], options: &Options) -> Result<Import, Refused> {
    let (text, other) = sap2000::decoded(bytes);
    let source = Arc::new(Source { path: options.path.clone(), text, sha256: String::new() });
    if let Some(at) = source.text.find('\0') {
        let error = Diagnostic::new("E1000", "a zero byte: this is no text", at..at + 1, &source);
        return Err(Refused(vec![error.help("save the file as text, in UTF-8")]));
    }
    let bare = Database::bare(&source);
    let sections = text::sections(&source.text, &bare);
    let refused =
        |db: &Database| Err(Refused(db.problems().into_iter().map(in_its_words).collect()));
    if !bare.problems().is_empty() {
        return refused(&bare);
    }
    let mut report = Report { things: Things::Sections, ..Report::default() };
    report.tables = tables(&sections, &bare);
    if other {
        report.otherwise("the file", "bytes that are no UTF-8 are read as Latin-1", "");
    }
    let file = File {
        sections: &sections,
        db: &bare,
        report: RefCell::new(report),
        rows: RefCell::default(),
    };
    let (version, units) = translate(&file);
    let File { report, rows, .. } = file;
    if !bare.problems().is_empty() {
        return refused(&bare);
    }
    let mut report = report.into_inner();
    left_out(&sections, &mut report);
    let db = Database::made(bare, rows.into_inner());
    let (draft, mut report, files) = sap2000::made(&db, units, report, options);
    if !db.problems().is_empty() {
        return refused(&db);
    }
    for notes in [&mut report.lost, &mut report.otherwise, &mut report.ignored] {
        notes.iter_mut().for_each(placed);
    }
    Ok(Import::new(draft, report, files, options, &version))
}

/// What becomes of each section; an unknown keyword in one that is read is an error.
fn tables(sections: &[Section], db: &Database) -> Vec<TableReport> {
    let mut out: Vec<TableReport> = Vec::new();
    for section in sections {
        let (fate, keywords) = fates::fate(&section.name);
        for line in &section.lines {
            if fate == Fate::Read && !keywords.contains(&line.keyword.as_str()) {
                let span = line.span.start..line.span.start + line.keyword.len();
                let message =
                    format!("`{}` is no keyword of the section {}", line.keyword, section.name);
                db.wrong(&span, &message, &format!("it holds {}", keywords.join(", ")));
            }
        }
        let rows = section.lines.len();
        match out.iter_mut().find(|t| t.name == section.name) {
            Some(known) => known.rows += rows,
            None => out.push(TableReport { name: section.name.clone(), rows, fate }),
        }
    }
    for table in out.iter_mut().filter(|t| t.rows == 0) {
        table.fate = Fate::Ignored("empty".into());
    }
    out
}

/// Makes tables of the sections; the version of the program, and units of length and force.
fn translate(file: &File<'_>) -> (String, (&'static str, &'static str)) {
    let program = file.each("PROGRAM INFORMATION", "PROGRAM", 1).into_iter().next();
    let version = program.map_or("ETABS".into(), |p| {
        format!("{} {}", p.names[0], p.text("VERSION").unwrap_or_default()).trim().to_owned()
    });
    let (length, force) = units(file);
    let metre = match length {
        "in" => 0.0254,
        "ft" => 0.3048,
        "mm" => 1e-3,
        "cm" => 1e-2,
        _ => 1.0,
    };
    title(file);
    let plan = plan::Plan::new(file);
    materials::materials(file, STANDARD_GRAVITY / metre);
    let known = materials::sections(file, metre);
    let links = links::properties(file);
    let frames = frames::frames(file, &plan, &known);
    links::links(file, &plan, &links);
    points::points(file, &plan, &links);
    let patterns = loads::patterns(file);
    loads::points(file, &plan, &patterns);
    loads::lines(file, &frames, &patterns);
    let preset = cases::options(file);
    cases::mass(file);
    functions::functions(file);
    cases::cases(file, preset);
    cases::combinations(file);
    plan.write(file);
    if !file.rows.borrow().contains_key("JOINT COORDINATES") {
        let help = "columns, beams and braces stand in LINE CONNECTIVITIES and LINE ASSIGNS";
        file.db.wrong(&(0..0), "the file has nothing that stands between points", help);
    }
    (version, (length, force))
}

/// Units of length and force.
fn units(file: &File<'_>) -> (&'static str, &'static str) {
    let Some(thing) = file.each("CONTROLS", "UNITS", 2).into_iter().next() else {
        let help = "CONTROLS names them: UNITS  \"KN\"  \"M\"  \"C\"";
        file.db.wrong(&(0..0), "the file does not say its units", help);
        return ("m", "N");
    };
    thing.at(2);
    let force = match thing.names[0].to_uppercase().as_str() {
        "LB" => Some("lbf"),
        "KIP" => Some("kip"),
        "N" => Some("N"),
        "KN" => Some("kN"),
        "KGF" => Some("kgf"),
        "TONF" => Some("tonf"),
        _ => None,
    };
    let length = ["in", "ft", "mm", "cm", "m"];
    let length = length.into_iter().find(|l| l.eq_ignore_ascii_case(thing.names[1]));
    if let (Some(force), Some(length)) = (force, length) {
        return (length, force);
    }
    let message = format!("the units `{} {}` are not known here", thing.names[0], thing.names[1]);
    let help = "set one of LB, KIP, N, KN, KGF, TONF with IN, FT, MM, CM, M, and export again";
    thing.wrong(&message, help);
    ("m", "N")
}

fn title(file: &File<'_>) {
    let info = file.each("PROJECT INFORMATION", "PROJECTINFO", 0).into_iter();
    let name = info.filter_map(|t| t.text("MODELNAME")).find(|n| !n.is_empty());
    let titles = ["TITLE2", "TITLE1"].map(|key| file.each("CONTROLS", key, 1));
    let title = titles.iter().flatten().map(|t| t.names[0]).find(|n| !n.is_empty());
    if let Some(name) = name.or(title) {
        let row = file.row("PROJECT INFORMATION", &(0..0)).with("Item", "Model Name");
        row.with("Data", name).put();
    }
}

/// Values that say that nothing is asked for.
const IDLE: [&str; 5] = ["NO", "NONE", "DEFAULT", "GLOBAL", "PROGRAM DETERMINED"];

/// Says of every word that nobody asked for what became of it.
fn left_out(sections: &[Section], report: &mut Report) {
    for section in sections.iter().filter(|s| fates::fate(&s.name).0 == Fate::Read) {
        for line in &section.lines {
            match fates::IDLE.iter().find(|(keyword, _)| *keyword == line.keyword) {
                Some((keyword, why)) => {
                    report.ignore(&format!("{}: {keyword}", section.name), why);
                }
                None => words_left(&section.name, line, report),
            }
        }
    }
}

fn words_left(section: &str, line: &Line, report: &mut Report) {
    let mut tokens = line.tokens.iter().peekable();
    while let Some(token) = tokens.next() {
        if token.used.get() {
            continue;
        }
        if !token.is_word() {
            report.lose(
                section,
                "a value that is not read",
                &format!("{} {}", line.keyword, token.text),
            );
            continue;
        }
        let value = tokens.next_if(|t| !t.used.get()).map_or("", |t| t.text.as_str());
        let place = format!("{section}: {}", token.text);
        let known = fates::FIELDS.iter().find(|(keyword, keys, _)| {
            *keyword == line.keyword && keys.iter().any(|k| fates::matches(k, &token.text))
        });
        let zero = text::number(value) == Some(0.0);
        match known {
            Some((.., why)) => report.ignore(&place, why),
            None if zero || IDLE.iter().any(|v| v.eq_ignore_ascii_case(value)) => {}
            None => {
                let which = format!("{} {value}", token.text);
                report.lose(&place, "this field is not read", which.trim_end());
            }
        }
    }
}

/// A note in the words of ETABS.
fn placed(note: &mut Note) {
    let (table, key) = match note.place.split_once(": ") {
        Some((table, key)) => (table.to_owned(), Some(key.to_owned())),
        None => (note.place.clone(), None),
    };
    let found = SECTIONS.iter().find(|(front, _)| table.starts_with(front));
    // What was said of a section itself has its place already.
    if let Some((_, section)) = found.filter(|_| fates::fate(&table).0 != Fate::Read) {
        let key = key.map(|k| {
            let plain = k.strip_prefix("Trans").or(k.strip_prefix("Rot")).unwrap_or(&k);
            format!(": {}", plain.to_uppercase())
        });
        note.place = format!("{section}{}", key.unwrap_or_default());
    }
    note.what = note.what.replace("SAP2000", "ETABS");
}

/// An error in the words of ETABS.
fn in_its_words(mut error: Diagnostic) -> Diagnostic {
    error.message = said(&error.message);
    error.help = error.help.as_deref().map(said);
    error
}

/// A text with sections in place of tables.
fn said(text: &str) -> String {
    let tables = SECTIONS.iter().filter(|(table, _)| table.len() > 12);
    tables
        .fold(text.replace("SAP2000", "ETABS"), |all, (table, section)| all.replace(table, section))
}
