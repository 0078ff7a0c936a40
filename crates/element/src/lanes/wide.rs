//! Numbers for machines with FMA and registers of 256 bits (AVX2) or 512 (AVX-512). They exist only where a
//! token of [`pulp`] says that the machine has them.

use super::{Real, functions};
use pulp::{Simd, bytemuck};
use std::fmt;
use std::ops::{Add, BitAnd, BitOr, Div, Mul, Neg, Not, Sub};

/// One number, multiplied and added in one rounding as [`Wide`] does it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Fused(pub f64);

/// Numbers in `K` registers: eight in two of AVX2 or in one of AVX-512, which lie in one line of the cache; four in one
/// of AVX2.
#[derive(Clone, Copy)]
#[repr(align(64))]
pub struct Wide<S: Simd, const K: usize> {
    pub(super) simd: S,
    x: [S::f64s; K],
}

/// Eight answers.
#[derive(Clone, Copy)]
pub struct WideMask<S: Simd, const K: usize> {
    simd: S,
    x: [S::m64s; K],
}

impl<S: Simd, const K: usize> fmt::Debug for Wide<S, K> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_list().entries(self.lanes()).finish()
    }
}

macro_rules! operators {
    ($($trait:ident $method:ident $op:tt $simd:ident),*) => {$(
        impl $trait for Fused {
            type Output = Self;
            #[inline(always)]
            fn $method(self, o: Self) -> Self {
                Self(self.0 $op o.0)
            }
        }
        impl<S: Simd, const K: usize> $trait for Wide<S, K> {
            type Output = Self;
            #[inline(always)]
            fn $method(self, o: Self) -> Self {
                self.by_two(o, |s, x, y| s.$simd(x, y))
            }
        }
    )*};
}
operators!(Add add + add_f64s, Sub sub - sub_f64s, Mul mul * mul_f64s, Div div / div_f64s);

macro_rules! masks {
    ($($trait:ident $method:ident $simd:ident),*) => {$(
        impl<S: Simd, const K: usize> $trait for WideMask<S, K> {
            type Output = Self;
            #[inline(always)]
            fn $method(self, o: Self) -> Self {
                let mut x = self.x;
                x.iter_mut().zip(o.x).for_each(|(x, o)| *x = self.simd.$simd(*x, o));
                Self { simd: self.simd, x }
            }
        }
    )*};
}
masks!(BitAnd bitand and_m64s, BitOr bitor or_m64s);

impl<S: Simd, const K: usize> Not for WideMask<S, K> {
    type Output = Self;
    #[inline(always)]
    fn not(self) -> Self {
        let mut x = self.x;
        x.iter_mut().for_each(|x| *x = self.simd.not_m64s(*x));
        Self { simd: self.simd, x }
    }
}

impl Neg for Fused {
    type Output = Self;
    #[inline(always)]
    fn neg(self) -> Self {
        Self(-self.0)
    }
}

impl<S: Simd, const K: usize> Neg for Wide<S, K> {
    type Output = Self;
    #[inline(always)]
    fn neg(self) -> Self {
        self.by_one(|s, x| s.neg_f64s(x))
    }
}

impl Real for Fused {
    type Mask = bool;

