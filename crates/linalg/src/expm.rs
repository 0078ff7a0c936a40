//! Matrix exponential, and what constant and rising loads make beside it, by scaling, Taylor series and squaring.

use crate::Dense;

/// (1/2)¹⁸/18! < 1e-21: rounding is reached well before.
const TERMS: i32 = 18;

/// So many terms that change nothing in turn, and no later one will.
const LAST: usize = 2;

/// Halvings that bring a norm to 1/2 at most; none bring one that overflows, whose exponential is no number either.
fn squarings(norm: f64) -> i32 {
    if norm > 0.5 && norm.is_finite() { norm.log2().ceil() as i32 + 1 } else { 0 }
}

/// exp(A) of a small matrix, row by row, without a place on the heap: φ₀ of [`phi_functions`] alone.
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

/// exp(A) and what it makes of loads: φ₀ = exp(A), φ₁, φ₂, φ₃ with
///
/// ```text
/// φₖ(A) = Σ Aⁱ/(i + k)!        x' = A x + b₀ + b₁ t + ½ b₂ t²:  x(1) = φ₀ x₀ + φ₁ b₀ + φ₂ b₁ + φ₃ b₂
/// ```
///
/// Of A/2ˢ with a norm of 1/2 at most the series of φ₃ is summed \[Paterson & Stockmeyer 1973\], and φₖ = 1/k! + A φₖ₊₁. What is
/// doubled s times then is
///
/// ```text
/// φ₀(2A) = φ₀²    φ₁(2A) = (φ₀ φ₁ + φ₁)/2    φ₂(2A) = (φ₀ φ₂ + φ₁ + φ₂)/4    φ₃(2A) = (φ₀ φ₃ + ½ φ₁ + φ₂ + φ₃)/8
/// ```
///
/// \[Skaflestad & Wright 2009\]. The exponential of one matrix with all loads among its unknowns comes to the same, with a
/// matrix of more than twice the size.
///
/// # Panics
/// Where the matrix is not square.
#[must_use]
pub fn phi_functions(a: &Dense) -> [Dense; 4] {
    let n = a.rows();
    assert_eq!(n, a.columns(), "a square matrix");
    let norm = (0..n).map(|j| a.column(j).iter().map(|x| x.abs()).sum::<f64>()).fold(0.0, f64::max);
    let squarings = squarings(norm);
    let scale = 0.5f64.powi(squarings);
    let mut a = a.clone();
    a.values_mut().iter_mut().for_each(|x| *x *= scale);
    let phi3 = series(&a);
    let next = |phi: &Dense, unit: f64| {
        let mut next = a.times(phi);
        (0..n).for_each(|i| next[(i, i)] += unit);
        next
    };
    let phi2 = next(&phi3, 0.5);
    let phi1 = next(&phi2, 1.0);
    let mut all = [next(&phi1, 1.0), phi1, phi2, phi3];
    for _ in 0..squarings {
        let [phi0, mut phi1, mut phi2, mut phi3] = all.each_ref().map(|phi| all[0].times(phi));
        let of = |k: usize| all[k].values().iter();
        for (x, (b, (c, d))) in phi3.values_mut().iter_mut().zip(of(1).zip(of(2).zip(of(3)))) {
            *x = 0.125 * (*x + 0.5 * b + c + d);
        }
        for (x, (b, c)) in phi2.values_mut().iter_mut().zip(of(1).zip(of(2))) {
            *x = 0.25 * (*x + b + c);
        }
        for (x, b) in phi1.values_mut().iter_mut().zip(of(1)) {
            *x = 0.5 * (*x + b);
        }
        all = [phi0, phi1, phi2, phi3];
    }
    all
}

/// φ₃ of a matrix with a norm of 1/2 at most: Σ Aⁱ/(i + 3)!, in fours from behind. (1/2)¹⁶/19! is below 1e-21.
fn series(a: &Dense) -> Dense {
    let n = a.rows();
    let a2 = a.times(a);
    let powers = [a, &a2, &a2.times(a)];
    let a4 = a2.times(&a2);
    let factorial = |k: u32| (1..=k).map(f64::from).product::<f64>();
    let mut sum = Dense::zeros(n, n);
    for first in [12, 8, 4, 0] {
        if first < 12 {
            sum = a4.times(&sum);
        }
        for (power, i) in powers.iter().zip(first + 1..) {
            let factor = factorial(i + 3).recip();
            for (x, y) in sum.values_mut().iter_mut().zip(power.values()) {
                *x += factor * y;
            }
        }
        let unit = factorial(first + 3).recip();
        (0..n).for_each(|i| sum[(i, i)] += unit);
    }
    sum
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_rotation_generator_gives_a_rotation() {
        let angle = 7.3;
        let [e, phi1, ..] =
            phi_functions(&Dense::from_columns(2, 2, vec![0.0, angle, -angle, 0.0]));
        assert!((e[(0, 0)] - f64::cos(angle)).abs() < 1e-13);
        assert!((e[(1, 0)] - f64::sin(angle)).abs() < 1e-13);
        // ∫ of it.
        assert!((phi1[(0, 0)] - f64::sin(angle) / angle).abs() < 1e-13);
        assert!((phi1[(1, 0)] - (1.0 - f64::cos(angle)) / angle).abs() < 1e-13);
    }

    /// Two thousand million squarings of it were made once.
    #[test]
    fn what_overflows_has_an_end() {
        assert!(expm_small([[f64::INFINITY, 0.0], [0.0, 1.0]])[0][0].is_nan());
        let [e, ..] =
            phi_functions(&Dense::from_columns(2, 2, vec![-f64::INFINITY, 0.0, 0.0, 1.0]));
        assert!(!e[(0, 0)].is_finite());
        // The largest that does not: to nothing.
        assert_eq!(expm_small([[-1e308]]), [[0.0]]);
    }

    /// exp of (A 1 0 0; 0 0 1 0; 0 0 0 1; 0 0 0 0) has all of them in its first row.
    #[test]
    fn they_are_the_exponential_of_a_matrix_with_loads_among_its_unknowns() {
        let mut seed = 0x2545_f491_4f6c_dd1d_u64;
        let mut random = || {
            seed ^= seed << 13;
            seed ^= seed >> 7;
            seed ^= seed << 17;
            (seed >> 11) as f64 / (1u64 << 53) as f64 - 0.5
        };
        for size in [1e-3, 0.3, 1.0, 7.0, 40.0] {
            for _ in 0..20 {
                let mut a = [[0.0; 12]; 12];
                for (i, row) in a.iter_mut().enumerate() {
                    if i < 3 {
                        (0..3).for_each(|j| row[j] = size * random());
                    }
                    if i < 9 {
                        row[i + 3] = 1.0;
                    }
                }
                let e = expm_small(a);
                let of = Dense::from_columns(3, 3, (0..9).map(|k| a[k % 3][k / 3]).collect());
                for (k, phi) in phi_functions(&of).iter().enumerate() {
                    let most = phi.values().iter().fold(0.0_f64, |most, x| most.max(x.abs()));
                    for i in 0..3 {
                        for j in 0..3 {
                            let apart = (phi[(i, j)] - e[i][3 * k + j]).abs();
                            assert!(apart < 1e-12 * most, "φ{k}, {size}: {apart} of {most}");
                        }
                    }
                }
            }
        }
    }
}
