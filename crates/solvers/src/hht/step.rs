//! What is kept for a step size: the factor, and the compliance of the links.
//!
//! Modal damping is a low-rank term of A = A₀ + s U R Uᵀ (Woodbury):
//!
//! ```text
//! A⁻¹ r = A₀⁻¹ r − X N⁻¹ Xᵀ r        X = A₀⁻¹ U        N = R⁻¹/s + Uᵀ X
//! ```

use super::newmark::newmark;
use crate::basis::LowRank;
use crate::error::SolveError;
use crate::kernel::{Compliance, StepKey};
use crate::structure::ReducedSystem;
use std::sync::Arc;
use trilith_linalg::{Dense, DenseLu, StagedLdlt, StagedPlan};

/// A step size.
pub(super) struct Step {
    pub factor: StagedLdlt,
    pub woodbury: Option<Woodbury>,
    pub compliance: Compliance,
    pub dt: f64,
    /// When it was used last.
    pub used: usize,
}

impl Step {
    pub(super) fn new(
        s: &ReducedSystem,
        plan: &Arc<StagedPlan>,
        alpha: f64,
        dt: f64,
        panel: &mut [f64],
    ) -> Result<Self, SolveError> {
        let (gamma, beta) = newmark(alpha);
        let w = 1.0 + alpha;
        let factor = StagedLdlt::new(plan, &s.sum(w * gamma * dt, w * beta * dt * dt))?;
        let modal = s.modal.as_ref();
        let woodbury = modal.map(|modal| Woodbury::new(&factor, modal, w * gamma * dt));
        let mut g = tail_compliance(s, &factor, panel);
        if let Some(woodbury) = &woodbury {
            woodbury.soften(s, &mut g);
        }
        let mut h = g.clone();
        g.values_mut().iter_mut().for_each(|x| *x *= w * beta * dt * dt);
        h.values_mut().iter_mut().for_each(|x| *x *= w * gamma * dt);
        let compliance = Compliance::full(g, h, StepKey::exact(dt));
        Ok(Self { factor, woodbury, compliance, dt, used: 0 })
    }

    /// Number of values it holds.
    pub(super) fn stored(&self) -> usize {
        let x = self.woodbury.as_ref().map_or(0, |w| w.x.values().len());
        self.factor.stored() + x + self.compliance.stored()
    }
}

/// What modal damping needs.
pub(super) struct Woodbury {
    pub x: Dense,
    /// The rows of X at the tail, in its order.
    pub tail: Dense,
    /// N.
    pub inner: DenseLu,
}

/// B A₀⁻¹ Bᵀ from the end of the factor: Zᵀ D⁻¹ Z with Z = T⁻¹ Bᵀ.
fn tail_compliance(s: &ReducedSystem, factor: &StagedLdlt, panel: &mut [f64]) -> Dense {
    let tail = &factor.plan().equations()[factor.plan().split()..];
    let mut place = vec![usize::MAX; s.order()];
    tail.iter().enumerate().for_each(|(p, i)| place[*i as usize] = p);
    let mut z = Dense::zeros(tail.len(), s.links.len());
    for j in 0..s.links.len() {
        for (i, c) in s.links.row(j).filter(|(_, c)| *c != 0.0) {
            z[(place[i], j)] += c;
        }
        factor.tail_forward(z.column_mut(j), panel);
    }
    let mut scaled = z.clone();
    for j in 0..scaled.columns() {
        scaled.column_mut(j).iter_mut().zip(factor.tail_pivots()).for_each(|(x, d)| *x /= d);
    }
    let mut g = z.transpose_times(&scaled);
    for j in 0..g.columns() {
        for i in 0..j {
            g[(i, j)] = g[(j, i)];
        }
    }
    g
}

impl Woodbury {
    fn new(factor: &StagedLdlt, modal: &LowRank, s: f64) -> Self {
        let mut x = modal.u.clone();
        factor.solve(x.values_mut());
        let mut inner = modal.u.transpose_times(&x);
        for (k, rate) in modal.rate.iter().enumerate() {
            inner[(k, k)] += 1.0 / (s * rate);
        }
        let places = &factor.plan().equations()[factor.plan().split()..];
        let mut tail = Dense::zeros(places.len(), x.columns());
        for k in 0..x.columns() {
            for (to, i) in tail.column_mut(k).iter_mut().zip(places) {
                *to = x.column(k)[*i as usize];
            }
        }
        Self { x, tail, inner: DenseLu::new(&inner) }
    }

    /// g −= B X inner⁻¹ (B X)ᵀ.
    fn soften(&self, s: &ReducedSystem, g: &mut Dense) {
        let mut image = Dense::zeros(s.links.len(), self.x.columns());
        for k in 0..self.x.columns() {
            s.links.deform(self.x.column(k), image.column_mut(k));
        }
        let image = image.transpose();
        let mut solved = image.clone();
        self.inner.solve_columns(&mut solved);
        let less = image.transpose_times(&solved);
        g.values_mut().iter_mut().zip(less.values()).for_each(|(x, y)| *x -= y);
    }
}
