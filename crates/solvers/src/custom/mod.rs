//! Rules for time of other crates, as propagators.
//!
//! An [`Integrator`] gives the end of a step for forces that are known; links want to know how the end answers to theirs.
//! A step is linear, so that is told by steps from rest under a unit of each pseudo-force at the end:
//!
//! ```text
//! G = B u(Bᵀ)      H = B v(Bᵀ)      u, v: the end of a step from rest with these forces at its end
//! ```
//!
//! May use `step` for the contracts, `kernel` and `structure`; `basis` for the low-rank form of modal damping.

mod linear;
mod structure;

use crate::error::SolveError;
use crate::kernel::{Compliance, StepKey, Wanted};
use crate::step::{Forces, Propagator, StepWork, TrapezoidalWork};
use crate::structure::{
    Followers, Motion, Products, ReducedSystem, acceleration, mass_acceleration,
};
use linear::fault;
use std::collections::BTreeMap;
use structure::Structure;
use trilith_element::{LinearStep, Motion as Moves, MotionMut};
use trilith_linalg::Dense;
use trilith_model::{CustomSolver, Model};
use trilith_system::System;

/// Steps of different lengths that are kept.
const KEPT: usize = 16;

/// The step of one length.
struct Kept {
    step: Box<dyn LinearStep>,
    compliance: Compliance,
    /// When it was used last.
    used: usize,
}

/// A rule of another crate on the coordinates of a motion.
pub(crate) struct CustomRule<'a> {
    solver: &'a CustomSolver,
    structure: Structure<'a>,
    products: Products,
    steps: BTreeMap<u64, Kept>,
    now: u64,
    clock: usize,
    followers: Followers,
    /// Forces at both ends, and the accelerations at the start as numbers.
    force: [Vec<f64>; 2],
    start: Vec<f64>,
    work: TrapezoidalWork,
}

impl<'a> CustomRule<'a> {
    pub(crate) fn new(
        solver: &'a CustomSolver,
        (model, system): (&'a Model, &'a System),
        space: ReducedSystem,
    ) -> Self {
        let n = space.order();
        Self {
            solver,
            products: Products::new(&space),
            work: TrapezoidalWork::new(&space),
            structure: Structure::new(model, system, space),
            steps: BTreeMap::new(),
            now: 0,
            clock: 0,
            followers: Followers::default(),
            force: [(); 2].map(|()| vec![0.0; n]),
            start: vec![0.0; n],
        }
    }

    fn refused(&self, reason: String) -> SolveError {
        SolveError::Integrator { kind: self.solver.card.kind, reason }
    }

    /// Makes the step of a length; the first one is tried before it is trusted.
    fn make(&mut self, key: &StepKey) -> Result<Kept, SolveError> {
        let made = self.solver.integrator.step(&self.structure, key.dt);
        let mut step = made.map_err(|reason| self.refused(reason))?;
        if self.steps.is_empty()
            && let Some(reason) = fault(step.as_mut(), &self.structure, key.dt)
        {
            return Err(self.refused(reason));
        }
        let compliance = self.compliance_of(step.as_mut(), key)?;
        Ok(Kept { step, compliance, used: self.clock })
    }

    /// By steps from rest.
    fn compliance_of(
        &self,
        step: &mut dyn LinearStep,
        key: &StepKey,
    ) -> Result<Compliance, SolveError> {
        let links = &self.structure.space.links;
        let (n, m) = (self.structure.space.order(), links.len());
        let rest = vec![0.0; n];
        let still = Moves { u: &rest, v: &rest, a: &rest };
        let (mut unit, mut force, mut end) = (vec![0.0; m], vec![0.0; n], vec![0.0; 3 * n]);
        let [mut g, mut h] = [(); 2].map(|()| Dense::zeros(m, m));
        for a in 0..m {
            unit[a] = 1.0;
            links.spread_into(&unit, &mut force);
            unit[a] = 0.0;
            step.advance(&self.structure, still, [&rest, &force], parts(&mut end));
            links.deform(&end[..n], g.column_mut(a));
            links.deform(&end[n..2 * n], h.column_mut(a));
        }
        for (name, matrix) in [("displacement", &mut g), ("velocity", &mut h)] {
            if let Some(share) = made_symmetric(matrix) {
                return Err(self.refused(format!(
                    "the {name} that a force at one link gives another is not that of the reverse ({:.0} % apart): its step is not that of a symmetric structure",
                    100.0 * share
                )));
            }
        }
        Ok(Compliance::full(g, h, key.clone()))
    }

