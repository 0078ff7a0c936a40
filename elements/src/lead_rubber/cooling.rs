//! What the lead core loses to the end plates and to the shims.
//!
//! ```text
//!   Ṫ = −g(t) T,   g = k_s/(a ρ c h) (1/F(τ) + 1.274 (t_s/a) τ^(−1/3)),   τ = α_s t/a²
//! ```
//!
//! F is the mean temperature rise of a disc on a half-space under constant flux: 2 √(τ/π) at first, 8/(3π) in
//! the end, by series on either side of τ = 0.6.

use std::f64::consts::PI;
use trilith_element::lanes::Real;

/// F(τ).
#[inline(always)]
pub(super) fn disc<R: Real>(tau: R) -> R {
    let (one, two, quarter, pi) = (tau.of(1.0), tau.of(2.0), tau.of(0.25), tau.of(PI));
    let x = quarter * tau;
    let series = two - x - x * x - x.of(3.75) * (x * x * x);
    let early = two * (tau / pi).sqrt() - tau / pi * series;
    let y = quarter / tau;
    let bracket = one - y / y.of(3.0) + y * y / y.of(6.0) - y * y * y / y.of(12.0);
    let late = tau.of(8.0 / (3.0 * PI)) - bracket / (two * (pi * tau).sqrt());
    R::select(tau.lt(tau.of(0.6)), early, late)
}

/// The numbers of g.
#[derive(Clone, Copy, Debug)]
pub(super) struct Cooling<R> {
    /// k_s/(a ρ c h), 1/s.
    pub(super) rate: R,
    /// α_s/a², 1/s.
    pub(super) diffusion: R,
    /// t_s/a.
    pub(super) shims: R,
}

impl<R: Real> Cooling<R> {
    /// g at a time > 0.
    #[inline(always)]
    pub(super) fn at(&self, t: R) -> R {
        let tau = self.diffusion * t;
        self.rate * (t.of(1.0) / disc(tau) + t.of(1.274) * self.shims / tau.cbrt())
    }

    /// ∫ g dt. Gauss's rule in √t, in which the singular start is smooth.
    #[inline(always)]
    pub(super) fn over(&self, from: R, to: R) -> R {
        let (a, b) = (from.sqrt(), to.sqrt());
        let (middle, half) = (from.of(0.5) * (a + b), from.of(0.5) * (b - a));
        let mut sum = from.of(0.0);
        let x = 0.6_f64.sqrt();
        for (x, weight) in [(0.0, 8.0 / 9.0), (-x, 5.0 / 9.0), (x, 5.0 / 9.0)] {
            let s = middle + half * from.of(x);
            sum = sum + from.of(weight) * half * from.of(2.0) * s * self.at(s * s);
        }
        sum.only(from.lt(to))
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
