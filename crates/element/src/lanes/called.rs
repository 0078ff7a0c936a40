//! Numbers whose operations are calls.

use super::Real;
use std::ops::{Add, Deref, DerefMut, Div, Mul, Neg, Sub};

/// A number whose operations are calls and not a part of the law that asks for them: much less code for a large number, such as one with
/// [many derivatives](super::Dual), of which every operation is a loop.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Called<R>(pub R);

impl<R> Deref for Called<R> {
    type Target = R;
    #[inline(always)]
    fn deref(&self) -> &R {
        &self.0
    }
}

impl<R> DerefMut for Called<R> {
    #[inline(always)]
    fn deref_mut(&mut self) -> &mut R {
        &mut self.0
    }
}

macro_rules! operators {
    ($($trait:ident $name:ident),*) => {$(
        impl<R: Real> $trait for Called<R> {
            type Output = Self;
            #[inline(never)]
            fn $name(self, o: Self) -> Self {
                Self(self.0.$name(o.0))
            }
        }
    )*};
}

operators!(Add add, Sub sub, Mul mul, Div div);

impl<R: Real> Neg for Called<R> {
    type Output = Self;
    #[inline(never)]
    fn neg(self) -> Self {
        Self(-self.0)
    }
}

macro_rules! functions {
    ($($name:ident),*) => {$(
        #[inline(never)]
        fn $name(self) -> Self {
            Self(self.0.$name())
        }
    )*};
}

impl<R: Real> Real for Called<R> {
    type Mask = R::Mask;
    const DERIVATIVES: bool = R::DERIVATIVES;

    functions!(abs, sqrt, exp, exp_by_vectors, ln, ln_1p, tanh, cbrt, fixed);

    #[inline(never)]
    fn of(self, x: f64) -> Self {
        Self(self.0.of(x))
    }
    #[inline(never)]
    fn mul_add(self, a: Self, b: Self) -> Self {
        Self(self.0.mul_add(a.0, b.0))
    }
    #[inline(never)]
    fn exp_and_m1(self) -> [Self; 2] {
        self.0.exp_and_m1().map(Self)
    }
    #[inline(never)]
    fn powf(self, a: Self) -> Self {
        Self(self.0.powf(a.0))
    }
    #[inline(always)]
    fn lt(self, o: Self) -> Self::Mask {
        self.0.lt(o.0)
    }
    #[inline(always)]
    fn le(self, o: Self) -> Self::Mask {
        self.0.le(o.0)
    }
    #[inline(never)]
    fn select(mask: Self::Mask, yes: Self, no: Self) -> Self {
        Self(R::select(mask, yes.0, no.0))
    }
    #[inline(always)]
    fn any(self, mask: Self::Mask) -> bool {
        self.0.any(mask)
    }
    #[inline(never)]
    fn map(self, f: impl Fn(f64) -> f64) -> Self {
        Self(self.0.map(f))
    }
    #[inline(never)]
    fn map2(self, o: Self, f: impl Fn(f64, f64) -> f64) -> Self {
        Self(self.0.map2(o.0, f))
    }
    #[inline(never)]
    fn map_pair(self, f: impl Fn(f64) -> [f64; 2]) -> [Self; 2] {
        self.0.map_pair(f).map(Self)
    }
}

#[cfg(test)]
mod tests {
    use super::super::Dual;
    use super::*;

    fn law<R: Real>(x: R, y: R) -> R {
        let [grown, more] = (x * y).exp_and_m1();
        let bent = R::select(x.lt(y), grown / y, more - x.mul_add(y, x.of(2.0)).abs());
        -bent + x.hypot(y).sqrt() * y.tanh().powf(x.of(0.5)) + x.map(f64::sin) + y.ln().cbrt()
    }

    #[test]
    fn they_are_the_numbers_that_they_are_made_of() {
        for (x, y) in [(0.7, 1.4), (1.9, 0.3)] {
            let (x, y) = (Dual::<2>::variable(x, 0), Dual::variable(y, 1));
            assert_eq!(law(Called(x), Called(y)).0, law(x, y));
        }
    }
}
