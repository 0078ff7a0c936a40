//! Forward and back substitution of one right-hand side through supernodes.
//!
//! ```text
//!            ┌ 1        ┐ columns of a supernode: consecutive, of one pattern;
//!            │ l 1      │ stored column by column, `stride` values each
//!   panel =  │ l l 1    │
//!            │ l l l    │ ← rows[0]      rows below the block on the diagonal
//!            └ l l l    ┘ ← rows[1]
//! ```
//!
//! One right-hand side is bound by the memory traffic of the factor, so each panel is read once, four
//! columns at a time, against a contiguous copy of the values it touches. The order of additions does
//! not depend on the width of the vector unit: any machine gives the same bits.

use pulp::{Simd, WithSimd};

/// Columns handled at once.
const WIDTH: usize = 4;

/// One supernode, or the part of one that belongs to a group.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Node {
    /// First column.
    pub start: u32,
    pub columns: u32,
    /// Rows of the panel, the block on the diagonal included.
    pub height: u32,
    pub stride: u32,
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
    pub stride: usize,
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
            stride: node.stride as usize,
            rows: &self.rows[node.rows..node.rows + height - columns],
            panel: &values[node.values..],
        }
    }

    /// x ← L⁻¹ x with the unit lower factor; `work` holds [`height`](Self::height) values or more.
    pub(crate) fn forward(&self, values: &[f64], x: &mut [f64], work: &mut [f64]) {
        crate::simd::dispatch(Forward { panels: self, values, x, work });
    }

    /// x ← L⁻ᵀ D⁻¹ x; `reciprocal` is 1/D. Rows beyond the columns of the group are known already.
    pub(crate) fn backward(
        &self,
        values: &[f64],
        reciprocal: &[f64],
        x: &mut [f64],
        work: &mut [f64],
    ) {
        crate::simd::dispatch(Backward { panels: self, values, reciprocal, x, work });
    }
}

struct Forward<'a> {
    panels: &'a Panels,
    values: &'a [f64],
    x: &'a mut [f64],
    work: &'a mut [f64],
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
    x: &'a mut [f64],
    work: &'a mut [f64],
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

#[inline(always)]
fn forward(node: &View<'_>, x: &mut [f64], work: &mut [f64]) {
    let (s, c, h) = (node.start, node.columns, node.height);
    if c == 1 {
        let t = x[s];
        for (r, l) in node.rows.iter().zip(&node.panel[1..h]) {
            x[*r as usize] -= l * t;
        }
        return;
    }
    let w = &mut work[..h];
    w[..c].copy_from_slice(&x[s..s + c]);
    w[c..].fill(0.0);
    let mut j = 0;
    while j + WIDTH <= c {
        let column = |k: usize| &node.panel[(j + k) * node.stride..][..h][j..];
        let [l0, l1, l2, l3] = [column(0), column(1), column(2), column(3)];
        let w = &mut w[j..];
        let a = w[0];
        let b = w[1] - l0[1] * a;
        let d = w[2] - l0[2] * a - l1[2] * b;
        let e = w[3] - l0[3] * a - l1[3] * b - l2[3] * d;
        (w[1], w[2], w[3]) = (b, d, e);
        let columns = l0[4..].iter().zip(&l1[4..]).zip(&l2[4..]).zip(&l3[4..]);
        for (y, (((l0, l1), l2), l3)) in w[4..].iter_mut().zip(columns) {
            *y -= (l0 * a + l1 * b) + (l2 * d + l3 * e);
        }
        j += WIDTH;
    }
    while j < c {
        let t = w[j];
        for (y, l) in w[j + 1..].iter_mut().zip(&node.panel[j * node.stride + j + 1..]) {
            *y -= l * t;
        }
        j += 1;
    }
    x[s..s + c].copy_from_slice(&w[..c]);
    for (r, y) in node.rows.iter().zip(&w[c..]) {
        x[*r as usize] += y;
    }
}

#[inline(always)]
fn backward(node: &View<'_>, reciprocal: &[f64], x: &mut [f64], work: &mut [f64]) {
    let (s, c, h) = (node.start, node.columns, node.height);
    if c == 1 {
        let mut sum = [0.0; 2];
        let (rows, more) = node.rows.as_chunks::<2>();
        let (l, last) = node.panel[1..h].as_chunks::<2>();
        for (r, l) in rows.iter().zip(l) {
            sum[0] += l[0] * x[r[0] as usize];
            sum[1] += l[1] * x[r[1] as usize];
        }
        for (r, l) in more.iter().zip(last) {
            sum[0] += l * x[*r as usize];
        }
        x[s] = x[s] * reciprocal[s] - (sum[0] + sum[1]);
        return;
    }
    let w = &mut work[..h];
    for (y, (a, r)) in w.iter_mut().zip(x[s..s + c].iter().zip(&reciprocal[s..])) {
        *y = a * r;
    }
    for (y, r) in w[c..].iter_mut().zip(node.rows) {
        *y = x[*r as usize];
    }
    let mut j = c;
    while !j.is_multiple_of(WIDTH) {
        j -= 1;
        let below = &w[j + 1..];
        w[j] -= dot(&node.panel[j * node.stride + j + 1..][..below.len()], below);
    }
    while j > 0 {
        j -= WIDTH;
        let column = |k: usize| &node.panel[(j + k) * node.stride..][..h][j..];
        let l = [column(0), column(1), column(2), column(3)];
        let w = &mut w[j..];
        let sum = dots([&l[0][4..], &l[1][4..], &l[2][4..], &l[3][4..]], &w[4..]);
        let e = w[3] - sum[3];
        let d = w[2] - sum[2] - l[2][3] * e;
        let b = w[1] - sum[1] - l[1][2] * d - l[1][3] * e;
        w[0] = w[0] - sum[0] - l[0][1] * b - l[0][2] * d - l[0][3] * e;
        (w[1], w[2], w[3]) = (b, d, e);
    }
    x[s..s + c].copy_from_slice(&w[..c]);
}

/// Four products with one vector.
#[inline(always)]
fn dots(l: [&[f64]; WIDTH], x: &[f64]) -> [f64; WIDTH] {
    let n = x.len();
    let [l0, l1, l2, l3] = l;
    let parts = [
        l0[..n].as_chunks::<4>(),
        l1[..n].as_chunks::<4>(),
        l2[..n].as_chunks::<4>(),
        l3[..n].as_chunks::<4>(),
    ];
    let (chunks, rest) = x.as_chunks::<4>();
    let mut sum = [[0.0; 4]; WIDTH];
    for (i, x) in chunks.iter().enumerate() {
        for (sum, (l, _)) in sum.iter_mut().zip(&parts) {
            let l = &l[i];
            for k in 0..4 {
                sum[k] += l[k] * x[k];
            }
        }
    }
    let mut total = [0.0; WIDTH];
    for k in 0..WIDTH {
        let tail: f64 = parts[k].1.iter().zip(rest).map(|(a, b)| a * b).sum();
        total[k] = (sum[k][0] + sum[k][1]) + (sum[k][2] + sum[k][3]) + tail;
    }
    total
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
