//! HHT-α on all DOFs or on a basis, and the textbook integrator by full Newton iteration.
//!
//! One factorisation per step size, one solve a step, links by their compliance; or the tangent in every iteration.
//! May use `step` for the contracts, `kernel` and `structure`; `basis` for the low-rank form of modal damping.
//!
//! ```text
//! M aₙ₊₁ = (1+α) sₙ₊₁ − α sₙ            s = p − C v − K u − Bᵀ f̃
//! uₙ₊₁ = uₙ + Δt vₙ + Δt² [(½−β) aₙ + β aₙ₊₁]      vₙ₊₁ = vₙ + Δt [(1−γ) aₙ + γ aₙ₊₁]
//! A = M + (1+α)(γΔt C + βΔt² K)        G = (1+α) βΔt² B A⁻¹ Bᵀ        H = γ/(βΔt) G
//! ```
//!
//! with γ = ½ − α, β = (1−α)²/4, α ∈ [−⅓, 0]; α = 0 is Newmark's average acceleration. Second order,
//! unconditionally stable for linear structures.
//!
//! The coordinates that links touch are eliminated last, so half of the solve gives their motion and G
//! needs nothing but the end of the factor. The link forces change the right-hand side at its end only;
//! the other half of the solve then completes the motion.
//!
//! Reference: \[Hilber, Hughes, Taylor 1977\].

mod full_newton;
mod newmark;
mod step;
#[cfg(test)]
mod tests;

use crate::error::SolveError;
use crate::kernel::{Compliance, StepKey, Wanted};
use crate::step::{Forces, Propagator, StepWork, TrapezoidalWork};
use crate::structure::{
    Followers, Motion, Products, ReducedSystem, acceleration, mass_acceleration,
};
pub(crate) use full_newton::FullNewton;
use newmark::newmark;
use std::collections::BTreeMap;
use std::sync::Arc;
use step::Step;
use trilith_linalg::StagedPlan;

/// Values (8 bytes each) in the factors of step sizes that are kept.
const KEPT_VALUES: usize = 1 << 25;

/// Vectors that a step needs. The tail is what links touch, in the order of elimination.
#[derive(Default)]
struct Work {
    /// In the order of the coordinates.
    u: Vec<f64>,
    v: Vec<f64>,
    right: Vec<f64>,
    /// In the order of elimination.
    solution: Vec<f64>,
    panel: Vec<f64>,
    /// At the tail: predicted displacement and velocity without the new acceleration, acceleration.
    tail_u: Vec<f64>,
    tail_v: Vec<f64>,
    tail_a: Vec<f64>,
    /// Of the links: pseudo-forces that the prediction holds, and deformations.
    guess: Vec<f64>,
    moved: Vec<f64>,
    /// Of modal damping.
    share: Vec<f64>,
    rank: Vec<f64>,
}

/// Direct integration.
pub(crate) struct Hht {
    space: ReducedSystem,
    products: Products,
    alpha: f64,
    /// The same for all step sizes.
    plan: Option<Arc<StagedPlan>>,
    steps: BTreeMap<u64, Step>,
    now: u64,
    clock: usize,
    factorizations: usize,
    followers: Followers,
    work: Work,
    trapezoidal: TrapezoidalWork,
}

impl Hht {
    pub(crate) fn new(space: ReducedSystem, alpha: f64) -> Self {
        let (products, trapezoidal) = (Products::new(&space), TrapezoidalWork::new(&space));
        Self {
            followers: Followers::default(),
            space,
            products,
            alpha,
            plan: None,
            steps: BTreeMap::new(),
            now: 0,
            clock: 0,
            factorizations: 0,
            work: Work::default(),
            trapezoidal,
        }
    }

