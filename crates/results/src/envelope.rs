//! Extremes without histories.

use crate::Peak;
use trilith_solvers::{Observer, Sample};

/// Watches a run and keeps the extremes of every output, their times and the last values: its memory
/// does not grow with the length of the run.
#[derive(Clone, Debug, Default)]
pub struct Envelope {
    peaks: Vec<Peak>,
    /// Time, values and rates of the sample before.
    before: Option<(f64, Vec<f64>, Vec<f64>)>,
}

impl Envelope {
    /// Nothing seen yet.
    #[must_use]
    pub fn new() -> Self {
        Self::default()
    }

    /// Goes on from the extremes of an earlier part of the case.
    #[must_use]
    pub fn after(mut self, peaks: Vec<Peak>) -> Self {
        self.peaks = peaks;
        self
    }

    /// Extremes of the outputs in the model's order; empty where nothing was seen.
    #[must_use]
    pub fn peaks(&self) -> &[Peak] {
        &self.peaks
    }
}

impl Envelope {
    /// The next moment of all outputs.
    fn advance(&mut self, now: f64, y: &[f64], r: &[f64]) {
        let Some((t, values, rates)) = &mut self.before else { return };
        let from = values.iter().zip(rates.iter());
        for (peak, ((y0, r0), (y1, r1))) in self.peaks.iter_mut().zip(from.zip(y.iter().zip(r))) {
            peak.advance((*t, *y0, *r0), (now, *y1, *r1));
        }
        *t = now;
        values.copy_from_slice(y);
        rates.copy_from_slice(r);
    }
}

impl Observer for Envelope {
    fn between(&mut self, t: f64, values: &[f64], rates: &[f64]) {
        self.advance(t, values, rates);
    }

    fn sample(&mut self, s: &Sample<'_>) {
        if self.before.is_some() {
            return self.advance(s.t, s.values, s.rates);
        }
        // A run that is continued starts from a moment that was seen.
        if self.peaks.len() != s.values.len() {
            self.peaks = s.values.iter().map(|y| Peak::new(s.t, *y)).collect();
        }
        self.before = Some((s.t, s.values.to_vec(), s.rates.to_vec()));
    }
}
