//! What a run leaves.

use super::end_state::EndState;
use crate::basis::BasisReport;
use crate::certificate::OutputError;
use crate::checks::End;
use crate::error::{LawFault, imbalance};
use crate::record::{EnergyTotals, LinkEnergy};
use serde::Serialize;
use trilith_model::{Analysis, Model};

/// How much work a run was.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize)]
pub struct Work {
    /// Output steps.
    pub steps: usize,
    /// Accepted substeps.
    pub substeps: usize,
    /// Iterations of the link equations.
    pub iterations: usize,
    /// Steps thrown away: not converged or too inaccurate.
    pub rejected: usize,
    /// Factorisations of matrices of the structure.
    pub factorizations: usize,
    /// Substeps accepted at the smallest step although their error was above the tolerance.
    pub forced: usize,
    /// Wall-clock time, s.
    pub wall_s: f64,
    /// CPU time of assembly, basis and first factorisation, s.
    pub setup_cpu_s: f64,
    /// CPU time of the march, s.
    pub march_cpu_s: f64,
    /// Largest resident memory of the process, MB.
    pub peak_rss_mb: f64,
}

/// How a run ended.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub enum Status {
    /// To the end, within the energy limit.
    Converged,
    /// To the end, but more energy than allowed is unaccounted for.
    EnergyError {
        /// Share of energy unaccounted for.
        share: f64,
        /// The limit.
        limit: f64,
    },
    /// Stopped: no equilibrium at the smallest step.
    NotConverged {
        /// Time of the last accepted state, s.
        t: f64,
        /// The link coordinate that is farthest from equilibrium, or `the structure` where it is none of a link.
        worst: String,
        /// Its force residual, N or N·m; not a number where the values are none.
        residual: f64,
    },
    /// Stopped: the law of a link breaks its contract, or has no answer and says why.
    Law {
        /// Time of the last accepted state, s.
        t: f64,
        /// Name of the link.
        link: String,
        /// What is wrong with its law.
        fault: LawFault,
    },
    /// Stopped: the work that the run was given is spent.
    Spent {
        /// Time of the last accepted state, s.
        t: f64,
        /// Substeps tried.
        tried: usize,
    },
    /// Stopped from outside, at an output time: all until then is as it would have been.
    Interrupted {
        /// That time, s.
        t: f64,
    },
    /// To the end, but the basis does not hold the motion well enough.
    Inadequate {
        /// The output that is farthest off.
        output: String,
        /// By how much, as a share of its range.
        share: f64,
        /// What is allowed.
        allowed: f64,
    },
    /// Stopped because a body has fallen over, within the energy limit.
    Overturned {
        /// Time of the last state, s.
        t: f64,
        /// Name of the link of the body.
        body: String,
    },
}

impl Status {
    /// True for a result to be trusted: to the end, or to the end of a body that overturned.
    #[must_use]
    pub fn is_good(&self) -> bool {
        matches!(self, Self::Converged | Self::Overturned { .. })
    }

    /// Word for `summary.json`.
    #[must_use]
    pub fn word(&self) -> &'static str {
        match self {
            Self::Converged => "converged",
            Self::EnergyError { .. } => "energy error",
            Self::NotConverged { .. } => "not converged",
            Self::Law { fault: LawFault::Refuses { .. }, .. } => "refused",
            Self::Law { .. } => "wrong law",
            Self::Spent { .. } => "spent",
            Self::Interrupted { .. } => "interrupted",
            Self::Overturned { .. } => "overturned",
            Self::Inadequate { .. } => "inadequate",
        }
    }

    /// A sentence for the user.
    #[must_use]
    pub fn text(&self) -> String {
        match self {
            Self::Converged => "converged".into(),
            Self::EnergyError { share, limit } => format!(
                "{:.3} % of the energy is unaccounted for (limit {:.3} %): lower `tolerance` or the step",
                100.0 * share,
                100.0 * limit
            ),
            Self::NotConverged { t, worst, residual } => format!(
                "no equilibrium at t = {t:.6} s with the smallest step: {}",
                imbalance(worst, *residual, "")
            ),
            Self::Law { t, link, fault } => fault.text(link, &format!("at t = {t:.6} s")),
            Self::Spent { t, tried } => format!(
                "stopped at t = {t:.6} s after {tried} tried substeps, which is all that it was given (`substep_limit`)"
            ),
            Self::Interrupted { t } => format!("interrupted at t = {t:.6} s"),
            Self::Inadequate { output, share, allowed } => format!(
                "the basis is too small: output \"{output}\" may be off by {:.2} % of its range (allowed {:.2} %): use more vectors",
                100.0 * share,
                100.0 * allowed
            ),
            Self::Overturned { t, body } => format!("\"{body}\" overturned at t = {t:.6} s"),
        }
    }
}

/// What a run leaves.
#[derive(Clone, Debug)]
pub struct CaseResult {
    /// Name of the case.
    pub case: String,
    /// Name of the solver (`static` for a static case).
    pub solver: &'static str,
    /// How it ended.
    pub status: Status,
    /// Work.
    pub work: Work,
    /// Energies at the end.
    pub energy: EnergyTotals,
    /// Energies of each link at the end: (index of the element, energies).
    pub link_energy: Vec<(usize, LinkEnergy)>,
    /// The basis, for reduced solvers.
    pub basis: Option<BasisReport>,
    /// What the user should know.
    pub warnings: Vec<String>,
    /// How far every output of the model may be off, in its order; empty where nobody asked.
    pub errors: Vec<OutputError>,
    /// The state at the end, to be continued or written as a checkpoint.
    pub end: EndState,
}

/// Times that a basis is enlarged at most, and by so many vectors at least.
const ENLARGED: usize = 5;

const LEAST: usize = 16;

impl CaseResult {
    /// Where it ended, for what is said of that.
    pub(crate) fn place(&self) -> End<'_> {
        let EndState { time, displacement, load, state, .. } = &self.end;
        let fallen = matches!(self.status, Status::Overturned { .. });
        End { time: *time, displacement, load, state, fallen }
    }

    /// How many vectors the run is to be made with again, after so many enlargements, where its basis was too small
    /// and its case lets it grow.
    #[must_use]
    pub fn enlarged(&self, model: &Model, rounds: usize) -> Option<usize> {
        let case = model.case(&self.case).map(|i| &model.cases[i].analysis);
        let may = matches!(case, Some(Analysis::Dynamic(d)) if d.solution.basis.enrich);
        let small = matches!(self.status, Status::Inadequate { .. });
        let basis = self.basis.as_ref().filter(|_| may && small && rounds < ENLARGED)?;
        Some((2 * basis.vectors).max(basis.vectors + LEAST))
    }
}
