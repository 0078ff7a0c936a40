//! What the readers make of files that somebody or something has spoiled.
//!
//! Every file of a corpus (models in RON and JSON, what they include, studies, records, tables, text models of SAP2000 and
//! ETABS, scripts of OpenSees, matrices in five forms, checkpoints, reports, histories, quantities) is cut, doubled, spliced
//! and sown with numbers that hurt; what comes of it is read and checked as `trilith check` does, and a small model is run
//! within a budget of work. A reader may refuse, with a reason that has its place. It must not panic, take longer than
//! [`SLOW`], take more memory than [`HEAVY`], or let through what is not a number.
//!
//! Reference: mutation of a corpus as in \[Miller, Fredriksen & So 1990\].

mod corpus;
mod mutate;
mod rng;
mod target;

pub use corpus::Corpus;
use rng::Rng;
use std::cell::RefCell;
use std::panic::{AssertUnwindSafe, catch_unwind, set_hook, take_hook};
use std::time::Duration;
pub use target::Target;

/// How long a check may take.
pub const SLOW: Duration = Duration::from_secs(2);
/// How much more memory than any check before it a check may take, in bytes.
pub const HEAVY: u64 = 1 << 30;
/// Longer files than this many bytes are cut: [`SLOW`] is promised for shorter ones.
const LONGEST: usize = 100_000;

/// What is wrong with a reader.
#[derive(Clone, Debug, PartialEq)]
pub enum Fault {
    /// It broke off: message and place.
    Panicked(String),
    /// It took this long, s.
    Slow(f64),
    /// It took this much memory, in bytes.
    Heavy(u64),
    /// It let through what is not a number, or refused without a place: what.
    Wrong(&'static str),
}

/// A spoiled file.
#[derive(Clone, Debug)]
pub struct Mutant {
    /// What reads it.
    pub target: Target,
    /// Its bytes.
    pub bytes: Vec<u8>,
}

/// The mutant of a seed.
#[must_use]
pub fn mutant(corpus: &Corpus, seed: u64) -> Mutant {
    let mut rng = Rng::new(seed);
    let file = corpus.any(&mut rng);
    let other = corpus.alike(file, &mut rng);
    let mut bytes = mutate::mutate(&file.bytes, &other.bytes, &mut rng);
    bytes.truncate(LONGEST);
    Mutant { target: file.target, bytes }
}

/// The mutant of a seed of a file of one reader; none where the corpus has no file of it.
#[must_use]
pub fn mutant_of(corpus: &Corpus, target: Target, seed: u64) -> Option<Mutant> {
    let mut rng = Rng::new(seed);
    let file = corpus.of(target, &mut rng)?;
    let other = corpus.alike(file, &mut rng);
    let mut bytes = mutate::mutate(&file.bytes, &other.bytes, &mut rng);
    bytes.truncate(LONGEST);
    Some(Mutant { target, bytes })
}

/// The largest memory of this process so far, in bytes; none where the system does not tell.
fn peak_memory() -> Option<u64> {
    let status = std::fs::read_to_string("/proc/self/status").ok()?;
    let line = status.lines().find_map(|line| line.strip_prefix("VmHWM:"))?;
    line.trim().strip_suffix("kB")?.trim().parse::<u64>().ok().map(|kb| kb << 10)
}

thread_local! {
    static SAID: RefCell<String> = const { RefCell::new(String::new()) };
}

/// CPU time of this thread so far: what else the machine does makes no reader slow.
#[cfg(unix)]
fn cpu() -> Duration {
    let t = rustix::time::clock_gettime(rustix::time::ClockId::ThreadCPUTime);
    Duration::new(t.tv_sec.unsigned_abs(), t.tv_nsec as u32)
}

/// Time since the first call.
#[cfg(not(unix))]
fn cpu() -> Duration {
    use std::sync::OnceLock;
    static FIRST: OnceLock<std::time::Instant> = OnceLock::new();
    FIRST.get_or_init(std::time::Instant::now).elapsed()
}

/// Reads a mutant; true where it is let through.
///
/// # Errors
/// What is wrong with the reader.
pub fn read(it: &Mutant) -> Result<bool, Fault> {
    let held = peak_memory();
    let start = cpu();
    let before = take_hook();
    set_hook(Box::new(|info| SAID.with(|said| *said.borrow_mut() = info.to_string())));
    let answer = catch_unwind(AssertUnwindSafe(|| it.target.read(&it.bytes)));
    set_hook(before);
    let took = cpu().saturating_sub(start);
    let grown = held.zip(peak_memory()).map_or(0, |(a, b)| b.saturating_sub(a));
    match answer {
        Err(_) => Err(Fault::Panicked(SAID.with(RefCell::take))),
        Ok(Err(what)) => Err(Fault::Wrong(what)),
        Ok(Ok(_)) if grown > HEAVY => Err(Fault::Heavy(grown)),
        Ok(Ok(_)) if took > SLOW => Err(Fault::Slow(took.as_secs_f64())),
        Ok(Ok(through)) => Ok(through),
    }
}
