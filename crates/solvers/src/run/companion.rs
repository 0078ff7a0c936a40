//! What the steps make of the errors of a run.
//!
//! ```text
//! e_o = 5/4 max over time |o(h, 2 τ) − o(h/2, τ)| + size/50000          τ: tolerance of the run
//! ```
//!
//! A run makes every step whole and in halves, and keeps the halves. Its companion is the same motion beside it, which
//! keeps the whole ones, at twice the tolerance: steps that are at least twice as long everywhere. What this moves in
//! an output is more than what the steps of the run themselves do, as long as shorter steps give a smaller error;
//! where they do so slowly it is about as much, and a quarter more is on the safe side. The last term is what neither of
//! both sees. It takes a thread of its own: a run on two processors waits for nothing.
//!
//! Where impacts part motions that begin side by side, how far two runs are apart is a matter of chance, and one of them
//! may end up near the other while both are far from the truth. Where outputs are apart by much, a second companion at
//! 3 τ goes the way once more, and the one that is further away counts.
//!
//! Reference: global error by a second integration in steps of another length \[Hairer, Nørsett & Wanner 1993, II.4;
//! Shampine & Watts 1976\].

use super::equations::Equations;
use super::start::Start;
use crate::certificate::Samples;
use crate::error::SolveError;
use crate::march::{March, Moment, Moving, Timeline, constant_force, output_step};
use crate::record::Ledger;
use crate::step::{State, Stepper};
use std::ops::Range;
use std::sync::atomic::{AtomicUsize, Ordering};
use trilith_model::StepControl;

/// Its tolerance over that of the run.
const LOOSER: f64 = 2.0;
/// The tolerance of a second one over that of the run.
const SECOND: f64 = 3.0;

/// The same motion at a looser tolerance.
pub(super) struct Companion<'a> {
    equations: Equations<'a>,
    timeline: &'a Timeline,
    tolerance: f64,
    steps: Range<usize>,
    /// The last of the output steps that it makes; sooner where the run ends before.
    last: AtomicUsize,
    budget: usize,
}

impl<'a> Companion<'a> {
    /// Beside a run of this tolerance over output steps; `budget`: substeps that may be tried.
    pub(crate) fn new(
        equations: Equations<'a>,
        timeline: &'a Timeline,
        tolerance: f64,
        steps: Range<usize>,
        budget: usize,
    ) -> Self {
        Self {
            equations,
            timeline,
            tolerance: LOOSER * tolerance,
            last: AtomicUsize::new(steps.end),
            steps,
            budget,
        }
    }

    /// A second one, beside a run that has ended.
    pub(crate) fn second(&self) -> Self {
        Self {
            equations: self.equations,
            timeline: self.timeline,
            tolerance: SECOND / LOOSER * self.tolerance,
            steps: self.steps.clone(),
            last: AtomicUsize::new(self.last.load(Ordering::Relaxed)),
            budget: self.budget,
        }
    }

    /// The run has ended after so many output steps: nobody looks at what would come later.
    pub(crate) fn end(&self, made: usize) {
        self.last.store(made, Ordering::Relaxed);
    }

    /// Outputs at the times of comparison, as far as it comes.
    pub(crate) fn march(
        &self,
        set_out: &dyn Fn(&mut dyn Stepper) -> Result<Start, SolveError>,
    ) -> Result<Samples<'a>, SolveError> {
        let Equations { model, system, loads, .. } = self.equations;
        let mut stepper = self.equations.stepper()?;
        let (state, control, ledger, _) = set_out(stepper.as_mut())?;
        let steps = self.steps.clone();
        let (space, timeline) = (stepper.space(), self.timeline);
        let mut samples =
            Samples::new(model, system, loads, space, timeline, steps.clone(), &state);
        let mut moving = Moving { state: Box::new(state), control, ledger };
        let constant = constant_force(stepper.space(), loads);
        let control = StepControl::Adaptive { tolerance: self.tolerance };
        let mut march = March::new(stepper.as_mut(), loads, control);
        march.budget = self.budget;
        march.whole = true;
        for step in steps {
            if step >= self.last.load(Ordering::Relaxed) {
                break;
            }
            let mut report = |moment: Moment, t: f64, s: &State, _: &Ledger| {
                if let Moment::Substep(segment) = moment {
                    samples.take(segment, t, s);
                }
            };
            let (line, moving) = (self.timeline, &mut moving);
            if output_step(line, step, &mut march, &constant, moving, &mut report).is_err() {
                break;
            }
        }
        Ok(samples)
    }
}
