//! The program under test: a model text, run by a solver.

use crate::trace::read;
use trilith::solvers::{Observer, OutputError, RunOptions, Sample};
use trilith::{Analysis, SolverKind};

/// What a run showed.
#[derive(Clone, Debug, Default)]
pub struct Shown {
    /// Times of its samples.
    pub time: Vec<f64>,
    /// Values of the outputs at each.
    pub values: Vec<Vec<f64>>,
    /// What it warned of.
    pub warnings: Vec<String>,
    /// Substeps made.
    pub substeps: usize,
    /// Setting up and marching, s of CPU.
    pub seconds: f64,
    /// Vectors of the basis, where there is one.
    pub vectors: Option<usize>,
    /// How far the run says that each output may be off.
    pub errors: Vec<OutputError>,
}

impl Observer for Shown {
    fn sample(&mut self, s: &Sample<'_>) {
        // A jump is shown twice, and a run that is made again from the start.
        while self.time.last().is_some_and(|t| *t >= s.t) {
            self.time.pop();
            self.values.pop();
        }
        self.time.push(s.t);
        self.values.push(s.values.to_vec());
    }
}

/// How a run ended.
#[derive(Clone, Debug)]
pub enum Ended {
    /// To its end, with nothing to complain about but warnings.
    Shown(Shown),
    /// Refused or stopped, with this message.
    Refused(String),
    /// It broke off.
    Panicked(String),
}

/// Substeps that a run may try: a structure that needs more is told as stuck.
const SUBSTEPS: usize = 1_000_000;

/// Runs the last case of a text.
#[must_use]
pub fn run(text: &str, solver: SolverKind) -> Ended {
    let work = || -> Result<Shown, String> {
        let model = read(text, "fuzz", &[]).map_err(|e| format!("read: {e}"))?;
        let analysis = Analysis::new(&model).map_err(|e| format!("assembly: {e}"))?;
        let analysis = analysis.without_histories();
        let mut shown = Shown::default();
        let case = model.cases.len() - 1;
        let options = RunOptions {
            case,
            solver: Some(solver),
            substeps: Some(SUBSTEPS),
            step_errors: true,
            ..RunOptions::default()
        };
        let run = analysis.observed(options, &mut [&mut shown]);
        let result = run.map_err(|e| format!("run: {e}"))?.result;
        if !result.status.is_good() {
            return Err(format!("status: {}", result.status.text()));
        }
        // That a basis grew is no excuse, nor is what looks strange in a made-up model.
        let excuses = ["the basis was enlarged", "check the model"];
        let counts = |warning: &String| !excuses.iter().any(|e| warning.starts_with(*e));
        shown.warnings = result.warnings.into_iter().filter(counts).collect();
        shown.substeps = result.work.substeps;
        shown.seconds = result.work.setup_cpu_s + result.work.march_cpu_s;
        shown.vectors = result.basis.as_ref().map(|b| b.vectors);
        shown.errors = result.errors;
        Ok(shown)
    };
    match std::panic::catch_unwind(work) {
        Ok(Ok(shown)) => Ended::Shown(shown),
        Ok(Err(message)) => Ended::Refused(message),
        Err(cause) => {
            let text = cause
                .downcast_ref::<String>()
                .cloned()
                .or_else(|| cause.downcast_ref::<&str>().map(|s| (*s).to_owned()));
            Ended::Panicked(text.unwrap_or_else(|| "panic".into()))
        }
    }
}
