//! Numbers with their derivatives by some variables, exact to rounding.
//!
//! A law over [`Real`] that is asked in them answers with its derivatives by whatever the variables are: deformation, rate,
//! history, step, parameters. Comparisons look at values alone, so the derivative is that of the branch that is taken; at a switch
//! between two branches it is that of one of them.

use super::Real;
use super::each::each;
use std::ops::{Add, Div, Mul, Neg, Sub};

/// A value and its derivatives by `N` variables, 24 at most.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Dual<const N: usize = 2, R = f64> {
    /// Value.
    pub x: R,
    /// Derivatives.
    pub by: [R; N],
}

impl<const N: usize, R: Real> Dual<N, R> {
    /// A number that no variable moves.
    #[inline(always)]
    #[must_use]
    pub fn constant(x: R) -> Self {
        Self { x, by: [x.of(0.0); N] }
    }

    /// The variable `i`; a constant where there are none.
    #[inline(always)]
    #[must_use]
    pub fn variable(x: R, i: usize) -> Self {
        let mut it = Self::constant(x);
        if N > 0 {
            it.by[i] = x.of(1.0);
        }
        it
    }

    /// Three variables from `i` on.
    #[inline(always)]
    #[must_use]
    pub fn variables(x: &[R], i: usize) -> [Self; 3] {
        [Self::variable(x[0], i), Self::variable(x[1], i + 1), Self::variable(x[2], i + 2)]
    }

    /// A function of it with this value and derivative.
    #[inline(always)]
    #[must_use]
    pub fn map(mut self, x: R, slope: R) -> Self {
        self.x = x;
        each!(N, i => self.by[i] = self.by[i] * slope);
        self
    }

    /// A function of it and another with this value and these derivatives.
    #[inline(always)]
    #[must_use]
    pub fn with(mut self, o: Self, x: R, slope: R, other: R) -> Self {
        self.x = x;
        each!(N, i => self.by[i] = slope.mul_add(self.by[i], other * o.by[i]));
        self
    }

    /// Root of a number above zero.
    #[inline(always)]
    #[must_use]
    pub fn sqrt(self) -> Self {
        let root = self.x.sqrt();
        self.map(root, root.of(0.5) / root)
    }

    /// The first where yes, the second where no.
    #[inline(always)]
    #[must_use]
    pub fn select(mask: R::Mask, yes: Self, no: Self) -> Self {
        let mut it = yes;
        it.x = R::select(mask, yes.x, no.x);
        each!(N, i => it.by[i] = R::select(mask, yes.by[i], no.by[i]));
        it
    }

    /// The number where yes, zero where no.
    #[inline(always)]
    #[must_use]
    pub fn only(self, mask: R::Mask) -> Self {
        Self::select(mask, self, Self::constant(self.x.of(0.0)))
    }
}

impl<const N: usize, R: Real> Add for Dual<N, R> {
    type Output = Self;
    #[inline(always)]
    fn add(mut self, o: Self) -> Self {
        self.x = self.x + o.x;
        each!(N, i => self.by[i] = self.by[i] + o.by[i]);
        self
    }
}

impl<const N: usize, R: Real> Neg for Dual<N, R> {
    type Output = Self;
    #[inline(always)]
    fn neg(mut self) -> Self {
        self.x = -self.x;
        each!(N, i => self.by[i] = -self.by[i]);
        self
    }
}

impl<const N: usize, R: Real> Sub for Dual<N, R> {
    type Output = Self;
    #[inline(always)]
    fn sub(mut self, o: Self) -> Self {
        self.x = self.x - o.x;
        each!(N, i => self.by[i] = self.by[i] - o.by[i]);
        self
    }
}

impl<const N: usize, R: Real> Mul for Dual<N, R> {
    type Output = Self;
    #[inline(always)]
    fn mul(self, o: Self) -> Self {
        self.with(o, self.x * o.x, o.x, self.x)
    }
}

impl<const N: usize, R: Real> Mul<R> for Dual<N, R> {
    type Output = Self;
    #[inline(always)]
    fn mul(self, o: R) -> Self {
        self.map(self.x * o, o)
    }
}

