//! What is assigned to points: supports, springs, masses, diaphragms.

use super::links::{place, unknown};
use super::plan::Plan;
use super::words::{File, Thing};
use std::collections::{BTreeMap, HashMap, HashSet};

const ASSIGNS: &str = "POINT ASSIGNS";
const AREAS: &str = "AREA ASSIGNS";
const DOFS: [&str; 6] = ["UX", "UY", "UZ", "RX", "RY", "RZ"];
const LOCAL: [&str; 6] = ["U1", "U2", "U3", "R1", "R2", "R3"];

/// Joints by the diaphragm and the storey that they belong to.
type Diaphragms<'a> = BTreeMap<(&'a str, usize), Vec<(usize, usize)>>;

/// Reads what is assigned to points, and the diaphragms of floors.
pub fn points<'a>(file: &File<'a>, plan: &Plan<'a>, links: &(HashSet<&'a str>, HashSet<&'a str>)) {
    let springs: HashMap<&str, Thing<'a>> = (file.things("POINT SPRING", "POINTSPRING", 1))
        .into_iter()
        .map(|thing| (thing.names[0], thing))
        .collect();
    let declared: HashSet<&str> = (file.each("DIAPHRAGM NAMES", "DIAPHRAGM", 1))
        .into_iter()
        .map(|thing| thing.names[0])
        .collect();
    let mut diaphragms = Diaphragms::new();
    // Points that say where they belong, in any way.
    let mut told = HashSet::new();
    let mut alone = Vec::new();
    for thing in file.things(ASSIGNS, "POINTASSIGN", 2) {
        let (point, story) =
            (plan.point(&thing, thing.names[0]), plan.story(&thing, thing.names[1]));
        let (Some(point), Some(story)) = (point, story) else { continue };
        let at = (point, story);
        let keys = ["RESTRAINT", "SPRINGPROP", "MASSUXUY", "MASSUZ", "MASSRX", "MASSRY", "MASSRZ"];
        let carries = keys.iter().any(|key| thing.token(key).is_some());
        // Else it is the corner of a floor.
        let exists = carries || plan.is_made(at);
        match thing.text("DIAPH") {
            None | Some("FROMSHELLOBJECT") => {}
            Some("DISCONNECTED") => _ = told.insert(at),
            Some(name) => {
                told.insert(at);
                if exists {
                    diaphragms.entry((name, story)).or_default().push(at);
                }
                if !declared.contains(name) {
                    let message = format!("there is no diaphragm \"{name}\"");
                    thing.wrong_at("DIAPH", &message, "they stand in DIAPHRAGM NAMES");
                }
            }
        }
        thing.says("USERJOINT");
        thing.says("INCLUDEINANALYSISMESH");
        if !exists {
            continue;
        }
        if !plan.is_made(at) {
            alone.push(at);
        }
        let name = plan.make(at);
        restrained(file, &thing, &name);
        massive(file, &thing, &name);
        if let Some(spring) = thing.text("SPRINGPROP") {
            match springs.get(spring) {
                Some(property) => sprung(file, &thing, property, &name, links),
                None => {
                    let message = format!("there is no point spring \"{spring}\"");
                    let help = "they stand in POINT SPRING PROPERTIES";
                    thing.wrong_at("SPRINGPROP", &message, help);
                }
            }
        }
    }
    areas(file, plan, &declared, &told, &mut diaphragms);
    write(file, plan, &diaphragms, &alone);
}

fn restrained(file: &File<'_>, thing: &Thing<'_>, name: &str) {
    let Some(said) = thing.text("RESTRAINT") else { return };
    let mut row = file.row("JOINT RESTRAINT ASSIGNMENTS", thing.span()).with("Joint", name);
    for word in said.split_whitespace() {
        let Some(at) = DOFS.iter().position(|d| d.eq_ignore_ascii_case(word)) else {
            let message = format!("`{word}` is no direction of a support");
            thing.wrong_at("RESTRAINT", &message, &DOFS.join(" "));
            return;
        };
        row = row.with(LOCAL[at], true);
    }
    row.put();
}

