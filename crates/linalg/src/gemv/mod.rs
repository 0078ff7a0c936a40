//! Products of a dense matrix and vectors: the inner loops of a step.
//!
//! Columns are taken several at a time, in vectors as wide as the processor has them; a short result stays in
//! registers while all columns pass. The order of the sums depends on sizes (and on which factors are zero)
//! alone, so equal inputs give equal bits, whether one vector comes alone or with others. Slices of equal length
//! are walked in step: no index is checked, and no closure stands in the way of the processor that was found.

mod columns;
mod dots;

use crate::simd::dispatch;
use columns::{AddColumns, AddColumnsEach};
use dots::AddDots;

/// `y += s · A x` with A column by column; columns of zero factors are not read.
pub(crate) fn add_columns(a: &[f64], s: f64, x: &[f64], y: &mut [f64]) {
    dispatch(AddColumns { a, s, x, y });
}

/// `y += s · A x` for several x at once, reading A once; the same values as one after the other.
pub(crate) fn add_columns_each<const R: usize>(
    a: &[f64],
    s: f64,
    x: [&[f64]; R],
    y: [&mut [f64]; R],
) {
    dispatch(AddColumnsEach { a, s, x, y });
}

/// `y += s · Aᵀ x` with A column by column, for several x at once; the same bits as one after the other.
pub(crate) fn add_dots<const R: usize>(a: &[f64], s: f64, x: [&[f64]; R], y: [&mut [f64]; R]) {
    dispatch(AddDots { a, s, x, y });
}

#[inline(always)]
fn column(a: &[f64], n: usize, j: usize) -> &[f64] {
    &a[j * n..(j + 1) * n]
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