    #[inline(always)]
    fn of(self, x: f64) -> Self {
        Self(x)
    }
    #[inline(always)]
    fn mul_add(self, a: Self, b: Self) -> Self {
        Self(self.0.mul_add(a.0, b.0))
    }
    #[inline(always)]
    fn abs(self) -> Self {
        Self(self.0.abs())
    }
    #[inline(always)]
    fn sqrt(self) -> Self {
        Self(self.0.sqrt())
    }
    #[inline(always)]
    fn lt(self, o: Self) -> bool {
        self.0 < o.0
    }
    #[inline(always)]
    fn le(self, o: Self) -> bool {
        self.0 <= o.0
    }
    #[inline(always)]
    fn select(mask: bool, yes: Self, no: Self) -> Self {
        if mask { yes } else { no }
    }
    #[inline(always)]
    fn any(self, mask: bool) -> bool {
        mask
    }
    #[inline(always)]
    fn exp_by_vectors(self) -> Self {
        functions::exp_and_m1(self)[0]
    }
    #[inline(always)]
    fn exp_and_m1(self) -> [Self; 2] {
        functions::exp_and_m1(self)
    }
    #[inline(always)]
    fn ln(self) -> Self {
        functions::ln(self)
    }
    #[inline(always)]
    fn ln_1p(self) -> Self {
        functions::ln_1p(self)
    }
    #[inline(always)]
    fn tanh(self) -> Self {
        functions::tanh(self)
    }
    #[inline(always)]
    fn cbrt(self) -> Self {
        functions::cbrt(self)
    }
    #[inline(always)]
    fn powf(self, a: Self) -> Self {
        functions::powf(self, a)
    }
    #[inline(always)]
    fn map(self, f: impl Fn(f64) -> f64) -> Self {
        Self(f(self.0))
    }
    #[inline(always)]
    fn map2(self, o: Self, f: impl Fn(f64, f64) -> f64) -> Self {
        Self(f(self.0, o.0))
    }
    #[inline(always)]
    fn map_pair(self, f: impl Fn(f64) -> [f64; 2]) -> [Self; 2] {
        let [a, b] = f(self.0);
        [Self(a), Self(b)]
    }
}

impl<S: Simd, const K: usize> Wide<S, K> {
    /// The lanes one by one; behind them, where there are fewer than eight, zeros.
    #[inline(always)]
    #[must_use]
    pub fn lanes(self) -> [f64; 8] {
        let mut lanes = [0.0; 8];
        let own = bytemuck::cast_slice(&self.x);
        lanes[..own.len()].copy_from_slice(own);
        lanes
    }

    #[inline(always)]
    pub(super) fn from_lanes(simd: S, x: [f64; 8]) -> Self {
        let x: &[S::f64s] = bytemuck::cast_slice(&x);
        Self { simd, x: std::array::from_fn(|i| x[i]) }
    }

    #[inline(always)]
    pub(super) fn splat(simd: S, x: f64) -> Self {
        Self { simd, x: [simd.splat_f64s(x); K] }
    }

    #[inline(always)]
    pub(super) fn of_registers(simd: S, x: [S::f64s; K]) -> Self {
        Self { simd, x }
    }

    #[inline(always)]
    pub(super) fn registers(self) -> [S::f64s; K] {
        self.x
    }

    /// Eight pairs, their first numbers and their second.
    #[inline(always)]
    pub(super) fn split_pairs(simd: S, pairs: &[f64; 16]) -> [Self; 2] {
        let pairs: &[S::f64s] = bytemuck::cast_slice(pairs);
        let mut both = [Self::splat(simd, 0.0); 2];
        for k in 0..K {
            let [x, y] = simd.deinterleave_shfl_f64s([pairs[2 * k], pairs[2 * k + 1]]);
            (both[0].x[k], both[1].x[k]) = (x, y);
        }
        both
    }

    #[inline(always)]
    pub(super) fn join_pairs([first, second]: [Self; 2]) -> [f64; 16] {
        let mut all = [0.0; 16];
        let pairs: &mut [S::f64s] = bytemuck::cast_slice_mut(&mut all);
        for k in 0..K {
            let two = first.simd.interleave_shfl_f64s([first.x[k], second.x[k]]);
            (pairs[2 * k], pairs[2 * k + 1]) = (two[0], two[1]);
        }
        all
    }

    #[inline(always)]
    fn by_one(self, f: impl Fn(S, S::f64s) -> S::f64s) -> Self {
        let mut x = self.x;
        x.iter_mut().for_each(|x| *x = f(self.simd, *x));
        Self { simd: self.simd, x }
    }

    #[inline(always)]
    fn by_two(self, o: Self, f: impl Fn(S, S::f64s, S::f64s) -> S::f64s) -> Self {
        let mut x = self.x;
        x.iter_mut().zip(o.x).for_each(|(x, o)| *x = f(self.simd, *x, o));
        Self { simd: self.simd, x }
    }

