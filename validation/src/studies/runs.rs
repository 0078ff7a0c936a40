//! What the studies share: models, runs under several solvers, differences and orders.

use crate::Trace;
use trilith::model::{Analysis, DynamicCase, Solution, StepControl};
use trilith::{Model, SolverKind};

/// A solver and its α, with a name for figures.
#[derive(Clone, Copy, Debug)]
pub(super) struct Method {
    pub name: &'static str,
    pub solver: SolverKind,
    pub alpha: f64,
}

const fn method(name: &'static str, solver: SolverKind, alpha: f64) -> Method {
    Method { name, solver, alpha }
}

pub(super) const FNA: Method = method("fna", SolverKind::Fna, 0.0);
/// HHT with α = 0 is Newmark's average acceleration.
pub(super) const HHT: Method = method("hht", SolverKind::Hht, 0.0);
pub(super) const RITZ_HHT: Method = method("ritz-hht", SolverKind::RitzHht, 0.0);
pub(super) const FULL_NEWTON: Method = method("full-newton", SolverKind::FullNewton, 0.0);
const HHT_DAMPED: Method = method("hht, α = −0.1", SolverKind::Hht, -0.1);

/// The four solvers as they are by default.
pub(super) const SOLVERS: [Method; 4] = [FNA, HHT, RITZ_HHT, FULL_NEWTON];
/// The time rules whose order is measured.
pub(super) const RULES: [Method; 4] = [FNA, HHT, HHT_DAMPED, FULL_NEWTON];

/// The dynamic case that runs: the last one.
pub(super) fn dynamic(model: &mut Model, change: impl FnOnce(&mut DynamicCase)) {
    if let Some(Analysis::Dynamic(case)) = model.cases.last_mut().map(|c| &mut c.analysis) {
        change(case);
    }
}

/// How the last case of a model is solved.
pub(super) fn solution(model: &mut Model, change: impl FnOnce(&mut Solution)) {
    dynamic(model, |case| change(&mut case.solution));
}

/// A run that the solver itself does not complain about.
pub(super) fn run(
    text: &str,
    set: &[(&str, &dyn ToString)],
    method: Method,
    change: impl FnOnce(&mut Model),
) -> Result<Trace, String> {
    let trace = Trace::run(text, set, method.solver, |model| {
        solution(model, |s| s.alpha = method.alpha);
        change(model);
    })?;
    match &trace.complaint {
        Some(complaint) => Err(format!("{}: {complaint}", method.name)),
        None => Ok(trace),
    }
}

/// A run with fixed steps. Coarse ones may miss energy: that is what is measured here.
pub(super) fn run_fixed(text: &str, method: Method, substeps: usize) -> Result<Trace, String> {
    run(text, &[], method, |model| {
        solution(model, |s| {
            s.step = StepControl::Fixed { substeps };
            s.energy_limit = 1e9;
        });
    })
}

/// Slope of ln y over ln x by least squares.
pub(super) fn slope(points: &[(f64, f64)]) -> f64 {
    let n = points.len() as f64;
    let logs: Vec<(f64, f64)> = points.iter().map(|(x, y)| (x.ln(), y.ln())).collect();
    let mean = |f: fn(&(f64, f64)) -> f64| logs.iter().map(f).sum::<f64>() / n;
    let (x, y) = (mean(|p| p.0), mean(|p| p.1));
    let (mut xy, mut xx) = (0.0, 0.0);
    for (a, b) in &logs {
        xy += (a - x) * (b - y);
        xx += (a - x) * (a - x);
    }
    xy / xx
}

/// Root mean square.
pub(super) fn rms(values: impl IntoIterator<Item = f64>) -> f64 {
    let (mut sum, mut n) = (0.0, 0.0);
    for v in values {
        sum += v * v;
        n += 1.0;
    }
    (sum / n).sqrt()
}

/// The largest; what is not a number is the largest.
pub(super) fn largest(values: impl IntoIterator<Item = f64>) -> f64 {
    values
        .into_iter()
        .fold(0.0, |a: f64, b| if a.is_nan() || b.is_nan() { f64::NAN } else { a.max(b) })
}

/// Smallest and largest value of an output over all substeps.
pub(super) fn ends(trace: &Trace, output: &str) -> (f64, f64) {
    trace
        .history(output)
        .iter()
        .fold((f64::INFINITY, f64::NEG_INFINITY), |(a, b), (_, v)| (a.min(*v), b.max(*v)))
}

/// Below this (SI) an output is rounding.
const NOTHING: f64 = 1e-9;

/// Largest difference of the peaks of two runs over the given outputs, as share of the larger peak of
/// the output, and the output where it is. Outputs that are nothing in both runs are left out.
pub(super) fn difference(a: &Trace, b: &Trace, outputs: &[&str]) -> (f64, String) {
    let mut worst = (0.0, String::new());
    for name in outputs {
        let ((a0, a1), (b0, b1)) = (ends(a, name), ends(b, name));
        let size = [a0, a1, b0, b1].into_iter().fold(0.0, |m: f64, x| m.max(x.abs()));
        let share = (a0 - b0).abs().max((a1 - b1).abs()) / size;
        // What is not a number is the worst.
        if size > NOTHING && (share.is_nan() || share >= worst.0) {
            worst = (share, (*name).to_owned());
        }
    }
    worst
}

/// Names of all outputs of a run.
pub(super) fn names(trace: &Trace) -> Vec<&str> {
    trace.outputs().iter().map(String::as_str).collect()
}
