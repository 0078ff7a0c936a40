//! Extremes of a quantity known at the substeps of a run.

use serde::{Deserialize, Serialize};

/// Extremes of one quantity, with their times in s.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Peak {
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

impl Peak {
    /// The extremes of a quantity that has only been seen once.
    #[must_use]
    pub fn new(t: f64, value: f64) -> Self {
        Self { max: value, t_max: t, min: value, t_min: t, last: value }
    }

    /// The larger of |max| and |min|.
    #[must_use]
    pub fn magnitude(&self) -> f64 {
        self.max.abs().max(self.min.abs())
    }

    /// True where all of it are numbers.
    #[must_use]
    pub fn is_finite(&self) -> bool {
        [self.max, self.t_max, self.min, self.t_min, self.last].iter().all(|x| x.is_finite())
    }

    fn include(&mut self, t: f64, value: f64) {
        if value > self.max {
            (self.max, self.t_max) = (value, t);
        }
        if value < self.min {
            (self.min, self.t_min) = (value, t);
        }
    }

    /// Takes the next moment of the quantity, `(t, value, rate)` each; the rates may be NaN.
    #[inline]
    pub fn advance(&mut self, from: (f64, f64, f64), to: (f64, f64, f64)) {
        self.last = to.1;
        if !self.holds(from, to) {
            self.look_inside(from, to);
        }
    }

    /// True where nothing between two moments can be new: the cubic between them lies in the hull of its Bézier points. A rate
    /// that is not a number holds nothing.
    #[inline]
    fn holds(&self, (t0, y0, r0): (f64, f64, f64), (t1, y1, r1): (f64, f64, f64)) -> bool {
        let third = (t1 - t0) / 3.0;
        let is_known = |y: f64| (self.min <= y) & (y <= self.max);
        is_known(y0) & is_known(y0 + third * r0) & is_known(y1 - third * r1) & is_known(y1)
    }

    fn look_inside(&mut self, from: (f64, f64, f64), to: (f64, f64, f64)) {
        for (t, value) in inner_extremes(from, to).into_iter().flatten() {
            self.include(t, value);
        }
        self.include(to.0, to.1);
    }
}

/// An extreme that is nearer to an end than this share of the step is that end, but for rounding.
const AT_END: f64 = 1e-9;

/// Time and value of the extremes, strictly inside, of the cubic Hermite polynomial between two moments
/// of (time, value, rate); none where a rate is not a number.
pub(crate) fn inner_extremes(
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
        let inside = s > AT_END && s < 1.0 - AT_END;
        inside.then_some((t0 + s * h, y0 + s * (m0 + s * (c2 + s * c3))))
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    /// What starts to fall from zero by rounding is largest at its start, and not 1e-20 s behind it.
    #[test]
    fn an_extreme_beside_an_end_is_that_end() {
        let mut peak = Peak::new(0.0, 0.0);
        peak.advance((0.0, 0.0, 1e-17), (1e-3, -1e-6, -2e-3));
        assert_eq!((peak.max, peak.t_max), (0.0, 0.0));
    }

    #[test]
    fn the_peak_of_a_parabola_between_two_moments_is_exact() {
        let y = |t: f64| 3.0 - 2.0 * (t - 0.25) * (t - 0.25);
        let r = |t: f64| -4.0 * (t - 0.25);
        let mut peak = Peak::new(0.0, y(0.0));
        peak.advance((0.0, y(0.0), r(0.0)), (1.0, y(1.0), r(1.0)));
        assert_eq!((peak.max, peak.t_max), (3.0, 0.25));
        assert_eq!((peak.min, peak.t_min, peak.last), (y(1.0), 1.0, y(1.0)));
    }

    #[test]
    fn both_extremes_of_a_cubic_are_found() {
        // (t − 1)(t − 2)(t − 3): extremes at 2 ∓ 1/√3, values ± 2/(3√3).
        let y = |t: f64| (t - 1.0) * (t - 2.0) * (t - 3.0);
        let r = |t: f64| 3.0 * t * t - 12.0 * t + 11.0;
        let mut peak = Peak::new(1.0, 0.0);
        peak.advance((1.0, y(1.0), r(1.0)), (3.0, y(3.0), r(3.0)));
        let (value, shift) = (2.0 / 27f64.sqrt(), 1.0 / 3f64.sqrt());
        for (is, should) in [
            (peak.max, value),
            (peak.min, -value),
            (peak.t_max, 2.0 - shift),
            (peak.t_min, 2.0 + shift),
        ] {
            assert!((is - should).abs() < 1e-14, "{is} {should}");
        }
    }

    /// However it wavers: the extremes of all pieces, looked into one by one, are those of all of it.
    #[test]
    fn what_is_passed_over_holds_nothing_new() {
        let of = |a: f64, t: f64| (a * t).sin() * (1.0 - 0.3 * (0.7 * t).cos());
        let rate = |a: f64, t: f64| {
            a * (a * t).cos() * (1.0 - 0.3 * (0.7 * t).cos())
                + (a * t).sin() * 0.21 * (0.7 * t).sin()
        };
        for a in [0.3, 1.0, 2.9] {
            let moment = |i: u32| {
                let t = 0.37 * f64::from(i);
                (t, of(a, t), rate(a, t))
            };
            let (mut peak, mut each) = (Peak::new(0.0, 0.0), Peak::new(0.0, 0.0));
            for i in 0..400 {
                peak.advance(moment(i), moment(i + 1));
                each.look_inside(moment(i), moment(i + 1));
            }
            each.last = moment(400).1;
            assert_eq!(peak, each);
        }
    }

    #[test]
    fn unknown_rates_leave_the_values_at_the_substeps() {
        let mut peak = Peak::new(0.0, 1.0);
        peak.advance((0.0, 1.0, f64::NAN), (1.0, 1.5, f64::NAN));
        peak.advance((1.0, 1.5, f64::NAN), (2.0, -1.0, f64::NAN));
        assert_eq!(peak, Peak { max: 1.5, t_max: 1.0, min: -1.0, t_min: 2.0, last: -1.0 });
    }

    #[test]
    fn a_straight_line_and_a_rest_have_no_inner_extreme() {
        let mut peak = Peak::new(0.0, 1.0);
        peak.advance((0.0, 1.0, 0.0), (1.0, 1.0, 0.0));
        peak.advance((1.0, 1.0, 2.0), (2.0, 3.0, 2.0));
        assert_eq!((peak.max, peak.t_max, peak.min, peak.t_min), (3.0, 2.0, 1.0, 0.0));
    }
}
