//! One case solved in several ways: how far the results are apart, and why.
//!
//! The cause of a difference is found by experiment: what could be its cause is taken away from both runs, and
//! the difference is measured again.

mod cause;
mod measure;
mod setup;

pub use cause::{Cause, Finding};
pub use measure::Difference;
pub use setup::Variant;

use crate::{Analysis, Error};
use setup::Setup;
use std::rc::Rc;
use std::sync::atomic::{AtomicBool, Ordering};
use trilith_model::Model;
use trilith_results::Summary;
use trilith_solvers::RunOptions;

/// What a variant left.
#[derive(Clone, Debug)]
pub struct Outcome {
    /// Output times, s.
    pub time: Vec<f64>,
    /// Outputs in the order of the model, at the output times.
    pub histories: Vec<Vec<f64>>,
    /// The summary.
    pub summary: Summary,
    /// True for a run that came to its end within the energy limit.
    pub good: bool,
    /// Equations of the structure.
    pub order: usize,
    /// Largest rotation of a node about X or Y in the deformed shapes kept, rad.
    pub rotation: f64,
}

/// A variant beside the first one.
#[derive(Clone, Debug)]
pub struct Compared {
    /// How it was solved.
    pub variant: Variant,
    /// What it left.
    pub outcome: Rc<Outcome>,
    /// Differences from the first variant, output by output; none for the first itself.
    pub differences: Vec<Difference>,
    /// Why they differ, where that was asked for.
    pub finding: Option<Finding>,
}

/// Runs variants of a case, each setting once.
pub struct Comparison<'m> {
    model: &'m mut Model,
    case: usize,
    done: Vec<(Setup, Rc<Outcome>)>,
    /// Told what is about to run.
    announce: Box<dyn FnMut(&str) + 'm>,
    /// True once an end is wanted.
    interrupt: Option<&'m AtomicBool>,
}

impl<'m> Comparison<'m> {
    /// For a dynamic case, by its index. `announce` is told what is about to run.
    pub fn new(model: &'m mut Model, case: usize, announce: impl FnMut(&str) + 'm) -> Self {
        Self { model, case, done: Vec::new(), announce: Box::new(announce), interrupt: None }
    }

    /// Once this is true, the run under way is given up and no other begun.
    #[must_use]
    pub fn until(mut self, interrupt: &'m AtomicBool) -> Self {
        self.interrupt = Some(interrupt);
        self
    }

    /// Runs the variants; with `experiments` also what tells the causes of their differences from the first. Where that
    /// was interrupted, those that came to their end.
    ///
    /// # Errors
    /// [`Error::Solve`] where one of the variants cannot be run.
    pub fn run(&mut self, variants: &[Variant], experiments: bool) -> Result<Vec<Compared>, Error> {
        let mut all: Vec<Compared> = Vec::new();
        for variant in variants {
            let outcome = match self.outcome(&Setup::of(variant)) {
                Err(Error::Interrupted) => break,
                outcome => outcome?,
            };
            let (mut differences, mut finding) = (Vec::new(), None);
            if let Some(first) = all.first() {
                let names = self.model.shown().map(|(_, o)| o.name.as_str());
                differences = measure::differences(names, &first.outcome, &outcome);
                if experiments {
                    let pair = [Setup::of(&first.variant), Setup::of(variant)];
                    finding = match cause::find(self, pair, &differences) {
                        Err(Error::Interrupted) => None,
                        finding => finding?,
                    };
                }
            }
            all.push(Compared { variant: variant.clone(), outcome, differences, finding });
        }
        Ok(all)
    }

    /// What a setup leaves; run once.
    fn outcome(&mut self, setup: &Setup) -> Result<Rc<Outcome>, Error> {
        if let Some((_, done)) = self.done.iter().find(|(s, _)| s == setup) {
            return Ok(Rc::clone(done));
        }
        (self.announce)(&setup.to_string());
        let before = setup.apply(self.model, self.case);
        let run = solve(self.model, self.case, setup, self.interrupt);
        before.restore(self.model, self.case);
        let outcome = Rc::new(run?);
        if self.interrupt.is_some_and(|wanted| wanted.load(Ordering::Relaxed)) {
            return Err(Error::Interrupted);
        }
        self.done.push((setup.clone(), Rc::clone(&outcome)));
        Ok(outcome)
    }
}

fn solve(
    model: &Model,
    case: usize,
    setup: &Setup,
    interrupt: Option<&AtomicBool>,
) -> Result<Outcome, Error> {
    const FRAMES: usize = 100;
    let analysis = Analysis::new(model)?.with_frames(FRAMES);
    let (solver, dt) = (Some(setup.variant.solver), setup.variant.dt);
    let run = analysis.run(RunOptions { case, solver, dt, interrupt, ..RunOptions::default() })?;
    let turned =
        |u: &[f32]| u.chunks(6).flat_map(|n| &n[3..5]).fold(0.0_f32, |a, x| a.max(x.abs()));
    let rotation = run.record.frames().iter().map(|f| turned(&f.displacements));
    Ok(Outcome {
        time: run.time().to_vec(),
        histories: model
            .shown()
            .map(|(i, _)| run.record.history(i).unwrap_or_default().to_vec())
            .collect(),
        summary: run.summary(model),
        good: run.result.status.is_good(),
        order: analysis.system().order(),
        rotation: f64::from(rotation.fold(0.0, f32::max)),
    })
}
