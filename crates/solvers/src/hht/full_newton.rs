//! The textbook integrator: HHT-α with the tangent of structure and links assembled and factorised in
//! every iteration. The honest baseline for "FNA against direct integration"; same equations as
//! [`hht`](crate::hht), same energies, other way to the solution.

use super::newmark::newmark;
use crate::error::SolveError;
use crate::kernel::{Remembered, Search};
use crate::step::{
    Difference, DisplacementNorms, Forces, LinksBefore, State, StepEnergy, StepFailure, StepWork,
    Stepper, Turning, difference_of, displacement_norms, energy_rounding, kinetic_and_strain,
};
use crate::structure::{
    Followers, Motion, ReducedSystem, accelerate_at_once, acceleration, mass_acceleration,
};
use crate::vector::largest;
use trilith_element::{Energy, Kinematics};
use trilith_linalg::{SparseLu, Triplets};
use trilith_model::Model;
use trilith_system::{Laws, LinkSet, LoadSet, StepLoads, System, Tangents};

const ITERATIONS: usize = 60;
const TOLERANCE: f64 = 1e-9;
/// Solutions for modal damping at most; a ratio of 5 % takes seven.
const REFINEMENTS: usize = 30;

/// Full Newton on all free DOFs.
pub(crate) struct FullNewton<'a> {
    pub model: &'a Model,
    pub system: &'a System,
    pub loads: &'a LoadSet,
    pub space: ReducedSystem,
    pub alpha: f64,
    pub followers: Followers,
    pub iterations: usize,
    pub factorizations: usize,
}

impl FullNewton<'_> {
    /// p − C v − K u − Bᵀ f.
    fn imbalance(&self, load: &[f64], u: &[f64], v: &[f64], f: &[f64]) -> Vec<f64> {
        let mut s = load.to_vec();
        self.space.damp(-1.0, v, &mut s);
        self.space.stiffness.mul_add(-1.0, u, &mut s);
        self.system.links.spread(-1.0, f, &mut s);
        s
    }

    /// Deformation and rate of all link coordinates.
    fn deform(&self, u: &[f64], v: &[f64], amplitudes: &[f64], d: &mut [f64], rate: &mut [f64]) {
        let none = vec![0.0; self.system.reduction.prescribed.len()];
        self.system.links.deform(u, &none, d);
        self.system.links.deform(v, &none, rate);
        self.loads.support_deformation(amplitudes, d, rate);
    }

    /// M + (1+α)(γΔt C + βΔt² K + Bᵀ(βΔt² k + γΔt c)B) without modal damping, which would fill it.
    fn tangent(&self, tangents: &Tangents, dt: f64) -> trilith_linalg::Sparse {
        let (gamma, beta) = newmark(self.alpha);
        let w = 1.0 + self.alpha;
        let (wc, wk) = (w * gamma * dt, w * beta * dt * dt);
        let n = self.space.order();
        let mut j = Triplets::new(n, n);
        for (factor, part) in self.space.sum(wc, wk) {
            for (a, b, x) in part.entries() {
                j.add(a, b, factor * x);
            }
        }
        let links = &self.system.links;
        for link in &links.links {
            let size = link.range.len();
            for i in 0..size {
                for k in 0..size {
                    let at = link.block.start + i * size + k;
                    let x = wk * tangents.k[at] + wc * tangents.c[at];
                    if x == 0.0 {
                        continue;
                    }
                    for (row, a) in &links.rows[link.range.start + i] {
                        for (column, b) in &links.rows[link.range.start + k] {
                            j.add(*row, *column, a * x * b);
                        }
                    }
                }
            }
        }
        j.build()
    }

    /// What closes a residual r by the tangent J and modal damping D together, Δ ← J⁻¹(r − D Δ): each time what is missing
    /// falls to less than the largest damping ratio of it. A tangent without D would leave that share in every iteration,
    /// and Newton's method beside the nanometre in which a contact takes hold.
    fn correction(&self, tangent: &SparseLu, residual: &[f64], dt: f64) -> Vec<f64> {
        let solve = |mut x: Vec<f64>| {
            tangent.solve(&mut x);
            x
        };
        let mut change = solve(residual.to_vec());
        let Some(modal) = &self.space.modal else {
            return change;
        };
        let (gamma, _) = newmark(self.alpha);
        let mut missed = f64::INFINITY;
        for _ in 0..REFINEMENTS {
            let mut left = residual.to_vec();
            modal.mul_add(-(1.0 + self.alpha) * gamma * dt, &change, &mut left);
            let better = solve(left);
            let distance =
                change.iter().zip(&better).fold(0.0, |d: f64, (a, b)| d.max((a - b).abs()));
            // Ratios above one lead nowhere: the tangent alone has to do.
            if distance >= missed {
                break;
            }
            (missed, change) = (distance, better);
            if missed <= TOLERANCE * largest(&change) {
                break;
            }
        }
        change
    }

    /// Hᵢᵢ of all link coordinates as if each of their DOFs moved by itself.
    fn softness(&self, dt: f64) -> Vec<f64> {
        let (gamma, beta) = newmark(self.alpha);
        let (m, k) = (self.space.mass.diagonal(), self.space.stiffness.diagonal());
        let of_dof = |(j, b): &(usize, f64)| b * b / (m[*j] + beta * dt * dt * k[*j]);
        let soft = |row: &Vec<(usize, f64)>| gamma * dt * row.iter().map(of_dof).sum::<f64>();
        // A DOF without mass or stiffness follows at once.
        self.system
            .links
            .rows
            .iter()
            .map(soft)
            .map(|h| if h.is_finite() { h } else { 0.0 })
            .collect()
    }

    fn worst(&self, residual: &[f64]) -> StepFailure {
        // The residual lives on DOFs; the coordinate of a link that pushes there is named.
        let at = (0..residual.len())
            .max_by(|a, b| residual[*a].abs().total_cmp(&residual[*b].abs()))
            .unwrap_or(0);
        let worst = (0..self.system.links.len())
            .find(|i| self.system.links.rows[*i].iter().any(|(j, _)| *j == at))
            .unwrap_or(usize::MAX);
        StepFailure::NoEquilibrium {
            worst,
            residual: residual.get(at).map_or(f64::NAN, |r| r.abs()),
        }
    }
}

