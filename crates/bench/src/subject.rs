//! A frame, read and made ready for a measurement.

use crate::clock::timed;
use std::sync::Arc;
use trilith::model::{
    AfterEnd, Analysis, DynamicCase, Interpolation, Output, Quantity, StepControl, Table,
    TimeFunction,
};
use trilith::{Model, SolverKind};

/// Kind of the links whose displacement is watched.
const ISOLATOR: &str = "ElastomericBearing";
/// Output of the generated frames: roof less base at the corner, along X.
const ROOF: &str = "roof_x";

/// Which part of the motion, and how it is solved.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Task {
    /// Solver.
    pub solver: SolverKind,
    /// Vectors of FNA; `None`: as the frame says.
    pub vectors: Option<usize>,
    /// Output steps.
    pub steps: usize,
    /// Fixed steps in an output step.
    pub substeps: usize,
    /// The motion starts there, s: later than 0 to be in strong motion from the first step on.
    pub offset: f64,
}

/// A model with its task.
#[derive(Debug)]
pub struct Subject {
    /// The model: its outputs are the roof drift, then U2 and U3 of every isolator.
    pub model: Model,
    /// The case.
    pub case: usize,
    /// The solver.
    pub solver: SolverKind,
    /// Output step, s.
    pub dt: f64,
    /// Output steps.
    pub steps: usize,
    /// CPU time of reading, s.
    pub parse: f64,
}

impl Subject {
    /// Reads a frame and sets the task.
    ///
    /// # Errors
    /// A sentence where the text is no such frame.
    pub fn new(text: &str, task: Task) -> Result<Self, String> {
        let registry = trilith::registry();
        let (read, parse) = timed(|| trilith::read_text(text, "frame.ron", &registry, &[]));
        let mut model = read.map_err(|errors| {
            errors.first().map_or("the frame cannot be read".into(), |e| e.message.clone())
        })?;
        let case = model.cases.len().checked_sub(1).ok_or("the frame has no case")?;
        watch(&mut model)?;
        let Analysis::Dynamic(dynamic) = &mut model.cases[case].analysis else {
            return Err("the last case of the frame is not dynamic".into());
        };
        dynamic.solution.step = StepControl::Fixed { substeps: task.substeps.max(1) };
        if task.vectors.is_some() {
            dynamic.solution.basis.vectors = task.vectors;
        }
        let (dt, steps) = (dynamic.dt, task.steps);
        dynamic.duration = dt * steps as f64;
        let base: Vec<usize> = dynamic.base.iter().map(|b| b.function).collect();
        for function in base {
            let f = &mut model.functions[function].function;
            *f = motion(f, dt, task.offset, steps)?;
        }
        Ok(Self { model, case, solver: task.solver, dt, steps, parse })
    }

    /// The dynamic case.
    #[must_use]
    pub fn dynamic(&self) -> Option<&DynamicCase> {
        match &self.model.cases[self.case].analysis {
            Analysis::Dynamic(d) => Some(d),
            Analysis::Static(_) => None,
        }
    }
}

/// The motion from `offset` on, as often as it takes to last `steps`. It starts from zero, so that a
/// program without initial accelerations starts from the same state.
fn motion(f: &TimeFunction, dt: f64, offset: f64, steps: usize) -> Result<TimeFunction, String> {
    let TimeFunction::Table(table) = f else { return Err("the motion is no table".into()) };
    let samples = table.values();
    let first = (offset / dt).round() as usize;
    let even = |t: &[f64]| t.iter().enumerate().all(|(i, t)| (t / dt - i as f64).abs() < 1e-6);
    if !even(table.times()) || first + 1 >= samples.len() {
        return Err(
            "the motion is not sampled at the output step, or ends before the offset".into()
        );
    }
    let mut values: Vec<f64> = samples[first..].iter().copied().cycle().take(steps + 1).collect();
    values[0] = 0.0;
    let times = (0..=steps).map(|i| i as f64 * dt).collect();
    Table::new(times, values, Interpolation::Linear, AfterEnd::Zero)
        .map(|t| TimeFunction::Table(Arc::new(t)))
        .map_err(|e| e.to_string())
}

/// Leaves the outputs whose peaks are known.
fn watch(model: &mut Model) -> Result<(), String> {
    let roof = model.outputs.iter().find(|o| o.name == ROOF).cloned();
    let mut outputs = vec![roof.ok_or_else(|| format!("the frame has no output `{ROOF}`"))?];
    for (element, e) in model.elements.iter().enumerate().filter(|(_, e)| e.kind == ISOLATOR) {
        for coordinate in 0..2 {
            outputs.push(Output {
                name: format!("{} {coordinate}", e.name),
                unit: "m".into(),
                quantity: Quantity::LinkDeformation { element, coordinate, factor: 1.0 },
                hidden: false,
            });
        }
    }
    model.outputs = outputs;
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;
    use trilith::generate::Frame;

    #[test]
    fn the_motion_starts_at_the_offset_and_repeats() {
        let text = Frame { duration: 1.0, ..Frame::default() }.to_ron();
        let task = Task {
            solver: SolverKind::Fna,
            vectors: Some(5),
            steps: 300,
            substeps: 1,
            offset: 0.25,
        };
        let whole = Subject::new(&text, Task { steps: 200, offset: 0.0, ..task }).unwrap();
        let part = Subject::new(&text, task).unwrap();
        let values = |s: &Subject| match &s.model.functions[0].function {
            TimeFunction::Table(t) => t.values().to_vec(),
            _ => Vec::new(),
        };
        let (all, cut) = (values(&whole), values(&part));
        assert_eq!((all.len(), cut.len()), (201, 301));
        assert_eq!((cut[0], cut[1]), (0.0, all[51]));
        assert_eq!((cut[151], cut[152]), (all[50], all[51]));
        assert_eq!(part.dynamic().unwrap().solution.basis.vectors, Some(5));
        assert_eq!(part.model.outputs.len(), 1 + 2 * 9);
    }
}
