//! Equal DOF: chosen DOFs of the other nodes equal those of the first.
//!
//! ```text
//!   u_s[dof] = u_m[dof]
//! ```
//!
//! Distances between the nodes do not matter: equal displacements of nodes apart resist rotation.
//!
//! Reference: \[Bathe 1996, §4.2.2\].

use serde::Deserialize;
use trilith_element::{
    Card, Category, Choices, Constraint, Described, Dof, Equation, Exercise, NodeCount,
    ParameterError, Parameters, Vector3,
};

/// A DOF by its name.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Choices, Deserialize)]
pub enum DofName {
    /// Displacement along X.
    Ux,
    /// Displacement along Y.
    Uy,
    /// Displacement along Z.
    Uz,
    /// Rotation about X.
    Rx,
    /// Rotation about Y.
    Ry,
    /// Rotation about Z.
    Rz,
}

/// Equal DOFs of several nodes.
#[derive(Clone, Debug, Deserialize, Parameters)]
#[serde(deny_unknown_fields)]
pub struct EqualDof {
    /// which DOFs
    #[parameter(choices = DofName::NAMES)]
    pub dofs: Vec<DofName>,
}

impl Described for EqualDof {
    const CARD: Card = Card::new(
        "EqualDof",
        Category::Constraint,
        "Chosen DOFs of the other nodes equal those of the first.",
    )
    .nodes(NodeCount::at_least(2))
    .parameters(Self::PARAMETERS)
    .law("u_s[dof] = u_m[dof]")
    .source("Bathe, Finite Element Procedures, 1996, §4.2.2")
    .example(r#""hinge": EqualDof(nodes: ("a", "b"), dofs: (Ux, Uz))"#)
    .exercise(Exercise::NONE);

    fn check(&self) -> Result<(), ParameterError> {
        let twice = self.dofs.iter().enumerate().any(|(i, d)| self.dofs[..i].contains(d));
        if self.dofs.is_empty() || twice {
            let message = "`dofs` needs at least one DOF, and each once";
            return Err(ParameterError::inconsistent("dofs", message));
        }
        Ok(())
    }
}

impl Constraint for EqualDof {
    fn equations(&self, nodes: &[Vector3]) -> Result<Vec<Equation>, ParameterError> {
        let each = |s: usize| {
            self.dofs.iter().map(move |name| {
                let dof = Dof::ALL[*name as usize];
                Equation::new((s, dof), vec![((0, dof), 1.0)])
            })
        };
        Ok((1..nodes.len()).flat_map(each).collect())
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::shared::parameters::read;
    use trilith_element::Value;

    #[test]
    fn names_become_equations_of_every_following_node() {
        let list = Value::List(vec![Value::Text("Ux".into()), Value::Text("Ry".into())]);
        let equal: EqualDof = read(&[("dofs", list)]).unwrap();
        let got = equal.equations(&[[0.0; 3], [1.0; 3], [2.0; 3]]).unwrap();
        let pairs: Vec<_> = got.iter().map(|e| e.dependent).collect();
        assert_eq!(pairs, [(1, Dof::Ux), (1, Dof::Ry), (2, Dof::Ux), (2, Dof::Ry)]);
        assert!(got.iter().all(|e| e.terms == [((0, e.dependent.1), 1.0)]));
    }

    #[test]
    fn refuses_none_and_the_same_twice() {
        assert!(read::<EqualDof>(&[("dofs", Value::List(vec![]))]).is_err());
        let twice = Value::List(vec![Value::Text("Ux".into()), Value::Text("Ux".into())]);
        assert!(read::<EqualDof>(&[("dofs", twice)]).is_err());
    }
}
