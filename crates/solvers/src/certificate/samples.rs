//! Outputs of a run at times that a second run of the same motion comes to as well.
//!
//! Every run ends a step at the end of every segment of the timeline, and steps lie on halvings of the segment. Times of
//! comparison are ends of segments, of which some are left out where there are many, and halvings of segments where there
//! are few: a run that is finer or coarser than these has fewer.

use super::touches::Touches;
use crate::march::{Segment, Timeline};
use crate::record::Outputs;
use crate::step::State;
use crate::structure::ReducedSystem;
use std::ops::Range;
use trilith_model::{Model, Side};
use trilith_system::{LoadSet, System};

/// Times of comparison; no more than twice as many.
const TIMES: usize = 500;

/// Outputs of a run at the times of comparison.
pub(crate) struct Samples<'a> {
    outputs: Outputs,
    count: usize,
    loads: &'a LoadSet,
    /// Equal parts of a segment.
    parts: usize,
    /// Segments from one time to the next.
    stride: usize,
    ended: usize,
    pub times: Vec<f64>,
    pub values: Vec<Vec<f64>>,
    /// What happens between them.
    pub touches: Touches,
}

impl<'a> Samples<'a> {
    /// None yet, of a run over these output steps from a state.
    pub(crate) fn new(
        model: &Model,
        system: &System,
        loads: &'a LoadSet,
        space: &ReducedSystem,
        timeline: &Timeline,
        steps: Range<usize>,
        state: &State,
    ) -> Self {
        let from = (timeline.time(steps.start), state);
        let outputs = Outputs::new(model, system, space);
        let touches = Touches::new(model, system, &outputs, space, from);
        let segments: usize = steps.map(|step| timeline.pieces(step).count()).sum();
        let segments = segments.max(1);
        Self {
            outputs,
            touches,
            count: model.outputs.len(),
            loads,
            parts: TIMES.div_ceil(segments).next_power_of_two(),
            stride: segments.div_ceil(2 * TIMES),
            ended: 0,
            times: Vec::new(),
            values: Vec::new(),
        }
    }

    /// The link forces that an output is a sum of, by flat coordinate.
    pub(super) fn link_forces(&self, output: usize) -> &[(usize, f64)] {
        self.outputs.rows[output].link_forces()
    }

    /// Takes the outputs at the end of a step in a segment, if that is a time of comparison.
    pub(crate) fn take(&mut self, segment: Segment, t: f64, state: &State) -> Option<&[f64]> {
        self.touches.follow(t, state);
        if t == segment.end {
            self.ended += 1;
            if !self.ended.is_multiple_of(self.stride) {
                return None;
            }
        } else {
            let parts = self.parts as f64;
            let near = ((t - segment.start) / segment.length * parts).round();
            if t != segment.time(near / parts) {
                return None;
            }
        }
        let values = self.now(t, state);
        self.touches.keep();
        self.times.push(t);
        self.values.push(values);
        self.values.last().map(Vec::as_slice)
    }

    /// The outputs at the end of a step, whenever that is.
    pub(crate) fn now(&self, t: f64, state: &State) -> Vec<f64> {
        let mut values = vec![0.0; self.count];
        self.outputs.at((t, Side::Before), state, self.loads).values(&mut values);
        values
    }

    /// The largest difference of every output from another run at the times that both have come to; not a number
    /// where there are none, or the other has not come as far.
    pub(crate) fn apart(&self, other: &Self) -> Vec<f64> {
        let mut apart = vec![0.0; self.count];
        let mut common = 0;
        let mut theirs = other.times.iter().zip(&other.values).peekable();
        for (t, own) in self.times.iter().zip(&self.values) {
            while theirs.next_if(|(other, _)| *other < t).is_some() {}
            let Some((_, values)) = theirs.next_if(|(other, _)| *other == t) else { continue };
            common += 1;
            for (most, (a, b)) in apart.iter_mut().zip(own.iter().zip(values)) {
                let off = (a - b).abs();
                // What is not a number stays so.
                if off > *most || off.is_nan() {
                    *most = off;
                }
            }
        }
        let whole = common > 0 && other.reach(self);
        if whole { apart } else { vec![f64::NAN; self.count] }
    }

    /// True where it has come as far as another run.
    pub(crate) fn reach(&self, other: &Self) -> bool {
        self.times.last() >= other.times.last()
    }
}
