//! A step of modes that each move on their own, in two passes over the modes.
//!
//! ```text
//! (∫q, q, q̇)₁ = C (q₀, q̇₀, s₀, s₁)        s = p − r: loads less what the links hold
//! ```

use crate::aligned::{Aligned, LINE};
use crate::simd::dispatch;
use pulp::{Simd, WithSimd};

/// Rows of coefficients: of q, q̇ and ∫q four each, ω², damping, mass.
const ROWS: usize = 15;
const Q: usize = 0;
const V: usize = 4;
const INTEGRAL: usize = 8;
const OMEGA2: usize = 12;
const RATE: usize = 13;
const MASS: usize = 14;

/// Coefficients of as many modes as the widest vector holds, row by row.
type Group = [f64; ROWS * LINE];

/// Modes that move on their own: what they are made of, and the coefficients of a step. All that a group of modes needs
/// lies together.
#[derive(Clone, Debug)]
pub struct OwnModes {
    count: usize,
    groups: Aligned,
}

/// A step: where it starts, its loads and length.
#[derive(Clone, Copy, Debug)]
pub struct ModalStep<'a> {
    /// q₀ and q̇₀, one after the other; more may follow.
    pub from: &'a [f64],
    /// Loads at the start and at the end.
    pub p: &'a [&'a [f64]; 2],
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

impl OwnModes {
    /// `c`: rows ∫q, q, q̇, columns q₀, q̇₀, s₀, s₁, of every mode; ω²; damping, 1/s; mass, 1 or 0 of static shapes.
    ///
    /// # Panics
    /// Where the lengths differ.
    #[must_use]
    pub fn new(c: &[[Vec<f64>; 4]; 3], omega2: &[f64], rates: &[f64], mass: &[f64]) -> Self {
        let count = omega2.len();
        let mut groups = Aligned::zeros(count.div_ceil(LINE) * ROWS * LINE);
        let [integral, q, v] = c;
        let rows = q.iter().chain(v).chain(integral).map(Vec::as_slice);
        for (row, values) in rows.chain([omega2, rates, mass]).enumerate() {
            assert!(values.len() == count, "lengths of coefficients");
            for (i, value) in values.iter().enumerate() {
                groups[(i / LINE * ROWS + row) * LINE + i % LINE] = *value;
            }
        }
        Self { count, groups }
    }

    /// The step with link forces at both ends. Of `sources` the third part holds these forces, the first two become s₀
    /// and s₁; q and q̇ at the end go where `to` begins.
    ///
    /// # Panics
    /// Where a length does not suit the number of modes.
    pub fn predict(&self, step: &ModalStep<'_>, sources: &mut [f64], to: &mut [f64]) {
        dispatch(Predict { modes: self, step, sources, to });
    }

    /// The step predicted last with the link forces in the third part of `sources` at its end instead: changes s₁, q and
    /// q̇, and gives accelerations, behind them, and sums.
    ///
    /// # Panics
    /// Where a length does not suit the number of modes.
    pub fn complete(
        &self,
        step: &ModalStep<'_>,
        sources: &mut [f64],
        to: &mut [f64],
        sums: &mut StepSums,
    ) {
        dispatch(Complete { modes: self, step, sources, to, sums });
    }
}

struct Predict<'a> {
    modes: &'a OwnModes,
    step: &'a ModalStep<'a>,
    sources: &'a mut [f64],
    to: &'a mut [f64],
}

struct Complete<'a> {
    modes: &'a OwnModes,
    step: &'a ModalStep<'a>,
    sources: &'a mut [f64],
    to: &'a mut [f64],
    sums: &'a mut StepSums,
}

/// Numbers of a group of modes.
type Line = [f64; LINE];

/// Those that are left over where the modes fill no group.
#[inline(always)]
fn rest_of<const N: usize>(rows: [&[f64]; N]) -> [Line; N] {
    let mut lines = [[0.0; LINE]; N];
    for (line, row) in lines.iter_mut().zip(rows) {
        line[..row.len()].copy_from_slice(row);
    }
    lines
}

