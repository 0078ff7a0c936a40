//! Is a matrix symmetric and positive semi-definite?

/// Larger matrices are looked at entry by entry alone: the factor costs n³/3.
const FACTORISED: usize = 256;

/// What keeps a matrix from being symmetric and positive semi-definite.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum NotDefinite {
    NotFinite {
        row: usize,
        column: usize,
        value: f64,
    },
    NotSymmetric {
        row: usize,
        column: usize,
        value: f64,
        mirrored: f64,
    },
    /// A diagonal value that is negative, or zero beside others in its row.
    Diagonal {
        row: usize,
        value: f64,
    },
    /// A combination of the directions up to this one has a negative value.
    Pivot {
        row: usize,
    },
}

/// Finite, and symmetric up to rounding: a share of the entry, and less of the largest.
pub(crate) fn symmetric(a: &[f64], n: usize) -> Result<(), NotDefinite> {
    let most = a.iter().fold(0.0_f64, |most, x| most.max(x.abs()));
    for row in 0..n {
        for column in 0..n {
            let (value, mirrored) = (a[row * n + column], a[column * n + row]);
            if !value.is_finite() {
                return Err(NotDefinite::NotFinite { row, column, value });
            }
            let allowed = 1e-9 * (value.abs() + mirrored.abs()) + 1e-12 * most;
            if column < row && (value - mirrored).abs() > allowed {
                return Err(NotDefinite::NotSymmetric { row, column, value, mirrored });
            }
        }
    }
    Ok(())
}

/// The same, and positive semi-definite: Cholesky of the matrix scaled to a unit diagonal plus `slack`.
pub(crate) fn semi_definite(a: &[f64], n: usize, slack: f64) -> Result<(), NotDefinite> {
    symmetric(a, n)?;
    let most = a.iter().fold(0.0_f64, |most, x| most.max(x.abs()));
    let diagonal = |i: usize| a[i * n + i];
    for row in 0..n {
        let beside = (0..n).any(|j| a[row * n + j].abs() > 1e-12 * most);
        if diagonal(row) < -1e-12 * most || (beside && diagonal(row) <= 0.0) {
            return Err(NotDefinite::Diagonal { row, value: diagonal(row) });
        }
    }
    if n > FACTORISED {
        return Ok(());
    }
    let mut l = vec![0.0; n * n];
    for i in 0..n {
        for j in 0..n {
            let size = (diagonal(i) * diagonal(j)).max(0.0).sqrt();
            l[i * n + j] = if size > 0.0 { a[i * n + j] / size } else { 0.0 };
        }
        l[i * n + i] += slack;
    }
    for j in 0..n {
        for i in j..n {
            let sum: f64 = (0..j).map(|k| l[i * n + k] * l[j * n + k]).sum();
            let rest = l[i * n + j] - sum;
            if i == j && rest < 0.0 {
                return Err(NotDefinite::Pivot { row: j });
            }
            l[i * n + j] = match i == j {
                true => rest.sqrt(),
                false if l[j * n + j] > 0.0 => rest / l[j * n + j],
                false => 0.0,
            };
        }
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn semi_definite_matrices_are_told_from_others() {
        let is = |a: &[f64], n| semi_definite(a, n, 1e-9);
        assert_eq!(is(&[1.0, -1.0, -1.0, 1.0], 2), Ok(()));
        assert_eq!(is(&[0.0; 4], 2), Ok(()));
        let (row, column) = (1, 0);
        let other = NotDefinite::NotSymmetric { row, column, value: -1.0, mirrored: 0.5 };
        assert_eq!(is(&[1.0, 0.5, -1.0, 1.0], 2), Err(other));
        assert_eq!(is(&[1.0, -1.1, -1.1, 1.0], 2), Err(NotDefinite::Pivot { row: 1 }));
        assert_eq!(is(&[1.0, 0.5, 0.5, 0.0], 2), Err(NotDefinite::Diagonal { row: 1, value: 0.0 }));
        assert_eq!(is(&[-3.0], 1), Err(NotDefinite::Diagonal { row: 0, value: -3.0 }));
        assert!(matches!(is(&[f64::NAN], 1), Err(NotDefinite::NotFinite { .. })));
    }
}