    /// The end of the step prepared last, under pseudo-forces at its end.
    fn advance(&mut self, from: &Motion, forces: &Forces<'_>, to: &mut Motion) {
        let Self { structure, steps, now, force, start, .. } = self;
        let n = structure.space.order();
        let both = forces.loads.into_iter().zip([forces.pseudo0, forces.pseudo1]);
        for (force, (load, pseudo)) in force.iter_mut().zip(both) {
            force.copy_from_slice(load);
            structure.space.links.spread(-1.0, pseudo, force);
        }
        start.iter_mut().zip(&from[2 * n..]).for_each(|(x, a)| *x = acceleration(*a));
        let from = Moves { u: &from[..n], v: &from[n..2 * n], a: start };
        let [first, last] = force;
        if let Some(kept) = steps.get_mut(now) {
            kept.step.advance(structure, from, [first, last], parts(to));
        }
    }
}

/// A motion in its three parts.
fn parts(motion: &mut [f64]) -> MotionMut<'_> {
    let n = motion.len() / 3;
    let (u, rest) = motion.split_at_mut(n);
    let (v, a) = rest.split_at_mut(n);
    MotionMut { u, v, a }
}

/// Share by which entries across the diagonal may differ.
const SYMMETRIC: f64 = 1e-6;

/// Makes the matrix symmetric; the share by which it is not, where that is no rounding.
fn made_symmetric(matrix: &mut Dense) -> Option<f64> {
    let n = matrix.rows();
    let mut most: f64 = 0.0;
    for j in 0..n {
        for i in 0..j {
            let (x, y) = (matrix[(i, j)], matrix[(j, i)]);
            let size = (matrix[(i, i)].abs() * matrix[(j, j)].abs()).sqrt().max(x.abs());
            if (x - y).abs() > SYMMETRIC * size {
                most = most.max((x - y).abs() / size);
            }
            matrix[(i, j)] = 0.5 * (x + y);
            matrix[(j, i)] = matrix[(i, j)];
        }
    }
    (most > 0.0).then_some(most)
}

impl Propagator for CustomRule<'_> {
    fn space(&self) -> &ReducedSystem {
        &self.structure.space
    }

    fn factorizations(&self) -> usize {
        self.structure.factorizations()
    }

    fn prepare(&mut self, key: &StepKey) -> Result<(), SolveError> {
        self.now = key.dt.to_bits();
        self.clock += 1;
        if let Some(kept) = self.steps.get_mut(&self.now) {
            kept.used = self.clock;
            return Ok(());
        }
        let made = self.make(key)?;
        let oldest = self.steps.iter().min_by_key(|(_, kept)| kept.used).map(|(key, _)| *key);
        if let Some(oldest) = oldest.filter(|_| self.steps.len() >= KEPT) {
            self.steps.remove(&oldest);
        }
        self.steps.insert(self.now, made);
        Ok(())
    }

    fn compliance(&self) -> &Compliance {
        &self.steps[&self.now].compliance
    }

    fn set_rates(&mut self, _rated: &[usize], damped: &[usize]) -> Result<(), SolveError> {
        self.followers = Followers::new(&self.structure.space, damped)?;
        Ok(())
    }

    fn acceleration(&mut self, force: &[f64]) -> Result<Vec<f64>, SolveError> {
        mass_acceleration(&self.structure.space, force.to_vec())
    }

    fn predict(&mut self, from: &Motion, forces: &Forces<'_>, to: &mut Motion, wanted: Wanted<'_>) {
        self.advance(from, forces, to);
        let (n, links) = (self.structure.space.order(), &self.structure.space.links);
        links.deform(&to[..n], wanted.d);
        links.deform_some(&to[n..2 * n], wanted.rate_dependent, wanted.v);
    }

    fn correct(&mut self, from: &Motion, forces: &Forces<'_>, to: &mut Motion) {
        self.advance(from, forces, to);
        let dt = f64::from_bits(self.now);
        self.followers.complete(from, to, dt);
    }

    fn work(&mut self, from: &Motion, to: &Motion, forces: &Forces<'_>) -> StepWork {
        let dt = f64::from_bits(self.now);
        self.work.of(&self.products, &self.structure.space, [from, to], forces, dt)
    }
}
