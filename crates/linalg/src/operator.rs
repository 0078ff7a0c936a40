//! Products with symmetric matrices that are used in every step.
//!
//! Rows with short indices; zeros are left out. Both triangles are stored, although one would do for a
//! quadratic form: `xᵀ A x = Σ xᵢ (A x)ᵢ` loses no digits where A x is small beside its terms, as for a
//! stiff structure that moves as a whole, only if all terms of a row come together. One pass gives several
//! forms.

use crate::Sparse;
use pulp::{Simd, WithSimd};

/// A symmetric matrix for products.
#[derive(Clone, Debug, Default)]
pub struct SymmetricOperator {
    order: usize,
    /// The diagonal of a matrix that is nothing else.
    diagonal: Vec<f64>,
    /// Rows that are not empty.
    rows: Vec<u32>,
    offsets: Vec<u32>,
    columns: Vec<u32>,
    values: Vec<f64>,
}

impl SymmetricOperator {
    /// From a matrix whose entries are symmetric.
    #[must_use]
    pub fn new(a: &Sparse) -> Self {
        Self::difference(a, &[])
    }

    /// A − Σ factor · matrix, where what cancels but for its rounding is left out.
    #[must_use]
    pub fn difference(a: &Sparse, parts: &[(f64, &Sparse)]) -> Self {
        let n = a.columns();
        let mut operator = Self { order: n, offsets: vec![0], ..Self::default() };
        // Value, and size of its terms, of a column, which is a row.
        let mut line = vec![(0.0, 0.0); n];
        let mut places: Vec<usize> = Vec::new();
        for j in 0..n {
            places.clear();
            let all = std::iter::once((1.0, a)).chain(parts.iter().map(|(f, p)| (-f, *p)));
            for (factor, part) in all {
                let (rows, values) = part.column(j);
                for (i, v) in rows.iter().zip(values).filter(|(_, v)| factor * **v != 0.0) {
                    if line[*i].1 == 0.0 {
                        places.push(*i);
                    }
                    line[*i].0 += factor * v;
                    line[*i].1 += (factor * v).abs();
                }
            }
            places.sort_unstable();
            for i in &places {
                let (value, size) = std::mem::take(&mut line[*i]);
                if value.abs() > ROUNDING * size {
                    operator.columns.push(*i as u32);
                    operator.values.push(value);
                }
            }
            let end = operator.columns.len() as u32;
            if operator.offsets.last() != Some(&end) {
                operator.rows.push(j as u32);
                operator.offsets.push(end);
            }
        }
        if 4 * operator.rows.len() > n && operator.rows == operator.columns {
            let mut diagonal = vec![0.0; n];
            operator
                .rows
                .iter()
                .zip(&operator.values)
                .for_each(|(i, v)| diagonal[*i as usize] = *v);
            return Self { order: n, diagonal, ..Self::default() };
        }
        operator.columns.shrink_to_fit();
        operator.values.shrink_to_fit();
        operator
    }

    /// Number of rows.
    #[must_use]
    pub fn order(&self) -> usize {
        self.order
    }

    /// Number of stored values.
    #[must_use]
    pub fn stored(&self) -> usize {
        self.diagonal.len() + self.values.len()
    }

    /// Rows that are not empty: row, columns, values.
    #[inline(always)]
    fn lines(&self) -> impl Iterator<Item = (usize, &[u32], &[f64])> {
        self.rows.iter().zip(self.offsets.windows(2)).map(|(row, range)| {
            let range = range[0] as usize..range[1] as usize;
            (*row as usize, &self.columns[range.clone()], &self.values[range])
        })
    }

    /// `y += s · A x`.
    pub fn mul_add(&self, s: f64, x: &[f64], y: &mut [f64]) {
        for ((y, d), x) in y.iter_mut().zip(&self.diagonal).zip(x) {
            *y += s * d * x;
        }
        for (i, columns, values) in self.lines() {
            let sum: f64 = columns.iter().zip(values).map(|(j, v)| v * x[*j as usize]).sum();
            y[i] += s * sum;
        }
    }

