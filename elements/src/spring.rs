//! Spring: linear spring and dashpot in six directions, between two nodes or a node and the ground.
//!
//! ```text
//!   f = K δ + C δ̇
//!   δ_t = R (u_j − u_i − θ_i × r),   δ_r = R (θ_j − θ_i)       r = x_j − x_i, R: local axes
//!   one node: δ = R (u, θ)
//! ```
//!
//! Two nodes apart are joined by a rigid arm from i to j, and the spring sits at j: a rigid motion of
//! both nodes costs nothing, and forces and moments are in equilibrium. Directions without stiffness
//! and damping use no DOF.
//!
//! Reference: \[Wilson 2002, ch. 4\].

use crate::shared::dense::{deformations, is_semi_definite, used};
use nalgebra::DMatrix;
use serde::Deserialize;
use trilith_element::{
    Card, Category, Described, Dimension, ElementMatrices, Exercise, Geometry, LinearElement,
    NodeCount, ParameterError, Parameters,
};

/// A symmetric 6 × 6 matrix in local axes.
type Matrix6 = [[f64; 6]; 6];

/// Linear spring and dashpot.
#[derive(Clone, Debug, std::default::Default, Deserialize, Parameters)]
#[serde(deny_unknown_fields, default)]
pub struct Spring {
    /// stiffness along local 1
    #[parameter("k₁", unit = "N/m", range = NonNegative, default = 0.0)]
    pub k1: f64,
    /// stiffness along local 2
    #[parameter("k₂", unit = "N/m", range = NonNegative, default = 0.0)]
    pub k2: f64,
    /// stiffness along local 3
    #[parameter("k₃", unit = "N/m", range = NonNegative, default = 0.0)]
    pub k3: f64,
    /// stiffness about local 1
    #[parameter("r₁", unit = "N·m/rad", range = NonNegative, default = 0.0)]
    pub r1: f64,
    /// stiffness about local 2
    #[parameter("r₂", unit = "N·m/rad", range = NonNegative, default = 0.0)]
    pub r2: f64,
    /// stiffness about local 3
    #[parameter("r₃", unit = "N·m/rad", range = NonNegative, default = 0.0)]
    pub r3: f64,
    /// damping along local 1
    #[parameter("c₁", unit = "N·s/m", range = NonNegative, default = 0.0)]
    pub c1: f64,
    /// damping along local 2
    #[parameter("c₂", unit = "N·s/m", range = NonNegative, default = 0.0)]
    pub c2: f64,
    /// damping along local 3
    #[parameter("c₃", unit = "N·s/m", range = NonNegative, default = 0.0)]
    pub c3: f64,
    /// damping about local 1
    #[parameter("cr₁", unit = "N·m·s/rad", range = NonNegative, default = 0.0)]
    pub cr1: f64,
    /// damping about local 2
    #[parameter("cr₂", unit = "N·m·s/rad", range = NonNegative, default = 0.0)]
    pub cr2: f64,
    /// damping about local 3
    #[parameter("cr₃", unit = "N·m·s/rad", range = NonNegative, default = 0.0)]
    pub cr3: f64,
    /// full matrix in local axes, added to the diagonal entries
    #[parameter("K", form = Matrix { size: 6, dimension: Dimension { mass: 1.0, length: 0.0, time: -2.0 }, symmetric: true })]
    pub stiffness: Option<Matrix6>,
    /// full matrix in local axes, added to the diagonal entries
    #[parameter("C", form = Matrix { size: 6, dimension: Dimension { mass: 1.0, length: 0.0, time: -1.0 }, symmetric: true })]
    pub damping: Option<Matrix6>,
}