    fn plan(&mut self) -> Result<Arc<StagedPlan>, SolveError> {
        if let Some(plan) = &self.plan {
            return Ok(Arc::clone(plan));
        }
        let s = &self.space;
        let mut touched: Vec<usize> = (0..s.links.len())
            .flat_map(|j| s.links.row(j).filter(|(_, c)| *c != 0.0).map(|(i, _)| i))
            .collect();
        touched.sort_unstable();
        touched.dedup();
        let plan = StagedPlan::new(&[&s.mass, &s.damping, &s.stiffness], &touched)?;
        let (n, rank) = (s.order(), s.modal.as_ref().map_or(0, |m| m.rate.len()));
        let of = |n: usize| vec![0.0; n];
        self.work = Work {
            u: of(n),
            v: of(n),
            right: of(n),
            solution: of(n),
            panel: of(plan.workspace()),
            tail_u: of(touched.len()),
            tail_v: of(touched.len()),
            tail_a: of(touched.len()),
            guess: of(s.links.len()),
            moved: of(s.links.len()),
            share: of(rank),
            rank: of(rank),
        };
        self.plan = Some(Arc::clone(&plan));
        Ok(plan)
    }

    fn build(&mut self, dt: f64) -> Result<Step, SolveError> {
        let plan = self.plan()?;
        self.factorizations += 1;
        Step::new(&self.space, &plan, self.alpha, dt, &mut self.work.panel)
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
}

impl Propagator for Hht {
    fn space(&self) -> &ReducedSystem {
        &self.space
    }

    fn factorizations(&self) -> usize {
        self.factorizations
    }

