//! The branches, and their fit to a springpot.

use std::f64::consts::{PI, TAU};

/// Relaxation times for each factor of ten.
const PER_DECADE: f64 = 2.0;

/// Factor by which the times go beyond both ends of the band.
const MARGIN: f64 = 3.0;

/// Maxwell branch.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Branch {
    /// Stiffness, N/m.
    pub(super) k: f64,
    /// Relaxation time, s.
    pub(super) tau: f64,
}

/// A spring and the branches beside it.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Branches {
    /// Stiffness of the spring, N/m.
    pub(super) k_inf: f64,
    /// From the slowest to the fastest.
    pub(super) branches: Vec<Branch>,
}

impl Branches {
    /// Branches with storage stiffness `k` at √(low high) and loss factor `loss` from `low` to `high`, Hz.
    pub(super) fn fitted(k: f64, loss: f64, low: f64, high: f64) -> Self {
        let beta = 2.0 / PI * loss.atan();
        let middle = TAU * (low * high).sqrt();
        let (slow, fast) = (MARGIN / (TAU * low), 1.0 / (MARGIN * TAU * high));
        let count = (PER_DECADE * (slow / fast).log10()).ceil();
        let step = (slow / fast).ln() / count;
        // (iω)^β = sin(πβ)/π ∫ (iωτ/(1 + iωτ)) τ^(−β) d ln τ, by the trapezoidal rule.
        let weight = k * (PI * beta).sin() / (PI * (0.5 * PI * beta).cos()) * step;
        let mut branches: Vec<Branch> = (0..=count as usize)
            .map(|i| {
                let tau = slow * (-step * i as f64).exp();
                Branch { k: weight * (middle * tau).powf(-beta), tau }
            })
            .collect();
        // What lies beyond is one more branch at each end: Σ k τ and Σ k τ² of the faster ones, Σ k/τ and
        // Σ k/τ² of the slower ones, which are springs for the rest. All are geometric sums.
        let beyond = |n: f64| {
            let ratio = (-n * step).exp();
            ratio / (1.0 - ratio)
        };
        let (first, last) = (branches[0], branches[count as usize]);
        let [s0, s1, s2] = [beta, beta + 1.0, beta + 2.0].map(beyond);
        let slowest = Branch { k: first.k * s1 * s1 / s2, tau: first.tau * s1 / s2 };
        let [f1, f2] = [1.0 - beta, 2.0 - beta].map(beyond);
        let fastest = Branch { k: last.k * f1 * f1 / f2, tau: last.tau * f2 / f1 };
        let k_inf = first.k * s0 - slowest.k;
        branches.insert(0, slowest);
        branches.push(fastest);
        Self { k_inf, branches }
    }

    /// K' and K'' at ω, rad/s.
    pub(super) fn moduli(&self, w: f64) -> [f64; 2] {
        let mut sum = [self.k_inf, 0.0];
        for b in &self.branches {
            let x = w * b.tau;
            sum[0] += b.k * x * x / (1.0 + x * x);
            sum[1] += b.k * x / (1.0 + x * x);
        }
        sum
    }
}
