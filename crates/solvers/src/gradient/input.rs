//! The energy that loads and supports put in, differentiated.
//!
//! ```text
//! E = Σ steps W(p₀, p₁; x₀, x₁) + ½ (f₀ + f₁)·(s₁ − s₀) − p_c·(u − u(0))
//! ```
//!
//! W is the work of the loads by the rule of the solver, s what moving supports give the links, p_c the constant loads, whose work is
//! that of a potential. W is of the second degree in loads and motion together, so its derivative along (∂p, δx) is, for an ε of
//! any size,
//!
//! ```text
//! δW = (W(p + ε ∂p, x + ε δx) − W(p − ε ∂p, x − ε δx)) / 2ε
//! ```

use super::influence::Influence;
use crate::march::{constant_force, potential};
use crate::step::{Forces, Propagator, State};
use crate::structure::ReducedSystem;
use crate::vector::largest;
use trilith_model::Side;
use trilith_system::LoadSet;

/// Derivatives of the energy that has been put in, by each parameter.
pub(super) struct InputMoves<'a> {
    loads: &'a LoadSet,
    influences: &'a [Influence<'a>],
    /// Flat indices of the active link coordinates.
    flat: usize,
    /// Of the work of loads and supports so far.
    sum: Vec<f64>,
    /// Of the potential of constant loads at the start.
    level: Vec<f64>,
}

/// A step and its derivatives by one parameter.
pub(super) struct Moved<'s> {
    /// States at both ends.
    pub states: [&'s State; 2],
    /// Their derivatives, and of the motion at the end what a basis that moves has in it, with the work of its loads.
    pub by: [&'s State; 2],
    pub basis: Option<(&'s [f64], f64)>,
}

/// The loads of a run at both ends of a step.
pub(super) struct EndLoads {
    /// Times (s), and the side of a jump that is in the step.
    sides: [(f64, Side); 2],
    force: [Vec<f64>; 2],
    /// Deformations of links by supports.
    support: [Vec<f64>; 2],
}

impl<'a> InputMoves<'a> {
    pub(super) fn new(
        loads: &'a LoadSet,
        influences: &'a [Influence<'a>],
        flat: usize,
        propagator: &dyn Propagator,
        (state, moves): (&State, &[State]),
    ) -> Self {
        let sum = vec![0.0; influences.len()];
        let mut it = Self { loads, influences, flat, level: sum.clone(), sum };
        it.level = it.levels(propagator, state, moves);
        it
    }

    /// Derivatives of the potential of constant loads.
    fn levels(&self, propagator: &dyn Propagator, state: &State, moves: &[State]) -> Vec<f64> {
        let constant = constant_force(propagator.space(), self.loads);
        let of = |(influence, by): (&Influence<'_>, &State)| {
            potential(&constant, by) + influence.potential(state)
        };
        self.influences.iter().zip(moves).map(of).collect()
    }

    /// The loads of the run over a step between these times (s).
    pub(super) fn loads(&self, [start, end]: [f64; 2], space: &ReducedSystem) -> EndLoads {
        let sides = [(start, Side::After), (end, Side::Before)];
        let amplitudes = sides.map(|(t, side)| -> Vec<f64> {
            self.loads.channels.iter().map(|c| c.track.at(t, side)).collect()
        });
        let support = [0, 1].map(|i| {
            let (mut d, mut v) = (vec![0.0; self.flat], vec![0.0; self.flat]);
            self.loads.support_deformation(&amplitudes[i], &mut d, &mut v);
            d
        });
        EndLoads { sides, force: amplitudes.map(|a| space.force(&a)), support }
    }

    /// Enters a step by the parameter of this index.
    pub(super) fn enter(
        &mut self,
        j: usize,
        propagator: &mut dyn Propagator,
        EndLoads { sides, force, support }: &EndLoads,
        step: &Moved<'_>,
    ) {
        let Moved { states: [from, to], by: [from_by, to_by], basis } = step;
        let influence = &self.influences[j];
        let more = match &influence.loads {
            Some(loads) => {
                sides.map(|(t, side)| Some(loads.at(influence.step, t, side, self.flat)))
            }
            None => [None, None],
        };
        // The basis has its loads in its own work.
        let own = |end: usize| more[end].as_ref().filter(|_| basis.is_none()).map(|m| &m[0]);
        let n = from.motion.len() / 3;
        let sizes = [&from_by.motion[..n], &to_by.motion[..n]].map(largest);
        let (size, moved) = (largest(&to.motion[..n]), sizes[0].max(sizes[1]));
        let e = if size > 0.0 && moved > 0.0 { size / moved } else { 1.0 };
        let mut work = |e: f64| {
            let along = |x: &[f64], by: Option<&[f64]>| -> Vec<f64> {
                let Some(by) = by else { return x.to_vec() };
                x.iter().zip(by).map(|(x, by)| x + e * by).collect()
            };
            let loads = [0, 1].map(|i| along(&force[i], own(i).map(|p| &p[..])));
            let [pseudo0, pseudo1] =
                [(from, from_by), (to, to_by)].map(|(x, by)| along(&x.pseudo, Some(&by.pseudo)));
            let start = along(&from.motion, Some(&from_by.motion));
            let mut end = along(&to.motion, Some(&to_by.motion));
            if let Some((moved, _)) = basis {
                end.iter_mut().zip(*moved).for_each(|(x, by)| *x -= e * by);
            }
            let loads = [&loads[0][..], &loads[1][..]];
            let forces = Forces { loads, pseudo0: &pseudo0, pseudo1: &pseudo1 };
            propagator.external_work(&start, &end, &forces)
        };
        self.sum[j] += (work(e) - work(-e)) / (2.0 * e) + basis.map_or(0.0, |(_, work)| work);
        self.sum[j] += of_supports(support, &more, step);
    }

    /// Derivatives of the energy put in until a state.
    pub(super) fn until(
        &self,
        propagator: &dyn Propagator,
        state: &State,
        moves: &[State],
    ) -> Vec<f64> {
        let now = self.levels(propagator, state, moves);
        let all = self.sum.iter().zip(now.iter().zip(&self.level));
        all.map(|(sum, (now, start))| sum + now - start).collect()
    }
}

/// ½ (δf₀ + δf₁)·(s₁ − s₀) + ½ (f₀ + f₁)·(∂s₁ − ∂s₀).
fn of_supports(
    [start, end]: &[Vec<f64>; 2],
    more: &[Option<[Vec<f64>; 3]>; 2],
    Moved { states: [from, to], by: [from_by, to_by], .. }: &Moved<'_>,
) -> f64 {
    let mut work = 0.0;
    for i in 0..start.len() {
        work += 0.5 * (from_by.f[i] + to_by.f[i]) * (end[i] - start[i]);
        if let [Some(start), Some(end)] = more {
            work += 0.5 * (from.f[i] + to.f[i]) * (end[1][i] - start[1][i]);
        }
    }
    work
}
