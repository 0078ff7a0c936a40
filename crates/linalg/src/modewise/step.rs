//! A step of modes that each move on their own, in two passes over the modes.
//!
//! ```text
//! (∫q, q, q̇)₁ = C (q₀, q̇₀, s₀, s₁)        s = p − r: loads less what the links hold
//! ```

use crate::simd::dispatch;
use pulp::{Simd, WithSimd};

/// The modes: what they are made of, and the coefficients of a step.
#[derive(Clone, Copy, Debug)]
pub struct OwnModes<'a> {
    /// Rows ∫q, q, q̇; columns q₀, q̇₀, s₀, s₁.
    pub c: &'a [[Vec<f64>; 4]; 3],
    /// ω².
    pub omega2: &'a [f64],
    /// Damping, 1/s.
    pub rates: &'a [f64],
    /// 1, and 0 of static shapes, which have no mass.
    pub mass: &'a [f64],
}

/// A step: where it starts, its loads and length.
#[derive(Clone, Copy, Debug)]
pub struct ModalStep<'a> {
    /// q₀.
    pub q: &'a [f64],
    /// q̇₀.
    pub v: &'a [f64],
    /// Loads at the start and at the end.
    pub p: [&'a [f64]; 2],
    /// One over its length, 1/s.
    pub per_dt: f64,
}

/// What a step did: sums over the modes.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct StepSums {
    /// Work of the loads, ∫ p q̇ dt for p linear in the step.
    pub external: f64,
    /// Work of loads less link forces.
    pub all: f64,
    /// ½ q̇² at the start and at the end.
    pub kinetic: [f64; 2],
    /// ½ ω² q² at the start and at the end.
    pub strain: [f64; 2],
}

/// Slices as vectors and what is left, all of one length.
macro_rules! vectors {
    ($s:ty, $n:expr; $(($x:ident, $rest:ident) = $of:expr),* $(,)?) => {
        $(let ($x, $rest) = <$s>::as_simd_f64s(&$of[..$n]);)*
    };
}

/// Vectors of one length: no index is checked.
macro_rules! cut {
    ($m:expr; $($x:ident),*) => {
        $(let $x = &$x[..$m];)*
    };
}

impl OwnModes<'_> {
    /// The step with link forces `links` at both ends: s₀, s₁, q and q̇ at the end.
    ///
    /// # Panics
    /// Where a length is not that of the coefficients.
    pub fn predict(
        &self,
        from: ModalStep<'_>,
        links: &[f64],
        s: [&mut [f64]; 2],
        to: [&mut [f64]; 2],
    ) {
        dispatch(Predict { modes: *self, from, links, s, to });
    }

    /// The step predicted last with link forces `links` at its end instead: changes s₁, q and q̇, and gives
    /// accelerations and sums.
    ///
    /// # Panics
    /// Where a length is not that of the coefficients.
    pub fn complete(
        &self,
        from: ModalStep<'_>,
        links: &[f64],
        s: (&[f64], &mut [f64]),
        to: [&mut [f64]; 3],
    ) -> StepSums {
        dispatch(Complete { modes: *self, from, links, s, to })
    }
}

struct Predict<'a> {
    modes: OwnModes<'a>,
    from: ModalStep<'a>,
    links: &'a [f64],
    s: [&'a mut [f64]; 2],
    to: [&'a mut [f64]; 2],
}

impl WithSimd for Predict<'_> {
    type Output = ();

    #[inline(always)]
    fn with_simd<S: Simd>(self, simd: S) {
        let Self { modes: OwnModes { c: [_, cq, cv], .. }, from, links, s: [s0, s1], to: [q, v] } =
            self;
        let n = cq[0].len();
        vectors!(S, n;
            (a0, a0e) = cq[0], (a1, a1e) = cq[1], (a2, a2e) = cq[2], (a3, a3e) = cq[3],
            (b0, b0e) = cv[0], (b1, b1e) = cv[1], (b2, b2e) = cv[2], (b3, b3e) = cv[3],
            (q0, q0e) = from.q, (v0, v0e) = from.v, (p0, p0e) = from.p[0], (p1, p1e) = from.p[1],
            (r, re) = links,
        );
        let (s0, s0e) = S::as_mut_simd_f64s(&mut s0[..n]);
        let (s1, s1e) = S::as_mut_simd_f64s(&mut s1[..n]);
        let (q, qe) = S::as_mut_simd_f64s(&mut q[..n]);
        let (v, ve) = S::as_mut_simd_f64s(&mut v[..n]);
        let m = r.len();
        cut!(m; a0, a1, a2, a3, b0, b1, b2, b3, q0, v0, p0, p1);
        let (s0, s1, q, v) = (&mut s0[..m], &mut s1[..m], &mut q[..m], &mut v[..m]);
        for i in 0..m {
            let (x, y) = (q0[i], v0[i]);
            let (s, t) = (simd.sub_f64s(p0[i], r[i]), simd.sub_f64s(p1[i], r[i]));
            (s0[i], s1[i]) = (s, t);
            let sum = simd.mul_add_e_f64s(a1[i], y, simd.mul_f64s(a0[i], x));
            q[i] = simd.mul_add_e_f64s(a3[i], t, simd.mul_add_e_f64s(a2[i], s, sum));
            let sum = simd.mul_add_e_f64s(b1[i], y, simd.mul_f64s(b0[i], x));
            v[i] = simd.mul_add_e_f64s(b3[i], t, simd.mul_add_e_f64s(b2[i], s, sum));
        }
        for i in 0..re.len() {
            let (x, y, s, t) = (q0e[i], v0e[i], p0e[i] - re[i], p1e[i] - re[i]);
            (s0e[i], s1e[i]) = (s, t);
            qe[i] = a0e[i] * x + a1e[i] * y + a2e[i] * s + a3e[i] * t;
            ve[i] = b0e[i] * x + b1e[i] * y + b2e[i] * s + b3e[i] * t;
        }
    }
}

