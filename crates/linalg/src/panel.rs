//! Matrices of few rows, for products in the inner loop of a step.

use crate::Dense;
use crate::aligned::{Aligned, LINE};
use crate::simd::dispatch;
use pulp::{Simd, WithSimd};

const GRAIN: usize = Panel::GRAIN;
/// Vectors of a result that stay in registers.
const TILE: usize = 8;

/// A matrix of few rows, column by column, whose columns fill whole vectors: a product takes each vector of the
/// result through all columns without leaving the registers, and without a look at what is left over. Columns of
/// very few rows are summed in several turns side by side: one sum would wait for itself.
#[derive(Clone, Debug)]
pub struct Panel {
    rows: usize,
    columns: usize,
    /// Numbers from column to column.
    stride: usize,
    values: Aligned,
}

impl Panel {
    /// Columns start at multiples of this many numbers, with zeros behind each: as many as the widest vector of any
    /// processor.
    pub const GRAIN: usize = LINE;

    /// More rows are no few: longer columns are better read from end to end, as [`Dense`] does it.
    pub const MOST_ROWS: usize = 128;

    /// Zero matrix.
    #[must_use]
    pub fn zeros(rows: usize, columns: usize) -> Self {
        let stride = rows.next_multiple_of(GRAIN);
        Self { rows, columns, stride, values: Aligned::zeros(stride * columns) }
    }

    /// The same matrix.
    #[must_use]
    pub fn new(of: &Dense) -> Self {
        let mut same = Self::zeros(of.rows(), of.columns());
        for j in 0..of.columns() {
            same.column_mut(j).copy_from_slice(of.column(j));
        }
        same
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

    /// Number of columns.
    #[must_use]
    pub fn columns(&self) -> usize {
        self.columns
    }

    /// One column.
    #[must_use]
    pub fn column(&self, j: usize) -> &[f64] {
        &self.values[j * self.stride..][..self.rows]
    }

    /// One column, to be changed.
    pub fn column_mut(&mut self, j: usize) -> &mut [f64] {
        &mut self.values[j * self.stride..][..self.rows]
    }

    /// `y = A x`.
    ///
    /// # Panics
    /// Where the lengths do not suit.
    pub fn times(&self, x: &[f64], y: &mut [f64]) {
        assert!(x.len() == self.columns && y.len() == self.rows, "lengths of a product");
        dispatch(Times::<false> { a: &self.values, stride: self.stride, x, y });
    }

    /// Number of rows with the zeros that fill up whole vectors.
    #[must_use]
    pub fn filled(&self) -> usize {
        self.stride
    }

    /// `y += A x`, with `y` [filled](Self::filled) up.
    ///
    /// # Panics
    /// Where the lengths do not suit.
    pub fn add_times(&self, x: &[f64], y: &mut [f64]) {
        assert!(x.len() == self.columns && y.len() == self.stride, "lengths of a product");
        dispatch(Times::<true> { a: &self.values, stride: self.stride, x, y });
    }
}

/// Calls a product of a tile for the number of its vectors, as a constant.
macro_rules! by_vectors {
    ($tile:ident.$times:ident($y:expr), $number:expr, $turns:literal) => {
        by_vectors!(@ $tile, $times, $y, $number, $turns, 1 2 3 4 5 6 7)
    };
    (@ $tile:ident, $times:ident, $y:expr, $number:expr, $turns:literal, $($vectors:literal)*) => {
        match $number {
            $($vectors => $tile.$times::<$vectors, $turns>($y),)*
            _ => $tile.$times::<TILE, $turns>($y),
        }
    };
}

/// The same for the number of turns in which columns of so many rows are summed. It depends on that number alone, so that
/// the order of sums is that of every processor.
macro_rules! by_turns {
    ($stride:expr, $tile:ident.$times:ident($y:expr), $number:expr) => {
        match $stride / GRAIN {
            0..=2 => by_vectors!($tile.$times($y), $number, 4),
            3..=4 => by_vectors!($tile.$times($y), $number, 2),
            _ => by_vectors!($tile.$times($y), $number, 1),
        }
    };
}

/// A product that becomes `y`, or is added to it.
struct Times<'a, const ADD: bool> {
    a: &'a [f64],
    stride: usize,
    x: &'a [f64],
    y: &'a mut [f64],
}

impl<const ADD: bool> WithSimd for Times<'_, ADD> {
    type Output = ();

    #[inline(always)]
    fn with_simd<S: Simd>(self, simd: S) {
        let Self { a, stride, x, y } = self;
        let vectors = stride / S::F64_LANES;
        if vectors <= TILE {
            let tile = Tile::<S, ADD> { simd, a, stride, row: 0, x };
            by_turns!(stride, tile.whole(y), vectors);
            return;
        }
        for (tile, y) in y.chunks_mut(TILE * S::F64_LANES).enumerate() {
            let tile = Tile::<S, ADD> { simd, a, stride, row: tile * TILE * S::F64_LANES, x };
            by_turns!(stride, tile.part(y), y.len().div_ceil(S::F64_LANES));
        }
    }
}

