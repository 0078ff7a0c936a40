//! Load patterns, and loads of points and lines.

use super::plan::Plan;
use super::words::{File, Thing};
use std::collections::HashSet;

/// Reads patterns; their names.
pub fn patterns<'a>(file: &File<'a>) -> HashSet<&'a str> {
    let mut out = HashSet::new();
    for (section, keyword) in [
        ("LOAD PATTERNS", "LOADPATTERN"),
        ("STATIC LOADS", "LOADPATTERN"),
        ("STATIC LOADS", "LOADCASE"),
    ] {
        for thing in file.things(section, keyword, 1) {
            let name = thing.names[0];
            if !out.insert(name) {
                continue;
            }
            thing.text("TYPE");
            file.row("LOAD PATTERN DEFINITIONS", thing.span())
                .with("LoadPat", name)
                .with("SelfWtMult", thing.or_zero("SELFWEIGHT"))
                .put();
            if keyword == "LOADCASE" {
                // In older files a pattern is a linear case as well.
                let case = |table| file.row(table, thing.span()).with("Case", name);
                case("LOAD CASE DEFINITIONS").with("Type", "LinStatic").put();
                let row = case("CASE - STATIC 1 - LOAD ASSIGNMENTS");
                row.with("LoadType", "Load pattern")
                    .with("LoadName", name)
                    .with("LoadSF", 1.0)
                    .put();
            }
        }
    }
    for keyword in ["SEISMIC", "WIND", "NOTIONALLOAD", "LIVE"] {
        for thing in file.each("LOAD PATTERNS", keyword, 1) {
            thing.idle();
            let what = "loads that the pattern makes by a code";
            file.lose(&format!("LOAD PATTERNS: {keyword}"), what, thing.names[0]);
        }
    }
    out
}

/// The pattern of a load.
fn pattern<'a>(thing: &Thing<'a>, patterns: &HashSet<&str>) -> Option<&'a str> {
    let name = thing.need("LC");
    if name.is_empty() {
        return None;
    }
    let known = patterns.contains(name);
    if !known {
        let message = format!("there is no load pattern \"{name}\"");
        thing.wrong_at("LC", &message, "they stand in the section LOAD PATTERNS");
    }
    known.then_some(name)
}

/// Reads loads of points.
pub fn points<'a>(file: &File<'a>, plan: &Plan<'a>, patterns: &HashSet<&str>) {
    let things = ["POINT OBJECT LOADS", "POINT LOADS"].map(|s| file.each(s, "POINTLOAD", 2));
    for thing in things.into_iter().flatten() {
        let (point, story) =
            (plan.point(&thing, thing.names[0]), plan.story(&thing, thing.names[1]));
        let (Some(point), Some(story)) = (point, story) else { continue };
        let at = (point, story);
        let name = plan.name(at);
        let Some(pattern) = pattern(&thing, patterns) else { continue };
        if !plan.is_made(at) {
            thing.idle();
            file.lose("POINT OBJECT LOADS", "a load where nothing stands", &name);
            continue;
        }
        let (table, keys): (&'static str, [(&str, &str); 6]) = match thing.text("TYPE") {
            Some("GROUNDDISP") => (
                "JOINT LOADS - GROUND DISPLACEMENT",
                [
                    ("U1", "UX"),
                    ("U2", "UY"),
                    ("U3", "UZ"),
                    ("R1", "RX"),
                    ("R2", "RY"),
                    ("R3", "RZ"),
                ],
            ),
            None | Some("FORCE") => (
                "JOINT LOADS - FORCE",
                [
                    ("F1", "FX"),
                    ("F2", "FY"),
                    ("F3", "FZ"),
                    ("M1", "MX"),
                    ("M2", "MY"),
                    ("M3", "MZ"),
                ],
            ),
            Some(kind) => {
                thing.idle();
                file.lose("POINT OBJECT LOADS: TYPE", &format!("loads of type {kind}"), &name);
                continue;
            }
        };
        let row = file.row(table, thing.span()).with("Joint", &name).with("LoadPat", pattern);
        row.from(&thing, &keys).put();
    }
}

