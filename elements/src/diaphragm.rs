//! Diaphragm: nodes of a floor that is rigid in its plane; the first node leads.
//!
//! ```text
//!   normal Z:  ux_s = ux_m − θz_m (y_s − y_m),   uy_s = uy_m + θz_m (x_s − x_m),   θz_s = θz_m
//! ```
//!
//! The three other DOFs of every node stay free. Distances along the normal do not matter.
//!
//! Reference: \[Wilson 2002, ch. 7\].

use crate::shared::dense::between;
use serde::Deserialize;
use trilith_element::{
    Card, Category, Choices, Constraint, Described, Dof, Equation, Exercise, NodeCount,
    ParameterError, Parameters, Vector3,
};

/// A global direction.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Deserialize, Choices)]
pub enum Normal {
    /// Global X.
    X,
    /// Global Y.
    Y,
    /// Global Z.
    Z,
}

/// Floor that is rigid in its plane.
#[derive(Clone, Debug, Deserialize, Parameters)]
#[serde(deny_unknown_fields)]
pub struct Diaphragm {
    /// direction normal to the floor
    #[parameter(choices = Normal::NAMES, default = "Z")]
    pub normal: Normal,
}

impl Described for Diaphragm {
    const CARD: Card = Card::new(
        "Diaphragm",
        Category::Constraint,
        "Floor that is rigid in its plane; the first node leads, the others follow.",
    )
    .nodes(NodeCount::at_least(2))
    .parameters(Self::PARAMETERS)
    .law("normal Z: ux_s = ux_m − θz_m (y_s − y_m), uy_s = uy_m + θz_m (x_s − x_m), θz_s = θz_m")
    .source("Wilson, Static and Dynamic Analysis of Structures, 2002, ch. 7")
    .example(r#""floor": Diaphragm(nodes: ("centre", "a", "b", "c", "d"))"#)
    .exercise(Exercise::NONE);
}

impl Constraint for Diaphragm {
    fn equations(&self, nodes: &[Vector3]) -> Result<Vec<Equation>, ParameterError> {
        let n = self.normal as usize;
        let (a, b) = ((n + 1) % 3, (n + 2) % 3);
        let about = Dof::ALL[3 + n];
        let Some((lead, rest)) = nodes.split_first() else { return Ok(Vec::new()) };
        let mut out = Vec::with_capacity(3 * rest.len());
        for (s, x) in rest.iter().enumerate() {
            let r = between(*lead, *x);
            // a, b, n is a right-handed triad: n × a = b and n × b = −a.
            for (dof, arm) in [(Dof::ALL[a], -r[b]), (Dof::ALL[b], r[a])] {
                let mut terms = vec![((0, dof), 1.0), ((0, about), arm)];
                terms.retain(|(_, c)| *c != 0.0);
                out.push(Equation::new((s + 1, dof), terms));
            }
            out.push(Equation::new((s + 1, about), vec![((0, about), 1.0)]));
        }
        Ok(out)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::RigidBody;

    #[test]
    fn moves_in_its_plane_like_a_rigid_body_at_one_height() {
        let nodes = [[1.0, 2.0, 3.0], [4.0, -2.0, 3.0]];
        for (normal, flat) in [(Normal::X, 0), (Normal::Y, 1), (Normal::Z, 2)] {
            let mut nodes = nodes;
            nodes[1][flat] = nodes[0][flat];
            let rigid = RigidBody { corners: Vec::new() }.equations(&nodes).unwrap();
            let in_plane = Diaphragm { normal }.equations(&nodes).unwrap();
            assert_eq!(in_plane.len(), 3);
            for e in in_plane {
                let mut same = rigid.iter().find(|r| r.dependent == e.dependent).unwrap().clone();
                // What is left of a rigid body are the terms of the plane.
                same.terms.retain(|t| e.terms.iter().any(|x| x.0 == t.0));
                assert_eq!(e, same);
            }
        }
    }

    #[test]
    fn the_height_of_a_node_does_not_matter() {
        let floor = Diaphragm { normal: Normal::Z };
        let low = floor.equations(&[[0.0; 3], [1.0, 2.0, 0.0]]).unwrap();
        assert_eq!(low, floor.equations(&[[0.0; 3], [1.0, 2.0, 5.0]]).unwrap());
    }
}
