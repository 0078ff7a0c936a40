//! Products with symmetric matrices that are used in every step.
//!
//! Half of the off-diagonal entries are stored, row by row, with short indices; zeros are left out. A
//! quadratic form `xᵀ A x = Σ xᵢ (aᵢᵢ xᵢ + 2 Σ_{j<i} aᵢⱼ xⱼ)` then takes one pass that writes nothing, and
//! four of them cost hardly more than one.

use crate::Sparse;

/// A symmetric matrix for products.
#[derive(Clone, Debug, Default)]
pub struct SymmetricOperator {
    order: usize,
    /// The diagonal; without values where most of it is zero.
    diagonal: Vec<f64>,
    /// Entries of the diagonal where it is not stored as a whole.
    few: Vec<(u32, f64)>,
    /// Rows that have entries left of the diagonal.
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
        let mut diagonal = vec![0.0; n];
        let mut operator = Self { order: n, offsets: vec![0], ..Self::default() };
        // Value and size of its terms, of the upper part of a column, which is the lower part of a row.
        let mut line = vec![(0.0, 0.0); n];
        let mut places: Vec<usize> = Vec::new();
        for j in 0..n {
            places.clear();
            for (factor, part) in
                std::iter::once((1.0, a)).chain(parts.iter().map(|(f, p)| (-f, *p)))
            {
                let (rows, values) = part.column(j);
                for (i, v) in rows.iter().zip(values).filter(|(i, v)| **i <= j && **v != 0.0) {
                    if line[*i].1 == 0.0 {
                        places.push(*i);
                    }
                    line[*i].0 += factor * v;
                    line[*i].1 += (factor * v).abs();
                }
            }
            places.sort_unstable();
            let before = operator.columns.len();
            for i in &places {
                let (value, size) = std::mem::take(&mut line[*i]);
                if value.abs() <= ROUNDING * size {
                    continue;
                }
                if *i == j {
                    diagonal[j] = value;
                } else {
                    operator.columns.push(*i as u32);
                    operator.values.push(value);
                }
            }
            if operator.columns.len() > before {
                operator.rows.push(j as u32);
                operator.offsets.push(operator.columns.len() as u32);
            }
        }
        let stored = diagonal.iter().filter(|d| **d != 0.0).count();
        if 4 * stored > n {
            operator.diagonal = diagonal;
        } else {
            let entries = diagonal.iter().enumerate().filter(|(_, d)| **d != 0.0);
            operator.few = entries.map(|(i, d)| (i as u32, *d)).collect();
        }
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
        self.diagonal.len() + self.few.len() + self.values.len()
    }

    /// Rows with what is left of their diagonal: row, columns, values.
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
        for (i, d) in &self.few {
            y[*i as usize] += s * d * x[*i as usize];
        }
        for (i, columns, values) in self.lines() {
            let (mut sum, t) = (0.0, s * x[i]);
            for (j, v) in columns.iter().zip(values) {
                let j = *j as usize;
                sum += v * x[j];
                y[j] += v * t;
            }
            y[i] += s * sum;
        }
    }

    /// The quadratic forms `xᵀ A x` of vectors that are stored side by side.
    #[must_use]
    pub fn forms<const N: usize>(&self, x: &[[f64; N]]) -> [f64; N] {
        pulp::Arch::new().dispatch(
            #[inline(always)]
            || {
                let mut total = [0.0; N];
                for (d, x) in self.diagonal.iter().zip(x) {
                    for k in 0..N {
                        total[k] += d * x[k] * x[k];
                    }
                }
                for (i, d) in &self.few {
                    let x = &x[*i as usize];
                    for k in 0..N {
                        total[k] += d * x[k] * x[k];
                    }
                }
                for (i, columns, values) in self.lines() {
                    let mut sum = [0.0; N];
                    for (j, v) in columns.iter().zip(values) {
                        let x = &x[*j as usize];
                        for k in 0..N {
                            sum[k] += v * x[k];
                        }
                    }
                    for k in 0..N {
                        total[k] += 2.0 * x[i][k] * sum[k];
                    }
                }
                total
            },
        )
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
        assert_eq!(operator.stored(), 5 + 3);
        let (x, z) = ([1.0, -2.0, 3.0, 0.25, 7.0], [0.5, 1.5, -1.0, 2.0, -4.0]);
        let (mut y, mut expected) = (vec![1.0; 5], vec![1.0; 5]);
        operator.mul_add(-2.0, &x, &mut y);
        a.mul_add(-2.0, &x, &mut expected);
        assert_eq!(y, expected);
        let pairs: Vec<[f64; 2]> = x.iter().zip(&z).map(|(a, b)| [*a, *b]).collect();
        let forms = operator.forms(&pairs);
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
        assert_eq!(operator.stored(), 2);
        let x = [1.0, -2.0, 3.0, 0.25, 7.0];
        let mut y = vec![0.0; 5];
        operator.mul_add(1.0, &x, &mut y);
        assert_eq!(y, rest.mul(&x));
    }
}
