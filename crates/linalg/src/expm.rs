//! Matrix exponential by scaling, Taylor series and squaring.

use crate::Dense;

/// `exp(A)`. The series is cut where its terms fall below rounding; scaled to norm ≤ 1/2 first.
#[must_use]
pub fn expm(a: &Dense) -> Dense {
    let n = a.rows();
    let norm = (0..n).map(|j| a.column(j).iter().map(|x| x.abs()).sum::<f64>()).fold(0.0, f64::max);
    let squarings = if norm > 0.5 { (norm / 0.5).log2().ceil() as i32 } else { 0 };
    let scale = 0.5f64.powi(squarings);
    let mut scaled = a.clone();
    scaled.values_mut().iter_mut().for_each(|x| *x *= scale);
    let mut sum = Dense::zeros(n, n);
    let mut term = Dense::zeros(n, n);
    for i in 0..n {
        sum[(i, i)] = 1.0;
        term[(i, i)] = 1.0;
    }
    // (1/2)^18 / 18! < 1e-21: rounding is reached well before.
    for k in 1..=18 {
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
}
