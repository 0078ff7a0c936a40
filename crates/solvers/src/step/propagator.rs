//! Propagators: linear steps in closed form, affine in the link forces at their end.

use crate::error::SolveError;
use crate::kernel::{Compliance, StepKey, Wanted};
use crate::modal::ClosedForm;
use crate::structure::{Motion, ReducedSystem};

/// Work over one step, J.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct StepWork {
    /// Of the loads.
    pub external: f64,
    /// Of the pseudo-forces of the links against the structure (taken from it).
    pub links: f64,
    /// Of the damping of the structure.
    pub damping: f64,
    /// Removed by the time rule.
    pub algorithmic: f64,
    /// Kinetic energy at the end.
    pub kinetic: f64,
    /// Strain energy at the end, effective stiffnesses included.
    pub strain: f64,
}

/// Loads and pseudo-forces at both ends of a step.
pub(crate) struct Forces<'a> {
    pub loads: [&'a [f64]; 2],
    pub pseudo0: &'a [f64],
    pub pseudo1: &'a [f64],
}

/// One rule for time, on one space.
pub(crate) trait Propagator {
    /// The space it moves in.
    fn space(&self) -> &ReducedSystem;

    /// Number of factorisations of structure matrices so far.
    fn factorizations(&self) -> usize;

    /// Says of which link coordinates laws depend on rates, those of every [prediction](Self::predict) to come, and
    /// which ones they damp.
    fn set_rates(&mut self, _rated: &[usize], _damped: &[usize]) -> Result<(), SolveError> {
        Ok(())
    }

    /// The step of length `dt` from a state whose active link coordinates have this stiffness, and had that
    /// one at most so far.
    fn choose(
        &mut self,
        dt: f64,
        _stiffness: &mut dyn Iterator<Item = f64>,
        _stiffest: &[f64],
    ) -> StepKey {
        StepKey::exact(dt)
    }

    /// Prepares for such steps; what is expensive is kept.
    fn prepare(&mut self, key: &StepKey) -> Result<(), SolveError>;

    /// Compliance of the step prepared last.
    fn compliance(&self) -> &Compliance;

    /// Largest G·k of the links so far under the exact rule, where steps were too long for it and were made
    /// by another rule.
    fn beyond_exact(&self) -> Option<f64> {
        None
    }

    /// What is known of the motion inside a step, where that is more than its ends.
    fn closed_form(&self) -> Option<ClosedForm> {
        None
    }

    /// Acceleration that a force on the structure at rest would cause; zero where there is no mass.
    fn acceleration(&mut self, force: &[f64]) -> Result<Vec<f64>, SolveError>;

    /// The step with the pseudo-forces at its end as they are at its start, as far as the links need it: d and v of the
    /// active coordinates. `to` need not be complete before [`correct`](Self::correct).
    fn predict(&mut self, from: &Motion, forces: &Forces<'_>, to: &mut Motion, wanted: Wanted<'_>);

    /// Completes the step predicted last with the pseudo-forces at its end, now known.
    fn correct(&mut self, from: &Motion, forces: &Forces<'_>, to: &mut Motion);

    /// True where the step is linear in motion and forces: nothing follows its load in a way that bends.
    fn is_linear(&self) -> bool {
        true
    }

    /// Whether work is asked for from now on; it is where nothing is said.
    fn follow_work(&mut self, _follows: bool) {}

    /// Work done over the step completed last.
    fn work(&mut self, from: &Motion, to: &Motion, forces: &Forces<'_>) -> StepWork;

    /// Work of the loads over a step as the one prepared last, from one motion to another, whatever was completed before.
    fn external_work(&mut self, from: &Motion, to: &Motion, forces: &Forces<'_>) -> f64 {
        self.work(from, to, forces).external
    }

    /// ½ vᵀ M v and ½ uᵀ K u (with effective stiffnesses) of a motion.
    fn energy(&self, motion: &[f64]) -> (f64, f64) {
        kinetic_and_strain(self.space(), motion)
    }
}

/// ½ vᵀ M v and ½ uᵀ K u (with effective stiffnesses).
pub(crate) fn kinetic_and_strain(space: &ReducedSystem, x: &[f64]) -> (f64, f64) {
    let n = space.order();
    let (u, v) = (&x[..n], &x[n..2 * n]);
    (0.5 * space.mass.bilinear(v, v), 0.5 * space.stiffness.bilinear(u, u))
}
