//! The runs of a study: one by itself, or several side by side.

use crate::column::{self, Watch};
use crate::finished::Finished;
use crate::{Cell, Place, Record, Records, Row, Study, StudyError};
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::path::Path;
use std::sync::atomic::AtomicBool;
use trilith::combine::combine_until;
use trilith::model::file::{NoNames, evaluate};
use trilith::model::{Model, ParameterValue};
use trilith::sweep::{Alone, Lanes, Outcome};
use trilith::{Analysis, Registry, RunOptions, SolverKind};

impl Study {
    /// Why its runs go one by one; none where they go side by side.
    #[must_use]
    pub fn alone(&self, registry: &Registry) -> Option<String> {
        if self.histories.is_some() {
            return Some("histories are kept".into());
        }
        if self.combination.is_some() {
            return Some("a combination runs several cases".into());
        }
        if self.solver.is_some_and(|solver| solver != SolverKind::Fna) {
            return Some("another solver than fna".into());
        }
        // What the first run says, all say that differ in numbers alone; the others are asked by themselves.
        let model = self.model(registry, &self.plan.place(0)).ok()?;
        Lanes::new().check(&model, self.case).ok()?.err()
    }

    /// The model of a run; none where it cannot be read, or where that panics: [`run`](Self::run) says why.
    pub(crate) fn try_model(&self, registry: &Registry, run: usize) -> Option<Model> {
        let read = || self.model(registry, &self.plan.place(run)).ok();
        catch_unwind(AssertUnwindSafe(read)).ok().flatten()
    }

    /// Makes those of the runs that go side by side; each is `done` with as soon as it is there, by its place. Where that
    /// says no, none is begun any more. False where a law panicked: the run that it is in tells so when it goes alone.
    pub(crate) fn beside(
        &self,
        lanes: &Lanes,
        models: &[&Model],
        done: &mut dyn FnMut(usize, Finished) -> bool,
    ) -> bool {
        let cases: Vec<(&Model, usize)> = models.iter().map(|m| (*m, self.case)).collect();
        let mut finished = |place: usize, found: Result<Outcome, Alone>| {
            let Ok(found) = found else { return true };
            let Outcome { status, outputs, integrals, energy, contact, warnings, .. } = found;
            let (contact, peaks) = (contact.as_ref(), outputs.0.iter().map(|(_, peak)| *peak));
            done(place, Finished::new(&status, &warnings, contact, &energy, peaks, &integrals))
        };
        let run = AssertUnwindSafe(|| lanes.run_each(&cases, None, &mut finished));
        catch_unwind(run).is_ok()
    }

    /// Makes one run, by its number, with what it came to where it came to an end. Whatever goes wrong in it is told in
    /// the record.
    pub(crate) fn run(
        &self,
        registry: &Registry,
        run: usize,
        folder: &Path,
        interrupt: &AtomicBool,
    ) -> Result<(Record, Option<Finished>), StudyError> {
        let place = self.plan.place(run);
        let made =
            catch_unwind(AssertUnwindSafe(|| self.make(registry, run, &place, folder, interrupt)));
        made.unwrap_or_else(|panic| {
            let text = panic.downcast_ref::<String>().cloned();
            let text = text.or_else(|| panic.downcast_ref::<&str>().map(|s| (*s).to_owned()));
            let message = text.unwrap_or_else(|| "the program gave up".into());
            Ok((self.failed(run, &self.plan.nominal(&place), "panic", &message), None))
        })
    }

    fn make(
        &self,
        registry: &Registry,
        run: usize,
        place: &Place,
        folder: &Path,
        interrupt: &AtomicBool,
    ) -> Result<(Record, Option<Finished>), StudyError> {
        let set = self.plan.nominal(place);
        let model = match self.model(registry, place) {
            Ok(model) => model,
            Err(message) => return Ok((self.failed(run, &set, "model error", &message), None)),
        };
        if let Some(name) = &self.combination {
            let names = std::slice::from_ref(name);
            let found = combine_until(&model, names, &mut |_, _| (), Some(interrupt));
            let finished = match found.as_ref().map(|found| Finished::combined(&model, found)) {
                Ok(finished) => finished,
                Err(e) => {
                    let failed = self.failed(run, &set, "error", &e.to_string());
                    return Ok((Record { parameters: self.cells(&model), ..failed }, None));
                }
            };
            return Ok((self.record(run, &model, &finished), Some(finished)));
        }
        let mut watch = Watch::new(&self.columns);
        let histories = self.histories.is_some();
        let made = Analysis::new(&model).and_then(|a| {
            let a = if histories { a } else { a.without_histories() };
            let options = RunOptions {
                case: self.case,
                solver: self.solver,
                interrupt: Some(interrupt),
                ..RunOptions::default()
            };
            a.observed(options, &mut [&mut watch])
        });
        match made {
            Ok(made) => {
                let finished = Finished::new(
                    &made.result.status,
                    &made.result.warnings,
                    made.contact.as_ref(),
                    &made.result.energy,
                    made.record.peaks().iter().copied(),
                    &watch.values(),
                );
                let record = self.record(run, &model, &finished);
                if self.keeps_histories(&record) {
                    let own = folder.join("runs").join(format!("{:06}", run + 1));
                    let fail = |e: trilith::Error| {
                        let cause = std::io::Error::other(e.to_string());
                        StudyError::File { path: own.clone(), cause }
                    };
                    made.write(&model, &own).map_err(fail)?;
                }
                Ok((record, Some(finished)))
            }
            Err(e) => {
                let failed = self.failed(run, &set, "error", &e.to_string());
                Ok((Record { parameters: self.cells(&model), ..failed }, None))
            }
        }
    }

