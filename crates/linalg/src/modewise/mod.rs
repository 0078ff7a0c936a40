//! Loops over numbers that belong to the modes of a structure, one by one, in vectors as wide as the processor
//! has them.

mod step;

pub use step::{ModalStep, OwnModes, StepSums};

use crate::simd::dispatch;
use pulp::{Simd, WithSimd};

/// `y = a₀ x₀ + a₁ x₁ + a₂ x₂ + a₃ x₃`, element by element.
///
/// # Panics
/// Where the lengths differ.
pub fn combine(a: [&[f64]; 4], x: [&[f64]; 4], y: &mut [f64]) {
    let n = y.len();
    assert!(a.iter().chain(&x).all(|z| z.len() == n), "lengths of a sum");
    dispatch(Combine { a, x, y });
}

/// `y += s · a x`, element by element.
///
/// # Panics
/// Where the lengths differ.
pub fn add_products(s: f64, a: &[f64], x: &[f64], y: &mut [f64]) {
    assert!(a.len() == y.len() && x.len() == y.len(), "lengths of a sum");
    dispatch(AddProducts { s, a, x, y });
}

/// Σ w x².
///
/// # Panics
/// Where the lengths differ.
#[must_use]
pub fn weighted_square(w: &[f64], x: &[f64]) -> f64 {
    assert!(w.len() == x.len(), "lengths of a sum");
    dispatch(WeightedSquare { w, x })
}

/// Σ p₁ (q₁ − r ∫q) − p₀ (q₀ − r ∫q): the work of loads that change linearly in a step from p₀ to p₁, with r
/// one over its length.
///
/// # Panics
/// Where the lengths differ.
#[must_use]
pub fn work_of_linear(p: [&[f64]; 2], q: [&[f64]; 2], integral: &[f64], r: f64) -> f64 {
    let n = integral.len();
    assert!(p.iter().chain(&q).all(|z| z.len() == n), "lengths of a sum");
    dispatch(Work { p, q, integral, r })
}

struct Combine<'a> {
    a: [&'a [f64]; 4],
    x: [&'a [f64]; 4],
    y: &'a mut [f64],
}

impl WithSimd for Combine<'_> {
    type Output = ();

    #[inline(always)]
    fn with_simd<S: Simd>(self, simd: S) {
        let n = self.y.len();
        let ([a, b, c, d], [q, v, s, t]) = (self.a, self.x);
        let ((a, ae), (b, be)) = (S::as_simd_f64s(&a[..n]), S::as_simd_f64s(&b[..n]));
        let ((c, ce), (d, de)) = (S::as_simd_f64s(&c[..n]), S::as_simd_f64s(&d[..n]));
        let ((q, qe), (v, ve)) = (S::as_simd_f64s(&q[..n]), S::as_simd_f64s(&v[..n]));
        let ((s, se), (t, te)) = (S::as_simd_f64s(&s[..n]), S::as_simd_f64s(&t[..n]));
        let (y, ye) = S::as_mut_simd_f64s(self.y);
        let m = y.len();
        let (a, b, c, d) = (&a[..m], &b[..m], &c[..m], &d[..m]);
        let (q, v, s, t) = (&q[..m], &v[..m], &s[..m], &t[..m]);
        for i in 0..m {
            let sum = simd.mul_f64s(a[i], q[i]);
            let sum = simd.mul_add_e_f64s(b[i], v[i], sum);
            let sum = simd.mul_add_e_f64s(c[i], s[i], sum);
            y[i] = simd.mul_add_e_f64s(d[i], t[i], sum);
        }
        for i in 0..ye.len() {
            ye[i] = ae[i] * qe[i] + be[i] * ve[i] + ce[i] * se[i] + de[i] * te[i];
        }
    }
}

struct AddProducts<'a> {
    s: f64,
    a: &'a [f64],
    x: &'a [f64],
    y: &'a mut [f64],
}

impl WithSimd for AddProducts<'_> {
    type Output = ();

    #[inline(always)]
    fn with_simd<S: Simd>(self, simd: S) {
        let n = self.y.len();
        let (a, ae) = S::as_simd_f64s(&self.a[..n]);
        let (x, xe) = S::as_simd_f64s(&self.x[..n]);
        let (y, ye) = S::as_mut_simd_f64s(self.y);
        let s = simd.splat_f64s(self.s);
        for (y, (a, x)) in y.iter_mut().zip(a.iter().zip(x)) {
            *y = simd.mul_add_e_f64s(simd.mul_f64s(s, *a), *x, *y);
        }
        for (y, (a, x)) in ye.iter_mut().zip(ae.iter().zip(xe)) {
            *y += self.s * a * x;
        }
    }
}

