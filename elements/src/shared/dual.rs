//! Numbers with their derivatives by two variables: exact tangents of closed forms.

use std::ops::{Add, Div, Mul, Neg, Sub};

/// A value and its two derivatives.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(crate) struct Dual {
    pub(crate) x: f64,
    pub(crate) by: [f64; 2],
}

impl Dual {
    pub(crate) const fn constant(x: f64) -> Self {
        Self { x, by: [0.0; 2] }
    }

    /// The variable `i`.
    pub(crate) fn variable(x: f64, i: usize) -> Self {
        let mut by = [0.0; 2];
        by[i] = 1.0;
        Self { x, by }
    }

    /// A function of it with this value and derivative.
    pub(crate) fn map(self, x: f64, slope: f64) -> Self {
        Self { x, by: self.by.map(|d| slope * d) }
    }

    /// A function of it and another with this value and these derivatives.
    fn with(self, o: Self, x: f64, slope: f64, other: f64) -> Self {
        Self { x, by: [0, 1].map(|i| slope * self.by[i] + other * o.by[i]) }
    }

    pub(crate) fn exp_m1(self) -> Self {
        self.map(self.x.exp_m1(), self.x.exp())
    }

    pub(crate) fn ln_1p(self) -> Self {
        self.map(self.x.ln_1p(), 1.0 / (1.0 + self.x))
    }

    /// Root of a number above zero.
    pub(crate) fn sqrt(self) -> Self {
        let root = self.x.sqrt();
        self.map(root, 0.5 / root)
    }
}

impl Add for Dual {
    type Output = Self;
    fn add(self, o: Self) -> Self {
        Self { x: self.x + o.x, by: [self.by[0] + o.by[0], self.by[1] + o.by[1]] }
    }
}

impl Neg for Dual {
    type Output = Self;
    fn neg(self) -> Self {
        self * -1.0
    }
}

impl Sub for Dual {
    type Output = Self;
    fn sub(self, o: Self) -> Self {
        self + -o
    }
}

impl Mul for Dual {
    type Output = Self;
    fn mul(self, o: Self) -> Self {
        self.with(o, self.x * o.x, o.x, self.x)
    }
}

impl Mul<f64> for Dual {
    type Output = Self;
    fn mul(self, o: f64) -> Self {
        self.map(self.x * o, o)
    }
}

impl Add<f64> for Dual {
    type Output = Self;
    fn add(self, o: f64) -> Self {
        Self { x: self.x + o, by: self.by }
    }
}

impl Div for Dual {
    type Output = Self;
    fn div(self, o: Self) -> Self {
        let x = self.x / o.x;
        self.with(o, x, 1.0 / o.x, -x / o.x)
    }
}
