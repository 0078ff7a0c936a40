//! Matrices prepared for many products with vectors.

use crate::aligned::{Aligned, LINE};
use crate::simd::dispatch;
use crate::{Dense, Panel};
use pulp::{Simd, WithSimd};

/// A matrix prepared for many products `y = A x`.
#[derive(Clone, Debug)]
pub enum Product {
    /// Of so few rows that columns would leave vectors empty.
    Rows(Rows),
    /// Of few rows.
    Few(Panel),
    /// Of many.
    Many(Dense),
}

impl Product {
    /// Of a matrix.
    #[must_use]
    pub fn new(of: Dense) -> Self {
        if of.rows() <= Rows::MOST {
            return Self::Rows(Rows::new(of));
        }
        Panel::of_few(&of).map_or_else(|| Self::Many(of), Self::Few)
    }

    /// Number of rows.
    #[must_use]
    pub fn rows(&self) -> usize {
        match self {
            Self::Rows(rows) => rows.of.rows(),
            Self::Few(panel) => panel.rows(),
            Self::Many(dense) => dense.rows(),
        }
    }

    /// Number of columns.
    #[must_use]
    pub fn columns(&self) -> usize {
        match self {
            Self::Rows(rows) => rows.of.columns(),
            Self::Few(panel) => panel.columns(),
            Self::Many(dense) => dense.columns(),
        }
    }

    /// One column.
    #[must_use]
    pub fn column(&self, j: usize) -> &[f64] {
        match self {
            Self::Rows(rows) => rows.of.column(j),
            Self::Few(panel) => panel.column(j),
            Self::Many(dense) => dense.column(j),
        }
    }

    /// `y = A x`.
    ///
    /// # Panics
    /// Where the lengths do not suit.
    #[inline]
    pub fn times(&self, x: &[f64], y: &mut [f64]) {
        match self {
            Self::Rows(rows) => rows.times(x, y),
            Self::Few(panel) => panel.times(x, y),
            Self::Many(dense) => {
                y.fill(0.0);
                dense.mul_add(1.0, x, y);
            }
        }
    }
}

/// A matrix of very few rows, row by row: each is summed from end to end, in as many turns side by side as a cache line
/// has numbers. So the order of the sums is that of every processor.
#[derive(Clone, Debug)]
pub struct Rows {
    of: Dense,
    /// Numbers from row to row, and the rows, with zeros behind each.
    stride: usize,
    values: Aligned,
}

impl Rows {
    /// With more rows their columns fill enough of a vector.
    const MOST: usize = LINE / 2;

    fn new(of: Dense) -> Self {
        let stride = of.columns().next_multiple_of(LINE).max(LINE);
        let mut values = Aligned::zeros(stride * of.rows());
        for i in 0..of.rows() {
            for j in 0..of.columns() {
                values[i * stride + j] = of[(i, j)];
            }
        }
        Self { of, stride, values }
    }

    fn times(&self, x: &[f64], y: &mut [f64]) {
        assert!(x.len() == self.of.columns() && y.len() == self.of.rows(), "lengths of a product");
        dispatch(Dots { rows: &self.values, stride: self.stride, x, y });
    }
}

/// Dots of rows with one vector.
struct Dots<'a> {
    rows: &'a [f64],
    stride: usize,
    x: &'a [f64],
    y: &'a mut [f64],
}

impl WithSimd for Dots<'_> {
    type Output = ();

    #[inline(always)]
    fn with_simd<S: Simd>(self, simd: S) {
        let (x, rest) = self.x.as_chunks::<LINE>();
        let mut last = [0.0; LINE];
        if !rest.is_empty() {
            last[..rest.len()].copy_from_slice(rest);
        }
        for (row, y) in self.rows.chunks_exact(self.stride).zip(self.y) {
            let (row, _) = row.as_chunks::<LINE>();
            // As many of them as there are vectors in a line.
            let mut sums = [simd.splat_f64s(0.0); LINE];
            for (a, x) in row.iter().zip(x) {
                add(simd, a, x, &mut sums);
            }
            if !rest.is_empty()
                && let Some(a) = row.last()
            {
                add(simd, a, &last, &mut sums);
            }
            let mut left = LINE / S::F64_LANES;
            while left > 1 {
                left /= 2;
                for k in 0..left {
                    sums[k] = simd.add_f64s(sums[k], sums[k + left]);
                }
            }
            *y = simd.reduce_sum_f64s(sums[0]);
        }
    }
}

/// Sums take a line of a row.
#[inline(always)]
fn add<S: Simd>(simd: S, a: &[f64; LINE], x: &[f64; LINE], sums: &mut [S::f64s; LINE]) {
    let ((a, _), (x, _)) = (S::as_simd_f64s(a), S::as_simd_f64s(x));
    for k in 0..LINE / S::F64_LANES {
        sums[k] = simd.mul_add_e_f64s(a[k], x[k], sums[k]);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn products_equal_the_sums_written_out_for_all_numbers_of_rows() {
        let number = |i: usize| ((i * 7919 + 13) % 101) as f64 / 50.0 - 1.0;
        for rows in (0..10).chain([127, 128, 129]) {
            for columns in [0, 1, 2, 3, 5, 7, 8, 9, 24] {
                let values = (0..rows * columns).map(number).collect();
                let a = Dense::from_columns(rows, columns, values);
                let x: Vec<f64> = (0..columns).map(|j| number(j + 5)).collect();
                let mut y = vec![9.0; rows];
                let product = Product::new(a.clone());
                product.times(&x, &mut y);
                assert_eq!((product.rows(), product.columns()), (rows, columns));
                (0..columns).for_each(|j| assert_eq!(product.column(j), a.column(j)));
                for i in 0..rows {
                    let sum: f64 = (0..columns).map(|j| a[(i, j)] * x[j]).sum();
                    assert!((y[i] - sum).abs() < 1e-13, "{rows} × {columns}");
                }
            }
        }
    }
}
