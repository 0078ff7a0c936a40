//! A number with its derivative in one direction.

use std::ops::{Add, Div, Mul, Neg, Sub};

/// Value and derivative.
#[derive(Clone, Copy, Debug, Default)]
pub struct Dual(pub f64, pub f64);

impl From<f64> for Dual {
    fn from(x: f64) -> Self {
        Self(x, 0.0)
    }
}
impl Add for Dual {
    type Output = Self;
    fn add(self, o: Self) -> Self {
        Self(self.0 + o.0, self.1 + o.1)
    }
}
impl Sub for Dual {
    type Output = Self;
    fn sub(self, o: Self) -> Self {
        Self(self.0 - o.0, self.1 - o.1)
    }
}
impl Mul for Dual {
    type Output = Self;
    fn mul(self, o: Self) -> Self {
        Self(self.0 * o.0, self.1 * o.0 + self.0 * o.1)
    }
}
impl Div for Dual {
    type Output = Self;
    fn div(self, o: Self) -> Self {
        Self(self.0 / o.0, (self.1 - self.0 / o.0 * o.1) / o.0)
    }
}
impl Mul<Dual> for f64 {
    type Output = Dual;
    fn mul(self, o: Dual) -> Dual {
        Dual(self * o.0, self * o.1)
    }
}
impl Neg for Dual {
    type Output = Self;
    fn neg(self) -> Self {
        Self(-self.0, -self.1)
    }
}

impl Dual {
    /// sgn(x) |x|^p; the slope at 0 is that of a number near it, so that it is finite.
    #[must_use]
    pub fn signed_power(self, p: f64) -> Self {
        let x = self.0.abs().max(1e-30);
        Self(self.0.signum() * self.0.abs().powf(p), p * x.powf(p - 1.0) * self.1)
    }

    /// Root of a number that is not negative.
    #[must_use]
    pub fn root(self) -> Self {
        let r = self.0.max(0.0).sqrt();
        Self(r, if r > 0.0 { 0.5 * self.1 / r } else { 0.0 })
    }

    /// Sine and cosine.
    #[must_use]
    pub fn sin_cos(self) -> (Self, Self) {
        let (sin, cos) = self.0.sin_cos();
        (Self(sin, cos * self.1), Self(cos, -sin * self.1))
    }

    /// e to it.
    #[must_use]
    pub fn exp(self) -> Self {
        let e = self.0.exp();
        Self(e, e * self.1)
    }

    /// The larger of it and 0; at 0 it rises.
    #[must_use]
    pub fn above_zero(self) -> Self {
        if self.0 >= 0.0 { self } else { Self::default() }
    }
}
