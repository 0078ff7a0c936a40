//! The response mode of bodies on contacts, in lanes; see [`ContactMode`](crate::ContactMode).

use crate::record::{ContactSummary, Seen};
use trilith_element::Contact;
use trilith_element::lanes::{Arithmetic, LaneContact, Real};

/// √(x² + y²); y is zero in a plane.
#[inline(always)]
fn length<R: Real>(plane: bool, of: impl Fn(usize) -> R) -> R {
    let x = of(0);
    if plane {
        return x.abs();
    }
    let y = of(1);
    x.mul_add(x, y * y).sqrt()
}

/// Pressed together, with a force.
#[inline(always)]
fn loaded<R: Real>(now: &LaneContact<R>) -> R::Mask {
    let zero = now.gap.of(0.0);
    now.gap.lt(zero) & zero.lt(now.normal)
}

/// What has been seen.
#[derive(Clone, Copy)]
struct SeenLanes<R> {
    slid: R,
    rocked: R,
    flew: R,
}

/// One contact.
#[derive(Clone, Copy)]
struct Foot<R> {
    start: [R; 2],
    /// Distance from the start where it last carried load.
    slip: R,
    gap: R,
    position: [R; 2],
}

/// All contacts of a model.
#[derive(Clone)]
pub(super) struct Feet<R: Real> {
    feet: Vec<Foot<R>>,
    direction: [R; 2],
    initial: SeenLanes<R>,
    whole: SeenLanes<R>,
    /// 1 while the initial mode goes on.
    fresh: R,
    play: R,
    /// How deep the deepest contact was pressed in, m.
    depth: R,
    max_uplift: R,
    max_slip: R,
    residual: R,
    plane: bool,
    /// Which lanes stand on something, or fall onto it.
    standing: Vec<bool>,
}

impl<R: Real> Feet<R> {
    /// At the start; `contacts` of each lane, and whether it stands; `plane` where all positions are along one axis.
    pub(super) fn new<A: Arithmetic<Real = R>>(
        with: A,
        contacts: &[&[Contact]],
        standing: Vec<bool>,
        plane: bool,
    ) -> Self {
        let last = contacts.len() - 1;
        let of = |i: usize| contacts[i.min(last)];
        let zero = with.splat(0.0);
        let count = contacts[0].len();
        let feet = (0..count)
            .map(|c| {
                let position = [0, 1].map(|k| with.gather(|i| of(i)[c].position[k]));
                Foot { start: position, slip: zero, gap: with.gather(|i| of(i)[c].gap), position }
            })
            .collect();
        let play = |i: usize| of(i).iter().map(|c| (-c.gap).max(0.0)).fold(0.0, f64::max);
        let uplift = |i: usize| of(i).iter().map(|c| c.gap).fold(0.0, f64::max);
        let seen = SeenLanes { slid: zero, rocked: zero, flew: zero };
        Self {
            feet,
            direction: [zero; 2],
            initial: seen,
            whole: seen,
            fresh: with.splat(1.0),
            play: with.gather(play),
            depth: with.gather(play),
            max_uplift: with.gather(uplift),
            max_slip: zero,
            residual: zero,
            plane,
            standing,
        }
    }

    /// After a step; `which` of the contacts are feet.
    #[inline(always)]
    pub(super) fn enter(&mut self, contacts: &[LaneContact<R>], which: &[usize]) {
        let Some(first) = self.feet.first() else { return };
        let (zero, one) = (first.gap.of(0.0), first.gap.of(1.0));
        let never = one.lt(zero);
        let (mut impact, mut some, mut sticks) = (never, never, never);
        let (mut highest, mut lowest) = (first.gap.of(f64::MIN), first.gap.of(f64::MAX));
        for (foot, at) in self.feet.iter().zip(which) {
            let now = &contacts[*at];
            let loaded = loaded(now);
            impact = impact | (zero.lt(foot.gap) & now.gap.le(zero));
            some = some | loaded;
            sticks = sticks | (loaded & now.slipping.le(zero));
            highest = highest.max(now.gap);
            lowest = lowest.min(now.gap);
        }
        self.depth = self.depth.max(-lowest);
        let moved = some & !sticks;
        if zero.any(moved) {
            let (slid, reversal) = self.slide(contacts, which, moved);
            self.fresh = self.fresh.only(!(impact | reversal));
            self.whole.slid = self.whole.slid + slid;
            self.initial.slid = self.initial.slid + slid.only(zero.lt(self.fresh));
        } else {
            self.fresh = self.fresh.only(!impact);
        }
        let lifts = zero.lt(highest);
        if zero.any(lifts) {
            let flies = zero.lt(lowest);
            let rocks = lifts & lowest.le(zero);
            let rocked = R::select(rocks, highest, (highest - lowest).only(flies));
            let flew = lowest.only(flies);
            let fresh = zero.lt(self.fresh);
            self.whole.rocked = self.whole.rocked.max(rocked);
            self.whole.flew = self.whole.flew.max(flew);
            self.initial.rocked = self.initial.rocked.max(rocked.only(fresh));
            self.initial.flew = self.initial.flew.max(flew.only(fresh));
            self.max_uplift = self.max_uplift.max(highest);
        }
        let mut slip = zero;
        for (foot, at) in self.feet.iter_mut().zip(which) {
            let now = &contacts[*at];
            let far = length(self.plane, |k| now.position[k] - foot.start[k]);
            foot.slip = R::mix(zero.lt(now.normal), far, foot.slip);
            slip = slip.max(foot.slip);
            foot.gap = now.gap;
            foot.position = now.position;
        }
        self.max_slip = self.max_slip.max(slip);
        self.residual = slip;
    }

