//! Whether the memory of a long run stays the same.

use crate::clock::{cpu, resident_mb};
use crate::{Subject, Task};
use serde::{Deserialize, Serialize};
use trilith::{Analysis, RunOptions};

/// Looks at the memory so often.
const MOMENTS: usize = 120;
/// Share of the run after which memory must not grow: buffers have their size by then.
const SETTLED: f64 = 0.05;
/// Growth that counts as none, MB: pages that the allocator takes and gives back.
const ALLOWED: f64 = 0.5;

/// Memory at one time of a run.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Moment {
    /// Time of the motion, s.
    pub t: f64,
    /// Resident memory, MB.
    pub mb: f64,
}

/// A long run.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Endurance {
    /// Name of the frame.
    pub size: String,
    /// Name of the solver.
    pub solver: String,
    /// Steps made.
    pub steps: usize,
    /// CPU time, s.
    pub cpu_s: f64,
    /// How it ended.
    pub status: String,
    /// Energy unaccounted for, as share.
    pub energy_error: f64,
    /// Memory over time.
    pub memory: Vec<Moment>,
    /// Largest less first value after the start, MB.
    pub growth_mb: f64,
}

impl Endurance {
    /// True where memory does not grow.
    #[must_use]
    pub fn is_flat(&self) -> bool {
        self.growth_mb <= ALLOWED
    }
}

/// Runs a frame through the library as a user would, keeping extremes only; the motion is repeated as
/// often as it takes.
///
/// # Errors
/// A sentence where the frame cannot be read or run.
pub fn endure(name: &str, text: &str, task: Task) -> Result<Endurance, String> {
    let subject = Subject::new(text, task)?;
    let analysis = Analysis::new(&subject.model).map_err(|e| e.to_string())?.without_histories();
    let every = (task.steps / MOMENTS).max(1);
    let mut memory = Vec::with_capacity(MOMENTS + 1);
    let mut made = 0_usize;
    let mut look = |_share: f64| {
        made += 1;
        if made.is_multiple_of(every) {
            memory.push(Moment { t: made as f64 * subject.dt, mb: resident_mb() });
        }
    };
    let start = cpu();
    let run = analysis
        .run(RunOptions {
            case: subject.case,
            solver: Some(subject.solver),
            progress: Some(&mut look),
            ..RunOptions::default()
        })
        .map_err(|e| e.to_string())?;
    let cpu_s = cpu() - start;
    Ok(Endurance {
        size: name.to_owned(),
        solver: run.result.solver.to_owned(),
        steps: run.result.work.steps,
        cpu_s,
        status: run.result.status.word().to_owned(),
        energy_error: run.result.energy.error_relative,
        growth_mb: growth(&memory),
        memory,
    })
}

fn growth(memory: &[Moment]) -> f64 {
    let end = memory.last().map_or(0.0, |m| m.t);
    let settled: Vec<f64> = memory.iter().filter(|m| m.t >= SETTLED * end).map(|m| m.mb).collect();
    let Some(first) = settled.first() else { return 0.0 };
    settled.iter().fold(0.0, |a: f64, mb| a.max(mb - first))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn growth_is_seen_and_the_start_is_not() {
        let run = |f: fn(f64) -> f64| -> Vec<Moment> {
            (1..=100).map(f64::from).map(|t| Moment { t, mb: f(t) }).collect()
        };
        assert_eq!(growth(&run(|t| if t < 4.0 { 5.0 } else { 20.0 })), 0.0);
        assert!((growth(&run(|t| 20.0 + 0.1 * t)) - 9.5).abs() < 1e-9);
        assert_eq!(growth(&[]), 0.0);
    }
}