    /// The quadratic forms `xᵀ A x` of several vectors; `x` gives their values in a row.
    #[must_use]
    pub fn forms<const N: usize>(&self, x: impl Fn(usize) -> [f64; N]) -> [f64; N] {
        crate::simd::dispatch(Forms { of: self, x })
    }
}

struct Forms<'a, F> {
    of: &'a SymmetricOperator,
    x: F,
}

impl<const N: usize, F: Fn(usize) -> [f64; N]> WithSimd for Forms<'_, F> {
    type Output = [f64; N];
    #[inline(always)]
    fn with_simd<S: Simd>(self, _: S) -> [f64; N] {
        let mut total = [0.0; N];
        for (i, d) in self.of.diagonal.iter().enumerate() {
            let x = (self.x)(i);
            for k in 0..N {
                total[k] += x[k] * (d * x[k]);
            }
        }
        for (i, columns, values) in self.of.lines() {
            let mut sum = [0.0; N];
            for (j, v) in columns.iter().zip(values) {
                let x = (self.x)(*j as usize);
                for k in 0..N {
                    sum[k] += v * x[k];
                }
            }
            let x = (self.x)(i);
            for k in 0..N {
                total[k] += x[k] * sum[k];
            }
        }
        total
    }
}

/// Share of its terms that a value keeps as rounding when they cancel.
const ROUNDING: f64 = 4.0 * f64::EPSILON;

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Triplets;

    fn matrix() -> Sparse {
        let mut t = Triplets::new(5, 5);
        for (i, j, v) in [(0, 1, 2.0), (1, 4, -3.0), (0, 3, 0.5), (2, 2, 0.0), (1, 2, 0.0)] {
            t.add(i, j, v);
            t.add(j, i, v);
        }
        for i in [0, 1, 3, 4] {
            t.add(i, i, 1.0 + i as f64);
        }
        t.build()
    }

    #[test]
    fn products_are_those_of_the_matrix() {
        let a = matrix();
        let operator = SymmetricOperator::new(&a);
        assert_eq!(operator.stored(), 4 + 2 * 3);
        let (x, z) = ([1.0, -2.0, 3.0, 0.25, 7.0], [0.5, 1.5, -1.0, 2.0, -4.0]);
        let (mut y, mut expected) = (vec![1.0; 5], vec![1.0; 5]);
        operator.mul_add(-2.0, &x, &mut y);
        a.mul_add(-2.0, &x, &mut expected);
        y.iter().zip(&expected).for_each(|(a, b)| assert!((a - b).abs() < 1e-13));
        let forms = operator.forms(|i| [x[i], z[i]]);
        assert!((forms[0] - a.bilinear(&x, &x)).abs() < 1e-12);
        assert!((forms[1] - a.bilinear(&z, &z)).abs() < 1e-12);
    }

    #[test]
    fn a_difference_keeps_only_what_does_not_cancel() {
        let (a, mut rest) = (matrix(), Triplets::new(5, 5));
        rest.add(2, 2, 4.0);
        rest.add(0, 4, 1.0);
        rest.add(4, 0, 1.0);
        let rest = rest.build();
        let sum = Sparse::combine(&[(0.3, &a), (1.0, &rest)]);
        let operator = SymmetricOperator::difference(&sum, &[(0.3, &a)]);
        assert_eq!(operator.stored(), 3);
        let x = [1.0, -2.0, 3.0, 0.25, 7.0];
        let mut y = vec![0.0; 5];
        operator.mul_add(1.0, &x, &mut y);
        y.iter().zip(rest.mul(&x)).for_each(|(a, b)| assert!((a - b).abs() < 1e-14));
    }

    #[test]
    fn a_diagonal_matrix_is_multiplied_as_such() {
        let mut t = Triplets::new(3, 3);
        t.add(0, 0, 2.0);
        t.add(2, 2, 3.0);
        let mass = SymmetricOperator::new(&t.build());
        assert_eq!(mass.stored(), 3);
        assert_eq!(mass.forms(|i| [1.0 + i as f64, 1.0]), [29.0, 5.0]);
        let mut y = vec![1.0; 3];
        mass.mul_add(0.5, &[1.0, 1.0, 2.0], &mut y);
        assert_eq!(y, [2.0, 1.0, 4.0]);
    }
}
