//! Numbers for machines with FMA and registers of 256 bits (AVX2) or 512 (AVX-512). They exist only where a
//! token of [`pulp`] says that the machine has them.

use super::each::{each, each_of_two};
use super::{Real, functions};
use pulp::x86::{V3, V4};
use pulp::{Simd, bytemuck};
use std::fmt;
use std::ops::{Add, BitAnd, BitOr, Div, Mul, Neg, Not, Sub};

/// Numbers side by side at most.
const LANES: usize = 8;

/// One number, multiplied and added in one rounding as [`Wide`] does it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Fused(pub f64);

/// Numbers in `K` registers: eight in two of AVX2 or in one of AVX-512, which lie in one line of the cache; four in one
/// of AVX2.
#[repr(align(64))]
pub struct Wide<S: Simd, const K: usize> {
    pub(super) simd: S,
    x: [S::f64s; K],
}

/// Eight answers.
pub struct WideMask<S: Simd, const K: usize> {
    simd: S,
    x: [S::m64s; K],
}

// Copied as a whole: a derived clone would go over the registers one by one.
macro_rules! copied {
    ($($name:ident),*) => {$(
        impl<S: Simd, const K: usize> Copy for $name<S, K> {}

        impl<S: Simd, const K: usize> Clone for $name<S, K> {
            #[inline(always)]
            fn clone(&self) -> Self {
                *self
            }
        }
    )*};
}
copied!(Wide, WideMask);

impl<S: Simd, const K: usize> fmt::Debug for Wide<S, K> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_list().entries(self.lanes()).finish()
    }
}

macro_rules! operators {
    ($($trait:ident $method:ident $op:tt),*) => {$(
        impl $trait for Fused {
            type Output = Self;
            #[inline(always)]
            fn $method(self, o: Self) -> Self {
                Self(self.0 $op o.0)
            }
        }
    )*};
}
operators!(Add add +, Sub sub -, Mul mul *, Div div /);

impl Neg for Fused {
    type Output = Self;
    #[inline(always)]
    fn neg(self) -> Self {
        Self(-self.0)
    }
}

/// Functions that every lane gets in vectors, to the bits that it has alone.
macro_rules! functions_by_vectors {
    () => {
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
    };
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
    functions_by_vectors!();
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
    pub fn lanes(self) -> [f64; LANES] {
        let mut lanes = [0.0; LANES];
        let own = bytemuck::cast_slice(&self.x);
        lanes[..own.len()].copy_from_slice(own);
        lanes
    }

    #[inline(always)]
    pub(super) fn from_lanes(simd: S, x: [f64; LANES]) -> Self {
        let from: &[S::f64s] = bytemuck::cast_slice(&x);
        let mut x = [simd.splat_f64s(0.0); K];
        each_of_two!(K, k => x[k] = from[k]);
        Self { simd, x }
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
        each_of_two!(K, k => {
            let [x, y] = simd.deinterleave_shfl_f64s([pairs[2 * k], pairs[2 * k + 1]]);
            (both[0].x[k], both[1].x[k]) = (x, y);
        });
        both
    }

    #[inline(always)]
    pub(super) fn join_pairs([first, second]: [Self; 2]) -> [f64; 16] {
        let mut all = [0.0; 16];
        let pairs: &mut [S::f64s] = bytemuck::cast_slice_mut(&mut all);
        each_of_two!(K, k => {
            let two = first.simd.interleave_shfl_f64s([first.x[k], second.x[k]]);
            (pairs[2 * k], pairs[2 * k + 1]) = (two[0], two[1]);
        });
        all
    }
}

