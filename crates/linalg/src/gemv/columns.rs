//! A x: sums of columns.

use super::column;
use pulp::{Simd, WithSimd};

/// `y += Σ t c` of four columns.
#[inline(always)]
fn add_four<S: Simd>(simd: S, t: [f64; 4], c: [&[f64]; 4], y: &mut [f64]) {
    let (c0, e0) = S::as_simd_f64s(c[0]);
    let (c1, e1) = S::as_simd_f64s(c[1]);
    let (c2, e2) = S::as_simd_f64s(c[2]);
    let (c3, e3) = S::as_simd_f64s(c[3]);
    let (y, e) = S::as_mut_simd_f64s(y);
    let [t0, t1, t2, t3] = t;
    let (w0, w1) = (simd.splat_f64s(t0), simd.splat_f64s(t1));
    let (w2, w3) = (simd.splat_f64s(t2), simd.splat_f64s(t3));
    for ((((y, a), b), c), d) in y.iter_mut().zip(c0).zip(c1).zip(c2).zip(c3) {
        let sum = simd.mul_add_e_f64s(w0, *a, *y);
        let sum = simd.mul_add_e_f64s(w1, *b, sum);
        let sum = simd.mul_add_e_f64s(w2, *c, sum);
        *y = simd.mul_add_e_f64s(w3, *d, sum);
    }
    if !e.is_empty() {
        let sum = simd.mul_add_e_f64s(w0, simd.partial_load_f64s(e0), simd.partial_load_f64s(e));
        let sum = simd.mul_add_e_f64s(w1, simd.partial_load_f64s(e1), sum);
        let sum = simd.mul_add_e_f64s(w2, simd.partial_load_f64s(e2), sum);
        let sum = simd.mul_add_e_f64s(w3, simd.partial_load_f64s(e3), sum);
        simd.partial_store_f64s(e, sum);
    }
}

/// The same for two vectors at once.
#[inline(always)]
fn add_four_pair<S: Simd>(simd: S, t: [[f64; 4]; 2], c: [&[f64]; 4], y: [&mut [f64]; 2]) {
    let (c0, e0) = S::as_simd_f64s(c[0]);
    let (c1, e1) = S::as_simd_f64s(c[1]);
    let (c2, e2) = S::as_simd_f64s(c[2]);
    let (c3, e3) = S::as_simd_f64s(c[3]);
    let [y, z] = y;
    let ((y, e), (z, f)) = (S::as_mut_simd_f64s(y), S::as_mut_simd_f64s(z));
    let [[t0, t1, t2, t3], [u0, u1, u2, u3]] = t;
    let (w0, w1) = (simd.splat_f64s(t0), simd.splat_f64s(t1));
    let (w2, w3) = (simd.splat_f64s(t2), simd.splat_f64s(t3));
    let (v0, v1) = (simd.splat_f64s(u0), simd.splat_f64s(u1));
    let (v2, v3) = (simd.splat_f64s(u2), simd.splat_f64s(u3));
    for (((((y, z), a), b), c), d) in y.iter_mut().zip(z).zip(c0).zip(c1).zip(c2).zip(c3) {
        let sum = simd.mul_add_e_f64s(w0, *a, *y);
        let other = simd.mul_add_e_f64s(v0, *a, *z);
        let sum = simd.mul_add_e_f64s(w1, *b, sum);
        let other = simd.mul_add_e_f64s(v1, *b, other);
        let sum = simd.mul_add_e_f64s(w2, *c, sum);
        let other = simd.mul_add_e_f64s(v2, *c, other);
        *y = simd.mul_add_e_f64s(w3, *d, sum);
        *z = simd.mul_add_e_f64s(v3, *d, other);
    }
    if !e.is_empty() {
        let (a, b) = (simd.partial_load_f64s(e0), simd.partial_load_f64s(e1));
        let (c, d) = (simd.partial_load_f64s(e2), simd.partial_load_f64s(e3));
        let sum = simd.mul_add_e_f64s(w0, a, simd.partial_load_f64s(e));
        let other = simd.mul_add_e_f64s(v0, a, simd.partial_load_f64s(f));
        let sum = simd.mul_add_e_f64s(w1, b, sum);
        let other = simd.mul_add_e_f64s(v1, b, other);
        let sum = simd.mul_add_e_f64s(w2, c, sum);
        let other = simd.mul_add_e_f64s(v2, c, other);
        simd.partial_store_f64s(e, simd.mul_add_e_f64s(w3, d, sum));
        simd.partial_store_f64s(f, simd.mul_add_e_f64s(v3, d, other));
    }
}

/// `y += t c`.
#[inline(always)]
fn add_one<S: Simd>(simd: S, t: f64, c: &[f64], y: &mut [f64]) {
    let (c, tail) = S::as_simd_f64s(c);
    let (y, e) = S::as_mut_simd_f64s(y);
    let w = simd.splat_f64s(t);
    for (y, c) in y.iter_mut().zip(c) {
        *y = simd.mul_add_e_f64s(w, *c, *y);
    }
    if !e.is_empty() {
        let sum = simd.mul_add_e_f64s(w, simd.partial_load_f64s(tail), simd.partial_load_f64s(e));
        simd.partial_store_f64s(e, sum);
    }
}

/// Vectors of a result that stay in registers.
const TILE: usize = 8;
/// Results of so many tiles at most are made tile by tile: longer columns are better read from end to end.
const TILES: usize = 4;

