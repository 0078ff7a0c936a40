//! Symmetric eigenproblems: small dense ones, the lowest modes of sparse ones, all modes of small ones.

use crate::{Dense, Ldlt, LinalgError, Sparse};
use faer::Side;

/// Eigenvalues (rising) and orthonormal eigenvectors of a dense symmetric matrix.
///
/// # Errors
/// [`LinalgError::Backend`] where the iteration of the backend fails.
pub fn symmetric_eigen(a: &Dense) -> Result<(Vec<f64>, Dense), LinalgError> {
    let n = a.rows();
    if let Some(found) = of_diagonal(a) {
        return Ok(found);
    }
    let eigen = a
        .as_ref()
        .self_adjoint_eigen(Side::Lower)
        .map_err(|e| LinalgError::Backend { reason: format!("{e:?}") })?;
    let values = (0..n).map(|i| eigen.S()[i]).collect();
    let mut vectors = Dense::zeros(n, n);
    vectors.as_mut().copy_from(eigen.U());
    Ok((values, vectors))
}

/// The same of a matrix that is diagonal already.
fn of_diagonal(a: &Dense) -> Option<(Vec<f64>, Dense)> {
    let n = a.rows();
    let apart = |j: usize| (0..n).all(|i| i == j || a[(i, j)] == 0.0);
    if !(0..n).all(|j| apart(j) && a[(j, j)].is_finite()) {
        return None;
    }
    let mut order: Vec<usize> = (0..n).collect();
    order.sort_by(|i, j| a[(*i, *i)].total_cmp(&a[(*j, *j)]));
    let mut vectors = Dense::zeros(n, n);
    order.iter().enumerate().for_each(|(j, i)| vectors[(*i, j)] = 1.0);
    Some((order.iter().map(|i| a[(*i, *i)]).collect(), vectors))
}

/// Lowest `count` modes of `(K − λ M) φ = 0` by subspace iteration with the shift `sigma` ≤ 0 that
/// makes `K − σ M` regular. M may be singular. Returns λ (rising) and M-orthonormal vectors.
///
/// # Errors
/// Where `K − σ M` is singular or the iteration does not converge.
pub fn lowest_modes(
    k: &Sparse,
    m: &Sparse,
    count: usize,
    sigma: f64,
) -> Result<(Vec<f64>, Dense), LinalgError> {
    const ITERATIONS: usize = 200;
    let n = k.rows();
    let shifted = Sparse::combine(&[(1.0, k), (-sigma, m)]);
    let mut factor = Ldlt::new(&shifted)?;
    let size = (2 * count).min(count + 8).min(n);
    let mut x = start_block(m, size);
    let mut before = vec![f64::INFINITY; size];
    for _ in 0..ITERATIONS {
        let mut y = Dense::zeros(n, size);
        for j in 0..size {
            m.mul_add(1.0, x.column(j), y.column_mut(j));
        }
        factor.solve(y.values_mut());
        let (values, vectors) = rayleigh_ritz(&shifted, m, &y)?;
        let kept = vectors.columns();
        if kept < count {
            return Err(LinalgError::NotConverged {
                what: "the search for modes",
                iterations: kept,
            });
        }
        // The projected problem is solved no better than to the rounding of its largest value.
        let largest = values.last().map_or(0.0, |v| v.abs());
        let settled = before.len() == values.len()
            && values[..count]
                .iter()
                .zip(&before)
                .all(|(a, b)| (a - b).abs() <= 1e-12 * a.abs().max(1e-2 * largest));
        if settled {
            let found = Dense::from_columns(n, count, vectors.values()[..n * count].to_vec());
            return Ok((values[..count].iter().map(|v| v + sigma).collect(), found));
        }
        before = values;
        x = if kept == size {
            vectors
        } else {
            let mut widened = start_block(m, size);
            widened.values_mut()[..n * kept].copy_from_slice(vectors.values());
            widened
        };
    }
    Err(LinalgError::NotConverged { what: "the search for modes", iterations: ITERATIONS })
}

/// Deterministic start vectors: the mass diagonal, then scattered pseudo-random directions.
fn start_block(m: &Sparse, size: usize) -> Dense {
    let n = m.rows();
    let mut x = Dense::zeros(n, size);
    let mut seed = 0x9E37_79B9_7F4A_7C15_u64;
    for j in 0..size {
        for i in 0..n {
            seed ^= seed << 13;
            seed ^= seed >> 7;
            seed ^= seed << 17;
            x[(i, j)] = if j == 0 { 1.0 } else { (seed >> 11) as f64 / (1u64 << 52) as f64 - 1.0 };
        }
    }
    x
}

/// Rayleigh–Ritz in the span of `y`: values rising, M-orthonormal vectors. Directions without mass
/// are dropped.
fn rayleigh_ritz(k: &Sparse, m: &Sparse, y: &Dense) -> Result<(Vec<f64>, Dense), LinalgError> {
    let (n, size) = (y.rows(), y.columns());
    let apply = |a: &Sparse| {
        let mut ay = Dense::zeros(n, size);
        for j in 0..size {
            a.mul_add(1.0, y.column(j), ay.column_mut(j));
        }
        y.transpose_times(&ay)
    };
    let (mut kr, mut mr) = (apply(k), apply(m));
    // Unit diagonal of the projected mass, so that the cut is relative to each vector.
    let scale: Vec<f64> =
        (0..size).map(|j| if mr[(j, j)] > 0.0 { 1.0 / mr[(j, j)].sqrt() } else { 0.0 }).collect();
    for j in 0..size {
        for i in 0..size {
            kr[(i, j)] *= scale[i] * scale[j];
            mr[(i, j)] *= scale[i] * scale[j];
        }
    }
    let (mass, basis) = symmetric_eigen(&mr)?;
    let kept: Vec<usize> = (0..size).filter(|i| mass[*i] > 1e-13).collect();
    let mut t = Dense::zeros(size, kept.len());
    for (new, old) in kept.iter().enumerate() {
        let factor = 1.0 / mass[*old].sqrt();
        for i in 0..size {
            t[(i, new)] = scale[i] * factor * basis[(i, *old)];
        }
    }
    let mut unscaled = apply(k);
    unscaled = t.transpose_times(&unscaled.times(&t));
    let (values, vectors) = symmetric_eigen(&unscaled)?;
    Ok((values, y.times(&t.times(&vectors))))
}

