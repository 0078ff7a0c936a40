//! The way out on a side: from zero force over one or two lines to the backbone.

use super::backbone::Backbone;
use trilith_element::lanes::Real;

/// Share of a deformation or a force that is rounding: before anything has worn out all ways are one line, and none breaks.
const SAME: f64 = 1e-9;

/// Deformations and forces counted outwards.
#[derive(Clone, Copy)]
pub(super) struct Way<R> {
    /// Where the force is zero.
    pub zero: R,
    /// Where the first line ends.
    pub break_at: R,
    pub break_force: R,
    /// Where the second line meets the backbone; not behind `break_at`: there is none.
    pub join: R,
}

/// What a new way aims at.
#[derive(Clone, Copy)]
pub(super) struct Aim<R> {
    /// Largest deformation so far, and more where reloading is accelerated.
    pub reach: R,
    /// The last peak on this side.
    pub peak: [R; 2],
    /// Stiffness of unloading: no line is steeper.
    pub stiffness: R,
    /// 1: pinching, with κ_F and κ_D.
    pub pinching: [R; 3],
}

impl<R: Real> Way<R> {
    /// From zero force at `zero`.
    #[inline(always)]
    pub fn new(zero: R, aim: &Aim<R>, side: &Backbone<R>) -> Self {
        let (nought, one) = (zero.of(0.0), zero.of(1.0));
        let [pinching, kappa_f, kappa_d] = aim.pinching;
        let k = aim.stiffness;
        let force = side.at(aim.reach).0;
        let ahead = zero.lt(aim.reach);
        let straight = R::select(ahead, force / (aim.reach - zero), k);
        let steepest = straight.min(k);
        // The break point of pinching.
        let pinch = (one - kappa_d) * (aim.reach - force / k);
        let behind = zero + zero.of(SAME) * (aim.reach.abs() + zero.abs());
        let pinched = nought.lt(pinching) & behind.lt(pinch) & pinch.lt(aim.reach);
        // The last peak, where the straight way lies below it.
        let [peak, peak_force] = aim.peak;
        let straight_there = straight * (peak - zero);
        let above = straight_there.lt((one - one.of(SAME)) * peak_force) & peak_force.lt(force);
        let through = !pinched & ahead & behind.lt(peak) & peak.lt(aim.reach) & above;
        let at = R::select(pinched, pinch, peak);
        let limit = R::select(pinched, kappa_f * steepest * (at - zero), peak_force);
        let broken = pinched | through;
        let at = R::select(broken, at, zero);
        let reached = limit.min(k * (at - zero)).only(broken);
        let slope = R::select(broken, (force - reached) / (aim.reach - at), straight);
        let join = R::select(k.lt(slope) | !ahead, side.meets(at, reached, k), aim.reach);
        Self {
            zero,
            break_at: R::select(broken, at, join),
            break_force: R::select(broken, reached, side.at(join).0),
            join,
        }
    }

    #[inline(always)]
    pub fn select(mask: R::Mask, yes: Self, no: Self) -> Self {
        Self {
            zero: R::select(mask, yes.zero, no.zero),
            break_at: R::select(mask, yes.break_at, no.break_at),
            break_force: R::select(mask, yes.break_force, no.break_force),
            join: R::select(mask, yes.join, no.join),
        }
    }

    /// The slopes of both lines; 0 for one that is none.
    #[inline(always)]
    pub fn slopes(&self, side: &Backbone<R>) -> [R; 2] {
        let first = self.break_force / (self.break_at - self.zero);
        let rise = side.at(self.join).0 - self.break_force;
        [
            first.only(self.zero.lt(self.break_at)),
            (rise / (self.join - self.break_at)).only(self.break_at.lt(self.join)),
        ]
    }

    /// Force and slope.
    #[inline(always)]
    pub fn at(&self, x: R, slopes: [R; 2], side: &Backbone<R>) -> (R, R) {
        let first = slopes[0] * (x - self.zero);
        let second = slopes[1].mul_add(x - self.break_at, self.break_force);
        let (behind, slope) = side.at(x);
        let on = |first: R, second: R, behind: R| {
            let outer = R::select(x.lt(self.join), second, behind);
            R::select(x.lt(self.break_at), first, outer)
        };
        (on(first, second, behind), on(slopes[0], slopes[1], slope))
    }

    /// ∫ of the force from zero to x, J.
    #[inline(always)]
    pub fn area(&self, x: R, slopes: [R; 2], side: &Backbone<R>) -> R {
        let half = x.of(0.5);
        let length = x.min(self.break_at) - self.zero;
        let more = x.max(self.break_at).min(self.join) - self.break_at;
        let second = (self.break_force + half * slopes[1] * more) * more;
        let second = second.only(self.break_at.lt(self.join));
        let behind = side.area(x) - side.area(self.join);
        half * slopes[0] * length * length + second + behind.only(self.join.lt(x))
    }
}