    #[inline(always)]
    fn compare(self, o: Self, f: impl Fn(S, S::f64s, S::f64s) -> S::m64s) -> WideMask<S, K> {
        WideMask { simd: self.simd, x: std::array::from_fn(|i| f(self.simd, self.x[i], o.x[i])) }
    }
}

impl<S: Simd, const K: usize> Real for Wide<S, K> {
    type Mask = WideMask<S, K>;

    #[inline(always)]
    fn of(self, x: f64) -> Self {
        Self::splat(self.simd, x)
    }
    #[inline(always)]
    fn mul_add(self, a: Self, b: Self) -> Self {
        let mut x = self.x;
        for i in 0..K {
            x[i] = self.simd.mul_add_f64s(x[i], a.x[i], b.x[i]);
        }
        Self { simd: self.simd, x }
    }
    #[inline(always)]
    fn abs(self) -> Self {
        self.by_one(|s, x| s.abs_f64s(x))
    }
    #[inline(always)]
    fn sqrt(self) -> Self {
        self.by_one(|s, x| s.sqrt_f64s(x))
    }
    #[inline(always)]
    fn lt(self, o: Self) -> Self::Mask {
        self.compare(o, |s, x, y| s.less_than_f64s(x, y))
    }
    #[inline(always)]
    fn le(self, o: Self) -> Self::Mask {
        self.compare(o, |s, x, y| s.less_than_or_equal_f64s(x, y))
    }
    #[inline(always)]
    fn select(mask: Self::Mask, yes: Self, no: Self) -> Self {
        let mut x = yes.x;
        for i in 0..K {
            x[i] = yes.simd.select_f64s(mask.x[i], x[i], no.x[i]);
        }
        Self { simd: yes.simd, x }
    }
    #[inline(always)]
    fn max(self, o: Self) -> Self {
        self.by_two(o, |s, x, y| s.max_f64s(x, y))
    }
    #[inline(always)]
    fn min(self, o: Self) -> Self {
        self.by_two(o, |s, x, y| s.min_f64s(x, y))
    }
    #[inline(always)]
    fn any(self, mask: Self::Mask) -> bool {
        let s = self.simd;
        let either = mask.x[1..].iter().fold(mask.x[0], |a, b| s.or_m64s(a, *b));
        s.first_true_m64s(either) < S::F64_LANES
    }
    #[inline(always)]
    fn exp_by_vectors(self) -> Self {
        functions::exp_and_m1(self)[0]
    }
    #[inline(always)]
    fn exp_and_m1(self) -> [Self; 2] {
        functions::exp_and_m1(self)
    }
    #[inline(always)]
    fn ln(self) -> Self {
        functions::ln(self)
    }
    #[inline(always)]
    fn ln_1p(self) -> Self {
        functions::ln_1p(self)
    }
    #[inline(always)]
    fn tanh(self) -> Self {
        functions::tanh(self)
    }
    #[inline(always)]
    fn cbrt(self) -> Self {
        functions::cbrt(self)
    }
    #[inline(always)]
    fn powf(self, a: Self) -> Self {
        functions::powf(self, a)
    }
    #[inline(always)]
    fn map(self, f: impl Fn(f64) -> f64) -> Self {
        Self::from_lanes(self.simd, self.lanes().map(f))
    }
    #[inline(always)]
    fn map2(self, o: Self, f: impl Fn(f64, f64) -> f64) -> Self {
        let (a, b) = (self.lanes(), o.lanes());
        Self::from_lanes(self.simd, std::array::from_fn(|i| f(a[i], b[i])))
    }
    #[inline(always)]
    fn map_pair(self, f: impl Fn(f64) -> [f64; 2]) -> [Self; 2] {
        let (mut a, mut b) = ([0.0; 8], [0.0; 8]);
        for (i, x) in self.lanes().into_iter().enumerate() {
            [a[i], b[i]] = f(x);
        }
        [Self::from_lanes(self.simd, a), Self::from_lanes(self.simd, b)]
    }
}
