//! Tall matrices of many columns: projections that read them once, whatever the number of vectors.
//!
//! ```text
//!   V      columns, in groups of three or eight         S = Vᵀ Y     three columns with four vectors at once, in registers
//!   Y, X   some vectors, in tiles of rows               X += V S     eight columns at once
//! ```
//!
//! A tile of the vectors stays in a cache while all columns pass, and threads share pieces of rows. General products of matrices
//! copy V, which pays with many vectors alone: with 48 they take two thirds of the time.

use crate::beside::tile;
use crate::simd::dispatch;
use crate::threads::share;
use crate::{Dense, Sparse};
use faer::linalg::matmul::matmul;
use faer::{Accum, MatRef, Par};
use pulp::{Simd, WithSimd};

/// Rows of a piece for one thread, and of a tile in it.
const ROWS: usize = 4096;
const TILE: usize = 1024;
/// Rows of eight columns that stay in the nearest cache.
const NEAR: usize = 256;
/// From so many vectors on general products are faster: for S, and for X.
const MANY: [usize; 2] = [12, 32];
/// Columns of a congruence that are made at once.
const BLOCK: usize = 64;

/// Vectors one after the other, whose number may grow.
#[derive(Clone, Debug)]
pub struct Columns {
    rows: usize,
    count: usize,
    /// Of those there are, and room for more: the system gives memory to what is written alone.
    values: Vec<f64>,
}

impl Columns {
    /// None yet, with room for `count`.
    #[must_use]
    pub fn with_capacity(rows: usize, count: usize) -> Self {
        Self { rows, count: 0, values: vec![0.0; rows * count] }
    }

    /// How many there are.
    #[must_use]
    pub fn len(&self) -> usize {
        self.count
    }

    /// True where there is none.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.count == 0
    }

    /// One more.
    ///
    /// # Panics
    /// Where its length does not suit.
    pub fn push(&mut self, x: &[f64]) {
        self.extend(&[x]);
    }

    /// Some more, which threads share.
    ///
    /// # Panics
    /// Where a length does not suit.
    pub fn extend(&mut self, x: &[impl AsRef<[f64]> + Sync]) {
        let (n, from) = (self.rows, self.values().len());
        assert!(x.iter().all(|x| x.as_ref().len() == n), "length of a column");
        self.count += x.len();
        if self.values.len() < n * self.count {
            self.values.resize(n * self.count.max(2 * (self.count - x.len())), 0.0);
        }
        let places = self.values[from..].chunks_mut(n.max(1));
        share(4 * n * x.len(), places.zip(x).collect(), |(place, x)| {
            place.copy_from_slice(x.as_ref());
        });
    }

    fn values(&self) -> &[f64] {
        &self.values[..self.count * self.rows]
    }

    /// Takes from every vector x of a block its shares in the columns from `first` on: x −= V (Vᵀ y), where y
    /// is the image of x that the columns are orthonormal to. Returns the shares Vᵀ y, one vector's after the
    /// other's.
    ///
    /// # Panics
    /// Where the lengths do not suit.
    pub fn take_out(&self, first: usize, x: &mut [Vec<f64>], y: &[Vec<f64>]) -> Vec<f64> {
        let columns = &self.values()[first.min(self.count) * self.rows..];
        if x.is_empty() || columns.is_empty() {
            return Vec::new();
        }
        let y: Vec<&[f64]> = y.iter().map(Vec::as_slice).collect();
        let shares = dots(columns, self.rows, &y);
        add(columns, self.rows, &shares, -1.0, x.iter_mut().map(Vec::as_mut_slice));
        shares.transpose().values().to_vec()
    }

    /// One of them.
    #[must_use]
    pub fn column(&self, j: usize) -> &[f64] {
        &self.values()[j * self.rows..(j + 1) * self.rows]
    }

    /// V Q of the first columns, as many as Q has rows.
    ///
    /// # Panics
    /// Where there are fewer columns.
    #[must_use]
    pub fn times(&self, q: &Dense) -> Dense {
        assert!(q.rows() <= self.len(), "sizes of a product");
        sums(&self.values()[..self.rows * q.rows()], self.rows, q)
    }

    /// As a matrix.
    #[must_use]
    pub fn into_dense(mut self) -> Dense {
        self.values.truncate(self.count * self.rows);
        Dense::from_columns(self.rows, self.count, self.values)
    }
}

/// (Vᵀ Y)ᵀ: of each column of V its products with all vectors.
fn dots(columns: &[f64], n: usize, y: &[&[f64]]) -> Dense {
    assert!(y.iter().all(|y| y.len() == n), "lengths of a product");
    let count = columns.len().checked_div(n).unwrap_or(0);
    let none = || Dense::zeros(y.len(), count);
    let mut parts: Vec<(usize, Dense)> = (0..n).step_by(ROWS).map(|at| (at, none())).collect();
    share(2 * columns.len() * y.len(), parts.iter_mut().collect(), |(from, shares)| {
        let end = n.min(*from + ROWS);
        for start in (*from..end).step_by(TILE) {
            let stop = end.min(start + TILE);
            if y.len() < MANY[0] {
                let y: Vec<&[f64]> = y.iter().map(|y| &y[start..stop]).collect();
                dispatch(Dots { columns, n, start, y: &y, shares: shares.values_mut() });
                continue;
            }
            let (y, columns) = (tile(y, start, stop), rows_of(columns, n, start, stop));
            let shares = shares.as_mut();
            matmul(shares, Accum::Add, y.as_ref().transpose(), columns, 1.0, Par::Seq);
        }
    });
    // In their order, whoever made them.
    let mut all = none();
    for (_, part) in &parts {
        all.values_mut().iter_mut().zip(part.values()).for_each(|(sum, part)| *sum += part);
    }
    all
}

/// X += factor · V S, with the shares of [`dots`].
fn add<'a>(
    columns: &[f64],
    n: usize,
    shares: &Dense,
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
    share(2 * columns.len() * count, tiles, |(start, mut x)| {
        if count < MANY[1] {
            return dispatch(Add { columns, n, start, x, shares: shares.values(), factor });
        }
        let rows = x[0].len();
        let (mut sums, columns) = (tile(&x, 0, rows), rows_of(columns, n, start, start + rows));
        let shares = shares.as_ref().transpose();
        matmul(sums.as_mut(), Accum::Add, columns, shares, factor, Par::Seq);
        x.iter_mut().enumerate().for_each(|(j, x)| x.copy_from_slice(sums.column(j)));
    });
}

/// Some rows of columns one after the other.
fn rows_of(columns: &[f64], n: usize, from: usize, to: usize) -> MatRef<'_, f64> {
    MatRef::from_column_major_slice(columns, n, columns.len() / n).subrows(from, to - from)
}

/// V T of columns one after the other.
fn sums(columns: &[f64], n: usize, t: &Dense) -> Dense {
    let mut all = Dense::zeros(n, t.columns());
    if n > 0 && t.columns() > 0 {
        add(columns, n, &t.transpose(), 1.0, all.values_mut().chunks_mut(n));
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
            let products = dots(left, n, &images);
            for i in 0..products.columns() {
                (0..width).for_each(|j| c[(start + i, start + j)] = products[(j, i)]);
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
#[path = "tall_tests.rs"]
mod tests;
