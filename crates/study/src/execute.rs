//! Running a study: all cores, one run a task, every finished run on disk at once.

use crate::column::{self, Watch};
use crate::journal::Journal;
use crate::{Cell, Place, Record, Study, StudyError};
use std::collections::BTreeMap;
use std::fs::OpenOptions;
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::path::{Path, PathBuf};
use std::sync::Mutex;
use std::sync::atomic::{AtomicBool, AtomicUsize, Ordering};
use trilith::model::file::{NoNames, evaluate};
use trilith::model::{Model, ParameterValue};
use trilith::{Analysis, Registry, Run, RunOptions};

/// How far a study is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Progress {
    /// Runs that are done, those of an earlier start and those left out beyond a limit included.
    pub done: usize,
    /// All runs.
    pub total: usize,
    /// Runs that failed.
    pub failed: usize,
}

/// What a study left.
#[derive(Debug)]
pub struct Results {
    /// The finished runs, in the order of their numbers.
    pub records: Vec<Record>,
    /// Runs that were on disk already.
    pub resumed: usize,
    /// Lines of the journal that were torn; their runs were run again.
    pub torn: usize,
    /// Runs left out because the series had reached its limit.
    pub left_out: usize,
    /// Files written.
    pub files: Vec<PathBuf>,
}

impl Results {
    /// Runs that failed.
    #[must_use]
    pub fn failed(&self) -> usize {
        self.records.iter().filter(|r| !r.good).count()
    }
}

/// What the workers share.
struct Shared<'a> {
    study: &'a Study,
    registry: &'a Registry,
    folder: &'a Path,
    kept: BTreeMap<usize, Record>,
    journal: Mutex<Journal>,
    found: Mutex<Vec<Record>>,
    error: Mutex<Option<StudyError>>,
    stop: AtomicBool,
    interrupt: &'a AtomicBool,
    next: AtomicUsize,
    done: AtomicUsize,
    failed: AtomicUsize,
    total: usize,
    progress: &'a (dyn Fn(Progress) + Sync),
}

/// Runs a study into a folder, or goes on with it, and writes its tables and its page.
///
/// Once `interrupt` is true, no run is begun, and those under way are given up.
///
/// # Errors
/// [`StudyError`] where the folder cannot be written or belongs to something else, or where it was interrupted. Runs that
/// fail are no error: they are rows of the table.
pub fn execute(
    study: &Study,
    registry: &Registry,
    folder: &Path,
    threads: usize,
    progress: &(dyn Fn(Progress) + Sync),
    interrupt: &AtomicBool,
) -> Result<Results, StudyError> {
    std::fs::create_dir_all(folder).map_err(StudyError::at(folder))?;
    // The system lets go of the lock when the process ends, however it ends.
    let lock_path = folder.join("lock");
    let lock = OpenOptions::new().write(true).create(true).truncate(false).open(&lock_path);
    let lock = lock.map_err(StudyError::at(&lock_path))?;
    match lock.try_lock() {
        Ok(()) => {}
        Err(std::fs::TryLockError::WouldBlock) => {
            return Err(StudyError::Locked { folder: folder.to_owned() });
        }
        Err(std::fs::TryLockError::Error(e)) => return Err(StudyError::at(&lock_path)(e)),
    }
    let (journal, kept) = Journal::open(&folder.join("runs.journal"), &study.identity)?;
    let total = study.identity.runs;
    let (resumed, torn) = (kept.records.len(), kept.torn);
    let shared = Shared {
        study,
        registry,
        folder,
        kept: kept.records,
        journal: Mutex::new(journal),
        found: Mutex::new(Vec::new()),
        error: Mutex::new(None),
        stop: AtomicBool::new(false),
        interrupt,
        next: AtomicUsize::new(0),
        done: AtomicUsize::new(0),
        failed: AtomicUsize::new(0),
        total,
        progress,
    };
    let chains = total / study.plan.chain_length();
    std::thread::scope(|scope| {
        for _ in 1..threads.min(chains).max(1) {
            scope.spawn(|| shared.work(chains));
        }
        shared.work(chains);
    });
    if let Some(error) = shared.error.into_inner().unwrap_or_default() {
        return Err(error);
    }
    if let Ok(mut journal) = shared.journal.lock() {
        journal.sync()?;
    }
    if interrupt.load(Ordering::Relaxed) {
        let done = shared.done.into_inner();
        return Err(StudyError::Interrupted { done, total, folder: folder.to_owned() });
    }
    let mut records = shared.found.into_inner().unwrap_or_default();
    records.sort_by_key(|r| r.run);
    let left_out = total - records.len();
    let files = crate::files::write(study, &records, left_out, folder)?;
    Ok(Results { records, resumed, torn, left_out, files })
}