    /// True for a run whose histories the study keeps.
    pub(crate) fn keeps_histories(&self, record: &Record) -> bool {
        self.histories.as_ref().is_some_and(|c| {
            let alone = Records::from_iter([record.clone()]);
            alone.iter().all(|row| c.holds(&self.columns, row))
        })
    }

    /// True for a run with which its series is at its end.
    pub(crate) fn ends_with(&self, run: Row<'_>) -> bool {
        self.stop.as_ref().is_some_and(|stop| stop.holds(&self.columns, run))
    }

    /// The model of a run.
    fn model(&self, registry: &Registry, place: &Place) -> Result<Model, String> {
        let read = |set: &[(String, String)]| {
            let model = self
                .text
                .read(registry, set)
                .map_err(|errors| errors.first().map_or_else(String::new, |d| d.message.clone()))?;
            match self.shape.misfit(&model) {
                None => Ok(model),
                Some(message) => Err(message),
            }
        };
        let mut set = self.plan.nominal(place);
        let model = read(&set)?;
        let mut factors = self.plan.factors(place.member).peekable();
        if factors.peek().is_none() {
            return Ok(model);
        }
        for (name, factor) in factors {
            let parameter = model.parameters.iter().find(|p| p.name == name);
            if let Some(ParameterValue::Number(x, dimension)) = parameter.map(|p| &p.value) {
                set.retain(|(n, _)| n != name);
                set.push((name.to_owned(), crate::number::written(x * factor, *dimension)));
            }
        }
        read(&set)
    }

    /// The row of a run that came to this.
    pub(crate) fn record(&self, run: usize, model: &Model, left: &Finished) -> Record {
        let contact = left.contact.as_ref();
        let values = if left.good {
            column::values(&self.columns, model, left)
        } else {
            vec![None; self.columns.len()]
        };
        Record {
            run,
            status: left.status.clone(),
            good: left.good,
            message: left.message.clone(),
            warnings: left.warnings.clone(),
            overturned: contact.is_some_and(|c| c.overturned),
            initial_mode: contact.filter(|_| left.good).map(|c| c.initial_mode.clone()),
            mode: contact.filter(|_| left.good).map(|c| c.mode.clone()),
            parameters: self.cells(model),
            values,
        }
    }

    fn cells(&self, model: &Model) -> Vec<Cell> {
        let one = |name: &String| match model.parameters.iter().find(|p| p.name == *name) {
            Some(p) => match &p.value {
                ParameterValue::Number(x, _) => Cell::Number(*x),
                ParameterValue::Text(t) => Cell::Text(t.clone()),
            },
            None => Cell::Nothing,
        };
        self.varied.iter().map(one).collect()
    }

    /// A run that came to no result. The values asked for are told as far as they are numbers by themselves.
    fn failed(&self, run: usize, set: &[(String, String)], status: &str, message: &str) -> Record {
        let cell = |name: &String| {
            let Some((_, text)) = set.iter().rev().find(|(n, _)| n == name) else {
                return Cell::Nothing;
            };
            if self.is_text(name) {
                return Cell::Text(text.clone());
            }
            match evaluate(text, &mut NoNames) {
                Ok(q) => Cell::Number(q.value),
                Err(_) => Cell::Nothing,
            }
        };
        Record {
            run,
            status: status.to_owned(),
            good: false,
            message: message.to_owned(),
            warnings: Vec::new(),
            overturned: false,
            initial_mode: None,
            mode: None,
            parameters: self.varied.iter().map(cell).collect(),
            values: vec![None; self.columns.len()],
        }
    }
}