struct WeightedSquare<'a> {
    w: &'a [f64],
    x: &'a [f64],
}

impl WithSimd for WeightedSquare<'_> {
    type Output = f64;

    #[inline(always)]
    fn with_simd<S: Simd>(self, simd: S) -> f64 {
        let (w, we) = S::as_simd_f64s(self.w);
        let (x, xe) = S::as_simd_f64s(self.x);
        let mut sum = simd.splat_f64s(0.0);
        for (w, x) in w.iter().zip(x) {
            sum = simd.mul_add_e_f64s(simd.mul_f64s(*w, *x), *x, sum);
        }
        let mut total = simd.reduce_sum_f64s(sum);
        for (w, x) in we.iter().zip(xe) {
            total += w * x * x;
        }
        total
    }
}

struct Work<'a> {
    p: [&'a [f64]; 2],
    q: [&'a [f64]; 2],
    integral: &'a [f64],
    r: f64,
}

impl WithSimd for Work<'_> {
    type Output = f64;

    #[inline(always)]
    fn with_simd<S: Simd>(self, simd: S) -> f64 {
        let Self { p: [p0, p1], q: [q0, q1], integral, r } = self;
        let ((p0, p0e), (p1, p1e)) = (S::as_simd_f64s(p0), S::as_simd_f64s(p1));
        let ((q0, q0e), (q1, q1e)) = (S::as_simd_f64s(q0), S::as_simd_f64s(q1));
        let (z, ze) = S::as_simd_f64s(integral);
        let scale = simd.splat_f64s(r);
        let (mut begin, mut end) = (simd.splat_f64s(0.0), simd.splat_f64s(0.0));
        for ((p0, q0), ((p1, q1), z)) in p0.iter().zip(q0).zip(p1.iter().zip(q1).zip(z)) {
            let mean = simd.mul_f64s(*z, scale);
            begin = simd.mul_add_e_f64s(*p0, simd.sub_f64s(*q0, mean), begin);
            end = simd.mul_add_e_f64s(*p1, simd.sub_f64s(*q1, mean), end);
        }
        let mut work = simd.reduce_sum_f64s(simd.sub_f64s(end, begin));
        for ((p0, q0), ((p1, q1), z)) in p0e.iter().zip(q0e).zip(p1e.iter().zip(q1e).zip(ze)) {
            let mean = z * r;
            work += p1 * (q1 - mean) - p0 * (q0 - mean);
        }
        work
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    pub(super) fn numbers(n: usize, seed: usize) -> Vec<f64> {
        (0..n).map(|i| (((i + seed) * 7919 + 13) % 101) as f64 / 50.0 - 1.0).collect()
    }

    /// Against the sums written out, for lengths on both sides of every vector width.
    #[test]
    fn all_equal_the_sums_written_out() {
        for n in [0, 1, 3, 4, 5, 8, 24, 31] {
            let x: Vec<Vec<f64>> = (0..8).map(|k| numbers(n, 17 * k)).collect();
            let (mut y, mut z) = (vec![9.0; n], numbers(n, 5));
            combine([&x[0], &x[1], &x[2], &x[3]], [&x[4], &x[5], &x[6], &x[7]], &mut y);
            let before = z.clone();
            add_products(-2.0, &x[0], &x[1], &mut z);
            for i in 0..n {
                let sum: f64 = (0..4).map(|k| x[k][i] * x[k + 4][i]).sum();
                assert!((y[i] - sum).abs() < 1e-14);
                assert!((z[i] - (before[i] - 2.0 * x[0][i] * x[1][i])).abs() < 1e-14);
            }
            let square: f64 = (0..n).map(|i| x[0][i] * x[1][i] * x[1][i]).sum();
            assert!((weighted_square(&x[0], &x[1]) - square).abs() < 1e-13);
            let r = 0.7;
            let one = |i: usize| {
                let mean = r * x[4][i];
                x[1][i] * (x[3][i] - mean) - x[0][i] * (x[2][i] - mean)
            };
            let work = work_of_linear([&x[0], &x[1]], [&x[2], &x[3]], &x[4], r);
            assert!((work - (0..n).map(one).sum::<f64>()).abs() < 1e-13, "{n}");
        }
    }
}
