//! How far a Newton correction goes, lane by lane: the line search of the ordinary [`kernel`](crate::kernel).

use super::coefficients::Rule;
use super::small::{Aligned, times};
use crate::kernel::{CROSSES, ENOUGH, SEARCH_FROM, TRIED};
use trilith_element::lanes::Real;

/// Line search of a step.
pub(super) struct Search<R, const L: usize> {
    /// The last correction of the forces, the residual before it and its size, and what it moves.
    step: Aligned<[R; L]>,
    residual: Aligned<[R; L]>,
    before: R,
    way: Aligned<[R; L]>,
    /// Part of it that is made; the largest known as too little, and the smallest as too much; residuals along the way
    /// there.
    share: R,
    ends: [R; 2],
    along: [R; 2],
    /// Parts tried.
    tried: R,
}

impl<R: Real, const L: usize> Search<R, L> {
    #[inline(always)]
    pub fn new(zero: R) -> Self {
        let none = Aligned([zero; L]);
        Self {
            step: none,
            residual: none,
            before: zero,
            way: none,
            share: zero,
            ends: [zero; 2],
            along: [zero; 2],
            tried: zero,
        }
    }

    /// What more of their last corrections those in `who` make, or less, and who does so: the residual of this size is no
    /// better than that before; `n`: coordinates.
    #[inline(always)]
    pub fn goes_on<const M: usize>(
        &mut self,
        rule: &Rule<R, M, L>,
        (n, iteration): (usize, usize),
        (residual, size): (&[R; L], R),
        who: R::Mask,
    ) -> (R, R::Mask) {
        let zero = size.of(0.0);
        let nobody = zero.lt(zero);
        if iteration < SEARCH_FROM {
            return (zero, nobody);
        }
        let begins = self.tried.le(zero);
        let worse = (size.of(ENOUGH) * self.before).lt(size);
        let open = self.tried.lt(size.of(TRIED as f64)) & (worse | !begins) & who;
        if !zero.any(open) {
            return (zero, nobody);
        }
        if zero.any(open & begins) {
            let moved = times((n, n), &rule.g, &self.step);
            let mut all = zero;
            for a in 0..n {
                self.way[a] = R::select(begins, -moved[a], self.way[a]);
                all = self.way[a].mul_add(self.residual[a], all);
            }
            self.along[0] = R::select(begins, all, self.along[0]);
        }
        let mut along = zero;
        for a in 0..n {
            along = self.way[a].mul_add(residual[a], along);
        }
        let one = size.of(1.0);
        let short = !begins & zero.lt(along);
        let [first, last] = self.along;
        let of_side =
            R::select(short, first * (one - self.share), last.abs() * (self.share / self.ends[1]));
        let crosses = !begins & along.abs().lt(size.of(CROSSES) * of_side);
        let goes_on = open & !crosses;
        self.ends[0] = R::select(goes_on & short, self.share, self.ends[0]);
        self.ends[1] = R::select(goes_on & !short, self.share, self.ends[1]);
        self.along[1] = R::select(goes_on & !short, along, self.along[1]);
        self.tried = self.tried + one.only(goes_on);
        let share = size.of(0.5) * (self.ends[0] + self.ends[1]);
        let more = (share - self.share).only(goes_on);
        self.share = R::select(goes_on, share, self.share);
        (more, goes_on)
    }

    /// The last correction.
    pub fn step(&self) -> &[R; L] {
        &self.step
    }

    /// Takes note of corrections that those in a mask are about to make, and of the residuals before; `n`: coordinates.
    #[inline(always)]
    pub fn goes(&mut self, n: usize, who: R::Mask, step: &[R; L], (residual, size): (&[R; L], R)) {
        let (zero, one) = (size.of(0.0), size.of(1.0));
        for a in 0..n {
            self.step[a] = R::select(who, step[a], self.step[a]);
            self.residual[a] = R::select(who, residual[a], self.residual[a]);
        }
        self.before = R::select(who, size, self.before);
        self.share = R::select(who, one, self.share);
        self.ends = [R::select(who, zero, self.ends[0]), R::select(who, one, self.ends[1])];
        self.tried = R::select(who, zero, self.tried);
    }
}
