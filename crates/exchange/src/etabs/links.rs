//! Links: their properties, and where they stand.

use super::frames::courses;
use super::plan::Plan;
use super::words::{File, Thing};
use crate::sap2000::READ;
use std::collections::HashSet;

const PROPERTIES: &str = "LINK PROPERTIES";

/// Kinds as tables know them: the table of their directions and their type, by the names of ETABS without blanks and signs.
const KINDS: [(&str, &str, &str); 17] = [
    ("LINEAR", "02 - LINEAR", "Linear"),
    ("MULTILINEARELASTIC", "03 - MULTILINEAR", "MultiLinear Elastic"),
    ("DAMPER", "04 - DAMPER", "Damper - Exponential"),
    ("DAMPEREXPONENTIAL", "04 - DAMPER", "Damper - Exponential"),
    ("DAMPERBILINEAR", "14 - BILINEAR DAMPER", "Damper - Bilinear"),
    ("DAMPERFRICTIONSPRING", "15 - FRICTION SPRING DAMPER", "Damper - Friction Spring"),
    ("GAP", "05 - GAP", "Gap"),
    ("HOOK", "06 - HOOK", "Hook"),
    ("RUBBERISOLATOR", "07 - RUBBER ISOLATOR", "Rubber Isolator"),
    ("ISOLATOR1", "07 - RUBBER ISOLATOR", "Rubber Isolator"),
    ("FRICTIONISOLATOR", "08 - SLIDING ISOLATOR", "Friction Isolator"),
    ("ISOLATOR2", "08 - SLIDING ISOLATOR", "Friction Isolator"),
    ("TCFRICTIONISOLATOR", "09 - TC SLIDING ISOLATOR", "T/C Friction Isolator"),
    ("PLASTICWEN", "10 - PLASTIC (WEN)", "Plastic (Wen)"),
    ("PLASTIC1", "10 - PLASTIC (WEN)", "Plastic (Wen)"),
    ("MULTILINEARPLASTIC", "11 - MULTILINEAR PLASTIC", "MultiLinear Plastic"),
    ("TRIPLEPENDULUMISOLATOR", "12 - TRIPLE PENDULUM ISOLATOR", "Triple Pendulum Isolator"),
];

/// What a property as a whole has: ours and theirs.
const WHOLE: [(&str, &str); 9] = [
    ("Mass", "MASS"),
    ("Weight", "WEIGHT"),
    ("RotInert1", "RMASS1"),
    ("RotInert2", "RMASS2"),
    ("RotInert3", "RMASS3"),
    ("PDM2I", "PDM2I"),
    ("PDM2J", "PDM2J"),
    ("PDM3I", "PDM3I"),
    ("PDM3J", "PDM3J"),
];

/// What directions have whose name here begins with `Trans` or `Rot`: the rest of ours and theirs.
const TURNING: [(&str, &str); 12] = [
    ("KE", "KE"),
    ("CE", "CE"),
    ("K", "K"),
    ("C", "C"),
    ("Open", "OPEN"),
    ("Yield", "YIELD"),
    ("K1", "LOADINGSLIPPINGSTIFFNESS"),
    ("K2", "UNLOADINGSLIPPINGSTIFFNESS"),
    ("U0", "PRECOMPRESSIONDISPLACEMENT"),
    ("Us", "STOPDISPLACEMENT"),
    ("Cy", "YIELDEDDAMPINGCOEFF"),
    ("KTens", "KTENSION"),
];