/// The operations for one kind of registers. Generic ones would be three functions inside one another for each operation of
/// a law, until the machine code is made; a closure for each might stay a call, outside of what is compiled for registers.
macro_rules! operations {
    ($token:ty) => {
        operations!(@binary $token: Add add add_f64s, Sub sub sub_f64s, Mul mul mul_f64s, Div div div_f64s);
        operations!(@masks $token: BitAnd bitand and_m64s, BitOr bitor or_m64s);

    impl<const K: usize> Not for WideMask<$token, K> {
        type Output = Self;
        #[inline(always)]
        fn not(self) -> Self {
            let mut x = self.x;
            each_of_two!(K, k => x[k] = self.simd.not_m64s(x[k]));
            Self { simd: self.simd, x }
        }
    }

    impl<const K: usize> Neg for Wide<$token, K> {
        type Output = Self;
        #[inline(always)]
        fn neg(self) -> Self {
            operations!(@one self, neg_f64s)
        }
    }

    impl<const K: usize> Real for Wide<$token, K> {
        type Mask = WideMask<$token, K>;

        #[inline(always)]
        fn of(self, x: f64) -> Self {
            Self::splat(self.simd, x)
        }
        #[inline(always)]
        fn mul_add(self, a: Self, b: Self) -> Self {
            let mut x = self.x;
            each_of_two!(K, k => x[k] = self.simd.mul_add_f64s(x[k], a.x[k], b.x[k]));
            Self { simd: self.simd, x }
        }
        #[inline(always)]
        fn abs(self) -> Self {
            // Not `abs_f64s`: that makes its mask by what may stay a call.
            let mask = self.simd.splat_f64s(f64::from_bits(u64::MAX >> 1));
            let mut x = self.x;
            each_of_two!(K, k => x[k] = self.simd.and_f64s(x[k], mask));
            Self { simd: self.simd, x }
        }
        #[inline(always)]
        fn sqrt(self) -> Self {
            operations!(@one self, sqrt_f64s)
        }
        #[inline(always)]
        fn lt(self, o: Self) -> Self::Mask {
            operations!(@compare self, o, less_than_f64s)
        }
        #[inline(always)]
        fn le(self, o: Self) -> Self::Mask {
            operations!(@compare self, o, less_than_or_equal_f64s)
        }
        #[inline(always)]
        fn select(mask: Self::Mask, yes: Self, no: Self) -> Self {
            let mut x = yes.x;
            each_of_two!(K, k => x[k] = yes.simd.select_f64s(mask.x[k], x[k], no.x[k]));
            Self { simd: yes.simd, x }
        }
        #[inline(always)]
        fn max(self, o: Self) -> Self {
            operations!(@two self, o, max_f64s)
        }
        #[inline(always)]
        fn min(self, o: Self) -> Self {
            operations!(@two self, o, min_f64s)
        }
        #[inline(always)]
        fn any(self, mask: Self::Mask) -> bool {
            let s = self.simd;
            let mut either = mask.x[0];
            each_of_two!(K, k => either = s.or_m64s(either, mask.x[k]));
            s.first_true_m64s(either) < <$token as Simd>::F64_LANES
        }
        functions_by_vectors!();
        #[inline(always)]
        fn map(self, f: impl Fn(f64) -> f64) -> Self {
            let mut x = self.lanes();
            each!(LANES, i => x[i] = f(x[i]));
            Self::from_lanes(self.simd, x)
        }
        #[inline(always)]
        fn map2(self, o: Self, f: impl Fn(f64, f64) -> f64) -> Self {
            let (mut a, b) = (self.lanes(), o.lanes());
            each!(LANES, i => a[i] = f(a[i], b[i]));
            Self::from_lanes(self.simd, a)
        }
        #[inline(always)]
        fn map_pair(self, f: impl Fn(f64) -> [f64; 2]) -> [Self; 2] {
            let (mut a, mut b) = (self.lanes(), [0.0; LANES]);
            each!(LANES, i => [a[i], b[i]] = f(a[i]));
            [Self::from_lanes(self.simd, a), Self::from_lanes(self.simd, b)]
        }
    }
    };
    (@one $self:ident, $simd:ident) => {{
        let mut x = $self.x;
        each_of_two!(K, k => x[k] = $self.simd.$simd(x[k]));
        Self { simd: $self.simd, x }
    }};
    (@two $self:ident, $o:ident, $simd:ident) => {{
        let mut x = $self.x;
        each_of_two!(K, k => x[k] = $self.simd.$simd(x[k], $o.x[k]));
        Self { simd: $self.simd, x }
    }};
    (@compare $self:ident, $o:ident, $simd:ident) => {{
        let mut x = [$self.simd.$simd($self.x[0], $o.x[0]); K];
        each_of_two!(K, k => x[k] = $self.simd.$simd($self.x[k], $o.x[k]));
        WideMask { simd: $self.simd, x }
    }};
    (@binary $token:ty: $($trait:ident $method:ident $simd:ident),*) => {$(
        impl<const K: usize> $trait for Wide<$token, K> {
            type Output = Self;
            #[inline(always)]
            fn $method(self, o: Self) -> Self {
                operations!(@two self, o, $simd)
            }
        }
    )*};
    (@masks $token:ty: $($trait:ident $method:ident $simd:ident),*) => {$(
        impl<const K: usize> $trait for WideMask<$token, K> {
            type Output = Self;
            #[inline(always)]
            fn $method(self, o: Self) -> Self {
                let mut x = self.x;
                each_of_two!(K, k => x[k] = self.simd.$simd(x[k], o.x[k]));
                Self { simd: self.simd, x }
            }
        }
    )*};
}
operations!(V3);
operations!(V4);
