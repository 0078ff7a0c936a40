//! Matrix exponential by scaling, Taylor series and squaring.

use crate::Dense;

/// (1/2)¹⁸/18! < 1e-21: rounding is reached well before.
const TERMS: i32 = 18;

/// So many terms that change nothing in turn, and no later one will.
const LAST: usize = 2;

/// Halvings that bring a norm to 1/2 at most; none bring one that overflows, whose exponential is no number either.
fn squarings(norm: f64) -> i32 {
    if norm > 0.5 && norm.is_finite() { norm.log2().ceil() as i32 + 1 } else { 0 }
}

/// [`expm`] of a small matrix, row by row, without a place on the heap.
#[must_use]
pub fn expm_small<const N: usize>(a: [[f64; N]; N]) -> [[f64; N]; N] {
    let times = |a: &[[f64; N]; N], b: &[[f64; N]; N]| {
        let mut c = [[0.0; N]; N];
        for (c, a) in c.iter_mut().zip(a) {
            for (a, b) in a.iter().zip(b) {
                c.iter_mut().zip(b).for_each(|(c, b)| *c += a * b);
            }
        }
        c
    };
    let sum_of = |j: usize| a.iter().map(|row| row[j].abs()).sum::<f64>();
    let squarings = squarings((0..N).map(sum_of).fold(0.0, f64::max));
    let scale = 0.5f64.powi(squarings);
    let scaled = a.map(|row| row.map(|x| x * scale));
    let unit: [[f64; N]; N] =
        std::array::from_fn(|i| std::array::from_fn(|j| f64::from(u8::from(i == j))));
    let (mut sum, mut term) = (unit, unit);
    let mut idle = 0;
    for k in 1..=TERMS {
        let factor = 1.0 / f64::from(k);
        term = times(&scaled, &term).map(|row| row.map(|x| x * factor));
        let before = sum;
        for (s, t) in sum.iter_mut().flatten().zip(term.iter().flatten()) {
            *s += t;
        }
        idle = if sum == before { idle + 1 } else { 0 };
        if idle == LAST {
            break;
        }
    }
    for _ in 0..squarings {
        sum = times(&sum, &sum);
    }
    sum
}

/// `exp(A)`. The series is cut where its terms fall below rounding; scaled to norm ≤ 1/2 first.
#[must_use]
pub fn expm(a: &Dense) -> Dense {
    let n = a.rows();
    let norm = (0..n).map(|j| a.column(j).iter().map(|x| x.abs()).sum::<f64>()).fold(0.0, f64::max);
    let squarings = squarings(norm);
    let scale = 0.5f64.powi(squarings);
    let mut scaled = a.clone();
    scaled.values_mut().iter_mut().for_each(|x| *x *= scale);
    let mut sum = Dense::zeros(n, n);
    let mut term = Dense::zeros(n, n);
    for i in 0..n {
        sum[(i, i)] = 1.0;
        term[(i, i)] = 1.0;
    }
    for k in 1..=TERMS {
        term = scaled.times(&term);
        let factor = 1.0 / f64::from(k);
        term.values_mut().iter_mut().for_each(|x| *x *= factor);
        for (s, t) in sum.values_mut().iter_mut().zip(term.values()) {
            *s += t;
        }
    }
    for _ in 0..squarings {
        sum = sum.times(&sum);
    }
    sum
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_rotation_generator_gives_a_rotation() {
        let angle = 7.3;
        let e = expm(&Dense::from_columns(2, 2, vec![0.0, angle, -angle, 0.0]));
        assert!((e[(0, 0)] - f64::cos(angle)).abs() < 1e-13);
        assert!((e[(1, 0)] - f64::sin(angle)).abs() < 1e-13);
    }

    /// Two thousand million squarings of it were made once.
    #[test]
    fn what_overflows_has_an_end() {
        assert!(expm_small([[f64::INFINITY, 0.0], [0.0, 1.0]])[0][0].is_nan());
        let e = expm(&Dense::from_columns(2, 2, vec![-f64::INFINITY, 0.0, 0.0, 1.0]));
        assert!(!e[(0, 0)].is_finite());
        // The largest that does not: to nothing.
        assert_eq!(expm_small([[-1e308]]), [[0.0]]);
    }

    #[test]
    fn the_small_one_equals_the_other() {
        let a = [[0.3, -2.0, 0.1], [1.7, 0.4, -0.6], [0.0, 5.0, -1.1]];
        let small = expm_small(a);
        let dense = Dense::from_columns(3, 3, (0..9).map(|i| a[i % 3][i / 3]).collect());
        let e = expm(&dense);
        for i in 0..3 {
            for j in 0..3 {
                assert!((small[i][j] - e[(i, j)]).abs() < 1e-13 * e[(i, j)].abs().max(1.0));
            }
        }
    }
}
