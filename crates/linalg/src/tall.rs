//! Tall matrices of many columns: projections that read them once, whatever the number of vectors.
//!
//! Rows are taken in tiles that stay in a cache while all columns pass, and threads share tiles and groups of columns.

use crate::simd::dispatch;
use crate::threads::share;
use crate::{Dense, Sparse};
use faer::linalg::matmul::matmul;
use faer::prelude::ReborrowMut;
use faer::{Accum, MatMut, MatRef, Par};
use pulp::{Simd, WithSimd};

/// Rows of a tile for one vector.
const TILE: usize = 1024;
/// Columns taken together for one vector.
const GROUP: usize = 4;
/// Columns of a product that are made at once.
const BLOCK: usize = 16;
/// Rows and columns of a piece of a product of matrices.
const ROWS: usize = 4096;
const COLUMNS: usize = 64;

/// Vectors one after the other, whose number may grow.
#[derive(Clone, Debug)]
pub struct Columns {
    rows: usize,
    values: Vec<f64>,
}

impl Columns {
    /// None yet, with room for `count`.
    #[must_use]
    pub fn with_capacity(rows: usize, count: usize) -> Self {
        Self { rows, values: Vec::with_capacity(rows * count) }
    }

    /// How many there are.
    #[must_use]
    pub fn len(&self) -> usize {
        self.values.len().checked_div(self.rows).unwrap_or(0)
    }

    /// True where there is none.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.values.is_empty()
    }

    /// One more.
    ///
    /// # Panics
    /// Where its length does not suit.
    pub fn push(&mut self, x: &[f64]) {
        assert!(x.len() == self.rows, "length of a column");
        self.values.extend_from_slice(x);
    }

    /// Takes from every vector x of a block its shares in the columns from `first` on: x −= V (Vᵀ y), where y
    /// is the image of x that the columns are orthonormal to. Returns the shares Vᵀ y, one vector's after the
    /// other's.
    ///
    /// # Panics
    /// Where the lengths do not suit.
    pub fn take_out(&self, first: usize, x: &mut [Vec<f64>], y: &[Vec<f64>]) -> Vec<f64> {
        let columns = &self.values[(first * self.rows).min(self.values.len())..];
        match (x, y) {
            ([], _) => Vec::new(),
            _ if columns.is_empty() => Vec::new(),
            ([x], [y]) => take_out(columns, [x], [y]),
            ([a, b], [c, d]) => take_out(columns, [a, b], [c, d]),
            (x, y) => {
                let shares = dots(columns, y);
                subtract(columns, &shares, x);
                shares
            }
        }
    }

    /// One of them.
    #[must_use]
    pub fn column(&self, j: usize) -> &[f64] {
        &self.values[j * self.rows..(j + 1) * self.rows]
    }

    /// V Q of the first columns, as many as Q has rows.
    ///
    /// # Panics
    /// Where there are fewer columns.
    #[must_use]
    pub fn times(&self, q: &Dense) -> Dense {
        assert!(q.rows() <= self.len(), "sizes of a product");
        let mut x = Dense::zeros(self.rows, q.columns());
        let first = &self.values[..self.rows * q.rows()];
        let own = MatRef::from_column_major_slice(first, self.rows, q.rows());
        matmul(x.as_mut(), Accum::Replace, own, q.as_ref(), 1.0, Par::Seq);
        x
    }

    /// As a matrix.
    #[must_use]
    pub fn into_dense(self) -> Dense {
        Dense::from_columns(self.rows, self.len(), self.values)
    }
}

/// Vᵀ y of several vectors, one's after the other's.
fn dots(columns: &[f64], y: &[Vec<f64>]) -> Vec<f64> {
    let n = y[0].len();
    let mut shares = vec![0.0; columns.len() / n * y.len()];
    products(MatRef::from_column_major_slice(columns, n, columns.len() / n), &y.concat(), &mut {
        MatMut::from_column_major_slice_mut(&mut shares, columns.len() / n, y.len())
    });
    shares
}

/// C = Vᵀ Y, for the columns of Y one after the other.
fn products(v: MatRef<'_, f64>, y: &[f64], c: &mut MatMut<'_, f64>) {
    let (n, count) = (v.nrows(), c.ncols());
    let y = MatRef::from_column_major_slice(y, n, count);
    let mut pieces = Vec::with_capacity(v.ncols().div_ceil(COLUMNS));
    let mut rest = c.rb_mut();
    for first in (0..v.ncols()).step_by(COLUMNS) {
        let width = COLUMNS.min(v.ncols() - first);
        let (piece, left) = rest.split_at_row_mut(width);
        pieces.push((v.subcols(first, width), piece));
        rest = left;
    }
    share(2 * n * v.ncols() * count, pieces, |(v, mut c)| {
        c.fill(0.0);
        for start in (0..n).step_by(ROWS) {
            let length = ROWS.min(n - start);
            let (v, y) = (v.subrows(start, length), y.subrows(start, length));
            matmul(c.rb_mut(), Accum::Add, v.transpose(), y, 1.0, Par::Seq);
        }
    });
}

