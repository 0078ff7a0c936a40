//! The runs of a search, and what is asked of each.

use super::terms::{Goal, Limit, Valued, Values};
use super::variables::Range;
use super::{Evaluation, OptimizeError, Stop};
use crate::Error;
use crate::gradient::{self, GradientError};
use std::sync::atomic::{AtomicBool, Ordering};
use trilith_model::{ModelText, Registry};
use trilith_solvers::gradient::Bend;

/// Why there is no value.
#[derive(Debug, thiserror::Error)]
pub(super) enum Refusal {
    #[error("stopped")]
    Stopped(Stop),
    #[error(transparent)]
    Wrong(OptimizeError),
}

/// What a search needs of a run: by y.
#[derive(Clone, Debug)]
pub(super) struct Made {
    /// As multiple of the goal at the start.
    pub goal: Valued,
    /// Shares of the bounds.
    pub limits: Vec<Valued>,
}

/// What is shown every run with its number from 0.
pub(super) type OnRun<'a> = &'a mut dyn FnMut(usize, &Evaluation);

/// The runs made so far.
pub(super) struct Course<'a> {
    pub text: &'a ModelText,
    pub registry: &'a Registry,
    /// What is asked of the gradient, but for the values of the variables.
    pub wanted: gradient::Wanted,
    pub ranges: &'a [Range],
    pub goal: &'a Goal,
    pub limits: &'a [Limit],
    pub most: usize,
    pub on_run: OnRun<'a>,
    pub interrupt: &'a AtomicBool,
    /// Goal at the start.
    pub size: f64,
    pub goal_unit: String,
    pub limit_units: Vec<String>,
    made: Vec<(Vec<f64>, Option<Made>)>,
    pub told: Vec<Evaluation>,
    pub bends: Vec<Vec<Bend>>,
}

impl<'a> Course<'a> {
    pub(super) fn new(
        (text, registry): (&'a ModelText, &'a Registry),
        wanted: gradient::Wanted,
        ranges: &'a [Range],
        (goal, limits): (&'a Goal, &'a [Limit]),
        most: usize,
        (on_run, interrupt): (OnRun<'a>, &'a AtomicBool),
    ) -> Self {
        Self {
            text,
            registry,
            wanted,
            ranges,
            goal,
            limits,
            most,
            on_run,
            interrupt,
            size: 1.0,
            goal_unit: String::new(),
            limit_units: Vec::new(),
            made: Vec::new(),
            told: Vec::new(),
            bends: Vec::new(),
        }
    }

    pub(super) fn limits(&self) -> usize {
        self.limits.len()
    }

    /// The run at y, made unless it has been; none where it fails.
    pub(super) fn at(&mut self, y: &[f64]) -> Result<Option<&Made>, Refusal> {
        let known = self.made.iter().position(|(there, _)| there == y);
        let index = match known {
            Some(index) => index,
            None => self.run(y)?,
        };
        Ok(self.made[index].1.as_ref())
    }

    fn run(&mut self, y: &[f64]) -> Result<usize, Refusal> {
        if self.interrupt.load(Ordering::Relaxed) {
            return Err(Refusal::Stopped(Stop::Interrupted));
        }
        if self.told.len() >= self.most {
            return Err(Refusal::Stopped(Stop::Spent));
        }
        let x: Vec<f64> = self.ranges.iter().zip(y).map(|(r, y)| r.at(*y)).collect();
        let mut wanted = self.wanted.clone();
        for (range, x) in self.ranges.iter().zip(&x) {
            wanted.set.retain(|(name, _)| *name != range.name);
            wanted.set.push((range.name.clone(), gradient::expression(*x, range.dimension)));
        }
        let first = self.told.is_empty();
        let made = match gradient::whole(self.text, self.registry, &wanted, Some(self.interrupt)) {
            Ok(whole) => whole,
            Err(GradientError::Run(Error::Interrupted)) => {
                return Err(Refusal::Stopped(Stop::Interrupted));
            }
            // A run within a search may fail: it went too far. The first one is as the user wants it.
            Err(error) if first => return Err(Refusal::Wrong(error.into())),
            Err(error) => {
                let failed = Some(reason(&error));
                return Ok(self.push(
                    y,
                    None,
                    Evaluation { x, failed, ..Evaluation::default() },
                    Vec::new(),
                ));
            }
        };
        let values = Values::new(&made.model, &made.found, &made.around);
        let (mut goal, largest, unit) = self.goal.of(&values).map_err(Refusal::Wrong)?;
        let slopes: Vec<f64> = self.ranges.iter().zip(y).map(|(r, y)| r.slope(*y)).collect();
        let by_y = |by: &mut Vec<f64>, factor: f64| {
            by.resize(slopes.len(), 0.0);
            by.iter_mut().zip(&slopes).for_each(|(x, slope)| *x *= slope * factor);
        };
        if first {
            self.goal_unit = unit.dimension.unit();
            self.size = if goal.value == 0.0 { 1.0 } else { goal.value.abs() };
        }
        let smooth = goal.value;
        goal.value /= self.size;
        by_y(&mut goal.by, 1.0 / self.size);
        let (mut limits, mut sides, mut units) = (Vec::new(), Vec::new(), Vec::new());
        for limit in self.limits {
            let (both, mut beyond, unit) = limit.of(&values).map_err(Refusal::Wrong)?;
            by_y(&mut beyond.by, 1.0);
            sides.push(both);
            limits.push(beyond);
            units.push(unit.dimension.unit());
        }
        if first {
            self.limit_units = units;
            let still = |v: &Valued| v.by.iter().all(|x| *x == 0.0);
            if still(&goal) && limits.iter().all(still) {
                let names = self.ranges.iter().map(|r| r.name.clone()).collect();
                return Err(Refusal::Wrong(OptimizeError::NothingMoves(names)));
            }
        }
        let evaluation = Evaluation {
            x,
            goal: largest,
            smooth,
            beyond: limits.iter().map(|l| l.value).collect(),
            sides,
            substeps: made.found.substeps,
            failed: None,
        };
        Ok(self.push(y, Some(Made { goal, limits }), evaluation, made.found.bends))
    }

    fn push(
        &mut self,
        y: &[f64],
        made: Option<Made>,
        evaluation: Evaluation,
        bends: Vec<Bend>,
    ) -> usize {
        self.made.push((y.to_vec(), made));
        self.told.push(evaluation);
        self.bends.push(bends);
        let index = self.told.len() - 1;
        (self.on_run)(index, &self.told[index]);
        index
    }
}

fn reason(error: &GradientError) -> String {
    error.to_string()
}
