//! Constraints: linear equations between DOFs, eliminated and never penalised.

use crate::{Dof, NodalOutline, ParameterError, Vector3};
use std::fmt::Debug;

/// `u[dependent] = Σ coefficient · u[retained]`.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub struct Equation {
    /// The DOF that goes: index into the constraint's nodes, and direction.
    pub dependent: (usize, Dof),
    /// The DOFs that stay, with their coefficients.
    pub terms: Vec<((usize, Dof), f64)>,
}

impl Equation {
    /// A DOF as a sum of others with coefficients.
    #[must_use]
    pub const fn new(dependent: (usize, Dof), terms: Vec<((usize, Dof), f64)>) -> Self {
        Self { dependent, terms }
    }
}

/// Removes DOFs: rigid links, rigid bodies, diaphragms, equal DOFs.
pub trait Constraint: Send + Sync + Debug {
    /// The equations for nodes at these positions (m), in the order of the model file.
    ///
    /// # Errors
    /// [`ParameterError::Geometry`] where the nodes do not suit.
    fn equations(&self, nodes: &[Vector3]) -> Result<Vec<Equation>, ParameterError>;

    /// What it looks like in a picture, for constraints that know. Others are drawn as lines between the nodes that lead
    /// and those that follow.
    fn outline(&self, _nodes: &[Vector3]) -> Option<NodalOutline> {
        None
    }
}
