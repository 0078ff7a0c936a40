//! Matrices of few rows, for products in the inner loop of a step.

use crate::Dense;
use pulp::{Arch, Simd, WithSimd};

/// Columns start at multiples of this many numbers, with zeros behind each: as many as the widest vector of any
/// processor.
const GRAIN: usize = 8;
/// Vectors of a result that stay in registers.
const TILE: usize = 8;

/// A matrix of few rows, column by column, whose columns fill whole vectors: a product takes each vector of the
/// result through all columns without leaving the registers, and without a look at what is left over.
#[derive(Clone, Debug)]
pub struct Panel {
    rows: usize,
    columns: usize,
    values: Vec<f64>,
}

impl Panel {
    /// More rows are no few: longer columns are better read from end to end, as [`Dense`] does it.
    pub const MOST_ROWS: usize = 128;

    /// The same matrix.
    #[must_use]
    pub fn new(of: &Dense) -> Self {
        let (rows, columns) = (of.rows(), of.columns());
        let stride = rows.next_multiple_of(GRAIN);
        let mut values = vec![0.0; stride * columns];
        for j in 0..columns {
            values[j * stride..j * stride + rows].copy_from_slice(of.column(j));
        }
        Self { rows, columns, values }
    }

    /// The same matrix, unless it has too many rows.
    #[must_use]
    pub fn of_few(of: &Dense) -> Option<Self> {
        (of.rows() <= Self::MOST_ROWS).then(|| Self::new(of))
    }

    /// Number of rows.
    #[must_use]
    pub fn rows(&self) -> usize {
        self.rows
    }

    /// `y = A x`.
    ///
    /// # Panics
    /// Where the lengths do not suit.
    pub fn times(&self, x: &[f64], y: &mut [f64]) {
        assert!(x.len() == self.columns && y.len() == self.rows, "lengths of a product");
        Arch::new().dispatch(Times { a: &self.values, x, y });
    }
}

/// A matrix prepared for many products `y = A x`.
#[derive(Clone, Debug)]
pub enum Product {
    /// Of few rows.
    Few(Panel),
    /// Of many.
    Many(Dense),
}

impl Product {
    /// Of a matrix.
    #[must_use]
    pub fn new(of: Dense) -> Self {
        Panel::of_few(&of).map_or_else(|| Self::Many(of), Self::Few)
    }

    /// Number of rows.
    #[must_use]
    pub fn rows(&self) -> usize {
        match self {
            Self::Few(panel) => panel.rows(),
            Self::Many(dense) => dense.rows(),
        }
    }

    /// `y = A x`.
    ///
    /// # Panics
    /// Where the lengths do not suit.
    pub fn times(&self, x: &[f64], y: &mut [f64]) {
        match self {
            Self::Few(panel) => panel.times(x, y),
            Self::Many(dense) => {
                y.fill(0.0);
                dense.mul_add(1.0, x, y);
            }
        }
    }
}

struct Times<'a> {
    a: &'a [f64],
    x: &'a [f64],
    y: &'a mut [f64],
}

impl WithSimd for Times<'_> {
    type Output = ();

    #[inline(always)]
    fn with_simd<S: Simd>(self, simd: S) {
        let Self { a, x, y } = self;
        let stride = y.len().next_multiple_of(GRAIN);
        for (tile, y) in y.chunks_mut(TILE * S::F64_LANES).enumerate() {
            let tile = Tile { simd, a, stride, row: tile * TILE * S::F64_LANES, x };
            match y.len().div_ceil(S::F64_LANES) {
                1 => tile.times::<1>(y),
                2 => tile.times::<2>(y),
                3 => tile.times::<3>(y),
                4 => tile.times::<4>(y),
                5 => tile.times::<5>(y),
                6 => tile.times::<6>(y),
                7 => tile.times::<7>(y),
                _ => tile.times::<8>(y),
            }
        }
    }
}

/// Some rows of a product.
struct Tile<'a, S> {
    simd: S,
    a: &'a [f64],
    stride: usize,
    row: usize,
    x: &'a [f64],
}

impl<S: Simd> Tile<'_, S> {
    /// Of `V` vectors of rows.
    #[inline(always)]
    fn times<const V: usize>(self, y: &mut [f64]) {
        let Self { simd, a, stride, row, x } = self;
        let mut sums = [simd.splat_f64s(0.0); V];
        for (column, x) in a.chunks_exact(stride).zip(x) {
            let (column, _) = S::as_simd_f64s(&column[row..row + V * S::F64_LANES]);
            let x = simd.splat_f64s(*x);
            for k in 0..V {
                sums[k] = simd.mul_add_e_f64s(column[k], x, sums[k]);
            }
        }
        let (full, rest) = S::as_mut_simd_f64s(y);
        if full.len() == V {
            full.copy_from_slice(&sums);
        } else {
            full.copy_from_slice(&sums[..V - 1]);
            let last = [sums[V - 1]];
            for (y, sum) in rest.iter_mut().zip(pulp::bytemuck::cast_slice(&last)) {
                *y = *sum;
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn products_equal_the_sums_written_out_for_all_numbers_of_rows() {
        let number = |i: usize| ((i * 7919 + 13) % 101) as f64 / 50.0 - 1.0;
        for rows in (0..40).chain([63, 64, 65, 96, 127, 128, 150]) {
            for columns in [0, 1, 2, 7, 24] {
                let values = (0..rows * columns).map(number).collect();
                let a = Dense::from_columns(rows, columns, values);
                let x: Vec<f64> = (0..columns).map(|j| number(j + 5)).collect();
                let mut y = vec![9.0; rows];
                Panel::new(&a).times(&x, &mut y);
                for i in 0..rows {
                    let sum: f64 = (0..columns).map(|j| a[(i, j)] * x[j]).sum();
                    assert!((y[i] - sum).abs() < 1e-13, "{rows} × {columns}");
                }
            }
        }
    }
}
