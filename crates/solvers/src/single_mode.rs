//! The exact step of one mode on its own, for loads linear in the step.

use trilith_linalg::expm_small;

/// Coefficients of one mode for one step size: rows ∫q, q, q̇; columns q₀, q̇₀, s₀, s₁.
pub(crate) type Mode = [[f64; 4]; 3];

/// Of a mode with this ω² and damping (1/s²; 1/s).
pub(crate) fn exact(omega2: f64, damping: f64, dt: f64) -> Mode {
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
    let mut a = [[0.0; 5]; 5];
    a[0][1] = dt;
    a[1][2] = dt;
    a[2] = [0.0, -omega2 * dt, -damping * dt, dt, 0.0];
    a[3][4] = 1.0;
    let e = expm_small(a);
    [0, 1, 2].map(|row| [e[row][1], e[row][2], e[row][3] - e[row][4], e[row][4]])
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_rule_of_a_free_mode_is_that_of_the_exponential() {
        let dt = 0.3;
        for (a, b) in exact(0.0, 0.0, dt).iter().zip(&by_exponential(0.0, 0.0, dt)) {
            for (x, y) in a.iter().zip(b) {
                assert!((x - y).abs() < 1e-15, "{a:?} {b:?}");
            }
        }
    }

    /// Under a constant load q = (1 − cos ωt)/ω².
    #[test]
    fn a_constant_load_is_exact() {
        let (w, dt) = (3.0, 0.7);
        let [_, q, _] = exact(w * w, 0.0, dt);
        assert!((q[2] + q[3] - (1.0 - f64::cos(w * dt)) / (w * w)).abs() < 1e-15);
        assert!((q[0] - f64::cos(w * dt)).abs() < 1e-14);
    }
}
