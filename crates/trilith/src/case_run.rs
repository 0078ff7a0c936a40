//! The run of a case, told how to be made.

use crate::{Analysis, Error, Run, RunOptions};
use std::ops::Deref;
use std::sync::atomic::AtomicBool;
use trilith_model::{Model, SolverKind};
use trilith_solvers::{EndState, Observer};

/// The run of a case that an [`Analysis`] is about to make: as the model says, but for what is told here.
pub struct CaseRun<'a, M> {
    analysis: &'a Analysis<M>,
    options: RunOptions<'a>,
    observers: Vec<&'a mut dyn Observer>,
}

impl<'a, M: Deref<Target = Model>> CaseRun<'a, M> {
    pub(crate) fn new(analysis: &'a Analysis<M>, case: usize) -> Self {
        let options = RunOptions { case, ..RunOptions::default() };
        Self { analysis, options, observers: Vec::new() }
    }

    /// With another solver.
    #[must_use]
    pub fn solver(mut self, solver: SolverKind) -> Self {
        self.options.solver = Some(solver);
        self
    }

    /// With another output step, s.
    #[must_use]
    pub fn dt(mut self, dt: f64) -> Self {
        self.options.dt = Some(dt);
        self
    }

    /// Until the first output time that is not before this one, s; the [end](trilith_solvers::CaseResult::end) of the run is where
    /// another may go on.
    #[must_use]
    pub fn until(mut self, t: f64) -> Self {
        self.options.until = Some(t);
        self
    }

    /// From where an earlier run of the case stopped.
    #[must_use]
    pub fn from(mut self, end: EndState) -> Self {
        self.options.from = Some(end);
        self
    }

    /// With so many vectors in the basis.
    #[must_use]
    pub fn vectors(mut self, count: usize) -> Self {
        self.options.vectors = Some(count);
        self
    }

    /// With an end after so many substeps, tried ones included.
    #[must_use]
    pub fn substeps(mut self, most: usize) -> Self {
        self.options.substeps = Some(most);
        self
    }

    /// With what the steps make of the errors of the outputs, for which the case is run a second time.
    #[must_use]
    pub fn step_errors(mut self) -> Self {
        self.options.step_errors = true;
        self
    }

    /// Telling how much of it is done, 0 … 1.
    #[must_use]
    pub fn progress(mut self, tell: &'a mut dyn FnMut(f64)) -> Self {
        self.options.progress = Some(tell);
        self
    }

    /// With a flag that ends it at the next output time once it is true.
    #[must_use]
    pub fn interrupt(mut self, flag: &'a AtomicBool) -> Self {
        self.options.interrupt = Some(flag);
        self
    }

    /// Under the eyes of an observer, who is shown every accepted substep.
    #[must_use]
    pub fn observer(mut self, observer: &'a mut dyn Observer) -> Self {
        self.observers.push(observer);
        self
    }

    /// Makes the run and, before it, those of the cases that it continues.
    ///
    /// # Errors
    /// As [`Analysis::run`].
    pub fn run(self) -> Result<Run, Error> {
        let Self { analysis, options, mut observers } = self;
        analysis.observed(options, &mut observers)
    }
}
