//! MultilinearElastic: nonlinear elastic spring through points, along or about one axis.
//!
//! ```text
//!   f │        ___●      f = fᵢ + (fᵢ₊₁ − fᵢ)/(dᵢ₊₁ − dᵢ) (d − dᵢ)     dᵢ ≤ d < dᵢ₊₁
//!     │    ●‾‾‾          the first and the last line go on beyond their points
//!     │  /               back on the same way: nothing is lost
//!   ──●/──────── d
//! ```
//!
//! The curve passes through the origin and does not fall beyond its ends. At a point the tangent is that of
//! the line to the right. Stored energy: ∫ f dd, exactly.
//!
//! Reference: \[CSI Analysis Reference Manual, multilinear elastic property\].

use crate::shared::multilinear::Curve;
use serde::Deserialize;
use trilith_element::{
    Axis, Card, Category, Coordinates, Described, Exercise, Kinematics, Link, NodeCount,
    ParameterError, Parameters, Response, Stroke,
};

/// Elastic spring whose force follows a curve through points.
#[derive(Clone, Debug, Deserialize, Parameters)]
#[serde(deny_unknown_fields)]
pub struct MultilinearElastic {
    /// deformations of the points, ascending
    #[parameter("dᵢ", unit = "m", about = "rad")]
    pub deformation: Vec<f64>,
    /// forces of the points, none against its deformation
    #[parameter("fᵢ", unit = "N", about = "N·m")]
    pub force: Vec<f64>,
    /// local axis
    #[parameter(choices = Axis::NAMES, default = "U1")]
    pub axis: Axis,
}

impl MultilinearElastic {
    fn curve(&self) -> Curve<'_> {
        Curve { d: &self.deformation, f: &self.force }
    }
}

impl Described for MultilinearElastic {
    const CARD: Card = Card::new(
        "MultilinearElastic",
        Category::Link,
        "Elastic spring whose force follows a curve through points.",
    )
    .nodes(NodeCount::GROUND_OR_TWO)
    .parameters(Self::PARAMETERS)
    .law("f = fᵢ + (fᵢ₊₁ − fᵢ)/(dᵢ₊₁ − dᵢ) (d − dᵢ) where dᵢ ≤ d < dᵢ₊₁; the lines at the ends go on")
    .source("CSI Analysis Reference Manual, multilinear elastic property")
    .example(r#""buffer": MultilinearElastic(nodes: ("a", "b"), deformation: ["-50 mm", "-20 mm", "0 mm", "20 mm", "50 mm"], force: ["-400 kN", "-60 kN", "0 kN", "60 kN", "400 kN"])"#)
    .exercise(Exercise::new(1.0, &[Stroke::about(0.0, 0.06)]));

    fn check(&self) -> Result<(), ParameterError> {
        self.curve().check()
    }
}

impl Link for MultilinearElastic {
    fn coordinates(&self) -> Coordinates {
        Coordinates::Local(vec![self.axis])
    }

    fn uses_rates(&self) -> bool {
        false
    }

    fn engaged_stiffness(&self, k: &mut [f64]) {
        k[0] = self.curve().stiffest();
    }

    fn respond(&self, at: &Kinematics<'_>, _: &[f64], _: &mut [f64], out: &mut Response<'_>) {
        (out.f[0], out.k[0]) = self.curve().at(at.d[0]);
        out.energy.stored = self.curve().area(at.d[0]);
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::shared::parameters::read;
    use crate::shared::paths::through;
    use approx::assert_relative_eq;
    use trilith_element::conformance::Kit;
    use trilith_element::{Driver, Value};

    fn law(d: &[f64], f: &[f64]) -> Result<MultilinearElastic, ParameterError> {
        let list = |x: &[f64]| Value::List(x.iter().map(|x| Value::Number(*x)).collect());
        read(&[("deformation", list(d)), ("force", list(f))])
    }

    #[test]
    fn conforms_softening_hardening_falling_and_without_symmetry() {
        for (d, f) in [
            (vec![-8.0, -1.0, 0.0, 1.0, 8.0], vec![-3.0, -2.0, 0.0, 2.0, 3.0]),
            (vec![-8.0, -3.0, 3.0, 8.0], vec![-30.0, -2.0, 2.0, 30.0]),
            (vec![-5.0, 0.0, 2.0, 5.0, 6.0], vec![0.0, 0.0, 4.0, 1.0, 1.0]),
        ] {
            Kit::new(&[6.0], 1.0).rate_independent().assert(&law(&d, &f).unwrap());
        }
    }

    /// Code_Aster SSND103: 2e8 N/m up to 5e4 N, 1e8 N/m beyond, and back on the same way.
    #[test]
    fn unloads_on_the_way_it_came() {
        let law =
            law(&[-1.0, -2.5e-4, 0.0, 2.5e-4, 8e-4], &[-1e8, -5e4, 0.0, 5e4, 1.05e5]).unwrap();
        let mut driver = Driver::new(&law);
        let forces = through(&mut driver, &[2e-4, 8e-4, 2e-4, 0.0]);
        for (f, expected) in forces.iter().zip([4e4, 1.05e5, 4e4, 0.0]) {
            assert_relative_eq!(*f, expected, epsilon = 1e-6);
        }
        assert_eq!((driver.heat(), driver.energy.stored), (0.0, 0.0));
        through(&mut driver, &[8e-4]);
        let area = 0.5 * 5e4 * 2.5e-4 + 0.5 * (5e4 + 1.05e5) * 5.5e-4;
        assert_relative_eq!(driver.energy.stored, area, max_relative = 1e-13);
    }

    #[test]
    fn refuses_a_curve_past_the_origin() {
        let error = law(&[1.0, 2.0], &[1.0, 2.0]).unwrap_err();
        assert_eq!(error.parameter(), Some("deformation"));
    }
}
