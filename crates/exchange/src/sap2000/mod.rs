//! Text models of SAP2000 (`.s2k`, `.$2k`).

mod beams;
mod bearings;
mod cases;
mod constraints;
mod context;
mod control;
mod damping;
mod database;
mod entry;
mod fates;
mod frame_loads;
mod frames;
mod functions;
mod geometry;
mod histories;
mod joints;
mod linear_links;
mod link_laws;
mod links;
mod outputs;
mod piece;
mod placement;
mod policy;
mod section;
mod sums;
mod supports;

use crate::{Draft, Import, Options, Refused, Report};
use context::Context;
pub(crate) use database::{Database, Field, Row};
pub(crate) use fates::READ;
use section::Sections;
use std::sync::Arc;
use trilith_model::{Diagnostic, Source};

/// Share of the largest force of a pattern below which a force is rounding.
const ROUNDING: f64 = 1e-13;

/// Reads a text model of SAP2000.
///
/// # Errors
/// All errors of the file: what is no table, no number, no joint, no unit.
pub fn import(bytes: &[u8], options: &Options) -> Result<Import, Refused> {
    let (text, other) = decoded(bytes);
    let source = Arc::new(Source { path: options.path.clone(), text, sha256: String::new() });
    if let Some(at) = source.text.find('\0') {
        let error = Diagnostic::new("E1000", "a zero byte: this is no text", at..at + 1, &source);
        return Err(Refused(vec![error.help("save the file as text, in UTF-8")]));
    }
    let db = Database::new(&source);
    if !db.problems().is_empty() {
        return Err(Refused(db.problems()));
    }
    let mut cx = Context::new(&db);
    let version = units(&mut cx);
    if db.rows("JOINT COORDINATES").next().is_none() {
        db.wrong(&(0..0), "the file has no joints", "they stand in the table JOINT COORDINATES");
    }
    if !db.problems().is_empty() {
        return Err(Refused(db.problems()));
    }
    if other {
        let what = "bytes that are no UTF-8 are read as Latin-1";
        cx.report.otherwise("the file", what, "");
    }
    let files = read(&mut cx, options);
    bounded(&cx);
    let written: Vec<&str> = cx.draft.cases.iter().map(|(name, _)| name.as_str()).collect();
    policy::settle(&db, &written, &mut cx.report);
    if !db.problems().is_empty() {
        return Err(Refused(db.problems()));
    }
    let Context { draft, report, .. } = cx;
    Ok(Import::new(draft, report, files, options, &version))
}

/// What tables come to that were made of another program's text: its units, and what its report says so far.
pub(crate) fn made(
    db: &Database,
    (length, force): (&str, &str),
    report: Report,
    options: &Options,
) -> (Draft, Report, Vec<(String, String)>) {
    let mut cx = Context::new(db);
    cx.draft.units = (length.into(), force.into());
    cx.report = report;
    let files = read(&mut cx, options);
    bounded(&cx);
    let written: Vec<&str> = cx.draft.cases.iter().map(|(name, _)| name.as_str()).collect();
    policy::fields(db, &written, &mut cx.report);
    (cx.draft, cx.report, files)
}

fn bounded(cx: &Context<'_>) {
    if let Some(name) = cx.draft.beyond() {
        let message = format!("a number of \"{name}\" is beyond all bounds");
        let help = "coordinates and properties of that size are no model";
        cx.db.wrong(&(0..0), &message, help);
    }
}

/// The text, and whether it was not UTF-8.
pub(crate) fn decoded(bytes: &[u8]) -> (String, bool) {
    let bytes = bytes.strip_prefix(b"\xef\xbb\xbf").unwrap_or(bytes);
    match std::str::from_utf8(bytes) {
        Ok(text) => (text.into(), false),
        Err(_) => (bytes.iter().map(|b| char::from(*b)).collect(), true),
    }
}

