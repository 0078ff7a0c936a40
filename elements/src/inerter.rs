//! Inerter: a force proportional to the relative acceleration of its ends.
//!
//! ```text
//!   f = b δ̈       δ: deformation along or about the local axis (one node: against the ground)
//! ```
//!
//! The inertance has no weight, does not count as mass of the structure and meets a moving ground only
//! through the motion relative to it; kinetic energy, modes and damping proportional to the mass hold
//! it. Two nodes apart are joined by a rigid arm from i to j, with the inerter at j. For a
//! tuned-mass-damper-inerter put springs and dashpots beside or in series with it; a point between
//! needs no mass of its own.
//!
//! Reference: \[Smith 2002\].

use crate::shared::dense::deformations;
use serde::Deserialize;
use trilith_element::{
    Axis, Card, Category, Described, Dof, ElementMatrices, Exercise, Geometry, LinearElement,
    NodeCount, ParameterError, Parameters,
};

/// Inertance between two nodes, or a node and the ground.
#[derive(Clone, Debug, Deserialize, Parameters)]
#[serde(deny_unknown_fields)]
pub struct Inerter {
    /// inertance
    #[parameter("b", unit = "kg", about = "kg·m²", range = Positive)]
    pub b: f64,
    /// local axis
    #[parameter(choices = Axis::NAMES, default = "U1")]
    pub axis: Axis,
}

impl Described for Inerter {
    const CARD: Card = Card::new(
        "Inerter",
        Category::Linear,
        "Force proportional to the relative acceleration of its ends.",
    )
    .nodes(NodeCount::GROUND_OR_TWO)
    .parameters(Self::PARAMETERS)
    .law("f = b δ̈; without weight, and without load from a motion of the ground")
    .source("Smith, Synthesis of mechanical networks: the inerter, 2002")
    .example(r#""inerter": Inerter(nodes: ("a", "b"), b: "20 t")"#)
    .exercise(Exercise::NONE);
}

impl LinearElement for Inerter {
    fn matrices(&self, at: &Geometry<'_>) -> Result<ElementMatrices, ParameterError> {
        let rows = deformations(at);
        let row = rows.row(self.axis.index());
        // A direction cosine that is nothing but rounding uses no DOF.
        let noise = 1e-12 * row.amax();
        let used: Vec<usize> = (0..row.len()).filter(|i| row[*i].abs() > noise).collect();
        let dofs = used.iter().map(|i| (i / 6, Dof::ALL[i % 6])).collect();
        let mut out = ElementMatrices::zeros(dofs);
        for (p, &i) in used.iter().enumerate() {
            for (q, &j) in used.iter().enumerate() {
                out.inertance[(p, q)] = self.b * (row[i] * row[j]);
            }
        }
        Ok(out)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::shared::parameters::{numbers, read};
    use approx::assert_relative_eq;
    use trilith_element::{Frame, Value};

    fn matrices(given: &[(&str, Value)], nodes: &[[f64; 3]]) -> ElementMatrices {
        let inerter: Inerter = read(given).unwrap();
        let frame = Frame::of_nodes(nodes, None, None).unwrap();
        inerter.matrices(&Geometry::new(nodes, frame)).unwrap()
    }

    #[test]
    fn a_grounded_inerter_uses_one_dof_and_is_no_mass() {
        let got = matrices(&numbers(&[("b", 3.0)]), &[[1.0, 2.0, 3.0]]);
        assert_eq!(got.dofs, [(0, Dof::Uz)]);
        assert_eq!(got.inertance.values(), [3.0]);
        assert!(got.mass.is_zero() && got.stiffness.is_zero() && got.damping.is_zero());
    }

    #[test]
    fn two_nodes_get_the_difference_along_the_line_between_them() {
        let got = matrices(&numbers(&[("b", 2.0)]), &[[0.0; 3], [3.0, 4.0, 0.0]]);
        assert_eq!(got.dofs.len(), 4);
        let n = [-0.6, -0.8, 0.6, 0.8];
        for i in 0..4 {
            for j in 0..4 {
                assert_relative_eq!(got.inertance[(i, j)], 2.0 * n[i] * n[j], epsilon = 1e-14);
            }
        }
    }

    #[test]
    fn about_an_axis_it_joins_rotations_and_across_it_has_an_arm() {
        let about = [("b", Value::Number(5.0)), ("axis", Value::Text("R1".into()))];
        let got = matrices(&about, &[[0.0; 3], [2.0, 0.0, 0.0]]);
        assert_eq!(got.dofs, [(0, Dof::Rx), (1, Dof::Rx)]);
        assert_eq!(got.inertance.values(), [5.0, -5.0, -5.0, 5.0]);
        let across = [("b", Value::Number(5.0)), ("axis", Value::Text("U2".into()))];
        let got = matrices(&across, &[[0.0; 3], [2.0, 0.0, 0.0]]);
        // Turning both nodes and moving j with them costs nothing.
        let rotation = got.dofs.iter().position(|d| d.0 == 0 && d.1.index() > 2).unwrap();
        assert_relative_eq!(got.inertance[(rotation, rotation)], 20.0, max_relative = 1e-12);
    }
}
