//! Rigid link: the second node follows the first as part of the same rigid body.
//!
//! ```text
//!   u_j = u_i + θ_i × r,   r = x_j − x_i (small rotations);   θ_j = θ_i unless `translations_only`
//! ```
//!
//! Reference: \[Bathe 1996, §4.2.2\].

use crate::rigid_body::rigid_equations;
use serde::Deserialize;
use trilith_element::{
    Card, Category, Constraint, Described, Equation, Exercise, NodeCount, ParameterError,
    Parameters, Vector3,
};

/// Rigid link of two nodes.
#[derive(Clone, Debug, Deserialize, Parameters)]
#[serde(deny_unknown_fields)]
pub struct RigidLink {
    /// the rotations of the second node stay free (a hinge there)
    #[parameter]
    #[serde(default)]
    pub translations_only: bool,
}

impl Described for RigidLink {
    const CARD: Card = Card::new(
        "RigidLink",
        Category::Constraint,
        "The second node follows the first as part of the same rigid body.",
    )
    .nodes(NodeCount::exactly(2))
    .parameters(Self::PARAMETERS)
    .law("u_j = u_i + θ_i × (x_j − x_i)\nθ_j = θ_i, unless `translations_only`")
    .source("Kinematics of a rigid body at small rotations; Bathe, Finite Element Procedures, 1996, §4.2.2")
    .example(r#""arm": RigidLink(nodes: ("column", "corner"))"#)
    .exercise(Exercise::NONE);
}

impl Constraint for RigidLink {
    fn equations(&self, nodes: &[Vector3]) -> Result<Vec<Equation>, ParameterError> {
        match nodes {
            [i, j] => Ok(rigid_equations(1, *i, *j, !self.translations_only)),
            _ => Err(ParameterError::geometry("a rigid link needs two nodes")),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use trilith_element::Dof;

    #[test]
    fn translations_only_leaves_the_rotations_free() {
        let nodes = [[0.0; 3], [1.0, 0.0, 2.0]];
        let all = RigidLink { translations_only: false }.equations(&nodes).unwrap();
        let some = RigidLink { translations_only: true }.equations(&nodes).unwrap();
        assert_eq!((all.len(), some.len()), (6, 3));
        let terms = vec![((0, Dof::Uz), 1.0), ((0, Dof::Ry), -1.0)];
        assert_eq!(some[2], Equation::new((1, Dof::Uz), terms));
    }
}
