//! The verdict on a run.

use super::march::Halt;
use super::spec::Spec;
use super::subject::{Ended, Shown, run};
use super::text::text;
use super::truth::{Truth, WINDOW, outside, truth};
use trilith::SolverKind;

/// The verdict.
#[derive(Clone, Debug)]
pub enum Verdict {
    /// Within its tolerance; the largest error.
    Passed(f64),
    /// It said that it does not solve this, and why.
    Refused(String),
    /// Off, and it said how far; the largest error.
    Told(f64),
    /// Off by more than it said, but it warned.
    Warned(f64, String),
    /// Off, and it said nothing, but only in what is small beside others of its kind: output, error, time.
    Small(usize, f64, f64),
    /// Off, and it said nothing: output, error, time.
    Failed(usize, f64, f64),
    /// It broke off.
    Panicked(String),
}

/// Why a structure is not compared.
#[derive(Clone, Debug)]
pub enum Skip {
    /// The oracle found no answer.
    NoOracle(String),
    /// It can answer for the time up to this with the work that it may do, s.
    TooMuchWork(f64),
    /// Its answer depends on the tolerance.
    IllPosed,
}

/// Share of the size of an output by which it may be off.
#[must_use]
pub fn allowed(spec: &Spec) -> f64 {
    // Steps are judged by energy: amplitudes go with the root of the tolerance of a step, 1e-4.
    match spec.tolerance {
        Some(t) if t < 1e-5 => 0.005,
        _ => 0.02,
    }
}

/// Multiplications that the oracle may make for a pass over a structure: some seconds.
pub const WORK: f64 = 6e9;

/// The oracle's answer, where it is worth comparing with; `work`: see [`WORK`].
///
/// # Errors
/// Why it is not.
pub fn reference(spec: &Spec, work: f64) -> Result<Truth, Skip> {
    let found = truth(spec, work).map_err(|halt| match halt {
        Halt::Spent(_, at) => Skip::TooMuchWork(at),
        Halt::Stuck(reason) => Skip::NoOracle(reason),
    })?;
    let limit = 0.25 * allowed(spec);
    if found.moves.iter().any(|m| m.is_nan() || *m > limit) {
        Err(Skip::IllPosed)
    } else {
        Ok(found)
    }
}

/// As [`reference()`]; what is too much work is cut short, and the answer is that of the description that is left.
///
/// # Errors
/// Why there is none.
pub fn reference_of_a_part(spec: &mut Spec, work: f64) -> Result<Truth, Skip> {
    let least = SHORTEST * spec.duration;
    loop {
        match reference(spec, work) {
            Err(Skip::TooMuchWork(at)) if at >= least => spec.end_at(0.9 * at),
            answer => return answer,
        }
    }
}

/// Nothing is cut to less than this share of its duration.
const SHORTEST: f64 = 0.02;

/// Largest error of a run over all outputs and samples: output, share, time.
#[must_use]
pub fn error(spec: &Spec, found: &Truth, time: &[f64], values: &[Vec<f64>]) -> (usize, f64, f64) {
    let mut worst = (0, 0.0, 0.0);
    for (t, row) in time.iter().zip(values).filter(|(t, _)| **t > 0.0) {
        for (i, x) in row.iter().enumerate() {
            let width = WINDOW * spec.duration;
            let (low, high) =
                found.course.span(i, (t - width).max(0.0), (t + width).min(spec.duration));
            let off = outside(*x, low, high) / found.scale[i];
            if off > worst.1 {
                worst = (i, off, *t);
            }
        }
    }
    worst
}

/// The largest error of one output and what the run says of it, as shares of its size.
#[derive(Clone, Copy, Debug)]
pub struct Pair {
    /// The output.
    pub output: usize,
    /// Largest distance from the oracle beyond what the oracle is sure of.
    pub off: f64,
    /// What the run says of its reduction and of its steps; not a number where it says nothing.
    pub said: [f64; 2],
}

/// Errors below this share are as good as none.
pub const NO_ERROR: f64 = 1e-5;

