//! The imposed deformation: to the mean, then cycles that grow.

use crate::element::Stroke;
use std::f64::consts::TAU;

/// A smooth ramp of one period to the means, then `cycles` cycles that reach `1/cycles`, `2/cycles` … of the
/// amplitudes, and a quarter more, so that the last period is a closed cycle at full amplitude.
///
/// ```text
///   dᵢ(t) = meanᵢ r(t) + aᵢ g(t) sin 2π(f t + φᵢ)
/// ```
///
/// r and g are continuous with two derivatives; g rises in the first quarter of every cycle.
#[derive(Clone, Debug, PartialEq)]
pub struct Motion {
    /// Cycles in a second, Hz.
    pub frequency: f64,
    /// One for each coordinate.
    pub strokes: Vec<Stroke>,
    /// How many cycles, 1 or more.
    pub cycles: usize,
}

/// From 0 to 1 as x does, with its derivative.
fn rise(x: f64) -> (f64, f64) {
    let x = x.clamp(0.0, 1.0);
    (x.powi(3) * (10.0 - 15.0 * x + 6.0 * x * x), 30.0 * (x * (1.0 - x)).powi(2))
}

impl Motion {
    /// Seconds of a cycle.
    #[must_use]
    pub fn period(&self) -> f64 {
        1.0 / self.frequency
    }

    /// Periods before the cycles: the ramp to the mean, where there is one.
    fn before(&self) -> f64 {
        if self.strokes.iter().any(|s| s.mean != 0.0) { 1.0 } else { 0.0 }
    }

    /// Periods of the whole.
    pub(super) fn periods(&self) -> f64 {
        self.before() + self.cycles.max(1) as f64 + 0.25
    }

    /// Seconds of the whole.
    #[must_use]
    pub fn duration(&self) -> f64 {
        self.periods() * self.period()
    }

    /// Deformations and rates at a time.
    #[must_use]
    pub fn at(&self, time: f64) -> (Vec<f64>, Vec<f64>) {
        let f = self.frequency;
        let before = self.before();
        let (mean, mean_rate) = if before > 0.0 { rise(time * f) } else { (1.0, 0.0) };
        let cycles = self.cycles.max(1) as f64;
        // In periods since the cycles began; the last quarter belongs to the last cycle.
        let at = (time * f - before).max(0.0);
        let number = at.floor().min(cycles - 1.0);
        let (part, part_rate) = rise(4.0 * (at - number));
        let (grown, grown_rate) = ((number + part) / cycles, 4.0 * f * part_rate / cycles);
        let one = |s: &Stroke| {
            let (sin, cos) = (TAU * (at + s.phase)).sin_cos();
            let d = s.mean * mean + s.amplitude * grown * sin;
            let v =
                s.mean * mean_rate * f + s.amplitude * (grown_rate * sin + grown * TAU * f * cos);
            (d, v)
        };
        self.strokes.iter().map(one).unzip()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn motion() -> Motion {
        let orbit = Stroke::about(0.2, 0.3).with_phase(0.25);
        Motion { frequency: 2.0, strokes: vec![Stroke::about(-1.0, 0.5), orbit], cycles: 3 }
    }

    #[test]
    fn rates_are_the_derivatives_and_nothing_jumps() {
        let m = motion();
        let h = 1e-6;
        let n = 1000;
        for k in 1..n {
            let t = m.duration() * k as f64 / n as f64;
            let ((a, _), (_, v), (b, _)) = (m.at(t - h), m.at(t), m.at(t + h));
            for i in 0..2 {
                let quotient = (b[i] - a[i]) / (2.0 * h);
                assert!((quotient - v[i]).abs() < 1e-3, "{t}: {quotient} {}", v[i]);
            }
        }
    }

    #[test]
    fn it_starts_at_rest_and_grows_by_thirds_about_the_mean() {
        let m = motion();
        assert_eq!(m.at(0.0), (vec![0.0; 2], vec![0.0; 2]));
        let peak = |cycle: f64| m.at((1.0 + cycle + 0.25) / m.frequency).0[0];
        for (cycle, expected) in [(0.0, 0.5 / 3.0), (1.0, 1.0 / 3.0), (2.0, 0.5), (3.0, 0.5)] {
            assert!((peak(cycle) - (-1.0 + expected)).abs() < 1e-12, "{cycle}");
        }
    }

    #[test]
    fn the_last_period_is_closed() {
        let m = motion();
        let (end, rate) = m.at(m.duration());
        let (start, before) = m.at(m.duration() - m.period());
        for i in 0..2 {
            assert!((end[i] - start[i]).abs() < 1e-12 && (rate[i] - before[i]).abs() < 1e-11);
        }
    }
}
