//! What a parameter moves in a run.

use super::around::{Around, Assembled, weighted};
use super::moving::{MovingBasis, Turn};
use super::sides::{Sides, in_physical, start};
use super::structure::Structure;
use crate::error::SolveError;
use crate::march::{constant_force, potential};
use crate::record::Outputs;
use crate::run::Prepared;
use crate::step::State;
use crate::structure::{JUMPED, ReducedSystem};
use std::sync::Arc;
use trilith_model::Side;
use trilith_system::{Channel, LoadSet, System, Track};

/// What a run is made of.
#[derive(Clone, Copy)]
pub(super) struct Pieces<'p, 'a> {
    pub prepared: &'p Prepared<'a>,
    pub space: &'p ReducedSystem,
    /// Whether somebody needs rates.
    pub watched: bool,
}

/// What a parameter moves.
pub(super) struct Influence<'a> {
    /// Step of the differences.
    pub step: f64,
    pub structure: Option<Structure>,
    pub loads: Option<Loads>,
    /// The outputs of the models around, and their loads, where rows may move.
    pub outputs: Option<[(Outputs, LoadSet); 4]>,
    /// Derivatives of the rows of the active link coordinates; none where they stay.
    pub rows: Option<Vec<Vec<(usize, f64)>>>,
    /// Where a basis moves with the structure: the coordinates of the models around.
    pub turns: Option<Arc<[Turn; 4]>>,
    /// The models around, for laws.
    pub around: &'a Around,
    pub systems: &'a [System; 4],
    /// Derivative of the state at the start.
    pub start: State,
}

impl Influence<'_> {
    /// What the parameter itself does to the potential of constant loads in a state.
    pub(super) fn potential(&self, state: &State) -> f64 {
        let Some(Loads { spaces, sets }) = &self.loads else { return 0.0 };
        let of = |i: usize| {
            let there = self.turns.as_ref().map(|turns| turns[i].state(state));
            potential(&constant_force(&spaces[i], &sets[i]), there.as_ref().unwrap_or(state))
        };
        weighted(self.step, [0, 1, 2, 3].map(|i| [of(i)]).each_ref().map(|x| &x[..]))[0]
    }
}

/// Loads of the models around, in the coordinates of the solver.
pub(super) struct Loads {
    spaces: [ReducedSystem; 4],
    sets: [LoadSet; 4],
}

impl Loads {
    /// ∂p at a time, and ∂ of the deformations and rates that supports give the links.
    pub(super) fn at(&self, step: f64, t: f64, side: Side, flat: usize) -> [Vec<f64>; 3] {
        let all = [0, 1, 2, 3].map(|i| {
            let (space, set) = (&self.spaces[i], &self.sets[i]);
            let amplitudes: Vec<f64> = set.channels.iter().map(|c| c.track.at(t, side)).collect();
            let (mut d, mut v) = (vec![0.0; flat], vec![0.0; flat]);
            set.support_deformation(&amplitudes, &mut d, &mut v);
            [space.force(&amplitudes), d, v]
        });
        [0, 1, 2].map(|k| weighted(step, [0, 1, 2, 3].map(|i| &all[i][k][..])))
    }
}

/// True where loads are the same at all times.
fn alike(a: &LoadSet, b: &LoadSet) -> bool {
    let same = |(a, b): (&Channel, &Channel)| {
        let same =
            a.deformation == b.deformation && a.rate == b.rate && is_same(&a.track, &b.track);
        a.force == b.force && same
    };
    a.channels.len() == b.channels.len() && a.channels.iter().zip(&b.channels).all(same)
}

fn is_same(a: &Track, b: &Track) -> bool {
    match (a, b) {
        (Track::Constant, Track::Constant) => true,
        (Track::Value { function: f, factor: x }, Track::Value { function: g, factor: y })
        | (Track::Rate { function: f, factor: x }, Track::Rate { function: g, factor: y })
        | (
            Track::Curvature { function: f, factor: x },
            Track::Curvature { function: g, factor: y },
        ) => f == g && x == y,
        _ => false,
    }
}

