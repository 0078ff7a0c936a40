//! Modes of an analysis that damping does not couple.

use crate::error::SolveError;
use trilith_linalg::{Dense, Sparse, symmetric_eigen};

/// Damping between modes that counts as none, as share of the largest.
const COUPLES: f64 = 1e-10;
/// Squares of frequencies that differ by less than this share are one.
const EQUAL: f64 = 1e-9;

/// Damping of every mode, and the turn of the modes that makes it so: modes of one frequency (such as
/// those of a body that nothing but links holds) may be any combination of each other. None where damping couples
/// modes of different frequencies.
pub(super) fn uncoupled(
    omega2: &[f64],
    damping: &Sparse,
) -> Result<Option<(Vec<f64>, Dense)>, SolveError> {
    let m = omega2.len();
    let mut c = Dense::zeros(m, m);
    for (i, j, x) in damping.entries() {
        c[(i, j)] += x;
    }
    let mut turn = Dense::zeros(m, m);
    let mut first = 0;
    while first < m {
        let near = |j: &usize| (omega2[*j] - omega2[first]).abs() <= EQUAL * omega2[*j].abs();
        let n = (first..m).take_while(near).count().max(1);
        let mut part = Dense::zeros(n, n);
        for i in 0..n {
            for j in 0..n {
                part[(i, j)] = 0.5 * (c[(first + i, first + j)] + c[(first + j, first + i)]);
            }
        }
        let vectors =
            if n == 1 { Dense::from_columns(1, 1, vec![1.0]) } else { symmetric_eigen(&part)?.1 };
        for i in 0..n {
            for j in 0..n {
                turn[(first + i, first + j)] = vectors[(i, j)];
            }
        }
        first += n;
    }
    let c = turn.transpose_times(&c.times(&turn));
    let largest = (0..m).fold(0.0f64, |a, i| a.max(c[(i, i)].abs()));
    let small = |x: f64| x.abs() <= COUPLES * largest;
    let couples = (0..m).any(|i| (0..m).any(|j| i != j && !small(c[(i, j)])));
    let own = (0..m).map(|i| if small(c[(i, i)]) { 0.0 } else { c[(i, i)] }).collect();
    Ok((!couples).then_some((own, turn)))
}

/// Tᵀ x.
pub(super) fn turned(turn: &Dense, x: &[f64]) -> Vec<f64> {
    let mut y = vec![0.0; x.len()];
    turn.transpose_mul_add(1.0, x, &mut y);
    y
}
