//! Extremes of outputs, between the steps as well.

use crate::record::peak::{self, inner_extremes};
use trilith_element::lanes::{Arithmetic, Real};

/// So many outputs are looked at together, where an analysis goes alone.
pub(super) const TOGETHER: usize = 4;

/// Extremes of `K` outputs in lanes.
#[derive(Clone, Copy)]
#[repr(align(32))]
pub(super) struct Peaks<R, const K: usize> {
    y: [R; K],
    rate: [R; K],
    max: [R; K],
    t_max: [R; K],
    min: [R; K],
    t_min: [R; K],
}

impl<R: Real, const K: usize> Peaks<R, K> {
    pub(super) fn new(y: [R; K], rate: [R; K]) -> Self {
        let zero = [y[0].of(0.0); K];
        Self { y, rate, max: y, t_max: zero, min: y, t_min: zero }
    }

    /// The value of one of them, and its rate where it has one.
    #[inline(always)]
    pub(super) fn now(&self, k: usize) -> [R; 2] {
        [self.y[k], self.rate[k]]
    }

    /// The next moment. The polynomial between two moments lies in the hull of its Bézier points: only
    /// where these pass an extreme is it looked at.
    #[inline(always)]
    pub(super) fn advance<A: Arithmetic<Real = R>>(
        &mut self,
        with: A,
        (t0, dt, third): (R, R, R),
        y: [R; K],
        rate: Option<[R; K]>,
    ) {
        let (mut high, mut low) = (y, y);
        if let Some(rate) = rate {
            for i in 0..K {
                let first = third.mul_add(self.rate[i], self.y[i]);
                let second = (-third).mul_add(rate[i], y[i]);
                high[i] = high[i].max(first).max(second);
                low[i] = low[i].min(first).min(second);
            }
        }
        let mut beyond = self.max[0].lt(high[0]) | low[0].lt(self.min[0]);
        for i in 1..K {
            beyond = beyond | (self.max[i].lt(high[i]) | low[i].lt(self.min[i]));
        }
        if y[0].any(beyond) {
            self.pass(with, (t0, t0 + dt), (y, rate), (high, low));
        }
        self.y = y;
        if let Some(rate) = rate {
            self.rate = rate;
        }
    }

    /// Some output passes an extreme, or may do so on its way from `t0` to `t1`.
    #[inline(always)]
    fn pass<A: Arithmetic<Real = R>>(
        &mut self,
        with: A,
        (t0, t1): (R, R),
        (y, rate): ([R; K], Option<[R; K]>),
        (high, low): ([R; K], [R; K]),
    ) {
        for i in 0..K {
            let y = y[i];
            let inside = self.max[i].max(y).lt(high[i]) | low[i].lt(self.min[i].min(y));
            if let Some(rate) = rate
                && y.any(inside)
            {
                let who = y.of(1.0).only(inside);
                self.look_inside(with, (i, who), (t0, t1), (y, rate[i]));
            }
            let (up, down) = (self.max[i].lt(y), y.lt(self.min[i]));
            // Of zeros of two signs the first stays, whoever asks: a neighbour may have led here.
            self.max[i] = R::select(up, y, self.max[i]);
            self.t_max[i] = R::mix(up, t1, self.t_max[i]);
            self.min[i] = R::select(down, y, self.min[i]);
            self.t_min[i] = R::mix(down, t1, self.t_min[i]);
        }
    }

    /// `who`: 1 of those that do, else 0. It is apart from its caller, and so not compiled for registers.
    #[inline(never)]
    fn look_inside<A: Arithmetic<Real = R>>(
        &mut self,
        with: A,
        (k, who): (usize, R),
        (t0, t1): (R, R),
        (y, rate): (R, R),
    ) {
        let of = |x: R| -> [f64; 8] {
            std::array::from_fn(|i| if i < A::WIDTH { with.lane(x, i) } else { 0.0 })
        };
        let who = of(who);
        let (t0, t1, y0, y1) = (of(t0), of(t1), of(self.y[k]), of(y));
        let (r0, r1) = (of(self.rate[k]), of(rate));
        let mut to = [self.max[k], self.t_max[k], self.min[k], self.t_min[k]].map(of);
        // Others would find their own rounding where a neighbour has an extreme.
        for i in (0..A::WIDTH).filter(|i| who[*i] == 1.0) {
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
        (self.max[k], self.t_max[k]) = (max, t_max);
        (self.min[k], self.t_min[k]) = (min, t_min);
    }

    /// Takes the other where the mask says no.
    #[inline(always)]
    pub(super) fn keep(&mut self, mask: R::Mask, other: &Self) {
        for (x, y) in [
            (&mut self.y, &other.y),
            (&mut self.rate, &other.rate),
            (&mut self.max, &other.max),
            (&mut self.t_max, &other.t_max),
            (&mut self.min, &other.min),
            (&mut self.t_min, &other.t_min),
        ] {
            for (x, y) in x.iter_mut().zip(y) {
                *x = R::select(mask, *x, *y);
            }
        }
    }

    /// Of one output and one lane.
    pub(super) fn of_lane<A: Arithmetic<Real = R>>(
        &self,
        with: A,
        k: usize,
        lane: usize,
    ) -> peak::Peak {
        let of = |x: R| with.lane(x, lane);
        peak::Peak {
            max: of(self.max[k]),
            t_max: of(self.t_max[k]),
            min: of(self.min[k]),
            t_min: of(self.t_min[k]),
            last: of(self.y[k]),
        }
    }
}
