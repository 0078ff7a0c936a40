//! Sparse matrices in compressed columns, full storage (both triangles).

use crate::simd::dispatch;
use crate::threads::share;
use nalgebra_sparse::CscMatrix;
use pulp::{Simd, WithSimd};
use std::sync::Arc;

/// Entries (row, column, value) that are summed into a [`Sparse`] matrix.
#[derive(Clone, Debug)]
pub struct Triplets {
    rows: usize,
    columns: usize,
    entries: Vec<(u32, u32, f64)>,
}

impl Triplets {
    /// No entries yet.
    ///
    /// # Panics
    /// Where there are more than 2³² rows or columns.
    #[must_use]
    pub fn new(rows: usize, columns: usize) -> Self {
        assert!(rows.max(columns) < u32::MAX as usize, "size of a matrix");
        Self { rows, columns, entries: Vec::new() }
    }

    /// Adds a value; entries at one place are summed.
    ///
    /// # Panics
    /// Where the place is outside the matrix.
    pub fn add(&mut self, row: usize, column: usize, value: f64) {
        assert!(row < self.rows && column < self.columns, "place in a matrix");
        self.entries.push((row as u32, column as u32, value));
    }

    /// The entries in the order in which they were added.
    pub fn entries(&self) -> impl Iterator<Item = (usize, usize, f64)> + '_ {
        self.entries.iter().map(|(i, j, v)| (*i as usize, *j as usize, *v))
    }

    /// The matrix. Sums are taken in the order in which the entries were added.
    #[must_use]
    pub fn build(&self) -> Sparse {
        // Sorted by row, then by column; both keep the order of equals.
        let by_row = sorted(&self.entries, self.rows, |e| e.0);
        let sorted = sorted(&by_row, self.columns, |e| e.1);
        drop(by_row);
        let mut offsets = vec![0; self.columns + 1];
        let mut rows: Vec<usize> = Vec::with_capacity(sorted.len());
        let mut values: Vec<f64> = Vec::with_capacity(sorted.len());
        let mut last = None;
        for (i, j, v) in sorted {
            if last == Some((i, j)) {
                if let Some(sum) = values.last_mut() {
                    *sum += v;
                }
                continue;
            }
            last = Some((i, j));
            rows.push(i as usize);
            values.push(v);
            offsets[j as usize + 1] += 1;
        }
        rows.shrink_to_fit();
        values.shrink_to_fit();
        for j in 0..self.columns {
            offsets[j + 1] += offsets[j];
        }
        Sparse::of_columns(self.rows, self.columns, offsets, rows, values)
    }
}

/// Entries sorted by a key below `keys`, by counting.
fn sorted(
    entries: &[(u32, u32, f64)],
    keys: usize,
    key: impl Fn(&(u32, u32, f64)) -> u32,
) -> Vec<(u32, u32, f64)> {
    let mut place = vec![0_usize; keys + 1];
    entries.iter().for_each(|e| place[key(e) as usize + 1] += 1);
    for k in 0..keys {
        place[k + 1] += place[k];
    }
    let mut out = vec![(0, 0, 0.0); entries.len()];
    for e in entries {
        let at = &mut place[key(e) as usize];
        out[*at] = *e;
        *at += 1;
    }
    out
}

/// Rows of a product with several vectors that one thread makes.
const ROWS: usize = 8192;

/// A sparse matrix. It never changes, so copies share its entries.
#[derive(Clone, Debug, PartialEq)]
pub struct Sparse(pub(crate) Arc<CscMatrix<f64>>);

impl Sparse {
    /// The zero matrix.
    #[must_use]
    pub fn zeros(rows: usize, columns: usize) -> Self {
        Self(Arc::new(CscMatrix::zeros(rows, columns)))
    }