impl Pair {
    /// The estimate; not a number where there is none.
    #[must_use]
    pub fn estimate(&self) -> f64 {
        self.said[0] + self.said[1]
    }

    /// The estimate holds.
    #[must_use]
    pub fn holds(&self) -> bool {
        self.off <= self.estimate() + NO_ERROR
    }
}

fn pairs(spec: &Spec, found: &Truth, shown: &Shown) -> Vec<Pair> {
    let mut off = vec![0.0_f64; spec.outputs.len()];
    let width = WINDOW * spec.duration;
    for (t, row) in shown.time.iter().zip(&shown.values).filter(|(t, _)| **t > 0.0) {
        for (i, x) in row.iter().enumerate() {
            let (low, high) =
                found.course.span(i, (t - width).max(0.0), (t + width).min(spec.duration));
            off[i] = off[i].max(outside(*x, low, high) / found.scale[i]);
        }
    }
    let pair = |(i, off): (usize, f64)| {
        let said = shown.errors.get(i).map_or([f64::NAN; 2], |e| [e.reduction, e.step]);
        let off = (off - found.moves[i] - found.rounding[i] / found.scale[i]).max(0.0);
        Pair { output: i, off, said: said.map(|x| x / found.scale[i]) }
    };
    off.into_iter().enumerate().map(pair).collect()
}

/// Runs a description under a solver and judges it.
#[must_use]
pub fn judge(spec: &Spec, found: &Truth, solver: SolverKind) -> Verdict {
    judge_and_compare(spec, found, solver).0
}

/// As [`judge`], with the error of every output and what the run says of it.
#[must_use]
pub fn judge_and_compare(spec: &Spec, found: &Truth, solver: SolverKind) -> (Verdict, Vec<Pair>) {
    match run(&text(spec), solver) {
        Ended::Shown(shown) => {
            let pairs = pairs(spec, found, &shown);
            (verdict(spec, found, &shown, &pairs), pairs)
        }
        Ended::Refused(message) => (Verdict::Refused(message), Vec::new()),
        Ended::Panicked(message) => (Verdict::Panicked(message), Vec::new()),
    }
}

fn verdict(spec: &Spec, found: &Truth, shown: &Shown, pairs: &[Pair]) -> Verdict {
    let (output, off, t) = error(spec, found, &shown.time, &shown.values);
    let end = shown.time.last().copied().unwrap_or(0.0);
    if end < spec.duration * (1.0 - 1e-9) {
        return Verdict::Failed(usize::MAX, 1.0, end);
    }
    if off <= allowed(spec) {
        Verdict::Passed(off)
    } else if pairs.iter().all(|p| p.off <= allowed(spec) || p.holds()) {
        Verdict::Told(off)
    } else if let Some(warning) = shown.warnings.first() {
        Verdict::Warned(off, warning.clone())
    } else if off * found.scale[output] <= allowed(spec) * SMALL * found.around[output]
        && error_beside(spec, found, &shown.time, &shown.values)
    {
        Verdict::Small(output, off, t)
    } else {
        Verdict::Failed(output, off, t)
    }
}

/// An error below the allowed share of this share of the largest motion is one of a small quantity.
const SMALL: f64 = 0.2;

/// No output is off by more than its share of the largest of its kind.
fn error_beside(spec: &Spec, found: &Truth, time: &[f64], values: &[Vec<f64>]) -> bool {
    let mut wide = found.clone();
    wide.scale = found.around.iter().zip(&found.scale).map(|(a, s)| (SMALL * a).max(*s)).collect();
    error(spec, &wide, time, values).1 <= allowed(spec)
}

/// A message without its numbers and names: one for all of a class.
#[must_use]
pub fn class(message: &str) -> String {
    let mut s = String::new();
    let mut quoted = false;
    for c in message.chars() {
        if c == '"' || c == '`' {
            quoted = !quoted;
            if quoted {
                s.push('…');
            }
        } else if !quoted && c.is_ascii_digit() {
            if !s.ends_with('#') {
                s.push('#');
            }
        } else if !quoted {
            s.push(c);
        }
    }
    s.chars().take(110).collect()
}
