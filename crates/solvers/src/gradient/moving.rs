//! Modes that move with the structure.
//!
//! Reduced solvers step coordinates q of modes Φ in the span of their vectors. Beside the value of a parameter the structure has other
//! modes Φᵢ in the same span, whose signs and order mean nothing; what is the same motion there is
//!
//! ```text
//! qᵢ = Tᵢ q        Tᵢ = Φᵢᵀ Mᵢ Φ        (modes; static shapes: one by one)
//! ```
//!
//! The span stays: vectors that are found anew beside the value are others by rounding where they are many, and a basis that is
//! complete spans all there is. All that the structure does in a step is the step
//! of each of four structures around, from the same motion, under the same link forces, each led back by its T:
//!
//! ```text
//! ∂x₁ = Σ wᵢ Tᵢ⁻¹ stepᵢ(Tᵢ x₀, pᵢ, f₀, f₁)        δx₁ = step(δx₀, 0, δf₀, δf₁) + ∂x₁
//! ```
//!
//! Masses, stiffness, damping, modes and loads are in it, and the exact exponential of FNA as it is: nothing of it is written twice.

use super::around::{Around, Varied, WEIGHTS, weighted};
use super::sides::{in_physical, start};
use crate::basis::RitzBasis;
use crate::error::SolveError;
use crate::kernel::{Layout, StepKey, Wanted};
use crate::march::jump;
use crate::run::Prepared;
use crate::step::{Forces, Propagator, State};
use crate::structure::{JUMPED, Motion, ReducedSystem, acceleration};
use std::sync::Arc;
use trilith_linalg::{Dense, DenseLu};
use trilith_model::{Side, SolverKind};
use trilith_system::System;

/// How much of a static shape another one must be to pass for it, and of a mode where modes step by rules of their own.
const SAME_SHAPE: f64 = 0.9;

/// Coordinates of one basis as those of another.
pub(super) struct Turn {
    modes: Dense,
    inverse: Dense,
    /// 1 or −1 for each static shape.
    statics: Vec<f64>,
    /// True where every mode is one of the other basis, in the same order.
    in_order: bool,
}

impl Turn {
    /// From one basis to that of another system; none where they hold other things.
    pub(super) fn new(from: &RitzBasis, to: &RitzBasis, system: &System) -> Option<Self> {
        let n = from.modes();
        if to.modes() != n || to.statics() != from.statics() {
            return None;
        }
        let mut modes = Dense::zeros(n, n);
        let mut in_order = true;
        for (j, heavy) in from.shapes.each_heavy().enumerate() {
            let image = system.mass.mul(&heavy);
            let column = to.shapes.load(&image);
            in_order &= column[j].abs() > SAME_SHAPE;
            modes.column_mut(j).copy_from_slice(&column[..n]);
        }
        let same = |r: usize| {
            let (a, b) = (from.shapes.kept_static(r), to.shapes.kept_static(r));
            let of = |x: &[f64], y: &[f64]| x.iter().zip(y).map(|(x, y)| x * y).sum::<f64>();
            let cosine = of(a, b) / (of(a, a) * of(b, b)).sqrt();
            (a.len() == b.len() && cosine.abs() > SAME_SHAPE).then(|| cosine.signum())
        };
        let statics = (0..from.statics()).map(same).collect::<Option<_>>()?;
        let mut inverse = Dense::zeros(n, n);
        (0..n).for_each(|j| inverse[(j, j)] = 1.0);
        DenseLu::new(&modes).solve_columns(&mut inverse);
        Some(Self { modes, inverse, statics, in_order })
    }

    /// A motion in the other coordinates: displacements, velocities, accelerations.
    pub(super) fn there(&self, motion: &[f64]) -> Motion {
        self.each(motion, &self.modes)
    }

    /// And from there.
    pub(super) fn back(&self, motion: &[f64]) -> Motion {
        self.each(motion, &self.inverse)
    }

    fn each(&self, motion: &[f64], by: &Dense) -> Motion {
        let modes = by.columns();
        let mut out = vec![0.0; motion.len()];
        let order = modes + self.statics.len();
        let mut parts = Vec::with_capacity(3);
        for (part, out) in motion.chunks(order).zip(out.chunks_mut(order)) {
            let (part, statics) = part.split_at(modes);
            let (to, rest) = out.split_at_mut(modes);
            for (out, (x, sign)) in rest.iter_mut().zip(statics.iter().zip(&self.statics)) {
                *out = if *x == JUMPED { JUMPED } else { sign * x };
            }
            parts.push((part, to));
        }
        by.mul_add_each(1.0, &mut parts);
        out
    }

    /// A state with its motion there; links are what they are.
    pub(super) fn state(&self, state: &State) -> State {
        State { motion: self.there(&state.motion), ..state.clone() }
    }

