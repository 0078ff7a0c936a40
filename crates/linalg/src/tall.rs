//! Tall matrices of many columns: projections that read them once, whatever the number of vectors.
//!
//! ```text
//!   V      columns, in groups of three or eight         S = Vᵀ Y     three columns with four vectors at once, in registers
//!   Y, X   some vectors, in tiles of rows               X += V S     eight columns at once
//! ```
//!
//! A tile of the vectors stays in a cache while all columns pass, and threads share columns (for S) and tiles (for X). General
//! products of matrices take up to twice as long here: they copy V, and with so few vectors that does not pay.

use crate::simd::dispatch;
use crate::threads::share;
use crate::{Dense, Sparse};
use pulp::{Simd, WithSimd};

/// Rows of a tile.
const TILE: usize = 1024;
/// Rows of eight columns that stay in the nearest cache.
const NEAR: usize = 256;
/// Columns that one thread takes.
const COLUMNS: usize = 64;
/// Columns of a product that are made at once.
const BLOCK: usize = 16;

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
        if x.is_empty() || columns.is_empty() {
            return Vec::new();
        }
        let y: Vec<&[f64]> = y.iter().map(Vec::as_slice).collect();
        let shares = dots(columns, self.rows, &y);
        add(columns, self.rows, &shares, -1.0, x.iter_mut().map(Vec::as_mut_slice));
        let count = y.len();
        (0..count).flat_map(|r| shares.iter().skip(r).step_by(count).copied()).collect()
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
        sums(&self.values[..self.rows * q.rows()], self.rows, q)
    }

    /// As a matrix.
    #[must_use]
    pub fn into_dense(self) -> Dense {
        Dense::from_columns(self.rows, self.len(), self.values)
    }
}

/// Vᵀ Y: for each column of V, its products with all vectors.
fn dots(columns: &[f64], n: usize, y: &[&[f64]]) -> Vec<f64> {
    assert!(y.iter().all(|y| y.len() == n), "lengths of a product");
    let mut shares = vec![0.0; columns.len().checked_div(n).unwrap_or(0) * y.len()];
    if shares.is_empty() {
        return shares;
    }
    let pieces = columns.chunks(COLUMNS * n).zip(shares.chunks_mut(COLUMNS * y.len())).collect();
    share(2 * columns.len() * y.len(), pieces, |(columns, shares)| {
        for start in (0..n).step_by(TILE) {
            let y: Vec<&[f64]> = y.iter().map(|y| &y[start..n.min(start + TILE)]).collect();
            dispatch(Dots { columns, n, start, y: &y, shares });
        }
    });
    shares
}

/// X += factor · V S, with the shares of [`dots`].
fn add<'a>(
    columns: &[f64],
    n: usize,
    shares: &[f64],
    factor: f64,
    x: impl ExactSizeIterator<Item = &'a mut [f64]>,
) {
    let count = x.len();
    let mut tiles: Vec<(usize, Vec<&mut [f64]>)> =
        (0..n).step_by(TILE).map(|start| (start, Vec::with_capacity(count))).collect();
    for x in x {
        assert!(x.len() == n, "lengths of a product");
        tiles.iter_mut().zip(x.chunks_mut(TILE)).for_each(|((_, tile), part)| tile.push(part));
    }
    share(2 * columns.len() * count, tiles, |(start, x)| {
        dispatch(Add { columns, n, start, x, shares, factor });
    });
}

/// V T of columns one after the other.
fn sums(columns: &[f64], n: usize, t: &Dense) -> Dense {
    let mut all = Dense::zeros(n, t.columns());
    if n > 0 && t.columns() > 0 {
        add(columns, n, t.transpose().values(), 1.0, all.values_mut().chunks_mut(n));
    }
    all
}

struct Dots<'a> {
    columns: &'a [f64],
    n: usize,
    /// First row of the tile.
    start: usize,
    y: &'a [&'a [f64]],
    /// As many for each column as there are vectors.
    shares: &'a mut [f64],
}

impl Dots<'_> {
    /// N columns with all vectors: twelve sums are what registers hold.
    #[inline(always)]
    fn group<S: Simd, const N: usize>(&mut self, simd: S, first: usize) {
        let mut r = 0;
        while r + 4 <= self.y.len() {
            self.block::<S, N, 4>(simd, first, r);
            r += 4;
        }
        if r + 2 <= self.y.len() {
            self.block::<S, N, 2>(simd, first, r);
            r += 2;
        }
        if r < self.y.len() {
            self.block::<S, N, 1>(simd, first, r);
        }
    }

    #[inline(always)]
    fn block<S: Simd, const N: usize, const R: usize>(&mut self, simd: S, first: usize, r: usize) {
        let length = self.y[r].len();
        let heads = length / S::F64_LANES;
        let y: [_; R] = std::array::from_fn(|k| {
            let (head, tail) = S::as_simd_f64s(self.y[r + k]);
            (&head[..heads], tail)
        });
        let columns: [_; N] = std::array::from_fn(|k| {
            let at = (first + k) * self.n + self.start;
            let (head, tail) = S::as_simd_f64s(&self.columns[at..at + length]);
            (&head[..heads], tail)
        });
        let mut sums = [[simd.splat_f64s(0.0); R]; N];
        for i in 0..heads {
            for k in 0..N {
                for q in 0..R {
                    sums[k][q] = simd.mul_add_e_f64s(columns[k].0[i], y[q].0[i], sums[k][q]);
                }
            }
        }
        for k in 0..N {
            for q in 0..R {
                let mut sum = simd.reduce_sum_f64s(sums[k][q]);
                for (c, y) in columns[k].1.iter().zip(y[q].1) {
                    sum += c * y;
                }
                self.shares[(first + k) * self.y.len() + r + q] += sum;
            }
        }
    }
}

