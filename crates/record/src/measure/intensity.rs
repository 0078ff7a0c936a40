//! Arias intensity, Husid curve, significant duration, cumulative absolute velocity.

use crate::STANDARD_GRAVITY;
use std::f64::consts::PI;

/// Arias intensity π/(2g) ∫ a² dt, m/s \[Arias 1970\].
#[must_use]
pub fn arias(acceleration: &[f64], dt: f64) -> f64 {
    squares(acceleration, dt).last().map_or(0.0, |total| PI / (2.0 * STANDARD_GRAVITY) * total)
}

/// Share of the Arias intensity that has come in by each sample, 0 … 1 \[Husid 1969\].
#[must_use]
pub fn husid(acceleration: &[f64], dt: f64) -> Vec<f64> {
    let mut sums = squares(acceleration, dt);
    let total = sums.last().copied().unwrap_or(0.0);
    if total > 0.0 {
        sums.iter_mut().for_each(|s| *s /= total);
    }
    sums
}

/// The times at which two shares of the Arias intensity have come in, such as 0.05 and 0.95, s; the significant
/// duration is their difference \[Trifunac & Brady 1975\].
#[must_use]
pub fn significant_duration(acceleration: &[f64], dt: f64, from: f64, to: f64) -> [f64; 2] {
    let curve = husid(acceleration, dt);
    [from, to].map(|share| {
        let i = curve.partition_point(|x| *x < share);
        if i == 0 || i >= curve.len() {
            return i.min(curve.len().saturating_sub(1)) as f64 * dt;
        }
        (i as f64 - (curve[i] - share) / (curve[i] - curve[i - 1])) * dt
    })
}

/// Cumulative absolute velocity ∫ |a| dt, m/s \[EPRI 1988\].
#[must_use]
pub fn cav(acceleration: &[f64], dt: f64) -> f64 {
    let one = |w: &[f64]| {
        let (a, b) = (w[0], w[1]);
        if a * b >= 0.0 {
            0.5 * (a.abs() + b.abs())
        } else {
            // Two triangles with the zero crossing between them.
            0.5 * (a * a + b * b) / (a.abs() + b.abs())
        }
    };
    dt * acceleration.windows(2).map(one).sum::<f64>()
}

/// ∫ a² dt up to each sample.
fn squares(acceleration: &[f64], dt: f64) -> Vec<f64> {
    let mut sum = 0.0;
    let mut all = Vec::with_capacity(acceleration.len());
    all.extend(acceleration.first().map(|_| 0.0));
    for w in acceleration.windows(2) {
        sum += dt / 3.0 * (w[0] * w[0] + w[0] * w[1] + w[1] * w[1]);
        all.push(sum);
    }
    all
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::f64::consts::TAU;

    /// ∫ (A sin ωt)² dt over whole cycles is A² T/2, ∫ |A sin ωt| dt is 2 A T/π.
    #[test]
    fn a_sine_has_the_intensities_of_the_closed_form() {
        let (amplitude, f, dt) = (2.0, 2.5, 1e-4);
        let a: Vec<f64> =
            (0..=40_000).map(|i| amplitude * (TAU * f * i as f64 * dt).sin()).collect();
        let exact = PI / (2.0 * STANDARD_GRAVITY) * amplitude * amplitude * 4.0 / 2.0;
        assert!((arias(&a, dt) / exact - 1.0).abs() < 1e-6);
        assert!((cav(&a, dt) / (2.0 * amplitude * 4.0 / PI) - 1.0).abs() < 1e-6);
        let [from, to] = significant_duration(&a, dt, 0.05, 0.95);
        assert!((from + to - 4.0).abs() < 1e-6 && (to - from - 3.6).abs() < 0.1);
    }

    #[test]
    fn nothing_has_no_intensity() {
        assert_eq!(arias(&[], 0.1), 0.0);
        assert_eq!(arias(&[0.0, 0.0], 0.1), 0.0);
        assert_eq!(husid(&[0.0, 0.0], 0.1), [0.0, 0.0]);
        assert_eq!(cav(&[1.0, -1.0], 1.0), 0.5);
    }
}
