//! HHT-α on any space: one factorisation per step size, links by their compliance.
//!
//! ```text
//! M aₙ₊₁ = (1+α) sₙ₊₁ − α sₙ            s = p − C v − K u − Bᵀ f̃
//! uₙ₊₁ = uₙ + Δt vₙ + Δt² [(½−β) aₙ + β aₙ₊₁]      vₙ₊₁ = vₙ + Δt [(1−γ) aₙ + γ aₙ₊₁]
//! A = M + (1+α)(γΔt C + βΔt² K)        G = (1+α) βΔt² B A⁻¹ Bᵀ        H = γ/(βΔt) G
//! ```
//!
//! with γ = ½ − α, β = (1−α)²/4, α ∈ [−⅓, 0]; α = 0 is Newmark's average acceleration. Modal damping
//! enters A as a low-rank term (Woodbury). Second order, unconditionally stable for linear structures.
//!
//! Reference: \[Hilber, Hughes, Taylor 1977\].

use crate::error::SolveError;
use crate::propagator::{Compliance, Forces, Motion, Propagator, StepWork, kinetic_and_strain};
use crate::space::Space;
use std::collections::BTreeMap;
use trilith_linalg::{Dense, DenseLu, Ldlt, Sparse};

/// γ and β of an α.
pub(crate) fn newmark(alpha: f64) -> (f64, f64) {
    (0.5 - alpha, 0.25 * (1.0 - alpha) * (1.0 - alpha))
}

/// Values (8 bytes each) in the factors and images of step sizes that are kept.
const KEPT_VALUES: usize = 1 << 26;

struct Step {
    factor: Ldlt,
    woodbury: Option<Woodbury>,
    /// A⁻¹ Bᵀ.
    image: Dense,
    compliance: Compliance,
    dt: f64,
    used: usize,
}

impl Step {
    fn stored(&self) -> usize {
        self.factor.stored() + self.image.values().len()
    }
}

/// (A₀ + s U R Uᵀ)⁻¹ = A₀⁻¹ − X (R⁻¹/s + Uᵀ X)⁻¹ Xᵀ with X = A₀⁻¹ U.
struct Woodbury {
    x: Dense,
    inner: DenseLu,
}

/// Direct integration.
pub(crate) struct Hht {
    space: Space,
    alpha: f64,
    steps: BTreeMap<u64, Step>,
    now: u64,
    clock: usize,
    factorizations: usize,
}

impl Hht {
    pub(crate) fn new(space: Space, alpha: f64) -> Self {
        Self { space, alpha, steps: BTreeMap::new(), now: 0, clock: 0, factorizations: 0 }
    }

    fn build(&mut self, dt: f64) -> Result<Step, SolveError> {
        let (gamma, beta) = newmark(self.alpha);
        let w = 1.0 + self.alpha;
        let s = &self.space;
        let a = Sparse::combine(&[
            (1.0, &s.mass),
            (w * gamma * dt, &s.damping),
            (w * beta * dt * dt, &s.stiffness),
        ]);
        let mut factor = Ldlt::new(&a)?;
        self.factorizations += 1;
        let woodbury = s.modal.as_ref().map(|modal| {
            let mut x = modal.u.clone();
            factor.solve(x.values_mut());
            let mut inner = modal.u.transpose_times(&x);
            for (k, rate) in modal.rate.iter().enumerate() {
                inner[(k, k)] += 1.0 / (w * gamma * dt * rate);
            }
            Woodbury { x, inner: DenseLu::new(&inner) }
        });
        let mut image = Dense::zeros(s.order(), s.links.len());
        for j in 0..s.links.len() {
            for (i, c) in s.links.row(j) {
                image[(i, j)] += c;
            }
        }
        factor.solve(image.values_mut());
        if let (Some(woodbury), Some(modal)) = (&woodbury, &s.modal) {
            for j in 0..image.columns() {
                woodbury.correct(modal_image(&modal.u, image.column(j)), image.column_mut(j));
            }
        }
        let links = s.links.len();
        let (mut g, mut h) = (Dense::zeros(links, links), Dense::zeros(links, links));
        let mut d = vec![0.0; links];
        for j in 0..links {
            s.links.deform(image.column(j), &mut d);
            for i in 0..links {
                g[(i, j)] = w * beta * dt * dt * d[i];
                h[(i, j)] = w * gamma * dt * d[i];
            }
        }
        let compliance = Compliance { g, h, key: dt.to_bits() };
        Ok(Step { factor, woodbury, image, compliance, dt, used: 0 })
    }

    /// Forgets the step sizes used longest ago until there is room for a new one.
    fn make_room(&mut self, wanted: usize) {
        let mut stored: usize = self.steps.values().map(Step::stored).sum();
        while stored + wanted > KEPT_VALUES
            && let Some((key, size)) =
                self.steps.iter().min_by_key(|(_, s)| s.used).map(|(k, s)| (*k, s.stored()))
        {
            self.steps.remove(&key);
            stored -= size;
        }
    }

    /// x ← A⁻¹ x with the step prepared last.
    fn solve(&mut self, x: &mut [f64]) {
        let Some(step) = self.steps.get_mut(&self.now) else { return };
        step.factor.solve(x);
        if let (Some(woodbury), Some(modal)) = (&step.woodbury, &self.space.modal) {
            woodbury.correct(modal_image(&modal.u, x), x);
        }
    }

