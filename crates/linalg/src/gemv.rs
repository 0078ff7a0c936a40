//! Products of a dense matrix and vectors: the inner loops of a step.
//!
//! Columns are taken several at a time, in vectors as wide as the processor has them; a short result stays in
//! registers while all columns pass. The order of the sums depends on sizes (and on which factors are zero)
//! alone, so equal inputs give equal bits, whether one vector comes alone or with others. Slices of equal length
//! are walked in step: no index is checked, and no closure stands in the way of the processor that was found.

use pulp::{Arch, Simd, WithSimd};

/// `y += s · A x` with A column by column; columns of zero factors are not read.
pub(crate) fn add_columns(a: &[f64], s: f64, x: &[f64], y: &mut [f64]) {
    Arch::new().dispatch(AddColumns { a, s, x, y });
}

/// `y += s · A x` for several x at once, reading A once; the same values as one after the other.
pub(crate) fn add_columns_each<const R: usize>(
    a: &[f64],
    s: f64,
    x: [&[f64]; R],
    y: [&mut [f64]; R],
) {
    Arch::new().dispatch(AddColumnsEach { a, s, x, y });
}

/// `y += s · Aᵀ x` with A column by column, for several x at once; the same bits as one after the other.
pub(crate) fn add_dots<const R: usize>(a: &[f64], s: f64, x: [&[f64]; R], y: [&mut [f64]; R]) {
    Arch::new().dispatch(AddDots { a, s, x, y });
}

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

struct AddColumns<'a> {
    a: &'a [f64],
    s: f64,
    x: &'a [f64],
    y: &'a mut [f64],
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

#[inline(always)]
fn column(a: &[f64], n: usize, j: usize) -> &[f64] {
    &a[j * n..(j + 1) * n]
}

