//! Products of a few long vectors with each other, and sums of them: in tiles that stay in a cache, which threads share.

use crate::Dense;
use crate::threads::share;
use faer::linalg::matmul::matmul;
use faer::{Accum, Par};

/// Rows of a piece for one thread, and of a tile in it.
const ROWS: usize = 4096;
const TILE: usize = 256;

/// Xᵀ Y of vectors of one length.
///
/// # Panics
/// Where the lengths differ.
#[must_use]
pub fn mutual_products(x: &[Vec<f64>], y: &[Vec<f64>]) -> Dense {
    let n = x.first().map_or(0, Vec::len);
    assert!(x.iter().chain(y).all(|v| v.len() == n), "lengths of vectors");
    let empty = || Dense::zeros(x.len(), y.len());
    let mut pieces: Vec<(usize, Dense)> = (0..n).step_by(ROWS).map(|at| (at, empty())).collect();
    share(2 * n * x.len() * y.len(), pieces.iter_mut().collect(), |(start, sum)| {
        let end = n.min(*start + ROWS);
        for from in (*start..end).step_by(TILE) {
            let to = end.min(from + TILE);
            let (x, y) = (tile(x, from, to), tile(y, from, to));
            matmul(sum.as_mut(), Accum::Add, x.as_ref().transpose(), y.as_ref(), 1.0, Par::Seq);
        }
    });
    // In their order, whoever made them.
    let mut all = empty();
    for (_, sum) in &pieces {
        all.values_mut().iter_mut().zip(sum.values()).for_each(|(all, sum)| *all += sum);
    }
    all
}

/// X ← X T for a square T.
///
/// # Panics
/// Where T does not suit the number of vectors, or their lengths differ.
pub fn turn_each(x: &mut [Vec<f64>], t: &Dense) {
    let (n, count) = (x.first().map_or(0, Vec::len), x.len());
    assert!(t.rows() == count && t.columns() == count, "sizes of a product");
    assert!(x.iter().all(|v| v.len() == n), "lengths of vectors");
    let mut pieces: Vec<Vec<&mut [f64]>> =
        (0..n).step_by(ROWS).map(|_| Vec::with_capacity(count)).collect();
    for x in x {
        pieces.iter_mut().zip(x.chunks_mut(ROWS)).for_each(|(piece, part)| piece.push(part));
    }
    share(2 * n * count * count, pieces, |mut piece| {
        let length = piece[0].len();
        for from in (0..length).step_by(TILE) {
            let to = length.min(from + TILE);
            let mut turned = Dense::zeros(to - from, count);
            let own = tile(&piece, from, to);
            matmul(turned.as_mut(), Accum::Replace, own.as_ref(), t.as_ref(), 1.0, Par::Seq);
            for (j, x) in piece.iter_mut().enumerate() {
                x[from..to].copy_from_slice(turned.column(j));
            }
        }
    });
}

/// Rows of vectors as a matrix.
pub(crate) fn tile(x: &[impl AsRef<[f64]>], from: usize, to: usize) -> Dense {
    let values: Vec<&[f64]> = x.iter().map(|x| &x.as_ref()[from..to]).collect();
    Dense::from_columns(to - from, x.len(), values.concat())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn products_and_sums_are_those_by_hand_on_any_number_of_threads() {
        let n = 9001;
        let number = |i: usize| ((i * 7919) % 1009) as f64 / 1009.0 - 0.5;
        let sample = |seed: usize, count: usize| -> Vec<Vec<f64>> {
            (0..count).map(|c| (0..n).map(|i| number(3 * i + c + seed)).collect()).collect()
        };
        let (x, y) = (sample(0, 3), sample(17, 2));
        let t = Dense::from_columns(3, 3, (0..9).map(number).collect());
        let both = || {
            let mut turned = x.clone();
            turn_each(&mut turned, &t);
            (mutual_products(&x, &y), turned)
        };
        let (products, turned) = both();
        assert_eq!(crate::threads::alone(both), (products.clone(), turned.clone()));
        for i in 0..3 {
            for j in 0..2 {
                let expected: f64 = x[i].iter().zip(&y[j]).map(|(a, b)| a * b).sum();
                assert!((products[(i, j)] - expected).abs() < 1e-9, "{i} {j} {expected}");
            }
        }
        for j in 0..3 {
            for at in (0..n).step_by(11) {
                let expected: f64 = (0..3).map(|i| x[i][at] * t[(i, j)]).sum();
                assert!((turned[j][at] - expected).abs() < 1e-14);
            }
        }
        turn_each(&mut [], &Dense::zeros(0, 0));
        assert_eq!(mutual_products(&[], &y[..0]), Dense::zeros(0, 0));
    }
}
