//! Extremes of outputs, between the steps as well.

use serde::Serialize;
use trilith_element::lanes::{Arithmetic, Real};

/// Extremes of one quantity, with their times in s.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Extremes {
    /// Largest value.
    pub max: f64,
    /// When it was reached first.
    pub t_max: f64,
    /// Smallest value.
    pub min: f64,
    /// When it was reached first.
    pub t_min: f64,
    /// Value at the end.
    #[serde(rename = "final")]
    pub last: f64,
}

/// Time and value of the extremes, strictly inside, of the cubic Hermite polynomial between two moments
/// of (time, value, rate); none where a rate is not a number.
#[must_use]
pub fn inner_extremes(
    (t0, y0, r0): (f64, f64, f64),
    (t1, y1, r1): (f64, f64, f64),
) -> [Option<(f64, f64)>; 2] {
    let h = t1 - t0;
    let (m0, m1) = (h * r0, h * r1);
    // p(s) = y0 + m0 s + (3Δ − 2m0 − m1) s² + (m0 + m1 − 2Δ) s³ with s = (t − t0)/h, Δ = y1 − y0.
    let rise = y1 - y0;
    let (c2, c3) = (3.0 * rise - 2.0 * m0 - m1, m0 + m1 - 2.0 * rise);
    // p' = m0 + 2 c2 s + 3 c3 s²; q avoids cancellation, and c3 = 0 leaves the root m0/q.
    let discriminant = c2 * c2 - 3.0 * c3 * m0;
    if discriminant.is_nan() || discriminant < 0.0 {
        return [None; 2];
    }
    let q = -(c2 + discriminant.sqrt().copysign(c2));
    [m0 / q, q / (3.0 * c3)].map(|s| {
        let inside = s > 0.0 && s < 1.0;
        inside.then_some((t0 + s * h, y0 + s * (m0 + s * (c2 + s * c3))))
    })
}

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
        t0: R,
        dt: R,
        y: R,
        rate: Option<R>,
    ) {
        let t1 = t0 + dt;
        if let Some(rate) = rate {
            let third = dt * y.of(1.0 / 3.0);
            let first = third.mul_add(self.rate, self.y);
            let second = (-third).mul_add(rate, y);
            let above = self.max.max(y).lt(first.max(second));
            let below = first.min(second).lt(self.min.min(y));
            if y.any(above | below) {
                self.look_inside(with, t0, t1, y, rate);
            }
            self.rate = rate;
        }
        let (up, down) = (self.max.lt(y), y.lt(self.min));
        if y.any(up | down) {
            self.max = self.max.max(y);
            self.t_max = R::mix(up, t1, self.t_max);
            self.min = self.min.min(y);
            self.t_min = R::mix(down, t1, self.t_min);
        }
        self.y = y;
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

    pub(super) fn of_lane<A: Arithmetic<Real = R>>(&self, with: A, lane: usize) -> Extremes {
        let of = |x: R| with.lane(x, lane);
        Extremes {
            max: of(self.max),
            t_max: of(self.t_max),
            min: of(self.min),
            t_min: of(self.t_min),
            last: of(self.y),
        }
    }
}
