//! Forward and back substitution of several right-hand sides at once, four or eight, see `substitution` for one.
//!
//! Their values stand side by side, so every value of the factor is read once for all of them. Each is solved to the
//! same bits whatever stands beside it.

use super::packing::{BLOCK, TILE, WIDTH, four};
use super::substitution::{Panels, View};
use pulp::{Simd, WithSimd};

impl Panels {
    /// x ← L⁻¹ x with the unit lower factor; `work` holds [`height`](Self::height) places or more.
    pub(crate) fn forward_each<const N: usize>(
        &self,
        values: &[f64],
        x: &mut [[f64; N]],
        work: &mut [[f64; N]],
    ) {
        crate::simd::dispatch(Forward { panels: self, values, x, work });
    }

    /// x ← L⁻ᵀ D⁻¹ x; `reciprocal` is 1/D. Rows beyond the columns of the group are known already.
    pub(crate) fn backward_each<const N: usize>(
        &self,
        values: &[f64],
        reciprocal: &[f64],
        x: &mut [[f64; N]],
        work: &mut [[f64; N]],
    ) {
        crate::simd::dispatch(Backward { panels: self, values, reciprocal, x, work });
    }
}

struct Forward<'a, const N: usize> {
    panels: &'a Panels,
    values: &'a [f64],
    x: &'a mut [[f64; N]],
    work: &'a mut [[f64; N]],
}

impl<const N: usize> WithSimd for Forward<'_, N> {
    type Output = ();
    #[inline(always)]
    fn with_simd<S: Simd>(self, _: S) {
        for node in &self.panels.nodes {
            forward::<S, N>(&self.panels.view(node, self.values), self.x, self.work);
        }
    }
}

struct Backward<'a, const N: usize> {
    panels: &'a Panels,
    values: &'a [f64],
    reciprocal: &'a [f64],
    x: &'a mut [[f64; N]],
    work: &'a mut [[f64; N]],
}

impl<const N: usize> WithSimd for Backward<'_, N> {
    type Output = ();
    #[inline(always)]
    fn with_simd<S: Simd>(self, _: S) {
        for node in self.panels.nodes.iter().rev() {
            backward::<S, N>(
                &self.panels.view(node, self.values),
                self.reciprocal,
                self.x,
                self.work,
            );
        }
    }
}

/// a b + c, rounded once where the processor can, which halves the operations of a substitution.
#[inline(always)]
fn fused<S: Simd>(a: f64, b: f64, c: f64) -> f64 {
    // Vectors of four come with it; elsewhere it might be a call.
    if S::F64_LANES >= 4 { a.mul_add(b, c) } else { a * b + c }
}

/// y −= l x.
#[inline(always)]
fn less<S: Simd, const N: usize>(y: &mut [f64; N], l: f64, x: &[f64; N]) {
    for k in 0..N {
        y[k] = fused::<S>(-l, x[k], y[k]);
    }
}

#[inline(always)]
fn forward<S: Simd, const N: usize>(node: &View<'_>, x: &mut [[f64; N]], work: &mut [[f64; N]]) {
    let (s, c, h) = (node.start, node.columns, node.height);
    // Where few equations are loaded, most of the structure hears of it on the way back alone.
    if x[s..s + c].iter().all(|x| *x == [0.0; N]) {
        return;
    }
    let w = &mut work[..h];
    w[..c].copy_from_slice(&x[s..s + c]);
    w[c..].fill([0.0; N]);
    let (mut j, mut panel) = (0, node.panel);
    while j + WIDTH <= c {
        let (own, rest) = panel.split_at(four(h - j));
        panel = rest;
        let (block, values) = own.split_at(BLOCK);
        let (own, below) = w[j..].split_at_mut(WIDTH);
        let a = own[0];
        less::<S, N>(&mut own[1], block[0], &a);
        less::<S, N>(&mut own[2], block[1], &a);
        less::<S, N>(&mut own[3], block[2], &a);
        let b = own[1];
        less::<S, N>(&mut own[2], block[3], &b);
        less::<S, N>(&mut own[3], block[4], &b);
        let d = own[2];
        less::<S, N>(&mut own[3], block[5], &d);
        let e = own[3];
        let (tiles, last) = values.as_chunks::<{ WIDTH * TILE }>();
        let (rows, left) = below.as_chunks_mut::<TILE>();
        for (y, l) in rows.iter_mut().zip(tiles) {
            less_four::<S, N>(y, l, [&a, &b, &d, &e]);
        }
        less_four::<S, N>(left, last, [&a, &b, &d, &e]);
        j += WIDTH;
    }
    while j < c {
        let (t, below) = (w[j], &mut w[j + 1..]);
        let (own, rest) = panel.split_at(below.len());
        panel = rest;
        for (y, l) in below.iter_mut().zip(own) {
            less::<S, N>(y, *l, &t);
        }
        j += 1;
    }
    x[s..s + c].copy_from_slice(&w[..c]);
    for (r, y) in node.rows.iter().zip(&w[c..]) {
        x[*r as usize].iter_mut().zip(y).for_each(|(x, y)| *x += y);
    }
}