impl<const N: usize, R: Real> Add<R> for Dual<N, R> {
    type Output = Self;
    #[inline(always)]
    fn add(self, o: R) -> Self {
        Self { x: self.x + o, by: self.by }
    }
}

impl<const N: usize, R: Real> Div for Dual<N, R> {
    type Output = Self;
    #[inline(always)]
    fn div(self, o: Self) -> Self {
        let back = o.x.of(1.0) / o.x;
        let x = self.x / o.x;
        self.with(o, x, back, -x * back)
    }
}

/// Share of an argument by which it is moved to find the slope of a function that is known by its values alone.
const MOVED: f64 = 1e-3;

/// Slope of a function at a number: central difference of fourth order, off by some 1e-12 where the function is smooth.
#[inline(always)]
fn slope<R: Real>(x: R, f: impl Fn(R) -> R) -> R {
    let (zero, least) = (x.of(0.0), x.of(f64::MIN_POSITIVE.sqrt()));
    let size = x.abs();
    // A power of two of the step would lose nothing; the step that is made counts instead.
    let h = (x + (size * x.of(MOVED)).max(least)) - x;
    let step = R::select(zero.lt(h), h, least);
    let two = x.of(2.0);
    let near = f(x + step) - f(x - step);
    let far = f(x + two * step) - f(x - two * step);
    (x.of(8.0) * near - far) / (x.of(12.0) * step)
}

impl<const N: usize, R: Real> Real for Dual<N, R> {
    type Mask = R::Mask;
    const DERIVATIVES: bool = true;

