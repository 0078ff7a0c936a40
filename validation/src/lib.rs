//! Validation of Trilith: closed-form and published cases, and studies, that print their own verdict.
//!
//! Every case is a model as a user would write it, with reference values from a closed form or from a
//! publication; a study makes many runs behind one statement. [`all`] lists both, [`run_all`] runs
//! them, and [`report`] writes the table, `report.json`, `REPORT.md` and the page with the figures.

pub mod case;
pub mod cases;
mod figures;
pub mod oracle;
mod outcome;
mod page;
pub mod report;
pub mod studies;
pub mod study;
mod topic;
mod trace;
pub mod unit;

pub use case::{Case, Check, Claim, Curve, Kind, Mark, Solver, Tolerance, View};
pub use outcome::{Outcome, Row, Table};
pub use study::{Findings, Study};
pub use trace::Trace;
pub use unit::Unit;

/// A case or a study.
pub enum Item {
    /// One model against its references.
    Case(Box<Case>),
    /// Many runs behind one statement.
    Study(Study),
    /// What could not be made here, as [`Outcome::unavailable`] says.
    Missing(Outcome),
}

impl Item {
    /// Short name.
    #[must_use]
    pub fn id(&self) -> &'static str {
        match self {
            Self::Case(c) => c.id,
            Self::Study(s) => s.id,
            Self::Missing(o) => o.id,
        }
    }

    fn run(&self) -> Outcome {
        match self {
            Self::Case(c) => c.run(),
            Self::Study(s) => s.run(),
            Self::Missing(o) => o.clone(),
        }
    }

    fn failed(&self, reason: &str) -> Outcome {
        match self {
            Self::Case(c) => c.failed(reason),
            Self::Study(s) => s.failed(reason),
            Self::Missing(o) => o.clone(),
        }
    }
}

/// Everything: studies first, as they take longest.
#[must_use]
pub fn all() -> Vec<Item> {
    let studies = studies::all().into_iter().map(Item::Study);
    let cases = cases::all().into_iter().map(|c| Item::Case(Box::new(c)));
    let others = studies::with_programs().into_iter();
    studies.chain(others).chain(cases).chain(cases::with_record()).collect()
}

/// Runs several items at a time and returns what they found in the order of the items. `done` is
/// called after each of them, from any thread, with its short name.
#[must_use]
pub fn run_all(items: &[Item], done: &(dyn Fn(&str) + Sync)) -> Vec<Outcome> {
    use std::sync::atomic::{AtomicUsize, Ordering};
    let next = AtomicUsize::new(0);
    let workers = std::thread::available_parallelism().map_or(1, |n| n.get().min(8));
    let work = || {
        let mut found = Vec::new();
        loop {
            let i = next.fetch_add(1, Ordering::Relaxed);
            let Some(item) = items.get(i) else { break };
            // A run that panics is a failing case, not the end of all others.
            let outcome = std::panic::catch_unwind(std::panic::AssertUnwindSafe(|| item.run()));
            found.push((i, outcome.unwrap_or_else(|_| item.failed("the run broke off"))));
            done(item.id());
        }
        found
    };
    let mut all = std::thread::scope(|scope| {
        let threads: Vec<_> = (0..workers).map(|_| scope.spawn(work)).collect();
        threads.into_iter().flat_map(|t| t.join().unwrap_or_default()).collect::<Vec<_>>()
    });
    all.sort_by_key(|(i, _)| *i);
    all.into_iter().map(|(_, outcome)| outcome).collect()
}
