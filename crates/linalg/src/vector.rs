//! Sums and extremes of vectors.

use pulp::{Arch, Simd, WithSimd};

/// Σ aᵢ bᵢ.
///
/// # Panics
/// Where the lengths differ.
#[must_use]
pub fn dot(a: &[f64], b: &[f64]) -> f64 {
    assert!(a.len() == b.len(), "lengths of a product");
    let mut y = [0.0];
    crate::gemv::add_dots(a, 1.0, [b], [&mut y]);
    y[0]
}

/// Largest magnitude; not a number where one of them is not finite, so that no comparison holds.
#[must_use]
pub fn largest(x: &[f64]) -> f64 {
    if x.len() >= SHORT {
        return Arch::new().dispatch(Largest(x));
    }
    let (mut largest, mut check) = (0.0, 0.0);
    for x in x {
        largest = if x.abs() > largest { x.abs() } else { largest };
        check += x * 0.0;
    }
    largest + check
}

/// Fewer numbers are looked at one by one.
const SHORT: usize = 16;

struct Largest<'a>(&'a [f64]);

impl WithSimd for Largest<'_> {
    type Output = f64;

    #[inline(always)]
    fn with_simd<S: Simd>(self, simd: S) -> f64 {
        let (head, tail) = S::as_simd_f64s(self.0);
        let zero = simd.splat_f64s(0.0);
        let (mut size, mut sound) = (zero, zero);
        for x in head {
            size = simd.max_f64s(size, simd.abs_f64s(*x));
            sound = simd.mul_add_e_f64s(*x, zero, sound);
        }
        let mut largest = simd.reduce_max_f64s(size);
        let mut check = simd.reduce_sum_f64s(sound);
        for x in tail {
            largest = if x.abs() > largest { x.abs() } else { largest };
            check += x * 0.0;
        }
        largest + check
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_largest_magnitude_is_found_at_every_place_and_what_is_not_finite_is_told() {
        for n in 1..20 {
            for at in 0..n {
                let mut x: Vec<f64> = (0..n).map(|i| i as f64 / 100.0).collect();
                x[at] = -7.0;
                assert_eq!(largest(&x), 7.0);
                for broken in [f64::NAN, f64::INFINITY] {
                    x[at] = broken;
                    assert!(largest(&x).is_nan());
                }
            }
        }
        assert_eq!(largest(&[]), 0.0);
    }
}
