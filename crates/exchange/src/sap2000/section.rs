//! Materials and sections of frames.

use super::context::Context;
use super::database::Entry;
use crate::ron::Ron;
use std::cell::RefCell;
use std::collections::{HashMap, HashSet};

/// What a beam takes from its section and material, modifiers included; in the units of the file.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Section {
    pub young: f64,
    pub shear: f64,
    /// Thermal expansion, per degree.
    pub expansion: f64,
    pub area: f64,
    /// Areas for shear along local 2 and 3; 0: no shear deformation.
    pub shear_areas: [f64; 2],
    pub torsion: f64,
    /// Second moments about local 2 and 3.
    pub moments: [f64; 2],
    /// Mass and weight per length.
    pub mass: f64,
    pub weight: f64,
    /// Outer height along local 2 and width along local 3.
    pub size: [f64; 2],
}

/// A stretch of a section that varies.
#[derive(Clone, Debug)]
pub struct Stretch<'a> {
    start: &'a str,
    end: &'a str,
    /// Length, or a share of what the others leave.
    length: Result<f64, f64>,
    /// Power of the law that the bending stiffnesses about 3 and 2 follow.
    powers: [f64; 2],
}

/// Ends of a stretch along a frame, its sections there, and the powers of its bending stiffnesses about 3 and 2.
pub type Reach = ([f64; 2], [Section; 2], [f64; 2]);

/// Sections and materials by name.
pub struct Sections<'a> {
    rows: HashMap<&'a str, Entry<'a>>,
    materials: HashMap<&'a str, Entry<'a>>,
    /// What else is said of materials; rows that were looked at.
    more: Vec<Entry<'a>>,
    seen: RefCell<HashSet<String>>,
    stretches: HashMap<&'a str, Vec<Stretch<'a>>>,
}

const TABLE: &str = "FRAME SECTION PROPERTIES 01 - GENERAL";

impl<'a> Sections<'a> {
    pub fn new(cx: &mut Context<'a>) -> Self {
        let by = |table: &str, key: &'static str| {
            let mut first: HashMap<&'a str, Entry<'a>> = HashMap::new();
            for row in cx.db.rows(table) {
                first.entry(row.need(key)).or_insert(row);
            }
            first
        };
        let rows = by(TABLE, "SectionName");
        let materials = by("MATERIAL PROPERTIES 02 - BASIC MECHANICAL PROPERTIES", "Material");
        let mut stretches: HashMap<&str, Vec<Stretch<'_>>> = HashMap::new();
        for row in cx.db.rows("FRAME SECTION PROPERTIES 05 - NONPRISMATIC") {
            let length = match row.text("LengthType") {
                Some("Absolute") => Ok(row.need_number("AbsLength")),
                _ => Err(row.need_number("VarLength")),
            };
            let power = |key| match row.text(key) {
                Some("Parabolic") => 2.0,
                Some("Cubic") => 3.0,
                _ => 1.0,
            };
            let powers = [power("EI33Var"), power("EI22Var")];
            row.number("NumSegments");
            row.number("SegmentNum");
            let (start, end) = (row.need("StartSect"), row.need("EndSect"));
            let name = row.need("SectionName");
            stretches.entry(name).or_default().push(Stretch { start, end, length, powers });
        }
        let tables =
            ["MATERIAL PROPERTIES 01 - GENERAL", "MATERIAL PROPERTIES 06 - DAMPING PARAMETERS"];
        let more = tables.iter().flat_map(|table| cx.db.rows(table)).collect();
        Self { rows, materials, more, seen: RefCell::default(), stretches }
    }

    /// The section of that name, in its own material or another.
    pub fn get(
        &self,
        cx: &mut Context<'a>,
        name: &'a str,
        material: Option<&str>,
    ) -> Option<Section> {
        let row = *self.rows.get(name)?;
        let named = material.or(row.text("Material"));
        let material = named.and_then(|m| self.materials.get(m).copied());
        self.look(cx, named.unwrap_or_default());
        let Some(material) = material else {
            row.wrong("the material of this section is not in the file", "");
            return None;
        };
        for (key, what) in [
            ("I23", "principal axes of a section that are turned"),
            ("EccV2", "a shear centre that is not at the centroid"),
            ("EccV3", "a shear centre that is not at the centroid"),
        ] {
            if row.or_zero(key) != 0.0 {
                cx.report.lose(&format!("{TABLE}: {key}"), what, name);
            }
        }
        let factor = |key| row.number(key).unwrap_or(1.0);
        let area = row.or_zero("Area");
        let shear = match material.number("G12") {
            Some(g) => g,
            None => {
                let poisson = material.number("U12").unwrap_or(0.0);
                material.or_zero("E1") / (2.0 * (1.0 + poisson))
            }
        };
        Some(Section {
            young: material.need_number("E1"),
            shear,
            expansion: material.or_zero("A1"),
            area: area * factor("AMod"),
            shear_areas: [
                row.or_zero("AS2") * factor("A2Mod"),
                row.or_zero("AS3") * factor("A3Mod"),
            ],
            torsion: row.or_zero("TorsConst") * factor("JMod"),
            moments: [row.or_zero("I22") * factor("I2Mod"), row.or_zero("I33") * factor("I3Mod")],
            mass: material.or_zero("UnitMass") * area * factor("MMod"),
            weight: material.or_zero("UnitWeight") * area * factor("WMod"),
            size: [row.or_zero("t3"), row.or_zero("t2")],
        })
    }

    /// Names what a material has beyond a constant stiffness, once.
    fn look(&self, cx: &mut Context<'a>, material: &str) {
        if !self.seen.borrow_mut().insert(material.into()) {
            return;
        }
        for row in self.more.iter().filter(|row| row.need("Material") == material) {
            if row.yes("TempDepend") {
                let what = "properties that change with temperature are those of the first row";
                cx.report.lose("MATERIAL PROPERTIES 01 - GENERAL: TempDepend", what, material);
            }
            if ["ModalRatio", "VisMass", "VisStiff", "HysMass", "HysStiff"].map(|k| row.or_zero(k))
                != [0.0; 5]
            {
                let what = "damping of a material: damping is that of the model";
                cx.report.lose("MATERIAL PROPERTIES 06 - DAMPING PARAMETERS", what, material);
            }
        }
    }

    /// True where there is a section of that name.
    pub fn has(&self, name: &str) -> bool {
        self.rows.contains_key(name)
    }

    /// True where the section varies along its frame.
    pub fn varies(&self, name: &str) -> bool {
        self.stretches.contains_key(name)
    }

    /// Stretches of a section that varies along a frame of a length: ends, sections and powers.
    pub fn stretches(&self, cx: &mut Context<'a>, name: &str, length: f64) -> Option<Vec<Reach>> {
        let all = self.stretches.get(name)?;
        let fixed: f64 = all.iter().filter_map(|s| s.length.ok()).sum();
        let shares: f64 = all.iter().filter_map(|s| s.length.err()).sum();
        // Absolute lengths that do not come to the whole are brought to it.
        let scale = if shares == 0.0 { length / fixed } else { 1.0 };
        let mut at = 0.0;
        let mut out = Vec::new();
        for s in all {
            let of = match s.length {
                Ok(absolute) => absolute * scale,
                Err(share) => (length - fixed) * share / shares,
            };
            if !(of.is_finite() && of >= 0.0) {
                return None;
            }
            let ends = [self.get(cx, s.start, None)?, self.get(cx, s.end, None)?];
            out.push(([at, at + of], ends, s.powers));
            at += of;
        }
        Some(out)
    }
}

