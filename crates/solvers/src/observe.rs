//! What a run shows while it goes on, and what it leaves.

use crate::certificate::OutputError;
use crate::imbalance::imbalance;
use serde::Serialize;
use trilith_element::{Contact, Vector3};
use trilith_model::{Analysis, Model};

/// A moment of a run, shown after every accepted substep.
pub struct Sample<'a> {
    /// Time, s.
    pub t: f64,
    /// Index of the output step where `t` is an output time (0 = start of the case).
    pub output_step: Option<usize>,
    /// Values of the model's outputs, in its order, SI.
    pub values: &'a [f64],
    /// Their time derivatives where they are known (displacements), NaN elsewhere.
    pub rates: &'a [f64],
    /// Energies so far.
    pub energy: &'a EnergyTotals,
    /// What every contact does: (index of the element in the model, contact).
    pub contacts: &'a [(usize, Contact)],
    /// Index of the element of a body that has fallen over.
    pub overturned: Option<usize>,
    /// Deformations of all links, coordinates of link after link in the model's order, m or rad.
    pub deformation: &'a [f64],
    /// Their forces in the same order, N or N·m.
    pub force: &'a [f64],
    /// Horizontal force on supports and ground along X and Y, N; not numbers where no observer wants it.
    pub base_shear: [f64; 2],
    /// Displacements of the structure on request.
    pub shape: &'a dyn Shape,
}

/// Displacements of all nodes.
pub trait Shape {
    /// Six displacements of every node, node after node (m, rad); `u` has 6 · nodes values.
    fn displacements(&self, u: &mut [f64]);

    /// Adds where the points of the outlines of links are, link after link in the model's order: global
    /// axes, m, each from the place of the link's first node without displacement.
    fn outlines(&self, _points: &mut Vec<Vector3>) {}
}

/// Watches a run.
pub trait Observer {
    /// Called once before the first sample: at most so many output steps follow that one.
    fn start(&mut self, _steps: usize) {}

    /// Called at the start and after every accepted substep, in time order.
    fn sample(&mut self, sample: &Sample<'_>);

    /// Called between two samples for moments inside a long step, in time order, with the outputs and their rates
    /// there: for extremes.
    fn between(&mut self, _t: f64, _values: &[f64], _rates: &[f64]) {}

    /// Called once where the run ends, wherever that is, with the last sample again.
    fn end(&mut self, _sample: &Sample<'_>) {}

    /// False where it never looks at the rates of a sample: where no observer does, nobody makes them, and they
    /// are not numbers.
    fn wants_rates(&self) -> bool {
        true
    }

    /// True where it looks at the base shear of a sample.
    fn wants_base_shear(&self) -> bool {
        false
    }
}

/// Energies of a case, J: what was there at its start, what came since then, and where it is now.
///
/// `start` (its sum) + `input` = `kinetic` + `strain` + `potential` + `link_stored` + `modal_damping` +
/// `link_hysteretic` + `link_viscous` + `algorithmic` + `error`; [`balance`](Self::balance) tells it in words. A
/// static case, which no time passes in, has neither input nor error.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, serde::Deserialize)]
pub struct EnergyTotals {
    /// What was there at the start of the case.
    pub start: StartEnergy,
    /// Work of base motion, moving supports and varying forces since the start.
    pub input: f64,
    /// ½ u̇ᵀ M u̇ (relative velocities).
    pub kinetic: f64,
    /// ½ uᵀ K u.
    pub strain: f64,
    /// Potential of constant loads (gravity): its change since the start, since it has no zero of its own; in a
    /// static case since there was no load.
    pub potential: f64,
    /// Work of structural damping since the start.
    pub modal_damping: f64,
    /// Stored in links.
    pub link_stored: f64,
    /// Heat of friction and yielding in links since the start.
    pub link_hysteretic: f64,
    /// Heat of rate-dependent link forces since the start.
    pub link_viscous: f64,
    /// Energy removed by the time rule (HHT with α < 0) since the start.
    pub algorithmic: f64,
    /// What is not accounted for: start + input − everything else.
    pub error: f64,
    /// |error| over the largest of input (with the kinetic energy at the start), kinetic energy, potential and heat,
    /// and a hundredth of the largest energy so far.
    pub error_relative: f64,
}

/// Energies at the start of a case, J; nothing in a static case.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, serde::Deserialize)]
pub struct StartEnergy {
    /// ½ u̇ᵀ M u̇ (relative velocities).
    pub kinetic: f64,
    /// ½ uᵀ K u.
    pub strain: f64,
    /// Stored in links.
    pub link_stored: f64,
}

/// Energies of one link since the start of the case, J.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, serde::Deserialize)]
pub struct LinkEnergy {
    /// Stored now (absolute).
    pub stored: f64,
    /// Heat of friction and yielding.
    pub hysteretic: f64,
    /// Heat of rate-dependent forces.
    pub viscous: f64,
}

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

/// How well a basis holds the flexibility of a link coordinate.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Adequacy {
    /// Name, such as `"foot" U1`.
    pub coordinate: String,
    /// Share of the exact flexibility, 0 … 1.
    pub share: f64,
}

/// The basis of a reduced solver.
#[derive(Clone, Debug, Default, PartialEq, Serialize)]
pub struct BasisReport {
    /// Number of vectors with mass: modes.
    pub vectors: usize,
    /// Number of static shapes of places without mass, beside the modes.
    pub static_shapes: usize,
    /// Circular frequencies of the structure without links, rad/s, rising.
    pub omega: Vec<f64>,
    /// Share of the mass along X, Y, Z that each vector carries.
    pub mass_participation: Vec<[f64; 3]>,
    /// Static participation of each load direction, by name: share of the static response held.
    pub static_participation: Vec<(String, f64)>,
    /// Worst coordinates first.
    pub adequacy: Vec<Adequacy>,
    /// The lowest modes that deform the structure, for pictures.
    #[serde(skip)]
    pub shapes: Vec<ModeShape>,
}

/// What a mode looks like.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct ModeShape {
    /// Which mode it is: an index into [`BasisReport::omega`].
    pub mode: usize,
    /// Six displacements of every node, node after node; of any size.
    pub displacements: Vec<f32>,
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
    pub end: crate::EndState,
}

/// Times that a basis is enlarged at most, and by so many vectors at least.
const ENLARGED: usize = 5;
const LEAST: usize = 16;

impl CaseResult {
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
