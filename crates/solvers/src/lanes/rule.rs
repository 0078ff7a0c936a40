//! Coefficients of one mode for one step size, and of the links on all modes.

use trilith_linalg::{Dense, expm};

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
    by_exponential(omega2, damping, dt)
}

/// exp of the augmented system with the states ∫q, q, q̇, s, ṡ·dt.
fn by_exponential(omega2: f64, damping: f64, dt: f64) -> Mode {
    let mut a = Dense::zeros(5, 5);
    a[(0, 1)] = dt;
    a[(1, 2)] = dt;
    a[(2, 1)] = -omega2 * dt;
    a[(2, 2)] = -damping * dt;
    a[(2, 3)] = dt;
    a[(3, 4)] = 1.0;
    let e = expm(&a);
    [0, 1, 2].map(|row| [e[(row, 1)], e[(row, 2)], e[(row, 3)] - e[(row, 4)], e[(row, 4)]])
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
        for (a, b) in mode(0.0, 0.0, dt).iter().zip(&by_exponential(0.0, 0.0, dt)) {
            for (x, y) in a.iter().zip(b) {
                assert!((x - y).abs() < 1e-15, "{a:?} {b:?}");
            }
        }
    }

    /// Under a constant load q = (1 − cos ωt)/ω².
    #[test]
    fn a_constant_load_is_exact() {
        let (w, dt) = (3.0, 0.7);
        let [_, q, _] = mode(w * w, 0.0, dt);
        assert!((q[2] + q[3] - (1.0 - f64::cos(w * dt)) / (w * w)).abs() < 1e-15);
        assert!((q[0] - f64::cos(w * dt)).abs() < 1e-14);
    }
}
