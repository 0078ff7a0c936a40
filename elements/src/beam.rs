//! Beam: straight two-node beam in space, Euler–Bernoulli or Timoshenko.
//!
//! ```text
//!            2 ↑  3 ⊙
//!   i ●▬▬▬o──┴────────────o▬▬▬● j  → 1        ▬ rigid offset, o flexible end (releases act here)
//!
//!   bending in plane 1–2:  E I₃,  Φ = 12 E I₃ / (G A₂ L²)
//!   bending in plane 1–3:  E I₂,  Φ = 12 E I₂ / (G A₃ L²)        Φ = 0 without shear areas
//!   axial E A / L,  torsion G J / L       L without rigid offsets; for these two with them where `offsets_stiffen: Bending`
//!   P-Δ: geometric stiffness of the axial force N (tension +), cubic shapes of the plane that bends
//! ```
//!
//! | parameter                | symbol | unit  | range | default | meaning                                      |
//! |--------------------------|--------|-------|-------|---------|----------------------------------------------|
//! | `young`                  | E      | N/m²  | > 0   | –       | Young's modulus                              |
//! | `shear_modulus`          | G      | N/m²  | > 0   | –       | or `poisson`; needed for torsion and shear   |
//! | `poisson`                | ν      | 1     | −1 … 0.5 | –    | G = E / (2 (1 + ν))                          |
//! | `area`                   | A      | m²    | > 0   | –       | section …                                    |
//! | `i2`, `i3`               | I₂, I₃ | m⁴    | > 0   | none    | second moments about local 2 and 3           |
//! | `torsion`                | J      | m⁴    | > 0   | none    | torsion constant                             |
//! | `width`, `depth`         | b, h   | m     | > 0   | –       | … or rectangle: b along local 3, h along 2   |
//! | `shear_area_2`, `shear_area_3` | A₂, A₃ | m² | > 0 | none   | effective areas for shear along local 2, 3   |
//! | `shear_coefficient`      | κ      | 1     | > 0   | none    | instead: A₂ = A₃ = κ A                       |
//! | `density`                | ρ      | kg/m³ | ≥ 0   | 0       | mass ρ A per length                          |
//! | `distributed_mass`       | m̄      | kg/m  | ≥ 0   | 0       | further mass per length                      |
//! | `expansion`              | α      | 1/K   | > 0   | none    | strain by one kelvin, for warmth             |
//! | `mass_matrix`            |        |       |       | Lumped  | `Lumped` or `Consistent`                     |
//! | `release_i`, `release_j` |        |       |       | none    | released local directions U1 … R3 at an end  |
//! | `offset_i`, `offset_j`   |        | m     | ≥ 0   | 0       | rigid lengths along the axis at the ends     |
//! | `offsets_stiffen`        |        |       |       | All     | `All`, or `Bending` (with shear) alone       |
//!
//! Shear deformation counts where shear areas or a coefficient are given (5/6 for a rectangle). A missing
//! `i2`, `i3` or `torsion` means no stiffness there, which suits a plane model. Rectangle:
//! I₂ = h b³/12, I₃ = b h³/12, J = a s³ (1/3 − 0.21 (s/a) (1 − s⁴/(12 a⁴))), a ≥ s the sides (Roark).
//!
//! Local axes follow the element's frame; axis 1 must run along the nodes.
//!
//! **Mass.** `Lumped`: half of the mass at each node, translations only, whatever the offsets and releases.
//! `Consistent`: cubic shape functions with shear (no rotary inertia of the section in bending, ρ (I₂ + I₃)
//! in torsion); rigid lengths count as rigid rods, and released ends are condensed with the
//! same transformation as the stiffness.
//!
//! Reference: \[Przemieniecki 1968, §5.6 and §11.3\]; condensation \[Guyan 1965\].

mod matrices;
mod span;
#[cfg(test)]
mod tests;

use crate::shared::dense::{to_global, used};
use nalgebra::DMatrix;
use serde::Deserialize;
use trilith_element::dimension::{
    AREA, DENSITY, LENGTH, MASS_PER_LENGTH, NONE, SECOND_MOMENT, STRESS,
};
use trilith_element::{
    Axis, Card, Category, Default, Described, Dimension, ElementMatrices, Exercise, Form, Geometry,
    LinearElement, Member, NodeCount, Parameter, ParameterError, Range,
};

/// How the mass of a beam or truss is spread.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Deserialize)]
pub enum MassMatrix {
    /// Half at each end, translations only.
    Lumped,
    /// From the shape functions of the stiffness.
    Consistent,
}

/// What rigid ends stiffen.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Deserialize)]
pub enum Stiffened {
    /// The flexible part alone stretches and twists.
    All,
    /// Stretch and twist go over the whole length, as in CSI's programs.
    Bending,
}

