//! Columns, beams and braces.

use super::materials::Known;
use super::plan::Plan;
use super::words::{File, Thing};
use std::collections::{HashMap, HashSet};

const ASSIGNS: &str = "LINE ASSIGNS";

/// A line in plan: its points and the storeys between them.
pub struct Course {
    points: [usize; 2],
    below: usize,
}

/// The lines of a section by name: kind, the point below, the point above, storeys between.
pub fn courses<'a>(
    file: &File<'a>,
    plan: &Plan<'a>,
    section: &str,
    keyword: &str,
) -> HashMap<&'a str, Course> {
    let mut out = HashMap::new();
    for thing in file.each(section, keyword, 1) {
        let mut behind = 1;
        if thing.at(1).is_some_and(|t| t.is_word()) {
            behind = 2;
        }
        let first = thing.at(behind).filter(|t| t.quoted);
        let second = thing.at(behind + 1).filter(|t| t.quoted);
        let Some(first) = first else {
            let help = format!("{keyword} \"C1\"  COLUMN  \"1\"  \"1\"  1");
            thing.wrong("a line without its points", &help);
            continue;
        };
        let i = plan.point(&thing, &first.text);
        let j = second.map_or(i, |t| plan.point(&thing, &t.text));
        let at = behind + 1 + usize::from(second.is_some());
        let count = thing.at(at).filter(|t| !t.is_word()).and_then(|_| thing.number_at(at));
        let below = count.unwrap_or(0.0);
        if !(below >= 0.0 && below.fract() == 0.0 && below < 1e6) {
            thing.wrong("storeys between the points of a line are a whole number", "0, 1, 2 …");
            continue;
        }
        let (Some(i), Some(j)) = (i, j) else { continue };
        let name = thing.names[0];
        if out.insert(name, Course { points: [i, j], below: below as usize }).is_some() {
            let help = "every line has a name of its own";
            thing.wrong(&format!("there are two lines \"{name}\""), help);
        }
    }
    out
}

impl Course {
    /// The joints of a line in a storey: the point below, and the one in the storey.
    pub fn joints(&self, thing: &Thing<'_>, plan: &Plan<'_>, story: usize) -> Option<[String; 2]> {
        let below = plan.below(thing, story, self.below)?;
        Some([plan.make((self.points[0], below)), plan.make((self.points[1], story))])
    }

    /// True where a line has one point in one storey.
    pub fn is_point(&self) -> bool {
        self.points[0] == self.points[1] && self.below == 0
    }
}

/// Factors of a line: ours and theirs.
const FACTORS: [(&str, &str); 8] = [
    ("AMod", "PROPMODA"),
    ("AS2Mod", "PROPMODA2"),
    ("AS3Mod", "PROPMODA3"),
    ("JMod", "PROPMODT"),
    ("I22Mod", "PROPMODI22"),
    ("I33Mod", "PROPMODI33"),
    ("MassMod", "PROPMODM"),
    ("WeightMod", "PROPMODW"),
];

/// Reads lines and what is assigned to them; the names of those that are written.
pub fn frames<'a>(file: &File<'a>, plan: &Plan<'a>, known: &Known<'a>) -> HashSet<[&'a str; 2]> {
    let courses = courses(file, plan, "LINE CONNECTIVITIES", "LINE");
    let mut out = HashSet::new();
    for thing in file.things(ASSIGNS, "LINEASSIGN", 2) {
        let [line, story] = [thing.names[0], thing.names[1]];
        let name = format!("{line}@{story}");
        let Some(course) = courses.get(line) else {
            let message = format!("there is no line \"{line}\"");
            thing.wrong(&message, "lines stand in the section LINE CONNECTIVITIES");
            continue;
        };
        let Some(at) = plan.story(&thing, story) else { continue };
        let section = thing.text("SECTION").filter(|s| !s.eq_ignore_ascii_case("none"));
        let Some(section) = section else {
            thing.idle();
            file.lose(ASSIGNS, "a line without a section is not written", &name);
            continue;
        };
        if !known.written.contains(section) {
            if known.lost.contains(section) {
                thing.idle();
                file.lose(ASSIGNS, "a line with a section that is lost is not written", &name);
            } else {
                let message = format!("there is no section \"{section}\"");
                thing.wrong_at("SECTION", &message, "they stand in FRAME SECTIONS");
            }
            continue;
        }
        let Some([i, j]) = course.joints(&thing, plan, at) else { continue };
        out.insert([line, story]);
        let span = thing.span();
        let frame = |table| file.row(table, span).with("Frame", &name);
        frame("CONNECTIVITY - FRAME").with("JointI", &i).with("JointJ", &j).put();
        let material = thing.text("MATERIALOVERWRITE").filter(|m| !m.is_empty());
        frame("FRAME SECTION ASSIGNMENTS")
            .with("AnalSect", section)
            .maybe("MatProp", material)
            .put();
        if let Some(angle) = thing.number("ANG") {
            frame("FRAME LOCAL AXES ASSIGNMENTS 1 - TYPICAL").with("Angle", angle).put();
        }
        if FACTORS.iter().any(|(_, key)| thing.number(key).is_some_and(|x| x != 1.0)) {
            frame("FRAME PROPERTY MODIFIERS").from(&thing, &FACTORS).put();
        }
        meshed(file, &thing, &name);
        ends(file, &thing, &name);
        released(file, &thing, &name);
        inserted(file, &thing, &name);
        for key in ["LIMITTENSION", "LIMITCOMPRESSION"] {
            if thing.token(key).is_some() {
                let what = "frames carry both; Gap and Hook carry one";
                file.lose(&format!("{ASSIGNS}: {key}"), what, &name);
            }
        }
    }
    out
}

