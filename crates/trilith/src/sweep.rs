//! Sweeps: one model with many values of its parameters.
//!
//! Analyses of a small model go side by side, several to a core, where the model fits (see
//! [`solvers::lanes`](crate::solvers::lanes)): solver `fna`, links that have a form for lanes.
//! All others run one by one on the ordinary engine; the outcome is of the same kind and says how it came.
//!
//! ```
//! use trilith::sweep::Sweep;
//!
//! let text = r#"(
//!     plane: XZ, gravity: "1 g", parameters: { "mu": 0.3, "a": "1 m/s^2" },
//!     nodes: { "cg": (0, 0, 0) },
//!     elements: {
//!         "mass": Mass(node: "cg", mass: "1 t", inertia: (0, 1, 0)),
//!         "upright": Spring(node: "cg", r3: "1 MN*m"),
//!         "foot": NLink(node: "cg", kn: "10 MN/m", ks: "10 MN/m", mu: "mu", damping: "10 kN*s/m"),
//!     },
//!     functions: { "pulse": Sine(amplitude: "a", frequency: "2 Hz", cycles: 1) },
//!     cases: {
//!         "gravity": Static(loads: [Gravity]),
//!         "shake": Dynamic(after: "gravity", duration: "1 s", dt: "1 ms",
//!             base: [(direction: X, function: "pulse")]),
//!     },
//!     outputs: { "slide": Displacement(node: "cg", dof: Ux) },
//! )"#;
//! let sweep = Sweep::new(text, "foot.ron", trilith::registry()).case("shake").fixed_steps(1);
//! let grid: Vec<_> = [1.0, 2.0, 4.0]
//!     .iter()
//!     .map(|a| vec![("a".to_owned(), format!("{a} m/s^2"))])
//!     .collect();
//! let outcomes = sweep.run(&grid);
//! let slide = |i: usize| outcomes[i].as_ref().expect("a run").outputs.get("slide").expect("an output").max;
//! // Friction holds the mass below 0.3 g.
//! assert!(slide(0).abs() < 1e-3 && slide(2).abs() > 1e-3);
//! ```

use crate::{Analysis, Error, Registry, RunOptions};
use std::path::PathBuf;
use std::sync::atomic::{AtomicBool, AtomicUsize, Ordering};
use std::sync::{Arc, Mutex};
use trilith_model::{Diagnostic, Model, ModelText, StepControl};
use trilith_results::{Named, Peak};
use trilith_solvers::lanes::width;
use trilith_solvers::{ContactSummary, EnergyTotals, LinkEnergy, Status};

pub use crate::lanes::{Alone, Lanes};

/// Values of parameters, by name, as `--set` takes them.
pub type Combination = Vec<(String, String)>;

/// Why a combination has no outcome.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum SweepError {
    /// The model cannot be read with these values.
    #[error("{} error(s) in the model; the first: {}", .0.len(), .0.first().map_or("", |d| d.message.as_str()))]
    Model(Vec<Diagnostic>),
    /// It cannot be run.
    #[error(transparent)]
    Run(#[from] Error),
}

/// How an outcome was computed.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Engine {
    /// Side by side with others.
    Lanes,
    /// On the ordinary engine: the model or the case does not fit, for this reason.
    Ordinary(String),
    /// On the ordinary engine with adaptive steps, after its lane found no equilibrium, or none within the tolerance, in
    /// however short a step.
    Rerun,
}

/// What one combination gave.
#[derive(Clone, Debug)]
pub struct Outcome {
    /// How it was computed.
    pub engine: Engine,
    /// What there is to say of it.
    pub warnings: Vec<String>,
    /// How it ended.
    pub status: Status,
    /// Extremes and final values of the outputs, by name, SI.
    pub outputs: Named<Peak>,
    /// What [`Lanes`](Lanes::over_time) were told to take over time.
    pub integrals: Vec<f64>,
    /// Energies at the end, J.
    pub energy: EnergyTotals,
    /// Energies of every link at the end, by its name, J.
    pub link_energy: Named<LinkEnergy>,
    /// How the contacts behaved, for models with contacts.
    pub contact: Option<ContactSummary>,
    /// Steps.
    pub steps: usize,
    /// Iterations of the link equations.
    pub iterations: usize,
}

/// A model to be run with many values of its parameters.
#[derive(Debug)]
pub struct Sweep {
    text: String,
    path: PathBuf,
    registry: Registry,
    case: Option<String>,
    substeps: Option<usize>,
    threads: usize,
    width: usize,
    interrupt: Option<Arc<AtomicBool>>,
}