/// Units of the file, and the version of the program.
fn units(cx: &mut Context<'_>) -> String {
    let Some(row) = cx.db.rows("PROGRAM CONTROL").next() else {
        let help = "PROGRAM CONTROL names them: CurrUnits=\"KN, m, C\"";
        cx.db.wrong(&(0..0), "the file does not say its units", help);
        return String::new();
    };
    let text = row.need("CurrUnits");
    let parts: Vec<&str> = text.split(',').map(str::trim).collect();
    let force = match parts.first().copied().unwrap_or_default().to_lowercase().as_str() {
        "lb" => Some("lbf"),
        "kip" => Some("kip"),
        "n" => Some("N"),
        "kn" => Some("kN"),
        "kgf" => Some("kgf"),
        "tonf" => Some("tonf"),
        _ => None,
    };
    let length = ["in", "ft", "mm", "cm", "m"];
    let length = length.into_iter().find(|l| parts.get(1) == Some(l));
    match (force, length) {
        (Some(force), Some(length)) if parts.len() == 3 => {
            cx.draft.units = (length.into(), force.into());
        }
        _ => {
            let help =
                "set one of lb, Kip, N, KN, Kgf, Tonf with in, ft, mm, cm, m, and export again";
            row.wrong_at("CurrUnits", &format!("the units `{text}` are not known here"), help);
        }
    }
    let (program, version) = (row.text("ProgramName"), row.text("Version"));
    format!("{} {}", program.unwrap_or("SAP2000"), version.unwrap_or_default()).trim().into()
}

/// Reads everything in its order; the files that go beside the model.
fn read<'a>(cx: &mut Context<'a>, options: &Options) -> Vec<(String, String)> {
    joints::joints(cx);
    joints::loads(cx);
    let sections = Sections::new(cx);
    let frames = frames::frames(cx, &sections);
    supports::restraints(cx, frames::stiffest(&frames));
    supports::springs(cx);
    frames::springs(cx, &frames);
    let mut masses = joints::Masses::new();
    let source = mass_source(cx);
    if source.masses {
        joints::added_masses(cx, &mut masses);
    }
    if source.elements && !source.vertical {
        frames::lumped(cx, &frames, &mut masses);
    }
    let mut own = joints::Masses::new();
    let links = links::links(cx, &mut own);
    frame_loads::loads(cx, &frames);
    frame_loads::ground(cx, &frames);
    supports::report_ground(cx);
    if source.elements {
        for (node, m) in own {
            let to = masses.entry(node).or_default();
            to.iter_mut().zip(m).for_each(|(a, b)| *a += b);
        }
    } else {
        frames::masses_out(cx);
    }
    loaded_masses(cx, &source.loads, &mut masses);
    if !source.vertical {
        masses.values_mut().for_each(|m| m[2] = 0.0);
    }
    joints::write_masses(cx, &masses);
    constraints::constraints(cx);
    let only = options.case.as_deref();
    let mut functions = functions::functions(cx, options.folder.as_deref(), &options.stem);
    if let Some(only) = only {
        let all: Vec<&str> =
            cx.db.rows("LOAD CASE DEFINITIONS").map(|row| row.need("Case")).collect();
        if !all.contains(&only) {
            let message = format!("there is no case \"{only}\"");
            let help = format!("the cases are {}", all.join(", "));
            cx.db.wrong(&(0..0), &message, &help);
        }
    }
    let settled = cases::cases(cx, &mut functions, only, links.nonlinear);
    damping_of_modes(cx, settled.damping);
    let named: Vec<&str> = cx.patterns.keys().copied().collect();
    for name in named.into_iter().filter(|name| !cases::is_empty(cx, name)).collect::<Vec<_>>() {
        let mut forces = cx.patterns[name].clone();
        let largest = forces.values().flatten().fold(0.0, |a: f64, b| a.max(b.abs()));
        for x in forces.values_mut().flatten().filter(|x| x.abs() < ROUNDING * largest) {
            *x = 0.0;
        }
        cx.draft.loads.push((name.into(), forces));
    }
    outputs::outputs(cx, &frames, &links);
    finish(cx, options);
    functions.files
}

