//! Running a study, or a part of it: all cores, every finished run on disk at once.

mod make;

use crate::column::over_time;
use crate::journal::{Journal, Kept};
use crate::shard::journals;
use crate::store::{Keys, Store};
use crate::{Part, Record, Records, Row, Study, StudyError};
use std::fs::{File, OpenOptions};
use std::path::{Path, PathBuf};
use std::sync::Mutex;
use std::sync::atomic::{AtomicBool, AtomicUsize, Ordering};
use trilith::Registry;
use trilith::sweep::Lanes;

/// Widths of the lanes in a share, twice as many at its end, at most: all models of a share are in memory.
const SHARES: usize = 32;

/// How a study is run.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct How<'a> {
    /// Runs at the same time.
    pub threads: usize,
    /// Which runs.
    pub part: Part,
    /// Make runs that have failed once more.
    pub retry_failed: bool,
    /// Folder of a store: runs that it has are taken from there, and new ones are kept there.
    pub store: Option<&'a Path>,
}

impl How<'_> {
    /// All runs, so many at the same time.
    #[must_use]
    pub fn threads(threads: usize) -> Self {
        Self { threads, part: Part::All, retry_failed: false, store: None }
    }
}

/// How far a study, or the part of it that is run, is.
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
    /// The finished runs, of the part where one was run, in the order of their numbers.
    pub records: Records,
    /// Runs that were on disk already.
    pub resumed: usize,
    /// Runs that were taken from the store.
    pub reused: usize,
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
        self.records.iter().filter(|r| !r.good()).count()
    }

    /// Runs that warned of something.
    #[must_use]
    pub fn warned(&self) -> usize {
        self.records.iter().filter(|r| !r.warnings().is_empty()).count()
    }
}

/// What the workers share.
struct Shared<'a> {
    study: &'a Study,
    registry: &'a Registry,
    folder: &'a Path,
    /// None where runs go one by one.
    lanes: Option<Lanes>,
    /// Chains of this part.
    chains: Vec<usize>,
    threads: usize,
    /// Chains that a thread takes at once, at least.
    width: usize,
    beside: AtomicUsize,
    /// Runs that were made now, and that were taken from the store.
    new: AtomicUsize,
    reused: AtomicUsize,
    store: Option<(Keys, Mutex<Store>)>,
    /// Failed runs of the store are made again.
    retry_failed: bool,
    kept: Records,
    /// None where nothing is run.
    journal: Option<Mutex<Journal>>,
    /// Runs that nobody has made.
    missing: AtomicUsize,
    /// Those that were made now or taken from the store, and those that were on disk, by number.
    found: Mutex<Records>,
    there: Mutex<Vec<usize>>,
    error: Mutex<Option<StudyError>>,
    stop: AtomicBool,
    interrupt: &'a AtomicBool,
    next: AtomicUsize,
    done: AtomicUsize,
    failed: AtomicUsize,
    total: usize,
    progress: &'a (dyn Fn(Progress) + Sync),
}

