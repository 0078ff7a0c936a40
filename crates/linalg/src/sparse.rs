//! Sparse matrices in compressed columns, full storage (both triangles).

use nalgebra_sparse::{CooMatrix, CscMatrix};

/// Entries (row, column, value) that are summed into a [`Sparse`] matrix.
#[derive(Clone, Debug)]
pub struct Triplets(CooMatrix<f64>);

impl Triplets {
    /// No entries yet.
    #[must_use]
    pub fn new(rows: usize, columns: usize) -> Self {
        Self(CooMatrix::new(rows, columns))
    }

    /// Adds a value; entries at one place are summed.
    ///
    /// # Panics
    /// Where the place is outside the matrix.
    pub fn add(&mut self, row: usize, column: usize, value: f64) {
        self.0.push(row, column, value);
    }

    /// The matrix.
    #[must_use]
    pub fn build(&self) -> Sparse {
        Sparse(CscMatrix::from(&self.0))
    }
}

/// A sparse matrix.
#[derive(Clone, Debug, PartialEq)]
pub struct Sparse(pub(crate) CscMatrix<f64>);

impl Sparse {
    /// The zero matrix.
    #[must_use]
    pub fn zeros(rows: usize, columns: usize) -> Self {
        Self(CscMatrix::zeros(rows, columns))
    }

    /// Number of rows.
    #[must_use]
    pub fn rows(&self) -> usize {
        self.0.nrows()
    }

    /// Number of columns.
    #[must_use]
    pub fn columns(&self) -> usize {
        self.0.ncols()
    }

    /// Number of stored entries.
    #[must_use]
    pub fn stored(&self) -> usize {
        self.0.nnz()
    }

    /// Stored entries (row, column, value), column by column.
    pub fn entries(&self) -> impl Iterator<Item = (usize, usize, f64)> + '_ {
        self.0.triplet_iter().map(|(i, j, v)| (i, j, *v))
    }

    /// Rows and values of one column.
    #[must_use]
    pub fn column(&self, j: usize) -> (&[usize], &[f64]) {
        let (offsets, rows, values) = self.0.csc_data();
        let range = offsets[j]..offsets[j + 1];
        (&rows[range.clone()], &values[range])
    }

    /// The diagonal.
    #[must_use]
    pub fn diagonal(&self) -> Vec<f64> {
        let mut d = vec![0.0; self.columns().min(self.rows())];
        for (i, j, v) in self.entries() {
            if i == j {
                d[i] += v;
            }
        }
        d
    }

    /// `y += s · A x`. Lengths: `x` columns, `y` rows.
    pub fn mul_add(&self, s: f64, x: &[f64], y: &mut [f64]) {
        for j in 0..self.columns() {
            let t = s * x[j];
            if t != 0.0 {
                let (rows, values) = self.column(j);
                for (i, v) in rows.iter().zip(values) {
                    y[*i] += t * v;
                }
            }
        }
    }

    /// `A x`.
    #[must_use]
    pub fn mul(&self, x: &[f64]) -> Vec<f64> {
        let mut y = vec![0.0; self.rows()];
        self.mul_add(1.0, x, &mut y);
        y
    }

    /// `y += s · Aᵀ x`. Lengths: `x` rows, `y` columns.
    pub fn transpose_mul_add(&self, s: f64, x: &[f64], y: &mut [f64]) {
        for j in 0..self.columns() {
            let (rows, values) = self.column(j);
            y[j] += s * rows.iter().zip(values).map(|(i, v)| v * x[*i]).sum::<f64>();
        }
    }

    /// `xᵀ A y`.
    #[must_use]
    pub fn bilinear(&self, x: &[f64], y: &[f64]) -> f64 {
        (0..self.columns())
            .map(|j| {
                let (rows, values) = self.column(j);
                y[j] * rows.iter().zip(values).map(|(i, v)| v * x[*i]).sum::<f64>()
            })
            .sum()
    }

    /// `Σ factor · matrix`, all of one size.
    ///
    /// # Panics
    /// Where there is no matrix or the sizes differ.
    #[must_use]
    pub fn combine(parts: &[(f64, &Self)]) -> Self {
        let (rows, columns) = (parts[0].1.rows(), parts[0].1.columns());
        let mut sum = Triplets::new(rows, columns);
        for (factor, part) in parts.iter().filter(|(f, _)| *f != 0.0) {
            for (i, j, v) in part.entries() {
                sum.add(i, j, factor * v);
            }
        }
        sum.build()
    }

    /// Tᵀ A T, by sprs.
    #[must_use]
    pub fn congruence(&self, t: &Self) -> Self {
        let (a, t) = (self.to_sprs(), t.to_sprs());
        let transposed = t.transpose_view().to_csc();
        let product = &(&transposed * &a).to_csc() * &t;
        Self::from_sprs(product.to_csc())
    }

    /// The block of the given rows and columns (both sorted).
    #[must_use]
    pub fn block(&self, rows: &[usize], columns: &[usize]) -> Self {
        let mut place = vec![usize::MAX; self.rows()];
        for (new, old) in rows.iter().enumerate() {
            place[*old] = new;
        }
        let mut block = Triplets::new(rows.len(), columns.len());
        for (new, old) in columns.iter().enumerate() {
            let (r, v) = self.column(*old);
            for (i, x) in r.iter().zip(v).filter(|(i, _)| place[**i] != usize::MAX) {
                block.add(place[*i], new, *x);
            }
        }
        block.build()
    }

    pub(crate) fn to_sprs(&self) -> sprs::CsMat<f64> {
        let (offsets, rows, values) = self.0.csc_data();
        sprs::CsMat::new_csc(
            (self.rows(), self.columns()),
            offsets.to_vec(),
            rows.to_vec(),
            values.to_vec(),
        )
    }

    fn from_sprs(a: sprs::CsMat<f64>) -> Self {
        let mut triplets = Triplets::new(a.rows(), a.cols());
        for (v, (i, j)) in a.iter() {
            triplets.add(i, j, *v);
        }
        triplets.build()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn sample() -> Sparse {
        let mut t = Triplets::new(2, 3);
        for (i, j, v) in [(0, 0, 1.0), (1, 0, 2.0), (0, 2, 3.0), (0, 0, 0.5)] {
            t.add(i, j, v);
        }
        t.build()
    }

    #[test]
    fn entries_at_one_place_are_summed() {
        assert_eq!(sample().mul(&[1.0, 1.0, 1.0]), vec![4.5, 2.0]);
    }

    #[test]
    fn congruence_equals_the_product_by_hand() {
        let mut k = Triplets::new(2, 2);
        for (i, j, v) in [(0, 0, 2.0), (0, 1, -1.0), (1, 0, -1.0), (1, 1, 3.0)] {
            k.add(i, j, v);
        }
        let reduced = k.build().congruence(&sample());
        let x = [1.0, 2.0, 3.0];
        let tx = sample().mul(&x);
        let expected = 2.0 * tx[0] * tx[0] - 2.0 * tx[0] * tx[1] + 3.0 * tx[1] * tx[1];
        assert!((reduced.bilinear(&x, &x) - expected).abs() < 1e-12);
    }
}
