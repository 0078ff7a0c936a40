//! Symmetric eigenproblems: dense ones, and all modes of small systems.

use crate::{Dense, LinalgError, Sparse};
use faer::Side;

/// Eigenvalues (rising) and orthonormal eigenvectors of a dense symmetric matrix.
///
/// Parts that no entry joins are solved apart: as one they would be mixed by rounding, more so the closer their
/// eigenvalues are, and what loads one would move the other.
///
/// # Errors
/// [`LinalgError::NotFinite`] where the matrix has numbers beyond all bounds, [`LinalgError::Backend`] where the
/// iteration of the backend fails.
pub fn symmetric_eigen(a: &Dense) -> Result<(Vec<f64>, Dense), LinalgError> {
    let n = a.rows();
    if let Some(at) = a.values().iter().position(|x| !x.is_finite()) {
        return Err(LinalgError::NotFinite { equation: at % n });
    }
    let parts = parts(a);
    if let [_] = parts[..] {
        return of_one_part(a);
    }
    let mut pairs = Vec::with_capacity(n);
    for part in &parts {
        let m = part.len();
        let own = part.iter().flat_map(|j| part.iter().map(|i| a[(*i, *j)])).collect();
        let own = Dense::from_columns(m, m, own);
        let (values, vectors) = of_one_part(&own)?;
        pairs.extend(values.into_iter().enumerate().map(|(j, value)| {
            let mut vector = vec![0.0; n];
            part.iter().zip(vectors.column(j)).for_each(|(i, x)| vector[*i] = *x);
            (value, vector)
        }));
    }
    pairs.sort_by(|a, b| a.0.total_cmp(&b.0));
    let (values, vectors): (Vec<f64>, Vec<Vec<f64>>) = pairs.into_iter().unzip();
    Ok((values, Dense::from_columns(n, n, vectors.concat())))
}

/// Equations that entries join, by their first ones.
fn parts(a: &Dense) -> Vec<Vec<usize>> {
    let mut open: Vec<usize> = (0..a.rows()).collect();
    let mut parts = Vec::new();
    while let Some(first) = open.first().copied() {
        open.remove(0);
        let (mut part, mut next) = (vec![first], 0);
        while let Some(i) = part.get(next).copied().filter(|_| !open.is_empty()) {
            let column = a.column(i);
            open.retain(|j| {
                let joined = column[*j] != 0.0 || a[(i, *j)] != 0.0;
                if joined {
                    part.push(*j);
                }
                !joined
            });
            next += 1;
        }
        part.sort_unstable();
        parts.push(part);
    }
    parts
}

/// The same of a matrix whose equations hang together.
fn of_one_part(a: &Dense) -> Result<(Vec<f64>, Dense), LinalgError> {
    let n = a.rows();
    if n == 1 {
        return Ok((vec![a[(0, 0)]], Dense::from_columns(1, 1, vec![1.0])));
    }
    // Beyond 128 equations the backend divides and conquers, and compares some differences with an absolute 2⁻⁵²:
    // it is right for matrices of size one only. A power of two rounds nothing.
    let most = a.values().iter().fold(0.0_f64, |most, x| most.max(x.abs()));
    let size =
        if most.is_normal() { most.log2().floor().clamp(-1000.0, 1000.0).exp2() } else { 1.0 };
    let mut scaled = a.clone();
    scaled.values_mut().iter_mut().for_each(|x| *x /= size);
    let eigen = scaled
        .as_ref()
        .self_adjoint_eigen(Side::Lower)
        .map_err(|e| LinalgError::Backend { reason: format!("{e:?}") })?;
    let values: Vec<f64> = (0..n).map(|i| eigen.S()[i]).collect();
    let mut vectors = Dense::zeros(n, n);
    vectors.as_mut().copy_from(eigen.U());
    let residual = residual(&scaled, &values, &vectors);
    if residual.is_nan() || residual > WRONG {
        let reason = format!("eigenvectors of {n} equations leave a residual of {residual:.1e}");
        return Err(LinalgError::Backend { reason });
    }
    Ok((values.into_iter().map(|x| size * x).collect(), vectors))
}

/// A residual of a matrix of size one beyond this is no rounding.
const WRONG: f64 = 1e-9;