/// x −= V s of several vectors, of whose shares s one's stand after the other's.
fn subtract(columns: &[f64], shares: &[f64], x: &mut [Vec<f64>]) {
    let (n, count) = (x[0].len(), x.len());
    let m = columns.len() / n;
    let v = MatRef::from_column_major_slice(columns, n, m);
    let shares = MatRef::from_column_major_slice(shares, m, count);
    let mut tiles: Vec<(usize, Vec<&mut [f64]>)> =
        (0..n).step_by(ROWS).map(|start| (start, Vec::with_capacity(count))).collect();
    for x in x {
        tiles.iter_mut().zip(x.chunks_mut(ROWS)).for_each(|((_, tile), part)| tile.push(part));
    }
    share(2 * n * m * count, tiles, |(start, tile)| {
        let length = tile[0].len();
        let mut sum = Dense::zeros(length, count);
        matmul(sum.as_mut(), Accum::Replace, v.subrows(start, length), shares, 1.0, Par::Seq);
        for (x, sum) in tile.into_iter().zip(sum.values().chunks(length)) {
            x.iter_mut().zip(sum).for_each(|(x, sum)| *x -= sum);
        }
    });
}

/// Both for one vector, or for two at once.
fn take_out<const R: usize>(a: &[f64], x: [&mut [f64]; R], y: [&[f64]; R]) -> Vec<f64> {
    let n = y[0].len();
    let mut shares = vec![0.0; R * (a.len() / n)];
    let pieces = a.chunks(COLUMNS * n).zip(shares.chunks_mut(R * COLUMNS)).collect();
    share(2 * R * a.len(), pieces, |(a, shares)| {
        for start in (0..n).step_by(TILE) {
            let y = y.map(|y| &y[start..n.min(start + TILE)]);
            dispatch(Dots { a, n, start, y, shares });
        }
    });
    let mut parts = x.map(|x| x.chunks_mut(TILE));
    let tile = |start| (start, parts.each_mut().map(|x| x.next().unwrap_or_default()));
    let tiles: Vec<_> = (0..n).step_by(TILE).map(tile).collect();
    let shares_of = &shares;
    share(2 * R * a.len(), tiles, |(start, x)| {
        dispatch(Subtract { a, n, start, x, shares: shares_of });
    });
    if R == 1 {
        return shares;
    }
    (0..R).flat_map(|r| shares.iter().skip(r).step_by(R).copied()).collect()
}

struct Dots<'a, const R: usize> {
    a: &'a [f64],
    n: usize,
    start: usize,
    y: [&'a [f64]; R],
    /// R shares a column.
    shares: &'a mut [f64],
}

impl<const R: usize> Dots<'_, R> {
    #[inline(always)]
    fn group<S: Simd, const N: usize>(&mut self, simd: S, first: usize) {
        let length = self.y[0].len();
        let y = self.y.map(|y| S::as_simd_f64s(y));
        let heads = length / S::F64_LANES;
        let columns: [_; N] = std::array::from_fn(|k| {
            let at = (first + k) * self.n + self.start;
            let (head, tail) = S::as_simd_f64s(&self.a[at..at + length]);
            (&head[..heads], tail)
        });
        let y = y.map(|(head, tail)| (&head[..heads], tail));
        let mut sums = [[simd.splat_f64s(0.0); R]; N];
        for i in 0..heads {
            for k in 0..N {
                for r in 0..R {
                    sums[k][r] = simd.mul_add_e_f64s(columns[k].0[i], y[r].0[i], sums[k][r]);
                }
            }
        }
        for k in 0..N {
            for r in 0..R {
                let mut sum = simd.reduce_sum_f64s(sums[k][r]);
                for (c, y) in columns[k].1.iter().zip(y[r].1) {
                    sum += c * y;
                }
                self.shares[(first + k) * R + r] += sum;
            }
        }
    }
}

impl<const R: usize> WithSimd for Dots<'_, R> {
    type Output = ();

    #[inline(always)]
    fn with_simd<S: Simd>(mut self, simd: S) {
        let columns = self.shares.len() / R;
        let mut j = 0;
        while j + GROUP <= columns {
            self.group::<S, GROUP>(simd, j);
            j += GROUP;
        }
        while j < columns {
            self.group::<S, 1>(simd, j);
            j += 1;
        }
    }
}

struct Subtract<'a, const R: usize> {
    a: &'a [f64],
    n: usize,
    start: usize,
    x: [&'a mut [f64]; R],
    shares: &'a [f64],
}