    fn prepare(&mut self, key: &StepKey) -> Result<(), SolveError> {
        let dt = key.dt;
        self.now = dt.to_bits();
        self.clock += 1;
        if !self.steps.contains_key(&self.now) {
            let plan = self.plan()?;
            self.make_room(plan.stored());
            let step = self.build(dt)?;
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

    fn set_rates(&mut self, _rated: &[usize], damped: &[usize]) -> Result<(), SolveError> {
        self.followers = Followers::new(&self.space, damped)?;
        Ok(())
    }

    fn acceleration(&mut self, force: &[f64]) -> Result<Vec<f64>, SolveError> {
        mass_acceleration(&self.space, force.to_vec())
    }

    fn predict(&mut self, from: &Motion, forces: &Forces<'_>, to: &mut Motion, wanted: Wanted<'_>) {
        let n = self.space.order();
        let step = &self.steps[&self.now];
        let work = &mut self.work;
        let (dt, alpha) = (step.dt, self.alpha);
        let (gamma, beta) = newmark(alpha);
        let w = 1.0 + alpha;
        let (u0, rest) = from.split_at(n);
        let (v0, a0) = rest.split_at(n);
        let (to_u, rest) = to.split_at_mut(n);
        let (to_v, _) = rest.split_at_mut(n);
        let (half, whole) = (dt * dt * (0.5 - beta), dt * (1.0 - gamma));
        // The weighted sum of both ends goes through K and C at once.
        for i in 0..n {
            let a0 = acceleration(a0[i]);
            to_u[i] = u0[i] + dt * v0[i] + half * a0;
            to_v[i] = v0[i] + whole * a0;
        }
        if alpha == 0.0 {
            work.right.copy_from_slice(forces.loads[1]);
            self.products.resist(
                &self.space,
                to_u,
                to_v,
                &mut work.rank,
                &mut work.u,
                &mut work.right,
            );
        } else {
            work.right.fill(0.0);
            self.space.links.spread(alpha, forces.pseudo0, &mut work.right);
            let [load0, load1] = forces.loads;
            for i in 0..n {
                work.right[i] += w * load1[i] - alpha * load0[i];
                work.v[i] = w * to_v[i] - alpha * v0[i];
                work.solution[i] = w * to_u[i] - alpha * u0[i];
            }
            self.products.resist(
                &self.space,
                &work.solution,
                &work.v,
                &mut work.rank,
                &mut work.u,
                &mut work.right,
            );
        }
        work.guess.copy_from_slice(forces.pseudo1);
        self.space.links.spread(-w, forces.pseudo1, &mut work.right);
        let plan = step.factor.plan();
        for (x, i) in work.solution.iter_mut().zip(plan.equations()) {
            *x = work.right[*i as usize];
        }
        step.factor.forward(&mut work.solution, &mut work.panel);
        work.tail_a.copy_from_slice(&work.solution[plan.split()..]);
        step.factor.tail_backward(&mut work.tail_a, &mut work.panel);
        if let Some(woodbury) = &step.woodbury {
            work.share.fill(0.0);
            woodbury.x.transpose_mul_add(1.0, &work.right, &mut work.share);
            woodbury.inner.solve(&mut work.share);
            woodbury.tail.mul_add(-1.0, &work.share, &mut work.tail_a);
        }
        for (p, i) in plan.equations()[plan.split()..].iter().enumerate() {
            let i = *i as usize;
            work.tail_u[p] = to_u[i];
            work.tail_v[p] = to_v[i];
            to_u[i] += beta * dt * dt * work.tail_a[p];
            to_v[i] += gamma * dt * work.tail_a[p];
        }
        self.space.links.deform(to_u, wanted.d);
        self.space.links.deform_some(to_v, wanted.rate_dependent, wanted.v);
    }

    fn correct(&mut self, from: &Motion, forces: &Forces<'_>, to: &mut Motion) {
        let n = self.space.order();
        let step = &self.steps[&self.now];
        let work = &mut self.work;
        let plan = step.factor.plan();
        let tail = &plan.equations()[plan.split()..];
        for i in tail {
            work.right[*i as usize] = 0.0;
        }
        work.moved.clear();
        work.moved.extend(forces.pseudo1.iter().zip(&work.guess).map(|(f, g)| f - g));
        self.space.links.spread(-(1.0 + self.alpha), &work.moved, &mut work.right);
        for (x, i) in work.tail_a.iter_mut().zip(tail) {
            *x = work.right[*i as usize];
        }
        if let Some(woodbury) = &step.woodbury {
            work.rank.fill(0.0);
            woodbury.tail.transpose_mul_add(1.0, &work.tail_a, &mut work.rank);
            woodbury.inner.solve(&mut work.rank);
            work.share.iter_mut().zip(&work.rank).for_each(|(x, y)| *x += y);
        }
        step.factor.tail_forward(&mut work.tail_a, &mut work.panel);
        let end = &mut work.solution[plan.split()..];
        end.iter_mut().zip(&work.tail_a).for_each(|(x, y)| *x += y);
        step.factor.tail_backward(end, &mut work.panel);
        step.factor.finish(&mut work.solution, &mut work.panel);
        let (to_u, rest) = to.split_at_mut(n);
        let (to_v, to_a) = rest.split_at_mut(n);
        for ((i, u), v) in tail.iter().zip(&work.tail_u).zip(&work.tail_v) {
            to_u[*i as usize] = *u;
            to_v[*i as usize] = *v;
        }
        for (i, x) in plan.equations().iter().zip(&work.solution) {
            to_a[*i as usize] = *x;
        }
        if let Some(woodbury) = &step.woodbury {
            woodbury.x.mul_add(-1.0, &work.share, to_a);
        }
        let (gamma, beta) = newmark(self.alpha);
        let (by_u, by_v) = (beta * step.dt * step.dt, gamma * step.dt);
        for ((u, v), a) in to_u.iter_mut().zip(to_v).zip(to_a) {
            *u += by_u * *a;
            *v += by_v * *a;
        }
        self.followers.complete(from, to, step.dt);
    }

    fn work(&mut self, from: &Motion, to: &Motion, forces: &Forces<'_>) -> StepWork {
        let dt = self.steps[&self.now].dt;
        self.trapezoidal.of(&self.products, &self.space, [from, to], forces, dt)
    }
}
