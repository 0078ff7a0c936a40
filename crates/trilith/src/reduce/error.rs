//! Why a part of a model cannot be reduced.

use crate::Error;
use trilith_model::file::names_help;
use trilith_solvers::{ReductionError, SolveError};
use trilith_system::SystemError;

/// Why a part of a model cannot be reduced.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum ReduceError {
    /// A name that nothing of its sort has.
    #[error("there is no {what} \"{name}\"")]
    Unknown {
        /// The name.
        name: String,
        /// `element or group of elements`, or the same of nodes.
        what: &'static str,
        /// What would be right.
        help: String,
    },
    /// No linear element is in the part.
    #[error("the part has no linear element")]
    Nothing,
    /// An element that is no linear one.
    #[error(
        "\"{element}\" is a {kind}, which is a link: only linear elements and constraints are reduced, and links and bodies stay outside of the part"
    )]
    NotLinear {
        /// Its name.
        element: String,
        /// Its kind.
        kind: &'static str,
    },
    /// An element that stands on the ground by itself.
    #[error(
        "\"{element}\" stands on the ground by itself: what is inside of a part must follow the ground by the nodes that are kept alone; leave it out of the part"
    )]
    OnGround {
        /// Its name.
        element: String,
    },
    /// An element with inertance.
    #[error(
        "\"{element}\" has inertance, which the matrices of a superelement cannot tell from mass; leave it out of the part"
    )]
    Inertance {
        /// Its name.
        element: String,
    },
    /// An element whose stiffness hangs on its axial force.
    #[error(
        "\"{element}\" carries an axial force of `p_delta`, which matrices of a superelement cannot follow; leave it out of the part, or the model without `p_delta`"
    )]
    AxialForce {
        /// Its name.
        element: String,
    },
    /// Outputs and envelopes of forces of elements of the part, each with its element.
    #[error(
        "{}: forces of elements that the part has; leave these elements out of the part, or the outputs out of the model", listed(.0)
    )]
    Outputs(Vec<(String, String)>),
    /// A node that no element of the part has.
    #[error("node \"{node}\" is none of the part: its elements do not have it")]
    NotInPart {
        /// Its name.
        node: String,
    },
    /// No node is kept.
    #[error("nothing of the part is kept: nothing else touches it, and no node is named")]
    NothingKept,
    /// What the nodes that are kept do not hold; names of nodes and directions.
    #[error(
        "the nodes that are kept do not hold the part: {} can move while they stand still; keep more nodes", directions(.0)
    )]
    Loose(Vec<(String, &'static str)>),
    /// Where the stiffness is negative.
    #[error(
        "the stiffness of the part is not positive definite at {node} {direction} while the nodes that are kept stand still"
    )]
    Negative {
        /// Name of the node.
        node: String,
        /// Direction.
        direction: &'static str,
    },
    /// More shares of inner nodes than a table should have.
    #[error(
        "the table of inner nodes would have {shares} entries, and at most {most} are written: name fewer nodes, or take fewer modes"
    )]
    TooMany {
        /// How many.
        shares: usize,
        /// How many may be.
        most: usize,
    },
    /// A factorisation or an eigenproblem failed.
    #[error(transparent)]
    Reduction(ReductionError),
    /// The model is none, or has no frequencies.
    #[error(transparent)]
    Model(#[from] Error),
}

impl ReduceError {
    pub(super) fn unknown<'a>(
        name: &str,
        what: &'static str,
        candidates: impl IntoIterator<Item = &'a str> + Clone,
    ) -> Self {
        let help = names_help(name, "names", candidates);
        Self::Unknown { name: name.to_owned(), what, help }
    }

    /// What would be right, where more than the sentence is to be said.
    #[must_use]
    pub fn help(&self) -> Option<&str> {
        match self {
            Self::Unknown { help, .. } => Some(help),
            _ => None,
        }
    }
}

impl From<SystemError> for ReduceError {
    fn from(e: SystemError) -> Self {
        Self::Model(e.into())
    }
}

impl From<SolveError> for ReduceError {
    fn from(e: SolveError) -> Self {
        Self::Model(e.into())
    }
}

/// At most so many of a list are named.
const NAMED: usize = 4;

fn listed(all: &[(String, String)]) -> String {
    let named: Vec<String> = all
        .iter()
        .take(NAMED)
        .map(|(output, element)| format!("\"{output}\" (of \"{element}\")"))
        .collect();
    format!("{}{}", named.join(", "), if all.len() > NAMED { ", …" } else { "" })
}

fn directions(all: &[(String, &'static str)]) -> String {
    let named: Vec<String> =
        all.iter().take(NAMED).map(|(node, direction)| format!("{node} {direction}")).collect();
    format!("{}{}", named.join(", "), if all.len() > NAMED { ", …" } else { "" })
}
