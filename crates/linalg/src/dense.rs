//! Dense matrices in column-major order, dense LU and dense inverses.

use crate::gemv;
use faer::linalg::matmul::matmul;
use faer::linalg::solvers::{Llt, PartialPivLu, Solve};
use faer::{Accum, MatMut, MatRef, Par, Side};

/// A dense matrix, column by column.
#[derive(Clone, Debug, PartialEq)]
pub struct Dense {
    rows: usize,
    columns: usize,
    values: Vec<f64>,
}

impl Dense {
    /// Zero matrix.
    #[must_use]
    pub fn zeros(rows: usize, columns: usize) -> Self {
        Self { rows, columns, values: vec![0.0; rows * columns] }
    }

    /// A matrix from its columns, one after the other.
    ///
    /// # Panics
    /// Where the length does not suit.
    #[must_use]
    pub fn from_columns(rows: usize, columns: usize, values: Vec<f64>) -> Self {
        assert_eq!(values.len(), rows * columns, "values of a dense matrix");
        Self { rows, columns, values }
    }

    /// The unit matrix.
    #[must_use]
    pub fn identity(size: usize) -> Self {
        let mut all = Self::zeros(size, size);
        (0..size).for_each(|i| all[(i, i)] = 1.0);
        all
    }

    /// The first rows and columns.
    ///
    /// # Panics
    /// Where there are fewer.
    #[must_use]
    pub fn leading(&self, rows: usize, columns: usize) -> Self {
        let values = (0..columns).flat_map(|j| self.column(j)[..rows].iter().copied());
        Self::from_columns(rows, columns, values.collect())
    }

    /// Number of rows.
    #[must_use]
    pub fn rows(&self) -> usize {
        self.rows
    }

    /// Number of columns.
    #[must_use]
    pub fn columns(&self) -> usize {
        self.columns
    }

    /// All values, column by column.
    #[must_use]
    pub fn values(&self) -> &[f64] {
        &self.values
    }

    /// All values, to be changed.
    pub fn values_mut(&mut self) -> &mut [f64] {
        &mut self.values
    }

    /// One column.
    #[must_use]
    pub fn column(&self, j: usize) -> &[f64] {
        &self.values[j * self.rows..(j + 1) * self.rows]
    }

    /// One column, to be changed.
    pub fn column_mut(&mut self, j: usize) -> &mut [f64] {
        &mut self.values[j * self.rows..(j + 1) * self.rows]
    }

    /// `y += s · A x`.
    ///
    /// # Panics
    /// Where the lengths do not suit.
    pub fn mul_add(&self, s: f64, x: &[f64], y: &mut [f64]) {
        assert!(x.len() == self.columns && y.len() == self.rows, "lengths of a product");
        gemv::add_columns(&self.values, s, x, y);
    }

    /// `y += s · Aᵀ x`.
    ///
    /// # Panics
    /// Where the lengths do not suit.
    pub fn transpose_mul_add(&self, s: f64, x: &[f64], y: &mut [f64]) {
        assert!(x.len() == self.rows && y.len() == self.columns, "lengths of a product");
        gemv::add_dots(&self.values, s, [x], [y]);
    }

    /// `y += s · A x` for all pairs (x, y), reading A once for several of them. The same values as one
    /// after the other.
    ///
    /// # Panics
    /// Where the lengths do not suit.
    pub fn mul_add_each(&self, s: f64, pairs: &mut [(&[f64], &mut [f64])]) {
        for (x, y) in pairs.iter() {
            assert!(x.len() == self.columns && y.len() == self.rows, "lengths of a product");
        }
        let mut parts = pairs.chunks_exact_mut(4);
        for part in &mut parts {
            let [a, b, c, d] = part else { continue };
            gemv::add_columns_each(&self.values, s, [a.0, b.0, c.0, d.0], [a.1, b.1, c.1, d.1]);
        }
        for (x, y) in parts.into_remainder() {
            gemv::add_columns(&self.values, s, x, y);
        }
    }

    /// `y += s · Aᵀ x` for all pairs (x, y), likewise.
    ///
    /// # Panics
    /// Where the lengths do not suit.
    pub fn transpose_mul_add_each(&self, s: f64, pairs: &mut [(&[f64], &mut [f64])]) {
        for (x, y) in pairs.iter() {
            assert!(x.len() == self.rows && y.len() == self.columns, "lengths of a product");
        }
        let mut parts = pairs.chunks_exact_mut(4);
        for part in &mut parts {
            let [a, b, c, d] = part else { continue };
            gemv::add_dots(&self.values, s, [a.0, b.0, c.0, d.0], [a.1, b.1, c.1, d.1]);
        }
        for (x, y) in parts.into_remainder() {
            gemv::add_dots(&self.values, s, [x], [y]);
        }
    }

