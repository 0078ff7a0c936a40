//! Aᵀ x: dots of columns.

use super::column;
use pulp::{Simd, WithSimd};

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

pub(super) struct AddDots<'a, const R: usize> {
    pub a: &'a [f64],
    pub s: f64,
    pub x: [&'a [f64]; R],
    pub y: [&'a mut [f64]; R],
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