impl Shared<'_> {
    fn work(&self, chains: usize) {
        let length = self.study.plan.chain_length();
        while !self.stops() {
            let chain = self.next.fetch_add(1, Ordering::Relaxed);
            if chain >= chains {
                break;
            }
            if let Err(error) = self.chain(chain * length, length) {
                self.stop.store(true, Ordering::Relaxed);
                if let Ok(mut first) = self.error.lock() {
                    first.get_or_insert(error);
                }
            }
        }
    }

    fn stops(&self) -> bool {
        [&self.stop, self.interrupt].iter().any(|flag| flag.load(Ordering::Relaxed))
    }

    /// Runs one after the other until the limit.
    fn chain(&self, first: usize, length: usize) -> Result<(), StudyError> {
        for run in first..first + length {
            if self.stops() {
                return Ok(());
            }
            let record = match self.kept.get(&run) {
                Some(record) => record.clone(),
                None => {
                    let record = self.study.run(self.registry, run, self.folder, self.interrupt)?;
                    if self.interrupt.load(Ordering::Relaxed) {
                        // It may have been cut short.
                        return Ok(());
                    }
                    if let Ok(mut journal) = self.journal.lock() {
                        journal.write(&record)?;
                    }
                    record
                }
            };
            let study = self.study;
            let over = study.stop.as_ref().is_some_and(|c| c.holds(&study.columns, &record));
            self.count(if over { first + length - run } else { 1 }, !record.good);
            if let Ok(mut found) = self.found.lock() {
                found.push(record);
            }
            if over {
                break;
            }
        }
        Ok(())
    }

    fn count(&self, runs: usize, failed: bool) {
        let done = self.done.fetch_add(runs, Ordering::Relaxed) + runs;
        let failed =
            self.failed.fetch_add(usize::from(failed), Ordering::Relaxed) + usize::from(failed);
        (self.progress)(Progress { done, total: self.total, failed });
    }
}

impl Study {
    /// Makes one run, by its number. Whatever goes wrong in it is told in the record.
    fn run(
        &self,
        registry: &Registry,
        run: usize,
        folder: &Path,
        interrupt: &AtomicBool,
    ) -> Result<Record, StudyError> {
        let place = self.plan.place(run);
        let made =
            catch_unwind(AssertUnwindSafe(|| self.make(registry, run, &place, folder, interrupt)));
        made.unwrap_or_else(|panic| {
            let text = panic.downcast_ref::<String>().cloned();
            let text = text.or_else(|| panic.downcast_ref::<&str>().map(|s| (*s).to_owned()));
            let message = text.unwrap_or_else(|| "the program gave up".into());
            Ok(self.failed(run, &self.plan.nominal(&place), "panic", &message))
        })
    }

    fn make(
        &self,
        registry: &Registry,
        run: usize,
        place: &Place,
        folder: &Path,
        interrupt: &AtomicBool,
    ) -> Result<Record, StudyError> {
        let set = self.plan.nominal(place);
        let model = match self.model(registry, place) {
            Ok(model) => model,
            Err(message) => return Ok(self.failed(run, &set, "model error", &message)),
        };
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
        let record = match made {
            Ok(made) => {
                let record = self.record(run, &model, &made, &watch);
                if self.histories.as_ref().is_some_and(|c| c.holds(&self.columns, &record)) {
                    let own = folder.join("runs").join(format!("{:06}", run + 1));
                    let fail = |e: trilith::Error| {
                        let cause = std::io::Error::other(e.to_string());
                        StudyError::File { path: own.clone(), cause }
                    };
                    made.write(&model, &own).map_err(fail)?;
                }
                record
            }
            Err(e) => Record {
                parameters: self.cells(&model),
                ..self.failed(run, &set, "error", &e.to_string())
            },
        };
        Ok(record)
    }

    /// The model of a run.
    fn model(&self, registry: &Registry, place: &Place) -> Result<Model, String> {
        let read = |set: &[(String, String)]| {
            self.text
                .read(registry, set)
                .map_err(|errors| errors.first().map_or_else(String::new, |d| d.message.clone()))
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

    fn record(&self, run: usize, model: &Model, made: &Run, watch: &Watch) -> Record {
        let status = &made.result.status;
        let contact = made.contact.as_ref();
        let good = status.is_good();
        let values = if good {
            column::values(&self.columns, model, made, watch)
        } else {
            vec![None; self.columns.len()]
        };
        let told = matches!(status, trilith::solvers::Status::Converged);
        Record {
            run,
            status: status.word().to_owned(),
            good,
            message: if told { String::new() } else { status.text() },
            overturned: contact.is_some_and(|c| c.overturned),
            initial_mode: contact.filter(|_| good).map(|c| c.initial_mode.to_owned()),
            mode: contact.filter(|_| good).map(|c| c.mode.to_owned()),
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
            overturned: false,
            initial_mode: None,
            mode: None,
            parameters: self.varied.iter().map(cell).collect(),
            values: vec![None; self.columns.len()],
        }
    }
}
