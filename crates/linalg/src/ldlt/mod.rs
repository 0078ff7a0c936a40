//! Sparse LDLᵀ of a symmetric matrix, and the search for equations without stiffness.

mod dissection;
mod failure;
mod numeric;
mod ordering;
mod packing;
mod staged;
mod substitution;
mod subtrees;
mod together;

pub use staged::{StagedLdlt, StagedPlan};

use self::failure::{all_finite, refused};
use crate::{LinalgError, Sparse, Triplets};
use faer::dyn_stack::{MemBuffer, MemStack};
use faer::linalg::cholesky::ldlt::factor::{LdltError, LdltRegularization};
use faer::sparse::linalg::SupernodalThreshold;
use faer::sparse::linalg::cholesky::{
    CholeskySymbolicParams, LdltRef, SymbolicCholesky, SymbolicCholeskyRaw, SymmetricOrdering,
    factorize_symbolic_cholesky, supernodal,
};
use faer::sparse::{SparseColMatRef, SymbolicSparseColMatRef};
use faer::{Conj, MatMut, Par, Side};

/// A factorised symmetric matrix.
pub struct Ldlt {
    symbolic: SymbolicCholesky<usize>,
    values: Vec<f64>,
    work: MemBuffer,
}

impl std::fmt::Debug for Ldlt {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        write!(f, "Ldlt({} values)", self.values.len())
    }
}

/// Right-hand sides solved at once.
const BLOCK: usize = 16;

pub(super) fn backend(e: impl std::fmt::Debug) -> LinalgError {
    LinalgError::Backend { reason: format!("{e:?}") }
}

impl Ldlt {
    /// Factorises `a` (symmetric; the lower triangle is read).
    ///
    /// # Errors
    /// [`LinalgError::Singular`] at an exactly zero pivot, [`LinalgError::NotFinite`] where numbers overflow.
    pub fn new(a: &Sparse) -> Result<Self, LinalgError> {
        Self::regularised(a, LdltRegularization::default())
    }

    /// Factorises a positive semi-definite `a`; equations with a zero pivot get zero solutions.
    ///
    /// # Errors
    /// Where the backend refuses.
    pub fn with_rigid_zeros(a: &Sparse) -> Result<Self, LinalgError> {
        let largest = a.diagonal().into_iter().fold(0.0, f64::max);
        let regularization = LdltRegularization {
            dynamic_regularization_signs: None,
            dynamic_regularization_epsilon: 1e-13 * largest,
            dynamic_regularization_delta: 1e30 * largest.max(1.0),
        };
        let n = a.rows();
        if (0..n).all(|i| a.column(i).0.binary_search(&i).is_ok()) {
            return Self::regularised(a, regularization);
        }
        // Each equation needs its place on the diagonal.
        let mut padded = Triplets::new(n, n);
        for (i, j, v) in a.entries() {
            padded.add(i, j, v);
        }
        for i in 0..n {
            padded.add(i, i, 0.0);
        }
        Self::regularised(&padded.build(), regularization)
    }

    fn regularised(
        a: &Sparse,
        regularization: LdltRegularization<'_, f64>,
    ) -> Result<Self, LinalgError> {
        all_finite(a)?;
        let (offsets, rows, values) = a.0.csc_data();
        let pattern =
            SymbolicSparseColMatRef::new_checked(a.rows(), a.columns(), offsets, None, rows);
        let params = CholeskySymbolicParams {
            supernodal_flop_ratio_threshold: SupernodalThreshold::FORCE_SUPERNODAL,
            ..Default::default()
        };
        let symbolic =
            factorize_symbolic_cholesky(pattern, Side::Lower, SymmetricOrdering::Amd, params)
                .map_err(backend)?;
        let scratch = symbolic
            .factorize_numeric_ldlt_scratch::<f64>(Par::Seq, Default::default())
            .or(symbolic.solve_in_place_scratch::<f64>(BLOCK, Par::Seq));
        let mut work = MemBuffer::try_new(scratch).map_err(backend)?;
        let mut l = vec![0.0; symbolic.len_val()];
        let made = symbolic
            .factorize_numeric_ldlt(
                &mut l,
                SparseColMatRef::new(pattern, values),
                Side::Lower,
                regularization,
                Par::Seq,
                MemStack::new(&mut work),
                Default::default(),
            )
            .map(|_| ())
            .map_err(|LdltError::ZeroPivot { index }| index);
        if let Err(index) = made {
            let forward = symbolic.perm().map(|p| p.arrays().0);
            let equation = |place: usize| match forward {
                Some(forward) => forward.get(place).copied(),
                None => Some(place),
            };
            return Err(refused(&symbolic, &l, index, equation));
        }
        Ok(Self { symbolic, values: l, work })
    }

