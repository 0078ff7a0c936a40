//! Sums and extremes of vectors.

use crate::simd::dispatch;
use pulp::{Simd, WithSimd};

/// Σ aᵢ bᵢ.
///
/// # Panics
/// Where the lengths differ.
#[must_use]
pub fn dot(a: &[f64], b: &[f64]) -> f64 {
    assert!(a.len() == b.len(), "lengths of a product");
    dispatch(Dot { a, b })
}

/// Largest magnitude; not a number where one of them is not finite, so that no comparison holds.
#[must_use]
pub fn largest(x: &[f64]) -> f64 {
    if x.len() >= SHORT {
        return dispatch(Largest(x));
    }
    let (four, rest) = x.as_chunks::<4>();
    let (mut largest, mut check) = ([0.0; 4], [0.0; 4]);
    let mut take = |i: usize, x: f64| {
        largest[i] = if x.abs() > largest[i] { x.abs() } else { largest[i] };
        check[i] += x * 0.0;
    };
    for x in four {
        x.iter().enumerate().for_each(|(i, x)| take(i, *x));
    }
    rest.iter().enumerate().for_each(|(i, x)| take(i, *x));
    let of = |a: f64, b: f64| if a > b { a } else { b };
    let [a, b, c, d] = largest;
    of(of(a, b), of(c, d)) + check.iter().sum::<f64>()
}

/// `r = f − k d − x`, element by element.
///
/// # Panics
/// Where the lengths differ.
#[inline]
pub fn residual(f: &[f64], k: &[f64], d: &[f64], x: &[f64], r: &mut [f64]) {
    let n = r.len();
    assert!(f.len() == n && k.len() == n && d.len() == n && x.len() == n, "lengths of a residual");
    for i in 0..n {
        r[i] = f[i] - k[i] * d[i] - x[i];
    }
}

/// The [`residual`] and as `sizes` the [`largest`] magnitudes of r, f and x; those of f and x may be
/// anything where r holds what is not finite.
///
/// # Panics
/// Where the lengths differ.
#[inline(always)]
pub fn sized_residual(
    f: &[f64],
    k: &[f64],
    d: &[f64],
    x: &[f64],
    r: &mut [f64],
    sizes: &mut [f64; 3],
) {
    let n = r.len();
    assert!(f.len() == n && k.len() == n && d.len() == n && x.len() == n, "lengths of a residual");
    dispatch(Residual { f, k, d, x, r, sizes });
}

/// `x += change`, element by element.
///
/// # Panics
/// Where the lengths differ.
pub fn add(x: &mut [f64], change: &[f64]) {
    assert!(x.len() == change.len(), "lengths of a sum");
    let (four, rest) = x.as_chunks_mut::<4>();
    let (by_four, by_rest) = change.as_chunks::<4>();
    for (x, change) in four.iter_mut().zip(by_four) {
        for i in 0..4 {
            x[i] += change[i];
        }
    }
    rest.iter_mut().zip(by_rest).for_each(|(x, change)| *x += change);
}

/// True where the numbers of both are the same to the bit; mostly they are, so all are looked at side by side.
#[must_use]
#[inline]
pub fn equal(a: &[f64], b: &[f64]) -> bool {
    if a.len() != b.len() {
        return false;
    }
    let mut differ = 0;
    for (a, b) in a.iter().zip(b) {
        differ |= a.to_bits() ^ b.to_bits();
    }
    differ == 0
}

/// Fewer numbers are looked at without vectors.
const SHORT: usize = 16;

struct Dot<'a> {
    a: &'a [f64],
    b: &'a [f64],
}

impl WithSimd for Dot<'_> {
    type Output = f64;

    #[inline(always)]
    fn with_simd<S: Simd>(self, simd: S) -> f64 {
        let ((a, ae), (b, be)) = (S::as_simd_f64s(self.a), S::as_simd_f64s(self.b));
        let mut sums = [simd.splat_f64s(0.0); 4];
        let ((fours, a), (by_fours, b)) = (a.as_chunks::<4>(), b.as_chunks::<4>());
        for (a, b) in fours.iter().zip(by_fours) {
            for k in 0..4 {
                sums[k] = simd.mul_add_e_f64s(a[k], b[k], sums[k]);
            }
        }
        for (sum, (a, b)) in sums.iter_mut().zip(a.iter().zip(b)) {
            *sum = simd.mul_add_e_f64s(*a, *b, *sum);
        }
        let [x, y, z, w] = sums;
        let mut sum = simd.reduce_sum_f64s(simd.add_f64s(simd.add_f64s(x, y), simd.add_f64s(z, w)));
        for (a, b) in ae.iter().zip(be) {
            sum += a * b;
        }
        sum
    }
}

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

