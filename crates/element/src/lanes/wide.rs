//! Numbers for machines with AVX2 and FMA. They exist only where [`V3`] says that the machine has them.

use super::Real;
use pulp::x86::V3;
use pulp::{Simd, f64x4, m64x4};
use std::fmt;
use std::ops::{Add, BitAnd, BitOr, Div, Mul, Neg, Not, Sub};

/// One number, multiplied and added in one rounding as [`Wide`] does it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Fused(pub f64);

/// Eight numbers in two registers.
#[derive(Clone, Copy)]
pub struct Wide {
    pub(super) simd: V3,
    pub(super) x: [f64x4; 2],
}

/// Eight answers.
#[derive(Clone, Copy)]
pub struct WideMask {
    simd: V3,
    x: [m64x4; 2],
}

impl fmt::Debug for Wide {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_list().entries(self.x).finish()
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
        impl $trait for Wide {
            type Output = Self;
            #[inline(always)]
            fn $method(self, o: Self) -> Self {
                let s = self.simd;
                Self { simd: s, x: [s.$simd(self.x[0], o.x[0]), s.$simd(self.x[1], o.x[1])] }
            }
        }
    )*};
}
operators!(Add add + add_f64s, Sub sub - sub_f64s, Mul mul * mul_f64s, Div div / div_f64s);

macro_rules! masks {
    ($($trait:ident $method:ident $simd:ident),*) => {$(
        impl $trait for WideMask {
            type Output = Self;
            #[inline(always)]
            fn $method(self, o: Self) -> Self {
                let s = self.simd;
                Self { simd: s, x: [s.$simd(self.x[0], o.x[0]), s.$simd(self.x[1], o.x[1])] }
            }
        }
    )*};
}
masks!(BitAnd bitand and_m64s, BitOr bitor or_m64s);

impl Not for WideMask {
    type Output = Self;
    #[inline(always)]
    fn not(self) -> Self {
        let s = self.simd;
        Self { simd: s, x: [s.not_m64s(self.x[0]), s.not_m64s(self.x[1])] }
    }
}

impl Neg for Fused {
    type Output = Self;
    #[inline(always)]
    fn neg(self) -> Self {
        Self(-self.0)
    }
}

impl Neg for Wide {
    type Output = Self;
    #[inline(always)]
    fn neg(self) -> Self {
        let s = self.simd;
        Self { simd: s, x: [s.neg_f64s(self.x[0]), s.neg_f64s(self.x[1])] }
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
    fn map(self, f: impl Fn(f64) -> f64) -> Self {
        Self(f(self.0))
    }
    #[inline(always)]
    fn map2(self, o: Self, f: impl Fn(f64, f64) -> f64) -> Self {
        Self(f(self.0, o.0))
    }
}

impl Wide {
    /// The lanes one by one.
    #[inline(always)]
    #[must_use]
    pub fn lanes(self) -> [f64; 8] {
        let [a, b] = self.x;
        [a.0, a.1, a.2, a.3, b.0, b.1, b.2, b.3]
    }

    #[inline(always)]
    pub(super) fn from_lanes(simd: V3, x: [f64; 8]) -> Self {
        Self { simd, x: [f64x4(x[0], x[1], x[2], x[3]), f64x4(x[4], x[5], x[6], x[7])] }
    }
}

impl Real for Wide {
    type Mask = WideMask;

    #[inline(always)]
    fn of(self, x: f64) -> Self {
        Self { simd: self.simd, x: [self.simd.splat_f64s(x); 2] }
    }
    #[inline(always)]
    fn mul_add(self, a: Self, b: Self) -> Self {
        let s = self.simd;
        let [x, y] = self.x;
        Self { simd: s, x: [s.mul_add_f64s(x, a.x[0], b.x[0]), s.mul_add_f64s(y, a.x[1], b.x[1])] }
    }
    #[inline(always)]
    fn abs(self) -> Self {
        let s = self.simd;
        Self { simd: s, x: [s.abs_f64s(self.x[0]), s.abs_f64s(self.x[1])] }
    }
    #[inline(always)]
    fn sqrt(self) -> Self {
        let s = self.simd;
        Self { simd: s, x: [s.sqrt_f64x4(self.x[0]), s.sqrt_f64x4(self.x[1])] }
    }
    #[inline(always)]
    fn lt(self, o: Self) -> WideMask {
        let s = self.simd;
        let x = [s.cmp_lt_f64x4(self.x[0], o.x[0]), s.cmp_lt_f64x4(self.x[1], o.x[1])];
        WideMask { simd: s, x }
    }
    #[inline(always)]
    fn le(self, o: Self) -> WideMask {
        let s = self.simd;
        let x = [s.cmp_le_f64x4(self.x[0], o.x[0]), s.cmp_le_f64x4(self.x[1], o.x[1])];
        WideMask { simd: s, x }
    }
    #[inline(always)]
    fn select(mask: WideMask, yes: Self, no: Self) -> Self {
        let s = yes.simd;
        let [a, b] = mask.x;
        Self {
            simd: s,
            x: [s.select_f64x4(a, yes.x[0], no.x[0]), s.select_f64x4(b, yes.x[1], no.x[1])],
        }
    }
    #[inline(always)]
    fn max(self, o: Self) -> Self {
        let s = self.simd;
        Self { simd: s, x: [s.max_f64s(self.x[0], o.x[0]), s.max_f64s(self.x[1], o.x[1])] }
    }
    #[inline(always)]
    fn min(self, o: Self) -> Self {
        let s = self.simd;
        Self { simd: s, x: [s.min_f64s(self.x[0], o.x[0]), s.min_f64s(self.x[1], o.x[1])] }
    }
    #[inline(always)]
    fn any(self, mask: WideMask) -> bool {
        let s = self.simd;
        let either = s.or_m64s(mask.x[0], mask.x[1]);
        s.first_true_m64s(either) < 4
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
}
