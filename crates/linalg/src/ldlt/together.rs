//! Forward and back substitution of four right-hand sides at once, see `substitution` for one.
//!
//! Values of the four stand side by side, so every value of the factor is read once for all of them. Each
//! is solved to the same bits whatever stands beside it.

use super::substitution::{Panels, View};
use pulp::{Simd, WithSimd};

/// One equation of the four.
pub(crate) type Four = [f64; 4];

/// Columns handled at once.
const WIDTH: usize = 4;

impl Panels {
    /// x ← L⁻¹ x with the unit lower factor; `work` holds [`height`](Self::height) places or more.
    pub(crate) fn forward_four(&self, values: &[f64], x: &mut [Four], work: &mut [Four]) {
        crate::simd::dispatch(Forward { panels: self, values, x, work });
    }

    /// x ← L⁻ᵀ D⁻¹ x; `reciprocal` is 1/D. Rows beyond the columns of the group are known already.
    pub(crate) fn backward_four(
        &self,
        values: &[f64],
        reciprocal: &[f64],
        x: &mut [Four],
        work: &mut [Four],
    ) {
        crate::simd::dispatch(Backward { panels: self, values, reciprocal, x, work });
    }
}

struct Forward<'a> {
    panels: &'a Panels,
    values: &'a [f64],
    x: &'a mut [Four],
    work: &'a mut [Four],
}

impl WithSimd for Forward<'_> {
    type Output = ();
    #[inline(always)]
    fn with_simd<S: Simd>(self, _: S) {
        for node in &self.panels.nodes {
            forward(&self.panels.view(node, self.values), self.x, self.work);
        }
    }
}

struct Backward<'a> {
    panels: &'a Panels,
    values: &'a [f64],
    reciprocal: &'a [f64],
    x: &'a mut [Four],
    work: &'a mut [Four],
}

impl WithSimd for Backward<'_> {
    type Output = ();
    #[inline(always)]
    fn with_simd<S: Simd>(self, _: S) {
        for node in self.panels.nodes.iter().rev() {
            backward(&self.panels.view(node, self.values), self.reciprocal, self.x, self.work);
        }
    }
}

/// y −= l x.
#[inline(always)]
fn less(y: &mut Four, l: f64, x: &Four) {
    for k in 0..4 {
        y[k] -= l * x[k];
    }
}

#[inline(always)]
fn forward(node: &View<'_>, x: &mut [Four], work: &mut [Four]) {
    let (s, c, h) = (node.start, node.columns, node.height);
    let w = &mut work[..h];
    w[..c].copy_from_slice(&x[s..s + c]);
    w[c..].fill([0.0; 4]);
    let mut j = 0;
    while j < c {
        let width = WIDTH.min(c - j);
        let column = |k: usize| &node.panel[(j + k) * node.stride..][..h][j..];
        let (block, below) = w[j..].split_at_mut(width);
        for k in 0..width {
            let t = block[k];
            block[k + 1..].iter_mut().zip(&column(k)[k + 1..]).for_each(|(y, l)| less(y, *l, &t));
        }
        if let Ok([a, b, d, e]) = <[Four; WIDTH]>::try_from(&*block) {
            let [l0, l1, l2, l3] = [0, 1, 2, 3].map(|k| &column(k)[WIDTH..]);
            let columns = l0.iter().zip(l1).zip(l2).zip(l3);
            for (y, (((l0, l1), l2), l3)) in below.iter_mut().zip(columns) {
                for k in 0..4 {
                    y[k] -= (l0 * a[k] + l1 * b[k]) + (l2 * d[k] + l3 * e[k]);
                }
            }
        } else {
            for (k, t) in block.iter().enumerate() {
                let l = &column(k)[width..];
                below.iter_mut().zip(l).for_each(|(y, l)| less(y, *l, t));
            }
        }
        j += width;
    }
    x[s..s + c].copy_from_slice(&w[..c]);
    for (r, y) in node.rows.iter().zip(&w[c..]) {
        x[*r as usize].iter_mut().zip(y).for_each(|(x, y)| *x += y);
    }
}

#[inline(always)]
fn backward(node: &View<'_>, reciprocal: &[f64], x: &mut [Four], work: &mut [Four]) {
    let (s, c, h) = (node.start, node.columns, node.height);
    let w = &mut work[..h];
    for (y, (a, r)) in w.iter_mut().zip(x[s..s + c].iter().zip(&reciprocal[s..])) {
        *y = a.map(|a| a * r);
    }
    for (y, r) in w[c..].iter_mut().zip(node.rows) {
        *y = x[*r as usize];
    }
    let mut j = c;
    while j > 0 {
        let width = if j.is_multiple_of(WIDTH) { WIDTH } else { j % WIDTH };
        j -= width;
        let column = |k: usize| &node.panel[(j + k) * node.stride..][..h][j..];
        let (block, below) = w[j..].split_at_mut(width);
        let mut sums = [[0.0; 4]; WIDTH];
        if width == WIDTH {
            let [l0, l1, l2, l3] = [0, 1, 2, 3].map(|k| &column(k)[WIDTH..]);
            let [mut a, mut b, mut d, mut e] = sums;
            for (y, (((l0, l1), l2), l3)) in below.iter().zip(l0.iter().zip(l1).zip(l2).zip(l3)) {
                for k in 0..4 {
                    a[k] += l0 * y[k];
                    b[k] += l1 * y[k];
                    d[k] += l2 * y[k];
                    e[k] += l3 * y[k];
                }
            }
            sums = [a, b, d, e];
        } else {
            for (k, sum) in sums[..width].iter_mut().enumerate() {
                for (l, y) in column(k)[width..].iter().zip(&*below) {
                    sum.iter_mut().zip(y).for_each(|(s, y)| *s += l * y);
                }
            }
        }
        for k in (0..width).rev() {
            let (upper, known) = block.split_at_mut(k + 1);
            less(&mut upper[k], 1.0, &sums[k]);
            known.iter().zip(&column(k)[k + 1..]).for_each(|(y, l)| less(&mut upper[k], *l, y));
        }
    }
    x[s..s + c].copy_from_slice(&w[..c]);
}