fn massive(file: &File<'_>, thing: &Thing<'_>, name: &str) {
    let flat = thing.number("MASSUXUY");
    let keys = ["MASSUZ", "MASSRX", "MASSRY", "MASSRZ"].map(|key| thing.number(key));
    if flat.is_none() && keys == [None; 4] {
        return;
    }
    let row = file.row("JOINT ADDED MASS ASSIGNMENTS", thing.span()).with("Joint", name);
    let row = row.maybe("Mass1", flat).maybe("Mass2", flat).maybe("Mass3", keys[0]);
    row.maybe("MMI1", keys[1]).maybe("MMI2", keys[2]).maybe("MMI3", keys[3]).put();
}

/// A spring on the ground, and links on the ground that it names.
fn sprung<'a>(
    file: &File<'a>,
    thing: &Thing<'a>,
    spring: &Thing<'a>,
    name: &str,
    links: &(HashSet<&'a str>, HashSet<&'a str>),
) {
    let stiff = DOFS.map(|key| spring.number(key));
    if stiff.iter().any(|k| k.is_some_and(|k| k != 0.0)) {
        let mut row = file.row("JOINT SPRING ASSIGNMENTS 1 - UNCOUPLED", spring.span());
        row = row.with("Joint", name);
        for (key, k) in LOCAL.iter().zip(stiff) {
            row = row.maybe(key, k);
        }
        row.put();
    }
    // Each line with a link of its own.
    for line in &spring.lines {
        let one = spring.line(line);
        let Some(property) = one.text("LINKPROP") else { continue };
        let upward = one.text("AXIALDIR").is_none_or(|d| matches!(d, "Z" | "+Z"));
        if !upward {
            let what = "a link of a spring whose local 1 does not point up";
            file.lose("POINT SPRING PROPERTIES: AXIALDIR", what, name);
        } else if links.0.contains(property) {
            let told = format!("{} {name}", spring.names[0]);
            place(
                file,
                thing,
                &told,
                property,
                [Some(&name.to_owned()), None],
                one.number("ANGLE"),
            );
        } else {
            unknown(file, &one, property, &links.1, name);
        }
    }
    let law = spring.text("NONLINEAROPTION").filter(|o| !o.eq_ignore_ascii_case("none"));
    if law.is_some() {
        let what = "a spring that is not linear: its stiffness is taken both ways";
        file.lose("POINT SPRING PROPERTIES: NONLINEAROPTION", what, spring.names[0]);
    }
}

/// Floors: what they are besides a diaphragm is lost.
fn areas<'a>(
    file: &File<'a>,
    plan: &Plan<'a>,
    declared: &HashSet<&str>,
    told: &HashSet<(usize, usize)>,
    diaphragms: &mut Diaphragms<'a>,
) {
    let shapes: HashMap<&str, Thing<'a>> = (file.each("AREA CONNECTIVITIES", "AREA", 1))
        .into_iter()
        .map(|thing| (thing.names[0], thing))
        .collect();
    shapes.values().for_each(Thing::idle);
    for thing in file.things(AREAS, "AREAASSIGN", 2) {
        let name = format!("{}@{}", thing.names[0], thing.names[1]);
        let Some(shape) = shapes.get(thing.names[0]) else {
            let message = format!("there is no area \"{}\"", thing.names[0]);
            thing.wrong(&message, "areas stand in the section AREA CONNECTIVITIES");
            continue;
        };
        let Some(story) = plan.story(&thing, thing.names[1]) else { continue };
        let section = thing.text("SECTION").filter(|s| !s.eq_ignore_ascii_case("none"));
        let opening = thing.says("OPENING") == Some(true);
        let diaphragm = thing.text("DIAPH").filter(|d| *d != "DISCONNECTED");
        thing.idle();
        if let (Some(section), false) = (section, opening) {
            let kind = shape.at(1).map_or("", |t| t.text.as_str());
            let what = match kind {
                "PANEL" => format!(
                    "walls of {section}: walls are not read, a superelement may stand for them"
                ),
                _ => format!("floors of {section}: their stiffness, mass and loads are not read"),
            };
            file.lose(AREAS, &what, &name);
        }
        let Some(diaphragm) = diaphragm.filter(|_| !opening) else { continue };
        if !declared.contains(diaphragm) {
            let message = format!("there is no diaphragm \"{diaphragm}\"");
            thing.wrong_at("DIAPH", &message, "they stand in DIAPHRAGM NAMES");
            continue;
        }
        let corners: Vec<[f64; 3]> = (shape.lines[0].tokens.iter().skip(1))
            .filter(|t| t.quoted)
            .filter_map(|t| plan.point(shape, &t.text))
            .map(|point| plan.at((point, story)))
            .collect();
        let all = diaphragms.entry((diaphragm, story)).or_default();
        for at in plan.of_story(story) {
            let inside = holds(&corners, plan.at(at));
            if inside && !told.contains(&at) && !all.contains(&at) {
                all.push(at);
            }
        }
    }
}

