//! Materials and cross-sections.

use super::words::{File, Thing};
use crate::ron::number;
use std::collections::HashSet;
use trilith_model::sections::{self, Section};

/// Names of the sections that are written, and of those that are not.
#[derive(Default)]
pub struct Known<'a> {
    pub written: HashSet<&'a str>,
    pub lost: HashSet<&'a str>,
}

/// Reads materials: stiffness and density.
pub fn materials(file: &File<'_>, gravity: f64) {
    for thing in file.things("MATERIAL PROPERTIES", "MATERIAL", 1) {
        let name = thing.names[0];
        let weight = thing.number("WEIGHTPERVOLUME");
        let mass = thing.number("MASSPERVOLUME");
        let [weight, mass] = match (weight, mass) {
            (Some(w), None) => [w, w / gravity],
            (None, Some(m)) => [m * gravity, m],
            (w, m) => [w.unwrap_or(0.0), m.unwrap_or(0.0)],
        };
        let directed = thing.text("SYMTYPE").is_some_and(|s| !s.eq_ignore_ascii_case("isotropic"));
        if directed {
            let what = "a material that differs along its axes: frames take that of axis 1";
            file.otherwise("MATERIAL PROPERTIES: SYMTYPE", what, name);
        }
        if ["MODALRATIO", "MASSCOEFF", "STIFFCOEFF"].iter().any(|key| thing.or_zero(key) != 0.0) {
            let what = "damping of a material: damping is that of the model";
            file.lose("MATERIAL PROPERTIES", what, name);
        }
        let first = |plain: &str, axis: &str| thing.number(plain).or_else(|| thing.number(axis));
        let (young, poisson) = (first("E", "E1"), first("U", "U12"));
        file.row("MATERIAL PROPERTIES 02 - BASIC MECHANICAL PROPERTIES", thing.span())
            .with("Material", name)
            .with("UnitWeight", weight)
            .with("UnitMass", mass)
            .maybe("E1", young)
            .maybe("G12", thing.number("G12"))
            .maybe("U12", poisson)
            .maybe("A1", first("A", "A1"))
            .put();
    }
}

/// Factors of a section: ours and theirs.
const FACTORS: [(&str, &str); 8] = [
    ("AMod", "AMOD"),
    ("A2Mod", "A2MOD"),
    ("A3Mod", "A3MOD"),
    ("JMod", "JMOD"),
    ("I2Mod", "I2MOD"),
    ("I3Mod", "I3MOD"),
    ("MMod", "MMOD"),
    ("WMod", "WMOD"),
];

/// Reads the sections of frames; `metre` is the length of the file's unit.
pub fn sections<'a>(file: &File<'a>, metre: f64) -> Known<'a> {
    let mut known = Known::default();
    for thing in file.things("FRAME SECTIONS", "FRAMESECTION", 1) {
        let name = thing.names[0];
        let shape = thing.text("SHAPE").unwrap_or_default();
        let Some(found) = computed(file, &thing, shape, metre).or_else(|| given(&thing)) else {
            let what = format!("a section of the shape {shape} is not written");
            file.lose("FRAME SECTIONS: SHAPE", &what, name);
            thing.idle();
            known.lost.insert(name);
            continue;
        };
        thing.idle_of_shape();
        if !known.written.insert(name) {
            continue;
        }
        let Found { area, shear, torsion, moments, size } = found;
        file.row("FRAME SECTION PROPERTIES 01 - GENERAL", thing.span())
            .with("SectionName", name)
            .with("Material", thing.need("MATERIAL"))
            .with("Area", area)
            .with("AS2", shear[0])
            .with("AS3", shear[1])
            .with("TorsConst", torsion)
            .with("I22", moments[0])
            .with("I33", moments[1])
            .with("t3", size[0])
            .with("t2", size[1])
            .from(&thing, &FACTORS)
            .maybe("I23", thing.number("I23").filter(|x| *x != 0.0))
            .put();
    }
    varying(file, &mut known);
    lists(file, &mut known);
    known
}

/// Properties in the file's units.
struct Found {
    area: f64,
    shear: [f64; 2],
    torsion: f64,
    /// About local 2 and 3.
    moments: [f64; 2],
    /// Depth and width.
    size: [f64; 2],
}

/// Properties that the file gives.
fn given(thing: &Thing<'_>) -> Option<Found> {
    let area = thing.number("AREA")?;
    Some(Found {
        area,
        shear: [thing.or_zero("AS2"), thing.or_zero("AS3")],
        torsion: thing.or_zero("TORSION"),
        moments: [thing.or_zero("I22"), thing.or_zero("I33")],
        size: [thing.or_zero("D"), thing.or_zero("B")],
    })
}

