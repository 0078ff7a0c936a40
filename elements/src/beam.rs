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
use trilith_element::{
    Axis, Card, Category, Choices, Described, ElementMatrices, Exercise, Geometry, LinearElement,
    Member, NodeCount, ParameterError, Parameters,
};

/// How the mass of a beam or truss is spread.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Deserialize, Choices)]
pub enum MassMatrix {
    /// Half at each end, translations only.
    Lumped,
    /// From the shape functions of the stiffness.
    Consistent,
}

/// What rigid ends stiffen.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Deserialize, Choices)]
pub enum Stiffened {
    /// The flexible part alone stretches and twists.
    All,
    /// Stretch and twist go over the whole length, as in CSI's programs.
    Bending,
}

/// Two-node beam.
#[derive(Clone, Debug, Deserialize, Parameters)]
#[serde(deny_unknown_fields)]
pub struct Beam {
    /// Young's modulus
    #[parameter("E", unit = "Pa", range = Positive)]
    pub young: f64,
    /// shear modulus; or give `poisson`
    #[parameter("G", unit = "Pa", range = Positive)]
    pub shear_modulus: Option<f64>,
    /// Poisson's ratio, G = E/(2(1 + ν))
    #[parameter("ν", unit = "1", range = Within(-0.99, 0.5))]
    pub poisson: Option<f64>,
    /// area of the section; or give `width` and `depth`
    #[parameter("A", unit = "m²", range = Positive)]
    pub area: Option<f64>,
    /// second moment about local 2; none: no stiffness there
    #[parameter("I₂", unit = "m⁴", range = Positive)]
    pub i2: Option<f64>,
    /// second moment about local 3; none: no stiffness there
    #[parameter("I₃", unit = "m⁴", range = Positive)]
    pub i3: Option<f64>,
    /// torsion constant; none: no stiffness there
    #[parameter("J", unit = "m⁴", range = Positive)]
    pub torsion: Option<f64>,
    /// side of a rectangular section along local 3
    #[parameter("b", unit = "m", range = Positive)]
    pub width: Option<f64>,
    /// side of a rectangular section along local 2
    #[parameter("h", unit = "m", range = Positive)]
    pub depth: Option<f64>,
    /// effective area for shear along local 2
    #[parameter("A₂", unit = "m²", range = Positive)]
    pub shear_area_2: Option<f64>,
    /// effective area for shear along local 3
    #[parameter("A₃", unit = "m²", range = Positive)]
    pub shear_area_3: Option<f64>,
    /// instead of shear areas: A₂ = A₃ = κ A
    #[parameter("κ", unit = "1", range = Positive)]
    pub shear_coefficient: Option<f64>,
    /// density, for the mass
    #[parameter("ρ", unit = "kg/m³", range = NonNegative, default = 0.0)]
    pub density: f64,
    /// further mass per length
    #[parameter("m̄", unit = "kg/m", range = NonNegative, default = 0.0)]
    pub distributed_mass: f64,
    /// strain by one kelvin, for loads of warmth
    #[parameter("α", unit = "1/K", range = Positive)]
    pub expansion: Option<f64>,
    /// how the mass is spread
    #[parameter(choices = MassMatrix::NAMES, default = "Lumped")]
    pub mass_matrix: MassMatrix,
    /// local directions released at end i
    #[parameter(choices = Axis::NAMES)]
    #[serde(default)]
    pub release_i: Vec<Axis>,
    /// local directions released at end j
    #[parameter(choices = Axis::NAMES)]
    #[serde(default)]
    pub release_j: Vec<Axis>,
    /// rigid length along the axis at i
    #[parameter(unit = "m", range = NonNegative, default = 0.0)]
    pub offset_i: f64,
    /// rigid length along the axis at j
    #[parameter(unit = "m", range = NonNegative, default = 0.0)]
    pub offset_j: f64,
    /// what rigid lengths stiffen: `Bending` leaves stretch and twist to the whole length
    #[parameter(choices = Stiffened::NAMES, default = "All")]
    pub offsets_stiffen: Stiffened,
}

impl Described for Beam {
    const CARD: Card = Card::new(
        "Beam",
        Category::Linear,
        "Two-node beam in space, Euler–Bernoulli or Timoshenko, with releases and rigid offsets.",
    )
    .nodes(NodeCount::exactly(2))
    .parameters(Self::PARAMETERS)
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
