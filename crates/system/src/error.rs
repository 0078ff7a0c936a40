//! What can be wrong with a model as a structure.

use trilith_linalg::LinalgError;
use trilith_model::Span;

/// A structure that cannot be assembled.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum SystemError {
    /// An element refuses its parameters or nodes.
    #[error("element \"{element}\": {reason}")]
    Element {
        /// Name of the element.
        element: String,
        /// What is wrong.
        reason: String,
        /// Where the file defines it.
        span: Span,
    },
    /// Constraints that depend on each other in a circle.
    #[error("the constraints {} depend on each other in a circle: each lets a node follow that another one moves", .elements.join(", "))]
    Cycle {
        /// Names of the constraints.
        elements: Vec<String>,
        /// Where the file defines the first.
        span: Span,
    },
    /// A constraint that ties DOFs whose motion is prescribed.
    #[error(
        "constraint \"{element}\" contradicts the prescribed motion of the supports it ties together"
    )]
    Overdetermined {
        /// Name of the constraint.
        element: String,
        /// Where the file defines it.
        span: Span,
    },
    /// Directions that neither stiffness nor mass holds.
    #[error("{}", unsupported_text(.directions, *.with_mass))]
    Unsupported {
        /// Node and direction of each.
        directions: Vec<(String, &'static str)>,
        /// True where masses were counted as support (dynamics), false in a static analysis.
        with_mass: bool,
        /// Where the file defines the first node.
        span: Span,
    },
    /// A sum of the structure's matrices has left the range of numbers.
    #[error(
        "{what} of node \"{node}\" {direction} is beyond all bounds: a length, a stiffness, a mass or the damping of what acts there is absurdly large"
    )]
    Overflow {
        /// `the stiffness`, `the mass` or `the damping`.
        what: &'static str,
        /// Name of the node.
        node: String,
        /// Direction.
        direction: &'static str,
        /// Where the file defines the node.
        span: Span,
    },
    /// Nothing is left to be solved for, and nothing is led.
    #[error(
        "the model has no free direction that an element or a link acts on, and no case moves a support"
    )]
    Empty,
    /// The backend failed.
    #[error(transparent)]
    Linalg(#[from] LinalgError),
}

impl SystemError {
    /// The place in the model file, where there is one.
    #[must_use]
    pub fn span(&self) -> Option<Span> {
        match self {
            Self::Element { span, .. }
            | Self::Cycle { span, .. }
            | Self::Overdetermined { span, .. }
            | Self::Overflow { span, .. }
            | Self::Unsupported { span, .. } => Some(span.clone()),
            _ => None,
        }
    }
}

fn unsupported_text(directions: &[(String, &'static str)], with_mass: bool) -> String {
    let list: Vec<String> =
        directions.iter().take(6).map(|(n, d)| format!("\"{n}\" {d}")).collect();
    let more = if directions.len() > 6 { ", …" } else { "" };
    let what = if with_mass { "neither stiffness nor mass" } else { "no stiffness" };
    format!(
        "the structure can move freely: {what} in the direction of node {}{more}; add a support, an element or a link that holds it",
        list.join(", ")
    )
}