/// Properties from the dimensions of a shape, or from its name in a catalogue.
fn computed(file: &File<'_>, thing: &Thing<'_>, shape: &str, metre: f64) -> Option<Found> {
    let sizes = |keys: &[&str]| -> Option<Vec<f64>> {
        let all: Vec<f64> = keys.iter().filter_map(|key| thing.number(key)).collect();
        let good = all.len() == keys.len() && all.iter().all(|x| *x > 0.0);
        if !good {
            let message = format!("a {shape} needs {} above zero", keys.join(", "));
            thing.wrong(&message, "the dimensions stand behind their keys");
        }
        good.then_some(all)
    };
    let (section, size, unit) = match shape {
        "Concrete Rectangular" | "Steel Plate" | "Steel Solid Rectangle" | "Other Rectangular" => {
            let d = sizes(&["D", "B"])?;
            (sections::rectangle(d[1], d[0]), [d[0], d[1]], 1.0)
        }
        "Concrete Circle" | "Steel Rod" | "Steel Solid Circle" => {
            let d = sizes(&["D"])?[0];
            (sections::circle(d), [d, d], 1.0)
        }
        "Steel Pipe" | "Concrete Pipe" => {
            let d = sizes(&["D", "T"])?;
            fits(thing, 2.0 * d[1], d[0])?;
            (sections::pipe(d[0], d[1]), [d[0], d[0]], 1.0)
        }
        "Steel Tube" | "Concrete Tube" => {
            let d = sizes(&["D", "B", "TF", "TW"])?;
            fits(thing, 2.0 * d[2], d[0])?;
            fits(thing, 2.0 * d[3], d[1])?;
            (sections::hollow_box(d[1], d[0], d[3], d[2]), [d[0], d[1]], 1.0)
        }
        "Steel I/Wide Flange" | "I/Wide Flange" => {
            let d = sizes(&["D", "B", "TF", "TW"])?;
            let other = |key, own: f64| thing.number(key).is_some_and(|x| x != own);
            if other("BB", d[1]) || other("TFB", d[2]) {
                return None;
            }
            fits(thing, 2.0 * d[2], d[0])?;
            fits(thing, d[3], d[1])?;
            let root = thing.or_zero("R");
            let of = sections::i_shape([d[0], d[1], d[3], d[2], root]);
            (of, [d[0], d[1]], 1.0)
        }
        _ => {
            let rolled = sections::rolled(shape)?;
            thing.text("FILE");
            let what = "a rolled section by its name has the properties of this program's tables";
            file.otherwise("FRAME SECTIONS: SHAPE", what, shape);
            let size = match rolled.shape {
                sections::Shape::I { depth, width, .. }
                | sections::Shape::Rectangle { width, depth } => [depth, width],
                sections::Shape::Round { diameter } => [diameter, diameter],
            };
            (rolled, size.map(|x| x / metre), metre)
        }
    };
    let Section { area, i2, i3, torsion, shear_area_2, shear_area_3, .. } = section;
    let [two, four] = [unit.powi(2), unit.powi(4)];
    Some(Found {
        area: area / two,
        shear: [shear_area_2 / two, shear_area_3 / two],
        torsion: torsion / four,
        moments: [i2 / four, i3 / four],
        size,
    })
}

/// Walls that leave a hollow.
fn fits(thing: &Thing<'_>, walls: f64, size: f64) -> Option<()> {
    if walls < size {
        return Some(());
    }
    let message = format!("walls of {} together fill the {}", number(walls), number(size));
    thing.wrong(&message, "thicknesses are those of single walls");
    None
}

/// Sections that vary along their frame.
fn varying<'a>(file: &File<'a>, known: &mut Known<'a>) {
    for thing in file.each("NONPRISMATIC SECTIONS", "NONPRISMATICSECTION", 1) {
        let (name, ends) = (thing.names[0], ["STARTSEC", "ENDSEC"].map(|key| thing.need(key)));
        if let Some(gone) = ends.iter().find(|end| !known.written.contains(*end)) {
            if known.lost.contains(gone) {
                file.lose("NONPRISMATIC SECTIONS", "a section with an end that is lost", name);
                known.lost.insert(name);
            } else {
                thing.wrong(&format!("there is no section \"{gone}\""), "FRAME SECTIONS");
            }
            continue;
        }
        let law = |key| {
            thing.text(key).map(|law| match law.to_uppercase().as_str() {
                "PARABOLIC" => "Parabolic",
                "CUBIC" => "Cubic",
                _ => "Linear",
            })
        };
        let row = file.row("FRAME SECTION PROPERTIES 05 - NONPRISMATIC", thing.span());
        let row = row.with("SectionName", name).with("StartSect", ends[0]).with("EndSect", ends[1]);
        let row = match thing.number("FLENGTH") {
            Some(length) => row.with("LengthType", "Absolute").with("AbsLength", length),
            None => row.with("VarLength", thing.number("VLENGTH").unwrap_or(1.0)),
        };
        row.maybe("EI33Var", law("VARI3")).maybe("EI22Var", law("VARI2")).put();
        if !known.written.insert(name) {
            continue;
        }
        // What varies still stands among the sections.
        file.row("FRAME SECTION PROPERTIES 01 - GENERAL", thing.span())
            .with("SectionName", name)
            .put();
    }
}

/// Lists that the program chooses from: their first section is taken.
fn lists<'a>(file: &File<'a>, known: &mut Known<'a>) {
    for thing in file.things("AUTO SELECT SECTION LISTS", "AUTOSECTION", 1) {
        thing.idle();
        let what = "a list that a design chooses from: frames with it are not written";
        file.lose("AUTO SELECT SECTION LISTS", what, thing.names[0]);
        known.lost.insert(thing.names[0]);
    }
}

impl Thing<'_> {
    /// Takes for asked what a shape of given dimensions has besides: properties that follow from them, and those of design.
    fn idle_of_shape(&self) {
        for key in [
            "AREA",
            "AS2",
            "AS3",
            "I33",
            "I22",
            "TORSION",
            "S33POS",
            "S33NEG",
            "S22POS",
            "S22NEG",
            "R33",
            "R22",
            "Z33",
            "Z22",
            "D",
            "B",
            "TF",
            "TW",
            "R",
            "BB",
            "TFB",
            "T",
            "FILE",
            "NOTES",
            "OFFSETCG3",
            "OFFSETCG2",
            "OFFSETPNA3",
            "OFFSETPNA2",
        ] {
            self.text(key);
        }
    }
}