impl Section {
    /// The section between two others: bending stiffness by the powers of its law, all else in proportion.
    #[must_use]
    pub fn between(a: &Self, b: &Self, share: f64, powers: [f64; 2]) -> Self {
        let line = |x: f64, y: f64| x + share * (y - x);
        let curve = |x: f64, y: f64, p: f64| line(x.powf(1.0 / p), y.powf(1.0 / p)).powf(p);
        let pair = |x: [f64; 2], y: [f64; 2]| [line(x[0], y[0]), line(x[1], y[1])];
        let bending = |i: usize| a.young * a.moments[i];
        let other = |i: usize| b.young * b.moments[i];
        let young = line(a.young, b.young);
        let [about3, about2] = powers;
        Self {
            young,
            shear: line(a.shear, b.shear),
            expansion: line(a.expansion, b.expansion),
            area: line(a.area, b.area),
            shear_areas: pair(a.shear_areas, b.shear_areas),
            torsion: line(a.torsion, b.torsion),
            moments: [
                curve(bending(0), other(0), about2) / young,
                curve(bending(1), other(1), about3) / young,
            ],
            mass: line(a.mass, b.mass),
            weight: line(a.weight, b.weight),
            size: pair(a.size, b.size),
        }
    }

    /// With the modifiers of a frame.
    pub fn modify(&mut self, row: Entry<'_>) {
        let factor = |key| row.number(key).unwrap_or(1.0);
        self.area *= factor("AMod");
        self.shear_areas[0] *= factor("AS2Mod");
        self.shear_areas[1] *= factor("AS3Mod");
        self.torsion *= factor("JMod");
        self.moments[0] *= factor("I22Mod");
        self.moments[1] *= factor("I33Mod");
        self.mass *= factor("MassMod");
        self.weight *= factor("WeightMod");
    }

    /// A beam with this section.
    #[must_use]
    pub fn beam(&self) -> Ron {
        let some = |x: f64| (x > 0.0).then_some(x);
        let twisted = self.torsion > 0.0 || self.shear_areas.iter().any(|a| *a > 0.0);
        Ron::block("Beam")
            .with("young", self.young)
            .maybe("shear_modulus", some(self.shear).filter(|_| twisted))
            .with("area", self.area)
            .maybe("i2", some(self.moments[0]))
            .maybe("i3", some(self.moments[1]))
            .maybe("torsion", some(self.torsion).filter(|_| self.shear > 0.0))
            .maybe("shear_area_2", some(self.shear_areas[0]).filter(|_| self.shear > 0.0))
            .maybe("shear_area_3", some(self.shear_areas[1]).filter(|_| self.shear > 0.0))
            .maybe("distributed_mass", some(self.mass))
    }
}
