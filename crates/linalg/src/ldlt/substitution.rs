//! Forward and back substitution of one right-hand side through supernodes.
//!
//! ```text
//!            ┌ 1        ┐ columns of a supernode: consecutive, of one pattern;
//!            │ l 1      │ stored as `packing` says
//!   panel =  │ l l 1    │
//!            │ l l l    │ ← rows[0]      rows below the block on the diagonal
//!            └ l l l    ┘ ← rows[1]
//! ```
//!
//! One right-hand side is bound by the memory traffic of the factor, so each panel is read once, four
//! columns at a time, against a contiguous copy of the values it touches. The order of additions does
//! not depend on the width of the vector unit: any machine gives the same bits.

use super::packing::{BLOCK, TILE, WIDTH, four};
use pulp::{Simd, WithSimd, bytemuck};

/// One supernode, or the part of one that belongs to a group.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Node {
    /// First column.
    pub start: u32,
    pub columns: u32,
    /// Rows of the panel, the block on the diagonal included.
    pub height: u32,
    /// Where its values begin.
    pub values: usize,
    /// Where its rows begin.
    pub rows: usize,
}

/// Supernodes in the order of elimination; rows and columns count from the first of the group.
#[derive(Clone, Debug, Default)]
pub(crate) struct Panels {
    pub nodes: Vec<Node>,
    /// Rows below the blocks on the diagonal.
    pub rows: Vec<u32>,
}

/// The parts of a node: first column, number of columns, rows below, panel.
pub(super) struct View<'a> {
    pub start: usize,
    pub columns: usize,
    pub height: usize,
    pub rows: &'a [u32],
    pub panel: &'a [f64],
}

impl Panels {
    /// Highest panel.
    pub(crate) fn height(&self) -> usize {
        self.nodes.iter().map(|n| n.height as usize).max().unwrap_or(0)
    }

    #[inline(always)]
    pub(super) fn view<'a>(&'a self, node: &Node, values: &'a [f64]) -> View<'a> {
        let (columns, height) = (node.columns as usize, node.height as usize);
        View {
            start: node.start as usize,
            columns,
            height,
            rows: &self.rows[node.rows..node.rows + height - columns],
            panel: &values[node.values..][..node.packed()],
        }
    }

    /// x ← L⁻¹ x with the unit lower factor; `work` holds [`height`](Self::height) values or more.
    pub(crate) fn forward(&self, values: &[f64], x: &mut [f64], work: &mut [f64]) {
        self.forward_of(&self.nodes, values, [x], work);
    }

    /// The same of some nodes, for some vectors, so that each panel comes from memory once.
    pub(super) fn forward_of<const K: usize>(
        &self,
        nodes: &[Node],
        values: &[f64],
        x: [&mut [f64]; K],
        work: &mut [f64],
    ) {
        crate::simd::dispatch(Forward { panels: self, nodes, values, x, work });
    }

    /// x ← L⁻ᵀ D⁻¹ x; `reciprocal` is 1/D. Rows beyond the columns of the group are known already.
    pub(crate) fn backward(
        &self,
        values: &[f64],
        reciprocal: &[f64],
        x: &mut [f64],
        work: &mut [f64],
    ) {
        self.backward_of(&self.nodes, values, reciprocal, [x], work);
    }

    /// The same of some nodes, for some vectors.
    pub(super) fn backward_of<const K: usize>(
        &self,
        nodes: &[Node],
        values: &[f64],
        reciprocal: &[f64],
        x: [&mut [f64]; K],
        work: &mut [f64],
    ) {
        crate::simd::dispatch(Backward { panels: self, nodes, values, reciprocal, x, work });
    }
}

struct Forward<'a, const K: usize> {
    panels: &'a Panels,
    nodes: &'a [Node],
    values: &'a [f64],
    x: [&'a mut [f64]; K],
    work: &'a mut [f64],
}

impl<const K: usize> WithSimd for Forward<'_, K> {
    type Output = ();
    #[inline(always)]
    fn with_simd<S: Simd>(mut self, simd: S) {
        for node in self.nodes {
            forward(simd, &self.panels.view(node, self.values), &mut self.x, self.work);
        }
    }
}

struct Backward<'a, const K: usize> {
    panels: &'a Panels,
    nodes: &'a [Node],
    values: &'a [f64],
    reciprocal: &'a [f64],
    x: [&'a mut [f64]; K],
    work: &'a mut [f64],
}

