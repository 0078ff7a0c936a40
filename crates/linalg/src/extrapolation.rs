//! What a sequence of vectors goes on to.

use crate::simd::dispatch;
use pulp::{Simd, WithSimd};

/// Orders of extrapolation.
pub const ORDERS: usize = 4;

/// What the polynomials through the last 1, 2, 3 and 4 vectors of a sequence go on to, a row for each, from those of the
/// vector before:
///
/// ```text
/// S¹ₙ = xₙ        Sᵖ⁺¹ₙ = Sᵖₙ + ∇ᵖxₙ        ∇ᵖxₙ = xₙ − Sᵖₙ₋₁
/// ```
///
/// The first of `rows` holds xₙ on entry. `sizes` become the largest magnitudes of xₙ and of ∇¹xₙ … ∇⁴xₙ, the backward
/// differences: how far each row of `before` missed xₙ.
///
/// # Panics
/// Where the tables are not of one size.
#[inline]
pub fn extrapolate(before: &[f64], rows: &mut [f64], sizes: &mut [f64; ORDERS + 1]) {
    let fits = before.len() == rows.len() && rows.len().is_multiple_of(ORDERS);
    assert!(fits, "rows of extrapolations");
    dispatch(Extrapolate { before, rows, sizes });
}

struct Extrapolate<'a> {
    before: &'a [f64],
    rows: &'a mut [f64],
    sizes: &'a mut [f64; ORDERS + 1],
}

impl WithSimd for Extrapolate<'_> {
    type Output = ();

    #[inline(always)]
    fn with_simd<S: Simd>(self, simd: S) {
        let Self { before, rows, sizes } = self;
        let n = rows.len() / ORDERS;
        let (ab, cd) = before.split_at(2 * n);
        let ((a, b), (c, d)) = (ab.split_at(n), cd.split_at(n));
        let (xy, zw) = rows.split_at_mut(2 * n);
        let ((x, y), (z, w)) = (xy.split_at_mut(n), zw.split_at_mut(n));
        let (x, xe) = S::as_simd_f64s(x);
        let m = x.len();
        let ((a, ae), (b, be)) = (S::as_simd_f64s(a), S::as_simd_f64s(b));
        let ((c, ce), (d, de)) = (S::as_simd_f64s(c), S::as_simd_f64s(d));
        let (y, ye) = S::as_mut_simd_f64s(y);
        let ((z, ze), (w, we)) = (S::as_mut_simd_f64s(z), S::as_mut_simd_f64s(w));
        let (a, b, c, d) = (&a[..m], &b[..m], &c[..m], &d[..m]);
        let (y, z, w) = (&mut y[..m], &mut z[..m], &mut w[..m]);
        let mut most = [simd.splat_f64s(0.0); ORDERS + 1];
        for i in 0..m {
            let x = x[i];
            let missed = [
                x,
                simd.sub_f64s(x, a[i]),
                simd.sub_f64s(x, b[i]),
                simd.sub_f64s(x, c[i]),
                simd.sub_f64s(x, d[i]),
            ];
            for p in 0..=ORDERS {
                most[p] = simd.max_f64s(most[p], simd.abs_f64s(missed[p]));
            }
            y[i] = simd.add_f64s(x, missed[1]);
            z[i] = simd.add_f64s(y[i], missed[2]);
            w[i] = simd.add_f64s(z[i], missed[3]);
        }
        for p in 0..=ORDERS {
            sizes[p] = simd.reduce_max_f64s(most[p]);
        }
        for (i, x) in xe.iter().enumerate() {
            let missed = [*x, x - ae[i], x - be[i], x - ce[i], x - de[i]];
            for p in 0..=ORDERS {
                sizes[p] = sizes[p].max(missed[p].abs());
            }
            ye[i] = x + missed[1];
            ze[i] = ye[i] + missed[2];
            we[i] = ze[i] + missed[3];
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn polynomials_are_gone_on_with_at_every_length() {
        for n in [0, 1, 2, 7, 8, 9, 16, 19] {
            let x = |k: usize, i: usize| (((i + 31 * k) * 7919 + 13) % 101) as f64 / 50.0 - 1.0;
            let mut tables = vec![vec![0.0; ORDERS * n]; 6];
            let mut sizes = [f64::NAN; ORDERS + 1];
            for k in 1..6 {
                let (before, here) = tables.split_at_mut(k);
                (0..n).for_each(|i| here[0][i] = x(k, i));
                extrapolate(&before[k - 1], &mut here[0], &mut sizes);
            }
            let close = |a: f64, b: f64| assert!((a - b).abs() < 1e-13, "{n}: {a} {b}");
            let mut largest = [0.0_f64; ORDERS + 1];
            for i in 0..n {
                let [a, b, c, d, e] = [5, 4, 3, 2, 1].map(|k| x(k, i));
                let own = [a, 2.0 * a - b, 3.0 * a - 3.0 * b + c, 4.0 * a - 6.0 * b + 4.0 * c - d];
                (0..ORDERS).for_each(|p| close(tables[5][p * n + i], own[p]));
                let missed = [
                    a,
                    a - b,
                    a - 2.0 * b + c,
                    a - 3.0 * b + 3.0 * c - d,
                    a - 4.0 * b + 6.0 * c - 4.0 * d + e,
                ];
                largest.iter_mut().zip(missed).for_each(|(s, m)| *s = s.max(m.abs()));
            }
            sizes.iter().zip(largest).for_each(|(a, b)| close(*a, b));
        }
    }
}