impl<'a> Influence<'a> {
    /// What a parameter moves in a case of a run; `moving`: its basis, where that moves.
    pub(super) fn new(
        assembled: &'a Assembled<'a>,
        sides: &mut Sides<'_>,
        moving: Option<&MovingBasis<'_>>,
        pieces: &Pieces<'_, '_>,
    ) -> Result<Self, SolveError> {
        let Pieces { prepared: base, space, watched } = *pieces;
        let step = assembled.around.of.step;
        let Sides { physical: all, structure, .. } = sides;
        let reduced = base.kind.is_reduced();
        // What a basis moves with is in its steps.
        let structure = structure.take().filter(|_| !reduced);
        let start = match moving {
            Some(moving) => start_moves(step, &moving.starts(watched)?, space, base),
            None => {
                let on = reduced.then_some(base);
                let [a, b, c, d] = [0, 1, 2, 3].map(|i| start(&all[i], on, watched));
                start_moves(step, &[a?, b?, c?, d?], space, base)
            }
        };
        let still = all.iter().all(|p| alike(&p.loads, &base.loads));
        let prepared = |i: usize| moving.map_or(&all[i], |moving| moving.prepared(i));
        let sets = [0, 1, 2, 3].map(|i| prepared(i).loads.clone());
        let space_of = |i: usize| match (moving, &base.bases) {
            (Some(moving), _) => moving.space(i),
            (None, Some(b)) if reduced => {
                let (effective, damping) = (&base.system.links.effective, base.damping());
                ReducedSystem::reduced(base.system, &sets[i], effective, damping, &b.stepping)
            }
            _ => in_physical(&all[i]),
        };
        let loads = (!still || moving.is_some())
            .then(|| Loads { spaces: [0, 1, 2, 3].map(space_of), sets: sets.clone() });
        let own = structure.is_some() || loads.is_some() || moving.is_some();
        let outputs = own.then(|| {
            [0, 1, 2, 3].map(|i| {
                let p = prepared(i);
                let outputs = match moving {
                    Some(moving) => Outputs::new(p.model, p.system, moving.spaces()[i]),
                    None if reduced => Outputs::new(p.model, base.system, space),
                    None => Outputs::new(p.model, p.system, &in_physical(p)),
                };
                (outputs, sets[i].clone())
            })
        });
        let rows = match moving {
            Some(moving) => Some(moving.rows()),
            None => structure.as_ref().and_then(|s| s.rows.clone()),
        };
        Ok(Self {
            step,
            structure,
            loads,
            outputs,
            rows,
            turns: moving.map(MovingBasis::turns),
            around: assembled.around,
            systems: &assembled.systems,
            start,
        })
    }
}

/// The derivative of the state at the start.
fn start_moves(
    step: f64,
    states: &[State; 4],
    space: &ReducedSystem,
    base: &Prepared<'_>,
) -> State {
    let of = |x: &dyn Fn(&State) -> &[f64]| weighted(step, [0, 1, 2, 3].map(|i| x(&states[i])));
    let mut start = State {
        motion: of(&|s| &s.motion),
        d: of(&|s| &s.d),
        v: of(&|s| &s.v),
        f: of(&|s| &s.f),
        history: of(&|s| &s.history),
        pseudo: vec![0.0; space.links.len()],
        ..State::default()
    };
    let n = space.order();
    for (i, a) in start.motion[2 * n..].iter_mut().enumerate() {
        // The mark of a jump moves nothing.
        if states.iter().any(|s| s.motion[2 * n + i] == JUMPED) {
            *a = 0.0;
        }
    }
    let mut own = vec![0.0; space.links.len()];
    space.links.deform(&start.motion[..n], &mut own);
    for (a, flat) in base.system.links.active.iter().enumerate() {
        start.pseudo[a] = start.f[*flat] - space.effective_k[a] * own[a];
    }
    start
}
