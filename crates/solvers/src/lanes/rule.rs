//! Coefficients of one mode for one step size, and of the links on all modes.

use crate::modal::coupled_rule;
use trilith_linalg::Dense;

/// Rows ∫q, q, q̇; columns q₀, q̇₀, s₀, s₁.
pub(super) type Mode = [[f64; 4]; 3];

/// Exact for loads linear in the step.
pub(super) fn mode(omega2: f64, damping: f64, dt: f64) -> Mode {
    if omega2 == 0.0 && damping == 0.0 {
        let t2 = dt * dt;
        return [
            [dt, 0.5 * t2, t2 * dt / 8.0, t2 * dt / 24.0],
            [1.0, dt, t2 / 3.0, t2 / 6.0],
            [0.0, 1.0, 0.5 * dt, 0.5 * dt],
        ];
    }
    let one = Dense::from_columns(1, 1, vec![damping]);
    coupled_rule(&[omega2], &one, dt).map(|row| row.map(|block| block[(0, 0)]))
}

/// Spectral radius of G k: the exact rule is stable below 2.
pub(super) fn stiffness_ratio(rows: &[Vec<f64>], modes: &[Mode], engaged: &[f64]) -> f64 {
    let mut x = vec![1.0; rows.len()];
    let mut ratio = 0.0;
    for _ in 0..50 {
        let mut s = vec![0.0; modes.len()];
        for (row, (x, k)) in rows.iter().zip(x.iter().zip(engaged)) {
            for (s, b) in s.iter_mut().zip(row) {
                *s += b * x * k;
            }
        }
        for (s, c) in s.iter_mut().zip(modes) {
            *s *= c[1][3];
        }
        let y: Vec<f64> =
            rows.iter().map(|row| row.iter().zip(&s).map(|(b, s)| b * s).sum()).collect();
        let size = y.iter().fold(0.0f64, |a, b| a.max(b.abs()));
        if size == 0.0 || !size.is_finite() {
            return size;
        }
        let settled = (size - ratio).abs() <= 1e-3 * size;
        ratio = size;
        x = y.into_iter().map(|v| v / size).collect();
        if settled {
            break;
        }
    }
    ratio
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_rule_of_a_free_mode_is_that_of_the_exponential() {
        let dt = 0.3;
        let one = Dense::from_columns(1, 1, vec![0.0]);
        let by_expm = coupled_rule(&[0.0], &one, dt);
        for (a, b) in mode(0.0, 0.0, dt).iter().zip(&by_expm) {
            for (x, y) in a.iter().zip(b) {
                assert!((x - y[(0, 0)]).abs() < 1e-15, "{a:?}");
            }
        }
    }
}
