//! Truss: straight two-node bar that carries axial force only.
//!
//! ```text
//!   i ●━━━━━━━━━━● j      k = E A / L along the bar
//! ```
//!
//! Only translations are used. The mass acts in all three directions: half at each end, or consistent
//! with linear displacements (1/3 and 1/6 of the mass).
//!
//! Reference: \[Przemieniecki 1968, §5.1 and §11.1\].

use crate::beam::{MassMatrix, span_along_axis_1};
use crate::shared::dense::used;
use nalgebra::DMatrix;
use serde::Deserialize;
use trilith_element::{
    Card, Category, Described, ElementMatrices, Exercise, Geometry, LinearElement, Member,
    NodeCount, ParameterError, Parameters, SpanLoad,
};

/// Bar with axial force only.
#[derive(Clone, Debug, Deserialize, Parameters)]
#[serde(deny_unknown_fields)]
pub struct Truss {
    /// Young's modulus
    #[parameter("E", unit = "Pa", range = Positive)]
    pub young: f64,
    /// area of the section
    #[parameter("A", unit = "m²", range = Positive)]
    pub area: f64,
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
}

impl Described for Truss {
    const CARD: Card =
        Card::new("Truss", Category::Linear, "Two-node bar that carries axial force only.")
            .nodes(NodeCount::exactly(2))
            .parameters(Self::PARAMETERS)
            .law("k = E A / L along the bar")
            .source("Przemieniecki, Theory of Matrix Structural Analysis, 1968, §5.1 and §11.1")
            .example(r#""brace": Truss(nodes: ("a", "b"), young: "210 GPa", area: "12 cm^2")"#)
            .exercise(Exercise::NONE);
}

impl LinearElement for Truss {
    fn matrices(&self, at: &Geometry<'_>) -> Result<ElementMatrices, ParameterError> {
        let length = span_along_axis_1(at, "truss")?;
        let along = at.frame.0[0];
        let k = self.young * self.area / length;
        let string = at.tension / length;
        let mass = (self.density * self.area + self.distributed_mass) * length;
        let [same, other] = match self.mass_matrix {
            MassMatrix::Lumped => [mass / 2.0, 0.0],
            MassMatrix::Consistent => [mass / 3.0, mass / 6.0],
        };
        let (mut stiffness, mut inertia) = (DMatrix::zeros(12, 12), DMatrix::zeros(12, 12));
        for (p, a) in [(0, -1.0), (6, 1.0)] {
            for (q, b) in [(0, -1.0), (6, 1.0)] {
                for i in 0..3 {
                    inertia[(p + i, q + i)] = if p == q { same } else { other };
                    for j in 0..3 {
                        let axial = along[i] * along[j];
                        let across = f64::from(u8::from(i == j)) - axial;
                        stiffness[(p + i, q + j)] = a * b * (k * axial + string * across);
                    }
                }
            }
        }
        Ok(used(&stiffness, &inertia, &DMatrix::zeros(12, 12)))
    }

    fn member(&self) -> Option<&dyn Member> {
        Some(self)
    }
}

impl Member for Truss {
    /// Forces go to the ends by the lever rule, as those of a bar between hinges.
    fn end_loads(&self, at: &Geometry<'_>, load: &SpanLoad) -> Result<[f64; 12], ParameterError> {
        let length = span_along_axis_1(at, "truss")?;
        let mut ends = [0.0; 12];
        if let SpanLoad::Warmth { rise, gradients } = load {
            let Some(alpha) = self.expansion else {
                return Err(ParameterError::inconsistent(
                    "expansion",
                    "warmth needs the strain by one kelvin, `expansion`, or a `material`",
                ));
            };
            if *gradients != [0.0; 2] {
                return Err(ParameterError::geometry(
                    "a truss does not bend: it takes a `rise`, no gradients",
                ));
            }
            let axial = self.young * self.area * alpha * rise;
            (ends[0], ends[6]) = (-axial, axial);
            return Ok(ends);
        }
        let mut turns = false;
        load.over([0.0, f64::INFINITY], |x, q| {
            let along = (x / length).min(1.0);
            for i in 0..3 {
                ends[i] += (1.0 - along) * q[i];
                ends[i + 6] += along * q[i];
            }
            turns |= q[3..].iter().any(|m| *m != 0.0);
        });
        if turns {
            return Err(ParameterError::geometry("a truss takes no moments along its span"));
        }
        Ok(ends)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::shared::parameters::read;
    use approx::assert_relative_eq;
    use trilith_element::{Dof, Frame, Value};

    fn matrices(density: f64, mass: &str, j: [f64; 3]) -> ElementMatrices {
        let n = Value::Number;
        let given = [
            ("young", n(2e11)),
            ("area", n(1e-3)),
            ("density", n(density)),
            ("mass_matrix", Value::Text(mass.into())),
        ];
        let truss: Truss = read(&given).unwrap();
        let nodes = [[0.0; 3], j];
        let frame = Frame::of_nodes(&nodes, None, None).unwrap();
        truss.matrices(&Geometry::new(&nodes, frame)).unwrap()
    }

    #[test]
    fn a_massless_bar_along_x_uses_ux_only() {
        let got = matrices(0.0, "Lumped", [4.0, 0.0, 0.0]);
        assert_eq!(got.dofs, [(0, Dof::Ux), (1, Dof::Ux)]);
        assert_eq!(got.stiffness.values(), [5e7, -5e7, -5e7, 5e7]);
    }

    #[test]
    fn an_inclined_bar_resists_along_itself_with_ea_over_l() {
        let got = matrices(0.0, "Lumped", [3.0, 0.0, 4.0]);
        assert_eq!(got.dofs.len(), 4);
        assert_relative_eq!(got.stiffness[(2, 2)], 4e7 * 0.36, max_relative = 1e-12);
        assert_relative_eq!(got.stiffness[(2, 3)], 4e7 * 0.48, max_relative = 1e-12);
        assert_relative_eq!(got.stiffness[(0, 3)], -4e7 * 0.48, max_relative = 1e-12);
    }

    #[test]
    fn both_mass_matrices_weigh_the_same_in_every_direction() {
        for kind in ["Lumped", "Consistent"] {
            let got = matrices(8000.0, kind, [3.0, 0.0, 4.0]);
            assert_eq!(got.dofs.len(), 6);
            let total: f64 = got.mass.values().iter().sum();
            assert_relative_eq!(total, 3.0 * 8000.0 * 1e-3 * 5.0, max_relative = 1e-12);
        }
    }
}