    /// Solves in place; `x` holds whole right-hand sides of `n` values, one after the other.
    pub fn solve(&mut self, x: &mut [f64]) {
        let n = self.symbolic.nrows();
        if n == 0 {
            return;
        }
        let factor = LdltRef::new(&self.symbolic, &self.values);
        for block in x.chunks_mut(n * BLOCK) {
            let columns = block.len() / n;
            factor.solve_in_place_with_conj(
                Conj::No,
                MatMut::from_column_major_slice_mut(block, n, columns),
                Par::Seq,
                MemStack::new(&mut self.work),
            );
        }
    }

    /// Shows equation and value of every pivot.
    pub fn pivots(&self, mut visit: impl FnMut(usize, f64)) {
        let forward = self.symbolic.perm().map(|p| p.arrays().0);
        let symbolic = match self.symbolic.raw() {
            SymbolicCholeskyRaw::Supernodal(symbolic) => symbolic,
            // Of a matrix without couplings: each column begins with its pivot.
            SymbolicCholeskyRaw::Simplicial(symbolic) => {
                for (place, start) in symbolic.col_ptr().iter().take(symbolic.ncols()).enumerate() {
                    visit(forward.map_or(place, |f| f[place]), self.values[*start]);
                }
                return;
            }
        };
        let l = supernodal::SupernodalLdltRef::new(symbolic, &self.values);
        for k in 0..symbolic.n_supernodes() {
            let node = l.supernode(k);
            for j in 0..node.val().ncols() {
                let place = node.start() + j;
                visit(forward.map_or(place, |f| f[place]), node.val()[(j, j)]);
            }
        }
    }

    /// Number of values in the factor.
    #[must_use]
    pub fn stored(&self) -> usize {
        self.values.len()
    }

    /// Number of negative pivots: the number of eigenvalues below zero.
    #[must_use]
    pub fn negative_pivots(&self) -> usize {
        let mut count = 0;
        self.pivots(|_, d| count += usize::from(d < 0.0));
        count
    }
}

