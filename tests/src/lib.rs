//! What the end-to-end tests share: models, runs, peaks and histories.

pub mod mutants;

use std::path::{Path, PathBuf};
use trilith_model::{Analysis, Model, Registry, SolverKind, StepControl};
use trilith_solvers::{CaseResult, Observer, RunOptions, Sample, run};
use trilith_system::System;

/// The root of the project.
#[must_use]
pub fn root() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).parent().unwrap_or(Path::new(".")).to_path_buf()
}

/// Offers the built-in kinds and those of the example of a third party.
pub fn register(to: &mut impl trilith_element::Register) {
    trilith_elements::register(to);
    trilith_thirdparty_example::register(to);
}

/// The built-in kinds and those of the example of a third party.
#[must_use]
pub fn registry() -> Registry {
    let mut kinds = Registry::default();
    register(&mut kinds);
    kinds
}

/// A model text with parameters set.
///
/// # Panics
/// With all diagnostics, where the model is wrong.
#[must_use]
pub fn parse(text: &str, set: &[(&str, String)]) -> (Model, System) {
    let set: Vec<(String, String)> =
        set.iter().map(|(n, v)| ((*n).to_owned(), v.clone())).collect();
    let path = root().join("models/test.ron");
    let model = trilith_model::read_text(text, &path, &registry(), &set).unwrap_or_else(|errors| {
        panic!("{}", errors.iter().map(ToString::to_string).collect::<Vec<_>>().join("\n"))
    });
    let system = trilith_solvers::assemble(&model).unwrap_or_else(|e| panic!("{e}"));
    (model, system)
}

/// The text of a shipped model.
///
/// # Panics
/// Where the file is missing.
#[must_use]
pub fn shipped_text(file: &str) -> String {
    std::fs::read_to_string(root().join("models").join(file)).expect("a shipped model")
}

/// A shipped model with parameters set.
#[must_use]
pub fn shipped(file: &str, set: &[(&str, String)]) -> (Model, System) {
    parse(&shipped_text(file), set)
}

/// Step control of all dynamic cases of a model.
pub fn set_step(model: &mut Model, step: StepControl) {
    for case in &mut model.cases {
        if let Analysis::Dynamic(d) = &mut case.analysis {
            d.solution.step = step;
        }
    }
}

/// Largest, smallest and last values of all outputs, and their histories at output times.
#[derive(Clone, Debug, Default)]
pub struct Trace {
    /// Largest values over all substeps.
    pub max: Vec<f64>,
    /// Smallest values over all substeps.
    pub min: Vec<f64>,
    /// Last values.
    pub last: Vec<f64>,
    /// Values at output times.
    pub history: Vec<Vec<f64>>,
    /// Output times.
    pub time: Vec<f64>,
}

impl Trace {
    /// Largest absolute value of output `i`.
    #[must_use]
    pub fn peak(&self, i: usize) -> f64 {
        self.max[i].abs().max(self.min[i].abs())
    }

    /// Root mean square difference of the histories of output `i`, over the peak.
    #[must_use]
    pub fn difference(&self, other: &Self, i: usize) -> f64 {
        let sum: f64 =
            self.history.iter().zip(&other.history).map(|(a, b)| (a[i] - b[i]).powi(2)).sum();
        (sum / self.history.len() as f64).sqrt() / other.peak(i)
    }
}

impl Observer for Trace {
    fn sample(&mut self, s: &Sample<'_>) {
        if self.max.is_empty() {
            self.max = s.values.to_vec();
            self.min = s.values.to_vec();
        }
        for (i, v) in s.values.iter().enumerate() {
            self.max[i] = self.max[i].max(*v);
            self.min[i] = self.min[i].min(*v);
        }
        self.last = s.values.to_vec();
        if s.output_step.is_some() {
            self.history.push(s.values.to_vec());
            self.time.push(s.t);
        }
    }
}

/// Runs the last case.
///
/// # Panics
/// Where the run cannot be made.
#[must_use]
pub fn trace(model: &Model, system: &System, solver: SolverKind) -> (Trace, CaseResult) {
    trace_with(model, system, RunOptions { solver: Some(solver), ..RunOptions::default() })
}

/// Runs the last case with options (whose case is overwritten).
///
/// # Panics
/// Where the run cannot be made.
#[must_use]
pub fn trace_with(model: &Model, system: &System, options: RunOptions<'_>) -> (Trace, CaseResult) {
    let mut trace = Trace::default();
    let options = RunOptions { case: model.cases.len() - 1, ..options };
    let result = run(model, system, options, &mut [&mut trace]).unwrap_or_else(|e| panic!("{e}"));
    (trace, result)
}

/// Index of an output.
///
/// # Panics
/// Where there is none of that name.
#[must_use]
pub fn output(model: &Model, name: &str) -> usize {
    model.output(name).unwrap_or_else(|| panic!("output {name}"))
}