#[inline(always)]
fn backward<S: Simd, const N: usize>(
    node: &View<'_>,
    reciprocal: &[f64],
    x: &mut [[f64; N]],
    work: &mut [[f64; N]],
) {
    let (s, c, h) = (node.start, node.columns, node.height);
    let w = &mut work[..h];
    for (y, (a, r)) in w.iter_mut().zip(x[s..s + c].iter().zip(&reciprocal[s..])) {
        *y = a.map(|a| a * r);
    }
    for (y, r) in w[c..].iter_mut().zip(node.rows) {
        *y = x[*r as usize];
    }
    let (mut j, mut panel) = (c, node.panel);
    while !j.is_multiple_of(WIDTH) {
        j -= 1;
        let (upper, below) = w[j..].split_at_mut(1);
        let (rest, own) = panel.split_at(panel.len() - below.len());
        panel = rest;
        let mut sum = [0.0; N];
        for (y, l) in below.iter().zip(own) {
            for k in 0..N {
                sum[k] = fused::<S>(*l, y[k], sum[k]);
            }
        }
        less::<S, N>(&mut upper[0], 1.0, &sum);
    }
    while j > 0 {
        j -= WIDTH;
        let (rest, own) = panel.split_at(panel.len() - four(h - j));
        panel = rest;
        let (block, values) = own.split_at(BLOCK);
        let (own, below) = w[j..].split_at_mut(WIDTH);
        let (tiles, last) = values.as_chunks::<{ WIDTH * TILE }>();
        let (rows, left) = below.as_chunks::<TILE>();
        let mut sums = [[0.0; N]; WIDTH];
        for (y, l) in rows.iter().zip(tiles) {
            add_four::<S, N>(&mut sums, y, l);
        }
        add_four::<S, N>(&mut sums, left, last);
        let [a, b, d, e] = sums;
        less::<S, N>(&mut own[3], 1.0, &e);
        let last = own[3];
        less::<S, N>(&mut own[2], 1.0, &d);
        less::<S, N>(&mut own[2], block[5], &last);
        let third = own[2];
        less::<S, N>(&mut own[1], 1.0, &b);
        less::<S, N>(&mut own[1], block[3], &third);
        less::<S, N>(&mut own[1], block[4], &last);
        let second = own[1];
        less::<S, N>(&mut own[0], 1.0, &a);
        less::<S, N>(&mut own[0], block[0], &second);
        less::<S, N>(&mut own[0], block[1], &third);
        less::<S, N>(&mut own[0], block[2], &last);
    }
    x[s..s + c].copy_from_slice(&w[..c]);
}

/// y −= four columns of a tile times four numbers each.
#[inline(always)]
fn less_four<S: Simd, const N: usize>(y: &mut [[f64; N]], l: &[f64], t: [&[f64; N]; WIDTH]) {
    let n = y.len();
    let l = &l[..WIDTH * n];
    let [a, b, d, e] = t;
    for (i, y) in y.iter_mut().enumerate() {
        let [l0, l1, l2, l3] = [l[i], l[n + i], l[2 * n + i], l[3 * n + i]];
        for k in 0..N {
            let half = fused::<S>(-l1, b[k], fused::<S>(-l0, a[k], y[k]));
            y[k] = fused::<S>(-l3, e[k], fused::<S>(-l2, d[k], half));
        }
    }
}

/// Sums of four columns of a tile times y.
#[inline(always)]
fn add_four<S: Simd, const N: usize>(sums: &mut [[f64; N]; WIDTH], y: &[[f64; N]], l: &[f64]) {
    let n = y.len();
    let l = &l[..WIDTH * n];
    for (i, y) in y.iter().enumerate() {
        for (c, sum) in sums.iter_mut().enumerate() {
            for k in 0..N {
                sum[k] = fused::<S>(l[c * n + i], y[k], sum[k]);
            }
        }
    }
}