/// Runs a study, or a part of it, into a folder, or goes on with it. Where it is all there, tables and page are written;
/// what parts of it have made in that folder counts.
///
/// Once `interrupt` is true, no run is begun, and those under way are given up.
///
/// # Errors
/// [`StudyError`] where the folder cannot be written or belongs to something else, where it was interrupted, or where runs
/// are missing that are to be gathered. Runs that fail are no error: they are rows of the table.
pub fn execute(
    study: &Study,
    registry: &Registry,
    folder: &Path,
    how: How<'_>,
    progress: &(dyn Fn(Progress) + Sync),
    interrupt: &AtomicBool,
) -> Result<Results, StudyError> {
    let How { threads, part, retry_failed, store } = how;
    std::fs::create_dir_all(folder).map_err(StudyError::at(folder))?;
    let _lock = lock(&part.lock(folder), folder)?;
    // What others have made comes first: where that is of another study, nothing is begun beside it.
    let own = part.journal(folder);
    let mut others = Vec::new();
    for (_, path) in journals(folder).map_err(StudyError::at(folder))? {
        if path != own || part == Part::Gather {
            others.push(Kept::of(&path, &study.identity)?);
        }
    }
    let (journal, mut kept) = match part {
        Part::Gather => (None, Kept::default()),
        _ => {
            let (journal, kept) = Journal::open(&own, &study.identity)?;
            (Some(Mutex::new(journal)), kept)
        }
    };
    // Of a run that several have made a good one counts.
    for Kept { records, .. } in others {
        if kept.records.is_empty() {
            kept.records = records;
            continue;
        }
        for row in records.iter() {
            if kept.records.get(row.run()).is_none_or(|known| !known.good()) {
                kept.records.insert(row.record());
            }
        }
    }
    if retry_failed {
        kept.records.retain(|row| row.good());
    }
    let length = study.plan.chain_length();
    let chains = part.chains(study.identity.runs / length);
    let total = chains.len() * length;
    let (lanes, alone) = match study.alone(registry) {
        None => (Some(Lanes::new().over_time(over_time(&study.columns))), None),
        reason => (None, reason),
    };
    let store = match store.filter(|_| part != Part::Gather) {
        Some(path) => {
            let keys = Keys::of(study, registry, lanes.is_some())?;
            Some((keys, Mutex::new(Store::open(path)?)))
        }
        None => None,
    };
    // Where there are few, all threads have some.
    let width =
        lanes.as_ref().map_or(1, |l| l.width().min(chains.len().div_ceil(threads.max(1))).max(1));
    let torn = kept.torn;
    let shared = Shared {
        study,
        registry,
        folder,
        lanes,
        chains,
        threads: threads.max(1),
        width,
        beside: AtomicUsize::new(0),
        new: AtomicUsize::new(0),
        reused: AtomicUsize::new(0),
        store,
        retry_failed,
        kept: kept.records,
        journal,
        missing: AtomicUsize::new(0),
        found: Mutex::default(),
        there: Mutex::new(Vec::new()),
        error: Mutex::new(None),
        stop: AtomicBool::new(false),
        interrupt,
        next: AtomicUsize::new(0),
        done: AtomicUsize::new(0),
        failed: AtomicUsize::new(0),
        total,
        progress,
    };
    // Runs side by side are shared among threads, so no run is.
    let work = || trilith::solvers::alone(|| shared.work());
    std::thread::scope(|scope| {
        for _ in 1..threads.min(shared.chains.len().div_ceil(width)).max(1) {
            scope.spawn(work);
        }
        work();
    });
    let closed = shared.store.and_then(|(_, store)| Some(store.into_inner().ok()?.close()));
    if let Some(error) = shared.error.into_inner().unwrap_or_default() {
        return Err(error);
    }
    closed.unwrap_or(Ok(()))?;
    if let Some(Ok(mut journal)) = shared.journal.as_ref().map(Mutex::lock) {
        journal.sync()?;
    }
    if interrupt.load(Ordering::Relaxed) {
        let done = shared.done.into_inner();
        return Err(StudyError::Interrupted { done, total, folder: folder.to_owned() });
    }
    let mut there = shared.there.into_inner().unwrap_or_default();
    there.sort_unstable();
    // What was on disk may be of another part, or beyond the limit of its series.
    let mut records = shared.kept;
    records.retain(|row| there.binary_search(&row.run()).is_ok());
    records.extend(shared.found.into_inner().unwrap_or_default().iter().map(Row::record));
    let missing = shared.missing.into_inner();
    if missing > 0 {
        let done = records.len();
        return Err(StudyError::Missing { missing, done, folder: folder.to_owned() });
    }
    let left_out = total - records.len();
    let files = match part {
        Part::Shard(_) => Vec::new(),
        Part::All | Part::Gather => crate::files::write(study, &records, left_out, folder)?,
    };
    let reused = shared.reused.into_inner();
    let resumed = records.len() - shared.new.into_inner() - reused;
    let beside = shared.beside.into_inner();
    Ok(Results { records, resumed, reused, torn, left_out, files, beside, alone })
}

