//! Running a study: all cores, one run a task, every finished run on disk at once.

use crate::column::over_time;
use crate::journal::Journal;
use crate::{Record, Study, StudyError};
use std::collections::BTreeMap;
use std::fs::OpenOptions;
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::path::{Path, PathBuf};
use std::sync::Mutex;
use std::sync::atomic::{AtomicBool, AtomicUsize, Ordering};
use std::time::{Duration, Instant};
use trilith::Registry;
use trilith::sweep::Lanes;

/// Shares of runs that take less than this grow.
const SOON: Duration = Duration::from_millis(200);
/// Widths of the lanes in a share at most.
const SHARES: usize = 8;

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
    /// New runs that went side by side, several to a core.
    pub beside: usize,
    /// Why none did, where the study does not fit.
    pub alone: Option<String>,
}

impl Results {
    /// Runs that failed.
    #[must_use]
    pub fn failed(&self) -> usize {
        self.records.iter().filter(|r| !r.good).count()
    }

    /// Runs that warned of something.
    #[must_use]
    pub fn warned(&self) -> usize {
        self.records.iter().filter(|r| !r.warnings.is_empty()).count()
    }
}

/// What the workers share.
struct Shared<'a> {
    study: &'a Study,
    registry: &'a Registry,
    folder: &'a Path,
    /// None where runs go one by one.
    lanes: Option<Lanes>,
    /// Chains that a thread takes at once.
    width: usize,
    beside: AtomicUsize,
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
    let chains = total / study.plan.chain_length();
    let (lanes, alone) = match study.alone(registry) {
        None => (Some(Lanes::new().over_time(over_time(&study.columns))), None),
        reason => (None, reason),
    };
    // Where there are few, all threads have some.
    let width = lanes.as_ref().map_or(1, |l| l.width().min(chains.div_ceil(threads.max(1))).max(1));
    let (resumed, torn) = (kept.records.len(), kept.torn);
    let shared = Shared {
        study,
        registry,
        folder,
        lanes,
        width,
        beside: AtomicUsize::new(0),
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
    std::thread::scope(|scope| {
        for _ in 1..threads.min(chains.div_ceil(width)).max(1) {
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
    let beside = shared.beside.into_inner();
    Ok(Results { records, resumed, torn, left_out, files, beside, alone })
}

impl Shared<'_> {
    fn work(&self, chains: usize) {
        let length = self.study.plan.chain_length();
        let mut share = self.width;
        while !self.stops() {
            let start = Instant::now();
            let first = self.next.fetch_add(share, Ordering::Relaxed);
            if first >= chains {
                break;
            }
            let own = first..chains.min(first + share);
            if let Err(error) = self.chains(own.map(|chain| chain * length).collect(), length) {
                self.stop.store(true, Ordering::Relaxed);
                if let Ok(mut first) = self.error.lock() {
                    first.get_or_insert(error);
                }
            }
            // A lane that has come to its end takes the next run of the share: the more there are, the fewer lanes are idle,
            // but the longer nothing of it is on disk.
            if self.lanes.is_some() && start.elapsed() < SOON && share < SHARES * self.width {
                share *= 2;
            }
        }
    }

    fn stops(&self) -> bool {
        [&self.stop, self.interrupt].iter().any(|flag| flag.load(Ordering::Relaxed))
    }

    /// Runs chains beside each other, each until its limit; `firsts`: their first runs.
    fn chains(&self, mut firsts: Vec<usize>, length: usize) -> Result<(), StudyError> {
        for step in 0..length {
            if self.stops() || firsts.is_empty() {
                return Ok(());
            }
            let runs: Vec<usize> = firsts.iter().map(|first| first + step).collect();
            let new: Vec<usize> =
                runs.iter().copied().filter(|run| !self.kept.contains_key(run)).collect();
            let Some(made) = self.make(&new)? else { return Ok(()) };
            let mut made = made.into_iter();
            let mut going = Vec::with_capacity(firsts.len());
            for (first, run) in firsts.into_iter().zip(runs) {
                let Some(record) = self.kept.get(&run).cloned().or_else(|| made.next()) else {
                    continue;
                };
                let study = self.study;
                let over = study.stop.as_ref().is_some_and(|c| c.holds(&study.columns, &record));
                self.count(if over { length - step } else { 1 }, !record.good);
                if let Ok(mut found) = self.found.lock() {
                    found.push(record);
                }
                if !over {
                    going.push(first);
                }
            }
            firsts = going;
        }
        Ok(())
    }

    /// Makes runs, side by side where they fit; each is on disk as soon as it is done. None where that was interrupted.
    fn make(&self, runs: &[usize]) -> Result<Option<Vec<Record>>, StudyError> {
        let (study, registry) = (self.study, self.registry);
        let beside = self.lanes.as_ref().map(|lanes| {
            // Where a law panics, the run that it is in tells so when it goes alone.
            catch_unwind(AssertUnwindSafe(|| study.beside(registry, lanes, runs)))
        });
        let beside = beside.and_then(Result::ok).unwrap_or_default();
        beside.iter().try_for_each(|record| self.write(record))?;
        self.beside.fetch_add(beside.len(), Ordering::Relaxed);
        let mut beside = beside.into_iter().peekable();
        let mut made = Vec::with_capacity(runs.len());
        for run in runs {
            if let Some(record) = beside.next_if(|record| record.run == *run) {
                made.push(record);
                continue;
            }
            let record = study.run(registry, *run, self.folder, self.interrupt)?;
            if self.interrupt.load(Ordering::Relaxed) {
                // It may have been cut short.
                return Ok(None);
            }
            self.write(&record)?;
            made.push(record);
        }
        Ok(Some(made))
    }

    fn write(&self, record: &Record) -> Result<(), StudyError> {
        self.journal.lock().map_or(Ok(()), |mut journal| journal.write(record))
    }

    fn count(&self, runs: usize, failed: bool) {
        let done = self.done.fetch_add(runs, Ordering::Relaxed) + runs;
        let failed =
            self.failed.fetch_add(usize::from(failed), Ordering::Relaxed) + usize::from(failed);
        (self.progress)(Progress { done, total: self.total, failed });
    }
}
