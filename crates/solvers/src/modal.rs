//! FNA: modal equations solved exactly for loads that are linear in the step.
//!
//! ```text
//! q̈ + D q̇ + Ω² q = s(t),      s(t) = Φᵀ p(t) − (B Φ)ᵀ f̃(t) linear in the step
//! (∫q, q, q̇)ₙ₊₁ = exp(A Δt) (0, q, q̇, s, ṡ)ₙ
//! ```
//!
//! Modes without coupling by damping have a recurrence of their own; otherwise (dashpots of the
//! structure, modal damping beside dummies) one exponential of the whole space is taken. Both are exact,
//! also for ω = 0 and beyond critical damping. Static shapes follow the loads (see `rules`).
//!
//! **Stiff links.** With link forces linear in the step the exact rule is the linear-acceleration method
//! on a link: stable only for ω_link Δt < 2√3. Steps that are too long for it at the stiffest link are
//! made by average acceleration instead, which has the same form, the same order and no such limit. A
//! contact at rest or in steady sliding then needs no short steps; where something happens, the error
//! control shortens them until the exact rule is back.
//!
//! The work of a linear load is exact too: ∫ s q̇ dt = s₁q₁ − s₀q₀ − ṡ ∫q dt; under average acceleration,
//! with ∫q = Δt (q₀ + q₁)/2, it is the work by which that rule balances.
//!
//! Reference: \[Wilson 2002, ch. 18\].

mod rules;

use crate::error::SolveError;
use crate::link_map::LinkMap;
use crate::propagator::{Compliance, Forces, Motion, Propagator, StepWork};
use crate::space::Space;
use rules::{Rule, Structure};
use trilith_linalg::Dense;

/// Steps with a larger G·k of the stiffest link are made by average acceleration; the limit of the exact
/// rule is 2 (ω²Δt²/6), and well before it the rule is no better any more.
const LONGEST: f64 = 0.5;

struct Step {
    rule: Rule,
    compliance: Compliance,
    /// Largest eigenvalue of G k of the engaged links under the exact rule.
    ratio: f64,
    dt: f64,
}

/// The exact propagator on a basis of modes.
pub(crate) struct Modal {
    space: Space,
    structure: Structure,
    /// Stiffness of the engaged links.
    engaged: Vec<f64>,
    steps: Vec<Step>,
    now: usize,
    /// Loads less link forces at the start and at the end of the step, and the integral of q.
    source0: Vec<f64>,
    source1: Vec<f64>,
    integral: Vec<f64>,
    /// Pseudo-forces spread last, and (B Φ)ᵀ of them.
    spread: (Vec<f64>, Vec<f64>),
}

impl Modal {
    /// `engaged` is the stiffness of the active link coordinates where they are engaged, N/m or N·m.
    pub(crate) fn new(space: Space, engaged: Vec<f64>) -> Self {
        let m = space.order();
        let mut damping = Dense::zeros(m, m);
        let mut coupled = false;
        for (i, j, v) in space.damping.entries() {
            damping[(i, j)] += v;
            coupled |= i != j && v != 0.0;
        }
        let rates = (0..m).map(|i| damping[(i, i)]).collect();
        let structure = Structure {
            modes: m - space.images.columns(),
            omega2: space.stiffness.diagonal(),
            rates,
            damping: coupled.then_some(damping),
        };
        let zero = vec![0.0; m];
        Self {
            spread: (vec![0.0; space.links.len()], zero.clone()),
            space,
            structure,
            engaged,
            steps: Vec::new(),
            now: 0,
            source0: zero.clone(),
            source1: zero.clone(),
            integral: zero,
        }
    }

    fn build(&self, dt: f64) -> Step {
        let mut rule = Rule::exact(&self.structure, dt);
        let modes = self.structure.modes;
        let ratio = ratio(&self.compliance_of(&rule, 1, modes), &self.engaged);
        if ratio > LONGEST {
            rule = Rule::average(&self.structure, dt);
        }
        let all = self.space.order();
        let (g, h) = (self.compliance_of(&rule, 1, all), self.compliance_of(&rule, 2, all));
        Step { rule, compliance: Compliance { g, h, key: dt.to_bits() }, ratio, dt }
    }

    /// B Φ (coefficient of s₁ in the given row) Φᵀ Bᵀ of the first coordinates.
    fn compliance_of(&self, rule: &Rule, row: usize, coordinates: usize) -> Dense {
        let l = self.space.links.len();
        let mut b = Dense::zeros(self.space.order(), l);
        for a in 0..l {
            for (j, c) in self.space.links.row(a).filter(|(j, _)| *j < coordinates) {
                b[(j, a)] = c;
            }
        }
        let mut scaled = Dense::zeros(b.rows(), l);
        for a in 0..l {
            rule.answer(row, b.column(a), scaled.column_mut(a));
        }
        b.transpose_times(&scaled)
    }

    fn step(&self) -> &Step {
        &self.steps[self.now]
    }

