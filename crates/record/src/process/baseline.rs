//! Baselines.

use super::ProcessError;
use crate::measure::{displacement, velocity};

/// What is taken away from an acceleration.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Baseline {
    /// The mean.
    Mean,
    /// The straight line of least squares.
    Linear,
    /// The polynomial of this order of least squares.
    Polynomial(usize),
    /// s(1 − s)(c₀ + c₁ s), s = t/T, with c₀ and c₁ such that velocity and displacement end at zero. It is zero
    /// at both ends, so that the record starts and ends as it did.
    Rest,
}

impl Baseline {
    pub(crate) fn words(self) -> String {
        match self {
            Self::Mean => "mean taken away".into(),
            Self::Linear => "straight line taken away".into(),
            Self::Polynomial(n) => format!("polynomial of order {n} taken away"),
            Self::Rest => "velocity and displacement brought to end at zero".into(),
        }
    }
}

/// Takes a baseline away.
///
/// # Errors
/// [`ProcessError::Baseline`] for a record with too few samples.
pub fn correct(a: &mut [f64], dt: f64, baseline: Baseline) -> Result<(), ProcessError> {
    let order = match baseline {
        Baseline::Mean => 0,
        Baseline::Linear => 1,
        Baseline::Polynomial(n) => n,
        Baseline::Rest => 4,
    };
    if a.len() <= order || order > 20 {
        return Err(ProcessError::Baseline { order, samples: a.len() });
    }
    if baseline == Baseline::Rest {
        rest(a, dt);
    } else {
        fit(a, order);
    }
    Ok(())
}

/// Takes away the polynomial of least squares: projections on polynomials that are orthogonal over the samples
/// (three-term recurrence), twice, so that rounding leaves nothing.
fn fit(a: &mut [f64], order: usize) {
    let n = a.len();
    let x: Vec<f64> = (0..n).map(|i| 2.0 * i as f64 / (n - 1).max(1) as f64 - 1.0).collect();
    for _ in 0..2 {
        let (mut before, mut p) = (vec![0.0; n], vec![1.0; n]);
        let mut norm_before = 1.0;
        for k in 0..=order {
            let norm: f64 = p.iter().map(|v| v * v).sum();
            let share: f64 = p.iter().zip(a.iter()).map(|(p, a)| p * a).sum::<f64>() / norm;
            a.iter_mut().zip(&p).for_each(|(a, p)| *a -= share * p);
            let alpha = p.iter().zip(&x).map(|(p, x)| x * p * p).sum::<f64>() / norm;
            let beta = if k == 0 { 0.0 } else { norm / norm_before };
            let next = (0..n).map(|i| (x[i] - alpha) * p[i] - beta * before[i]).collect();
            norm_before = norm;
            before = std::mem::replace(&mut p, next);
        }
    }
}

fn rest(a: &mut [f64], dt: f64) {
    let n = a.len();
    let shape = |k: i32| -> Vec<f64> {
        let one = |i: usize| {
            let s = i as f64 / (n - 1) as f64;
            s * (1.0 - s) * s.powi(k)
        };
        (0..n).map(one).collect()
    };
    let shapes = [shape(0), shape(1)];
    let ends = |a: &[f64]| {
        let end = |x: Vec<f64>| x.last().copied().unwrap_or(0.0);
        [end(velocity(a, dt)), end(displacement(a, dt))]
    };
    // Twice: the second time takes away what rounding left.
    for _ in 0..2 {
        let [[v0, u0], [v1, u1]] = [ends(&shapes[0]), ends(&shapes[1])];
        let [v, u] = ends(a);
        let det = v0 * u1 - v1 * u0;
        let (c0, c1) = ((v * u1 - v1 * u) / det, (v0 * u - v * u0) / det);
        for i in 0..n {
            a[i] -= c0 * shapes[0][i] + c1 * shapes[1][i];
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn motion(n: usize) -> Vec<f64> {
        (0..n).map(|i| (0.3 * i as f64).sin() + 0.2 * (0.05 * i as f64).cos()).collect()
    }

    #[test]
    fn a_polynomial_goes_away_as_a_whole() {
        for order in 0..6 {
            let mut a: Vec<f64> = (0..500).map(|i| (1.0 + i as f64 / 100.0).powi(order)).collect();
            correct(&mut a, 0.01, Baseline::Polynomial(order as usize)).unwrap();
            assert!(crate::measure::peak(&a) < 1e-9, "{order} {}", crate::measure::peak(&a));
        }
        let mut a = motion(100);
        correct(&mut a, 0.01, Baseline::Mean).unwrap();
        assert!(a.iter().sum::<f64>().abs() < 1e-12);
    }

    #[test]
    fn a_motion_brought_to_rest_ends_there_and_keeps_its_ends() {
        let mut a = motion(1000);
        let before = a.clone();
        correct(&mut a, 0.01, Baseline::Rest).unwrap();
        let (v, u) = (velocity(&a, 0.01), displacement(&a, 0.01));
        assert!(v[999].abs() < 1e-12 && u[999].abs() < 1e-11, "{} {}", v[999], u[999]);
        assert!(velocity(&before, 0.01)[999].abs() > 1e-3);
        assert_eq!((a[0], a[999]), (before[0], before[999]));
    }

    #[test]
    fn too_few_samples_are_refused() {
        assert!(correct(&mut [1.0, 2.0], 0.1, Baseline::Polynomial(3)).is_err());
    }
}