struct Complete<'a> {
    modes: OwnModes<'a>,
    from: ModalStep<'a>,
    links: &'a [f64],
    s: (&'a [f64], &'a mut [f64]),
    to: [&'a mut [f64]; 3],
}

impl WithSimd for Complete<'_> {
    type Output = StepSums;

    #[inline(always)]
    fn with_simd<S: Simd>(self, simd: S) -> StepSums {
        let Self { modes, from, links, s: (s0, s1), to: [q, v, a] } = self;
        let OwnModes { c: [ci, cq, cv], omega2, rates, mass } = modes;
        let n = ci[0].len();
        vectors!(S, n;
            (c0, c0e) = ci[0], (c1, c1e) = ci[1], (c2, c2e) = ci[2], (c3, c3e) = ci[3],
            (a3, a3e) = cq[3], (b3, b3e) = cv[3],
            (w, we) = omega2, (d, de) = rates, (mass, masse) = mass,
            (q0, q0e) = from.q, (v0, v0e) = from.v, (p0, p0e) = from.p[0], (p1, p1e) = from.p[1],
            (r, re) = links, (s0, s0e) = s0,
        );
        let (s1, s1e) = S::as_mut_simd_f64s(&mut s1[..n]);
        let (q, qe) = S::as_mut_simd_f64s(&mut q[..n]);
        let (v, ve) = S::as_mut_simd_f64s(&mut v[..n]);
        let (a, ae) = S::as_mut_simd_f64s(&mut a[..n]);
        let m = r.len();
        cut!(m; c0, c1, c2, c3, a3, b3, w, d, mass, q0, v0, p0, p1, s0);
        let (s1, q, v, a) = (&mut s1[..m], &mut q[..m], &mut v[..m], &mut a[..m]);
        let (zero, scale) = (simd.splat_f64s(0.0), simd.splat_f64s(from.per_dt));
        let (mut external, mut all) = (zero, zero);
        let (mut kinetic0, mut kinetic1, mut strain0, mut strain1) = (zero, zero, zero, zero);
        for i in 0..m {
            let s = simd.sub_f64s(p1[i], r[i]);
            let change = simd.sub_f64s(s, s1[i]);
            let x = simd.mul_add_e_f64s(a3[i], change, q[i]);
            let y = simd.mul_add_e_f64s(b3[i], change, v[i]);
            (s1[i], q[i], v[i]) = (s, x, y);
            let held = simd.mul_add_e_f64s(d[i], y, simd.mul_f64s(w[i], x));
            a[i] = simd.mul_f64s(mass[i], simd.sub_f64s(s, held));
            // ∫ p q̇ dt = p₁ (q₁ − mean) − p₀ (q₀ − mean) with the mean of q.
            let sum = simd.mul_add_e_f64s(c1[i], v0[i], simd.mul_f64s(c0[i], q0[i]));
            let sum = simd.mul_add_e_f64s(c3[i], s, simd.mul_add_e_f64s(c2[i], s0[i], sum));
            let mean = simd.mul_f64s(sum, scale);
            let (end, begin) = (simd.sub_f64s(x, mean), simd.sub_f64s(mean, q0[i]));
            external = simd.mul_add_e_f64s(p0[i], begin, simd.mul_add_e_f64s(p1[i], end, external));
            all = simd.mul_add_e_f64s(s0[i], begin, simd.mul_add_e_f64s(s, end, all));
            kinetic0 = simd.mul_add_e_f64s(simd.mul_f64s(mass[i], v0[i]), v0[i], kinetic0);
            kinetic1 = simd.mul_add_e_f64s(simd.mul_f64s(mass[i], y), y, kinetic1);
            strain0 = simd.mul_add_e_f64s(simd.mul_f64s(w[i], q0[i]), q0[i], strain0);
            strain1 = simd.mul_add_e_f64s(simd.mul_f64s(w[i], x), x, strain1);
        }
        let mut sums = StepSums {
            external: simd.reduce_sum_f64s(external),
            all: simd.reduce_sum_f64s(all),
            kinetic: [simd.reduce_sum_f64s(kinetic0), simd.reduce_sum_f64s(kinetic1)],
            strain: [simd.reduce_sum_f64s(strain0), simd.reduce_sum_f64s(strain1)],
        };
        for i in 0..re.len() {
            let s = p1e[i] - re[i];
            let change = s - s1e[i];
            let (x, y) = (qe[i] + a3e[i] * change, ve[i] + b3e[i] * change);
            (s1e[i], qe[i], ve[i]) = (s, x, y);
            ae[i] = masse[i] * (s - (de[i] * y + we[i] * x));
            let sum = c0e[i] * q0e[i] + c1e[i] * v0e[i] + c2e[i] * s0e[i] + c3e[i] * s;
            let mean = sum * from.per_dt;
            let (end, begin) = (x - mean, mean - q0e[i]);
            sums.external += p0e[i] * begin + p1e[i] * end;
            sums.all += s0e[i] * begin + s * end;
            sums.kinetic[0] += masse[i] * v0e[i] * v0e[i];
            sums.kinetic[1] += masse[i] * y * y;
            sums.strain[0] += we[i] * q0e[i] * q0e[i];
            sums.strain[1] += we[i] * x * x;
        }
        let half = |[start, end]: [f64; 2]| [0.5 * start, 0.5 * end];
        StepSums { kinetic: half(sums.kinetic), strain: half(sums.strain), ..sums }
    }
}

