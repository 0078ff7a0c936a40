//! Numbers with their derivatives by some variables: exact tangents of closed forms, of one analysis or of several side
//! by side.

use super::spatial::{self, M3, transposed};
use std::ops::{Add, Div, Mul, Neg, Sub};
use trilith_element::lanes::Real;

/// A value and its derivatives by `N` variables.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Dual<const N: usize = 2, R = f64> {
    pub(crate) x: R,
    pub(crate) by: [R; N],
}

impl<const N: usize, R: Real> Dual<N, R> {
    #[inline(always)]
    pub(crate) fn constant(x: R) -> Self {
        Self { x, by: [x.of(0.0); N] }
    }

    /// The variable `i`; a constant where there are none.
    #[inline(always)]
    pub(crate) fn variable(x: R, i: usize) -> Self {
        let mut it = Self::constant(x);
        if N > 0 {
            it.by[i] = x.of(1.0);
        }
        it
    }

    /// Three variables from `i` on.
    #[inline(always)]
    pub(crate) fn variables(x: &[R], i: usize) -> Dual3<N, R> {
        [Self::variable(x[0], i), Self::variable(x[1], i + 1), Self::variable(x[2], i + 2)]
    }

    /// A function of it with this value and derivative.
    #[inline(always)]
    pub(crate) fn map(mut self, x: R, slope: R) -> Self {
        self.x = x;
        for by in &mut self.by {
            *by = *by * slope;
        }
        self
    }

    /// A function of it and another with this value and these derivatives.
    #[inline(always)]
    pub(crate) fn with(mut self, o: Self, x: R, slope: R, other: R) -> Self {
        self.x = x;
        for i in 0..N {
            self.by[i] = slope.mul_add(self.by[i], other * o.by[i]);
        }
        self
    }

    /// Root of a number above zero.
    #[inline(always)]
    pub(crate) fn sqrt(self) -> Self {
        let root = self.x.sqrt();
        self.map(root, root.of(0.5) / root)
    }

    /// The first where yes, the second where no.
    #[inline(always)]
    pub(crate) fn select(mask: R::Mask, yes: Self, no: Self) -> Self {
        let mut it = yes;
        it.x = R::select(mask, yes.x, no.x);
        for i in 0..N {
            it.by[i] = R::select(mask, yes.by[i], no.by[i]);
        }
        it
    }

    /// The number where yes, zero where no.
    #[inline(always)]
    pub(crate) fn only(self, mask: R::Mask) -> Self {
        Self::select(mask, self, Self::constant(self.x.of(0.0)))
    }
}

impl<const N: usize> Dual<N> {
    pub(crate) fn exp_m1(self) -> Self {
        self.map(self.x.exp_m1(), self.x.exp())
    }

    pub(crate) fn ln_1p(self) -> Self {
        self.map(self.x.ln_1p(), 1.0 / (1.0 + self.x))
    }
}

/// A vector of them.
pub(crate) type Dual3<const N: usize, R = f64> = [Dual<N, R>; 3];

/// `a · b`.
#[inline(always)]
pub(crate) fn dot<const N: usize, R: Real>(a: &Dual3<N, R>, b: &Dual3<N, R>) -> Dual<N, R> {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

/// `a × b`.
#[inline(always)]
pub(crate) fn cross<const N: usize, R: Real>(a: &Dual3<N, R>, b: &Dual3<N, R>) -> Dual3<N, R> {
    [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
}

/// `A x`, A row by row.
#[inline(always)]
pub(crate) fn times<const N: usize, R: Real>(a: &[Dual3<N, R>; 3], x: &Dual3<N, R>) -> Dual3<N, R> {
    [dot(&a[0], x), dot(&a[1], x), dot(&a[2], x)]
}

/// `Aᵀ x`, A row by row.
#[inline(always)]
pub(crate) fn transposed_times<const N: usize, R: Real>(
    a: &[Dual3<N, R>; 3],
    x: &Dual3<N, R>,
) -> Dual3<N, R> {
    let mut y = *x;
    for j in 0..3 {
        y[j] = a[0][j] * x[0] + a[1][j] * x[1] + a[2][j] * x[2];
    }
    y
}

/// R, row by row, with its derivatives by φ, which are the variables from `first` on, if there are any; `jacobian`
/// is Jᵣ(φ).
#[inline(always)]
pub(crate) fn rotation<const N: usize, R: Real>(
    matrix: &M3<R>,
    jacobian: &M3<R>,
    first: usize,
) -> [Dual3<N, R>; 3] {
    let mut all = [[Dual::constant(matrix[0][0]); 3]; 3];
    for i in 0..3 {
        for j in 0..3 {
            all[i][j].x = matrix[i][j];
        }
    }
    if N > 0 {
        // A row of R [Jᵣ eₖ]× is that of R across Jᵣ eₖ.
        let columns = transposed(jacobian);
        for i in 0..3 {
            for k in 0..3 {
                let change = spatial::cross(&matrix[i], &columns[k]);
                for j in 0..3 {
                    all[i][j].by[first + k] = change[j];
                }
            }
        }
    }
    all
}

impl<const N: usize, R: Real> Add for Dual<N, R> {
    type Output = Self;
    #[inline(always)]
    fn add(mut self, o: Self) -> Self {
        self.x = self.x + o.x;
        for i in 0..N {
            self.by[i] = self.by[i] + o.by[i];
        }
        self
    }
}

impl<const N: usize, R: Real> Neg for Dual<N, R> {
    type Output = Self;
    #[inline(always)]
    fn neg(mut self) -> Self {
        self.x = -self.x;
        for by in &mut self.by {
            *by = -*by;
        }
        self
    }
}

impl<const N: usize, R: Real> Sub for Dual<N, R> {
    type Output = Self;
    #[inline(always)]
    fn sub(mut self, o: Self) -> Self {
        self.x = self.x - o.x;
        for i in 0..N {
            self.by[i] = self.by[i] - o.by[i];
        }
        self
    }
}

impl<const N: usize, R: Real> Mul for Dual<N, R> {
    type Output = Self;
    #[inline(always)]
    fn mul(self, o: Self) -> Self {
        self.with(o, self.x * o.x, o.x, self.x)
    }
}

impl<const N: usize, R: Real> Mul<R> for Dual<N, R> {
    type Output = Self;
    #[inline(always)]
    fn mul(self, o: R) -> Self {
        self.map(self.x * o, o)
    }
}

impl<const N: usize, R: Real> Add<R> for Dual<N, R> {
    type Output = Self;
    #[inline(always)]
    fn add(self, o: R) -> Self {
        Self { x: self.x + o, by: self.by }
    }
}

impl<const N: usize, R: Real> Div for Dual<N, R> {
    type Output = Self;
    #[inline(always)]
    fn div(self, o: Self) -> Self {
        let back = o.x.of(1.0) / o.x;
        let x = self.x / o.x;
        self.with(o, x, back, -x * back)
    }
}
