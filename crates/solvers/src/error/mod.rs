//! What can stop a run before or while it goes on.

mod law_fault;

pub use law_fault::LawFault;

use trilith_linalg::LinalgError;
use trilith_model::Span;
use trilith_system::SystemError;

/// A run that cannot be made.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum SolveError {
    /// The structure is not one.
    #[error(transparent)]
    System(#[from] SystemError),
    /// A factorisation or an eigenproblem failed.
    #[error(transparent)]
    Linalg(#[from] LinalgError),
    /// A complete basis was asked for a model that is too large for it.
    #[error(
        "a complete basis needs a dense eigenproblem of {order} equations (limit {limit}): use `basis: Ritz(vectors: …)`"
    )]
    BasisTooLarge {
        /// Free DOFs.
        order: usize,
        /// Largest order.
        limit: usize,
    },
    /// No vector of the basis carries mass.
    #[error("no direction that a load or a link acts on carries mass: the model has no dynamics")]
    NoMass,
    /// A place without mass is unstable with its links as they are linearised.
    #[error(
        "with its links so the structure has no modes: where it has no mass it stands on nothing, or on less than nothing; `engaged` links hold it"
    )]
    NoModes,
    /// A law gives no finite stiffness in the state in which it is linearised.
    #[error("the law of \"{link}\" has no finite stiffness there")]
    NoStiffness {
        /// Name of the link.
        link: String,
        /// Where the file defines it.
        span: Span,
    },
    /// A response spectrum has no value for a mode.
    #[error(
        "the spectrum has no value at the period of mode {mode}, {period:.4} s: it goes from {} to {} s", range[0], range[1]
    )]
    OutsideSpectrum {
        /// Counted from 1.
        mode: usize,
        /// Its period, s.
        period: f64,
        /// First and last period of the spectrum, s.
        range: [f64; 2],
    },
    /// A static case found no equilibrium.
    #[error(
        "static case \"{case}\": no equilibrium beyond {percent:.1} % of its loads: {}",
        imbalance(.worst, *.residual, " N or N·m")
    )]
    StaticNotConverged {
        /// Name of the case.
        case: String,
        /// Share of the loads that was reached.
        percent: f64,
        /// The link coordinate farthest from equilibrium.
        worst: String,
        /// Its residual.
        residual: f64,
        /// Where the file defines the case.
        span: Span,
    },
    /// The axial forces of the P-Δ case make the structure unstable.
    #[error(
        "the structure buckles under the axial forces of case \"{case}\" ({worst} carries the largest compression, {force:.4e} N)"
    )]
    Buckles {
        /// Name of the case.
        case: String,
        /// The element with the largest compression.
        worst: String,
        /// Its axial force, N, tension positive.
        force: f64,
        /// Where the file defines the case.
        span: Span,
    },
    /// The axial forces of the P-Δ case and the stiffness they leave do not settle.
    #[error(
        "the axial forces of case \"{case}\" do not settle with P-Δ: the last change was {change:.2e} of the largest"
    )]
    AxialForces {
        /// Name of the case.
        case: String,
        /// Last change relative to the largest axial force.
        change: f64,
        /// Where the file defines the case.
        span: Span,
    },
    /// A case that another one continues did not get to its end.
    #[error("case \"{case}\", which is continued, did not finish: {reason}")]
    Predecessor {
        /// Name of the case.
        case: String,
        /// Its status.
        reason: String,
    },
    /// Somebody asked for the end in a case that another one continues: of that one nothing is kept.
    #[error(
        "interrupted at t = {t} s of case \"{case}\", which is continued: there is nothing of the case after it; `--case \"{case}\"` runs it alone, and keeps what there is of it"
    )]
    Interrupted {
        /// Name of the case.
        case: String,
        /// How far it came, s.
        t: f64,
    },
    /// Joints without mass found no equilibrium with their links beside initial displacements.
    #[error(
        "the initial displacements leave joints without mass out of balance with their links beyond {percent:.1} % of the way: {}; give these joints a mass, or a spring beside the links",
        imbalance(.worst, *.residual, " N or N·m")
    )]
    JointNotHeld {
        /// Share of the displacements that was reached.
        percent: f64,
        /// The link coordinate farthest from equilibrium.
        worst: String,
        /// Its residual.
        residual: f64,
        /// Where the file defines the link.
        span: Span,
    },
    /// An initial value for a direction that is fixed or follows another node.
    #[error(
        "node \"{node}\" {direction} has no value of its own to start from: it is fixed or follows a constraint; give the initial value at the node that leads"
    )]
    InitialNotFree {
        /// Name of the node.
        node: String,
        /// Direction.
        direction: &'static str,
        /// Where the file defines the node.
        span: Span,
    },
    /// An output step that is none.
    #[error("case \"{case}\" cannot have an output step of {dt} s: must be > 0")]
    OutputStep {
        /// Name of the case.
        case: String,
        /// Output step, s.
        dt: f64,
        /// Where the file defines the case.
        span: Span,
    },
    /// An output step so short that there are more of them than can be kept.
    #[error(
        "case \"{case}\" has {steps:.3e} output steps of {dt} s: at most {most} are kept; give a longer output step, by `dt` of the case or `--dt`",
        most = trilith_model::MOST_OUTPUT_STEPS
    )]
    TooManySteps {
        /// Name of the case.
        case: String,
        /// Output steps asked for, a whole number.
        steps: f64,
        /// Output step, s.
        dt: f64,
        /// Where the file defines the case.
        span: Span,
    },
    /// The law of a link breaks its contract where no time goes on.
    #[error("{}", fault.text(.link, .when))]
    Law {
        /// Name of the link.
        link: String,
        /// What is wrong.
        fault: LawFault,
        /// When, such as `at the start of case "shake"`.
        when: String,
        /// Where the file defines the link.
        span: Span,
    },
    /// The rule for time of another crate cannot step the structure.
    #[error("solver {kind}: {reason}")]
    Integrator {
        /// Its kind.
        kind: &'static str,
        /// What it says, or what is wrong with it.
        reason: String,
    },
    /// Derivatives that cannot be had.
    #[error("no derivatives: {reason}")]
    NoGradient {
        /// Why, and what would give them.
        reason: String,
    },
    /// A state that belongs to another model, case or solver.
    #[error("the checkpoint does not fit: {reason}")]
    Checkpoint {
        /// What differs.
        reason: String,
    },
}