/// A vector out of a row of a line or a group.
#[inline(always)]
fn of<S: Simd>(row: &[f64], at: usize) -> S::f64s {
    S::as_simd_f64s(&row[at..at + S::F64_LANES]).0[0]
}

#[inline(always)]
fn put<S: Simd>(row: &mut Line, at: usize, x: S::f64s) {
    S::as_mut_simd_f64s(&mut row[at..at + S::F64_LANES]).0[0] = x;
}

impl WithSimd for Predict<'_> {
    type Output = ();

    #[inline(always)]
    fn with_simd<S: Simd>(self, simd: S) {
        let Self { modes, step, sources, to } = self;
        let ModalStep { from, p: &[p0, p1], .. } = *step;
        let n = modes.count;
        let (groups, _) = modes.groups.as_chunks::<{ ROWS * LINE }>();
        let (q0, v0) = from[..2 * n].split_at(n);
        let (s, r) = sources[..3 * n].split_at_mut(2 * n);
        let (s0, s1) = s.split_at_mut(n);
        let (q, v) = to[..2 * n].split_at_mut(n);
        let ((q0, q0e), (v0, v0e)) = (q0.as_chunks(), v0.as_chunks());
        let ((p0, p0e), (p1, p1e)) = (p0[..n].as_chunks(), p1[..n].as_chunks());
        let (r, re) = r.as_chunks();
        let ((s0, s0e), (s1, s1e)) = (s0.as_chunks_mut(), s1.as_chunks_mut());
        let ((q, qe), (v, ve)) = (q.as_chunks_mut(), v.as_chunks_mut());
        let m = q0.len();
        let (whole, left) = groups.split_at(m);
        let (v0, p0, p1, r) = (&v0[..m], &p0[..m], &p1[..m], &r[..m]);
        let (s0, s1, q, v) = (&mut s0[..m], &mut s1[..m], &mut q[..m], &mut v[..m]);
        for (i, group) in whole.iter().enumerate() {
            let given = [&q0[i], &v0[i], &p0[i], &p1[i], &r[i]];
            predict(simd, group, given, [&mut s0[i], &mut s1[i], &mut q[i], &mut v[i]]);
        }
        if let [group] = left {
            let [q0, v0, p0, p1, r] = &rest_of([q0e, v0e, p0e, p1e, re]);
            let [mut s0, mut s1, mut q, mut v] = [[0.0; LINE]; 4];
            let wanted = [&mut s0, &mut s1, &mut q, &mut v];
            predict(simd, group, [q0, v0, p0, p1, r], wanted);
            for (to, line) in [s0e, s1e, qe, ve].into_iter().zip([s0, s1, q, v]) {
                to.copy_from_slice(&line[..to.len()]);
            }
        }
    }
}

/// A group of modes.
#[inline(always)]
fn predict<S: Simd>(
    simd: S,
    c: &Group,
    [q0, v0, p0, p1, r]: [&Line; 5],
    [s0, s1, q, v]: [&mut Line; 4],
) {
    let mut at = 0;
    while at < LINE {
        let (x, y, held) = (of::<S>(q0, at), of::<S>(v0, at), of::<S>(r, at));
        let (s, t) = (simd.sub_f64s(of::<S>(p0, at), held), simd.sub_f64s(of::<S>(p1, at), held));
        put::<S>(s0, at, s);
        put::<S>(s1, at, t);
        for (row, to) in [(Q, &mut *q), (V, &mut *v)] {
            let sum = simd.mul_f64s(of::<S>(c, row * LINE + at), x);
            let sum = simd.mul_add_e_f64s(of::<S>(c, (row + 1) * LINE + at), y, sum);
            let sum = simd.mul_add_e_f64s(of::<S>(c, (row + 2) * LINE + at), s, sum);
            put::<S>(to, at, simd.mul_add_e_f64s(of::<S>(c, (row + 3) * LINE + at), t, sum));
        }
        at += S::F64_LANES;
    }
}