/// What directions have besides: ours and theirs.
const PLAIN: [(&str, &str); 50] = [
    ("DJ", "DJ"),
    ("Ratio", "KRATIO"),
    ("ForceLimit", "FORCELIMIT"),
    ("Slow", "CSLOW"),
    ("Fast", "CFAST"),
    ("Rate", "RATE"),
    ("Radius", "RADIUS"),
    ("GapComp", "OPENCOMP"),
    ("GapTens", "OPENTENS"),
    ("SlowComp", "CSLOWCOMP"),
    ("FastComp", "CFASTCOMP"),
    ("RateComp", "RATECOMP"),
    ("SlowTens", "CSLOWTENS"),
    ("FastTens", "CFASTTENS"),
    ("RateTens", "RATETENS"),
    ("Alpha1", "ALPHA1"),
    ("Alpha2", "ALPHA2"),
    ("Beta1", "BETA1"),
    ("Beta2", "BETA2"),
    ("Eta", "ETA"),
    ("HeightOut", "OUTERHEIGHT"),
    ("HeightIn", "INNERHEIGHT"),
    ("KOutTop", "KOUTERTOP"),
    ("SlowOutTop", "CSLOWOUTERTOP"),
    ("FastOutTop", "CFASTOUTERTOP"),
    ("RateOutTop", "RATEOUTERTOP"),
    ("RadOutTop", "RADIUSOUTERTOP"),
    ("StopOutTop", "STOPDISTOUTERTOP"),
    ("KOutBot", "KOUTERBOT"),
    ("SlowOutBot", "CSLOWOUTERBOT"),
    ("FastOutBot", "CFASTOUTERBOT"),
    ("RateOutBot", "RATEOUTERBOT"),
    ("RadOutBot", "RADIUSOUTERBOT"),
    ("StopOutBot", "STOPDISTOUTERBOT"),
    ("KInTop", "KINNERTOP"),
    ("SlowInTop", "CSLOWINNERTOP"),
    ("FastInTop", "CFASTINNERTOP"),
    ("RateInTop", "RATEINNERTOP"),
    ("RadInTop", "RADIUSINNERTOP"),
    ("StopInTop", "STOPDISTINNERTOP"),
    ("KInBot", "KINNERBOT"),
    ("SlowInBot", "CSLOWINNERBOT"),
    ("FastInBot", "CFASTINNERBOT"),
    ("RateInBot", "RATEINNERBOT"),
    ("RadInBot", "RADIUSINNERBOT"),
    ("StopInBot", "STOPDISTINNERBOT"),
    ("SymOut", "OUTERSYM"),
    ("SymIn", "INNERSYM"),
    ("ActiveDir", "ACTIVEDIRECTION"),
    ("HysType", "HYSTYPE"),
];

fn bare(kind: &str) -> String {
    let letters: String = kind.chars().filter(char::is_ascii_alphanumeric).collect();
    letters.to_uppercase()
}

/// Reads the properties of links; their names, and those of which nothing is written.
pub fn properties<'a>(file: &File<'a>) -> (HashSet<&'a str>, HashSet<&'a str>) {
    let (mut written, mut lost) = (HashSet::new(), HashSet::new());
    for thing in file.things(PROPERTIES, "LINKPROP", 1) {
        let name = thing.names[0];
        let said = thing.need("TYPE");
        let bare = bare(said);
        let Some((_, table, kind)) = KINDS.iter().find(|(theirs, ..)| *theirs == bare) else {
            thing.idle();
            let what = format!("a link of type {said} has no counterpart");
            file.lose("LINK PROPERTIES: TYPE", &what, name);
            lost.insert(name);
            continue;
        };
        written.insert(name);
        let row = file.row("LINK PROPERTY DEFINITIONS 01 - GENERAL", thing.span());
        row.with("Link", name).with("LinkType", *kind).from(&thing, &WHOLE).put();
        let whole = |name: &&&str| name.strip_prefix("LINK PROPERTY DEFINITIONS ") == Some(table);
        let whole = READ.iter().find(whole).expect("a table that is read");
        for direction in directions(&thing) {
            one(file, &direction, name, kind, whole);
        }
    }
    (written, lost)
}

/// The lines of each direction.
fn directions<'a>(thing: &Thing<'a>) -> Vec<Thing<'a>> {
    let mut out: Vec<(&str, Thing<'a>)> = Vec::new();
    for line in &thing.lines {
        let one = thing.line(line);
        let Some(dof) = one.text("DOF") else { continue };
        match out.iter_mut().find(|(d, _)| *d == dof) {
            Some((_, all)) => all.lines.push(line),
            None => out.push((dof, one)),
        }
    }
    out.into_iter().map(|(_, thing)| thing).collect()
}

