//! A number that is one `f64` or several of them side by side.

use std::fmt::Debug;
use std::ops::{Add, BitAnd, BitOr, Div, Mul, Neg, Not, Sub};

/// One number, or one in each lane of a register. All operations act lane by lane and give in every
/// lane what they give alone.
pub trait Real:
    Copy
    + Debug
    + Send
    + Sync
    + Add<Output = Self>
    + Sub<Output = Self>
    + Mul<Output = Self>
    + Div<Output = Self>
    + Neg<Output = Self>
{
    /// Yes or no in every lane.
    type Mask: Copy
        + BitAnd<Output = Self::Mask>
        + BitOr<Output = Self::Mask>
        + Not<Output = Self::Mask>;

    /// True where a number carries derivatives: a shortcut that is right at a value may be wrong beside it.
    const DERIVATIVES: bool = false;

    /// The same number in every lane.
    #[must_use]
    fn of(self, x: f64) -> Self;

    /// `self · a + b`; in one rounding where the machine does it so.
    #[must_use]
    fn mul_add(self, a: Self, b: Self) -> Self;

    /// |x|.
    #[must_use]
    fn abs(self) -> Self;

    /// √x.
    #[must_use]
    fn sqrt(self) -> Self;

    /// self < o; no where one of them is not a number.
    fn lt(self, o: Self) -> Self::Mask;

    /// self ≤ o; no where one of them is not a number.
    fn le(self, o: Self) -> Self::Mask;

    /// The first where yes, the second where no.
    #[must_use]
    fn select(mask: Self::Mask, yes: Self, no: Self) -> Self;

    /// True where some lane says yes.
    fn any(self, mask: Self::Mask) -> bool;

    /// eˣ.
    #[inline(always)]
    #[must_use]
    fn exp(self) -> Self {
        self.map(f64::exp)
    }

    /// eˣ by operations of vectors, where [`exp`](Self::exp) goes lane by lane.
    #[inline(always)]
    #[must_use]
    fn exp_by_vectors(self) -> Self {
        self.exp()
    }

    /// eˣ and eˣ − 1, in vectors as well.
    #[inline(always)]
    #[must_use]
    fn exp_and_m1(self) -> [Self; 2] {
        self.map_pair(|x| [x.exp(), x.exp_m1()])
    }

    /// ln x, in vectors as well; of numbers above the least normal one.
    #[inline(always)]
    #[must_use]
    fn ln(self) -> Self {
        self.map(f64::ln)
    }

    /// ln(1 + x), in vectors as well.
    #[inline(always)]
    #[must_use]
    fn ln_1p(self) -> Self {
        self.map(f64::ln_1p)
    }

    /// tanh x, in vectors as well.
    #[inline(always)]
    #[must_use]
    fn tanh(self) -> Self {
        self.map(f64::tanh)
    }

    /// ∛x, in vectors as well.
    #[inline(always)]
    #[must_use]
    fn cbrt(self) -> Self {
        self.map(f64::cbrt)
    }

    /// xᵃ of x ≥ 0, in vectors as well.
    #[inline(always)]
    #[must_use]
    fn powf(self, a: Self) -> Self {
        self.map2(a, f64::powf)
    }

    /// A function of one number in every lane: for what registers cannot do, slowly.
    #[must_use]
    fn map(self, f: impl Fn(f64) -> f64) -> Self;

    /// The same for two numbers.
    #[must_use]
    fn map2(self, o: Self, f: impl Fn(f64, f64) -> f64) -> Self;

    /// Two functions of one number that are found together.
    #[must_use]
    fn map_pair(self, f: impl Fn(f64) -> [f64; 2]) -> [Self; 2];

    /// The same number as one that nothing moves: where a form has derivatives, these are not those of the number.
    #[inline(always)]
    #[must_use]
    fn fixed(self) -> Self {
        self
    }

    /// The larger; the second where they cannot be compared.
    #[inline(always)]
    #[must_use]
    fn max(self, o: Self) -> Self {
        Self::select(o.lt(self), self, o)
    }

    /// The smaller; the second where they cannot be compared.
    #[inline(always)]
    #[must_use]
    fn min(self, o: Self) -> Self {
        Self::select(self.lt(o), self, o)
    }

    /// As [`select`](Self::select), for a place in memory that keeps its number where no: with zero added,
    /// which no compiler turns into a store under a mask. Those are slow on some machines. Zero comes out positive.
    #[inline(always)]
    #[must_use]
    fn mix(mask: Self::Mask, yes: Self, no: Self) -> Self {
        Self::select(mask, yes, no) + yes.of(0.0)
    }

    /// √(x² + y²), where no square may be too large or too small for a number.
    #[inline(always)]
    #[must_use]
    fn hypot(self, o: Self) -> Self {
        let (x, y) = (self.abs(), o.abs());
        let (most, least) = (x.max(y), x.min(y));
        let share = (least / most).only(self.of(0.0).lt(most));
        most * share.mul_add(share, self.of(1.0)).sqrt()
    }

    /// The number where yes, zero where no.
    #[inline(always)]
    #[must_use]
    fn only(self, mask: Self::Mask) -> Self {
        Self::select(mask, self, self.of(0.0))
    }
}

impl Real for f64 {
    type Mask = bool;

    #[inline(always)]
    fn of(self, x: f64) -> Self {
        x
    }
    #[inline(always)]
    fn mul_add(self, a: Self, b: Self) -> Self {
        self * a + b
    }
    #[inline(always)]
    fn abs(self) -> Self {
        f64::abs(self)
    }
    #[inline(always)]
    fn sqrt(self) -> Self {
        f64::sqrt(self)
    }
    #[inline(always)]
    fn lt(self, o: Self) -> bool {
        self < o
    }
    #[inline(always)]
    fn le(self, o: Self) -> bool {
        self <= o
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
        f(self)
    }
    #[inline(always)]
    fn map2(self, o: Self, f: impl Fn(f64, f64) -> f64) -> Self {
        f(self, o)
    }
    #[inline(always)]
    fn map_pair(self, f: impl Fn(f64) -> [f64; 2]) -> [Self; 2] {
        f(self)
    }
}