impl Stepper for FullNewton<'_> {
    fn step(
        &mut self,
        from: &State,
        to: &mut State,
        loads: &StepLoads,
        dt: f64,
        energy: &mut StepEnergy,
    ) -> Result<(), StepFailure> {
        let n = self.space.order();
        let (gamma, beta) = newmark(self.alpha);
        let w = 1.0 + self.alpha;
        let (load0, load1) = (self.space.force(&loads.start), self.space.force(&loads.end));
        let (u0, rest) = from.motion.split_at(n);
        let (v0, a0) = rest.split_at(n);
        let before = self.imbalance(&load0, u0, v0, &from.f);
        to.clone_from(from);
        to.history.fill(f64::NAN);
        let a0: Vec<f64> = a0.iter().map(|a| acceleration(*a)).collect();
        let mut a = a0.clone();
        let mut tangents = self.system.links.tangents();
        energy.links.resize(self.system.links.links.len(), Energy::default());
        let laws = self.system.links.laws(self.model);
        let mut residual = vec![f64::NAN; n];
        let mut search = Search::default();
        for iteration in 0..ITERATIONS {
            self.iterations += 1;
            for i in 0..n {
                to.motion[i] = u0[i] + dt * v0[i] + dt * dt * ((0.5 - beta) * a0[i] + beta * a[i]);
                to.motion[n + i] = v0[i] + dt * ((1.0 - gamma) * a0[i] + gamma * a[i]);
                to.motion[2 * n + i] = a[i];
            }
            let (u, v) = (to.motion[..n].to_vec(), to.motion[n..2 * n].to_vec());
            self.deform(&u, &v, &loads.end, &mut to.d, &mut to.v);
            laws.respond(
                Kinematics::new([&to.d, &to.v], [&from.d, &from.v], dt),
                &from.history,
                &mut to.history,
                &mut to.f,
                &mut tangents,
                &mut energy.links,
            );
            let now = self.imbalance(&load1, &u, &v, &to.f);
            let inertia = self.space.mass.mul(&a);
            residual = (0..n).map(|i| w * now[i] - self.alpha * before[i] - inertia[i]).collect();
            let force = largest(&to.f).max(from.scale[0]).max(from.scale[1]);
            let size = largest(&inertia).max(largest(&load1)).max(force);
            if largest(&residual) <= TOLERANCE * size {
                to.tangents = tangents;
                self.end(from, to, loads, (&load0, &load1), dt, energy);
                return Ok(());
            }
            // A force like |v|^α with α < ½ throws Newton's method past zero in the shortest of steps.
            let moves = |step: &[f64], way: &mut Vec<f64>| step.clone_into(way);
            if let Some(more) = search.goes_on(iteration, &residual, largest(&residual), moves) {
                for (x, step) in a.iter_mut().zip(&search.step) {
                    *x += more * step;
                }
                continue;
            }
            self.factorizations += 1;
            let lu = SparseLu::new(&self.tangent(&tangents, dt)).map_err(SolveError::from)?;
            let change = self.correction(&lu, &residual, dt);
            if change.iter().any(|x| !x.is_finite()) {
                break;
            }
            // A contact that takes hold within a nanometre answers the last digit of a gap with more than the tolerance.
            if beta * dt * dt * largest(&change) <= f64::EPSILON * largest(&u) {
                to.tangents = tangents;
                self.end(from, to, loads, (&load0, &load1), dt, energy);
                return Ok(());
            }
            search.before(&residual);
            search.goes(&change);
            for (x, y) in a.iter_mut().zip(change) {
                *x += y;
            }
        }
        // Who looks for the culprit looks at all of its answer.
        to.tangents = tangents;
        Err(self.worst(&residual))
    }

    fn start(
        &mut self,
        u: &[f64],
        v: &[f64],
        before: &LinksBefore,
        amplitudes: &[f64],
    ) -> Result<State, SolveError> {
        let links = &self.system.links;
        let (mut d, mut rate) = (vec![0.0; links.len()], vec![0.0; links.len()]);
        self.deform(u, v, amplitudes, &mut d, &mut rate);
        let mut state = State::of_links(self.model, links, before, d, rate);
        let load = self.space.force(amplitudes);
        let force = self.imbalance(&load, u, v, &state.f);
        let a = mass_acceleration(&self.space, force)?;
        state.motion = [u, v, &a].concat();
        Ok(state)
    }

    fn jump(&mut self, state: &mut State, change: &[f64]) -> Result<(), SolveError> {
        let a = mass_acceleration(&self.space, self.space.force(change))?;
        let n = a.len();
        accelerate_at_once(&mut state.motion[2 * n..], &a);
        Ok(())
    }

    fn difference(&mut self, a: &State, b: &State) -> Difference {
        let of_structure = |x: &[f64]| kinetic_and_strain(&self.space, x);
        difference_of(&self.space, &self.system.links, of_structure, a, b, &mut Vec::new())
    }

    fn displacement_norms(&mut self, a: &State, b: Option<&State>) -> DisplacementNorms {
        displacement_norms(&self.space, &self.system.links, a, b, &mut Vec::new())
    }

    fn missed(&mut self, from: &State, to: &State, dt: f64, _: f64) -> f64 {
        let links = &self.system.links;
        let laws = links.laws(self.model);
        Turning::default().missed(&laws, links, from, to, &to.v, &self.softness(dt), dt)
    }

    fn rounding(&self, state: &State) -> f64 {
        energy_rounding(&self.space, &self.system.links.active, state)
    }

    fn space(&self) -> &ReducedSystem {
        &self.space
    }

    fn links(&self) -> &LinkSet {
        &self.system.links
    }

    fn laws(&self) -> Laws<'_> {
        self.system.links.laws(self.model)
    }

    fn work(&self) -> (usize, usize) {
        (self.iterations, self.factorizations)
    }

    fn memory(&self) -> Vec<Remembered> {
        Vec::new()
    }

    fn recall(&mut self, _: Vec<Remembered>, _: f64, _: &mut State) -> Result<(), SolveError> {
        Ok(())
    }
}