/// Writes a direction: a row, and one more for each further point of its curve.
fn one(file: &File<'_>, thing: &Thing<'_>, name: &str, kind: &str, table: &'static str) {
    let dof = thing.need("DOF").to_uppercase();
    let front = if dof.starts_with('R') { "Rot" } else { "Trans" };
    let row = || file.row(table, thing.span()).with("Link", name).with("DOF", &dof);
    let lawful = thing.says("NONLIN") == Some(true);
    let mut first =
        row().with("Fixed", thing.says("FIXED") == Some(true)).with("NonLinear", lawful);
    for (ours, theirs) in TURNING {
        first = first.maybe(&format!("{front}{ours}"), thing.number(theirs));
    }
    // The dashpot of a law has a name of its own in some kinds.
    let damping = thing.number("CDAMP").or_else(|| thing.number("INITIALDAMPINGCOEFF"));
    first = first.maybe(&format!("{front}C"), damping);
    let exponent = if kind == "Plastic (Wen)" { "YieldExp" } else { "CExp" };
    first = first.maybe(exponent, thing.number("EXP"));
    for (ours, theirs) in PLAIN {
        match theirs {
            "OUTERSYM" | "INNERSYM" => first = first.maybe(ours, thing.says(theirs)),
            "ACTIVEDIRECTION" | "HYSTYPE" => first = first.maybe(ours, thing.text(theirs)),
            _ => first = first.maybe(ours, thing.number(theirs)),
        }
    }
    let mut points = points(file, name, &dof).into_iter();
    let turned = front == "Rot";
    let [along, against] = if turned { ["Rotn", "Moment"] } else { ["Displ", "Force"] };
    if let Some([d, f]) = points.next() {
        first = first.with(along, d).with(against, f);
    }
    first.put();
    for [d, f] in points {
        row().with(along, d).with(against, f).put();
    }
}

/// The curve of a direction.
fn points(file: &File<'_>, name: &str, dof: &str) -> Vec<[f64; 2]> {
    let all = file.each(PROPERTIES, "LINKPROPFORCEDISPL", 1);
    let own = all.iter().filter(|p| p.names[0] == name);
    let own = own.filter(|p| p.text("DOF").is_none_or(|d| d.eq_ignore_ascii_case(dof)));
    own.map(|p| [p.need_number("DISPL"), p.need_number("FORCE")]).collect()
}

/// Reads the links of the section of assignments.
pub fn links(file: &File<'_>, plan: &Plan<'_>, (written, lost): &(HashSet<&str>, HashSet<&str>)) {
    let courses = courses(file, plan, "LINK CONNECTIVITIES", "LINK");
    for thing in file.things("LINK ASSIGNS", "LINKASSIGN", 2) {
        let [link, story] = [thing.names[0], thing.names[1]];
        let name = format!("{link}@{story}");
        let Some(course) = courses.get(link) else {
            let message = format!("there is no link \"{link}\"");
            thing.wrong(&message, "links stand in the section LINK CONNECTIVITIES");
            continue;
        };
        let Some(at) = plan.story(&thing, story) else { continue };
        let keys = ["LINKPROP", "PROPERTY", "PROP", "SECTION"];
        let Some(property) = keys.iter().find_map(|key| thing.text(key)) else {
            file.lose("LINK ASSIGNS", "a link without a property is not written", &name);
            continue;
        };
        if !written.contains(property) {
            unknown(file, &thing, property, lost, &name);
            continue;
        }
        let Some([i, j]) = course.joints(&thing, plan, at) else { continue };
        let far = (!course.is_point()).then_some(&j);
        let angle = thing.number("ANG");
        place(file, &thing, &name, property, [Some(&i), far], angle);
    }
}

/// A property that is not there, or of which nothing is written.
pub fn unknown(
    file: &File<'_>,
    thing: &Thing<'_>,
    property: &str,
    lost: &HashSet<&str>,
    name: &str,
) {
    if lost.contains(property) {
        file.lose("LINK ASSIGNS", "a link with a property that is lost is not written", name);
    } else {
        let message = format!("there is no link property \"{property}\"");
        thing.wrong(&message, "they stand in the section LINK PROPERTIES");
    }
}

/// Puts a link between two joints, or on the ground where there is no second one.
pub fn place(
    file: &File<'_>,
    thing: &Thing<'_>,
    name: &str,
    property: &str,
    [near, far]: [Option<&String>; 2],
    angle: Option<f64>,
) {
    let link = |table| file.row(table, thing.span()).with("Link", name);
    link("CONNECTIVITY - LINK").maybe("JointI", near).maybe("JointJ", far).put();
    link("LINK PROPERTY ASSIGNMENTS").with("LinkProp", property).put();
    if let Some(angle) = angle {
        link("LINK LOCAL AXES ASSIGNMENTS 1 - TYPICAL").with("Angle", angle).put();
    }
}
