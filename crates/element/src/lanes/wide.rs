//! Numbers for machines with FMA and registers of 256 bits (AVX2) or 512 (AVX-512). They exist only where a
//! token of [`pulp`] says that the machine has them.

use super::each::each;
use super::registers::{Both, Registers, Two, avx2, avx512, in_one, in_two};
use super::{Real, functions};
use pulp::x86::{V3, V4};
use pulp::{Simd, cast, f64x4, f64x8};
use std::arch::x86_64::__m256d;
use std::fmt;
use std::ops::{Add, BitAnd, BitOr, Div, Mul, Neg, Not, Sub};

/// One number, multiplied and added in one rounding as [`Wide`] does it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Fused(pub f64);

/// Numbers side by side: eight in a register of AVX-512 (`V4`) or in two of AVX2 (`Two`), four in one of AVX2 (`V3`).
pub struct Wide<S: Registers> {
    pub(super) simd: S,
    x: S::Numbers,
}

/// As many answers.
pub struct WideMask<S: Registers> {
    simd: S,
    x: S::Answers,
}

// Copied as a whole: a derived clone would go over the registers one by one.
macro_rules! copied {
    ($($name:ident),*) => {$(
        impl<S: Registers> Copy for $name<S> {}

        impl<S: Registers> Clone for $name<S> {
            #[inline(always)]
            fn clone(&self) -> Self {
                *self
            }
        }
    )*};
}
copied!(Wide, WideMask);

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

impl Wide<V3> {
    #[inline(always)]
    pub(super) fn of_four(simd: V3, x: [f64; 4]) -> Self {
        Self { simd, x: cast(x) }
    }

    #[inline(always)]
    pub(super) fn four(self) -> [f64; 4] {
        cast(self.x)
    }

    #[inline(always)]
    fn of_array(simd: V3, x: [f64; 8]) -> Self {
        let [a, b, c, d, ..] = x;
        Self::of_four(simd, [a, b, c, d])
    }

    /// The lanes, and behind them zeros.
    #[inline(always)]
    fn array(self) -> [f64; 8] {
        let [a, b, c, d] = self.four();
        [a, b, c, d, 0.0, 0.0, 0.0, 0.0]
    }
}

impl Wide<Two> {
    #[inline(always)]
    pub(super) fn of_array(simd: Two, x: [f64; 8]) -> Self {
        let [a, b]: [__m256d; 2] = cast(x);
        Self { simd, x: Both(a, b) }
    }

    #[inline(always)]
    pub(super) fn array(self) -> [f64; 8] {
        cast([self.x.0, self.x.1])
    }

    /// Eight pairs, their first numbers and their second.
    #[inline(always)]
    pub(super) fn split_pairs(simd: Two, pairs: &[f64; 16]) -> [Self; 2] {
        let [a, b, c, d]: [f64x4; 4] = cast(*pairs);
        let [x0, y0] = simd.0.deinterleave_shfl_f64s([a, b]);
        let [x1, y1] = simd.0.deinterleave_shfl_f64s([c, d]);
        [Self { simd, x: Both(cast(x0), cast(x1)) }, Self { simd, x: Both(cast(y0), cast(y1)) }]
    }

    #[inline(always)]
    pub(super) fn join_pairs([first, second]: [Self; 2]) -> [f64; 16] {
        let simd = first.simd.0;
        let ([a, b], [c, d]): ([f64x4; 2], [f64x4; 2]) =
            (cast([first.x.0, second.x.0]), cast([first.x.1, second.x.1]));
        let ([a, b], [c, d]) =
            (simd.interleave_shfl_f64s([a, b]), simd.interleave_shfl_f64s([c, d]));
        cast([a, b, c, d])
    }
}

impl Wide<V4> {
    #[inline(always)]
    pub(super) fn of_array(simd: V4, x: [f64; 8]) -> Self {
        Self { simd, x: cast(x) }
    }

    #[inline(always)]
    pub(super) fn array(self) -> [f64; 8] {
        cast(self.x)
    }

    /// Eight pairs, their first numbers and their second.
    #[inline(always)]
    pub(super) fn split_pairs(simd: V4, pairs: &[f64; 16]) -> [Self; 2] {
        let pairs: [f64x8; 2] = cast(*pairs);
        let [x, y] = simd.deinterleave_shfl_f64s(pairs);
        [Self { simd, x: cast(x) }, Self { simd, x: cast(y) }]
    }

    #[inline(always)]
    pub(super) fn join_pairs([first, second]: [Self; 2]) -> [f64; 16] {
        let both: [f64x8; 2] = cast([first.x, second.x]);
        cast(first.simd.interleave_shfl_f64s(both))
    }
}

