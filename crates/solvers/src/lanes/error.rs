//! How far a step made whole and in two halves is apart, lane by lane: the norms of the ordinary
//! [`march`](crate::march) and of [`Difference`](crate::step::Difference).

use super::plan::{Plan, pick};
use super::record::Record;
use super::setup::{Adaptive, LaneSetup};
use super::state::State;
use crate::march::{CLOSURE, LEAST_WAY, ROUNDING, StepControlState};
use trilith_element::lanes::{Arithmetic, Real};

/// What steps are measured against.
pub(super) struct Norms<R> {
    tolerance: R,
    /// Largest energy of the motion so far, J.
    reference: R,
    /// Largest displacements so far: √(uᵀ M u), and deformations of the links, translations and rotations.
    motion: R,
    deformation: [R; 2],
    /// Forces that count beside the loads.
    push: [R; 2],
}

/// A step on trial: whole, and its halves; the work that links took in these, J.
pub(super) struct Tried<'a, R: Real, const M: usize, const L: usize, const N: usize> {
    pub whole: &'a State<R, M, L, N>,
    pub halves: &'a [State<R, M, L, N>; 2],
    pub work: R,
    /// Energy of the impulses that the halves have missed, J, and forces that they have wrong.
    pub missed: R,
    pub turned: [R; 2],
}

impl<R: Real> Norms<R> {
    pub fn new<A: Arithmetic<Real = R>>(with: A, setups: &[&LaneSetup]) -> Self {
        let of = |of: &dyn Fn(&Adaptive) -> f64| {
            pick(with, setups, &|s| s.adaptive.as_ref().map_or(1.0, of))
        };
        Self {
            tolerance: of(&|a| a.tolerance),
            reference: of(&|a| a.control.reference),
            motion: of(&|a| a.control.reached.motion),
            deformation: [0, 1].map(|kind| of(&|a| a.control.reached.deformation[kind])),
            push: [0, 1].map(|kind| of(&|a| a.control.push[kind])),
        }
    }

    /// Those of others where a mask says so.
    pub fn take(&mut self, mask: R::Mask, from: &Self) {
        for (to, from) in [
            (&mut self.tolerance, &from.tolerance),
            (&mut self.reference, &from.reference),
            (&mut self.motion, &from.motion),
        ] {
            *to = R::select(mask, *from, *to);
        }
        for kind in 0..2 {
            let (own, other) = (self.deformation[kind], from.deformation[kind]);
            self.deformation[kind] = R::select(mask, other, own);
            self.push[kind] = R::select(mask, from.push[kind], self.push[kind]);
        }
    }

