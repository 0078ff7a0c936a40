//! Backward differences of a sequence of vectors.

use crate::simd::dispatch;
use pulp::{Simd, WithSimd};

/// Fills a table of backward differences, a row for each order, from that of the vector before:
///
/// ```text
/// ∇⁰xₙ = xₙ        ∇ᵖxₙ = ∇ᵖ⁻¹xₙ − ∇ᵖ⁻¹xₙ₋₁
/// ```
///
/// The first row of `table` holds xₙ on entry. Rows of the first tables, which know fewer vectors, hold what
/// follows from zeros before. `sizes` becomes the largest magnitude of each row.
///
/// # Panics
/// Where the tables have not one row for each size.
pub fn backward_differences(before: &[f64], table: &mut [f64], sizes: &mut [f64]) {
    let fits = before.len() == table.len() && table.len().is_multiple_of(sizes.len().max(1));
    assert!(fits, "rows of a table of differences");
    if !table.is_empty() {
        dispatch(Fill { before, table, sizes });
    }
}

struct Fill<'a> {
    before: &'a [f64],
    table: &'a mut [f64],
    sizes: &'a mut [f64],
}

impl WithSimd for Fill<'_> {
    type Output = ();

    #[inline(always)]
    fn with_simd<S: Simd>(self, simd: S) {
        let Self { before, table, sizes } = self;
        let n = table.len() / sizes.len();
        let (first, mut rest) = table.split_at_mut(n);
        let (mut lower, mut before) = (&*first, before);
        for (p, size) in sizes.iter_mut().enumerate() {
            let mut most = simd.splat_f64s(0.0);
            let mut last = 0.0;
            let (x, xe) = S::as_simd_f64s(lower);
            if p == 0 {
                for x in x {
                    most = simd.max_f64s(most, simd.abs_f64s(*x));
                }
                for x in xe {
                    last = if x.abs() > last { x.abs() } else { last };
                }
            } else {
                let (then, rows) = before.split_at(n);
                let (row, others) = rest.split_at_mut(n);
                let (then, then_e) = S::as_simd_f64s(then);
                let (to, to_e) = S::as_mut_simd_f64s(row);
                for (to, (x, then)) in to.iter_mut().zip(x.iter().zip(then)) {
                    *to = simd.sub_f64s(*x, *then);
                    most = simd.max_f64s(most, simd.abs_f64s(*to));
                }
                for (to, (x, then)) in to_e.iter_mut().zip(xe.iter().zip(then_e)) {
                    *to = x - then;
                    last = if to.abs() > last { to.abs() } else { last };
                }
                (lower, before, rest) = (row, rows, others);
            }
            let most = simd.reduce_max_f64s(most);
            *size = if last > most { last } else { most };
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn differences_equal_those_written_out_at_every_length() {
        for n in [1, 2, 7, 8, 9, 16, 19] {
            let x = |k: usize, i: usize| (((i + 31 * k) * 7919 + 13) % 101) as f64 / 50.0 - 1.0;
            let mut tables = vec![vec![0.0; 4 * n]; 5];
            let mut sizes = [f64::NAN; 4];
            for k in 1..5 {
                (0..n).for_each(|i| tables[k][i] = x(k, i));
                let (before, here) = tables.split_at_mut(k);
                backward_differences(&before[k - 1], &mut here[0], &mut sizes);
            }
            let close = |a: f64, b: f64| assert!((a - b).abs() < 1e-14, "{n}: {a} {b}");
            for i in 0..n {
                let [a, b, c, d] = [4, 3, 2, 1].map(|k| x(k, i));
                let own = [a, a - b, a - 2.0 * b + c, a - 3.0 * b + 3.0 * c - d];
                own.iter().enumerate().for_each(|(p, own)| close(tables[4][p * n + i], *own));
            }
            for (p, size) in sizes.iter().enumerate() {
                close(*size, crate::largest(&tables[4][p * n..(p + 1) * n]));
            }
        }
        backward_differences(&[], &mut [], &mut [0.0]);
    }
}