/// Most combinations that a thread takes at a time, in widths of the lanes.
const MOST: usize = 4;

impl Sweep {
    /// Of a model text; `path` as in [`read_text`](crate::read_text).
    #[must_use]
    pub fn new(text: impl Into<String>, path: impl Into<PathBuf>, registry: Registry) -> Self {
        let threads = std::thread::available_parallelism().map_or(1, std::num::NonZero::get);
        Self {
            text: text.into(),
            path: path.into(),
            registry,
            case: None,
            substeps: None,
            threads,
            width: width(),
            interrupt: None,
        }
    }

    /// The case to run; without it the last of the model.
    #[must_use]
    pub fn case(mut self, name: impl Into<String>) -> Self {
        self.case = Some(name.into());
        self
    }

    /// Fixed steps, so many to an output step, whatever the model says.
    #[must_use]
    pub fn fixed_steps(mut self, substeps: usize) -> Self {
        self.substeps = Some(substeps.max(1));
        self
    }

    /// Number of threads; without it as many as the machine runs at once. The outcomes are the same to
    /// the bit.
    #[must_use]
    pub fn threads(mut self, threads: usize) -> Self {
        self.threads = threads.max(1);
        self
    }

    /// Analyses side by side, at most as many as the machine's registers hold: 1 runs each alone, with
    /// the same bits.
    #[must_use]
    pub fn width(mut self, width: usize) -> Self {
        self.width = width.clamp(1, self::width());
        self
    }

    /// Once this is true, no combination is begun: those that are left have [`Error::Interrupted`] in the place of an
    /// outcome.
    #[must_use]
    pub fn until(mut self, interrupt: Arc<AtomicBool>) -> Self {
        self.interrupt = Some(interrupt);
        self
    }

    fn is_over(&self) -> bool {
        self.interrupt.as_ref().is_some_and(|wanted| wanted.load(Ordering::Relaxed))
    }

    /// Runs all combinations; outcomes in their order.
    #[must_use]
    pub fn run(&self, combinations: &[Combination]) -> Vec<Result<Outcome, SweepError>> {
        let parsed = match ModelText::new(&self.text, &self.path) {
            Ok(parsed) => parsed,
            Err(errors) => {
                let failed = || Err(SweepError::Model(errors.clone()));
                return combinations.iter().map(|_| failed()).collect();
            }
        };
        let lanes = Lanes::new().at_most(self.width);
        let all = combinations.len();
        let threads = self.threads.min(all.div_ceil(self.width)).max(1);
        let after = |start: usize| start + share(all - start, self.width, threads);
        let next = AtomicUsize::new(0);
        let done = Mutex::new(Vec::new());
        let work = || {
            let take = |start| (start < all).then(|| after(start));
            while !self.is_over()
                && let Ok(start) = next.fetch_update(Ordering::Relaxed, Ordering::Relaxed, take)
            {
                let outcomes = self.portion(&parsed, &combinations[start..after(start)], &lanes);
                if let Ok(mut done) = done.lock() {
                    done.push((start, outcomes));
                }
            }
        };
        // Analyses are shared among threads, so none of them is.
        let work = || trilith_solvers::alone(work);
        std::thread::scope(|scope| {
            for _ in 1..threads {
                scope.spawn(work);
            }
            work();
        });
        let mut done = done.into_inner().unwrap_or_default();
        done.sort_by_key(|(start, _)| *start);
        let mut outcomes: Vec<_> = done.into_iter().flat_map(|(_, outcomes)| outcomes).collect();
        // Whatever was taken was done, from the first on.
        outcomes.resize_with(all, || Err(Error::Interrupted.into()));
        outcomes
    }

    fn portion(
        &self,
        parsed: &ModelText,
        combinations: &[Combination],
        lanes: &Lanes,
    ) -> Vec<Result<Outcome, SweepError>> {
        let models: Vec<Result<(Model, usize), SweepError>> =
            combinations.iter().map(|c| self.model(parsed, c)).collect();
        let cases = models.iter().filter_map(|m| m.as_ref().ok());
        let cases: Vec<(&Model, usize)> = cases.map(|(model, case)| (model, *case)).collect();
        let mut found = lanes.run(&cases, self.substeps).into_iter();
        let one = |read: Result<(Model, usize), SweepError>| {
            let (model, case) = read?;
            match found.next() {
                Some(Ok(outcome)) => Ok(outcome),
                Some(Err(Alone::Failed(e))) => Err(e.into()),
                Some(Err(Alone::Unfit(reason))) => {
                    self.ordinary(model, case, self.substeps, Engine::Ordinary(reason))
                }
                Some(Err(Alone::Odd)) => {
                    let reason = "it ends as no model is meant to, which its warnings say";
                    self.ordinary(model, case, self.substeps, Engine::Ordinary(reason.into()))
                }
                Some(Err(Alone::Lost)) | None => self.ordinary(model, case, None, Engine::Rerun),
            }
        };
        models.into_iter().map(one).collect()
    }

