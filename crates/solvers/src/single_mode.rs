//! The exact step of one mode on its own, for loads linear in the step.

use trilith_linalg::expm_small;

/// Coefficients of one mode for one step size: rows ∫q, q, q̇; columns q₀, q̇₀, s₀, s₁.
pub(crate) type Mode = [[f64; 4]; 3];

/// Of a mode with this ω² and damping (1/s²; 1/s).
pub(crate) fn exact(omega2: f64, damping: f64, dt: f64) -> Mode {
    if omega2 == 0.0 { free(damping, dt) } else { by_exponential(omega2, damping, dt) }
}

/// By average acceleration: q̇₁ = q̇₀ + Δt (q̈₀ + q̈₁)/2, q₁ = q₀ + Δt (q̇₀ + q̇₁)/2, ∫q = Δt (q₀ + q₁)/2.
pub(crate) fn average(omega2: f64, damping: f64, dt: f64) -> Mode {
    let half = 0.5 * dt;
    let own = half * damping + half * half * omega2;
    let rate = [-dt * omega2, 1.0 - own, half, half].map(|x| x / (1.0 + own));
    let mut way = rate.map(|x| half * x);
    (way[0], way[1]) = (way[0] + 1.0, way[1] + half);
    let mut sum = way.map(|x| half * x);
    sum[0] += half;
    [sum, way, rate]
}

/// Of a mode without stiffness.
fn free(damping: f64, dt: f64) -> Mode {
    let [p0, p1, p2, p3, p4] = phi(-damping * dt);
    let (t2, t3) = (dt * dt, dt * dt * dt);
    [
        [dt, t2 * p2, t3 * (p3 - p4), t3 * p4],
        [1.0, dt * p1, t2 * (p2 - p3), t2 * p3],
        [0.0, p0, dt * (p1 - p2), dt * p2],
    ]
}

/// φₖ(z) = Σ zʲ/(j+k)! for k from 0, where φ₀ is the exponential (Hochbruck and Ostermann, Exponential integrators,
/// Acta Numerica 19, 2010, eq. 2.10): each from its neighbour, on the side where that loses nothing.
fn phi(z: f64) -> [f64; 5] {
    const INVERSE_FACTORIAL: [f64; 4] = [1.0, 1.0, 0.5, 1.0 / 6.0];
    let mut phi = [0.0; 5];
    if z.abs() > 1.0 {
        phi[0] = z.exp();
        for k in 0..4 {
            phi[k + 1] = (phi[k] - INVERSE_FACTORIAL[k]) / z;
        }
        return phi;
    }
    // 1/20! is less than the rounding of 1/4!.
    phi[4] = (5..=20).rev().fold(1.0, |sum, k| 1.0 + sum * z / f64::from(k)) / 24.0;
    for k in (0..4).rev() {
        phi[k] = z.mul_add(phi[k + 1], INVERSE_FACTORIAL[k]);
    }
    phi
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

    /// Energy that the load puts in over a step, ∫ s q̇ dt by parts, is that which the oscillator has won.
    #[test]
    fn average_acceleration_keeps_the_energy() {
        let (omega2, dt) = (4e6, 1e-2);
        let [sum, way, rate] = average(omega2, 0.0, dt);
        let from = [0.3, -7.0, 2e5, -9e5];
        let of = |row: [f64; 4]| row.iter().zip(from).map(|(c, x)| c * x).sum::<f64>();
        let (mean, q, p) = (of(sum) / dt, of(way), of(rate));
        let energy = |q: f64, p: f64| 0.5 * (p * p + omega2 * q * q);
        let won = energy(q, p) - energy(from[0], from[1]);
        let work = from[3] * (q - mean) + from[2] * (mean - from[0]);
        assert!((won - work).abs() < 1e-9 * work.abs(), "{won} {work}");
        // Short steps under a constant load are exact.
        let rows = [exact(omega2, 30.0, 1e-6), average(omega2, 30.0, 1e-6)];
        let held = rows.map(|[_, q, p]| [q, p].map(|x| [x[0], x[1], x[2] + x[3]]));
        for (x, y) in held[0].as_flattened().iter().zip(held[1].as_flattened()) {
            assert!((x - y).abs() <= 1e-5 * x.abs(), "{x} {y}");
        }
    }

    #[test]
    fn the_rule_of_a_free_mode_is_that_of_the_exponential() {
        let dt = 0.3;
        // The series of the exponential rounds at every squaring.
        let allowed = |damping: f64| if damping == 0.0 { 1e-15 } else { 1e-14 };
        for damping in [0.0, 1e-9, 1e-3, 0.7, 3.2, 3.4, 20.0, 100.0] {
            for (a, b) in exact(0.0, damping, dt).iter().zip(&by_exponential(0.0, damping, dt)) {
                for (x, y) in a.iter().zip(b) {
                    assert!((x - y).abs() < allowed(damping), "{damping}: {a:?} {b:?}");
                }
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