/// True where a point lies in a polygon or on its edge, in plan.
fn holds(corners: &[[f64; 3]], [x, y, _]: [f64; 3]) -> bool {
    let size = corners.iter().flatten().fold(0.0, |a: f64, b| a.max(b.abs()));
    let mut inside = false;
    for (i, a) in corners.iter().enumerate() {
        let b = corners[(i + 1) % corners.len()];
        let (dx, dy) = (b[0] - a[0], b[1] - a[1]);
        let length = dx.hypot(dy);
        let (along, across) =
            ((x - a[0]) * dx + (y - a[1]) * dy, (x - a[0]) * dy - (y - a[1]) * dx);
        let near = 1e-6 * size;
        let on = across.abs() <= near * length
            && along >= -near * length
            && along <= (length + near) * length;
        if on {
            return true;
        }
        let crosses = (a[1] > y) != (b[1] > y);
        inside ^= crosses && x < a[0] + (y - a[1]) / dy * dx;
    }
    inside
}

fn write(file: &File<'_>, plan: &Plan<'_>, diaphragms: &Diaphragms<'_>, alone: &[(usize, usize)]) {
    let kinds: HashMap<&str, bool> = (file.things("DIAPHRAGM NAMES", "DIAPHRAGM", 1))
        .iter()
        .map(|d| (d.names[0], d.text("TYPE").is_none_or(|t| t.eq_ignore_ascii_case("rigid"))))
        .collect();
    let mut held = HashSet::new();
    for ((name, story), joints) in diaphragms {
        let told = format!("{name} {}", plan.story_name(*story));
        if joints.len() < 2 {
            continue;
        }
        if kinds.get(name) != Some(&true) {
            let what = "a diaphragm that is not rigid is the slab that it is made of";
            file.lose("DIAPHRAGM NAMES: TYPE", what, &told);
            continue;
        }
        held.extend(joints.iter().copied());
        let row = file.row("CONSTRAINT DEFINITIONS - DIAPHRAGM", &(0..0)).with("Name", &told);
        row.with("Axis", "Z").put();
        for at in joints {
            let row = file.row("JOINT CONSTRAINT ASSIGNMENTS", &(0..0));
            row.with("Joint", &plan.name(*at)).with("Constraint", &told).put();
        }
    }
    for at in alone.iter().filter(|at| held.contains(at)) {
        let name = plan.name(*at);
        let what = "a joint that only its diaphragm carries is held in the other directions";
        file.otherwise(ASSIGNS, what, &name);
        let row = file.row("JOINT RESTRAINT ASSIGNMENTS", &(0..0)).with("Joint", &name);
        row.with("U3", true).with("R1", true).with("R2", true).put();
    }
}