/// Some rows of a product.
struct Tile<'a, S, const ADD: bool> {
    simd: S,
    a: &'a [f64],
    stride: usize,
    row: usize,
    x: &'a [f64],
}

impl<S: Simd, const ADD: bool> Tile<'_, S, ADD> {
    /// Of columns that are `V` vectors long, summed in `T` turns.
    #[inline(always)]
    fn whole<const V: usize, const T: usize>(self, y: &mut [f64]) {
        let Self { simd, a, x, .. } = self;
        let mut sums = [[simd.splat_f64s(0.0); V]; T];
        let (columns, _) = S::as_simd_f64s(a).0.as_chunks::<V>();
        let ((columns, last_columns), (turns, last)) =
            (columns.as_chunks::<T>(), x.as_chunks::<T>());
        for (columns, x) in columns.iter().zip(turns) {
            for t in 0..T {
                add(simd, &columns[t], x[t], &mut sums[t]);
            }
        }
        for (sums, (column, x)) in sums.iter_mut().zip(last_columns.iter().zip(last)) {
            add(simd, column, *x, sums);
        }
        finish::<S, ADD, V, T>(simd, sums, y);
    }

    /// Of `V` vectors out of longer columns, the same.
    #[inline(always)]
    fn part<const V: usize, const T: usize>(self, y: &mut [f64]) {
        let Self { simd, a, stride, row, x } = self;
        let mut sums = [[simd.splat_f64s(0.0); V]; T];
        for (j, x) in x.iter().enumerate() {
            let (column, _) = S::as_simd_f64s(&a[j * stride + row..]).0.as_chunks::<V>();
            add(simd, &column[0], *x, &mut sums[j % T]);
        }
        finish::<S, ADD, V, T>(simd, sums, y);
    }
}

/// The sum of the sums of all turns becomes `y`, or is added to it.
#[inline(always)]
fn finish<S: Simd, const ADD: bool, const V: usize, const T: usize>(
    simd: S,
    mut sums: [[S::f64s; V]; T],
    y: &mut [f64],
) {
    let mut left = T;
    while left > 1 {
        left /= 2;
        for t in 0..left {
            for k in 0..V {
                sums[t][k] = simd.add_f64s(sums[t][k], sums[t + left][k]);
            }
        }
    }
    let (full, rest) = S::as_mut_simd_f64s(y);
    for k in 0..V {
        let sum = sums[0][k];
        if let Some(y) = full.get_mut(k) {
            *y = if ADD { simd.add_f64s(*y, sum) } else { sum };
        } else if !ADD && k == full.len() {
            // A copy of its own: the sums that fill a vector else went through memory as well.
            let last = [sum];
            copy_some(pulp::bytemuck::cast_slice(&last), rest);
        }
    }
}

/// Sums take a column.
#[inline(always)]
fn add<S: Simd, const V: usize>(simd: S, column: &[S::f64s; V], x: f64, sums: &mut [S::f64s; V]) {
    let x = simd.splat_f64s(x);
    for k in 0..V {
        sums[k] = simd.mul_add_e_f64s(column[k], x, sums[k]);
    }
}

/// Copies as many numbers as there is room for, fewer than eight, by moves of known size.
#[inline(always)]
fn copy_some(from: &[f64], to: &mut [f64]) {
    let (n, mut at) = (to.len(), 0);
    if n & 4 != 0 {
        to[..4].copy_from_slice(&from[..4]);
        at = 4;
    }
    if n & 2 != 0 {
        to[at..at + 2].copy_from_slice(&from[at..at + 2]);
        at += 2;
    }
    if n & 1 != 0 {
        to[at] = from[at];
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn products_equal_the_sums_written_out_for_all_numbers_of_rows() {
        let number = |i: usize| ((i * 7919 + 13) % 101) as f64 / 50.0 - 1.0;
        for rows in (0..40).chain([63, 64, 65, 96, 127, 128, 150]) {
            for columns in [0, 1, 2, 3, 5, 7, 24] {
                let values = (0..rows * columns).map(number).collect();
                let a = Dense::from_columns(rows, columns, values);
                let x: Vec<f64> = (0..columns).map(|j| number(j + 5)).collect();
                let panel = Panel::new(&a);
                let mut y = vec![9.0; rows];
                panel.times(&x, &mut y);
                assert_eq!((panel.rows(), panel.columns()), (rows, columns));
                (0..columns).for_each(|j| assert_eq!(panel.column(j), a.column(j)));
                let mut added: Vec<f64> = (0..panel.filled()).map(number).collect();
                panel.add_times(&x, &mut added);
                for (i, added) in added.iter().enumerate() {
                    let sum = number(i) + y.get(i).unwrap_or(&0.0);
                    assert_eq!(*added, sum, "{rows} × {columns}");
                }
                for i in 0..rows {
                    let sum: f64 = (0..columns).map(|j| a[(i, j)] * x[j]).sum();
                    assert!((y[i] - sum).abs() < 1e-13, "{rows} × {columns}");
                }
            }
        }
    }
}