/// Equations of a symmetric positive semi-definite matrix that nothing holds: one for each
/// independent mechanism. The matrix is scaled to unit diagonal first.
///
/// # Errors
/// [`LinalgError::NotFinite`] where the matrix has numbers beyond all bounds; or where the backend refuses.
pub fn unsupported(a: &Sparse) -> Result<Vec<usize>, LinalgError> {
    const HUGE: f64 = 1e30;
    let diagonal = a.diagonal();
    let scale: Vec<f64> =
        diagonal.iter().map(|d| if *d > 0.0 { 1.0 / d.sqrt() } else { 0.0 }).collect();
    let mut found: Vec<usize> = (0..diagonal.len()).filter(|i| diagonal[*i] <= 0.0).collect();
    let mut scaled = Triplets::new(a.rows(), a.columns());
    for (i, j, v) in a.entries() {
        scaled.add(i, j, v * scale[i] * scale[j]);
    }
    for i in &found {
        scaled.add(*i, *i, 1.0);
    }
    let regularization = LdltRegularization {
        dynamic_regularization_signs: None,
        dynamic_regularization_epsilon: 1e-11,
        dynamic_regularization_delta: HUGE,
    };
    Ldlt::regularised(&scaled.build(), regularization)?.pivots(|equation, d| {
        if d.abs() >= 0.5 * HUGE {
            found.push(equation)
        }
    });
    found.sort_unstable();
    found.dedup();
    Ok(found)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn chain(n: usize, anchored: bool) -> Sparse {
        let mut k = Triplets::new(n, n);
        for i in 0..n - 1 {
            for (a, b, v) in [(i, i, 1.0), (i + 1, i + 1, 1.0), (i, i + 1, -1.0), (i + 1, i, -1.0)]
            {
                k.add(a, b, v * 1e7);
            }
        }
        k.add(0, 0, if anchored { 1e7 } else { 0.0 });
        k.build()
    }

    #[test]
    fn an_anchored_chain_is_solved_and_a_free_one_is_reported() {
        let k = chain(50, true);
        let mut x = vec![0.0; 100];
        x[49] = 1e7;
        x[99] = 2e7;
        Ldlt::new(&k).unwrap().solve(&mut x);
        assert!((x[49] - 50.0).abs() < 1e-9 && (x[99] - 100.0).abs() < 1e-9);
        assert!(unsupported(&k).unwrap().is_empty());
        assert_eq!(unsupported(&chain(50, false)).unwrap().len(), 1);
    }

    fn diagonal(values: &[f64]) -> Sparse {
        let mut t = Triplets::new(values.len(), values.len());
        values.iter().enumerate().for_each(|(i, v)| t.add(i, i, *v));
        t.build()
    }

    #[test]
    fn the_pivots_of_a_matrix_without_couplings_are_its_diagonal() {
        let values = [3.0, -1.0, 2.0, -5.0];
        let factor = Ldlt::new(&diagonal(&values)).unwrap();
        let mut found = [0.0; 4];
        factor.pivots(|equation, pivot| found[equation] = pivot);
        assert_eq!(found, values);
        assert_eq!(factor.negative_pivots(), 2);
    }

    #[test]
    fn a_zero_pivot_of_a_matrix_without_couplings_is_named() {
        for equation in 0..3 {
            let mut values = [1.0, 2.0, 3.0];
            values[equation] = 0.0;
            let error = Ldlt::new(&diagonal(&values)).unwrap_err();
            assert_eq!(error, LinalgError::Singular { equation });
        }
    }

    #[test]
    fn numbers_beyond_all_bounds_are_an_error() {
        for wrong in [f64::INFINITY, f64::NEG_INFINITY, f64::NAN] {
            for equation in 0..3 {
                let mut values = [1.0, 2.0, 3.0];
                values[equation] = wrong;
                let (a, expected) = (diagonal(&values), LinalgError::NotFinite { equation });
                assert_eq!(unsupported(&a).unwrap_err(), expected);
                assert_eq!(Ldlt::new(&a).unwrap_err(), expected);
                assert_eq!(Ldlt::with_rigid_zeros(&a).unwrap_err(), expected);
            }
        }
    }

    /// All entries are finite; 1e200²/1e-200 is not.
    #[test]
    fn a_factorisation_that_overflows_is_an_error() {
        let mut t = Triplets::new(2, 2);
        for (i, j, v) in [(0, 0, 1e-200), (1, 0, 1e200), (0, 1, 1e200), (1, 1, 1.0)] {
            t.add(i, j, v);
        }
        let a = t.build();
        let is_overflow = |e: &LinalgError| matches!(e, LinalgError::NotFinite { .. });
        assert!(Ldlt::new(&a).is_err_and(|e| is_overflow(&e)));
        assert!(StagedLdlt::alone(&[(1.0, &a)]).is_err_and(|e| is_overflow(&e)));
        // The sum of two finite matrices.
        let large = diagonal(&[1.0, 1e308]);
        let error = StagedLdlt::alone(&[(1.0, &large), (1.0, &large)]).unwrap_err();
        assert_eq!(error, LinalgError::NotFinite { equation: 1 });
    }
}
