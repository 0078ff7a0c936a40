//! What one frame costs under one solver.

use crate::clock::{cpu, median, peak_mb, timed};
use crate::{Gauge, Peaks, Size, Subject, Task};
use serde::{Deserialize, Serialize};
use trilith::solvers::{CaseResult, Observer, Status};
use trilith::{Analysis, Model, RunOptions, SolverKind};
use trilith_linalg::Ldlt;

/// Steps of the whole motion.
pub const WHOLE: usize = 4000;

/// CPU times in s, memory in MB, peaks in m.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Measurement {
    /// Name of the frame.
    pub size: String,
    /// Name of the solver.
    pub solver: String,
    /// Free degrees of freedom.
    pub dof: usize,
    /// Elements of the structure.
    pub elements: usize,
    /// Coordinates of the links.
    pub links: usize,
    /// Vectors of the basis; 0 for a solver on all degrees of freedom.
    pub vectors: usize,
    /// Steps made.
    pub steps: usize,
    /// Reading the model.
    pub parse_s: f64,
    /// Assembly.
    pub assembly_s: f64,
    /// One factorisation of the stiffness alone; part of the set-up.
    pub factor_s: f64,
    /// What a run does before its first step: basis, factorisation, start. Median.
    pub setup_s: f64,
    /// One step with the peaks of all isolators kept: mean over the march, median over the runs.
    pub step_s: f64,
    /// The same with nobody watching.
    pub bare_step_s: f64,
    /// Assembly, set-up and the 4000 steps of the whole motion, from a model that is read.
    pub whole_s: f64,
    /// Iterations of the link equations in a step.
    pub iterations: f64,
    /// Steps that did not converge at once and were cut.
    pub unconverged: usize,
    /// Largest resident memory after the first run.
    pub peak_mb: f64,
    /// Runs behind the medians.
    pub runs: usize,
    /// How the run ended.
    pub status: String,
    /// Energy unaccounted for, as share.
    pub energy_error: f64,
    /// Largest displacement of any isolator.
    pub isolator: f64,
    /// Largest roof drift.
    pub roof: f64,
    /// Roof drift at the end.
    pub last: f64,
}

/// How long and how often to measure.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Effort {
    /// Most runs.
    pub runs: usize,
    /// No further run after this CPU time, s.
    pub budget: f64,
}

impl Default for Effort {
    fn default() -> Self {
        Self { runs: 7, budget: 4.0 }
    }
}

/// One run: what came out, CPU time until the first step and of one step.
struct Timed {
    result: CaseResult,
    setup: f64,
    step: f64,
}

/// Measures a frame.
///
/// # Errors
/// A sentence where the frame cannot be read or run.
pub fn measure(name: &str, text: &str, task: Task, effort: Effort) -> Result<Measurement, String> {
    let subject = Subject::new(text, task)?;
    let (analysis, assembly) = timed(|| Analysis::new(&subject.model));
    let analysis = analysis.map_err(|e| e.to_string())?;
    let mut gauge = Gauge::default();
    let first = run(&subject, &analysis, &mut [&mut gauge])?;
    let peak = peak_mb();
    let (Timed { result, setup, step }, start) = (first, cpu());
    let (mut setups, mut steps, mut bare) = (vec![setup], vec![step], Vec::new());
    loop {
        let again = run(&subject, &analysis, &mut [])?;
        setups.push(again.setup);
        bare.push(again.step);
        if steps.len() >= effort.runs || cpu() - start > effort.budget {
            break;
        }
        let again = run(&subject, &analysis, &mut [&mut Gauge::default()])?;
        setups.push(again.setup);
        steps.push(again.step);
    }
    let system = analysis.system();
    let (factor, factor_s) = timed(|| Ldlt::new(&system.stiffness));
    let (setup_s, step_s, runs) = (median(setups), median(steps.clone()), steps.len());
    let elements = subject.model.elements.iter().filter(|e| e.nodes.len() == 2).count();
    let (work, Peaks { isolator, roof }) = (result.work, gauge.peaks());
    Ok(Measurement {
        size: name.to_owned(),
        solver: result.solver.to_owned(),
        dof: system.order(),
        elements,
        links: system.links.len(),
        vectors: result.basis.as_ref().map_or(0, |b| b.vectors),
        steps: work.steps,
        parse_s: subject.parse,
        assembly_s: assembly,
        factor_s: if factor.is_ok() { factor_s } else { f64::NAN },
        setup_s,
        step_s,
        bare_step_s: median(bare),
        whole_s: assembly + setup_s + WHOLE as f64 * step_s,
        iterations: work.iterations as f64 / work.substeps.max(1) as f64,
        unconverged: work.rejected
            + usize::from(matches!(result.status, Status::NotConverged { .. })),
        peak_mb: peak,
        runs,
        status: result.status.word().to_owned(),
        energy_error: result.energy.error_relative,
        isolator,
        roof,
        last: gauge.last,
    })
}

/// Runs once. The clock is read after the first step and after the last one only.
fn run(
    subject: &Subject,
    analysis: &Analysis<&Model>,
    observers: &mut [&mut dyn Observer],
) -> Result<Timed, String> {
    let (mut made, mut after_first, mut after_last) = (0_usize, f64::NAN, f64::NAN);
    let total = subject.steps;
    let start = cpu();
    let mut progress = |_share: f64| {
        made += 1;
        if made == 1 {
            after_first = cpu();
        }
        if made == total {
            after_last = cpu();
        }
    };
    let options = RunOptions {
        case: subject.case,
        solver: Some(subject.solver),
        progress: Some(&mut progress),
        ..RunOptions::default()
    };
    let result = trilith::solvers::run(&subject.model, analysis.system(), options, observers)
        .map_err(|e| e.to_string())?;
    let step = (after_last - after_first) / (total.max(2) - 1) as f64;
    Ok(Timed { result, setup: after_first - start - step, step })
}

/// Error of a peak against what it must be.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Accuracy {
    /// Of the isolators, relative.
    pub isolator: f64,
    /// Of the roof drift, relative.
    pub roof: f64,
    /// What they may be.
    pub allowed: Peaks,
    /// Which reference.
    pub against: &'static str,
}

impl Accuracy {
    /// Within what is allowed.
    #[must_use]
    pub fn pass(&self) -> bool {
        self.isolator.abs() <= self.allowed.isolator && self.roof.abs() <= self.allowed.roof
    }
}

impl Measurement {
    /// Against the peaks of the size; `None` where they are not known or less than the whole motion ran.
    #[must_use]
    pub fn accuracy(&self, size: &Size) -> Option<Accuracy> {
        if self.steps != WHOLE {
            return None;
        }
        // FNA integrates the modes exactly: its truth is that of a fine step, where there is one. Direct integration must be
        // the same scheme as the reference, whose tolerance is the limit.
        let fna = self.solver == SolverKind::Fna.name();
        let (truth, against) = match (fna, size.fine, size.newmark) {
            (true, Some((fine, _)), _) => (fine, "Newmark, fine step"),
            (_, _, Some(same)) => (same, "Newmark, same step"),
            _ => return None,
        };
        let allowed = if fna {
            Peaks { isolator: 1e-3, roof: 1e-2 }
        } else {
            Peaks { isolator: 1e-6, roof: 1e-6 }
        };
        Some(Accuracy {
            isolator: self.isolator / truth.isolator - 1.0,
            roof: self.roof / truth.roof - 1.0,
            allowed,
            against,
        })
    }
}
