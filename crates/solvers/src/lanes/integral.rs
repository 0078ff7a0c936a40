//! What is taken over time of an output: its mean square, or how long it is above a value.

use trilith_element::lanes::Real;

/// An integral over the straight lines between the moments of an output, of one analysis or of several side by side.
#[derive(Clone, Copy, Debug)]
pub struct Integral<R> {
    /// The value to be above; none: root of the mean square.
    above: Option<R>,
    y: R,
    time: R,
    sum: R,
}

impl<R: Real> Integral<R> {
    /// From a first value on. `above`: the time above a value is wanted, else the root of the mean square.
    #[inline(always)]
    #[must_use]
    pub fn new(y: R, above: Option<f64>) -> Self {
        let zero = y.of(0.0);
        Self { above: above.map(|x| y.of(x)), y, time: zero, sum: zero }
    }

    /// The next value, `dt` later.
    #[inline(always)]
    pub fn advance(&mut self, dt: R, y: R) {
        let zero = y.of(0.0);
        let before = std::mem::replace(&mut self.y, y);
        let share = match self.above {
            None => (before * before + before * y + y * y) * y.of(1.0 / 3.0),
            Some(limit) => {
                let (a, b) = (before - limit, y - limit);
                let (first, second) = (zero.lt(a), zero.lt(b));
                let over = a.max(b);
                let crossing = over / (over - a.min(b));
                R::select(first & second, y.of(1.0), crossing.only(first | second))
            }
        };
        self.time = self.time + dt;
        self.sum = self.sum + dt * share;
    }

    /// What it has come to.
    #[must_use]
    pub fn value(&self) -> R {
        let zero = self.sum.of(0.0);
        match self.above {
            Some(_) => self.sum,
            None => R::select(zero.lt(self.time), (self.sum / self.time).sqrt(), self.y.abs()),
        }
    }

    /// Takes the other where the mask says no.
    #[inline(always)]
    pub(super) fn keep(&mut self, mask: R::Mask, other: &Self) {
        self.y = R::select(mask, self.y, other.y);
        self.time = R::select(mask, self.time, other.time);
        self.sum = R::select(mask, self.sum, other.sum);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A triangle from 0 over 2 to −1, in 1 s each.
    #[test]
    fn they_are_those_of_straight_lines() {
        let of = |above| {
            let mut it = Integral::new(0.0, above);
            [2.0, -1.0].into_iter().for_each(|y| it.advance(1.0, y));
            it.value()
        };
        assert!((of(None) - f64::sqrt((4.0 / 3.0 + 1.0) / 2.0)).abs() < 1e-15);
        assert!((of(Some(1.0)) - (0.5 + 1.0 / 3.0)).abs() < 1e-15);
        assert_eq!((of(Some(2.0)), of(Some(-2.0))), (0.0, 2.0));
        assert_eq!(Integral::new(-3.0, None).value(), 3.0);
    }
}
