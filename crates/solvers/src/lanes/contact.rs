//! The response mode of bodies on contacts, in lanes; see [`ContactMode`](crate::ContactMode).

use crate::contact_mode::{ContactSummary, Seen};
use trilith_element::Contact;
use trilith_element::lanes::{Arithmetic, LaneStep, Real};

/// √(x² + y²); y is zero in a plane.
#[inline(always)]
fn length<R: Real>(x: R, y: R, plane: bool) -> R {
    if plane { x.abs() } else { x.mul_add(x, y * y).sqrt() }
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
            max_uplift: with.gather(uplift),
            max_slip: zero,
            residual: zero,
            plane,
            standing,
        }
    }

    /// After a step of all links; `which` of them are contacts.
    #[inline(always)]
    pub(super) fn enter(&mut self, steps: &[LaneStep<R>], which: &[usize]) {
        let Some(first) = self.feet.first() else { return };
        let zero = first.gap.of(0.0);
        let one = first.gap.of(1.0);
        let never = one.lt(zero);
        let (mut impact, mut sticks) = (never, never);
        let (mut mean, mut count) = ([zero; 2], zero);
        let (mut highest, mut lowest) = (first.gap.of(f64::MIN), first.gap.of(f64::MAX));
        let mut slip = zero;
        for (foot, link) in self.feet.iter_mut().zip(which) {
            let now = &steps[*link].contact;
            let carries = zero.lt(now.normal);
            let loaded = now.gap.lt(zero) & carries;
            impact = impact | (zero.lt(foot.gap) & now.gap.le(zero));
            sticks = sticks | (loaded & now.slipping.le(zero));
            for k in 0..2 {
                mean[k] = mean[k] + (now.position[k] - foot.position[k]).only(loaded);
            }
            count = count + one.only(loaded);
            highest = highest.max(now.gap);
            lowest = lowest.min(now.gap);
            let x = now.position[0] - foot.start[0];
            let y = now.position[1] - foot.start[1];
            let far = length(x, y, self.plane);
            foot.slip = R::mix(carries, far, foot.slip);
            slip = slip.max(foot.slip);
            foot.gap = now.gap;
            foot.position = now.position;
        }
        let moved = zero.lt(count) & !sticks;
        let slides = zero.any(moved);
        let (mut slid, mut reversal) = (zero, never);
        if slides {
            let count = count.max(one);
            mean = [mean[0] / count, mean[1] / count];
            let along = mean[0] * self.direction[0] + mean[1] * self.direction[1];
            reversal = moved & along.lt(zero);
            slid = length(mean[0], mean[1], self.plane).only(moved);
            let turned = zero.lt(slid);
            for k in 0..2 {
                self.direction[k] = R::mix(turned, mean[k], self.direction[k]);
            }
        }
        self.fresh = self.fresh.only(!(impact | reversal));
        let rocks = zero.lt(highest) & lowest.le(zero);
        let flies = zero.lt(lowest);
        let rocked = R::select(rocks, highest, (highest - lowest).only(flies));
        let flew = lowest.only(flies);
        self.whole.slid = self.whole.slid + slid;
        self.whole.rocked = self.whole.rocked.max(rocked);
        self.whole.flew = self.whole.flew.max(flew);
        let fresh = zero.lt(self.fresh);
        self.initial.slid = self.initial.slid + slid.only(fresh);
        self.initial.rocked = self.initial.rocked.max(rocked.only(fresh));
        self.initial.flew = self.initial.flew.max(flew.only(fresh));
        self.max_uplift = self.max_uplift.max(highest);
        self.max_slip = self.max_slip.max(slip);
        self.residual = slip;
    }

    /// Takes the other where the mask says no.
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