/// Frames are cut at the joints on them unless their line says otherwise.
fn meshed(file: &File<'_>, thing: &Thing<'_>, name: &str) {
    let count = thing.number("MESHMINSEGMENTS").or_else(|| thing.number("MINMESHSEGMENTS"));
    let longest =
        thing.number("MESHMAXSEGMENTLENGTH").or_else(|| thing.number("MAXMESHSEGMENTLENGTH"));
    let whole = thing.says("AUTOMESH") == Some(false);
    let joints = thing.says("MESHATJOINTS").unwrap_or(true);
    thing.says("MESHATINTERSECTIONS");
    file.row("FRAME AUTO MESH ASSIGNMENTS", thing.span())
        .with("Frame", name)
        .with("AutoMesh", !whole)
        .with("AtJoints", joints)
        .maybe("NumSegments", count)
        .maybe("MaxLength", longest)
        .put();
}

/// Lengths at the ends, and the share of them that is rigid.
fn ends(file: &File<'_>, thing: &Thing<'_>, name: &str) {
    let factor = thing.or_zero("RIGIDZONE");
    let lengths = ["LENGTHOFFI", "LENGTHOFFJ"].map(|key| thing.number(key));
    if factor == 0.0 {
        // Faces that forces are shown at: the stiffness knows nothing of them.
        return;
    }
    if lengths == [None; 2] {
        let what = "rigid ends whose lengths the program finds from the frames that meet: without";
        file.lose("LINE ASSIGNS: RIGIDZONE", what, name);
        return;
    }
    let [i, j] = lengths.map(|l| l.unwrap_or(0.0));
    file.row("FRAME OFFSET ALONG LENGTH ASSIGNMENTS", thing.span())
        .with("Frame", name)
        .with("LengthI", i)
        .with("LengthJ", j)
        .with("RigidFactor", factor)
        .put();
}

/// Released directions.
const RELEASES: [&str; 12] =
    ["PI", "V2I", "V3I", "TI", "M2I", "M3I", "PJ", "V2J", "V3J", "TJ", "M2J", "M3J"];

fn released(file: &File<'_>, thing: &Thing<'_>, name: &str) {
    let Some(said) = thing.text("RELEASE") else { return };
    let mut row = file.row("FRAME RELEASE ASSIGNMENTS 1 - GENERAL", thing.span());
    row = row.with("Frame", name);
    for word in said.split_whitespace() {
        let gone: &[&str] = match RELEASES.iter().position(|r| *r == word) {
            Some(at) => &RELEASES[at..=at],
            None if word == "PINNED" => {
                let what = "PINNED releases M2 and M3 at both ends";
                file.otherwise("LINE ASSIGNS: RELEASE", what, name);
                &["M2I", "M3I", "M2J", "M3J"]
            }
            None => {
                let message = format!("`{word}` is no direction of a release");
                thing.wrong_at("RELEASE", &message, &format!("PINNED, or {}", RELEASES.join(" ")));
                return;
            }
        };
        for key in gone {
            row = row.with(key, true);
        }
    }
    row.put();
}

/// Where the section sits on its line.
fn inserted(file: &File<'_>, thing: &Thing<'_>, name: &str) {
    let Some(point) = thing.number("CARDINALPT") else { return };
    let moves = thing.says("TRANSFORMSTIFF") == Some(true);
    file.row("FRAME INSERTION POINT ASSIGNMENTS", thing.span())
        .with("Frame", name)
        .with("CardinalPt", point)
        .with("Transform", moves)
        .put();
}