    /// `x` times column j.
    ///
    /// # Panics
    /// Where the length does not suit.
    #[must_use]
    pub fn column_dot(&self, j: usize, x: &[f64]) -> f64 {
        crate::dot(self.column(j), x)
    }

    /// The transpose.
    #[must_use]
    pub fn transpose(&self) -> Self {
        let mut t = Self::zeros(self.columns, self.rows);
        for j in 0..self.columns {
            for i in 0..self.rows {
                t[(j, i)] = self[(i, j)];
            }
        }
        t
    }

    /// `A B`.
    #[must_use]
    pub fn times(&self, b: &Self) -> Self {
        let mut c = Self::zeros(self.rows, b.columns);
        matmul(c.as_mut(), Accum::Replace, self.as_ref(), b.as_ref(), 1.0, Par::Seq);
        c
    }

    /// `Aᵀ B`.
    #[must_use]
    pub fn transpose_times(&self, b: &Self) -> Self {
        let mut c = Self::zeros(self.columns, b.columns);
        matmul(c.as_mut(), Accum::Replace, self.as_ref().transpose(), b.as_ref(), 1.0, Par::Seq);
        c
    }

    /// `A Bᵀ`.
    #[must_use]
    pub fn times_transpose(&self, b: &Self) -> Self {
        let mut c = Self::zeros(self.rows, b.rows);
        matmul(c.as_mut(), Accum::Replace, self.as_ref(), b.as_ref().transpose(), 1.0, Par::Seq);
        c
    }

    pub(crate) fn as_ref(&self) -> MatRef<'_, f64> {
        MatRef::from_column_major_slice(&self.values, self.rows, self.columns)
    }

    pub(crate) fn as_mut(&mut self) -> MatMut<'_, f64> {
        MatMut::from_column_major_slice_mut(&mut self.values, self.rows, self.columns)
    }
}

impl std::ops::Index<(usize, usize)> for Dense {
    type Output = f64;
    fn index(&self, (i, j): (usize, usize)) -> &f64 {
        &self.values[j * self.rows + i]
    }
}

impl std::ops::IndexMut<(usize, usize)> for Dense {
    fn index_mut(&mut self, (i, j): (usize, usize)) -> &mut f64 {
        &mut self.values[j * self.rows + i]
    }
}

/// A factorised dense square matrix.
#[derive(Clone, Debug)]
pub struct DenseLu(PartialPivLu<f64>);

impl DenseLu {
    /// Factorises with partial pivoting. A singular matrix shows in values that are not finite after
    /// [`solve`](Self::solve).
    #[must_use]
    pub fn new(a: &Dense) -> Self {
        Self(PartialPivLu::new(a.as_ref()))
    }

    /// Solves in place.
    pub fn solve(&self, x: &mut [f64]) {
        let n = x.len();
        self.0.solve_in_place(MatMut::from_column_major_slice_mut(x, n, 1));
    }

    /// Solves for all columns in place.
    pub fn solve_columns(&self, b: &mut Dense) {
        self.0.solve_in_place(b.as_mut());
    }
}

/// The inverse of a positive definite matrix whose lower triangle this is; none where a pivot of its Cholesky factor is
/// no more than this share of its entry on the diagonal. For many products with a small matrix: each is cheaper than
/// a substitution.
#[must_use]
pub fn positive_inverse(a: &Dense, share: f64) -> Option<Dense> {
    let factor = Llt::new(a.as_ref(), Side::Lower).ok()?;
    let (l, n) = (factor.L(), a.columns());
    if (0..n).any(|i| l[(i, i)] * l[(i, i)] <= share * a[(i, i)]) {
        return None;
    }
    let mut inverse = Dense::zeros(n, n);
    (0..n).for_each(|i| inverse[(i, i)] = 1.0);
    factor.solve_in_place(inverse.as_mut());
    Some(inverse)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_positive_matrix_is_inverted_and_a_singular_one_is_none() {
        let a = |last: f64| Dense::from_columns(2, 2, vec![4.0, 2.0, f64::NAN, last]);
        let inverse = positive_inverse(&a(3.0), 1e-11).unwrap();
        for (found, expected) in inverse.values().iter().zip([0.375, -0.25, -0.25, 0.5]) {
            assert!((found - expected).abs() < 1e-14, "{inverse:?}");
        }
        assert!(positive_inverse(&a(1.0 + 1e-12), 1e-11).is_none());
        assert!(positive_inverse(&a(0.5), 1e-11).is_none());
    }

    #[test]
    fn an_unsymmetric_system_is_solved() {
        let a = Dense::from_columns(2, 2, vec![0.0, 2.0, 1.0, 3.0]);
        let mut x = vec![1.0, 8.0];
        DenseLu::new(&a).solve(&mut x);
        assert!((x[0] - 2.5).abs() < 1e-14 && (x[1] - 1.0).abs() < 1e-14);
    }
}
