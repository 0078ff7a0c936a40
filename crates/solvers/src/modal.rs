//! FNA: modal equations solved exactly for loads that are linear in the step.
//!
//! ```text
//! q̈ + D q̇ + Ω² q = s(t),      s(t) = Φᵀ p(t) − (B Φ)ᵀ f̃(t) linear in the step
//! (∫q, q, q̇)ₙ₊₁ = exp(A Δt) (0, q, q̇, s, ṡ)ₙ
//! ```
//!
//! Modes without coupling by damping have a recurrence of their own; otherwise (dashpots of the
//! structure, modal damping beside dummies) one exponential of the whole space is taken. Both are exact,
//! also for ω = 0 and beyond critical damping.
//!
//! The work of a linear load is exact too: ∫ s q̇ dt = s₁q₁ − s₀q₀ − ṡ ∫q dt.
//!
//! Reference: \[Wilson 2002, ch. 18\].

use crate::error::SolveError;
use crate::propagator::{Compliance, Forces, Motion, Propagator, StepWork, kinetic_and_strain};
use crate::space::Space;
use std::collections::BTreeMap;
use trilith_linalg::{Dense, expm};

/// Coefficients of one step size: rows ∫q, q, q̇; columns q₀, q̇₀, s₀, s₁.
enum Rule {
    Diagonal(Vec<[[f64; 4]; 3]>),
    Coupled(Box<[[Dense; 4]; 3]>),
}

struct Step {
    rule: Rule,
    compliance: Compliance,
    dt: f64,
}

/// The exact propagator on a basis of modes.
pub(crate) struct Modal {
    space: Space,
    damping: Dense,
    coupled: bool,
    steps: BTreeMap<u64, Step>,
    now: u64,
}

impl Modal {
    pub(crate) fn new(space: Space) -> Self {
        let m = space.order();
        let mut damping = Dense::zeros(m, m);
        let mut coupled = false;
        for (i, j, v) in space.damping.entries() {
            damping[(i, j)] += v;
            coupled |= i != j && v != 0.0;
        }
        Self { space, damping, coupled, steps: BTreeMap::new(), now: 0 }
    }

    fn omega2(&self) -> Vec<f64> {
        self.space.stiffness.diagonal()
    }

    fn build(&self, dt: f64) -> Step {
        let rule = if self.coupled {
            Rule::Coupled(Box::new(coupled_rule(&self.omega2(), &self.damping, dt)))
        } else {
            let omega2 = self.omega2();
            Rule::Diagonal(
                (0..omega2.len())
                    .map(|i| {
                        let one = Dense::from_columns(1, 1, vec![self.damping[(i, i)]]);
                        coupled_rule(&[omega2[i]], &one, dt)
                            .map(|row| row.map(|block| block[(0, 0)]))
                    })
                    .collect(),
            )
        };
        let (g, h) = (self.compliance_of(&rule, 1), self.compliance_of(&rule, 2));
        Step { rule, compliance: Compliance { g, h, key: dt.to_bits() }, dt }
    }

    /// B Φ (coefficient of s₁ in the given row) Φᵀ Bᵀ.
    fn compliance_of(&self, rule: &Rule, row: usize) -> Dense {
        let (l, m) = (self.space.rows.len(), self.space.order());
        let mut b = Dense::zeros(m, l);
        for (a, terms) in self.space.rows.iter().enumerate() {
            for (j, c) in terms {
                b[(*j, a)] = *c;
            }
        }
        let scaled = match rule {
            Rule::Diagonal(c) => {
                let mut s = b.clone();
                for a in 0..l {
                    for (x, c) in s.column_mut(a).iter_mut().zip(c) {
                        *x *= c[row][3];
                    }
                }
                s
            }
            Rule::Coupled(c) => c[row][3].times(&b),
        };
        b.transpose_times(&scaled)
    }

    fn step(&self) -> &Step {
        &self.steps[&self.now]
    }

    /// Σ over the four inputs of one row of coefficients.
    fn apply(&self, row: usize, inputs: [&[f64]; 4]) -> Vec<f64> {
        let m = self.space.order();
        match &self.step().rule {
            Rule::Diagonal(c) => (0..m)
                .map(|i| {
                    let c = &c[i][row];
                    c[0] * inputs[0][i]
                        + c[1] * inputs[1][i]
                        + c[2] * inputs[2][i]
                        + c[3] * inputs[3][i]
                })
                .collect(),
            Rule::Coupled(c) => {
                let mut y = vec![0.0; m];
                for (block, x) in c[row].iter().zip(inputs) {
                    block.mul_add(1.0, x, &mut y);
                }
                y
            }
        }
    }

    fn source(&self, load: &[f64], pseudo: &[f64]) -> Vec<f64> {
        let mut s = load.to_vec();
        self.space.spread(-1.0, pseudo, &mut s);
        s
    }

    fn finish(&self, source: &[f64], to: &mut Motion) {
        let m = self.space.order();
        let omega2 = self.omega2();
        let mut a = source.to_vec();
        self.damping.mul_add(-1.0, &to[m..2 * m], &mut a);
        for i in 0..m {
            a[i] -= omega2[i] * to[i];
        }
        to[2 * m..].copy_from_slice(&a);
    }
}

