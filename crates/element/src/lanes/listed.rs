//! Numbers with derivatives that a law holds by their places in a list.
//!
//! A law is one function, and long. Over numbers of nine `f64` it would be much longer: each operation nine, or a call with three
//! numbers in memory. Here an operation is a call with two places that gives a third: a third of the library's machine code less.

use super::law::{DIRECTIONS, Directions};
use super::{Dual, Real};
use std::cell::RefCell;
use std::ops::{Add, Div, Mul, Neg, Sub};

thread_local! {
    /// The numbers of the law that is asked on this thread, in the order in which they came.
    static NUMBERS: RefCell<Vec<Directions>> = const { RefCell::new(Vec::new()) };
}

/// The place of a number. It holds on its thread, until the list is [begun](Self::begin) anew.
#[derive(Clone, Copy, Debug)]
pub(super) struct Listed(u32);

impl Listed {
    /// Begins the list: no number of before is there any more.
    pub(super) fn begin() {
        NUMBERS.with_borrow_mut(Vec::clear);
    }

    /// Puts a number into the list.
    #[inline(never)]
    pub(super) fn new(number: Directions) -> Self {
        NUMBERS.with_borrow_mut(|all| {
            all.push(number);
            Self(u32::try_from(all.len() - 1).expect("numbers of one law"))
        })
    }

    /// The number.
    #[inline(never)]
    pub(super) fn number(self) -> Directions {
        NUMBERS.with_borrow(|all| all[self.0 as usize])
    }

    #[inline(always)]
    fn by_one(self, f: impl FnOnce(Directions) -> Directions) -> Self {
        Self::new(f(self.number()))
    }

    #[inline(always)]
    fn by_two(self, o: Self, f: impl FnOnce(Directions, Directions) -> Directions) -> Self {
        Self::new(f(self.number(), o.number()))
    }
}

macro_rules! operators {
    ($($trait:ident $name:ident),*) => {$(
        impl $trait for Listed {
            type Output = Self;
            #[inline(never)]
            fn $name(self, o: Self) -> Self {
                self.by_two(o, Directions::$name)
            }
        }
    )*};
}

operators!(Add add, Sub sub, Mul mul, Div div);

impl Neg for Listed {
    type Output = Self;
    #[inline(never)]
    fn neg(self) -> Self {
        self.by_one(Directions::neg)
    }
}

macro_rules! functions {
    ($($name:ident),*) => {$(
        #[inline(never)]
        fn $name(self) -> Self {
            self.by_one(<Directions as Real>::$name)
        }
    )*};
}

impl Real for Listed {
    type Mask = bool;
    const DERIVATIVES: bool = true;

    functions!(abs, sqrt, exp, exp_by_vectors, ln, ln_1p, tanh, cbrt, fixed);

    #[inline(never)]
    fn of(self, x: f64) -> Self {
        Self::new(Dual::<DIRECTIONS>::constant(x))
    }
    #[inline(never)]
    fn mul_add(self, a: Self, b: Self) -> Self {
        Self::new(self.number().mul_add(a.number(), b.number()))
    }
    #[inline(never)]
    fn exp_and_m1(self) -> [Self; 2] {
        self.number().exp_and_m1().map(Self::new)
    }
    #[inline(never)]
    fn powf(self, a: Self) -> Self {
        self.by_two(a, Real::powf)
    }
    #[inline(never)]
    fn lt(self, o: Self) -> bool {
        self.number().lt(o.number())
    }
    #[inline(never)]
    fn le(self, o: Self) -> bool {
        self.number().le(o.number())
    }
    #[inline(always)]
    fn select(mask: bool, yes: Self, no: Self) -> Self {
        if mask { yes } else { no }
    }
    #[inline(always)]
    fn any(self, mask: bool) -> bool {
        mask
    }
    #[inline(never)]
    fn map(self, f: impl Fn(f64) -> f64) -> Self {
        Self::new(Real::map(self.number(), f))
    }
    #[inline(never)]
    fn map2(self, o: Self, f: impl Fn(f64, f64) -> f64) -> Self {
        Self::new(self.number().map2(o.number(), f))
    }
    #[inline(never)]
    fn map_pair(self, f: impl Fn(f64) -> [f64; 2]) -> [Self; 2] {
        self.number().map_pair(f).map(Self::new)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn law<R: Real>(x: R, y: R) -> R {
        let [grown, more] = (x * y).exp_and_m1();
        let bent = R::select(x.lt(y), grown / y, more - x.mul_add(y, x.of(2.0)).abs());
        let pair = y.map_pair(|y| [y.sin(), y.cos()]);
        let smooth = x.map(f64::sin) + y.ln().cbrt() - x.fixed() * pair[0] + pair[1].max(x.exp());
        -bent + x.hypot(y).sqrt() * y.tanh().powf(x.of(0.5)) + smooth.only(x.le(y))
    }

    #[test]
    fn they_are_the_numbers_that_stand_there() {
        for (x, y) in [(0.7, 1.4), (1.9, 0.3)] {
            let (x, y) = (Directions::variable(x, 0), Directions::variable(y, 5));
            Listed::begin();
            assert_eq!(law(Listed::new(x), Listed::new(y)).number(), law(x, y));
        }
    }
}
