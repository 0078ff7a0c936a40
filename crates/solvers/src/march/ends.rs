//! What ends a march early: a law that breaks its contract, work that is spent, no equilibrium however short the step.

use super::closing::Made;
use super::{DEPTH, March, ROUNDING, Stop, Trial};
use crate::step::{
    State, StepEnergy, StepFailure, Stepper, asked_again, asked_twice, is_sound, leaves_out,
    not_finite,
};
use trilith_model::StepControl;
use trilith_system::StepLoads;

/// Steps tried between two questions whether the laws answer the same twice: often enough that a law which remembers
/// what it was asked is told long before the work is spent, seldom enough to cost nothing.
pub(super) const ASK_EVERY: usize = 4096;

impl March<'_> {
    /// Ends the run where a law does not account for its work, by an accepted step from `t`.
    #[inline]
    pub(super) fn watch(&mut self, state: &State, t: f64) -> Result<(), Stop> {
        if !self.closing.is_watching() {
            return Ok(());
        }
        let Trial { whole, first, second, energies: [e0, e1, e2], .. } = &self.trial;
        let made = Made {
            from: state,
            whole: (whole, e0),
            first: (first, e1),
            second: (second, e2),
            rounding: ROUNDING * self.stepper.rounding(second),
        };
        match self.closing.look(self.stepper.links(), &made) {
            Some(culprit) => Err(Stop::Law { t, culprit }),
            None => Ok(()),
        }
    }

    /// Asks the laws again what they answered in the step accepted last, which led to a state at `t`.
    ///
    /// # Errors
    /// [`Stop::Law`] where one answers otherwise.
    pub(crate) fn ask_again(&self, state: &State, t: f64) -> Result<(), Stop> {
        let Trial { whole, first, second, .. } = &self.trial;
        let from = match self.control {
            StepControl::Fixed { .. } => whole,
            StepControl::Adaptive { .. } if self.whole => second,
            StepControl::Adaptive { .. } => first,
        };
        // No step has been made yet.
        if from.d.len() != state.d.len() || self.last == 0.0 {
            return Ok(());
        }
        let (laws, links) = (self.stepper.laws(), self.stepper.links());
        match asked_again(&laws, links, from, state, self.last) {
            Some(culprit) => Err(Stop::Law { t, culprit }),
            None => Ok(()),
        }
    }

    /// Ends a run of fixed steps where a law does not account for its work in the step accepted last, which led to a state
    /// at `t`. Where steps are as short as they must be, [`watch`](Self::watch) has looked.
    pub(crate) fn look(&mut self, state: &State, t: f64) -> Result<(), Stop> {
        let Trial { whole: from, energies: [energy, ..], .. } = &self.trial;
        let made = from.d.len() == state.d.len() && self.last > 0.0;
        if matches!(self.control, StepControl::Adaptive { .. }) || !made {
            return Ok(());
        }
        let step = (&**from, state);
        let suspects = self.suspicion.look(self.stepper.links(), step, &energy.links);
        if suspects.is_empty() {
            return Ok(());
        }
        let since = Some(t - self.last);
        match leaves_out(&suspects, &self.stepper.laws(), step, self.last, since) {
            Some(culprit) => Err(Stop::Law { t, culprit }),
            None => Ok(()),
        }
    }

    /// Ends the run where its work is spent, or goes into a law that answers otherwise each time.
    #[inline]
    pub(super) fn spend(&mut self, t: f64, state: &State) -> Result<(), Stop> {
        self.at = t;
        let tried = self.counts.substeps + self.counts.rejected;
        if tried < self.budget && tried < self.ask_at {
            return Ok(());
        }
        self.ask_at = tried + ASK_EVERY;
        match asked_twice(&self.stepper.laws(), self.stepper.links(), state) {
            Some(culprit) => Err(Stop::Law { t, culprit }),
            None if tried >= self.budget => Err(Stop::Spent { t }),
            None => Ok(()),
        }
    }

    /// Ends the run where halving the step of this size (s) from a state does not help.
    pub(super) fn give_up(
        &self,
        failure: StepFailure,
        level: u32,
        (t, state): (f64, &State),
        size: f64,
    ) -> Result<(), Stop> {
        match failure {
            StepFailure::Fatal(e) => Err(Stop::Fatal(e)),
            // A shorter step may lead where the law has an answer.
            _ if level + 2 < DEPTH => Ok(()),
            StepFailure::Unsound(culprit) => Err(Stop::Law { t, culprit }),
            StepFailure::NoEquilibrium { worst, residual } => {
                let Trial { whole, first, second, .. } = &self.trial;
                let links = self.stepper.links();
                // Only forces and tangents are there where a step has failed.
                let tried = [
                    (state, &**whole, size),
                    (state, first, 0.5 * size),
                    (first, second, 0.5 * size),
                ];
                let culprit = tried
                    .into_iter()
                    .find_map(|(from, to, dt)| not_finite(links, (from, to), dt, None));
                let culprit = culprit.or_else(|| asked_twice(&self.stepper.laws(), links, state));
                Err(match culprit {
                    Some(culprit) => Stop::Law { t, culprit },
                    None => Stop::NoEquilibrium { t, worst, residual },
                })
            }
        }
    }
}

/// A step in which all laws have answered with numbers.
#[inline]
pub(super) fn sound_step(
    stepper: &mut dyn Stepper,
    from: &State,
    to: &mut State,
    loads: &StepLoads,
    dt: f64,
    energy: &mut StepEnergy,
) -> Result<(), StepFailure> {
    stepper.step(from, to, loads, dt, energy)?;
    if is_sound(to, &energy.links) {
        return Ok(());
    }
    match not_finite(stepper.links(), (from, to), dt, Some(&energy.links)) {
        Some(culprit) => Err(StepFailure::Unsound(culprit)),
        // It is not a law: the measures of the step tell.
        None => Ok(()),
    }
}