struct AddColumnsEach<'a, const R: usize> {
    a: &'a [f64],
    s: f64,
    x: [&'a [f64]; R],
    y: [&'a mut [f64]; R],
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

/// Dots of eight columns with one vector.
#[inline(always)]
fn dot_eight<S: Simd>(simd: S, c: [&[f64]; 8], x: &[f64]) -> [f64; 8] {
    let (c0, e0) = S::as_simd_f64s(c[0]);
    let (c1, e1) = S::as_simd_f64s(c[1]);
    let (c2, e2) = S::as_simd_f64s(c[2]);
    let (c3, e3) = S::as_simd_f64s(c[3]);
    let (c4, e4) = S::as_simd_f64s(c[4]);
    let (c5, e5) = S::as_simd_f64s(c[5]);
    let (c6, e6) = S::as_simd_f64s(c[6]);
    let (c7, e7) = S::as_simd_f64s(c[7]);
    let (x, e) = S::as_simd_f64s(x);
    let m = x.len();
    let (c0, c1, c2, c3) = (&c0[..m], &c1[..m], &c2[..m], &c3[..m]);
    let (c4, c5, c6, c7) = (&c4[..m], &c5[..m], &c6[..m], &c7[..m]);
    let zero = simd.splat_f64s(0.0);
    let (mut s0, mut s1, mut s2, mut s3) = (zero, zero, zero, zero);
    let (mut s4, mut s5, mut s6, mut s7) = (zero, zero, zero, zero);
    for i in 0..m {
        let x = x[i];
        s0 = simd.mul_add_e_f64s(c0[i], x, s0);
        s1 = simd.mul_add_e_f64s(c1[i], x, s1);
        s2 = simd.mul_add_e_f64s(c2[i], x, s2);
        s3 = simd.mul_add_e_f64s(c3[i], x, s3);
        s4 = simd.mul_add_e_f64s(c4[i], x, s4);
        s5 = simd.mul_add_e_f64s(c5[i], x, s5);
        s6 = simd.mul_add_e_f64s(c6[i], x, s6);
        s7 = simd.mul_add_e_f64s(c7[i], x, s7);
    }
    if !e.is_empty() {
        let x = simd.partial_load_f64s(e);
        s0 = simd.mul_add_e_f64s(simd.partial_load_f64s(e0), x, s0);
        s1 = simd.mul_add_e_f64s(simd.partial_load_f64s(e1), x, s1);
        s2 = simd.mul_add_e_f64s(simd.partial_load_f64s(e2), x, s2);
        s3 = simd.mul_add_e_f64s(simd.partial_load_f64s(e3), x, s3);
        s4 = simd.mul_add_e_f64s(simd.partial_load_f64s(e4), x, s4);
        s5 = simd.mul_add_e_f64s(simd.partial_load_f64s(e5), x, s5);
        s6 = simd.mul_add_e_f64s(simd.partial_load_f64s(e6), x, s6);
        s7 = simd.mul_add_e_f64s(simd.partial_load_f64s(e7), x, s7);
    }
    [
        simd.reduce_sum_f64s(s0),
        simd.reduce_sum_f64s(s1),
        simd.reduce_sum_f64s(s2),
        simd.reduce_sum_f64s(s3),
        simd.reduce_sum_f64s(s4),
        simd.reduce_sum_f64s(s5),
        simd.reduce_sum_f64s(s6),
        simd.reduce_sum_f64s(s7),
    ]
}

/// Dots of four columns with one vector.
#[inline(always)]
fn dot_four<S: Simd>(simd: S, c: [&[f64]; 4], x: &[f64]) -> [f64; 4] {
    let (c0, e0) = S::as_simd_f64s(c[0]);
    let (c1, e1) = S::as_simd_f64s(c[1]);
    let (c2, e2) = S::as_simd_f64s(c[2]);
    let (c3, e3) = S::as_simd_f64s(c[3]);
    let (x, e) = S::as_simd_f64s(x);
    let zero = simd.splat_f64s(0.0);
    let (mut s0, mut s1, mut s2, mut s3) = (zero, zero, zero, zero);
    for ((((x, a), b), c), d) in x.iter().zip(c0).zip(c1).zip(c2).zip(c3) {
        s0 = simd.mul_add_e_f64s(*a, *x, s0);
        s1 = simd.mul_add_e_f64s(*b, *x, s1);
        s2 = simd.mul_add_e_f64s(*c, *x, s2);
        s3 = simd.mul_add_e_f64s(*d, *x, s3);
    }
    if !e.is_empty() {
        let x = simd.partial_load_f64s(e);
        s0 = simd.mul_add_e_f64s(simd.partial_load_f64s(e0), x, s0);
        s1 = simd.mul_add_e_f64s(simd.partial_load_f64s(e1), x, s1);
        s2 = simd.mul_add_e_f64s(simd.partial_load_f64s(e2), x, s2);
        s3 = simd.mul_add_e_f64s(simd.partial_load_f64s(e3), x, s3);
    }
    [
        simd.reduce_sum_f64s(s0),
        simd.reduce_sum_f64s(s1),
        simd.reduce_sum_f64s(s2),
        simd.reduce_sum_f64s(s3),
    ]
}

/// Dots of four columns with two vectors at once.
#[inline(always)]
fn dot_four_pair<S: Simd>(simd: S, c: [&[f64]; 4], x: [&[f64]; 2]) -> [[f64; 4]; 2] {
    let (c0, e0) = S::as_simd_f64s(c[0]);
    let (c1, e1) = S::as_simd_f64s(c[1]);
    let (c2, e2) = S::as_simd_f64s(c[2]);
    let (c3, e3) = S::as_simd_f64s(c[3]);
    let (x0, f0) = S::as_simd_f64s(x[0]);
    let (x1, f1) = S::as_simd_f64s(x[1]);
    let zero = simd.splat_f64s(0.0);
    let (mut s0, mut s1, mut s2, mut s3) = (zero, zero, zero, zero);
    let (mut t0, mut t1, mut t2, mut t3) = (zero, zero, zero, zero);
    for (((((x, y), a), b), c), d) in x0.iter().zip(x1).zip(c0).zip(c1).zip(c2).zip(c3) {
        s0 = simd.mul_add_e_f64s(*a, *x, s0);
        s1 = simd.mul_add_e_f64s(*b, *x, s1);
        s2 = simd.mul_add_e_f64s(*c, *x, s2);
        s3 = simd.mul_add_e_f64s(*d, *x, s3);
        t0 = simd.mul_add_e_f64s(*a, *y, t0);
        t1 = simd.mul_add_e_f64s(*b, *y, t1);
        t2 = simd.mul_add_e_f64s(*c, *y, t2);
        t3 = simd.mul_add_e_f64s(*d, *y, t3);
    }
    if !f0.is_empty() {
        let (a, b) = (simd.partial_load_f64s(e0), simd.partial_load_f64s(e1));
        let (c, d) = (simd.partial_load_f64s(e2), simd.partial_load_f64s(e3));
        let (x, y) = (simd.partial_load_f64s(f0), simd.partial_load_f64s(f1));
        s0 = simd.mul_add_e_f64s(a, x, s0);
        s1 = simd.mul_add_e_f64s(b, x, s1);
        s2 = simd.mul_add_e_f64s(c, x, s2);
        s3 = simd.mul_add_e_f64s(d, x, s3);
        t0 = simd.mul_add_e_f64s(a, y, t0);
        t1 = simd.mul_add_e_f64s(b, y, t1);
        t2 = simd.mul_add_e_f64s(c, y, t2);
        t3 = simd.mul_add_e_f64s(d, y, t3);
    }
    let first = [
        simd.reduce_sum_f64s(s0),
        simd.reduce_sum_f64s(s1),
        simd.reduce_sum_f64s(s2),
        simd.reduce_sum_f64s(s3),
    ];
    let second = [
        simd.reduce_sum_f64s(t0),
        simd.reduce_sum_f64s(t1),
        simd.reduce_sum_f64s(t2),
        simd.reduce_sum_f64s(t3),
    ];
    [first, second]
}

/// Dot of one column with one vector.
#[inline(always)]
fn dot_one<S: Simd>(simd: S, c: &[f64], x: &[f64]) -> f64 {
    let ((c, e), (x, f)) = (S::as_simd_f64s(c), S::as_simd_f64s(x));
    let mut s = simd.splat_f64s(0.0);
    for (c, x) in c.iter().zip(x) {
        s = simd.mul_add_e_f64s(*c, *x, s);
    }
    if !f.is_empty() {
        s = simd.mul_add_e_f64s(simd.partial_load_f64s(e), simd.partial_load_f64s(f), s);
    }
    simd.reduce_sum_f64s(s)
}

struct AddDots<'a, const R: usize> {
    a: &'a [f64],
    s: f64,
    x: [&'a [f64]; R],
    y: [&'a mut [f64]; R],
}

impl<const R: usize> WithSimd for AddDots<'_, R> {
    type Output = ();

    #[inline(always)]
    fn with_simd<S: Simd>(self, simd: S) {
        let Self { a, s, x, y } = self;
        let (n, columns) = (x[0].len(), y[0].len());
        let mut j = 0;
        while R == 1 && j + 8 <= columns {
            let mut c = [x[0]; 8];
            for k in 0..8 {
                c[k] = column(a, n, j + k);
            }
            let sums = dot_eight(simd, c, x[0]);
            for k in 0..8 {
                y[0][j + k] += s * sums[k];
            }
            j += 8;
        }
        while j + 4 <= columns {
            let c =
                [column(a, n, j), column(a, n, j + 1), column(a, n, j + 2), column(a, n, j + 3)];
            let mut r = 0;
            while r + 2 <= R {
                let sums = dot_four_pair(simd, c, [x[r], x[r + 1]]);
                for k in 0..4 {
                    y[r][j + k] += s * sums[0][k];
                    y[r + 1][j + k] += s * sums[1][k];
                }
                r += 2;
            }
            if r < R {
                let sums = dot_four(simd, c, x[r]);
                for k in 0..4 {
                    y[r][j + k] += s * sums[k];
                }
            }
            j += 4;
        }
        while j < columns {
            for r in 0..R {
                y[r][j] += s * dot_one(simd, column(a, n, j), x[r]);
            }
            j += 1;
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn number(i: usize) -> f64 {
        ((i * 7919 + 13) % 101) as f64 / 50.0 - 1.0
    }

    /// Against the sums written out, for sizes on both sides of every group and vector width.
    #[test]
    fn both_products_equal_the_sums_written_out() {
        for rows in [0, 1, 3, 4, 7, 8, 9, 16, 31, 33, 47, 62, 64, 65, 150] {
            for columns in [0, 1, 3, 4, 5, 8, 11, 21] {
                let a: Vec<f64> = (0..rows * columns).map(number).collect();
                let x: Vec<f64> =
                    (0..columns).map(|j| if j % 3 == 1 { 0.0 } else { number(j + 5) }).collect();
                let z: Vec<f64> = (0..rows).map(|i| number(i + 17)).collect();
                let (mut y, mut w) = (vec![0.5; rows], vec![0.25; columns]);
                add_columns(&a, -2.0, &x, &mut y);
                add_dots(&a, 3.0, [&z], [&mut w]);
                let mut each = [vec![0.5; rows], vec![0.0; rows]];
                let [first, second] = &mut each;
                add_columns_each(&a, -2.0, [&x, &x], [first, second]);
                assert_eq!(each[0], y, "{rows} × {columns}");
                for i in 0..rows {
                    let sum: f64 = (0..columns).map(|j| a[j * rows + i] * x[j]).sum();
                    assert!((y[i] - (0.5 - 2.0 * sum)).abs() < 1e-13, "{rows} × {columns}");
                }
                for j in 0..columns {
                    let sum: f64 = (0..rows).map(|i| a[j * rows + i] * z[i]).sum();
                    assert!((w[j] - (0.25 + 3.0 * sum)).abs() < 1e-13, "{rows} × {columns}");
                }
            }
        }
    }
}