    #[inline(always)]
    fn of(self, x: f64) -> Self {
        Self::constant(self.x.of(x))
    }
    #[inline(always)]
    fn mul_add(self, a: Self, b: Self) -> Self {
        let mut it = b;
        it.x = self.x.mul_add(a.x, b.x);
        each!(N, i => it.by[i] = self.x.mul_add(a.by[i], a.x.mul_add(self.by[i], b.by[i])));
        it
    }
    #[inline(always)]
    fn abs(self) -> Self {
        let (zero, one) = (self.x.of(0.0), self.x.of(1.0));
        self.map(self.x.abs(), R::select(self.x.lt(zero), -one, one))
    }
    /// At zero, where the slope is beyond all bounds, it counts as zero.
    #[inline(always)]
    fn sqrt(self) -> Self {
        let (zero, root) = (self.x.of(0.0), self.x.sqrt());
        self.map(root, (root.of(0.5) / root).only(zero.lt(root)))
    }
    #[inline(always)]
    fn exp(self) -> Self {
        let value = self.x.exp();
        self.map(value, value)
    }
    #[inline(always)]
    fn fixed(self) -> Self {
        Self::constant(self.x.fixed())
    }
    #[inline(always)]
    fn exp_by_vectors(self) -> Self {
        let value = self.x.exp_by_vectors();
        self.map(value, value)
    }
    #[inline(always)]
    fn exp_and_m1(self) -> [Self; 2] {
        let [value, less] = self.x.exp_and_m1();
        [self.map(value, value), self.map(less, value)]
    }
    #[inline(always)]
    fn ln(self) -> Self {
        self.map(self.x.ln(), self.x.of(1.0) / self.x)
    }
    #[inline(always)]
    fn ln_1p(self) -> Self {
        let one = self.x.of(1.0);
        self.map(self.x.ln_1p(), one / (one + self.x))
    }
    #[inline(always)]
    fn tanh(self) -> Self {
        let t = self.x.tanh();
        self.map(t, t.of(1.0) - t * t)
    }
    /// At zero, where the slope is beyond all bounds, it counts as zero.
    #[inline(always)]
    fn cbrt(self) -> Self {
        let (zero, root) = (self.x.of(0.0), self.x.cbrt());
        let slope = root / (self.x.of(3.0) * self.x);
        self.map(root, slope.only(zero.lt(self.x.abs())))
    }
    /// At zero it counts as if nothing moved.
    #[inline(always)]
    fn powf(self, a: Self) -> Self {
        let value = self.x.powf(a.x);
        let above = self.x.of(0.0).lt(self.x);
        let slope = (a.x * value / self.x).only(above);
        let mut it = self.map(value, slope);
        let by_power = value * self.x.ln();
        each!(N, i => it.by[i] = it.by[i] + (by_power * a.by[i]).only(above));
        it
    }
    #[inline(always)]
    fn lt(self, o: Self) -> Self::Mask {
        self.x.lt(o.x)
    }
    #[inline(always)]
    fn le(self, o: Self) -> Self::Mask {
        self.x.le(o.x)
    }
    #[inline(always)]
    fn select(mask: Self::Mask, yes: Self, no: Self) -> Self {
        Dual::select(mask, yes, no)
    }
    #[inline(always)]
    fn any(self, mask: Self::Mask) -> bool {
        self.x.any(mask)
    }
    /// The slope is a difference quotient: nothing is known of the function but its values.
    #[inline(always)]
    fn map(self, f: impl Fn(f64) -> f64) -> Self {
        Dual::map(self, self.x.map(&f), slope(self.x, |x| x.map(&f)))
    }
    #[inline(always)]
    fn map2(self, o: Self, f: impl Fn(f64, f64) -> f64) -> Self {
        let own = slope(self.x, |x| x.map2(o.x, &f));
        let other = slope(o.x, |x| self.x.map2(x, &f));
        self.with(o, self.x.map2(o.x, &f), own, other)
    }
    #[inline(always)]
    fn map_pair(self, f: impl Fn(f64) -> [f64; 2]) -> [Self; 2] {
        let values = self.x.map_pair(&f);
        [0, 1].map(|i| Dual::map(self, values[i], slope(self.x, |x| x.map_pair(&f)[i])))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Something of everything that a law may do.
    fn law<R: Real>(x: R, y: R) -> R {
        let far = x.hypot(y).sqrt() * (-x).exp() + x.map(f64::tanh) / y.mul_add(y, x.of(1.0));
        let near = x.map_pair(|x| [x.sin(), x.cos()]);
        let bent = R::select(x.lt(y), near[0] * y, near[1] - x.abs().min(y.max(x.of(0.3))));
        let [grown, more] = (x * y).exp_and_m1();
        let size = x.abs();
        let smooth = grown * (size.ln() + y.tanh()) - more * y.ln_1p() + size.powf(y) / y.cbrt();
        far + bent.only(y.lt(x.of(2.0))) + x.map2(y, |x, y| x.abs().powf(y)) + smooth
    }

    #[test]
    fn a_law_in_them_answers_with_its_derivatives() {
        let sides = [(0.7, 0.4), (0.4, 0.7), (-0.6, 1.9), (1.3, 2.5), (-2.0, -0.5)];
        for (x, y) in sides {
            let both = law(Dual::<2>::variable(x, 0), Dual::variable(y, 1));
            assert_eq!(both.x.to_bits(), law(x, y).to_bits());
            let h = 1e-3;
            let quotient = |f: &dyn Fn(f64) -> f64| {
                (8.0 * (f(h) - f(-h)) - (f(2.0 * h) - f(-2.0 * h))) / (12.0 * h)
            };
            let expected = [quotient(&|h| law(x + h, y)), quotient(&|h| law(x, y + h))];
            for (given, expected) in both.by.iter().zip(expected) {
                assert!((given - expected).abs() < 1e-9, "{x} {y}: {given} for {expected}");
            }
        }
    }

    #[test]
    fn derivatives_have_derivatives() {
        // ∂²(x³)/∂x² = 6 x
        let x = Dual::<1, Dual<1>>::variable(Dual::variable(0.7, 0), 0);
        let cube = x * x * x;
        assert!((cube.by[0].by[0] - 6.0 * 0.7).abs() < 1e-14);
    }

    #[test]
    fn what_is_fixed_has_no_derivatives() {
        let x = Dual::<1>::variable(0.7, 0);
        let product = x * x.fixed();
        assert_eq!((product.x, product.by), (0.7 * 0.7, [0.7]));
    }

    #[test]
    fn nothing_moves_at_the_root_of_zero() {
        let root = Real::sqrt(Dual::<1>::constant(0.0));
        assert_eq!((root.x, root.by), (0.0, [0.0]));
    }
}