impl SolveError {
    /// The place in the model file, where there is one.
    #[must_use]
    pub fn span(&self) -> Option<Span> {
        match self {
            Self::System(e) => e.span(),
            Self::StaticNotConverged { span, .. }
            | Self::JointNotHeld { span, .. }
            | Self::Law { span, .. }
            | Self::NoStiffness { span, .. }
            | Self::InitialNotFree { span, .. }
            | Self::Buckles { span, .. }
            | Self::OutputStep { span, .. }
            | Self::TooManySteps { span, .. }
            | Self::AxialForces { span, .. } => Some(span.clone()),
            _ => None,
        }
    }
}

/// A part of a sentence: what is farthest off, and by how much, in N or N·m; `unit` follows the number as it is.
/// A residual that is no finite number says that the values themselves are none.
pub(crate) fn imbalance(worst: &str, residual: f64, unit: &str) -> String {
    if residual.is_finite() {
        return format!("{worst} is off by {residual:.3e}{unit}");
    }
    format!(
        "{worst} has values that are no finite numbers: a load, a motion, a mass or a stiffness is too large or too small to compute with"
    )
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn no_number_is_said_to_be_none() {
        assert_eq!(imbalance("\"foot\" U1", 12.5, " N"), "\"foot\" U1 is off by 1.250e1 N");
        for residual in [f64::NAN, f64::INFINITY] {
            let text = imbalance("the structure", residual, "");
            assert!(
                text.starts_with("the structure has values that are no finite numbers"),
                "{text}"
            );
        }
    }
}
