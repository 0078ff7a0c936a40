//! Products of a dense matrix and a vector: the inner loops of a step.
//!
//! Columns are taken four at a time, in vectors as wide as the processor has them; the order of the sums
//! depends on sizes (and on which factors are zero) alone, so equal inputs give equal bits.

use pulp::{Arch, Simd, WithSimd};

/// Columns taken together.
const GROUP: usize = 4;

/// `y += s · A x` with A column by column; columns of zero factors are not read.
pub(crate) fn add_columns(a: &[f64], s: f64, x: &[f64], y: &mut [f64]) {
    Arch::new().dispatch(AddColumns { a, s, x, y });
}

/// `y += s · Aᵀ x` with A column by column, for several x at once; the same bits as one after the other.
pub(crate) fn add_dots<const R: usize>(a: &[f64], s: f64, x: [&[f64]; R], y: [&mut [f64]; R]) {
    Arch::new().dispatch(AddDots { a, s, x, y });
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

struct AddColumns<'a> {
    a: &'a [f64],
    s: f64,
    x: &'a [f64],
    y: &'a mut [f64],
}

impl AddColumns<'_> {
    #[inline(always)]
    fn group<S: Simd, const N: usize>(&mut self, simd: S, columns: [usize; N]) {
        let n = self.y.len();
        let length = n / S::F64_LANES;
        // No closures here: they would not be compiled for the processor that was found.
        let mut heads: [&[S::f64s]; N] = [&[]; N];
        let mut tails: [&[f64]; N] = [&[]; N];
        let mut factors = [simd.splat_f64s(0.0); N];
        let mut t = [0.0; N];
        for k in 0..N {
            let j = columns[k];
            t[k] = self.s * self.x[j];
            factors[k] = simd.splat_f64s(t[k]);
            let (head, tail) = S::as_simd_f64s(&self.a[j * n..(j + 1) * n]);
            (heads[k], tails[k]) = (&head[..length], tail);
        }
        let (head, tail) = S::as_mut_simd_f64s(self.y);
        let head = &mut head[..length];
        for i in 0..length {
            let mut sum = head[i];
            for k in 0..N {
                sum = simd.mul_add_e_f64s(factors[k], heads[k][i], sum);
            }
            head[i] = sum;
        }
        for i in 0..tail.len() {
            for k in 0..N {
                tail[i] += t[k] * tails[k][i];
            }
        }
    }
}

impl WithSimd for AddColumns<'_> {
    type Output = ();

    #[inline(always)]
    fn with_simd<S: Simd>(mut self, simd: S) {
        let mut group = [0; GROUP];
        let mut count = 0;
        for j in 0..self.x.len() {
            if self.x[j] != 0.0 {
                group[count] = j;
                count += 1;
            }
            if count == GROUP {
                self.group(simd, group);
                count = 0;
            }
        }
        for j in &group[..count] {
            self.group(simd, [*j]);
        }
    }
}

struct AddColumnsEach<'a, const R: usize> {
    a: &'a [f64],
    s: f64,
    x: [&'a [f64]; R],
    y: [&'a mut [f64]; R],
}

impl<const R: usize> AddColumnsEach<'_, R> {
    #[inline(always)]
    fn group<S: Simd, const N: usize>(&mut self, simd: S, first: usize) {
        let n = self.y[0].len();
        let length = n / S::F64_LANES;
        let mut heads: [&[S::f64s]; N] = [&[]; N];
        let mut tails: [&[f64]; N] = [&[]; N];
        for k in 0..N {
            let (head, tail) = S::as_simd_f64s(&self.a[(first + k) * n..(first + k + 1) * n]);
            (heads[k], tails[k]) = (&head[..length], tail);
        }
        for r in 0..R {
            let mut t = [0.0; N];
            let mut factors = [simd.splat_f64s(0.0); N];
            for k in 0..N {
                t[k] = self.s * self.x[r][first + k];
                factors[k] = simd.splat_f64s(t[k]);
            }
            let (head, tail) = S::as_mut_simd_f64s(self.y[r]);
            let head = &mut head[..length];
            for i in 0..length {
                let mut sum = head[i];
                for k in 0..N {
                    sum = simd.mul_add_e_f64s(factors[k], heads[k][i], sum);
                }
                head[i] = sum;
            }
            for i in 0..tail.len() {
                for k in 0..N {
                    tail[i] += t[k] * tails[k][i];
                }
            }
        }
    }
}

impl<const R: usize> WithSimd for AddColumnsEach<'_, R> {
    type Output = ();

    #[inline(always)]
    fn with_simd<S: Simd>(mut self, simd: S) {
        let columns = self.x[0].len();
        let mut j = 0;
        while j + 2 * GROUP <= columns {
            self.group::<S, { 2 * GROUP }>(simd, j);
            j += 2 * GROUP;
        }
        while j < columns {
            self.group::<S, 1>(simd, j);
            j += 1;
        }
    }
}

struct AddDots<'a, const R: usize> {
    a: &'a [f64],
    s: f64,
    x: [&'a [f64]; R],
    y: [&'a mut [f64]; R],
}

impl<const R: usize> AddDots<'_, R> {
    #[inline(always)]
    fn group<S: Simd, const N: usize>(&mut self, simd: S, first: usize) {
        let n = self.x[0].len();
        let length = n / S::F64_LANES;
        let mut columns: [&[S::f64s]; N] = [&[]; N];
        let mut column_tails: [&[f64]; N] = [&[]; N];
        for k in 0..N {
            let (head, tail) = S::as_simd_f64s(&self.a[(first + k) * n..(first + k + 1) * n]);
            (columns[k], column_tails[k]) = (&head[..length], tail);
        }
        let mut x: [&[S::f64s]; R] = [&[]; R];
        let mut x_tails: [&[f64]; R] = [&[]; R];
        for r in 0..R {
            let (head, tail) = S::as_simd_f64s(self.x[r]);
            (x[r], x_tails[r]) = (&head[..length], tail);
        }
        let mut sums = [[simd.splat_f64s(0.0); R]; N];
        for i in 0..length {
            for k in 0..N {
                for r in 0..R {
                    sums[k][r] = simd.mul_add_e_f64s(columns[k][i], x[r][i], sums[k][r]);
                }
            }
        }
        for k in 0..N {
            for r in 0..R {
                let mut sum = simd.reduce_sum_f64s(sums[k][r]);
                for i in 0..x_tails[r].len() {
                    sum += column_tails[k][i] * x_tails[r][i];
                }
                self.y[r][first + k] += self.s * sum;
            }
        }
    }
}

impl<const R: usize> WithSimd for AddDots<'_, R> {
    type Output = ();

    #[inline(always)]
    fn with_simd<S: Simd>(mut self, simd: S) {
        let columns = self.y[0].len();
        let mut j = 0;
        // Eight sums at once keep the processor busy while each of them waits for its last product.
        while R == 1 && j + 2 * GROUP <= columns {
            self.group::<S, { 2 * GROUP }>(simd, j);
            j += 2 * GROUP;
        }
        while R <= 2 && j + GROUP <= columns {
            self.group::<S, GROUP>(simd, j);
            j += GROUP;
        }
        while j + 2 <= columns {
            self.group::<S, 2>(simd, j);
            j += 2;
        }
        while j < columns {
            self.group::<S, 1>(simd, j);
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
        for rows in [0, 1, 3, 4, 7, 8, 9, 16, 31] {
            for columns in [0, 1, 3, 4, 5, 8, 11] {
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
