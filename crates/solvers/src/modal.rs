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
//! Static shapes (places without mass) follow the loads, c q̇ + q = s: exactly where the structure damps
//! them, at the mean rate of the step where it does not.
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
    /// The static shapes; same rows and columns.
    statics: Vec<[[f64; 4]; 3]>,
    compliance: Compliance,
    /// G of the modes alone: what limits the step.
    limited: Dense,
    dt: f64,
}

/// The exact propagator on a basis of modes.
pub(crate) struct Modal {
    space: Space,
    /// Number of modes; the static shapes come after them.
    modes: usize,
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
        let modes = m - space.images.columns();
        Self { space, modes, damping, coupled, steps: BTreeMap::new(), now: 0 }
    }

    fn omega2(&self) -> Vec<f64> {
        self.space.stiffness.diagonal()
    }

    fn build(&self, dt: f64) -> Step {
        let omega2 = &self.omega2()[..self.modes];
        let rule = if self.coupled {
            let mut damping = Dense::zeros(self.modes, self.modes);
            for i in 0..self.modes {
                for j in 0..self.modes {
                    damping[(i, j)] = self.damping[(i, j)];
                }
            }
            Rule::Coupled(Box::new(coupled_rule(omega2, &damping, dt)))
        } else {
            Rule::Diagonal(
                (0..self.modes)
                    .map(|i| {
                        let one = Dense::from_columns(1, 1, vec![self.damping[(i, i)]]);
                        coupled_rule(&[omega2[i]], &one, dt)
                            .map(|row| row.map(|block| block[(0, 0)]))
                    })
                    .collect(),
            )
        };
        let statics: Vec<_> = (self.modes..self.space.order())
            .map(|i| static_rule(self.damping[(i, i)], dt))
            .collect();
        let limited = self.compliance_of(&rule, &[], 1);
        let (g, h) =
            (self.compliance_of(&rule, &statics, 1), self.compliance_of(&rule, &statics, 2));
        Step { rule, statics, compliance: Compliance { g, h, key: dt.to_bits() }, limited, dt }
    }

    /// B Φ (coefficient of s₁ in the given row) Φᵀ Bᵀ.
    fn compliance_of(&self, rule: &Rule, statics: &[[[f64; 4]; 3]], row: usize) -> Dense {
        let l = self.space.rows.len();
        let mut b = Dense::zeros(self.modes, l);
        let mut rest = Dense::zeros(statics.len(), l);
        for (a, terms) in self.space.rows.iter().enumerate() {
            for (j, c) in terms {
                match j.checked_sub(self.modes) {
                    None => b[(*j, a)] = *c,
                    Some(r) if r < statics.len() => rest[(r, a)] = *c,
                    Some(_) => {}
                }
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
        let mut sum = b.transpose_times(&scaled);
        if !statics.is_empty() {
            let mut scaled = rest.clone();
            for a in 0..l {
                for (x, c) in scaled.column_mut(a).iter_mut().zip(statics) {
                    *x *= c[row][3];
                }
            }
            let more = rest.transpose_times(&scaled);
            sum.values_mut().iter_mut().zip(more.values()).for_each(|(x, y)| *x += y);
        }
        sum
    }

    fn step(&self) -> &Step {
        &self.steps[&self.now]
    }

    /// Σ over the four inputs of one row of coefficients.
    fn apply(&self, row: usize, inputs: [&[f64]; 4]) -> Vec<f64> {
        let one = |c: &[[f64; 4]; 3], i: usize| {
            let c = &c[row];
            c[0] * inputs[0][i] + c[1] * inputs[1][i] + c[2] * inputs[2][i] + c[3] * inputs[3][i]
        };
        let step = self.step();
        let mut y: Vec<f64> = match &step.rule {
            Rule::Diagonal(c) => c.iter().enumerate().map(|(i, c)| one(c, i)).collect(),
            Rule::Coupled(c) => {
                let mut y = vec![0.0; self.modes];
                for (block, x) in c[row].iter().zip(inputs) {
                    block.mul_add(1.0, &x[..self.modes], &mut y);
                }
                y
            }
        };
        y.extend(step.statics.iter().enumerate().map(|(r, c)| one(c, self.modes + r)));
        y
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
        for i in 0..self.modes {
            a[i] -= omega2[i] * to[i];
        }
        a[self.modes..].fill(0.0);
        to[2 * m..].copy_from_slice(&a);
    }
}

/// c q̇ + q = s with s linear in the step: rows ∫q, q, q̇; columns q₀, q̇₀, s₀, s₁. Without damping q = s,
/// at the mean rate of the step, whatever q was before: a load may have jumped.
fn static_rule(c: f64, dt: f64) -> [[f64; 4]; 3] {
    let x = dt / c;
    if !x.is_finite() || x > 1e9 {
        return [
            [0.5 * dt, 0.0, 0.0, 0.5 * dt],
            [0.0, 0.0, 0.0, 1.0],
            [-dt.recip(), 0.0, 0.0, dt.recip()],
        ];
    }
    let decay = (-x).exp();
    let mean = -(-x).exp_m1() / x;
    let q = [decay, 0.0, mean - decay, 1.0 - mean];
    let v = [-decay / c, 0.0, -(mean - decay) / c, mean / c];
    // ∫q = ∫s − c (q₁ − q₀)
    let integral = [c * (1.0 - decay), 0.0, 0.5 * dt - c * q[2], 0.5 * dt - c * q[3]];
    [integral, q, v]
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

    fn limited(&self) -> Option<&Dense> {
        Some(&self.step().limited)
    }

    fn acceleration(&mut self, force: &[f64]) -> Result<Vec<f64>, SolveError> {
        let mut a = force.to_vec();
        a[self.modes..].fill(0.0);
        Ok(a)
    }

    fn predict(
        &mut self,
        from: &Motion,
        forces: &Forces<'_>,
        to: &mut Motion,
        d: &mut [f64],
        v: &mut [f64],
    ) {
        let m = self.space.order();
        let s0 = self.source(forces.load0, forces.pseudo0);
        let (q, rate) = (&from[..m], &from[m..2 * m]);
        for row in [1, 2] {
            let y = self.apply(row, [q, rate, &s0, forces.load1]);
            to[(row - 1) * m..row * m].copy_from_slice(&y);
        }
        self.space.deform(&to[..m], d);
        self.space.deform(&to[m..2 * m], v);
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

    /// c q̇ + q = s: q = 1 − e^(−t/c) under a constant load, t − c (1 − e^(−t/c)) under a rising one.
    #[test]
    fn a_damped_static_shape_follows_constant_and_rising_loads() {
        let (c, dt) = (0.3, 0.7);
        let [integral, q, v] = static_rule(c, dt);
        let decay = f64::exp(-dt / c);
        assert!((q[2] + q[3] - (1.0 - decay)).abs() < 1e-15);
        assert!((q[3] * dt - (dt - c * (1.0 - decay))).abs() < 1e-15);
        assert!((v[2] + v[3] - decay / c).abs() < 1e-14);
        assert!((integral[2] + integral[3] - (dt - c * (1.0 - decay))).abs() < 1e-15);
        // Little damping and none are the same for a load that did not jump.
        let (little, none) = (static_rule(1e-8 * dt, dt), static_rule(0.0, dt));
        for (a, b) in little.iter().zip(&none) {
            let at = |r: &[f64; 4]| [r[0] + r[2], r[3]];
            for (x, y) in at(a).iter().zip(at(b)) {
                assert!((x - y).abs() < 1e-6, "{little:?} {none:?}");
            }
        }
    }

    #[test]
    fn a_free_mass_moves_as_under_constant_and_rising_force() {
        let c = coupled_rule(&[0.0], &Dense::zeros(1, 1), 2.0);
        assert!((c[1][2][(0, 0)] - 4.0 / 3.0).abs() < 1e-14);
        assert!((c[1][3][(0, 0)] - 4.0 / 6.0).abs() < 1e-14);
        assert!((c[2][3][(0, 0)] - 1.0).abs() < 1e-14);
    }
}
