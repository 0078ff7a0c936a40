//! Numbers with their derivatives by some variables: exact tangents of closed forms.

use std::ops::{Add, Div, Mul, Neg, Sub};

/// A value and its derivatives by `N` variables.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Dual<const N: usize = 2> {
    pub(crate) x: f64,
    pub(crate) by: [f64; N],
}

impl<const N: usize> Dual<N> {
    #[inline]
    pub(crate) const fn constant(x: f64) -> Self {
        Self { x, by: [0.0; N] }
    }

    /// The variable `i`; a constant where there are none.
    pub(crate) fn variable(x: f64, i: usize) -> Self {
        let mut by = [0.0; N];
        if N > 0 {
            by[i] = 1.0;
        }
        Self { x, by }
    }

    /// Three variables from `i` on.
    pub(crate) fn variables(x: &[f64], i: usize) -> Dual3<N> {
        [0, 1, 2].map(|k| Self::variable(x[k], i + k))
    }

    /// A function of it with this value and derivative.
    #[inline]
    pub(crate) fn map(mut self, x: f64, slope: f64) -> Self {
        self.x = x;
        for by in &mut self.by {
            *by *= slope;
        }
        self
    }

    /// A function of it and another with this value and these derivatives.
    #[inline]
    pub(crate) fn with(mut self, o: Self, x: f64, slope: f64, other: f64) -> Self {
        self.x = x;
        for i in 0..N {
            self.by[i] = slope * self.by[i] + other * o.by[i];
        }
        self
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

/// A vector of them.
pub(crate) type Dual3<const N: usize> = [Dual<N>; 3];

/// `a · b`.
pub(crate) fn dot<const N: usize>(a: &Dual3<N>, b: &Dual3<N>) -> Dual<N> {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

/// `a × b`.
pub(crate) fn cross<const N: usize>(a: &Dual3<N>, b: &Dual3<N>) -> Dual3<N> {
    [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
}

/// `A x`, A row by row.
pub(crate) fn times<const N: usize>(a: &[Dual3<N>; 3], x: &Dual3<N>) -> Dual3<N> {
    [dot(&a[0], x), dot(&a[1], x), dot(&a[2], x)]
}

/// `Aᵀ x`, A row by row.
pub(crate) fn transposed_times<const N: usize>(a: &[Dual3<N>; 3], x: &Dual3<N>) -> Dual3<N> {
    let row = |j: usize| a[0][j] * x[0] + a[1][j] * x[1] + a[2][j] * x[2];
    [row(0), row(1), row(2)]
}

impl<const N: usize> Add for Dual<N> {
    type Output = Self;
    #[inline]
    fn add(mut self, o: Self) -> Self {
        self.x += o.x;
        for i in 0..N {
            self.by[i] += o.by[i];
        }
        self
    }
}

impl<const N: usize> Neg for Dual<N> {
    type Output = Self;
    #[inline]
    fn neg(mut self) -> Self {
        self.x = -self.x;
        for by in &mut self.by {
            *by = -*by;
        }
        self
    }
}

impl<const N: usize> Sub for Dual<N> {
    type Output = Self;
    #[inline]
    fn sub(mut self, o: Self) -> Self {
        self.x -= o.x;
        for i in 0..N {
            self.by[i] -= o.by[i];
        }
        self
    }
}

impl<const N: usize> Mul for Dual<N> {
    type Output = Self;
    #[inline]
    fn mul(self, o: Self) -> Self {
        self.with(o, self.x * o.x, o.x, self.x)
    }
}

impl<const N: usize> Mul<f64> for Dual<N> {
    type Output = Self;
    #[inline]
    fn mul(self, o: f64) -> Self {
        self.map(self.x * o, o)
    }
}

impl<const N: usize> Add<f64> for Dual<N> {
    type Output = Self;
    fn add(self, o: f64) -> Self {
        Self { x: self.x + o, by: self.by }
    }
}

impl<const N: usize> Div for Dual<N> {
    type Output = Self;
    fn div(self, o: Self) -> Self {
        let x = self.x / o.x;
        self.with(o, x, 1.0 / o.x, -x / o.x)
    }
}