/// exp of the augmented system, as blocks: rows ∫q, q, q̇; columns q₀, q̇₀, s₀, s₁.
fn coupled_rule(omega2: &[f64], damping: &Dense, dt: f64) -> [[Dense; 4]; 3] {
    let m = omega2.len();
    // States: ∫q, q, q̇, s, ṡ·dt.
    let mut a = Dense::zeros(5 * m, 5 * m);
    for i in 0..m {
        a[(i, m + i)] = dt;
        a[(m + i, 2 * m + i)] = dt;
        a[(2 * m + i, m + i)] = -omega2[i] * dt;
        a[(2 * m + i, 3 * m + i)] = dt;
        a[(3 * m + i, 4 * m + i)] = 1.0;
        for j in 0..m {
            a[(2 * m + i, 2 * m + j)] = -damping[(i, j)] * dt;
        }
    }
    let e = expm(&a);
    let block = |row: usize, column: usize| {
        let mut b = Dense::zeros(m, m);
        for j in 0..m {
            for i in 0..m {
                b[(i, j)] = e[(row * m + i, column * m + j)];
            }
        }
        b
    };
    [0, 1, 2].map(|row| {
        let end = block(row, 4);
        let mut start = block(row, 3);
        for (x, y) in start.values_mut().iter_mut().zip(end.values()) {
            *x -= y;
        }
        [block(row, 1), block(row, 2), start, end]
    })
}

impl Propagator for Modal {
    fn space(&self) -> &Space {
        &self.space
    }

    fn factorizations(&self) -> usize {
        0
    }

    fn prepare(&mut self, dt: f64) -> Result<(), SolveError> {
        self.now = dt.to_bits();
        if !self.steps.contains_key(&self.now) {
            let step = self.build(dt);
            self.steps.insert(self.now, step);
        }
        Ok(())
    }

    fn compliance(&self) -> &Compliance {
        &self.step().compliance
    }

    fn conditionally_stable(&self) -> bool {
        true
    }

    fn acceleration(&mut self, force: &[f64]) -> Result<Vec<f64>, SolveError> {
        Ok(force.to_vec())
    }

    fn predict(&mut self, from: &Motion, forces: &Forces<'_>, to: &mut Motion) {
        let m = self.space.order();
        let s0 = self.source(forces.load0, forces.pseudo0);
        let (q, v) = (&from[..m], &from[m..2 * m]);
        for row in [1, 2] {
            let y = self.apply(row, [q, v, &s0, forces.load1]);
            to[(row - 1) * m..row * m].copy_from_slice(&y);
        }
    }

    fn correct(&mut self, forces: &Forces<'_>, to: &mut Motion) {
        let m = self.space.order();
        let mut s = vec![0.0; m];
        self.space.spread(-1.0, forces.pseudo1, &mut s);
        let zero = vec![0.0; m];
        for row in [1, 2] {
            let y = self.apply(row, [&zero, &zero, &zero, &s]);
            for (x, y) in to[(row - 1) * m..row * m].iter_mut().zip(y) {
                *x += y;
            }
        }
        let source = self.source(forces.load1, forces.pseudo1);
        self.finish(&source, to);
    }

    fn work(&self, from: &Motion, to: &Motion, forces: &Forces<'_>) -> StepWork {
        let m = self.space.order();
        let s0 = self.source(forces.load0, forces.pseudo0);
        let s1 = self.source(forces.load1, forces.pseudo1);
        let integral = self.apply(0, [&from[..m], &from[m..2 * m], &s0, &s1]);
        let dt = self.step().dt;
        let of = |p0: &[f64], p1: &[f64]| -> f64 {
            (0..m)
                .map(|i| p1[i] * to[i] - p0[i] * from[i] - (p1[i] - p0[i]) / dt * integral[i])
                .sum()
        };
        let external = of(forces.load0, forces.load1);
        let links = external - of(&s0, &s1);
        let (k0, e0) = kinetic_and_strain(&self.space, from);
        let (k1, e1) = kinetic_and_strain(&self.space, to);
        let damped = self.damping.values().iter().any(|x| *x != 0.0);
        let damping = if damped { external - links - (k1 - k0) - (e1 - e0) } else { 0.0 };
        StepWork { external, links, damping, algorithmic: 0.0 }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// u = p/k (1 − cos ωt) under a constant load; (p/k)(t/t₁ − sin ωt / ωt₁) under a ramp.
    #[test]
    fn constant_and_linear_loads_are_exact() {
        let (w, dt) = (3.0, 0.7);
        let c = coupled_rule(&[w * w], &Dense::zeros(1, 1), dt);
        let x = w * dt;
        let both = c[1][2][(0, 0)] + c[1][3][(0, 0)];
        assert!((both - (1.0 - x.cos()) / (w * w)).abs() < 1e-15);
        assert!((c[1][3][(0, 0)] - (1.0 - x.sin() / x) / (w * w)).abs() < 1e-15);
        assert!((c[1][0][(0, 0)] - x.cos()).abs() < 1e-14);
    }

    #[test]
    fn a_free_mass_moves_as_under_constant_and_rising_force() {
        let c = coupled_rule(&[0.0], &Dense::zeros(1, 1), 2.0);
        assert!((c[1][2][(0, 0)] - 4.0 / 3.0).abs() < 1e-14);
        assert!((c[1][3][(0, 0)] - 4.0 / 6.0).abs() < 1e-14);
        assert!((c[2][3][(0, 0)] - 1.0).abs() < 1e-14);
    }
}
