//! The state of a motion, and what one step makes of it.

use super::StepWork;
use super::culprit::Culprit;
use crate::error::SolveError;
use crate::kernel::{Extrapolation, ForceScale, NoEquilibrium};
use crate::structure::Motion;
use crate::vector::{larger, largest};
use serde::{Deserialize, Serialize};
use trilith_element::{Energy, Kinematics};
use trilith_model::Model;
use trilith_system::{LinkSet, System, Tangents};

/// Everything that changes during a run: copying it is a checkpoint.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct State {
    /// Displacements, velocities, accelerations in the coordinates of the solver.
    pub(crate) motion: Motion,
    /// Deformation of all link coordinates, flat.
    pub(crate) d: Vec<f64>,
    /// Its rate.
    pub(crate) v: Vec<f64>,
    /// Link forces.
    pub(crate) f: Vec<f64>,
    /// Pseudo-forces of the active coordinates that the motion feels: those of the laws but for what the
    /// tolerance of the link equations leaves.
    pub(crate) pseudo: Vec<f64>,
    /// Link history.
    pub(crate) history: Vec<f64>,
    /// Largest link forces so far.
    pub(crate) scale: ForceScale,
    /// Energy stored in each link.
    pub(crate) stored: Vec<f64>,
    /// Tangents of the laws.
    pub(crate) tangents: Tangents,
    /// What the guesses of the last steps left.
    #[serde(rename = "unforeseen")]
    pub(crate) extrapolation: Extrapolation,
    /// The largest stiffness of the active link coordinates so far, N/m or N·m.
    pub(crate) stiffest: Vec<f64>,
}

/// Where links are before a case gives them its initial values.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct LinksBefore {
    /// Deformations, flat.
    pub d: Vec<f64>,
    /// Histories, flat.
    pub history: Vec<f64>,
}

impl LinksBefore {
    /// Before anything has happened.
    pub(crate) fn rest(model: &Model, links: &LinkSet) -> Self {
        Self { d: vec![0.0; links.len()], history: links.at_rest(model) }
    }

    /// In a state.
    pub(crate) fn of(state: &State) -> Self {
        Self { d: state.d.clone(), history: state.history.clone() }
    }
}

/// Steps in which links are led to an initial deformation whose laws follow no straight path exactly.
const LED: usize = 64;

/// A law that ends in so many steps where it does in one follows the path exactly.
const TRIED: usize = 8;

/// Share of a value of the history that is rounding.
const SAME: f64 = 1e-12;

/// Histories of links that are led along a straight path, so slowly that nothing viscous acts.
fn lead(model: &Model, links: &LinkSet, before: &LinksBefore, d: &[f64]) -> Vec<f64> {
    if before.d == d {
        return before.history.clone();
    }
    let laws = links.laws(model);
    let still = vec![0.0; d.len()];
    let (mut f, mut tangents) = (still.clone(), links.tangents());
    let mut energy = vec![Energy::default(); links.links.len()];
    let mut along = |steps: usize| {
        let (mut at, mut next) = (before.d.clone(), before.d.clone());
        let (mut history, mut led) = (before.history.clone(), before.history.clone());
        for i in 1..=steps {
            let share = i as f64 / steps as f64;
            for (x, (from, to)) in next.iter_mut().zip(before.d.iter().zip(d)) {
                *x = if i == steps { *to } else { from + share * (to - from) };
            }
            let path = Kinematics::new([&next, &still], [&at, &still], 0.0);
            laws.respond(path, &history, &mut led, &mut f, &mut tangents, &mut energy);
            std::mem::swap(&mut history, &mut led);
            std::mem::swap(&mut at, &mut next);
        }
        history
    };
    let (at_once, tried) = (along(1), along(TRIED));
    let is_same = |(x, y): (&f64, &f64)| (x - y).abs() <= SAME * x.abs().max(y.abs());
    if at_once.iter().zip(&tried).all(is_same) { at_once } else { along(LED) }
}

impl State {
    /// The links led slowly and straight from where they were to a deformation, then at a rate, as the laws
    /// see it at the start of a step; no motion yet.
    pub(crate) fn of_links(
        model: &Model,
        links: &LinkSet,
        before: &LinksBefore,
        d: Vec<f64>,
        v: Vec<f64>,
    ) -> Self {
        let history = lead(model, links, before, &d);
        let mut state = Self {
            motion: Vec::new(),
            f: vec![0.0; links.len()],
            pseudo: vec![0.0; links.active.len()],
            history: vec![f64::NAN; history.len()],
            scale: [0.0; 2],
            stored: vec![0.0; links.links.len()],
            tangents: links.tangents(),
            extrapolation: Extrapolation::default(),
            stiffest: vec![0.0; links.active.len()],
            d,
            v,
        };
        let mut energy = vec![Energy::default(); links.links.len()];
        links.laws(model).respond(
            Kinematics::still(&state.d, &state.v),
            &history,
            &mut state.history,
            &mut state.f,
            &mut state.tangents,
            &mut energy,
        );
        let force = largest(&state.f);
        state.record_converged(links, &energy, force);
        state
    }

    /// Makes this a place for the step that follows another state.
    #[inline]
    pub(crate) fn follow(&mut self, from: &Self) {
        if self.motion.len() == from.motion.len() && self.d.len() == from.d.len() {
            self.scale = from.scale;
            self.stiffest.copy_from_slice(&from.stiffest);
        } else {
            self.clone_from(from);
        }
    }

    /// Takes note of the forces, the largest of which is given, the stored energies and the stiffness of a converged
    /// step.
    #[inline]
    pub(crate) fn record_converged(&mut self, links: &LinkSet, energy: &[Energy], force: f64) {
        for (most, at) in self.stiffest.iter_mut().zip(&links.diagonal) {
            *most = larger(*most, self.tangents.k[*at]);
        }
        for (stored, e) in self.stored.iter_mut().zip(energy) {
            *stored = e.stored;
        }
        if !links.turns {
            self.scale[0] = larger(self.scale[0], force);
            return;
        }
        for (f, rotational) in self.f.iter().zip(&links.rotational) {
            let scale = &mut self.scale[usize::from(*rotational)];
            *scale = larger(*scale, f.abs());
        }
    }
}

/// What one step did to the energies.
#[derive(Clone, Debug, Default)]
pub(crate) struct StepEnergy {
    pub work: StepWork,
    /// Work that the links took, effective stiffnesses put right.
    pub link_work: f64,
    /// Work of moving supports on the links.
    pub support: f64,
    pub kinetic: f64,
    pub strain: f64,
    /// Raw energies of each link.
    pub links: Vec<Energy>,
}

/// A step that found no equilibrium.
#[derive(Clone, Debug)]
pub(crate) enum StepFailure {
    /// The flat link coordinate farthest from equilibrium, and its residual.
    NoEquilibrium { worst: usize, residual: f64 },
    /// A law answers with no finite number.
    Unsound(Culprit),
    /// The linear algebra failed.
    Fatal(SolveError),
}

impl From<NoEquilibrium> for StepFailure {
    fn from(NoEquilibrium { worst, residual }: NoEquilibrium) -> Self {
        Self::NoEquilibrium { worst, residual }
    }
}

impl From<SolveError> for StepFailure {
    fn from(e: SolveError) -> Self {
        Self::Fatal(e)
    }
}

/// A state without motion, as the laws are before anything has happened.
pub(crate) fn untouched(model: &Model, system: &System) -> State {
    let links = &system.links;
    let rest = LinksBefore::rest(model, links);
    State::of_links(model, links, &rest, rest.d.clone(), rest.d.clone())
}
