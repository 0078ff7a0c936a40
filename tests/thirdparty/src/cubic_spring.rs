//! Cubic spring: a hardening or softening spring of Duffing's kind, without memory.
//!
//! ```text
//!   f = k₁ d + k₃ d³
//! ```
//!
//! | parameter | symbol | unit | range | default | meaning                                     |
//! |-----------|--------|------|-------|---------|---------------------------------------------|
//! | `k1`      | k₁     | N/m  | > 0   | –       | stiffness at rest                           |
//! | `k3`      | k₃     | N/m³ | any   | 0       | cubic coefficient; > 0 hardens, < 0 softens |
//! | `axis`    |        |      |       | U1      | local axis: U1, U2 or U3                    |
//!
//! A softening spring loses its resistance beyond |d| = √(k₁/(3 |k₃|)).
//!
//! Reference: \[Duffing 1918\].

use serde::Deserialize;
use trilith_element::dimension::{AREA, STIFFNESS};
use trilith_element::{
    Axis, Card, Category, Coordinates, Described, Dimension, Exercise, Kinematics, Link, NodeCount,
    Parameter, Range, Response, Stroke,
};

/// N/m³.
const CUBIC: Dimension = Dimension {
    mass: STIFFNESS.mass - AREA.mass,
    length: STIFFNESS.length - AREA.length,
    time: STIFFNESS.time - AREA.time,
};

/// Spring with a cubic term.
#[derive(Clone, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct CubicSpring {
    /// Stiffness at rest k₁, N/m.
    pub k1: f64,
    /// Cubic coefficient k₃, N/m³.
    pub k3: f64,
    /// Local axis.
    pub axis: Axis,
}

impl Described for CubicSpring {
    const CARD: Card = Card::new(
        "CubicSpring",
        Category::Link,
        "Spring with a cubic term, hardening or softening.",
    )
    .nodes(NodeCount::GROUND_OR_TWO)
    .parameters(&[
        Parameter::required("k1", "k₁", STIFFNESS, Range::Positive, "stiffness at rest"),
        Parameter::number("k3", "k₃", CUBIC, Range::Any, 0.0, "cubic coefficient"),
        Parameter::choice("axis", &["U1", "U2", "U3"], "U1", "local axis"),
    ])
    .law("f = k₁ d + k₃ d³")
    .source("Duffing, Erzwungene Schwingungen bei veränderlicher Eigenfrequenz, 1918")
    .example(r#""mount": CubicSpring(node: "a", k1: "40 kN/m", k3: "5 MN/m^3")"#)
    .exercise(Exercise::new(1.0, &[Stroke::about(0.0, 0.1)]));
}

impl Link for CubicSpring {
    fn coordinates(&self) -> Coordinates {
        Coordinates::Local(vec![self.axis])
    }

    fn engaged_stiffness(&self, k: &mut [f64]) {
        k[0] = self.k1;
    }

    fn respond(&self, at: &Kinematics<'_>, _: &[f64], _: &mut [f64], out: &mut Response<'_>) {
        let d = at.d[0];
        out.f[0] = self.k1 * d + self.k3 * d.powi(3);
        out.k[0] = self.k1 + 3.0 * self.k3 * d * d;
        out.energy.stored = 0.5 * self.k1 * d * d + 0.25 * self.k3 * d.powi(4);
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use trilith_element::conformance::Kit;
    use trilith_element::{Driver, ParameterError, Value, Values};

    fn read(names: [&str; 3]) -> Result<CubicSpring, ParameterError> {
        let values = [Value::Number(4e4), Value::Number(5e6), Value::Text("U1".into())];
        Values(names.map(str::to_owned).into_iter().zip(values).collect()).read()
    }

    fn law() -> CubicSpring {
        read(["k1", "k3", "axis"]).unwrap()
    }

    #[test]
    fn conforms_hardening_and_softening() {
        Kit::new(&[0.1], 2.0).rate_independent().assert(&law());
        let soft = CubicSpring { k3: -1e5, ..law() };
        Kit::new(&[0.1], 2.0).rate_independent().assert(&soft);
    }

    #[test]
    fn doubles_its_force_where_both_terms_are_equal() {
        let d = (4e4_f64 / 5e6).sqrt();
        let law = law();
        let mut driver = Driver::starting_at(&law, &[-d], &[0.0]);
        let f = driver.to(&[d])[0];
        assert!((f - 2.0 * 4e4 * d).abs() < 1e-9 * f);
    }

    #[test]
    fn rejects_an_unknown_parameter() {
        assert!(read(["k1", "k2", "axis"]).is_err());
    }
}