impl WithSimd for Dots<'_> {
    type Output = ();

    #[inline(always)]
    fn with_simd<S: Simd>(mut self, simd: S) {
        let count = self.shares.len() / self.y.len();
        let mut j = 0;
        while j + 3 <= count {
            self.group::<S, 3>(simd, j);
            j += 3;
        }
        while j < count {
            self.group::<S, 1>(simd, j);
            j += 1;
        }
    }
}

struct Add<'a> {
    columns: &'a [f64],
    n: usize,
    /// First row of the tile.
    start: usize,
    x: Vec<&'a mut [f64]>,
    shares: &'a [f64],
    factor: f64,
}

impl Add<'_> {
    #[inline(always)]
    fn group<S: Simd, const N: usize>(&mut self, simd: S, first: usize) {
        let (length, count) = (self.x[0].len(), self.x.len());
        for near in (0..length).step_by(NEAR) {
            let end = length.min(near + NEAR);
            let heads = (end - near) / S::F64_LANES;
            let columns: [_; N] = std::array::from_fn(|k| {
                let at = (first + k) * self.n + self.start;
                let (head, tail) = S::as_simd_f64s(&self.columns[at + near..at + end]);
                (&head[..heads], tail)
            });
            for (r, x) in self.x.iter_mut().enumerate() {
                let (mut shares, mut factors) = ([0.0; N], [simd.splat_f64s(0.0); N]);
                for k in 0..N {
                    shares[k] = self.factor * self.shares[(first + k) * count + r];
                    factors[k] = simd.splat_f64s(shares[k]);
                }
                let (head, tail) = S::as_mut_simd_f64s(&mut x[near..end]);
                let head = &mut head[..heads];
                for i in 0..heads {
                    let mut sum = head[i];
                    for k in 0..N {
                        sum = simd.mul_add_e_f64s(factors[k], columns[k].0[i], sum);
                    }
                    head[i] = sum;
                }
                for (i, x) in tail.iter_mut().enumerate() {
                    for k in 0..N {
                        *x += shares[k] * columns[k].1[i];
                    }
                }
            }
        }
    }
}

impl WithSimd for Add<'_> {
    type Output = ();

    #[inline(always)]
    fn with_simd<S: Simd>(mut self, simd: S) {
        let count = self.shares.len() / self.x.len();
        let mut j = 0;
        while j + 8 <= count {
            self.group::<S, 8>(simd, j);
            j += 8;
        }
        while j + 2 <= count {
            self.group::<S, 2>(simd, j);
            j += 2;
        }
        if j < count {
            self.group::<S, 1>(simd, j);
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
            let images: Vec<&[f64]> = image.values()[..n * width].chunks(n).collect();
            for (i, products) in dots(left, n, &images).chunks(width).enumerate() {
                (0..width).for_each(|j| c[(start + i, start + j)] = products[j]);
            }
        }
        for j in 0..count {
            for i in 0..j {
                // Within a diagonal block both halves are made.
                c[(i, j)] = c[(j, i)];
            }
        }
        c
    }

    /// V T of the first columns V, as many as T has rows, which threads share.
    ///
    /// # Panics
    /// Where there are fewer columns.
    #[must_use]
    pub fn sums(&self, t: &Self) -> Self {
        assert!(t.rows() <= self.columns(), "sizes of a product");
        sums(&self.values()[..self.rows() * t.rows()], self.rows(), t)
    }

    /// V ← V T on the first columns, as many as T has.
    ///
    /// # Panics
    /// Where T is not square or has more columns.
    pub fn turn(&mut self, t: &Self) {
        assert!(t.rows() == t.columns(), "sizes of a product");
        let turned = self.sums(t);
        self.values_mut()[..turned.values().len()].copy_from_slice(turned.values());
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
    fn a_congruence_and_sums_of_columns_are_the_products_by_hand() {
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
            let shares = sample(count, 5);
            let sums = v.sums(&shares);
            for j in 0..5 {
                for i in (0..n).step_by(13) {
                    let expected: f64 = (0..count).map(|k| v[(i, k)] * shares[(k, j)]).sum();
                    assert!((sums[(i, j)] - expected).abs() < 1e-12);
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
        let both = || (v.congruence(&a, m), v.sums(&sample(m, m)));
        assert_eq!(crate::threads::alone(both), both());
    }
}
