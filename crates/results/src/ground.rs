//! The ground motion of a case: what accelerates the base, and the spectrum of it.

use trilith_element::Dof;
use trilith_model::{Analysis, Model, Side, TimeFunction};
use trilith_record::measure::{periods, pseudo_accelerations};

/// Damping of the spectra of ground motions, share of critical.
pub const GROUND_DAMPING: f64 = 0.05;
/// Periods of the spectrum: from, to (s) and how many.
const PERIODS: (f64, f64, usize) = (0.02, 5.0, 180);
/// Longest sampling step, s: a spectrum down to 0.02 s needs no less.
const STEP: f64 = 0.005;
/// Samples at most.
const SAMPLES: f64 = 1e6;

/// Acceleration of the base along one direction, over the whole length of a case.
#[derive(Clone, Debug, PartialEq)]
pub struct GroundMotion {
    /// Direction: Ux, Uy or Uz.
    pub direction: Dof,
    /// Times, s, evenly spaced from 0.
    pub time: Vec<f64>,
    /// Accelerations, m/s².
    pub acceleration: Vec<f64>,
    /// Largest |acceleration|, m/s², with its sign, and its time, s.
    pub peak: (f64, f64),
    /// Periods of its response spectrum, s.
    pub periods: Vec<f64>,
    /// Pseudo-accelerations there for 5 % damping, m/s².
    pub psa: Vec<f64>,
}

/// The ground motions of a case, one for each direction in which the base moves; none for a static case.
///
/// `dt` is the output step, s. Motions are sampled at this step or at 5 ms, whichever is shorter; of very long cases
/// at a millionth of their length.
#[must_use]
pub fn ground_motions(model: &Model, case: usize, dt: f64) -> Vec<GroundMotion> {
    let Some(Analysis::Dynamic(case)) = model.cases.get(case).map(|c| &c.analysis) else {
        return Vec::new();
    };
    let step = if dt > 0.0 { dt.min(STEP) } else { STEP }.max(case.duration / SAMPLES);
    let count = (case.duration / step).round().max(1.0) as usize + 1;
    let one = |direction: Dof| {
        let parts: Vec<(f64, &TimeFunction)> = case
            .base
            .iter()
            .filter(|b| b.direction == direction)
            .filter_map(|b| Some((b.factor, &model.functions.get(b.function)?.function)))
            .collect();
        if parts.is_empty() {
            return None;
        }
        let time: Vec<f64> = (0..count).map(|i| i as f64 * step).collect();
        let at = |t: f64| parts.iter().map(|(k, f)| k * f.value(t, Side::Before)).sum();
        let acceleration: Vec<f64> = time.iter().map(|t| at(*t)).collect();
        let largest = |best: (f64, f64), (t, a): (&f64, &f64)| {
            if a.abs() > best.0.abs() { (*a, *t) } else { best }
        };
        let peak = time.iter().zip(&acceleration).fold((0.0, 0.0), largest);
        // Nothing shakes: there is nothing to show.
        if peak.0 == 0.0 {
            return None;
        }
        let (from, to, n) = PERIODS;
        let periods = periods(from, to, n);
        let psa = pseudo_accelerations(&acceleration, step, &periods, GROUND_DAMPING);
        Some(GroundMotion { direction, time, acceleration, peak, periods, psa })
    };
    [Dof::Ux, Dof::Uy, Dof::Uz].into_iter().filter_map(one).collect()
}
