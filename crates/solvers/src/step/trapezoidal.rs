//! Work over a step of direct integration.

use super::propagator::{Forces, StepWork};
use crate::structure::{Motion, Products, ReducedSystem};

/// By the trapezoidal rule, with which average acceleration balances exactly; what another rule leaves is the work of
/// the time rule. Holds the vectors that it needs.
pub(crate) struct TrapezoidalWork {
    u: Vec<f64>,
    v: Vec<f64>,
    moved: Vec<f64>,
    rank: Vec<f64>,
}

impl TrapezoidalWork {
    pub(crate) fn new(space: &ReducedSystem) -> Self {
        let of = |n: usize| vec![0.0; n];
        let n = space.order();
        let rank = space.modal.as_ref().map_or(0, |m| m.rate.len());
        Self { u: of(n), v: of(n), moved: of(space.links.len()), rank: of(rank) }
    }

    /// Of a step of this length (s) from one motion to the other.
    pub(crate) fn of(
        &mut self,
        products: &Products,
        space: &ReducedSystem,
        [from, to]: [&Motion; 2],
        forces: &Forces<'_>,
        dt: f64,
    ) -> StepWork {
        let n = space.order();
        let [load0, load1] = forces.loads;
        let mut external = 0.0;
        for i in 0..n {
            self.u[i] = to[i] - from[i];
            self.v[i] = 0.5 * (from[n + i] + to[n + i]);
            external += 0.5 * (load0[i] + load1[i]) * self.u[i];
        }
        space.links.deform(&self.u, &mut self.moved);
        let links: f64 = (forces.pseudo0.iter().zip(forces.pseudo1).zip(&self.moved))
            .map(|((f0, f1), d)| 0.5 * (f0 + f1) * d)
            .sum();
        let energies = products.energies(space, [from, to], &self.v, &mut self.rank);
        let [kinetic, strain] = energies.end;
        let damping = dt * energies.damping;
        let gained = (kinetic - energies.start[0]) + (strain - energies.start[1]);
        let algorithmic = external - links - damping - gained;
        StepWork { external, links, damping, algorithmic, kinetic, strain }
    }
}
