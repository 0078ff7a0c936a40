//! Validation of Trilith: closed-form and published cases that print their own verdict.
//!
//! Every case is a model as a user would write it, with reference values from a closed form or from a
//! publication. [`cases::all`] lists them, [`run_all`] runs them under the solvers they name, and
//! [`report`] writes the table, `report.json` and `REPORT.md`.

pub mod case;
pub mod cases;
pub mod report;

pub use case::{Case, Check, Kind, Row, Solver, Tolerance, Trace, Unit};

/// Runs all cases, several at a time, and returns the rows in the order of the cases.
#[must_use]
pub fn run_all(cases: &[Case]) -> Vec<Row> {
    use std::sync::atomic::{AtomicUsize, Ordering};
    let next = AtomicUsize::new(0);
    let workers = std::thread::available_parallelism().map_or(1, |n| n.get().min(8));
    let work = || {
        let mut done = Vec::new();
        loop {
            let i = next.fetch_add(1, Ordering::Relaxed);
            let Some(case) = cases.get(i) else { break };
            done.push((i, case.run()));
        }
        done
    };
    let mut all = std::thread::scope(|scope| {
        let threads: Vec<_> = (0..workers).map(|_| scope.spawn(work)).collect();
        threads.into_iter().flat_map(|t| t.join().unwrap_or_default()).collect::<Vec<_>>()
    });
    // A case lost with its thread still has to show up, as failing.
    for (i, case) in cases.iter().enumerate() {
        if !all.iter().any(|(j, _)| *j == i) {
            all.push((i, case.failed("the run broke off")));
        }
    }
    all.sort_by_key(|(i, _)| *i);
    all.into_iter().flat_map(|(_, rows)| rows).collect()
}