impl WithSimd for Complete<'_> {
    type Output = ();

    #[inline(always)]
    fn with_simd<S: Simd>(self, simd: S) {
        let Self { modes, step, sources, to, sums } = self;
        let ModalStep { from, p: &[p0, p1], per_dt } = *step;
        let n = modes.count;
        let (groups, _) = modes.groups.as_chunks::<{ ROWS * LINE }>();
        let (q0, v0) = from[..2 * n].split_at(n);
        let (s, r) = sources[..3 * n].split_at_mut(2 * n);
        let (s0, s1) = s.split_at_mut(n);
        let (q, rest) = to[..3 * n].split_at_mut(n);
        let (v, a) = rest.split_at_mut(n);
        let ((q0, q0e), (v0, v0e)) = (q0.as_chunks(), v0.as_chunks());
        let ((p0, p0e), (p1, p1e)) = (p0[..n].as_chunks(), p1[..n].as_chunks());
        let ((r, re), (s0, s0e)) = (r.as_chunks(), s0.as_chunks());
        let ((s1, s1e), (q, qe)) = (s1.as_chunks_mut(), q.as_chunks_mut());
        let ((v, ve), (a, ae)) = (v.as_chunks_mut(), a.as_chunks_mut());
        let m = q0.len();
        let (whole, left) = groups.split_at(m);
        let (v0, p0, p1, r, s0) = (&v0[..m], &p0[..m], &p1[..m], &r[..m], &s0[..m]);
        let (s1, q, v, a) = (&mut s1[..m], &mut q[..m], &mut v[..m], &mut a[..m]);
        let per_dt = simd.splat_f64s(per_dt);
        let mut all = [simd.splat_f64s(0.0); 6];
        for (i, group) in whole.iter().enumerate() {
            let given = [&q0[i], &v0[i], &p0[i], &p1[i], &r[i], &s0[i]];
            let wanted = [&mut s1[i], &mut q[i], &mut v[i], &mut a[i]];
            complete(simd, group, per_dt, given, wanted, &mut all);
        }
        if let [group] = left {
            let [q0, v0, p0, p1, r, s0] = &rest_of([q0e, v0e, p0e, p1e, re, s0e]);
            let [mut s1, mut q, mut v, a] = rest_of([s1e, qe, ve, &[]]);
            let mut a = a;
            let wanted = [&mut s1, &mut q, &mut v, &mut a];
            complete(simd, group, per_dt, [q0, v0, p0, p1, r, s0], wanted, &mut all);
            for (to, line) in [s1e, qe, ve, ae].into_iter().zip([s1, q, v, a]) {
                to.copy_from_slice(&line[..to.len()]);
            }
        }
        let [external, all, kinetic0, kinetic1, strain0, strain1] = all;
        sums.external = simd.reduce_sum_f64s(external);
        sums.all = simd.reduce_sum_f64s(all);
        sums.kinetic = [0.5 * simd.reduce_sum_f64s(kinetic0), 0.5 * simd.reduce_sum_f64s(kinetic1)];
        sums.strain = [0.5 * simd.reduce_sum_f64s(strain0), 0.5 * simd.reduce_sum_f64s(strain1)];
    }
}