/// Root mean square of (A Q − Q Λ) x for a vector x of plus and minus ones without a pattern: what a wrong pair
/// leaves is seen without the work of a product of matrices.
fn residual(a: &Dense, values: &[f64], vectors: &Dense) -> f64 {
    let n = values.len();
    let sign = |j: usize| if (j * j / 3 + j / 2).is_multiple_of(2) { 1.0 } else { -1.0 };
    let (mut sum, mut weighted) = (vec![0.0; n], vec![0.0; n]);
    for (j, value) in values.iter().enumerate() {
        for (i, q) in vectors.column(j).iter().enumerate() {
            sum[i] += sign(j) * q;
            weighted[i] += sign(j) * value * q;
        }
    }
    let mut left: Vec<f64> = weighted.iter().map(|x| -x).collect();
    for (j, x) in sum.iter().enumerate() {
        left.iter_mut().zip(a.column(j)).for_each(|(left, a)| *left += a * x);
    }
    (left.iter().map(|x| x * x).sum::<f64>() / n as f64).sqrt()
}

/// A mass below this share of what its own equations weigh is rounding: the direction has none.
const MASSLESS: f64 = 1e-13;
/// Modes slower than this share of the fastest ones' λ are found once more among themselves.
const SLOW: f64 = 1e-5;

/// All modes with mass of a small system `(K − λ M) φ = 0`, M singular or not, K positive
/// semi-definite: massless directions are condensed statically. Dense; for some hundred DOFs.
/// Returns λ (rising) and M-orthonormal vectors.
///
/// Masses are told from none by what their own equations weigh, so they may be of any size beside each other;
/// and slow modes are as accurate as fast ones.
///
/// # Errors
/// Where a massless direction has no stiffness.
pub fn all_modes(k: &Sparse, m: &Sparse) -> Result<(Vec<f64>, Dense), LinalgError> {
    let (null, mut modes) = split(m)?;
    let (massless, count) = (null.columns(), modes.columns());
    if massless > 0 && count > 0 {
        // x = heavy·y + null·z with nullᵀ K x = 0.
        let mut k_null = Dense::zeros(null.rows(), massless);
        for j in 0..massless {
            k.mul_add(1.0, null.column(j), k_null.column_mut(j));
        }
        let mut z = k_null.transpose_times(&modes);
        let inner = null.transpose_times(&k_null);
        crate::DenseLu::new(&inner).solve_columns(&mut z);
        if let Some(at) = z.values().iter().position(|x| !x.is_finite()) {
            return Err(LinalgError::Singular { equation: at % massless });
        }
        let shift = null.times(&z);
        for (a, b) in modes.values_mut().iter_mut().zip(shift.values()) {
            *a -= b;
        }
    }
    // A dense eigenvalue is found no better than to the rounding of the largest one.
    let (mut values, mut slow) = (vec![0.0; count], count);
    while slow > 0 {
        let (again, rotation) = symmetric_eigen(&modes.congruence(k, slow))?;
        modes.turn(&rotation);
        values[..slow].copy_from_slice(&again);
        let largest = again.last().copied().unwrap_or(0.0);
        let slower = again.iter().filter(|w| **w < SLOW * largest).count();
        slow = if slower < slow { slower } else { 0 };
    }
    Ok((values, modes))
}