#[cfg(test)]
mod tests {
    use super::super::tests::numbers;
    use super::*;

    /// Against the same written out, for numbers of modes on both sides of every vector width.
    #[test]
    fn a_step_equals_its_formulas_written_out() {
        for n in [0, 1, 3, 4, 5, 8, 24, 31] {
            let c: [[Vec<f64>; 4]; 3] =
                std::array::from_fn(|r| std::array::from_fn(|k| numbers(n, 20 * r + 3 * k)));
            let x: Vec<Vec<f64>> = (0..9).map(|k| numbers(n, 17 * k + 1)).collect();
            let mass: Vec<f64> = (0..n).map(|i| f64::from(u8::from(i % 5 != 3))).collect();
            let modes = OwnModes { c: &c, omega2: &x[0], rates: &x[1], mass: &mass };
            let per_dt = 0.7;
            let from = ModalStep { q: &x[2], v: &x[3], p: [&x[4], &x[5]], per_dt };
            let [mut s0, mut s1, mut q, mut v, mut a]: [Vec<f64>; 5] =
                std::array::from_fn(|_| vec![9.0; n]);
            modes.predict(from, &x[6], [&mut s0, &mut s1], [&mut q, &mut v]);
            let with = |row: usize, i: usize, s: f64, t: f64| {
                c[row][0][i] * x[2][i]
                    + c[row][1][i] * x[3][i]
                    + c[row][2][i] * s
                    + c[row][3][i] * t
            };
            let close = |a: f64, b: f64| assert!((a - b).abs() < 1e-13, "{n}: {a} {b}");
            for i in 0..n {
                let (s, t) = (x[4][i] - x[6][i], x[5][i] - x[6][i]);
                close(q[i], with(1, i, s, t));
                close(v[i], with(2, i, s, t));
            }
            let sums = modes.complete(from, &x[7], (&s0, &mut s1), [&mut q, &mut v, &mut a]);
            let mut expected = StepSums::default();
            for i in 0..n {
                let (s, t) = (x[4][i] - x[6][i], x[5][i] - x[7][i]);
                close(s1[i], t);
                close(q[i], with(1, i, s, t));
                close(v[i], with(2, i, s, t));
                close(a[i], mass[i] * (t - x[1][i] * v[i] - x[0][i] * q[i]));
                let mean = per_dt * with(0, i, s, t);
                expected.external += x[5][i] * (q[i] - mean) - x[4][i] * (x[2][i] - mean);
                expected.all += t * (q[i] - mean) - s * (x[2][i] - mean);
                for (k, (q, v)) in [(x[2][i], x[3][i]), (q[i], v[i])].into_iter().enumerate() {
                    expected.kinetic[k] += 0.5 * mass[i] * v * v;
                    expected.strain[k] += 0.5 * x[0][i] * q * q;
                }
            }
            close(sums.external, expected.external);
            close(sums.all, expected.all);
            for k in 0..2 {
                close(sums.kinetic[k], expected.kinetic[k]);
                close(sums.strain[k], expected.strain[k]);
            }
        }
    }
}
