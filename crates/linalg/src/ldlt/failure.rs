//! Why a matrix has no factor: a zero pivot, or numbers that overflow.
//!
//! The backend tells both by one error. Matrices without couplings it factorises column by column and counts their
//! pivots from one there, all others from zero.

use crate::{LinalgError, Sparse};
use faer::sparse::linalg::cholesky::{SymbolicCholesky, SymbolicCholeskyRaw};

/// Refuses a matrix with entries that are infinite or no numbers.
pub(super) fn all_finite(a: &Sparse) -> Result<(), LinalgError> {
    match a.not_finite() {
        None => Ok(()),
        Some(equation) => Err(LinalgError::NotFinite { equation }),
    }
}

/// What the backend means by a pivot that it refuses. `values`: what there is of the factor, the refused pivot
/// included; `index`: as the backend counts; `equation`: of a place in the order of elimination.
pub(super) fn refused(
    symbolic: &SymbolicCholesky<usize>,
    values: &[f64],
    index: usize,
    equation: impl Fn(usize) -> Option<usize>,
) -> LinalgError {
    let place = match symbolic.raw() {
        SymbolicCholeskyRaw::Simplicial(_) => index.saturating_sub(1),
        SymbolicCholeskyRaw::Supernodal(_) => index,
    };
    let equation = equation(place).unwrap_or(place);
    // Dividing by a zero pivot comes after it is refused, so what is not finite has overflowed.
    let overflows = values.iter().any(|v| !v.is_finite());
    if overflows { LinalgError::NotFinite { equation } } else { LinalgError::Singular { equation } }
}
