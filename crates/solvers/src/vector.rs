//! Sums over vectors.

pub(crate) use trilith_linalg::{add, dot, equal, largest, residual, sized_residual};

/// The larger of two; the first where the second is not a number.
#[inline]
pub(crate) fn larger(a: f64, b: f64) -> f64 {
    if b > a { b } else { a }
}