    /// A row over the coordinates there as one over those here.
    fn row(&self, row: &[f64]) -> Vec<f64> {
        let modes = self.modes.columns();
        let mut out = vec![0.0; row.len()];
        self.modes.transpose_mul_add(1.0, &row[..modes], &mut out[..modes]);
        for ((out, x), sign) in out[modes..].iter_mut().zip(&row[modes..]).zip(&self.statics) {
            *out = sign * x;
        }
        out
    }
}

/// What a structure that moves, and its modes with it, does to the steps of a run.
pub(super) struct MovingBasis<'a> {
    step: f64,
    name: &'a str,
    sides: Vec<(Box<dyn Propagator + 'a>, &'a Prepared<'a>)>,
    turns: Arc<[Turn; 4]>,
    /// Rows of the active link coordinates of each structure, column by column, over the coordinates of the run.
    rows: [Dense; 4],
    /// Flat indices of the active link coordinates.
    active: &'a [usize],
    rate_dependent: Vec<usize>,
    /// Whether the work of loads is wanted, and its derivative over the step made last.
    works: bool,
    work: f64,
}

impl<'a> MovingBasis<'a> {
    /// Of four models around a parameter that are prepared for the solver of a run.
    pub(super) fn new(
        of: &'a Around,
        prepared: &'a [Prepared<'a>; 4],
        base: &'a Prepared<'a>,
        watched: bool,
    ) -> Result<Self, SolveError> {
        let Varied { name, step, .. } = &of.of;
        let kind = base.kind.name();
        let refuse = |why: &str| SolveError::NoGradient {
            reason: format!(
                "`{name}` moves the structure, and beside its value the basis of {kind} {why}; `--solver hht` gives derivatives by it"
            ),
        };
        let links = &base.system.links;
        let layout = Layout::new(links, &links.laws(base.model), Vec::new());
        let (mut sides, mut turns) = (Vec::with_capacity(4), Vec::with_capacity(4));
        for side in prepared {
            let (Some(from), Some(to), Some(mut propagator)) =
                (&base.bases, &side.bases, side.equations(watched).propagator())
            else {
                return Err(refuse("would have other directions without mass"));
            };
            if from.stepping.statics() > 0 && base.kind != SolverKind::Fna {
                return Err(refuse("has static shapes"));
            }
            let turn = Turn::new(&from.stepping, &to.stepping, side.system);
            turns.push(turn.ok_or_else(|| refuse("would have other static shapes"))?);
            if base.kind == SolverKind::Fna {
                propagator.set_rates(&layout.rate_dependent, &layout.damped)?;
            }
            propagator.follow_work(false);
            sides.push((propagator, side));
        }
        let Ok(turns) = turns.try_into() else { return Err(refuse("is not there")) };
        let Layout { rate_dependent, .. } = layout;
        let active = &links.active;
        let turns: Arc<[Turn; 4]> = Arc::new(turns);
        let rows = [0, 1, 2, 3].map(|side: usize| {
            let space = sides[side].0.space();
            let mut rows = Dense::zeros(space.order(), active.len());
            for a in 0..active.len() {
                let mut row = vec![0.0; space.order()];
                space.links.row(a).for_each(|(i, c)| row[i] += c);
                rows.column_mut(a).copy_from_slice(&turns[side].row(&row));
            }
            rows
        });
        Ok(Self {
            step: *step,
            name,
            sides,
            turns,
            rows,
            active,
            rate_dependent,
            works: false,
            work: 0.0,
        })
    }

    /// The coordinates of the models around.
    pub(super) fn turns(&self) -> Arc<[Turn; 4]> {
        Arc::clone(&self.turns)
    }

    /// The states that the models around start from, as motions of the run.
    pub(super) fn starts(&self, watched: bool) -> Result<[State; 4], SolveError> {
        let of = |side: usize| -> Result<State, SolveError> {
            let state = start(self.sides[side].1, None, watched)?;
            Ok(State { motion: self.turns[side].back(&state.motion), ..state })
        };
        let [a, b, c, d] = [0, 1, 2, 3].map(of);
        Ok([a?, b?, c?, d?])
    }

    /// One of the four structures.
    pub(super) fn prepared(&self, side: usize) -> &Prepared<'a> {
        self.sides[side].1
    }

    /// The coordinates of one of the four structures once more, for its loads.
    pub(super) fn space(&self, side: usize) -> ReducedSystem {
        let of = self.sides[side].1;
        let Some(bases) = &of.bases else { return in_physical(of) };
        let effective = &of.system.links.effective;
        ReducedSystem::reduced(of.system, &of.loads, effective, of.damping(), &bases.stepping)
    }

    /// Derivatives of the rows of the active link coordinates.
    pub(super) fn rows(&self) -> Vec<Vec<(usize, f64)>> {
        let of = |a: usize| {
            let sum = weighted(self.step, self.rows.each_ref().map(|rows| rows.column(a)));
            sum.into_iter().enumerate().filter(|(_, c)| *c != 0.0).collect()
        };
        (0..self.active.len()).map(of).collect()
    }

    /// The coordinates of the four structures.
    pub(super) fn spaces(&self) -> [&ReducedSystem; 4] {
        [0, 1, 2, 3].map(|i| self.sides[i].0.space())
    }

    /// Link forces of a state of the run as this structure takes them: those of its effective stiffnesses are in it.
    fn pseudo(&self, side: usize, state: &State) -> Vec<f64> {
        let space = self.sides[side].0.space();
        if space.effective_k.iter().all(|k| *k == 0.0) {
            return state.pseudo.clone();
        }
        let mut own = vec![0.0; self.active.len()];
        self.rows[side].transpose_mul_add(1.0, &state.motion[..space.order()], &mut own);
        let forces = self.active.iter().zip(&space.effective_k).zip(own);
        forces.map(|((flat, k), d)| state.f[*flat] - k * d).collect()
    }

    /// From now on, the work of loads is wanted.
    pub(super) fn follow_work(&mut self) {
        self.works = true;
        self.sides.iter_mut().for_each(|(propagator, _)| propagator.follow_work(true));
    }

    /// The derivative of the motion at the end of a step by all that the structure and its loads do in it.
    pub(super) fn step(
        &mut self,
        [from, to]: [&State; 2],
        [start, end]: [f64; 2],
        key: &StepKey,
    ) -> Result<Motion, SolveError> {
        let mut sum = vec![0.0; to.motion.len()];
        self.work = 0.0;
        for side in 0..4 {
            let turn = &self.turns[side];
            if !key.average.is_empty() && !turn.in_order {
                return Err(SolveError::NoGradient {
                    reason: format!(
                        "beside the value of `{}` modes change places at t = {end:.6} s, where some of them step by average acceleration; `--solver hht` gives derivatives by it",
                        self.name
                    ),
                });
            }
            let motion = turn.there(&from.motion);
            let [pseudo0, pseudo1] = [from, to].map(|state| self.pseudo(side, state));
            let (propagator, Prepared { loads, .. }) = &mut self.sides[side];
            propagator.prepare(key)?;
            let force = |t: f64, of: Side| {
                let amplitudes: Vec<f64> =
                    loads.channels.iter().map(|c| c.track.at(t, of)).collect();
                propagator.space().force(&amplitudes)
            };
            let loads = [force(start, Side::After), force(end, Side::Before)];
            let loads = [&loads[0][..], &loads[1][..]];
            let mut made = vec![0.0; motion.len()];
            let (mut d, mut v) =
                (vec![0.0; self.active.len()], vec![0.0; self.rate_dependent.len()]);
            let wanted = Wanted { d: &mut d, v: &mut v, rate_dependent: &self.rate_dependent };
            let forces = Forces { loads, pseudo0: &pseudo0, pseudo1: &pseudo0 };
            propagator.predict(&motion, &forces, &mut made, wanted);
            let forces = Forces { loads, pseudo0: &pseudo0, pseudo1: &pseudo1 };
            propagator.correct(&motion, &forces, &mut made);
            let weight = WEIGHTS[side] / self.step;
            if self.works {
                self.work += weight * propagator.work(&motion, &made, &forces).external;
            }
            let made = turn.back(&made);
            sum.iter_mut().zip(&made).for_each(|(sum, x)| *sum += weight * acceleration(*x));
        }
        Ok(sum)
    }

    /// The derivative of the work of loads over the step made last.
    pub(super) fn work(&self) -> f64 {
        self.work
    }

    /// The derivative of how accelerations follow a jump of the loads at a time.
    pub(super) fn jump(&mut self, t: f64) -> Result<Vec<f64>, SolveError> {
        let n = self.sides[0].0.space().order();
        let mut sum = vec![0.0; n];
        let sides = self.sides.iter_mut().zip(self.turns.iter().zip(WEIGHTS));
        for ((propagator, Prepared { loads, .. }), (turn, weight)) in sides {
            let change = jump(loads, t).unwrap_or_else(|| vec![0.0; loads.channels.len()]);
            let force = propagator.space().force(&change);
            let by = turn.back(&propagator.acceleration(&force)?);
            for (sum, a) in sum.iter_mut().zip(&by) {
                *sum += weight / self.step * acceleration(*a);
            }
        }
        Ok(sum)
    }
}
