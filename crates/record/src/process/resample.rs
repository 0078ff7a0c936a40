//! Another time step.

use super::ProcessError;
use crate::MOST_SAMPLES;
use std::f64::consts::PI;

/// How values between samples come about.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Resampling {
    /// Band-limited: a sinc within a Kaiser window of 32 zero crossings to each side (−100 dB), which also cuts what
    /// a longer step cannot hold; zero before and behind the record.
    #[default]
    BandLimited,
    /// Straight lines; a finer step changes no motion that is straight between samples.
    Linear,
}

/// Samples at 0, `to`, 2 `to` … up to the end of the record.
///
/// # Errors
/// [`ProcessError::Step`] for a step that is not above 0, longer than the record, or that makes [`MOST_SAMPLES`] samples.
pub fn resample(a: &[f64], dt: f64, to: f64, how: Resampling) -> Result<Vec<f64>, ProcessError> {
    let duration = a.len().saturating_sub(1) as f64 * dt;
    let samples = duration / to * (1.0 + 1e-9);
    if !(to > 0.0 && to.is_finite() && (1.0..MOST_SAMPLES as f64).contains(&samples)) {
        return Err(ProcessError::Step(to));
    }
    let times = (0..=samples.floor() as usize).map(|i| i as f64 * to / dt);
    Ok(match how {
        Resampling::Linear => times.map(|x| linear(a, x)).collect(),
        Resampling::BandLimited => {
            // What lies above half the lower of both rates goes.
            let cut = (dt / to).min(1.0);
            times.map(|x| sinc(a, x, cut)).collect()
        }
    })
}

/// At position x, in samples.
fn linear(a: &[f64], x: f64) -> f64 {
    let i = (x.floor() as usize).min(a.len() - 1);
    let share = x - i as f64;
    match a.get(i + 1) {
        Some(next) => a[i] + share * (next - a[i]),
        None => a[i],
    }
}

const CROSSINGS: f64 = 32.0;
const BETA: f64 = 10.0;

fn sinc(a: &[f64], x: f64, cut: f64) -> f64 {
    let half = CROSSINGS / cut;
    let first = (x - half).ceil().max(0.0) as usize;
    let last = ((x + half).floor() as usize).min(a.len() - 1);
    let top = bessel(BETA);
    (first..=last)
        .map(|i| {
            let d = x - i as f64;
            let window = bessel(BETA * (1.0 - (d / half).powi(2)).max(0.0).sqrt()) / top;
            let y = PI * cut * d;
            let core = if y == 0.0 { 1.0 } else { y.sin() / y };
            a[i] * cut * core * window
        })
        .sum()
}

/// Modified Bessel function I₀, by its series.
fn bessel(x: f64) -> f64 {
    let q = 0.25 * x * x;
    let (mut sum, mut term) = (1.0, 1.0);
    for k in 1..60 {
        term *= q / f64::from(k * k);
        sum += term;
        if term < 1e-17 * sum {
            break;
        }
    }
    sum
}

#[cfg(test)]
mod tests {
    use super::*;

    fn sine(f: f64, dt: f64, n: usize) -> Vec<f64> {
        (0..n).map(|i| (2.0 * PI * f * i as f64 * dt).sin()).collect()
    }

    #[test]
    fn a_sine_below_the_cut_comes_through_and_one_above_does_not() {
        let a = sine(5.0, 0.01, 2001);
        for to in [0.004, 0.01, 0.0125] {
            let out = resample(&a, 0.01, to, Resampling::BandLimited).unwrap();
            let exact = sine(5.0, to, out.len());
            let middle = out.len() / 4..3 * out.len() / 4;
            assert!(middle.clone().all(|i| (out[i] - exact[i]).abs() < 1e-5), "{to}");
        }
        let fast = sine(30.0, 0.01, 2001);
        let out = resample(&fast, 0.01, 0.025, Resampling::BandLimited).unwrap();
        assert!(out[200..600].iter().all(|x| x.abs() < 1e-4));
    }

    #[test]
    fn straight_lines_keep_the_samples() {
        let a = [0.0, 1.0, -1.0, 0.5];
        let out = resample(&a, 0.1, 0.05, Resampling::Linear).unwrap();
        let exact = [0.0, 0.5, 1.0, 0.0, -1.0, -0.25, 0.5];
        assert_eq!(out.len(), 7);
        assert!(out.iter().zip(exact).all(|(x, y)| (x - y).abs() < 1e-12), "{out:?}");
        assert!(resample(&a, 0.1, 0.0, Resampling::Linear).is_err());
        assert!(resample(&a, 0.1, 5.0, Resampling::Linear).is_err());
    }
}
