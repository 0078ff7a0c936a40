//! Motions along which links are led.

use std::f64::consts::{FRAC_PI_2, TAU};

/// How long every motion lasts, s.
pub(super) const DURATION: f64 = 3.0;

/// One coordinate of a motion, m.
#[derive(Clone, Copy, Debug)]
pub(super) enum Wave {
    /// Stays where it is.
    Held(f64),
    /// From zero, straight, to this.
    Ramp(f64),
    /// Cycles that grow up to an amplitude: amplitude, frequency in Hz.
    Growing(f64, f64),
    /// The same, a quarter of a cycle ahead.
    Ahead(f64, f64),
    /// Two frequencies without a common period, growing: some reversals are within larger loops.
    Irregular(f64),
    /// About a mean: mean, amplitude, frequency in Hz.
    About(f64, f64, f64),
}

impl Wave {
    /// Deformation and rate at a time.
    pub fn at(self, t: f64) -> (f64, f64) {
        let share = t / DURATION;
        // A factor that grows from nought to one over the duration, times a wave.
        let grown = |(d, v): (f64, f64)| (share * d, d / DURATION + share * v);
        match self {
            Self::Held(d) => (d, 0.0),
            Self::Ramp(d) => (share * d, d / DURATION),
            Self::Growing(a, f) => grown(sine(a, f, 0.0, t)),
            Self::Ahead(a, f) => grown(sine(a, f, FRAC_PI_2, t)),
            Self::Irregular(a) => {
                let (one, two) = (sine(0.5 * a, 0.9, 0.0, t), sine(0.5 * a, 2.17, 0.0, t));
                grown((one.0 + two.0, one.1 + two.1))
            }
            Self::About(mean, a, f) => {
                let (d, v) = sine(a, f, 0.0, t);
                (mean + d, v)
            }
        }
    }
}

fn sine(amplitude: f64, frequency: f64, phase: f64, t: f64) -> (f64, f64) {
    let w = TAU * frequency;
    let (sin, cos) = (w * t + phase).sin_cos();
    (amplitude * sin, amplitude * w * cos)
}

/// Deformations and rates of all coordinates, a list each, at equal steps from the start to the end.
pub(super) fn sampled(waves: &[Wave], steps: usize) -> (Vec<Vec<f64>>, Vec<Vec<f64>>) {
    let times = (0..=steps).map(|i| DURATION * i as f64 / steps as f64);
    let one = |wave: &Wave| times.clone().map(|t| wave.at(t)).unzip();
    waves.iter().map(one).unzip()
}