    /// From compressed columns with rising rows.
    fn of_columns(
        rows: usize,
        columns: usize,
        offsets: Vec<usize>,
        indices: Vec<usize>,
        values: Vec<f64>,
    ) -> Self {
        let made = CscMatrix::try_from_csc_data(rows, columns, offsets, indices, values);
        // Whoever calls has sorted them.
        Self(Arc::new(made.unwrap_or_else(|_| unreachable!("columns in order"))))
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

    /// Rows and values of every column.
    fn by_column(&self) -> impl Iterator<Item = (&[usize], &[f64])> {
        let (offsets, rows, values) = self.0.csc_data();
        offsets.windows(2).map(|at| (&rows[at[0]..at[1]], &values[at[0]..at[1]]))
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

    /// Row of the first stored entry that is infinite or no number.
    #[must_use]
    pub fn not_finite(&self) -> Option<usize> {
        let (_, rows, values) = self.0.csc_data();
        values.iter().position(|v| !v.is_finite()).map(|at| rows[at])
    }

    /// `y += s · A x`. Lengths: `x` columns, `y` rows.
    pub fn mul_add(&self, s: f64, x: &[f64], y: &mut [f64]) {
        for ((rows, values), x) in self.by_column().zip(x) {
            let t = s * x;
            if t != 0.0 {
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

    /// `A x` of several vectors, for a symmetric A: its entries are read once for eight of them, and threads share them.
    ///
    /// # Panics
    /// Where the matrix is not square, or a length does not suit.
    #[must_use]
    pub fn symmetric_images(&self, x: &[impl AsRef<[f64]>]) -> Vec<Vec<f64>> {
        self.symmetric_images_in(x, &mut Vec::new())
    }

    /// The same with memory that the caller keeps from one call to the next.
    ///
    /// # Panics
    /// As [`symmetric_images`](Self::symmetric_images).
    pub fn symmetric_images_in(
        &self,
        x: &[impl AsRef<[f64]>],
        room: &mut Vec<f64>,
    ) -> Vec<Vec<f64>> {
        let mut y: Vec<Vec<f64>> = x.iter().map(|x| vec![0.0; x.as_ref().len()]).collect();
        let images = y.iter_mut().map(Vec::as_mut_slice);
        self.symmetric(x.iter().map(AsRef::as_ref).zip(images).collect(), room);
        y
    }

    /// The same of vectors one after the other.
    ///
    /// # Panics
    /// As [`symmetric_images`](Self::symmetric_images).
    pub fn symmetric_products(&self, x: &[f64], y: &mut [f64]) {
        let n = self.rows().max(1);
        self.symmetric(x.chunks(n).zip(y.chunks_mut(n)).collect(), &mut Vec::new());
    }

    fn symmetric(&self, mut pairs: Vec<(&[f64], &mut [f64])>, room: &mut Vec<f64>) {
        let n = self.rows();
        assert!(self.columns() == n, "a symmetric matrix");
        let suits = |(x, y): &(&[f64], &mut [f64])| x.len() == n && y.len() == n;
        assert!(pairs.iter().all(suits), "lengths of a product");
        while pairs.len() > 4 {
            let rest = pairs.split_off(pairs.len().min(8));
            self.beside::<8>(std::mem::replace(&mut pairs, rest), room);
        }
        match pairs.len() {
            0 => {}
            1 => self.beside::<1>(pairs, room),
            _ => self.beside::<4>(pairs, room),
        }
    }

    /// Images of N vectors at most, whose values stand side by side.
    fn beside<const N: usize>(&self, pairs: Vec<(&[f64], &mut [f64])>, room: &mut Vec<f64>) {
        let n = self.rows();
        room.resize(room.len().max(N * n), 0.0);
        let (beside, _) = room[..N * n].as_chunks_mut::<N>();
        let mut pieces: Vec<(usize, Vec<&mut [f64]>)> =
            (0..n).step_by(ROWS).map(|start| (start, Vec::with_capacity(N))).collect();
        let mut x = Vec::with_capacity(N);
        for (own, y) in pairs {
            x.push(own);
            pieces.iter_mut().zip(y.chunks_mut(ROWS)).for_each(|(piece, y)| piece.1.push(y));
        }
        share(N * n, beside.chunks_mut(ROWS).enumerate().collect(), |(i, beside)| {
            for (k, x) in x.iter().enumerate() {
                beside.iter_mut().zip(&x[i * ROWS..]).for_each(|(each, x)| each[k] = *x);
            }
        });
        share(2 * N * self.stored(), pieces, |(start, y)| {
            dispatch(SymmetricRows { of: self, x: beside, start, y });
        });
    }

    /// `y += s · Aᵀ x`. Lengths: `x` rows, `y` columns.
    pub fn transpose_mul_add(&self, s: f64, x: &[f64], y: &mut [f64]) {
        for ((rows, values), y) in self.by_column().zip(y) {
            *y += s * rows.iter().zip(values).map(|(i, v)| v * x[*i]).sum::<f64>();
        }
    }

    /// Σ |aᵢⱼ| of every row: Σ |aᵢⱼ xᵢ xⱼ| of a symmetric matrix is at most Σ xᵢ² times these.
    #[must_use]
    pub fn row_sums(&self) -> Vec<f64> {
        let mut sums = vec![0.0; self.rows()];
        for (rows, values) in self.by_column() {
            rows.iter().zip(values).for_each(|(i, v)| sums[*i] += v.abs());
        }
        sums
    }

    /// `xᵀ A y`.
    #[must_use]
    pub fn bilinear(&self, x: &[f64], y: &[f64]) -> f64 {
        let own = |((rows, values), y): ((&[usize], &[f64]), &f64)| {
            y * rows.iter().zip(values).map(|(i, v)| v * x[*i]).sum::<f64>()
        };
        self.by_column().zip(y).map(own).sum()
    }

    /// `Σ factor · matrix`, all of one size.
    ///
    /// # Panics
    /// Where there is no matrix or the sizes differ.
    #[must_use]
    pub fn combine(parts: &[(f64, &Self)]) -> Self {
        let (rows, columns) = (parts[0].1.rows(), parts[0].1.columns());
        let parts: Vec<_> = parts.iter().filter(|(f, _)| *f != 0.0).collect();
        let most = parts.iter().map(|(_, part)| part.stored()).max().unwrap_or(0);
        let mut offsets = Vec::with_capacity(columns + 1);
        offsets.push(0);
        let (mut indices, mut values) = (Vec::with_capacity(most), Vec::with_capacity(most));
        // Sums of one column, and the last column that had an entry in each row.
        let mut sums = vec![0.0; rows];
        let mut seen = vec![usize::MAX; rows];
        for j in 0..columns {
            let start = indices.len();
            for (factor, part) in &parts {
                let (rows, entries) = part.column(j);
                for (i, v) in rows.iter().zip(entries) {
                    if seen[*i] == j {
                        sums[*i] += factor * v;
                    } else {
                        (seen[*i], sums[*i]) = (j, factor * v);
                        indices.push(*i);
                    }
                }
            }
            indices[start..].sort_unstable();
            values.extend(indices[start..].iter().map(|i| sums[*i]));
            offsets.push(indices.len());
        }
        Self::of_columns(rows, columns, offsets, indices, values)
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
}

/// Rows of images under a symmetric matrix: its columns are its rows, so each value is a sum.
struct SymmetricRows<'a, const N: usize> {
    of: &'a Sparse,
    /// Of N vectors, side by side.
    x: &'a [[f64; N]],
    /// First row, and from there on the images.
    start: usize,
    y: Vec<&'a mut [f64]>,
}

impl<const N: usize> WithSimd for SymmetricRows<'_, N> {
    type Output = ();

    #[inline(always)]
    fn with_simd<S: Simd>(mut self, _: S) {
        for j in 0..self.y[0].len() {
            let (rows, values) = self.of.column(self.start + j);
            let mut sum = [0.0; N];
            for (i, v) in rows.iter().zip(values) {
                let x = &self.x[*i];
                for k in 0..N {
                    sum[k] += v * x[k];
                }
            }
            for k in 0..self.y.len() {
                self.y[k][j] = sum[k];
            }
        }
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
    fn an_entry_beyond_all_bounds_is_found_by_its_row() {
        assert_eq!(sample().not_finite(), None);
        for wrong in [f64::INFINITY, f64::NEG_INFINITY, f64::NAN] {
            let mut t = Triplets::new(2, 3);
            t.add(0, 0, 1.0);
            t.add(1, 2, wrong);
            assert_eq!(t.build().not_finite(), Some(1));
        }
    }

    #[test]
    fn a_combination_holds_the_places_of_all_its_parts() {
        let mut t = Triplets::new(2, 3);
        t.add(1, 2, 4.0);
        t.add(0, 0, 1.0);
        let sum = Sparse::combine(&[(2.0, &sample()), (0.0, &sample()), (-1.0, &t.build())]);
        let expected = [(0, 0, 2.0), (1, 0, 4.0), (0, 2, 6.0), (1, 2, -4.0)];
        assert_eq!(sum.entries().collect::<Vec<_>>(), expected);
        assert_eq!(Sparse::combine(&[(0.0, &sample())]), Sparse::zeros(2, 3));
    }

    #[test]
    fn entries_come_sorted_by_column_and_row() {
        let (n, mut t) = (37, Triplets::new(37, 41));
        let mut sums = vec![0.0; 37 * 41];
        for k in 0..2000_usize {
            let (i, j) = ((k * 7919) % n, (k * 104_729) % 41);
            t.add(i, j, k as f64);
            sums[j * n + i] += k as f64;
        }
        let built = t.build();
        let entries: Vec<_> = built.entries().collect();
        assert!(entries.windows(2).all(|w| (w[0].1, w[0].0) < (w[1].1, w[1].0)));
        assert!(entries.iter().all(|(i, j, v)| *v == sums[j * n + i]));
        assert_eq!(entries.len(), sums.iter().filter(|x| **x != 0.0).count());
    }
}
