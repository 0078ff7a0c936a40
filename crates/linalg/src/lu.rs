//! Sparse LU of an unsymmetric matrix (friction makes tangents unsymmetric).

use crate::{LinalgError, Sparse};
use faer::MatMut;
use faer::linalg::solvers::Solve;
use faer::sparse::linalg::solvers::{Lu, SymbolicLu};
use faer::sparse::{SparseColMatRef, SymbolicSparseColMatRef};

/// A factorised square matrix.
#[derive(Debug)]
pub struct SparseLu(Lu<usize, f64>);

impl SparseLu {
    /// Factorises `a`.
    ///
    /// # Errors
    /// [`LinalgError::Backend`] for a structurally singular matrix. A numerically singular one shows
    /// in values that are not finite after [`solve`](Self::solve).
    pub fn new(a: &Sparse) -> Result<Self, LinalgError> {
        let backend = |e: &dyn std::fmt::Debug| LinalgError::Backend { reason: format!("{e:?}") };
        let (offsets, rows, values) = a.0.csc_data();
        let pattern =
            SymbolicSparseColMatRef::new_checked(a.rows(), a.columns(), offsets, None, rows);
        let symbolic = SymbolicLu::try_new(pattern).map_err(|e| backend(&e))?;
        Lu::try_new_with_symbolic(symbolic, SparseColMatRef::new(pattern, values))
            .map(Self)
            .map_err(|e| backend(&e))
    }

    /// Solves in place.
    pub fn solve(&self, x: &mut [f64]) {
        let n = x.len();
        self.0.solve_in_place(MatMut::from_column_major_slice_mut(x, n, 1));
    }
}