impl<const K: usize> WithSimd for Backward<'_, K> {
    type Output = ();
    #[inline(always)]
    fn with_simd<S: Simd>(mut self, simd: S) {
        for node in self.nodes.iter().rev() {
            let view = self.panels.view(node, self.values);
            backward(simd, &view, self.reciprocal, &mut self.x, self.work);
        }
    }
}

/// Values that a panel touches, of each vector, one after the other in `work`.
#[inline(always)]
fn touched<const K: usize>(work: &mut [f64], height: usize) -> [&mut [f64]; K] {
    let mut parts = work.chunks_exact_mut(height);
    std::array::from_fn(|_| parts.next().unwrap_or_default())
}

#[inline(always)]
fn forward<S: Simd, const K: usize>(
    simd: S,
    node: &View<'_>,
    x: &mut [&mut [f64]; K],
    work: &mut [f64],
) {
    let (s, c, h) = (node.start, node.columns, node.height);
    if c == 1 {
        for x in x {
            let t = x[s];
            for (r, l) in node.rows.iter().zip(node.panel) {
                x[*r as usize] -= l * t;
            }
        }
        return;
    }
    let mut w = touched::<K>(work, h);
    for (w, x) in w.iter_mut().zip(&*x) {
        w[..c].copy_from_slice(&x[s..s + c]);
        w[c..].fill(0.0);
    }
    let (mut j, mut panel) = (0, node.panel);
    while j + WIDTH <= c {
        let (own, rest) = panel.split_at(four(h - j));
        panel = rest;
        let (block, below) = own.split_at(BLOCK);
        let mut t = [[0.0; WIDTH]; K];
        for (t, w) in t.iter_mut().zip(&mut w) {
            let w = &mut w[j..];
            let a = w[0];
            let b = w[1] - block[0] * a;
            let d = w[2] - block[1] * a - block[3] * b;
            let e = w[3] - block[2] * a - block[4] * b - block[5] * d;
            (w[1], w[2], w[3]) = (b, d, e);
            *t = [a, b, d, e];
        }
        less(simd, w.each_mut().map(|w| &mut w[j + WIDTH..]), below, t);
        j += WIDTH;
    }
    while j < c {
        let (own, rest) = panel.split_at(h - j - 1);
        panel = rest;
        for w in &mut w {
            let (t, below) = (w[j], &mut w[j + 1..]);
            for (y, l) in below.iter_mut().zip(own) {
                *y -= l * t;
            }
        }
        j += 1;
    }
    for (w, x) in w.iter().zip(x) {
        x[s..s + c].copy_from_slice(&w[..c]);
        for (r, y) in node.rows.iter().zip(&w[c..]) {
            x[*r as usize] += y;
        }
    }
}

#[inline(always)]
fn backward<S: Simd, const K: usize>(
    simd: S,
    node: &View<'_>,
    reciprocal: &[f64],
    x: &mut [&mut [f64]; K],
    work: &mut [f64],
) {
    let (s, c, h) = (node.start, node.columns, node.height);
    if c == 1 {
        for x in x {
            let mut sum = [0.0; 2];
            let (rows, more) = node.rows.as_chunks::<2>();
            let (l, last) = node.panel.as_chunks::<2>();
            for (r, l) in rows.iter().zip(l) {
                sum[0] += l[0] * x[r[0] as usize];
                sum[1] += l[1] * x[r[1] as usize];
            }
            for (r, l) in more.iter().zip(last) {
                sum[0] += l * x[*r as usize];
            }
            x[s] = x[s] * reciprocal[s] - (sum[0] + sum[1]);
        }
        return;
    }
    let mut w = touched::<K>(work, h);
    for (w, x) in w.iter_mut().zip(&*x) {
        for (y, (a, r)) in w.iter_mut().zip(x[s..s + c].iter().zip(&reciprocal[s..])) {
            *y = a * r;
        }
        for (y, r) in w[c..].iter_mut().zip(node.rows) {
            *y = x[*r as usize];
        }
    }
    let (mut j, mut panel) = (c, node.panel);
    while !j.is_multiple_of(WIDTH) {
        j -= 1;
        let (rest, own) = panel.split_at(panel.len() - (h - j - 1));
        panel = rest;
        for w in &mut w {
            w[j] -= dot(own, &w[j + 1..]);
        }
    }
    while j > 0 {
        j -= WIDTH;
        let (rest, own) = panel.split_at(panel.len() - four(h - j));
        panel = rest;
        let (block, below) = own.split_at(BLOCK);
        let sums = dots(simd, below, w.each_ref().map(|w| &w[j + WIDTH..]));
        for (w, sum) in w.iter_mut().zip(&sums) {
            let w = &mut w[j..];
            let e = w[3] - sum[3];
            let d = w[2] - sum[2] - block[5] * e;
            let b = w[1] - sum[1] - block[3] * d - block[4] * e;
            w[0] = w[0] - sum[0] - block[0] * b - block[1] * d - block[2] * e;
            (w[1], w[2], w[3]) = (b, d, e);
        }
    }
    for (w, x) in w.iter().zip(x) {
        x[s..s + c].copy_from_slice(&w[..c]);
    }
}