    /// Looks how deep contacts that are no feet are pressed in.
    #[inline(always)]
    pub(super) fn press(&mut self, contacts: &[LaneContact<R>], others: &[usize]) {
        for at in others {
            let now = &contacts[*at];
            self.depth = self.depth.max((-now.gap).only(loaded(now)));
        }
    }

    /// How deep the deepest contact of a lane was pressed in, m.
    pub(super) fn depth<A: Arithmetic<Real = R>>(&self, with: A, lane: usize) -> f64 {
        with.lane(self.depth, lane)
    }

    /// How far a mask has slid, in the mean of the loaded contacts, and where it has turned back.
    #[inline(always)]
    fn slide(
        &mut self,
        contacts: &[LaneContact<R>],
        which: &[usize],
        moved: R::Mask,
    ) -> (R, R::Mask) {
        let zero = self.fresh.of(0.0);
        let one = self.fresh.of(1.0);
        let axes = if self.plane { 1 } else { 2 };
        let (mut mean, mut count) = ([zero; 2], zero);
        for (foot, at) in self.feet.iter().zip(which) {
            let now = &contacts[*at];
            let loaded = loaded(now);
            for k in 0..axes {
                mean[k] = mean[k] + (now.position[k] - foot.position[k]).only(loaded);
            }
            count = count + one.only(loaded);
        }
        let share = one / count.max(one);
        let mut along = zero;
        for k in 0..axes {
            mean[k] = mean[k] * share;
            along = mean[k].mul_add(self.direction[k], along);
        }
        let slid = length(self.plane, |k| mean[k]).only(moved);
        let turned = zero.lt(slid);
        for k in 0..axes {
            self.direction[k] = R::mix(turned, mean[k], self.direction[k]);
        }
        (slid, moved & along.lt(zero))
    }

    /// Takes the other where the mask says no.
    #[inline(always)]
    pub(super) fn keep(&mut self, mask: R::Mask, other: &Self) {
        let one = |x: &mut R, y: &R| *x = R::select(mask, *x, *y);
        for (x, y) in self.feet.iter_mut().zip(&other.feet) {
            one(&mut x.slip, &y.slip);
            one(&mut x.gap, &y.gap);
            one(&mut x.position[0], &y.position[0]);
            one(&mut x.position[1], &y.position[1]);
        }
        for (x, y) in [(&mut self.initial, &other.initial), (&mut self.whole, &other.whole)] {
            one(&mut x.slid, &y.slid);
            one(&mut x.rocked, &y.rocked);
            one(&mut x.flew, &y.flew);
        }
        for (x, y) in self.direction.iter_mut().zip(&other.direction) {
            one(x, y);
        }
        one(&mut self.fresh, &other.fresh);
        one(&mut self.depth, &other.depth);
        one(&mut self.max_uplift, &other.max_uplift);
        one(&mut self.max_slip, &other.max_slip);
        one(&mut self.residual, &other.residual);
    }

    pub(super) fn of_lane<A: Arithmetic<Real = R>>(
        &self,
        with: A,
        lane: usize,
    ) -> Option<ContactSummary> {
        if self.feet.is_empty() || !self.standing[lane] {
            return None;
        }
        let of = |x: R| with.lane(x, lane);
        let seen =
            |s: &SeenLanes<R>| Seen { slid: of(s.slid), rocked: of(s.rocked), flew: of(s.flew) };
        let play = of(self.play);
        Some(ContactSummary {
            initial_mode: seen(&self.initial).mode(play),
            mode: seen(&self.whole).mode(play),
            max_uplift: of(self.max_uplift),
            max_slip: of(self.max_slip),
            residual_slip: of(self.residual),
            overturned: false,
        })
    }
}