impl<const R: usize> Subtract<'_, R> {
    #[inline(always)]
    fn group<S: Simd, const N: usize>(&mut self, simd: S, first: usize) {
        let length = self.x[0].len();
        let heads = length / S::F64_LANES;
        let columns: [_; N] = std::array::from_fn(|k| {
            let at = (first + k) * self.n + self.start;
            let (head, tail) = S::as_simd_f64s(&self.a[at..at + length]);
            (&head[..heads], tail)
        });
        for (r, x) in self.x.iter_mut().enumerate() {
            let shares: [f64; N] = std::array::from_fn(|k| -self.shares[(first + k) * R + r]);
            let factors = shares.map(|s| simd.splat_f64s(s));
            let (head, tail) = S::as_mut_simd_f64s(x);
            for (i, x) in head.iter_mut().enumerate() {
                let mut sum = *x;
                for k in 0..N {
                    sum = simd.mul_add_e_f64s(factors[k], columns[k].0[i], sum);
                }
                *x = sum;
            }
            for (i, x) in tail.iter_mut().enumerate() {
                for k in 0..N {
                    *x += shares[k] * columns[k].1[i];
                }
            }
        }
    }
}

impl<const R: usize> WithSimd for Subtract<'_, R> {
    type Output = ();

    #[inline(always)]
    fn with_simd<S: Simd>(mut self, simd: S) {
        let columns = self.shares.len() / R;
        let mut j = 0;
        while j + GROUP <= columns {
            self.group::<S, GROUP>(simd, j);
            j += GROUP;
        }
        while j < columns {
            self.group::<S, 1>(simd, j);
            j += 1;
        }
    }
}

impl Dense {
    /// Vᵀ A V of the first `count` columns V, for a symmetric A.
    ///
    /// # Panics
    /// Where there are fewer columns, or the sizes differ.
    #[must_use]
    pub fn congruence(&self, a: &Sparse, count: usize) -> Self {
        let n = self.rows();
        assert!(a.rows() == n && a.columns() == n, "sizes of a product");
        if a.stored() == 0 {
            return Self::zeros(count, count);
        }
        self.congruence_by(count, |x, images| a.symmetric_products(x, images))
    }

    /// The same for an A that `images` of columns one after the other are made with.
    ///
    /// # Panics
    /// Where there are fewer columns.
    #[must_use]
    pub fn congruence_by(&self, count: usize, mut images: impl FnMut(&[f64], &mut [f64])) -> Self {
        let n = self.rows();
        assert!(count <= self.columns(), "sizes of a product");
        let mut c = Self::zeros(count, count);
        if n == 0 {
            return c;
        }
        let mut image = Self::zeros(n, BLOCK.min(count));
        for start in (0..count).step_by(BLOCK) {
            let width = BLOCK.min(count - start);
            let block = start * n..(start + width) * n;
            images(&self.values()[block], &mut image.values_mut()[..n * width]);
            // Nothing above the diagonal block: symmetry gives it.
            let left = &self.values()[start * n..count * n];
            let left = MatRef::from_column_major_slice(left, n, count - start);
            let mut below = c.as_mut().submatrix_mut(start, start, count - start, width);
            products(left, &image.values()[..n * width], &mut below);
        }
        for j in 0..count {
            for i in 0..j {
                // Within a diagonal block both halves are made.
                c[(i, j)] = c[(j, i)];
            }
        }
        c
    }

