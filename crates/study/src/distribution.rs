//! Distributions by their quantile function.

use statrs::distribution::{ContinuousCDF, Normal};

/// A distribution of a parameter.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Distribution {
    /// Even between two values.
    Uniform {
        /// Lower end.
        from: f64,
        /// Upper end.
        to: f64,
    },
    /// Even in the logarithm between two values above 0.
    LogUniform {
        /// Lower end.
        from: f64,
        /// Upper end.
        to: f64,
    },
    /// Normal, cut off outside two ends.
    Normal {
        /// Mean.
        mean: f64,
        /// Standard deviation.
        deviation: f64,
        /// Lower end; −∞: none.
        from: f64,
        /// Upper end; ∞: none.
        to: f64,
    },
    /// Lognormal, cut off outside two ends.
    LogNormal {
        /// Median.
        median: f64,
        /// Standard deviation of the logarithm.
        dispersion: f64,
        /// Lower end; 0: none.
        from: f64,
        /// Upper end; ∞: none.
        to: f64,
    },
}

/// The standard normal distribution function.
#[must_use]
pub fn phi(z: f64) -> f64 {
    Normal::standard().cdf(z)
}

/// The quantile of the standard normal distribution.
#[must_use]
pub fn phi_inverse(p: f64) -> f64 {
    Normal::standard().inverse_cdf(p)
}

/// The quantile of a standard normal distribution cut off outside two ends.
fn cut(u: f64, from: f64, to: f64) -> f64 {
    // In the upper tail 1 − Φ loses digits: mirror.
    if from > 0.0 {
        return -cut(1.0 - u, -to, -from);
    }
    let (low, high) = (phi(from), phi(to));
    phi_inverse(low + u * (high - low)).clamp(from, to)
}

impl Distribution {
    /// The value that a share `u` (above 0, below 1) of all values lies below.
    #[must_use]
    pub fn quantile(&self, u: f64) -> f64 {
        match *self {
            Self::Uniform { from, to } => from + u * (to - from),
            Self::LogUniform { from, to } => from * (u * (to / from).ln()).exp(),
            Self::Normal { mean, deviation, from, to } => {
                let z = |x: f64| (x - mean) / deviation;
                mean + deviation * cut(u, z(from), z(to))
            }
            Self::LogNormal { median, dispersion, from, to } => {
                let z = |x: f64| (x / median).ln() / dispersion;
                median * (dispersion * cut(u, z(from), z(to))).exp()
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn moments(d: Distribution) -> (f64, f64) {
        let n = 100_000;
        let all = (0..n).map(|i| d.quantile((f64::from(i) + 0.5) / f64::from(n)));
        let (s, q) = all.fold((0.0, 0.0), |(s, q), x| (s + x, q + x * x));
        let mean = s / f64::from(n);
        (mean, (q / f64::from(n) - mean * mean).sqrt())
    }

    #[test]
    fn moments_are_those_of_the_textbook() {
        let inf = f64::INFINITY;
        let e = std::f64::consts::E;
        // Cut at ±2: 1 − 2·2φ(2)/(2Φ(2) − 1); cut below at 1.5: φ/(1 − Φ), 1 + zλ − λ².
        let lambda: f64 = 0.129_517_595_665_892 / 0.066_807_201_268_858;
        let cases = [
            (Distribution::Uniform { from: 1.0, to: 4.0 }, 2.5, 3.0 / 12f64.sqrt()),
            (
                Distribution::LogUniform { from: 1.0, to: e },
                e - 1.0,
                ((e * e - 1.0) / 2.0 - (e - 1.0) * (e - 1.0)).sqrt(),
            ),
            (Distribution::Normal { mean: 3.0, deviation: 0.5, from: -inf, to: inf }, 3.0, 0.5),
            (
                Distribution::Normal { mean: 3.0, deviation: 0.5, from: 2.0, to: 4.0 },
                3.0,
                0.5 * 0.773_741_3f64.sqrt(),
            ),
            (
                Distribution::Normal { mean: 0.0, deviation: 1.0, from: 1.5, to: inf },
                lambda,
                (1.0 + 1.5 * lambda - lambda * lambda).sqrt(),
            ),
            (
                Distribution::LogNormal { median: 2.0, dispersion: 0.4, from: 0.0, to: inf },
                2.0 * 0.08f64.exp(),
                2.0 * 0.08f64.exp() * (0.16f64.exp() - 1.0).sqrt(),
            ),
        ];
        for (d, mean, deviation) in cases {
            let (m, s) = moments(d);
            assert!((m - mean).abs() < 2e-4 * mean.max(1.0), "{d:?}: mean {m}, not {mean}");
            assert!((s - deviation).abs() < 2e-3 * deviation, "{d:?}: {s}, not {deviation}");
        }
    }

    #[test]
    fn cut_distributions_stay_between_their_ends() {
        let d = Distribution::LogNormal { median: 1.0, dispersion: 0.3, from: 5.0, to: 6.0 };
        for u in [1e-16, 0.5, 1.0 - 1e-16] {
            let x = d.quantile(u);
            assert!((5.0 - 1e-12..=6.0 + 1e-12).contains(&x), "{x}");
        }
    }
}
