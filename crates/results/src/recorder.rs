//! Records what the model asks for.

use crate::{Envelope, Frames, Loops, Peak};
use trilith_model::Model;
use trilith_solvers::{EnergyTotals, Observer, Sample};

/// Names of the recorded energies, in the order of [`Recorder::energy`].
pub const ENERGIES: [&str; 10] = [
    "input",
    "kinetic",
    "strain",
    "potential",
    "modal_damping",
    "link_stored",
    "link_hysteretic",
    "link_viscous",
    "algorithmic",
    "error",
];

/// Watches a run: histories at the output times, peaks over all substeps, deformed shapes on request.
///
/// What was recorded stays whether or not the run comes to its end.
#[derive(Clone, Debug)]
pub struct Recorder {
    time: Vec<f64>,
    histories: Vec<Vec<f64>>,
    energy: [Vec<f64>; ENERGIES.len()],
    envelope: Envelope,
    frames: Frames,
    loops: Loops,
    keeps_histories: bool,
    /// Outputs whose histories are kept.
    kept: Vec<usize>,
}

impl Recorder {
    /// For the outputs of a model.
    #[must_use]
    pub fn new(model: &Model) -> Self {
        Self {
            time: Vec::new(),
            histories: vec![Vec::new(); model.outputs.len()],
            energy: Default::default(),
            envelope: Envelope::new(),
            frames: Frames::new(model.nodes.len(), 0),
            loops: Loops::none(),
            keeps_histories: true,
            // A spectrum is made of the history of its output, hidden or not.
            kept: (0..model.outputs.len())
                .filter(|i| {
                    !model.outputs[*i].hidden || model.spectra.iter().any(|s| s.output == *i)
                })
                .collect(),
        }
    }

    /// Keeps no histories: memory then does not grow with the length of the run.
    #[must_use]
    pub fn without_histories(mut self) -> Self {
        self.keeps_histories = false;
        self
    }

    /// Keeps up to `limit` deformed shapes as well, evenly spaced in time.
    #[must_use]
    pub fn with_frames(mut self, model: &Model, limit: usize) -> Self {
        self.frames = Frames::new(model.nodes.len(), limit);
        self
    }

    /// Goes on from the extremes of an earlier part of the case.
    #[must_use]
    pub fn after(mut self, peaks: Vec<Peak>) -> Self {
        self.envelope = Envelope::new().after(peaks);
        self
    }

    /// Keeps deformation and force of all links as well.
    #[must_use]
    pub fn with_loops(mut self, model: &Model) -> Self {
        self.loops = Loops::new(model);
        self
    }

    /// The output times, s.
    #[must_use]
    pub fn time(&self) -> &[f64] {
        &self.time
    }

    /// Values of an output, by its index in the model, at the output times; none of a hidden one.
    #[must_use]
    pub fn history(&self, output: usize) -> Option<&[f64]> {
        let kept = self.kept.binary_search(&output).is_ok();
        self.histories.get(output).filter(|_| kept).map(Vec::as_slice)
    }

    /// Energies at the output times, J: one list for each of [`ENERGIES`].
    #[must_use]
    pub fn energy(&self) -> &[Vec<f64>; ENERGIES.len()] {
        &self.energy
    }

    /// Extremes of the outputs in the model's order; empty where nothing was recorded.
    #[must_use]
    pub fn peaks(&self) -> &[Peak] {
        self.envelope.peaks()
    }

    /// The deformed shapes.
    #[must_use]
    pub fn frames(&self) -> &Frames {
        &self.frames
    }

    /// Deformation and force of the links.
    #[must_use]
    pub fn loops(&self) -> &Loops {
        &self.loops
    }
}

impl Observer for Recorder {
    fn start(&mut self, steps: usize) {
        self.frames.start(steps);
        self.loops.start(steps);
    }

    fn sample(&mut self, s: &Sample<'_>) {
        self.envelope.sample(s);
        if s.output_step.is_none() {
            return;
        }
        self.frames.take(s.t, s.shape);
        self.loops.take(s.t, s.deformation, s.force);
        if !self.keeps_histories {
            return;
        }
        self.time.push(s.t);
        for i in &self.kept {
            self.histories[*i].push(s.values[*i]);
        }
        for (history, e) in self.energy.iter_mut().zip(energies(s.energy)) {
            history.push(e);
        }
    }

    fn between(&mut self, t: f64, values: &[f64], rates: &[f64]) {
        self.envelope.between(t, values, rates);
    }

    fn end(&mut self, s: &Sample<'_>) {
        self.frames.end(s.t, s.shape);
    }
}

/// In the order of [`ENERGIES`].
fn energies(e: &EnergyTotals) -> [f64; ENERGIES.len()] {
    let [energies @ .., _] = e.values();
    energies
}
