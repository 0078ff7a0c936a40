//! What the lead core loses to the end plates and to the shims.
//!
//! ```text
//!   Ṫ = −g(t) T,   g = k_s/(a ρ c h) (1/F(τ) + 1.274 (t_s/a) τ^(−1/3)),   τ = α_s t/a²
//! ```
//!
//! F is the mean temperature rise of a disc on a half-space under constant flux: 2 √(τ/π) at first, 8/(3π) in
//! the end, by series on either side of τ = 0.6.

use std::f64::consts::PI;

/// F(τ).
pub(super) fn disc(tau: f64) -> f64 {
    if tau < 0.6 {
        let x = 0.25 * tau;
        return 2.0 * (tau / PI).sqrt() - tau / PI * (2.0 - x - x * x - 3.75 * x.powi(3));
    }
    let y = 0.25 / tau;
    let bracket = 1.0 - y / 3.0 + y * y / 6.0 - y.powi(3) / 12.0;
    8.0 / (3.0 * PI) - bracket / (2.0 * (PI * tau).sqrt())
}

/// The numbers of g.
#[derive(Clone, Copy, Debug)]
pub(super) struct Cooling {
    /// k_s/(a ρ c h), 1/s.
    pub(super) rate: f64,
    /// α_s/a², 1/s.
    pub(super) diffusion: f64,
    /// t_s/a.
    pub(super) shims: f64,
}

impl Cooling {
    /// g at a time > 0.
    pub(super) fn at(&self, t: f64) -> f64 {
        let tau = self.diffusion * t;
        self.rate * (1.0 / disc(tau) + 1.274 * self.shims / tau.cbrt())
    }

    /// ∫ g dt. Gauss's rule in √t, in which the singular start is smooth.
    pub(super) fn over(&self, from: f64, to: f64) -> f64 {
        let (a, b) = (from.sqrt(), to.sqrt());
        let (middle, half) = (0.5 * (a + b), 0.5 * (b - a));
        let part = |x: f64, weight: f64| {
            let s = middle + half * x;
            weight * half * 2.0 * s * self.at(s * s)
        };
        if to <= from {
            return 0.0;
        }
        let x = 0.6_f64.sqrt();
        part(0.0, 8.0 / 9.0) + part(-x, 5.0 / 9.0) + part(x, 5.0 / 9.0)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use approx::assert_relative_eq;

    /// The limits of the mean temperature of a heated disc on a half-space (Carslaw & Jaeger, § 10.5).
    #[test]
    fn the_disc_is_a_plane_at_first_and_steady_in_the_end() {
        assert_relative_eq!(disc(1e-8), 2.0 * (1e-8 / PI).sqrt(), max_relative = 1e-3);
        assert_relative_eq!(disc(1e8), 8.0 / (3.0 * PI), max_relative = 1e-3);
        // The series meet to a thousandth.
        assert_relative_eq!(disc(0.6 - 1e-12), disc(0.6), max_relative = 1.1e-3);
    }

    #[test]
    fn its_integral_is_good_from_the_start_on() {
        let cooling = Cooling { rate: 1e-3, diffusion: 2e-3, shims: 0.7 };
        for (from, to) in [(0.0, 0.01), (0.01, 0.02), (5.0, 5.01), (200.0, 201.0)] {
            let n = 200_000;
            let h = (to - from) / f64::from(n);
            let sum: f64 = (0..n).map(|i| cooling.at(from + (f64::from(i) + 0.5) * h) * h).sum();
            assert_relative_eq!(cooling.over(from, to), sum, max_relative = 4e-3);
        }
    }
}