/// y −= four columns, which lie in tiles, times four numbers; of each vector its own.
#[inline(always)]
fn less<S: Simd, const K: usize>(simd: S, y: [&mut [f64]; K], l: &[f64], t: [[f64; WIDTH]; K]) {
    let (tiles, last) = l.as_chunks::<{ WIDTH * TILE }>();
    let mut y = y.map(|y| y.as_chunks_mut::<TILE>());
    let splat = t.map(|t| t.map(|t| simd.splat_f64s(t)));
    for (i, l) in tiles.iter().enumerate() {
        let (l, _) = S::as_simd_f64s(l);
        for ((y, _), [va, vb, vd, ve]) in y.iter_mut().zip(splat) {
            let (y, _) = S::as_mut_simd_f64s(&mut y[i]);
            let n = y.len();
            let l = &l[..WIDTH * n];
            for k in 0..n {
                let one = simd.add_f64s(simd.mul_f64s(l[k], va), simd.mul_f64s(l[n + k], vb));
                let two =
                    simd.add_f64s(simd.mul_f64s(l[2 * n + k], vd), simd.mul_f64s(l[3 * n + k], ve));
                y[k] = simd.sub_f64s(y[k], simd.add_f64s(one, two));
            }
        }
    }
    for ((_, left), [a, b, d, e]) in y.iter_mut().zip(t) {
        let n = left.len();
        let last = &last[..WIDTH * n];
        for k in 0..n {
            left[k] -=
                (last[k] * a + last[n + k] * b) + (last[2 * n + k] * d + last[3 * n + k] * e);
        }
    }
}

/// Four products with each vector, of columns that lie in tiles.
#[inline(always)]
fn dots<S: Simd, const K: usize>(simd: S, l: &[f64], x: [&[f64]; K]) -> [[f64; WIDTH]; K] {
    let (tiles, last) = l.as_chunks::<{ WIDTH * TILE }>();
    let x = x.map(|x| x.as_chunks::<TILE>());
    // As many of the registers as a tile takes.
    let mut sums = [[[simd.splat_f64s(0.0); TILE]; WIDTH]; K];
    for (i, l) in tiles.iter().enumerate() {
        let (l, _) = S::as_simd_f64s(l);
        for ((x, _), sum) in x.iter().zip(&mut sums) {
            let (x, _) = S::as_simd_f64s(&x[i]);
            let n = TILE / S::F64_LANES;
            let (x, l) = (&x[..n], &l[..WIDTH * n]);
            for c in 0..WIDTH {
                for k in 0..n {
                    sum[c][k] = simd.add_f64s(sum[c][k], simd.mul_f64s(l[n * c + k], x[k]));
                }
            }
        }
    }
    let mut totals = [[0.0; WIDTH]; K];
    for (total, ((_, left), sum)) in totals.iter_mut().zip(x.iter().zip(&sums)) {
        let n = left.len();
        let last = &last[..WIDTH * n];
        for c in 0..WIDTH {
            let mut tail = 0.0;
            for k in 0..n {
                tail += last[n * c + k] * left[k];
            }
            let s: &[f64] = bytemuck::cast_slice(&sum[c][..TILE / S::F64_LANES]);
            total[c] = ((s[0] + s[1]) + (s[2] + s[3])) + ((s[4] + s[5]) + (s[6] + s[7])) + tail;
        }
    }
    totals
}

#[inline(always)]
fn dot(a: &[f64], b: &[f64]) -> f64 {
    let ((a, more), (b, rest)) = (a.as_chunks::<4>(), b.as_chunks::<4>());
    let mut sum = [0.0; 4];
    for (a, b) in a.iter().zip(b) {
        for k in 0..4 {
            sum[k] += a[k] * b[k];
        }
    }
    let tail: f64 = more.iter().zip(rest).map(|(a, b)| a * b).sum();
    (sum[0] + sum[1]) + (sum[2] + sum[3]) + tail
}