/// Reads loads of lines.
pub fn lines<'a>(file: &File<'a>, frames: &HashSet<[&'a str; 2]>, patterns: &HashSet<&str>) {
    let sections = ["FRAME OBJECT LOADS", "LINE OBJECT LOADS", "LINE LOADS"];
    for thing in sections.into_iter().flat_map(|s| file.each(s, "LINELOAD", 2)) {
        let name = format!("{}@{}", thing.names[0], thing.names[1]);
        let Some(pattern) = pattern(&thing, patterns) else { continue };
        if !frames.contains(&[thing.names[0], thing.names[1]]) {
            thing.idle();
            file.lose("FRAME OBJECT LOADS", "a load of a line that is not written", &name);
            continue;
        }
        let kind = thing.text("TYPE").unwrap_or_default();
        let row =
            |table| file.row(table, thing.span()).with("Frame", &name).with("LoadPat", pattern);
        let moment = kind.ends_with('M');
        let sort = if moment { "Moment" } else { "Force" };
        match kind {
            "POINTF" | "POINTM" => {
                let Some((system, dir)) = direction(&thing) else { continue };
                row("FRAME LOADS - POINT")
                    .with("CoordSys", system)
                    .with("Type", sort)
                    .with("Dir", dir)
                    .with("RelDist", thing.need_number("RDIST"))
                    .with(sort, thing.need_number(if moment { "MVAL" } else { "FVAL" }))
                    .put();
            }
            "UNIFF" | "UNIFM" | "TRAPF" | "TRAPM" => {
                let Some((system, dir)) = direction(&thing) else { continue };
                let [a, b] = if kind.starts_with("UNI") {
                    [thing.need_number(if moment { "MVAL" } else { "FVAL" }); 2]
                } else {
                    let keys = if moment { ["MSTART", "MEND"] } else { ["FSTART", "FEND"] };
                    keys.map(|key| thing.need_number(key))
                };
                let keys = if moment { ["MOverLA", "MOverLB"] } else { ["FOverLA", "FOverLB"] };
                row("FRAME LOADS - DISTRIBUTED")
                    .with("CoordSys", system)
                    .with("Type", sort)
                    .with("Dir", dir)
                    .with("RelDistA", thing.or_zero("RDSTART"))
                    .with("RelDistB", thing.number("RDEND").unwrap_or(1.0))
                    .with(keys[0], a)
                    .with(keys[1], b)
                    .put();
            }
            "TEMP" | "TEMPGRAD2" | "TEMPGRAD3" => {
                let [sort, key] = match kind {
                    "TEMP" => ["Temperature", "Temp"],
                    "TEMPGRAD2" => ["Gradient2", "TempGrad2"],
                    _ => ["Gradient3", "TempGrad3"],
                };
                let value = ["T", "TEMP", "FVAL"].iter().find_map(|key| thing.number(key));
                let value = value.unwrap_or_else(|| thing.need_number("T"));
                row("FRAME LOADS - TEMPERATURE").with("Type", sort).with(key, value).put();
            }
            _ => {
                thing.idle();
                file.lose("FRAME OBJECT LOADS: TYPE", &format!("loads of type {kind}"), &name);
            }
        }
    }
}

/// Coordinate system and direction of a load.
fn direction(thing: &Thing<'_>) -> Option<(&'static str, &'static str)> {
    let said = thing.need("DIR");
    let found = match said.to_uppercase().as_str() {
        "GRAV" | "GRAVITY" => ("GLOBAL", "Gravity"),
        "X" => ("GLOBAL", "X"),
        "Y" => ("GLOBAL", "Y"),
        "Z" => ("GLOBAL", "Z"),
        "GRAVPROJ" => ("GLOBAL", "Gravity Proj"),
        "XPROJ" => ("GLOBAL", "X Proj"),
        "YPROJ" => ("GLOBAL", "Y Proj"),
        "1" => ("Local", "1"),
        "2" => ("Local", "2"),
        "3" => ("Local", "3"),
        "" => return None,
        _ => {
            let message = format!("`{said}` is no direction of a load");
            thing.wrong_at("DIR", &message, "GRAV, X, Y, Z, 1, 2, 3, GRAVPROJ, XPROJ or YPROJ");
            return None;
        }
    };
    Some(found)
}