/// Directions without mass, and M-orthonormal ones with. M is scaled to a unit diagonal, so that neither units nor
/// sizes of masses decide.
fn split(m: &Sparse) -> Result<(Dense, Dense), LinalgError> {
    let n = m.rows();
    let scale: Vec<f64> =
        m.diagonal().iter().map(|d| if *d > 0.0 { d.sqrt().recip() } else { 0.0 }).collect();
    let mut scaled = Dense::zeros(n, n);
    for (i, j, v) in m.entries() {
        scaled[(i, j)] += v * scale[i] * scale[j];
    }
    for i in (0..n).filter(|i| scale[*i] > 0.0) {
        scaled[(i, i)] = 1.0;
    }
    let (mass, mut v) = symmetric_eigen(&scaled)?;
    let massless = mass.iter().filter(|x| **x <= MASSLESS).count();
    for j in 0..n {
        let size = if j < massless { 1.0 } else { mass[j].sqrt().recip() };
        for (x, s) in v.column_mut(j).iter_mut().zip(&scale) {
            *x *= if *s > 0.0 { s * size } else { 1.0 };
        }
    }
    let (null, heavy) = v.values().split_at(n * massless);
    let matrix = |values: &[f64]| Dense::from_columns(n, values.len() / n.max(1), values.to_vec());
    Ok((matrix(null), matrix(heavy)))
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
        let (all, _) = all_modes(&k, &m).unwrap();
        for j in 1..=8 {
            assert!((all[j - 1].sqrt() / exact(j) - 1.0).abs() < 1e-12);
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

    /// Two chains of one frequency, whose equations take turns.
    #[test]
    fn what_does_not_hang_together_is_not_mixed() {
        let n = 12;
        let mut a = Dense::zeros(2 * n, 2 * n);
        for (i, part) in (0..n).flat_map(|i| [(i, 0), (i, 1)]) {
            a[(2 * i + part, 2 * i + part)] = 2.0;
            if i > 0 {
                a[(2 * i + part, 2 * i + part - 2)] = -1.0;
                a[(2 * i + part - 2, 2 * i + part)] = -1.0;
            }
        }
        let (values, vectors) = symmetric_eigen(&a).unwrap();
        assert!(values.is_sorted());
        for j in 0..2 * n {
            let of = |part: usize| vectors.column(j).iter().skip(part).step_by(2);
            let in_none = |part| of(part).all(|x| *x == 0.0);
            assert!(in_none(0) != in_none(1), "vector {j}");
            let exact = 2.0 - 2.0 * (std::f64::consts::PI * (j / 2 + 1) as f64 / 13.0).cos();
            assert!((values[j] - exact).abs() < 1e-14, "{j}: {} for {exact}", values[j]);
        }
    }

    /// Stiffnesses over masses are of any size; the backend takes another way beyond 128 equations.
    #[test]
    fn eigenvectors_are_as_exact_whatever_the_size_of_the_numbers() {
        let n = 150;
        for size in [1e12, 1.0, 1e-12] {
            let mut a = Dense::zeros(n, n);
            let mut seed = 1_u64;
            for i in 0..n {
                for j in 0..=i {
                    seed = seed.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1);
                    let x = size * ((seed >> 11) as f64 / (1_u64 << 53) as f64 - 0.5);
                    (a[(i, j)], a[(j, i)]) = (x, x);
                }
            }
            let (values, vectors) = symmetric_eigen(&a).unwrap();
            for (j, value) in values.iter().enumerate() {
                let q = vectors.column(j);
                for i in 0..n {
                    let left: f64 = (0..n).map(|l| a[(i, l)] * q[l]).sum::<f64>() - value * q[i];
                    assert!(left.abs() < 1e-12 * size, "{size:e}: pair {j} leaves {left:e}");
                }
            }
        }
    }

    #[test]
    fn numbers_beyond_all_bounds_are_an_error() {
        for wrong in [f64::INFINITY, f64::NEG_INFINITY, f64::NAN] {
            let a = Dense::from_columns(2, 2, vec![1.0, wrong, wrong, 2.0]);
            assert_eq!(symmetric_eigen(&a).unwrap_err(), LinalgError::NotFinite { equation: 1 });
            let a = Dense::from_columns(2, 2, vec![wrong, 0.0, 0.0, 2.0]);
            assert_eq!(symmetric_eigen(&a).unwrap_err(), LinalgError::NotFinite { equation: 0 });
        }
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

    /// A light mass on a heavy one: λ from the characteristic polynomial.
    #[test]
    fn light_masses_beside_heavy_ones_are_masses() {
        // Apart, and as rotary inertia about a place that the mass is off by e.
        for (light, e) in [(1e-9, 0.0), (1e-6, 0.0), (1e-9, 2e-8), (1e-12, 3e-9)] {
            let heavy = 1e6;
            let mass = [heavy, heavy * e, light + heavy * e * e];
            let stiffness = [3e6, -1e6, 1e6];
            let [k, m] = [stiffness, mass].map(|[a, b, c]| {
                let mut t = Triplets::new(2, 2);
                for (i, j, v) in [(0, 0, a), (0, 1, b), (1, 0, b), (1, 1, c)] {
                    t.add(i, j, v);
                }
                t.build()
            });
            let (values, vectors) = all_modes(&k, &m).unwrap();
            // a λ² − b λ + c = 0, without the difference that rounding would spoil.
            let [k, s] = [stiffness, mass];
            let (a, c) = (heavy * light, k[0] * k[2] - k[1] * k[1]);
            let b = k[0] * s[2] + k[2] * s[0] - 2.0 * k[1] * s[1];
            let larger = b + (b * b - 4.0 * a * c).sqrt();
            let expected = [2.0 * c / larger, larger / (2.0 * a)];
            assert_eq!(values.len(), 2, "{light} {e}: {values:?}");
            for (j, (found, expected)) in values.iter().zip(expected).enumerate() {
                assert!(
                    (found / expected - 1.0).abs() < 1e-9,
                    "{light} {e}: {values:?} {expected}"
                );
                let image = m.mul(vectors.column(j));
                let square = crate::dot(vectors.column(j), &image);
                assert!((square - 1.0).abs() < 1e-9, "{square}");
            }
        }
    }
}
