//! What an element or a constraint can break.

use crate::{ElementFault, ParameterError};

/// A property of a linear element or a constraint that does not hold. Nodes are counted from 1.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum StructureError {
    /// It refuses the place that it was given.
    #[error(transparent)]
    Refused(#[from] ParameterError),
    /// Matrices or equations that cannot be.
    #[error(transparent)]
    Fault(#[from] ElementFault),
    /// Equal questions got different answers.
    #[error("asked again, it answers otherwise: {what}")]
    Impure {
        /// Which matrix, or the equations.
        what: &'static str,
    },
    /// A motion as a rigid body meets a force, or breaks an equation.
    #[error("{motion} as a rigid body meets {what}: {value:e} at node {node} {direction}")]
    Rigid {
        /// Such as `a rotation about Z`.
        motion: &'static str,
        /// What it meets, such as `stiffness`.
        what: &'static str,
        /// Node.
        node: usize,
        /// Direction.
        direction: &'static str,
        /// The force, or what is left of the equation.
        value: f64,
    },
    /// In another place it is another one.
    #[error(
        "{how}, its {what} is another one: {value:e} for {expected:e} between node {} {} and node {} {}",
        .row.0, .row.1, .column.0, .column.1
    )]
    Place {
        /// `moved` or `turned`.
        how: &'static str,
        /// Which matrix.
        what: &'static str,
        /// Node and direction of the row.
        row: (usize, &'static str),
        /// Node and direction of the column.
        column: (usize, &'static str),
        /// What it is there.
        value: f64,
        /// What it should be.
        expected: f64,
    },
    /// Two halves in a row are not the whole.
    #[error(
        "two halves in a row are not the whole: stiffness {halves:e} for {whole:e} between node {} {} and node {} {}",
        .row.0, .row.1, .column.0, .column.1
    )]
    Halves {
        /// Node and direction of the row.
        row: (usize, &'static str),
        /// Node and direction of the column.
        column: (usize, &'static str),
        /// What the halves have.
        halves: f64,
        /// What the whole has.
        whole: f64,
    },
    /// An equation whose DOF is among its terms, or goes by another one as well.
    #[error("node {node} {direction} {why}")]
    Dependent {
        /// Node.
        node: usize,
        /// Direction.
        direction: &'static str,
        /// Why it cannot go.
        why: &'static str,
    },
}

/// Names of the motions as a rigid body.
pub(super) const MOTIONS: [&str; 6] = [
    "a translation along X",
    "a translation along Y",
    "a translation along Z",
    "a rotation about X",
    "a rotation about Y",
    "a rotation about Z",
];