pub(super) struct AddColumns<'a> {
    pub a: &'a [f64],
    pub s: f64,
    pub x: &'a [f64],
    pub y: &'a mut [f64],
}

impl WithSimd for AddColumns<'_> {
    type Output = ();

    #[inline(always)]
    fn with_simd<S: Simd>(self, simd: S) {
        let Self { a, s, x, y } = self;
        let n = y.len();
        let vectors = n.div_ceil(S::F64_LANES);
        if vectors <= TILES * TILE {
            let tiles = vectors.div_ceil(TILE);
            let mut row = 0;
            for tile in 0..tiles {
                let mine = vectors * (tile + 1) / tiles - row / S::F64_LANES;
                let product = Tile { simd, a, n, row, s, x };
                match mine {
                    1 => product.add::<1>(y),
                    2 => product.add::<2>(y),
                    3 => product.add::<3>(y),
                    4 => product.add::<4>(y),
                    5 => product.add::<5>(y),
                    6 => product.add::<6>(y),
                    7 => product.add::<7>(y),
                    _ => product.add::<8>(y),
                }
                row += mine * S::F64_LANES;
            }
            return;
        }
        let mut four = [0; 4];
        let mut count = 0;
        for j in 0..x.len() {
            if x[j] != 0.0 {
                four[count] = j;
                count += 1;
            }
            if count == 4 {
                let [i, j, k, l] = four;
                let t = [s * x[i], s * x[j], s * x[k], s * x[l]];
                let c = [column(a, n, i), column(a, n, j), column(a, n, k), column(a, n, l)];
                add_four(simd, t, c, y);
                count = 0;
            }
        }
        for j in &four[..count] {
            add_one(simd, s * x[*j], column(a, n, *j), y);
        }
    }
}

/// Some rows of a product.
struct Tile<'a, S> {
    simd: S,
    a: &'a [f64],
    /// Rows of A.
    n: usize,
    /// The first of the tile.
    row: usize,
    s: f64,
    x: &'a [f64],
}

impl<S: Simd> Tile<'_, S> {
    /// Of `V` vectors of rows, the last of which may go beyond the end.
    #[inline(always)]
    fn add<const V: usize>(self, y: &mut [f64]) {
        let Self { simd, a, n, row, s, x } = self;
        let end = n.min(row + V * S::F64_LANES);
        let y = &mut y[row..end];
        let mut sums = [simd.splat_f64s(0.0); V];
        let (full, rest) = S::as_simd_f64s(y);
        for (sum, y) in sums.iter_mut().zip(full) {
            *sum = *y;
        }
        if !rest.is_empty() {
            sums[V - 1] = simd.partial_load_f64s(rest);
        }
        // Beyond the end of a column the next one is read; nobody looks at what that gives.
        let reach = V * S::F64_LANES;
        let whole = match (a.len() + n).checked_sub(row + reach) {
            Some(room) if n > 0 => (room / n).min(x.len()),
            _ => 0,
        };
        let (first, last) = x.split_at(whole);
        for (j, x) in first.iter().enumerate() {
            let start = j * n + row;
            let (column, _) = S::as_simd_f64s(&a[start..start + reach]);
            let w = simd.splat_f64s(s * x);
            for k in 0..V {
                sums[k] = simd.mul_add_e_f64s(w, column[k], sums[k]);
            }
        }
        for (j, x) in last.iter().enumerate() {
            let start = (whole + j) * n + row;
            let (column, tail) = S::as_simd_f64s(&a[start..start + end - row]);
            let w = simd.splat_f64s(s * x);
            for k in 0..column.len().min(V) {
                sums[k] = simd.mul_add_e_f64s(w, column[k], sums[k]);
            }
            if !tail.is_empty() {
                sums[V - 1] = simd.mul_add_e_f64s(w, simd.partial_load_f64s(tail), sums[V - 1]);
            }
        }
        let (full, rest) = S::as_mut_simd_f64s(y);
        for (y, sum) in full.iter_mut().zip(sums) {
            *y = sum;
        }
        if !rest.is_empty() {
            simd.partial_store_f64s(rest, sums[V - 1]);
        }
    }
}

pub(super) struct AddColumnsEach<'a, const R: usize> {
    pub a: &'a [f64],
    pub s: f64,
    pub x: [&'a [f64]; R],
    pub y: [&'a mut [f64]; R],
}

impl<const R: usize> WithSimd for AddColumnsEach<'_, R> {
    type Output = ();

    #[inline(always)]
    fn with_simd<S: Simd>(self, simd: S) {
        let Self { a, s, x, mut y } = self;
        let (n, columns) = (y[0].len(), x[0].len());
        let mut j = 0;
        while j + 4 <= columns {
            let c =
                [column(a, n, j), column(a, n, j + 1), column(a, n, j + 2), column(a, n, j + 3)];
            let factors = |r: usize| {
                let x = &x[r][j..j + 4];
                [s * x[0], s * x[1], s * x[2], s * x[3]]
            };
            let mut pairs = y.chunks_exact_mut(2);
            let mut r = 0;
            for pair in &mut pairs {
                if let [y, z] = pair {
                    add_four_pair(simd, [factors(r), factors(r + 1)], c, [y, z]);
                }
                r += 2;
            }
            for y in pairs.into_remainder() {
                add_four(simd, factors(r), c, y);
            }
            j += 4;
        }
        while j < columns {
            for r in 0..R {
                add_one(simd, s * x[r][j], column(a, n, j), y[r]);
            }
            j += 1;
        }
    }
}
