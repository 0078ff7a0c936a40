//! Vectors of numbers with their derivatives by some variables: exact tangents of closed forms, of one analysis or of
//! several side by side.

use super::spatial::{self, M3, transposed};
pub(crate) use trilith_element::lanes::Dual;
use trilith_element::lanes::Real;

/// A vector of them.
pub(crate) type Dual3<const N: usize, R = f64> = [Dual<N, R>; 3];

/// The same number with the first of its derivatives alone.
#[inline(always)]
pub(crate) fn by_fewer<const N: usize, const M: usize, R: Real>(it: Dual<N, R>) -> Dual<M, R> {
    let mut fewer = Dual::constant(it.x);
    for i in 0..M {
        fewer.by[i] = it.by[i];
    }
    fewer
}

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