    /// p − C v − K u of a motion.
    fn imbalance(&self, load: &[f64], u: &[f64], v: &[f64]) -> Vec<f64> {
        let mut s = load.to_vec();
        self.space.damp(-1.0, v, &mut s);
        self.space.stiffness.mul_add(-1.0, u, &mut s);
        s
    }
}

fn modal_image(u: &Dense, x: &[f64]) -> Vec<f64> {
    let mut y = vec![0.0; u.columns()];
    u.transpose_mul_add(1.0, x, &mut y);
    y
}

impl Woodbury {
    /// x −= X inner⁻¹ y, with y = Uᵀ x.
    fn correct(&self, mut y: Vec<f64>, x: &mut [f64]) {
        self.inner.solve(&mut y);
        self.x.mul_add(-1.0, &y, x);
    }
}

impl Propagator for Hht {
    fn space(&self) -> &Space {
        &self.space
    }

    fn factorizations(&self) -> usize {
        self.factorizations
    }

    fn prepare(&mut self, dt: f64) -> Result<(), SolveError> {
        self.now = dt.to_bits();
        self.clock += 1;
        if !self.steps.contains_key(&self.now) {
            let step = self.build(dt)?;
            self.make_room(step.stored());
            self.steps.insert(self.now, step);
        }
        if let Some(step) = self.steps.get_mut(&self.now) {
            step.used = self.clock;
        }
        Ok(())
    }

    fn compliance(&self) -> &Compliance {
        &self.steps[&self.now].compliance
    }

    fn acceleration(&mut self, force: &[f64]) -> Result<Vec<f64>, SolveError> {
        crate::full_newton::mass_acceleration(&self.space, force.to_vec())
    }

    fn predict(
        &mut self,
        from: &Motion,
        forces: &Forces<'_>,
        to: &mut Motion,
        d: &mut [f64],
        v: &mut [f64],
    ) {
        let n = self.space.order();
        let dt = self.steps[&self.now].dt;
        let (gamma, beta) = newmark(self.alpha);
        let w = 1.0 + self.alpha;
        let (u, rest) = from.split_at(n);
        let (v0, a) = rest.split_at(n);
        for i in 0..n {
            to[i] = u[i] + dt * v0[i] + dt * dt * (0.5 - beta) * a[i];
            to[n + i] = v0[i] + dt * (1.0 - gamma) * a[i];
        }
        let mut right = self.imbalance(forces.load1, &to[..n], &to[n..2 * n]);
        if self.alpha != 0.0 {
            let mut before = self.imbalance(forces.load0, u, v0);
            self.space.links.spread(-1.0, forces.pseudo0, &mut before);
            for (x, y) in right.iter_mut().zip(before) {
                *x = w * *x - self.alpha * y;
            }
        }
        self.solve(&mut right);
        for i in 0..n {
            to[i] += beta * dt * dt * right[i];
            to[n + i] += gamma * dt * right[i];
            to[2 * n + i] = right[i];
        }
        self.space.links.deform(&to[..n], d);
        self.space.links.deform(&to[n..2 * n], v);
        let Compliance { g, h, .. } = &self.steps[&self.now].compliance;
        g.mul_add(-1.0, forces.pseudo1, d);
        h.mul_add(-1.0, forces.pseudo1, v);
    }

    fn correct(&mut self, forces: &Forces<'_>, to: &mut Motion) {
        let n = self.space.order();
        let step = &self.steps[&self.now];
        let (gamma, beta) = newmark(self.alpha);
        let mut a = vec![0.0; n];
        step.image.mul_add(-(1.0 + self.alpha), forces.pseudo1, &mut a);
        for i in 0..n {
            to[i] += beta * step.dt * step.dt * a[i];
            to[n + i] += gamma * step.dt * a[i];
            to[2 * n + i] += a[i];
        }
    }

    fn work(&mut self, from: &Motion, to: &Motion, forces: &Forces<'_>) -> StepWork {
        average_work(&self.space, self.steps[&self.now].dt, from, to, forces)
    }
}

/// Work by the trapezoidal rule, with which average acceleration balances exactly; what another α
/// leaves is the work of the time rule.
pub(crate) fn average_work(
    space: &Space,
    dt: f64,
    from: &Motion,
    to: &Motion,
    forces: &Forces<'_>,
) -> StepWork {
    let n = space.order();
    let moved: Vec<f64> = (0..n).map(|i| to[i] - from[i]).collect();
    let external: f64 = (0..n).map(|i| 0.5 * (forces.load0[i] + forces.load1[i]) * moved[i]).sum();
    let mut d = vec![0.0; space.links.len()];
    space.links.deform(&moved, &mut d);
    let links: f64 =
        (0..d.len()).map(|i| 0.5 * (forces.pseudo0[i] + forces.pseudo1[i]) * d[i]).sum();
    let v: Vec<f64> = (n..2 * n).map(|i| 0.5 * (from[i] + to[i])).collect();
    let mut cv = vec![0.0; n];
    space.damp(dt, &v, &mut cv);
    let damping: f64 = v.iter().zip(&cv).map(|(a, b)| a * b).sum();
    let (k0, e0) = kinetic_and_strain(space, from);
    let (k1, e1) = kinetic_and_strain(space, to);
    let algorithmic = external - links - damping - (k1 - k0) - (e1 - e0);
    StepWork { external, links, damping, algorithmic }
}