/// Two-node beam.
#[derive(Clone, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Beam {
    /// Young's modulus E, N/m².
    pub young: f64,
    /// Shear modulus G, N/m².
    pub shear_modulus: Option<f64>,
    /// Poisson's ratio ν.
    pub poisson: Option<f64>,
    /// Area A, m².
    pub area: Option<f64>,
    /// Second moment about local 2, m⁴.
    pub i2: Option<f64>,
    /// Second moment about local 3, m⁴.
    pub i3: Option<f64>,
    /// Torsion constant J, m⁴.
    pub torsion: Option<f64>,
    /// Side of a rectangle along local 3, m.
    pub width: Option<f64>,
    /// Side of a rectangle along local 2, m.
    pub depth: Option<f64>,
    /// Effective area for shear along local 2, m².
    pub shear_area_2: Option<f64>,
    /// Effective area for shear along local 3, m².
    pub shear_area_3: Option<f64>,
    /// Shear coefficient κ.
    pub shear_coefficient: Option<f64>,
    /// Density ρ, kg/m³.
    pub density: f64,
    /// Further mass per length, kg/m.
    pub distributed_mass: f64,
    /// Strain by one kelvin α, 1/K.
    pub expansion: Option<f64>,
    /// How the mass is spread.
    pub mass_matrix: MassMatrix,
    /// Released directions at the flexible end i.
    #[serde(default)]
    pub release_i: Vec<Axis>,
    /// Released directions at the flexible end j.
    #[serde(default)]
    pub release_j: Vec<Axis>,
    /// Rigid length at i, m.
    pub offset_i: f64,
    /// Rigid length at j, m.
    pub offset_j: f64,
    /// What these lengths stiffen.
    pub offsets_stiffen: Stiffened,
}

const fn maybe(
    name: &'static str,
    symbol: &'static str,
    dimension: Dimension,
    meaning: &'static str,
) -> Parameter {
    Parameter::optional(name, symbol, dimension, Range::Positive, meaning)
}

const fn zero(
    name: &'static str,
    symbol: &'static str,
    dimension: Dimension,
    meaning: &'static str,
) -> Parameter {
    Parameter::number(name, symbol, dimension, Range::NonNegative, 0.0, meaning)
}

const fn releases(name: &'static str, meaning: &'static str) -> Parameter {
    Parameter::new(name, "", Form::Choices(Axis::NAMES), Default::Absent, meaning)
}

impl Described for Beam {
    const CARD: Card = Card::new(
        "Beam",
        Category::Linear,
        "Two-node beam in space, Euler–Bernoulli or Timoshenko, with releases and rigid offsets.",
    )
    .nodes(NodeCount::exactly(2))
    .parameters(&[
        Parameter::required("young", "E", STRESS, Range::Positive, "Young's modulus"),
        maybe("shear_modulus", "G", STRESS, "shear modulus; or give `poisson`"),
        Parameter::optional(
            "poisson",
            "ν",
            NONE,
            Range::Within(-0.99, 0.5),
            "Poisson's ratio, G = E/(2(1 + ν))",
        ),
        maybe("area", "A", AREA, "area of the section; or give `width` and `depth`"),
        maybe("i2", "I₂", SECOND_MOMENT, "second moment about local 2; none: no stiffness there"),
        maybe("i3", "I₃", SECOND_MOMENT, "second moment about local 3; none: no stiffness there"),
        maybe("torsion", "J", SECOND_MOMENT, "torsion constant; none: no stiffness there"),
        maybe("width", "b", LENGTH, "side of a rectangular section along local 3"),
        maybe("depth", "h", LENGTH, "side of a rectangular section along local 2"),
        maybe("shear_area_2", "A₂", AREA, "effective area for shear along local 2"),
        maybe("shear_area_3", "A₃", AREA, "effective area for shear along local 3"),
        maybe("shear_coefficient", "κ", NONE, "instead of shear areas: A₂ = A₃ = κ A"),
        zero("density", "ρ", DENSITY, "density, for the mass"),
        zero("distributed_mass", "m̄", MASS_PER_LENGTH, "further mass per length"),
        maybe("expansion", "α", NONE, "strain by one kelvin, for loads of warmth"),
        Parameter::choice(
            "mass_matrix",
            &["Lumped", "Consistent"],
            "Lumped",
            "how the mass is spread",
        ),
        releases("release_i", "local directions released at end i"),
        releases("release_j", "local directions released at end j"),
        zero("offset_i", "", LENGTH, "rigid length along the axis at i"),
        zero("offset_j", "", LENGTH, "rigid length along the axis at j"),
        Parameter::choice(
            "offsets_stiffen",
            &["All", "Bending"],
            "All",
            "what rigid lengths stiffen: `Bending` leaves stretch and twist to the whole length",
        ),
    ])
    .law(
        "bending in 1–2: E I₃, Φ = 12 E I₃/(G A₂ L²); bending in 1–3: E I₂, Φ = 12 E I₂/(G A₃ L²)\n\
              axial E A/L, torsion G J/L; Φ = 0 without shear areas\n\
              rectangle: I₂ = h b³/12, I₃ = b h³/12, J = a s³ (1/3 − 0.21 (s/a) (1 − s⁴/(12 a⁴)))",
    )
    .source("Przemieniecki, Theory of Matrix Structural Analysis, 1968, §5.6 and §11.3")
    .example(
        r#""column": Beam(nodes: ("a", "b"), young: "210 GPa", area: "50 cm^2", i3: "2000 cm^4")"#,
    )
    .exercise(Exercise::NONE);