impl Described for Spring {
    const CARD: Card = Card::new(
        "Spring",
        Category::Linear,
        "Linear spring and dashpot in six directions, between two nodes or to the ground.",
    )
    .nodes(NodeCount::GROUND_OR_TWO)
    .parameters(Self::PARAMETERS)
    .law(
        "f = K δ + C δ̇\n\
              δ = R (u_j − u_i − θ_i × (x_j − x_i), θ_j − θ_i); one node: δ = R (u, θ)",
    )
    .source("Wilson, Static and Dynamic Analysis of Structures, 2002, ch. 4")
    .example(r#""soil": Spring(node: "base", k1: "80 MN/m", c1: "1 MN*s/m")"#)
    .exercise(Exercise::NONE);

    fn check(&self) -> Result<(), ParameterError> {
        for (name, full) in [("stiffness", &self.stiffness), ("damping", &self.damping)] {
            if full.is_some_and(|a| !is_semi_definite(&DMatrix::from_fn(6, 6, |i, j| a[i][j]))) {
                let message = format!("`{name}` must be symmetric and positive semi-definite");
                return Err(ParameterError::inconsistent(name, message));
            }
        }
        Ok(())
    }
}

impl LinearElement for Spring {
    fn matrices(&self, at: &Geometry<'_>) -> Result<ElementMatrices, ParameterError> {
        let k = [self.k1, self.k2, self.k3, self.r1, self.r2, self.r3];
        let c = [self.c1, self.c2, self.c3, self.cr1, self.cr2, self.cr3];
        let b = deformations(at);
        let assembled = |diagonal: [f64; 6], full: &Option<Matrix6>| {
            let mut sum = full.map_or_else(
                || DMatrix::zeros(b.ncols(), b.ncols()),
                |a| b.transpose() * DMatrix::from_fn(6, 6, |i, j| a[i][j]) * &b,
            );
            for (i, x) in diagonal.into_iter().enumerate().filter(|(_, x)| *x != 0.0) {
                let row = b.row(i).transpose();
                sum.ger(x, &row, &row, 1.0);
            }
            sum
        };
        let none = DMatrix::zeros(b.ncols(), b.ncols());
        Ok(used(&assembled(k, &self.stiffness), &none, &assembled(c, &self.damping)))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::shared::dense::between;
    use crate::shared::parameters::{numbers, read};
    use approx::assert_relative_eq;
    use nalgebra::Vector3 as V3;
    use trilith_element::{Dof, Frame, Value};

    fn matrices(spring: &Spring, nodes: &[[f64; 3]]) -> ElementMatrices {
        let frame = Frame::of_nodes(nodes, None, None).unwrap();
        spring.matrices(&Geometry::new(nodes, frame)).unwrap()
    }

    #[test]
    fn a_grounded_spring_stands_upright_and_uses_one_dof() {
        let spring: Spring = read(&numbers(&[("k1", 3.0), ("c1", 2.0)])).unwrap();
        let got = matrices(&spring, &[[1.0, 2.0, 3.0]]);
        assert_eq!(got.dofs, [(0, Dof::Uz)]);
        assert_eq!((got.stiffness[(0, 0)], got.damping[(0, 0)]), (3.0, 2.0));
        let spring: Spring = read(&numbers(&[("cr2", 5.0)])).unwrap();
        assert_eq!(matrices(&spring, &[[0.0; 3]]).dofs, [(0, Dof::Rx)]);
    }

    #[test]
    fn coincident_nodes_get_the_difference() {
        let spring = Spring { k2: 7.0, ..Spring::default() };
        let got = matrices(&spring, &[[0.0; 3]; 2]);
        assert_eq!(got.dofs, [(0, Dof::Ux), (1, Dof::Ux)]);
        assert_eq!(got.stiffness.values(), [7.0, -7.0, -7.0, 7.0]);
    }

    #[test]
    fn a_rigid_motion_of_nodes_apart_costs_nothing() {
        let spring =
            Spring { k1: 5.0, k2: 7.0, k3: 9.0, r1: 2.0, r2: 3.0, r3: 4.0, ..Spring::default() };
        let nodes = [[1.0, 0.0, 2.0], [2.0, -1.0, 4.0]];
        let got = matrices(&spring, &nodes);
        assert_eq!(got.dofs.len(), 12);
        let r = between(nodes[0], nodes[1]);
        for i in 0..3 {
            let mut theta = V3::zeros();
            theta[i] = 1.0;
            let moved = theta.cross(&r);
            let u: Vec<f64> =
                [V3::zeros(), theta, moved, theta].iter().flat_map(|v| v.iter().copied()).collect();
            for row in 0..12 {
                let force: f64 = (0..12).map(|q| got.stiffness[(row, q)] * u[q]).sum();
                assert!(force.abs() < 1e-12);
            }
        }
        // The spring sits at j: a shear there bends i by the whole arm and j not at all.
        assert_relative_eq!(
            got.stiffness[(9, 9)] + got.stiffness[(10, 10)] + got.stiffness[(11, 11)],
            9.0,
            max_relative = 1e-12
        );
    }

    #[test]
    fn a_coupled_matrix_arrives_and_an_indefinite_one_is_refused() {
        let rows = |coupling: f64| {
            let value = |i: usize, j: usize| match (i, j) {
                (0, 0) | (1, 1) => 2.0,
                (0, 1) | (1, 0) => coupling,
                _ => 0.0,
            };
            let row = |i| Value::List((0..6).map(|j| Value::Number(value(i, j))).collect());
            Value::List((0..6).map(row).collect())
        };
        let spring: Spring = read(&[("stiffness", rows(1.0))]).unwrap();
        let got = matrices(&spring, &[[0.0; 3]]);
        assert_eq!(got.dofs, [(0, Dof::Ux), (0, Dof::Uz)]);
        assert_eq!(got.stiffness.values(), [2.0, 1.0, 1.0, 2.0]);
        let err = read::<Spring>(&[("damping", rows(3.0))]).unwrap_err();
        assert_eq!(err.parameter(), Some("damping"));
    }
}