    /// Makes (B Φ)ᵀ f̃ of these pseudo-forces the last one.
    fn spread(&mut self, pseudo: &[f64]) {
        let (last, spread) = &mut self.spread;
        if last != pseudo {
            last.copy_from_slice(pseudo);
            spread.fill(0.0);
            self.space.links.spread(1.0, pseudo, spread);
        }
    }
}

/// Loads less link forces.
fn less(load: &[f64], links: &[f64], source: &mut [f64]) {
    for (s, (p, f)) in source.iter_mut().zip(load.iter().zip(links)) {
        *s = p - f;
    }
}

/// Largest eigenvalue of G diag(k).
fn ratio(g: &Dense, k: &[f64]) -> f64 {
    const ITERATIONS: usize = 50;
    let mut x = vec![1.0; k.len()];
    let mut ratio = 0.0;
    for _ in 0..ITERATIONS {
        let f: Vec<f64> = x.iter().zip(k).map(|(a, b)| a * b).collect();
        let mut y = vec![0.0; k.len()];
        g.mul_add(1.0, &f, &mut y);
        let size = y.iter().fold(0.0f64, |a, b| a.max(b.abs()));
        if size == 0.0 {
            return 0.0;
        }
        ratio = size;
        x = y.into_iter().map(|v| v / size).collect();
    }
    ratio
}

impl Propagator for Modal {
    fn space(&self) -> &Space {
        &self.space
    }

    fn factorizations(&self) -> usize {
        0
    }

    fn prepare(&mut self, dt: f64) -> Result<(), SolveError> {
        if self.steps.get(self.now).is_some_and(|s| s.dt == dt) {
            return Ok(());
        }
        self.now = self.steps.iter().position(|s| s.dt == dt).unwrap_or_else(|| {
            let step = self.build(dt);
            self.steps.push(step);
            self.steps.len() - 1
        });
        Ok(())
    }

    fn compliance(&self) -> &Compliance {
        &self.step().compliance
    }

    fn stiffness_ratio(&self) -> Option<f64> {
        Some(self.step().ratio).filter(|r| *r > LONGEST)
    }

    fn acceleration(&mut self, force: &[f64]) -> Result<Vec<f64>, SolveError> {
        let mut a = force.to_vec();
        a[self.structure.modes..].fill(0.0);
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
        let m = self.source0.len();
        self.spread(forces.pseudo0);
        less(forces.load0, &self.spread.1, &mut self.source0);
        self.spread(forces.pseudo1);
        less(forces.load1, &self.spread.1, &mut self.source1);
        let inputs = [&from[..m], &from[m..2 * m], &self.source0, &self.source1];
        let rule = &self.steps[self.now].rule;
        let (q, rest) = to.split_at_mut(m);
        rule.apply(1, inputs, q);
        rule.apply(2, inputs, &mut rest[..m]);
        match &self.space.links {
            LinkMap::Full(b) => {
                d.fill(0.0);
                v.fill(0.0);
                b.transpose_mul_add_pair(1.0, [q, &rest[..m]], [d, v]);
            }
            links @ LinkMap::Sparse(_) => {
                links.deform(q, d);
                links.deform(&rest[..m], v);
            }
        }
    }

    fn correct(&mut self, forces: &Forces<'_>, to: &mut Motion) {
        self.spread(forces.pseudo1);
        let m = self.source0.len();
        let rule = &self.steps[self.now].rule;
        let (q, rest) = to.split_at_mut(m);
        let (v, a) = rest.split_at_mut(m);
        let change = &mut self.integral;
        for (i, x) in change.iter_mut().enumerate() {
            let source = forces.load1[i] - self.spread.1[i];
            *x = source - self.source1[i];
            self.source1[i] = source;
        }
        rule.add_answer(1, change, q);
        rule.add_answer(2, change, v);
        self.structure.acceleration(&self.source1, q, v, a);
    }

    fn work(&mut self, from: &Motion, to: &Motion, forces: &Forces<'_>) -> StepWork {
        let m = self.source0.len();
        let step = &self.steps[self.now];
        let inputs = [&from[..m], &from[m..2 * m], &self.source0, &self.source1];
        step.rule.apply(0, inputs, &mut self.integral);
        let (mut external, mut all) = (0.0, 0.0);
        let scale = step.dt.recip();
        for i in 0..m {
            let (q0, q1, mean) = (from[i], to[i], self.integral[i] * scale);
            let (p0, p1) = (forces.load0[i], forces.load1[i]);
            let (s0, s1) = (self.source0[i], self.source1[i]);
            external += p1 * (q1 - mean) - p0 * (q0 - mean);
            all += s1 * (q1 - mean) - s0 * (q0 - mean);
        }
        let links = external - all;
        let damping = if self.structure.is_damped() {
            let ((k0, e0), (k1, e1)) = (self.energy(from), self.energy(to));
            all - (k1 - k0) - (e1 - e0)
        } else {
            0.0
        };
        StepWork { external, links, damping, algorithmic: 0.0 }
    }

    fn energy(&self, x: &[f64]) -> (f64, f64) {
        self.structure.energy(x)
    }
}
