//! Systems of few unknowns, where a library's way in costs more than the elimination.

use crate::Dense;

/// Solves A X = B in place, with partial pivoting, for few unknowns: A is left as its factors. A singular matrix shows in
/// values that are not finite.
///
/// # Panics
/// Where the sizes do not suit.
pub fn solve_few(a: &mut Dense, b: &mut Dense) {
    let n = a.rows();
    assert!(a.columns() == n && b.rows() == n, "sizes of a system");
    for k in 0..n {
        let column = a.column(k);
        let size = |i: &usize| column[*i].abs();
        let pivot = (k..n).max_by(|i, j| size(i).total_cmp(&size(j))).unwrap_or(k);
        let over = column[pivot].recip();
        if pivot != k {
            (k..n).for_each(|j| a.column_mut(j).swap(k, pivot));
            (0..b.columns()).for_each(|j| b.column_mut(j).swap(k, pivot));
        }
        for i in k + 1..n {
            a[(i, k)] *= over;
        }
        a[(k, k)] = over;
        let (done, rest) = a.values_mut().split_at_mut((k + 1) * n);
        let below = &done[k * n + k + 1..];
        let columns = rest.chunks_exact_mut(n).chain(b.values_mut().chunks_exact_mut(n));
        for column in columns {
            let (top, column) = column.split_at_mut(k + 1);
            let x = top[k];
            column.iter_mut().zip(below).for_each(|(y, l)| *y -= l * x);
        }
    }
    for column in b.values_mut().chunks_exact_mut(n.max(1)) {
        for k in (0..n).rev() {
            let (above, rest) = column.split_at_mut(k);
            let x = rest[0] * a[(k, k)];
            rest[0] = x;
            above.iter_mut().zip(a.column(k)).for_each(|(y, u)| *y -= u * x);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Numbers without order, between −1 and 1.
    fn numbers(rows: usize, columns: usize, mut seed: u64) -> Dense {
        let next = |_| {
            seed = seed
                .wrapping_mul(6_364_136_223_846_793_005)
                .wrapping_add(1_442_695_040_888_963_407);
            (seed >> 11) as f64 / (1_u64 << 52) as f64 - 1.0
        };
        Dense::from_columns(rows, columns, (0..rows * columns).map(next).collect())
    }

    #[test]
    fn what_comes_back_solves_the_system() {
        for n in 0..20 {
            let (a, b) = (numbers(n, n, 7 + n as u64), numbers(n, 3, 99));
            let (mut factors, mut x) = (a.clone(), b.clone());
            solve_few(&mut factors, &mut x);
            for (found, wanted) in a.times(&x).values().iter().zip(b.values()) {
                assert!((found - wanted).abs() < 1e-11, "{n}: {found} {wanted}");
            }
        }
    }

    #[test]
    fn rows_change_places_and_a_singular_matrix_shows() {
        let mut x = Dense::from_columns(2, 1, vec![1.0, 8.0]);
        solve_few(&mut Dense::from_columns(2, 2, vec![0.0, 2.0, 1.0, 3.0]), &mut x);
        assert_eq!(x.values(), [2.5, 1.0]);
        let mut x = Dense::from_columns(2, 1, vec![1.0, 1.0]);
        solve_few(&mut Dense::from_columns(2, 2, vec![1.0, 1.0, 2.0, 2.0]), &mut x);
        assert!(x.values().iter().any(|x| !x.is_finite()));
    }
}