/// The operations on registers. Generic ones would be functions inside one another for each operation of a law, until the
/// machine code is made; a closure for each might stay a call, outside of what is compiled for registers.
macro_rules! operations {
    ($set:ty, $over:ident $by:ident) => {
        operations!(@all $set, $over $by, Wide: Add add, Sub sub, Mul mul, Div div);
        operations!(@all $set, $over $by, WideMask: BitAnd bitand, BitOr bitor);

        impl Wide<$set> {
            #[inline(always)]
            pub(super) fn splat(simd: $set, x: f64) -> Self {
                Self { simd, x: $over!($by splat simd, x) }
            }
        }

        impl fmt::Debug for Wide<$set> {
            fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
                f.debug_list().entries(self.array()).finish()
            }
        }

        impl Not for WideMask<$set> {
            type Output = Self;
            #[inline(always)]
            fn not(self) -> Self {
                Self { simd: self.simd, x: $over!($by not self.simd, self.x) }
            }
        }

        impl Neg for Wide<$set> {
            type Output = Self;
            #[inline(always)]
            fn neg(self) -> Self {
                let sign = $over!($by splat self.simd, -0.0);
                Self { simd: self.simd, x: $over!($by bits_xor self.simd, self.x, sign) }
            }
        }

        impl Real for Wide<$set> {
            type Mask = WideMask<$set>;

            #[inline(always)]
            fn of(self, x: f64) -> Self {
                Self::splat(self.simd, x)
            }
            #[inline(always)]
            fn mul_add(self, a: Self, b: Self) -> Self {
                Self { simd: self.simd, x: $over!($by mul_add self.simd, self.x, a.x, b.x) }
            }
            #[inline(always)]
            fn abs(self) -> Self {
                let size = $over!($by splat self.simd, f64::from_bits(u64::MAX >> 1));
                Self { simd: self.simd, x: $over!($by bits_and self.simd, self.x, size) }
            }
            #[inline(always)]
            fn sqrt(self) -> Self {
                Self { simd: self.simd, x: $over!($by sqrt self.simd, self.x) }
            }
            #[inline(always)]
            fn lt(self, o: Self) -> Self::Mask {
                WideMask { simd: self.simd, x: $over!($by lt self.simd, self.x, o.x) }
            }
            #[inline(always)]
            fn le(self, o: Self) -> Self::Mask {
                WideMask { simd: self.simd, x: $over!($by le self.simd, self.x, o.x) }
            }
            #[inline(always)]
            fn select(mask: Self::Mask, yes: Self, no: Self) -> Self {
                Self { simd: yes.simd, x: $over!($by select yes.simd, mask.x, yes.x, no.x) }
            }
            #[inline(always)]
            fn max(self, o: Self) -> Self {
                Self { simd: self.simd, x: $over!($by max self.simd, self.x, o.x) }
            }
            #[inline(always)]
            fn min(self, o: Self) -> Self {
                Self { simd: self.simd, x: $over!($by min self.simd, self.x, o.x) }
            }
            #[inline(always)]
            fn any(self, mask: Self::Mask) -> bool {
                $over!($by any self.simd, mask.x)
            }
            functions_by_vectors!();
            #[inline(always)]
            fn map(self, f: impl Fn(f64) -> f64) -> Self {
                let mut x = self.array();
                each!(8, i => x[i] = f(x[i]));
                Self::of_array(self.simd, x)
            }
            #[inline(always)]
            fn map2(self, o: Self, f: impl Fn(f64, f64) -> f64) -> Self {
                let (mut a, b) = (self.array(), o.array());
                each!(8, i => a[i] = f(a[i], b[i]));
                Self::of_array(self.simd, a)
            }
            #[inline(always)]
            fn map_pair(self, f: impl Fn(f64) -> [f64; 2]) -> [Self; 2] {
                let (mut a, mut b) = (self.array(), [0.0; 8]);
                each!(8, i => [a[i], b[i]] = f(a[i]));
                [Self::of_array(self.simd, a), Self::of_array(self.simd, b)]
            }
        }
    };
    (@all $set:ty, $over:ident $by:ident, $of:ident: $($trait:ident $name:ident),*) => {$(
        impl $trait for $of<$set> {
            type Output = Self;
            #[inline(always)]
            fn $name(self, o: Self) -> Self {
                Self { simd: self.simd, x: $over!($by $name self.simd, self.x, o.x) }
            }
        }
    )*};
}
operations!(V3, in_one avx2);
operations!(Two, in_two avx2);
operations!(V4, in_one avx512);
