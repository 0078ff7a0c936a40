//! Extremes of outputs, between the steps as well.

use crate::peak::{self, inner_extremes};
use trilith_element::lanes::{Arithmetic, Real};

/// Extremes in lanes.
#[derive(Clone, Copy)]
pub(super) struct Peak<R> {
    pub y: R,
    pub rate: R,
    pub max: R,
    pub t_max: R,
    pub min: R,
    pub t_min: R,
}

impl<R: Real> Peak<R> {
    pub(super) fn new(y: R, rate: R) -> Self {
        let zero = y.of(0.0);
        Self { y, rate, max: y, t_max: zero, min: y, t_min: zero }
    }

    /// The next moment. The polynomial between two moments lies in the hull of its Bézier points: only
    /// where these pass an extreme is it looked at.
    #[inline(always)]
    pub(super) fn advance<A: Arithmetic<Real = R>>(
        &mut self,
        with: A,
        (t0, dt, third): (R, R, R),
        y: R,
        rate: Option<R>,
    ) {
        let (mut high, mut low) = (y, y);
        if let Some(rate) = rate {
            let first = third.mul_add(self.rate, self.y);
            let second = (-third).mul_add(rate, y);
            high = high.max(first).max(second);
            low = low.min(first).min(second);
        }
        if y.any(self.max.lt(high) | low.lt(self.min)) {
            let t1 = t0 + dt;
            if let Some(rate) = rate
                && y.any(self.max.max(y).lt(high) | low.lt(self.min.min(y)))
            {
                self.look_inside(with, t0, t1, y, rate);
            }
            let (up, down) = (self.max.lt(y), y.lt(self.min));
            self.max = self.max.max(y);
            self.t_max = R::mix(up, t1, self.t_max);
            self.min = self.min.min(y);
            self.t_min = R::mix(down, t1, self.t_min);
        }
        self.y = y;
        if let Some(rate) = rate {
            self.rate = rate;
        }
    }

    #[inline(never)]
    fn look_inside<A: Arithmetic<Real = R>>(&mut self, with: A, t0: R, t1: R, y: R, rate: R) {
        let of = |x: R| -> [f64; 8] {
            std::array::from_fn(|i| if i < A::WIDTH { with.lane(x, i) } else { 0.0 })
        };
        let (t0, t1, y0, y1) = (of(t0), of(t1), of(self.y), of(y));
        let (r0, r1) = (of(self.rate), of(rate));
        let mut to = [of(self.max), of(self.t_max), of(self.min), of(self.t_min)];
        for i in 0..A::WIDTH {
            let inner = inner_extremes((t0[i], y0[i], r0[i]), (t1[i], y1[i], r1[i]));
            for (t, value) in inner.into_iter().flatten() {
                if value > to[0][i] {
                    (to[0][i], to[1][i]) = (value, t);
                }
                if value < to[2][i] {
                    (to[2][i], to[3][i]) = (value, t);
                }
            }
        }
        let [max, t_max, min, t_min] = to.map(|x| with.gather(|i| x[i]));
        (self.max, self.t_max, self.min, self.t_min) = (max, t_max, min, t_min);
    }

    /// Takes the other where the mask says no.
    pub(super) fn keep(&mut self, mask: R::Mask, other: &Self) {
        let one = |x: R, y: R| R::select(mask, x, y);
        *self = Self {
            y: one(self.y, other.y),
            rate: one(self.rate, other.rate),
            max: one(self.max, other.max),
            t_max: one(self.t_max, other.t_max),
            min: one(self.min, other.min),
            t_min: one(self.t_min, other.t_min),
        };
    }

    pub(super) fn of_lane<A: Arithmetic<Real = R>>(&self, with: A, lane: usize) -> peak::Peak {
        let of = |x: R| with.lane(x, lane);
        peak::Peak {
            max: of(self.max),
            t_max: of(self.t_max),
            min: of(self.min),
            t_min: of(self.t_min),
            last: of(self.y),
        }
    }
}