    /// Error of energies and forces, and of displacements for the way that the step went.
    #[inline(always)]
    pub fn measure<A: Arithmetic<Real = R>, const M: usize, const L: usize, const N: usize>(
        &self,
        with: A,
        plan: &Plan<R, M, L, N>,
        (at, record): (&State<R, M, L, N>, &Record<R>),
        tried: &Tried<'_, R, M, L, N>,
    ) -> [R; 2] {
        let Tried { whole, halves: [first, second], work, missed, turned } = tried;
        let (zero, half) = (with.splat(0.0), with.splat(0.5));
        // The motion: apart, and on its way.
        let [mut kinetic, mut strain, mut apart, mut moved, mut moving] = [zero; 5];
        for j in 0..plan.modes() {
            let q = whole.q[j] - second.q[j];
            let p = whole.p[j] - second.p[j];
            let way = second.q[j] - at.q[j];
            kinetic = p.mul_add(p, kinetic);
            strain = (plan.omega2[j] * q).mul_add(q, strain);
            apart = q.mul_add(q, apart);
            moved = way.mul_add(way, moved);
            moving = second.p[j].mul_add(second.p[j], moving);
        }
        // Its links.
        let mut of_links = zero;
        let (mut d_apart, mut d_moved, mut f_apart) = ([zero; 2], [zero; 2], *turned);
        for a in 0..plan.coordinates() {
            let kind = usize::from(plan.rotational[a]);
            let d = (whole.d[a] - second.d[a]).abs();
            let f = (whole.f[a] - second.f[a]).abs();
            of_links = d.mul_add(f, of_links);
            d_apart[kind] = d_apart[kind].max(d);
            d_moved[kind] = d_moved[kind].max((second.d[a] - at.d[a]).abs());
            f_apart[kind] = f_apart[kind].max(f);
        }
        let energy = self.reference.max(half * moving);
        let apart_energy = half * (kinetic + strain.abs() + of_links);
        let share = (apart_energy.max(*missed) / energy).sqrt();
        // The energies of the links must close.
        let mut missing = record.stored + *work;
        let mut heat = zero;
        for step in first.steps.iter().chain(&second.steps) {
            heat = heat + step.hysteretic;
            if plan.rate {
                heat = heat + step.viscous;
            }
        }
        for step in &second.steps {
            missing = missing - step.stored;
        }
        let missing = (missing - heat).abs();
        let least = with.splat(10.0) * self.tolerance * self.tolerance * energy;
        let mut allowed = with.splat(CLOSURE).mul_add(heat.abs(), least);
        let over = allowed.lt(missing);
        if zero.any(over) {
            allowed = allowed + rounding(with, plan, second).only(over);
        }
        let tiny = with.splat(f64::MIN_POSITIVE);
        let mut of_force = zero;
        for (kind, f) in f_apart.into_iter().enumerate() {
            let forces = whole.scale[kind].max(second.scale[kind]).max(self.push[kind]).max(tiny);
            of_force = of_force.max(f / forces);
        }
        let closing = self.tolerance * missing / allowed.max(tiny);
        let error = share.max(closing).max(of_force * of_force);
        // A half that is no number leaves no doubt of it.
        let sound = R::select(share.le(share), error, share);
        let least = with.splat(LEAST_WAY);
        let over = |x: R, way: R, most: R| x / way.max(least * most).max(tiny);
        let mut on_way = over(apart.sqrt(), moved.sqrt(), self.motion);
        for kind in 0..2 {
            on_way = on_way.max(over(d_apart[kind], d_moved[kind], self.deformation[kind]));
        }
        [sound, on_way]
    }

    /// The energy in motion after a step, of the analyses in `ok`.
    #[inline(always)]
    pub fn see(&mut self, ok: R::Mask, energy: R) {
        self.reference = R::select(ok, self.reference.max(energy), self.reference);
    }

    /// True where all motion of an analysis counts for nothing beside what stands in springs.
    pub fn is_lost<A: Arithmetic<Real = R>>(
        &self,
        with: A,
        setup: &LaneSetup,
        lane: usize,
    ) -> bool {
        let reference = with.lane(self.reference, lane);
        setup
            .adaptive
            .as_ref()
            .is_some_and(|a| StepControlState { reference, ..a.control.clone() }.is_lost())
    }

    /// How far the motion is behind a step, of the analyses in `ok`.
    #[inline(always)]
    pub fn reach<const M: usize, const L: usize, const N: usize>(
        &mut self,
        plan: &Plan<R, M, L, N>,
        ok: R::Mask,
        at: &State<R, M, L, N>,
    ) {
        let zero = self.motion.of(0.0);
        let mut motion = zero;
        for q in *at.q {
            motion = q.mul_add(q, motion);
        }
        let mut deformation = [zero; 2];
        for a in 0..plan.coordinates() {
            let kind = usize::from(plan.rotational[a]);
            deformation[kind] = deformation[kind].max(at.d[a].abs());
        }
        self.motion = R::select(ok, self.motion.max(motion.sqrt()), self.motion);
        for (most, now) in self.deformation.iter_mut().zip(deformation) {
            *most = R::select(ok, most.max(now), *most);
        }
    }
}

/// What rounding of the motion may do to the energies of the links, J.
#[inline(always)]
fn rounding<A: Arithmetic, const M: usize, const L: usize, const N: usize>(
    with: A,
    plan: &Plan<A::Real, M, L, N>,
    state: &State<A::Real, M, L, N>,
) -> A::Real {
    let mut sum = with.splat(0.0);
    for a in 0..plan.coordinates() {
        let mut size = with.splat(0.0);
        for j in 0..plan.modes() {
            size = size + (plan.b[a][j] * state.q[j]).abs();
        }
        sum = state.f[a].abs().mul_add(size, sum);
    }
    // The force of the law, and that which the motion feels.
    with.splat(2.0 * ROUNDING * f64::EPSILON) * sum
}
