//! Rigid body: the first node leads, the others follow as parts of the same rigid body.
//!
//! ```text
//!   u_s = u_m + θ_m × r,   θ_s = θ_m,   r = x_s − x_m        (small rotations)
//! ```
//!
//! All six DOFs of every following node are eliminated. A following node must not be fixed nor follow
//! anything else. Mass and inertia are separate `Mass` elements at any of the nodes.
//!
//! Reference: \[Bathe 1996, §4.2.2\].

use crate::shared::dense::between;
use serde::Deserialize;
use trilith_element::{
    Card, Category, Constraint, Described, Dof, Equation, Exercise, NodalOutline, NodeCount,
    ParameterError, Parameters, Vector3,
};

/// Several nodes that move as one rigid body; the law is on top of this page's source file.
#[derive(Clone, Debug, Deserialize, Parameters)]
#[serde(deny_unknown_fields)]
pub struct RigidBody {
    /// corners of the body from its first node, in order; only drawn
    #[parameter(form = Points)]
    #[serde(default)]
    pub corners: Vec<Vector3>,
}

impl Described for RigidBody {
    const CARD: Card = Card::new(
        "RigidBody",
        Category::Constraint,
        "Nodes that move as one rigid body; the first leads, the others follow.",
    )
    .nodes(NodeCount::at_least(2))
    .parameters(Self::PARAMETERS)
    .law("u_s = u_m + θ_m × r\nθ_s = θ_m\nr   = x_s − x_m")
    .source("Kinematics of a rigid body at small rotations; Bathe, Finite Element Procedures, 1996, §4.2.2")
    .example(r#""block": RigidBody(nodes: ("cg", "left", "right"))"#)
    .exercise(Exercise::NONE);
}

impl Constraint for RigidBody {
    fn equations(&self, nodes: &[Vector3]) -> Result<Vec<Equation>, ParameterError> {
        let Some((lead, rest)) = nodes.split_first() else { return Ok(Vec::new()) };
        let follow = rest.iter().enumerate();
        Ok(follow.flat_map(|(s, x)| rigid_equations(s + 1, *lead, *x, true)).collect())
    }

    fn outline(&self, _: &[Vector3]) -> Option<NodalOutline> {
        (!self.corners.is_empty()).then(|| NodalOutline::default().and_face(0, &self.corners))
    }
}

/// The equations of node `s` at `x` that follows node 0 at `lead`.
pub(crate) fn rigid_equations(
    s: usize,
    lead: Vector3,
    x: Vector3,
    with_rotations: bool,
) -> Vec<Equation> {
    let r = between(lead, x);
    let mut out = Vec::with_capacity(6);
    for i in 0..3 {
        let mut terms = vec![((0, Dof::ALL[i]), 1.0)];
        // (θ × r)_i = θ_j r_k − θ_k r_j for i, j, k in turn.
        let (j, k) = ((i + 1) % 3, (i + 2) % 3);
        terms.push(((0, Dof::ALL[3 + j]), r[k]));
        terms.push(((0, Dof::ALL[3 + k]), -r[j]));
        terms.retain(|(_, c)| *c != 0.0);
        out.push(Equation::new((s, Dof::ALL[i]), terms));
    }
    if with_rotations {
        for dof in [Dof::Rx, Dof::Ry, Dof::Rz] {
            out.push(Equation::new((s, dof), vec![((0, dof), 1.0)]));
        }
    }
    out
}

#[cfg(test)]
mod tests {
    use super::*;
    use nalgebra::Vector3 as V3;

    #[test]
    fn corners_are_drawn_as_one_face_and_change_no_equation() {
        let nodes = [[0.0, 0.0, 2.0], [-1.0, 0.0, 0.0]];
        let corners = vec![[-1.0, 0.0, -2.0], [1.0, 0.0, -2.0], [1.0, 0.0, 2.0]];
        let (plain, drawn) = (RigidBody { corners: Vec::new() }, RigidBody { corners });
        assert_eq!(plain.equations(&nodes).unwrap(), drawn.equations(&nodes).unwrap());
        assert_eq!(plain.outline(&nodes), None);
        assert_eq!(drawn.outline(&nodes).unwrap().paths, [[0, 1, 2, 0]]);
    }

    #[test]
    fn followers_move_by_u_plus_theta_cross_r() {
        let nodes = [[1.0, 2.0, 3.0], [4.0, -1.0, 0.5], [1.0, 2.0, 8.0]];
        let (u, theta) = (V3::new(0.1, -0.2, 0.3), V3::new(1e-3, 2e-3, -5e-3));
        let lead = [u[0], u[1], u[2], theta[0], theta[1], theta[2]];
        let equations = RigidBody { corners: Vec::new() }.equations(&nodes).unwrap();
        assert_eq!(equations.len(), 12);
        for e in equations {
            let (s, dof) = e.dependent;
            let moved = u + theta.cross(&between(nodes[0], nodes[s]));
            let expected =
                if dof.is_rotation() { theta[dof.index() - 3] } else { moved[dof.index()] };
            let got: f64 = e
                .terms
                .iter()
                .map(|((n, d), c)| {
                    assert_eq!(*n, 0);
                    c * lead[d.index()]
                })
                .sum();
            approx::assert_relative_eq!(got, expected, max_relative = 1e-14);
        }
    }
}