impl FullNewton<'_> {
    /// A step in equilibrium.
    fn end(
        &self,
        from: &State,
        to: &mut State,
        loads: &StepLoads,
        force: (&[f64], &[f64]),
        dt: f64,
        energy: &mut StepEnergy,
    ) {
        self.followers.complete(&from.motion, &mut to.motion, dt);
        to.record_converged(&self.system.links, &energy.links, largest(&to.f));
        self.book(from, to, loads, force, dt, energy);
    }

    fn book(
        &self,
        from: &State,
        to: &State,
        loads: &StepLoads,
        force: (&[f64], &[f64]),
        dt: f64,
        energy: &mut StepEnergy,
    ) {
        let active = &self.system.links.active;
        let pick = |f: &[f64]| -> Vec<f64> { active.iter().map(|i| f[*i]).collect() };
        let (pseudo0, pseudo1) = (pick(&from.f), pick(&to.f));
        let forces = Forces { loads: [force.0, force.1], pseudo0: &pseudo0, pseudo1: &pseudo1 };
        energy.work = average_work(&self.space, dt, &from.motion, &to.motion, &forces);
        energy.link_work = energy.work.links;
        (energy.kinetic, energy.strain) = (energy.work.kinetic, energy.work.strain);
        let n = self.system.links.len();
        let mut moved = [vec![0.0; n], vec![0.0; n]];
        for (d, amplitudes) in moved.iter_mut().zip([&loads.start, &loads.end]) {
            self.loads.support_deformation(amplitudes, d, &mut vec![0.0; n]);
        }
        energy.support =
            (0..n).map(|i| 0.5 * (from.f[i] + to.f[i]) * (moved[1][i] - moved[0][i])).sum();
    }
}

/// Work by the trapezoidal rule, with which average acceleration balances exactly; what another α
/// leaves is the work of the time rule.
fn average_work(
    space: &ReducedSystem,
    dt: f64,
    from: &Motion,
    to: &Motion,
    forces: &Forces<'_>,
) -> StepWork {
    let n = space.order();
    let moved: Vec<f64> = (0..n).map(|i| to[i] - from[i]).collect();
    let [load0, load1] = forces.loads;
    let external: f64 = (0..n).map(|i| 0.5 * (load0[i] + load1[i]) * moved[i]).sum();
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
    StepWork { external, links, damping, algorithmic, kinetic: k1, strain: e1 }
}