/// Keeps other processes out for as long as the file is open: the system lets go of it when the process ends, however it
/// ends.
pub(crate) fn lock(path: &Path, folder: &Path) -> Result<File, StudyError> {
    let lock = OpenOptions::new().write(true).create(true).truncate(false).open(path);
    let lock = lock.map_err(StudyError::at(path))?;
    match lock.try_lock() {
        Ok(()) => Ok(lock),
        Err(std::fs::TryLockError::WouldBlock) => {
            Err(StudyError::Locked { folder: folder.to_owned() })
        }
        Err(std::fs::TryLockError::Error(e)) => Err(StudyError::at(path)(e)),
    }
}

impl Shared<'_> {
    fn work(&self) {
        let length = self.study.plan.chain_length();
        let all = self.chains.len();
        let take = |first: usize| (first < all).then(|| first + self.share(all - first));
        while !self.stops()
            && let Ok(first) = self.next.fetch_update(Ordering::Relaxed, Ordering::Relaxed, take)
        {
            let own = &self.chains[first..first + self.share(all - first)];
            let firsts = own.iter().map(|chain| chain * length).collect();
            if let Err(error) = self.chains(firsts, length) {
                self.stop.store(true, Ordering::Relaxed);
                if let Ok(mut first) = self.error.lock() {
                    first.get_or_insert(error);
                }
            }
        }
    }

    /// Chains that a thread takes where so many are left. A lane that has come to its end takes the next of the share: the
    /// more there are, the fewer lanes are idle at its end; but then the others should have as many.
    fn share(&self, left: usize) -> usize {
        if self.lanes.is_none() {
            return 1;
        }
        let most = SHARES * self.width;
        if self.threads == 1 {
            // What would be left over is no share of its own.
            return if left < 2 * most { left } else { most };
        }
        (left / (2 * self.threads)).clamp(self.width, most).min(left)
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
                runs.iter().copied().filter(|run| !self.kept.contains(*run)).collect();
            if self.journal.is_none() {
                self.missing.fetch_add(new.len(), Ordering::Relaxed);
                firsts.retain(|first| !new.contains(&(first + step)));
                let runs = firsts.iter().map(|first| first + step).collect();
                firsts = self.take(firsts, runs, Vec::new(), length - step);
                continue;
            }
            let Some(made) = self.make(&new)? else { return Ok(()) };
            firsts = self.take(firsts, runs, made, length - step);
        }
        Ok(())
    }

    /// Takes note of a run of each chain, kept or just made; returns the chains that go on. `left`: runs of a chain that
    /// are left, this one included.
    fn take(
        &self,
        firsts: Vec<usize>,
        runs: Vec<usize>,
        made: Vec<Record>,
        left: usize,
    ) -> Vec<usize> {
        let mut made = made.into_iter();
        let mut going = Vec::with_capacity(firsts.len());
        for (first, run) in firsts.into_iter().zip(runs) {
            let kept = self.kept.get(run);
            let over = if let Some(kept) = kept {
                if let Ok(mut there) = self.there.lock() {
                    there.push(run);
                }
                self.study.ends_with(kept)
            } else {
                let (Some(record), Ok(mut found)) = (made.next(), self.found.lock()) else {
                    continue;
                };
                found.insert(record);
                found.get(run).is_some_and(|row| self.study.ends_with(row))
            };
            // A new one was counted when it was made.
            let runs = if over { left } else { 1 } - usize::from(kept.is_none());
            if runs > 0 {
                self.count(runs, kept.is_some_and(|kept| !kept.good()));
            }
            if !over {
                going.push(first);
            }
        }
        going
    }

    /// Takes note of runs that are on disk or not needed.
    fn count(&self, runs: usize, failed: bool) {
        let done = self.done.fetch_add(runs, Ordering::Relaxed) + runs;
        let failed =
            self.failed.fetch_add(usize::from(failed), Ordering::Relaxed) + usize::from(failed);
        (self.progress)(Progress { done, total: self.total, failed });
    }
}
