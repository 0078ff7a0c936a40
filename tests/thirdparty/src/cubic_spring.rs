//! Cubic spring: a hardening or softening spring of Duffing's kind, without memory.
//!
//! ```text
//!   f = k₁ d + k₃ d³
//! ```
//!
//! A softening spring loses its resistance beyond |d| = √(k₁/(3 |k₃|)).
//!
//! Reference: \[Duffing 1918\].

use serde::Deserialize;
use trilith_element::{
    Axis, Card, Category, Coordinates, Described, Exercise, Kinematics, Link, NodeCount,
    Parameters, Response, Stroke,
};

/// Spring with a cubic term.
#[derive(Clone, Debug, Deserialize, Parameters)]
#[serde(deny_unknown_fields)]
pub struct CubicSpring {
    /// stiffness at rest
    #[parameter("k₁", unit = "N/m", range = Positive)]
    pub k1: f64,
    /// cubic coefficient; > 0 hardens, < 0 softens
    #[parameter("k₃", unit = "N/m³", default = 0.0)]
    pub k3: f64,
    /// local axis
    #[parameter(choices = ["U1", "U2", "U3"], default = "U1")]
    pub axis: Axis,
}

impl Described for CubicSpring {
    const CARD: Card = Card::new(
        "CubicSpring",
        Category::Link,
        "Spring with a cubic term, hardening or softening.",
    )
    .nodes(NodeCount::GROUND_OR_TWO)
    .parameters(Self::PARAMETERS)
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