    /// V ← V T on the first columns, as many as T has, in place.
    ///
    /// # Panics
    /// Where T is not square or has more columns.
    pub fn turn(&mut self, t: &Self) {
        let (n, count) = (self.rows(), t.columns());
        assert!(t.rows() == count && count <= self.columns(), "sizes of a product");
        /// Rows that stay in the nearest cache.
        const FEW: usize = 256;
        let mut pieces = Vec::with_capacity(n.div_ceil(ROWS));
        let mut rest = self.as_mut().subcols_mut(0, count);
        for start in (0..n).step_by(ROWS) {
            let (piece, left) = rest.split_at_row_mut(ROWS.min(n - start));
            pieces.push(piece);
            rest = left;
        }
        share(2 * n * count * count, pieces, |mut rows| {
            let n = rows.nrows();
            let mut part = Self::zeros(FEW.min(n), count);
            for start in (0..n).step_by(FEW) {
                let mut here = rows.rb_mut().subrows_mut(start, FEW.min(n - start));
                let mut part = part.as_mut().subrows_mut(0, here.nrows());
                matmul(part.rb_mut(), Accum::Replace, here.as_ref(), t.as_ref(), 1.0, Par::Seq);
                here.copy_from(part);
            }
        });
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Triplets;

    fn number(i: usize) -> f64 {
        ((i * 7919) % 1009) as f64 / 1009.0 - 0.5
    }

    fn sample(rows: usize, columns: usize) -> Dense {
        Dense::from_columns(rows, columns, (0..rows * columns).map(number).collect())
    }

    #[test]
    fn shares_are_taken_out_of_one_two_and_three_vectors() {
        let n = 2500;
        let v = sample(n, 7);
        let mut columns = Columns::with_capacity(n, 7);
        (0..7).for_each(|j| columns.push(v.column(j)));
        assert_eq!((columns.len(), columns.is_empty()), (7, false));
        for count in 1..4 {
            let y: Vec<Vec<f64>> =
                (0..count).map(|c| (0..n).map(|i| number(3 * i + c)).collect()).collect();
            let mut x = y.clone();
            let shares = columns.take_out(2, &mut x, &y);
            assert_eq!(shares.len(), 5 * count);
            for ((x, y), shares) in x.iter().zip(&y).zip(shares.chunks(5)) {
                let mut expected = y.clone();
                for j in 2..7 {
                    let share: f64 = v.column(j).iter().zip(y).map(|(a, b)| a * b).sum();
                    assert!((share - shares[j - 2]).abs() < 1e-10, "{share} {shares:?}");
                    expected.iter_mut().zip(v.column(j)).for_each(|(e, a)| *e -= share * a);
                }
                for (x, e) in x.iter().zip(&expected) {
                    assert!((x - e).abs() < 1e-10 * (1.0 + e.abs()), "{x} {e}");
                }
            }
        }
        let q = sample(3, 2);
        let product = columns.times(&q);
        for j in 0..2 {
            for i in (0..n).step_by(7) {
                let expected: f64 = (0..3).map(|k| v[(i, k)] * q[(k, j)]).sum();
                assert!((product[(i, j)] - expected).abs() < 1e-14);
            }
        }
        assert_eq!(columns.column(4), v.column(4));
        assert_eq!(columns.into_dense(), v);
    }

    #[test]
    fn a_congruence_and_a_turn_are_the_products_by_hand() {
        let (n, m) = (600, 37);
        let mut t = Triplets::new(n, n);
        for i in 0..n {
            t.add(i, i, 2.0 + number(i));
            if i > 2 {
                t.add(i, i - 3, number(i));
                t.add(i - 3, i, number(i));
            }
        }
        let (a, v) = (t.build(), sample(n, m));
        for count in [m, 20, 1, 0] {
            let c = v.congruence(&a, count);
            for i in 0..count {
                for j in 0..count {
                    let expected = a.bilinear(v.column(i), v.column(j));
                    assert!((c[(i, j)] - expected).abs() < 1e-10, "{} {expected}", c[(i, j)]);
                }
            }
            let turn = sample(count, count);
            let mut turned = v.clone();
            turned.turn(&turn);
            for j in 0..m {
                for i in (0..n).step_by(13) {
                    let product = || (0..count).map(|k| v[(i, k)] * turn[(k, j)]).sum();
                    let expected: f64 = if j < count { product() } else { v[(i, j)] };
                    assert!((turned[(i, j)] - expected).abs() < 1e-12);
                }
            }
        }
    }

    #[test]
    fn threads_change_no_bit_and_images_of_many_are_those_of_each() {
        let (n, m) = (20_000, 70);
        let mut t = Triplets::new(n, n);
        for i in 0..n {
            t.add(i, i, 2.0 + number(i));
            for j in (i + 1..n).step_by(997).take(12) {
                t.add(i, j, number(i + j));
                t.add(j, i, number(i + j));
            }
        }
        let (a, v) = (t.build(), sample(n, m));
        let mut columns = Columns::with_capacity(n, m);
        (0..m).for_each(|j| columns.push(v.column(j)));
        for count in [1, 2, 7] {
            let x: Vec<Vec<f64>> =
                (0..count).map(|c| (0..n).map(|i| number(3 * i + c)).collect()).collect();
            let all = || {
                let (images, mut left) = (a.symmetric_images(&x), x.clone());
                let shares = columns.take_out(0, &mut left, &images);
                (images, left, shares)
            };
            let (images, left, shares) = all();
            assert_eq!(crate::threads::alone(all), (images.clone(), left, shares));
            for (x, image) in x.iter().zip(&images) {
                let pairs = a.mul(x).into_iter().zip(image);
                pairs.for_each(|(y, own)| assert!((y - own).abs() < 1e-13, "{y} {own}"));
            }
        }
        let both = || {
            let mut turned = v.clone();
            turned.turn(&sample(m, m));
            (v.congruence(&a, m), turned)
        };
        assert_eq!(crate::threads::alone(both), both());
    }
}