/// A group of modes; sums of the work of loads, of all, of q̇² and ω² q² at both ends.
#[inline(always)]
fn complete<S: Simd>(
    simd: S,
    c: &Group,
    per_dt: S::f64s,
    [q0, v0, p0, p1, r, s0]: [&Line; 6],
    [s1, q, v, a]: [&mut Line; 4],
    [external, all, kinetic0, kinetic1, strain0, strain1]: &mut [S::f64s; 6],
) {
    let mut at = 0;
    while at < LINE {
        let (x0, y0, t) = (of::<S>(q0, at), of::<S>(v0, at), of::<S>(s0, at));
        let (w, mass) = (of::<S>(c, OMEGA2 * LINE + at), of::<S>(c, MASS * LINE + at));
        let (start, end) = (of::<S>(p0, at), of::<S>(p1, at));
        let s = simd.sub_f64s(end, of::<S>(r, at));
        let change = simd.sub_f64s(s, of::<S>(s1, at));
        let x = simd.mul_add_e_f64s(of::<S>(c, (Q + 3) * LINE + at), change, of::<S>(q, at));
        let y = simd.mul_add_e_f64s(of::<S>(c, (V + 3) * LINE + at), change, of::<S>(v, at));
        put::<S>(s1, at, s);
        put::<S>(q, at, x);
        put::<S>(v, at, y);
        let held = simd.mul_add_e_f64s(of::<S>(c, RATE * LINE + at), y, simd.mul_f64s(w, x));
        put::<S>(a, at, simd.mul_f64s(mass, simd.sub_f64s(s, held)));
        // ∫ p q̇ dt = p₁ (q₁ − mean) − p₀ (q₀ − mean) with the mean of q.
        let sum = simd.mul_f64s(of::<S>(c, INTEGRAL * LINE + at), x0);
        let sum = simd.mul_add_e_f64s(of::<S>(c, (INTEGRAL + 1) * LINE + at), y0, sum);
        let sum = simd.mul_add_e_f64s(of::<S>(c, (INTEGRAL + 2) * LINE + at), t, sum);
        let sum = simd.mul_add_e_f64s(of::<S>(c, (INTEGRAL + 3) * LINE + at), s, sum);
        let mean = simd.mul_f64s(sum, per_dt);
        let (last, first) = (simd.sub_f64s(x, mean), simd.sub_f64s(mean, x0));
        *external = simd.mul_add_e_f64s(start, first, simd.mul_add_e_f64s(end, last, *external));
        *all = simd.mul_add_e_f64s(t, first, simd.mul_add_e_f64s(s, last, *all));
        *kinetic0 = simd.mul_add_e_f64s(simd.mul_f64s(mass, y0), y0, *kinetic0);
        *kinetic1 = simd.mul_add_e_f64s(simd.mul_f64s(mass, y), y, *kinetic1);
        *strain0 = simd.mul_add_e_f64s(simd.mul_f64s(w, x0), x0, *strain0);
        *strain1 = simd.mul_add_e_f64s(simd.mul_f64s(w, x), x, *strain1);
        at += S::F64_LANES;
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
            let modes = OwnModes::new(&c, &x[0], &x[1], &mass);
            let per_dt = 0.7;
            let start = [&x[2][..], &x[3], &x[8]].concat();
            let loads = [&x[4][..], &x[5]];
            let step = &ModalStep { from: &start, p: &loads, per_dt };
            let mut sources = vec![9.0; 3 * n];
            let mut to = vec![9.0; 3 * n];
            sources[2 * n..].copy_from_slice(&x[6]);
            modes.predict(step, &mut sources, &mut to);
            let with = |row: usize, i: usize, s: f64, t: f64| {
                c[row][0][i] * x[2][i]
                    + c[row][1][i] * x[3][i]
                    + c[row][2][i] * s
                    + c[row][3][i] * t
            };
            let close = |a: f64, b: f64| assert!((a - b).abs() < 1e-13, "{n}: {a} {b}");
            for i in 0..n {
                let (s, t) = (x[4][i] - x[6][i], x[5][i] - x[6][i]);
                close(to[i], with(1, i, s, t));
                close(to[n + i], with(2, i, s, t));
                assert_eq!(to[2 * n + i], 9.0);
            }
            sources[2 * n..].copy_from_slice(&x[7]);
            let mut sums = StepSums::default();
            modes.complete(step, &mut sources, &mut to, &mut sums);
            let mut expected = StepSums::default();
            for i in 0..n {
                let (s, t) = (x[4][i] - x[6][i], x[5][i] - x[7][i]);
                let (q, v) = (to[i], to[n + i]);
                close(sources[i], s);
                close(sources[n + i], t);
                close(q, with(1, i, s, t));
                close(v, with(2, i, s, t));
                close(to[2 * n + i], mass[i] * (t - x[1][i] * v - x[0][i] * q));
                let mean = per_dt * with(0, i, s, t);
                expected.external += x[5][i] * (q - mean) - x[4][i] * (x[2][i] - mean);
                expected.all += t * (q - mean) - s * (x[2][i] - mean);
                for (k, (q, v)) in [(x[2][i], x[3][i]), (q, v)].into_iter().enumerate() {
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