    fn index(&self, model: &Model) -> Result<usize, Error> {
        match &self.case {
            Some(name) => model.case(name).ok_or_else(|| Error::unknown_case(model, name)),
            None => model.cases.len().checked_sub(1).ok_or_else(|| Error::unknown_case(model, "")),
        }
    }

    fn model(
        &self,
        parsed: &ModelText,
        combination: &Combination,
    ) -> Result<(Model, usize), SweepError> {
        let model = parsed.read(&self.registry, combination).map_err(SweepError::Model)?;
        let case = self.index(&model)?;
        Ok((model, case))
    }

    /// Runs a model on the ordinary engine.
    fn ordinary(
        &self,
        mut model: Model,
        case: usize,
        substeps: Option<usize>,
        engine: Engine,
    ) -> Result<Outcome, SweepError> {
        if let trilith_model::Analysis::Dynamic(analysis) = &mut model.cases[case].analysis {
            if let Some(substeps) = substeps {
                analysis.solution.step = StepControl::Fixed { substeps };
            }
            if engine == Engine::Rerun {
                analysis.solution.step = StepControl::default();
            }
        }
        let interrupt = self.interrupt.as_deref();
        let options = RunOptions { case, interrupt, ..RunOptions::default() };
        let run = Analysis::new(&model)?.run(options)?;
        if self.is_over() && matches!(run.result.status, Status::Interrupted { .. }) {
            return Err(Error::Interrupted.into());
        }
        let output = |(i, o): (usize, &trilith_model::Output)| {
            run.record.peaks().get(i).map(|peak| (o.name.clone(), *peak))
        };
        let result = &run.result;
        Ok(Outcome {
            integrals: Vec::new(),
            engine,
            warnings: result.warnings.clone(),
            status: result.status.clone(),
            outputs: Named(model.outputs.iter().enumerate().filter_map(output).collect()),
            energy: result.energy,
            link_energy: named(&model, &result.link_energy),
            contact: run.contact.clone(),
            steps: result.work.substeps,
            iterations: result.work.iterations,
        })
    }
}

/// How many of the combinations that are left a thread takes: whole widths, and fewer towards the end, so that no
/// thread is left with much while the others have nothing.
fn share(left: usize, width: usize, threads: usize) -> usize {
    let widths = left / (2 * threads * width);
    (widths.clamp(1, MOST) * width).min(left)
}

pub(crate) fn named(model: &Model, links: &[(usize, LinkEnergy)]) -> Named<LinkEnergy> {
    let one = |(element, energy): &(usize, LinkEnergy)| {
        model.elements.get(*element).map(|e| (e.name.clone(), *energy))
    };
    Named(links.iter().filter_map(one).collect())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_an_interrupt_leaves_says_so() {
        let stopped = Arc::new(AtomicBool::new(true));
        let sweep = Sweep::new("()", "a.ron", Registry::new()).threads(2).until(stopped);
        let outcomes = sweep.run(&vec![Vec::new(); 5]);
        let interrupted =
            |o: &Result<Outcome, SweepError>| matches!(o, Err(SweepError::Run(Error::Interrupted)));
        assert!(outcomes.len() == 5 && outcomes.iter().all(interrupted));
    }

    #[test]
    fn shares_are_whole_widths_and_small_at_the_end() {
        for (all, width, threads) in [(64, 8, 2), (1000, 8, 3), (7, 8, 1), (100, 1, 4), (0, 8, 2)] {
            let mut left = all;
            let mut before = usize::MAX;
            while left > 0 {
                let taken = share(left, width, threads);
                assert!(taken > 0 && taken <= before.min(MOST * width), "{taken} of {left}");
                assert!(taken.is_multiple_of(width) || taken == left);
                // At most half of what falls to a thread, unless it is the least there is.
                assert!(taken <= width || 2 * threads * taken <= left);
                (left, before) = (left - taken, taken);
            }
        }
    }
}