/// Modes with ratios of their own are named: which frequencies they have is not known here.
fn damping_of_modes(cx: &mut Context<'_>, damping: Option<(String, damping::Damping)>) {
    let Some((case, damping)) = damping.filter(|(_, d)| !d.overrides.is_empty()) else { return };
    for (mode, ratio) in &damping.overrides {
        let what = format!("ratios of single modes of {case} are not written");
        cx.report.lose(
            "CASE - MODAL HISTORY 5 - DAMPING OVERRIDES",
            &what,
            &format!("{mode}: {ratio}"),
        );
    }
}

/// What mass is made of.
struct MassSource<'a> {
    elements: bool,
    masses: bool,
    /// It moves vertically as well.
    vertical: bool,
    loads: Vec<(&'a str, f64)>,
}

fn mass_source<'a>(cx: &mut Context<'a>) -> MassSource<'a> {
    const TABLE: &str = "MASS SOURCE";
    let rows: Vec<_> = cx.db.rows(TABLE).collect();
    let mut out = MassSource { elements: true, masses: true, vertical: true, loads: Vec::new() };
    let chosen = rows.iter().find(|r| r.yes("IsDefault")).or(rows.first());
    let Some(chosen) = chosen else { return out };
    out.elements = chosen.yes("Elements");
    out.masses = chosen.yes("Masses");
    out.vertical = chosen.text("VerticalMass").is_none_or(|v| v == "Yes");
    let (name, loads) = (chosen.text("MassSource"), chosen.yes("Loads"));
    for row in &rows {
        if row.text("MassSource") == name {
            if let (true, Some(pattern)) = (loads, row.text("LoadPat")) {
                out.loads.push((pattern, row.number("Multiplier").unwrap_or(1.0)));
            }
        } else {
            let what = "a mass source beside the default one";
            cx.report.otherwise(TABLE, what, row.text("MassSource").unwrap_or_default());
        }
    }
    out
}

/// Masses of downward loads.
fn loaded_masses(cx: &mut Context<'_>, loads: &[(&str, f64)], masses: &mut joints::Masses) {
    let gravity = trilith_model::STANDARD_GRAVITY
        / match cx.draft.units.0.as_str() {
            "in" => 0.0254,
            "ft" => 0.3048,
            "mm" => 1e-3,
            "cm" => 1e-2,
            _ => 1.0,
        };
    for (pattern, times) in loads {
        let spread = cx.spread.get(pattern).into_iter().flatten();
        for (node, f) in cx.patterns.get(pattern).into_iter().flatten().chain(spread) {
            let mass = (-f[2] * times / gravity).max(0.0);
            let to = masses.entry(*node).or_default();
            (0..3).for_each(|k| to[k] += mass);
        }
    }
}

/// Title, head, and a case where there is none.
fn finish(cx: &mut Context<'_>, options: &Options) {
    let item = |name: &str| {
        let mut rows = cx.db.rows("PROJECT INFORMATION");
        rows.find(|r| r.text("Item") == Some(name)).and_then(|r| r.text("Data"))
    };
    let name = options.path.file_stem().map(|n| n.to_string_lossy().into_owned());
    cx.draft.title = item("Model Name").map_or(name.unwrap_or_default(), str::to_owned);
    let file = options.path.file_name().map(|n| n.to_string_lossy().into_owned());
    cx.draft.head = vec![
        format!("From {} by `trilith import`.", file.unwrap_or_default()),
        format!("What was lost or is said otherwise: {}.import.txt", options.stem),
    ];
    if cx.draft.elements.iter().all(|(_, e)| e.name() == "Mass") {
        cx.report.lose("the file", "no element can be written: nothing is left that runs", "");
    }
    if cx.draft.cases.is_empty() {
        let what = "no case can be written: one without loads stands for them";
        cx.report.otherwise("LOAD CASE DEFINITIONS", what, "");
        let block = crate::ron::Ron::block("Dynamic").with("duration", 1.0).with("dt", 0.1);
        cx.draft.cases.push(("no loads".into(), block));
    }
}