    fn check(&self) -> Result<(), ParameterError> {
        let wrong = |name: &str, message: &str| Err(ParameterError::inconsistent(name, message));
        let general = [self.area, self.i2, self.i3, self.torsion];
        match (self.width, self.depth) {
            (Some(_), Some(_)) if general.iter().any(Option::is_some) => {
                return wrong("area", "`width` and `depth` exclude `area`, `i2`, `i3`, `torsion`");
            }
            (Some(_), None) => return wrong("width", "`width` goes with `depth`"),
            (None, Some(_)) => return wrong("depth", "`depth` goes with `width`"),
            (None, None) if self.area.is_none() => {
                return wrong("area", "a beam needs `area`, or `width` and `depth`");
            }
            _ => {}
        }
        if self.shear_modulus.is_some() && self.poisson.is_some() {
            return wrong("poisson", "`shear_modulus` and `poisson` exclude each other");
        }
        let areas = self.shear_area_2.or(self.shear_area_3);
        if areas.is_some() && self.shear_coefficient.is_some() {
            return wrong(
                "shear_coefficient",
                "`shear_coefficient` excludes `shear_area_2` and `_3`",
            );
        }
        let sheared = areas.is_some() || self.shear_coefficient.is_some();
        let twisted = self.torsion.is_some() || self.width.is_some();
        if (sheared || twisted) && self.shear_modulus.is_none() && self.poisson.is_none() {
            return wrong("shear_modulus", "torsion and shear need `shear_modulus` or `poisson`");
        }
        Ok(())
    }
}

/// Section constants; 0 where there is none.
#[derive(Clone, Copy, Debug)]
struct Section {
    area: f64,
    i2: f64,
    i3: f64,
    torsion: f64,
}

impl Beam {
    fn section(&self) -> Section {
        if let (Some(b), Some(h)) = (self.width, self.depth) {
            let (a, s) = (b.max(h), b.min(h));
            let q = s / a;
            let torsion = a * s.powi(3) * (1.0 / 3.0 - 0.21 * q * (1.0 - q.powi(4) / 12.0));
            return Section {
                area: b * h,
                i2: h * b.powi(3) / 12.0,
                i3: b * h.powi(3) / 12.0,
                torsion,
            };
        }
        let or_zero = |x: Option<f64>| x.unwrap_or(0.0);
        Section {
            area: or_zero(self.area),
            i2: or_zero(self.i2),
            i3: or_zero(self.i3),
            torsion: or_zero(self.torsion),
        }
    }

    /// What the rigid lengths leave of the whole, m.
    fn flexible(&self, whole: f64) -> Result<f64, ParameterError> {
        let flexible = whole - self.offset_i - self.offset_j;
        if flexible > 0.0 {
            return Ok(flexible);
        }
        Err(ParameterError::geometry(format!(
            "the rigid offsets of {} m leave nothing of a beam of {whole} m",
            self.offset_i + self.offset_j
        )))
    }

    fn shear_modulus(&self) -> f64 {
        let by_poisson = || self.poisson.map(|nu| self.young / (2.0 * (1.0 + nu)));
        self.shear_modulus.or_else(by_poisson).unwrap_or(0.0)
    }

    /// Shear areas along local 2 and 3, where shear deformation counts.
    fn shear_areas(&self, section: &Section) -> [Option<f64>; 2] {
        let by_coefficient = self.shear_coefficient.map(|k| k * section.area);
        [self.shear_area_2.or(by_coefficient), self.shear_area_3.or(by_coefficient)]
    }
}

impl LinearElement for Beam {
    fn matrices(&self, at: &Geometry<'_>) -> Result<ElementMatrices, ParameterError> {
        let whole = span_along_axis_1(at, "beam")?;
        let flexible = self.flexible(whole)?;
        let (k, m) = self.local(whole, flexible, at.tension)?;
        let none = DMatrix::zeros(12, 12);
        Ok(used(&to_global(&k, &at.frame), &to_global(&m, &at.frame), &none))
    }

    fn member(&self) -> Option<&dyn Member> {
        Some(self)
    }
}

/// Length of a two-node element, whose local axis 1 must run from i to j.
pub(crate) fn span_along_axis_1(at: &Geometry<'_>, what: &str) -> Result<f64, ParameterError> {
    let [i, j] = at.nodes else {
        return Err(ParameterError::geometry(format!("a {what} needs two nodes")));
    };
    let length = at.length();
    if length <= 0.0 {
        return Err(ParameterError::geometry(format!("the two nodes of a {what} coincide")));
    }
    let along: f64 = (0..3).map(|x| at.frame.0[0][x] * (j[x] - i[x])).sum();
    if along < length * (1.0 - 1e-6) {
        return Err(ParameterError::geometry(format!(
            "local axis 1 of a {what} must run from its first to its second node"
        )));
    }
    Ok(length)
}