struct Residual<'a> {
    f: &'a [f64],
    k: &'a [f64],
    d: &'a [f64],
    x: &'a [f64],
    r: &'a mut [f64],
    sizes: &'a mut [f64; 3],
}

impl WithSimd for Residual<'_> {
    type Output = ();

    #[inline(always)]
    fn with_simd<S: Simd>(self, simd: S) {
        let n = self.r.len();
        let ((f, fe), (k, ke)) = (S::as_simd_f64s(&self.f[..n]), S::as_simd_f64s(&self.k[..n]));
        let ((d, de), (x, xe)) = (S::as_simd_f64s(&self.d[..n]), S::as_simd_f64s(&self.x[..n]));
        let (r, re) = S::as_mut_simd_f64s(self.r);
        let m = r.len();
        let (f, k, d, x) = (&f[..m], &k[..m], &d[..m], &x[..m]);
        let zero = simd.splat_f64s(0.0);
        let (mut of_r, mut of_f, mut of_x, mut sound) = (zero, zero, zero, zero);
        for i in 0..m {
            r[i] = simd.sub_f64s(simd.sub_f64s(f[i], simd.mul_f64s(k[i], d[i])), x[i]);
            of_r = simd.max_f64s(of_r, simd.abs_f64s(r[i]));
            of_f = simd.max_f64s(of_f, simd.abs_f64s(f[i]));
            of_x = simd.max_f64s(of_x, simd.abs_f64s(x[i]));
            sound = simd.mul_add_e_f64s(r[i], zero, sound);
        }
        if !re.is_empty() {
            let (f, x) = (simd.partial_load_f64s(fe), simd.partial_load_f64s(xe));
            let held = simd.mul_f64s(simd.partial_load_f64s(ke), simd.partial_load_f64s(de));
            let r = simd.sub_f64s(simd.sub_f64s(f, held), x);
            simd.partial_store_f64s(re, r);
            of_r = simd.max_f64s(of_r, simd.abs_f64s(r));
            of_f = simd.max_f64s(of_f, simd.abs_f64s(f));
            of_x = simd.max_f64s(of_x, simd.abs_f64s(x));
            sound = simd.mul_add_e_f64s(r, zero, sound);
        }
        let check = simd.reduce_sum_f64s(sound);
        let (of_r, of_f) = (simd.reduce_max_f64s(of_r), simd.reduce_max_f64s(of_f));
        *self.sizes = [of_r + check, of_f, simd.reduce_max_f64s(of_x)];
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_residual_is_told_with_its_sizes_at_every_length() {
        for n in 0..20 {
            let number = |i: usize| ((i * 7919 + 13) % 101) as f64 / 50.0 - 1.0;
            let x: Vec<Vec<f64>> =
                (0..4).map(|k| (0..n).map(|i| number(i + 31 * k)).collect()).collect();
            let mut r = vec![9.0; n];
            let mut sizes = [f64::NAN; 3];
            sized_residual(&x[0], &x[1], &x[2], &x[3], &mut r, &mut sizes);
            let mut plain = vec![9.0; n];
            residual(&x[0], &x[1], &x[2], &x[3], &mut plain);
            assert_eq!(r, plain);
            for i in 0..n {
                assert_eq!(r[i], x[0][i] - x[1][i] * x[2][i] - x[3][i]);
            }
            assert_eq!(sizes, [largest(&r), largest(&x[0]), largest(&x[3])]);
            for at in 0..n {
                let (mut f, mut y) = (x[0].clone(), x[3].clone());
                (f[at], y[at]) = (-7.0, 8.0);
                sized_residual(&f, &x[1], &x[2], &y, &mut r, &mut sizes);
                assert_eq!(sizes, [largest(&r), 7.0, 8.0], "{n} {at}");
            }
            if n > 0 {
                let mut broken = x[0].clone();
                broken[n / 2] = f64::NAN;
                sized_residual(&broken, &x[1], &x[2], &x[3], &mut r, &mut sizes);
                assert!(sizes[0].is_nan());
            }
        }
    }

    #[test]
    fn what_differs_anywhere_is_not_equal() {
        for n in 0..20 {
            let x: Vec<f64> = (0..n).map(|i| i as f64 - 7.0).collect();
            assert!(equal(&x, &x) && !equal(&x, &[&x[..], &[0.0]].concat()));
            for at in 0..n {
                let mut y = x.clone();
                y[at] = 99.0;
                assert!(!equal(&x, &y));
            }
        }
    }

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