/// All modes with mass of a small system `(K − λ M) φ = 0`, M singular or not, K positive
/// semi-definite: massless directions are condensed statically. Dense; for some hundred DOFs.
/// Returns λ (rising) and M-orthonormal vectors.
///
/// # Errors
/// Where a massless direction has no stiffness.
pub fn all_modes(k: &Sparse, m: &Sparse) -> Result<(Vec<f64>, Dense), LinalgError> {
    let n = k.rows();
    let dense = |a: &Sparse| {
        let mut d = Dense::zeros(n, n);
        for (i, j, v) in a.entries() {
            d[(i, j)] += v;
        }
        d
    };
    let (kd, md) = (dense(k), dense(m));
    let (mass, v) = symmetric_eigen(&md)?;
    let largest = mass.last().copied().unwrap_or(0.0);
    let massless = mass.iter().filter(|x| **x <= 1e-13 * largest).count();
    let null = Dense::from_columns(n, massless, v.values()[..n * massless].to_vec());
    let mut heavy = Dense::from_columns(n, n - massless, v.values()[n * massless..].to_vec());
    for j in 0..n - massless {
        let factor = 1.0 / mass[massless + j].sqrt();
        heavy.column_mut(j).iter_mut().for_each(|x| *x *= factor);
    }
    if massless > 0 {
        // x = heavy·y + null·z with nullᵀ K x = 0.
        let k_null = kd.times(&null);
        let mut z = k_null.transpose_times(&heavy);
        let inner = null.transpose_times(&k_null);
        crate::DenseLu::new(&inner).solve_columns(&mut z);
        if let Some(at) = z.values().iter().position(|x| !x.is_finite()) {
            return Err(LinalgError::Singular { equation: at % massless });
        }
        let shift = null.times(&z);
        for (a, b) in heavy.values_mut().iter_mut().zip(shift.values()) {
            *a -= b;
        }
    }
    let reduced = heavy.transpose_times(&kd.times(&heavy));
    let (values, vectors) = symmetric_eigen(&reduced)?;
    Ok((values, heavy.times(&vectors)))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Triplets;

    /// Fixed-fixed chain of 8 masses 10 kg and 9 springs 1e5 N/m: f_j = (1/π) √(k/m) sin(jπ/18).
    fn chain() -> (Sparse, Sparse) {
        let (mut k, mut m) = (Triplets::new(8, 8), Triplets::new(8, 8));
        for i in 0..8 {
            k.add(i, i, 2e5);
            m.add(i, i, 10.0);
            if i > 0 {
                k.add(i, i - 1, -1e5);
                k.add(i - 1, i, -1e5);
            }
        }
        (k.build(), m.build())
    }

    fn exact(j: usize) -> f64 {
        2.0 * 1e2 * (std::f64::consts::PI * j as f64 / 18.0).sin()
    }

    #[test]
    fn the_chain_has_its_closed_form_frequencies() {
        let (k, m) = chain();
        let (few, _) = lowest_modes(&k, &m, 3, 0.0).unwrap();
        let (all, _) = all_modes(&k, &m).unwrap();
        for j in 1..=8 {
            assert!((all[j - 1].sqrt() / exact(j) - 1.0).abs() < 1e-12);
        }
        for j in 1..=3 {
            assert!((few[j - 1].sqrt() / exact(j) - 1.0).abs() < 1e-10, "{few:?}");
        }
    }

    #[test]
    fn a_diagonal_matrix_is_its_own_answer_and_others_are_not_taken_for_one() {
        let a = |corner: f64| {
            Dense::from_columns(3, 3, vec![2.0, 0.0, corner, 0.0, -1.0, 0.0, corner, 0.0, 0.5])
        };
        let (values, vectors) = symmetric_eigen(&a(0.0)).unwrap();
        assert_eq!(values, [-1.0, 0.5, 2.0]);
        assert_eq!(vectors.values(), [0.0, 1.0, 0.0, 0.0, 0.0, 1.0, 1.0, 0.0, 0.0]);
        let (values, _) = symmetric_eigen(&a(1.0)).unwrap();
        assert!((values[1] - 0.5 * (2.5 - 6.25f64.sqrt())).abs() < 1e-14, "{values:?}");
    }

    #[test]
    fn massless_equations_are_condensed() {
        let mut m = Triplets::new(2, 2);
        m.add(1, 1, 2.0);
        let mut k = Triplets::new(2, 2);
        for (i, j, v) in [(0, 0, 4.0), (0, 1, -2.0), (1, 0, -2.0), (1, 1, 2.0)] {
            k.add(i, j, v);
        }
        let (values, vectors) = all_modes(&k.build(), &m.build()).unwrap();
        assert_eq!(values.len(), 1);
        assert!((values[0] - 0.5).abs() < 1e-12);
        assert!((vectors[(0, 0)] / vectors[(1, 0)] - 0.5).abs() < 1e-12);
    }
}
