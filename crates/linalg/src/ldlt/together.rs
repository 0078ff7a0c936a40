//! Forward and back substitution of eight right-hand sides at once, see `substitution` for one.
//!
//! ```text
//!   y₈ −= l t₈      of each value l of the factor, eight numbers at once: one register, two, or eight
//! ```
//!
//! Their values stand side by side, so every value of the factor is read once for all of them. Each is solved to the same
//! bits whatever stands beside it. Registers are named: left to the compiler, rows came into them in place of right-hand
//! sides, gathered one by one, which took three times as long.

use super::packing::{BLOCK, TILE, WIDTH, four};
use super::substitution::{Panels, View};
use pulp::{Simd, WithSimd};

/// Right-hand sides side by side.
pub(super) const BESIDE: usize = 8;

/// A number of each right-hand side.
pub(super) type Each = [f64; BESIDE];

impl Panels {
    /// x ← L⁻¹ x with the unit lower factor; `work` holds [`height`](Self::height) places or more.
    pub(super) fn forward_each(&self, values: &[f64], x: &mut [Each], work: &mut [Each]) {
        crate::simd::dispatch(Substitution { panels: self, values, reciprocal: None, x, work });
    }

    /// x ← L⁻ᵀ D⁻¹ x; `reciprocal` is 1/D. Rows beyond the columns of the group are known already.
    pub(super) fn backward_each(
        &self,
        values: &[f64],
        reciprocal: &[f64],
        x: &mut [Each],
        work: &mut [Each],
    ) {
        let reciprocal = Some(reciprocal);
        crate::simd::dispatch(Substitution { panels: self, values, reciprocal, x, work });
    }
}

/// Forward, or with 1/D back.
struct Substitution<'a> {
    panels: &'a Panels,
    values: &'a [f64],
    reciprocal: Option<&'a [f64]>,
    x: &'a mut [Each],
    work: &'a mut [Each],
}

impl Substitution<'_> {
    #[inline(always)]
    fn run<S: Simd, const P: usize>(self, simd: S) {
        let Self { panels, values, reciprocal, x, work } = self;
        let (x, work) = (registers::<S, P>(x), registers::<S, P>(work));
        match reciprocal {
            None => {
                for node in &panels.nodes {
                    forward(simd, &panels.view(node, values), x, work);
                }
            }
            Some(reciprocal) => {
                for node in panels.nodes.iter().rev() {
                    backward(simd, &panels.view(node, values), reciprocal, x, work);
                }
            }
        }
    }
}

impl WithSimd for Substitution<'_> {
    type Output = ();
    #[inline(always)]
    fn with_simd<S: Simd>(self, simd: S) {
        match S::F64_LANES {
            8 => self.run::<S, 1>(simd),
            4 => self.run::<S, 2>(simd),
            2 => self.run::<S, 4>(simd),
            _ => self.run::<S, BESIDE>(simd),
        }
    }
}

/// Numbers of the right-hand sides as P registers each.
#[inline(always)]
fn registers<S: Simd, const P: usize>(x: &mut [Each]) -> &mut [[S::f64s; P]] {
    S::as_mut_simd_f64s(x.as_flattened_mut()).0.as_chunks_mut().0
}

/// y + l t.
#[inline(always)]
fn plus<S: Simd, const P: usize>(
    simd: S,
    y: [S::f64s; P],
    l: f64,
    t: [S::f64s; P],
) -> [S::f64s; P] {
    let l = simd.splat_f64s(l);
    std::array::from_fn(|p| simd.mul_add_e_f64s(l, t[p], y[p]))
}

/// −t.
#[inline(always)]
fn minus<S: Simd, const P: usize>(simd: S, t: [S::f64s; P]) -> [S::f64s; P] {
    t.map(|t| simd.neg_f64s(t))
}

#[inline(always)]
fn forward<S: Simd, const P: usize>(
    simd: S,
    node: &View<'_>,
    x: &mut [[S::f64s; P]],
    work: &mut [[S::f64s; P]],
) {
    let (s, c, h) = (node.start, node.columns, node.height);
    // Where few equations are loaded, most of the structure hears of it on the way back alone.
    if is_zero::<S, P>(&x[s..s + c]) {
        return;
    }
    let w = &mut work[..h];
    w[..c].copy_from_slice(&x[s..s + c]);
    w[c..].fill([simd.splat_f64s(0.0); P]);
    let mut panel = node.panel;
    for j in (0..c - c % WIDTH).step_by(WIDTH) {
        let (own, rest) = panel.split_at(four(h - j));
        panel = rest;
        let (block, values) = own.split_at(BLOCK);
        let (own, below) = w[j..].split_at_mut(WIDTH);
        let a = minus(simd, own[0]);
        own[1] = plus(simd, own[1], block[0], a);
        own[2] = plus(simd, own[2], block[1], a);
        own[3] = plus(simd, own[3], block[2], a);
        let b = minus(simd, own[1]);
        own[2] = plus(simd, own[2], block[3], b);
        own[3] = plus(simd, own[3], block[4], b);
        let d = minus(simd, own[2]);
        own[3] = plus(simd, own[3], block[5], d);
        let e = minus(simd, own[3]);
        spread(simd, below, values, [a, b, d, e]);
    }
    for j in c - c % WIDTH..c {
        let (t, below) = (minus(simd, w[j]), &mut w[j + 1..]);
        let (own, rest) = panel.split_at(below.len());
        panel = rest;
        below.iter_mut().zip(own).for_each(|(y, l)| *y = plus(simd, *y, *l, t));
    }
    x[s..s + c].copy_from_slice(&w[..c]);
    for (r, y) in node.rows.iter().zip(&w[c..]) {
        let x = &mut x[*r as usize];
        *x = std::array::from_fn(|p| simd.add_f64s(x[p], y[p]));
    }
}

#[inline(always)]
fn backward<S: Simd, const P: usize>(
    simd: S,
    node: &View<'_>,
    reciprocal: &[f64],
    x: &mut [[S::f64s; P]],
    work: &mut [[S::f64s; P]],
) {
    let (s, c, h) = (node.start, node.columns, node.height);
    let zero = [simd.splat_f64s(0.0); P];
    let w = &mut work[..h];
    for (y, (a, r)) in w.iter_mut().zip(x[s..s + c].iter().zip(&reciprocal[s..])) {
        let r = simd.splat_f64s(*r);
        *y = a.map(|a| simd.mul_f64s(a, r));
    }
    for (y, r) in w[c..].iter_mut().zip(node.rows) {
        *y = x[*r as usize];
    }
    let mut panel = node.panel;
    for j in (c - c % WIDTH..c).rev() {
        let (upper, below) = w[j..].split_at_mut(1);
        let (rest, own) = panel.split_at(panel.len() - below.len());
        panel = rest;
        let sum = below.iter().zip(own).fold(zero, |sum, (y, l)| plus(simd, sum, *l, *y));
        upper[0] = plus(simd, upper[0], -1.0, sum);
    }
    for j in (0..c - c % WIDTH).step_by(WIDTH).rev() {
        let (rest, own) = panel.split_at(panel.len() - four(h - j));
        panel = rest;
        let (block, values) = own.split_at(BLOCK);
        let (own, below) = w[j..].split_at_mut(WIDTH);
        let sums = gather(simd, below, values);
        let less = |y, l: f64, t| plus(simd, y, -l, t);
        own[3] = less(own[3], 1.0, sums[3]);
        own[2] = less(less(own[2], 1.0, sums[2]), block[5], own[3]);
        own[1] = less(less(own[1], 1.0, sums[1]), block[3], own[2]);
        own[1] = less(own[1], block[4], own[3]);
        own[0] = less(less(own[0], 1.0, sums[0]), block[0], own[1]);
        own[0] = less(less(own[0], block[1], own[2]), block[2], own[3]);
    }
    x[s..s + c].copy_from_slice(&w[..c]);
}

/// True where all numbers are zero.
#[inline(always)]
fn is_zero<S: Simd, const P: usize>(x: &[[S::f64s; P]]) -> bool {
    pulp::bytemuck::cast_slice::<S::f64s, f64>(x.as_flattened()).iter().all(|x| *x == 0.0)
}

/// y += L t of four columns of some tiles.
#[inline(always)]
fn spread<S: Simd, const P: usize>(
    simd: S,
    y: &mut [[S::f64s; P]],
    l: &[f64],
    t: [[S::f64s; P]; WIDTH],
) {
    let (tiles, last) = l.as_chunks::<{ WIDTH * TILE }>();
    let (rows, left) = y.as_chunks_mut::<TILE>();
    for (y, l) in rows.iter_mut().zip(tiles) {
        for i in 0..TILE {
            // Apart from memory while it grows.
            let mut own = y[i];
            for k in 0..WIDTH {
                own = plus(simd, own, l[k * TILE + i], t[k]);
            }
            y[i] = own;
        }
    }
    let n = left.len();
    for (i, y) in left.iter_mut().enumerate() {
        for k in 0..WIDTH {
            *y = plus(simd, *y, last[k * n + i], t[k]);
        }
    }
}

/// Lᵀ y of four columns of some tiles.
#[inline(always)]
fn gather<S: Simd, const P: usize>(
    simd: S,
    y: &[[S::f64s; P]],
    l: &[f64],
) -> [[S::f64s; P]; WIDTH] {
    let (tiles, last) = l.as_chunks::<{ WIDTH * TILE }>();
    let (rows, left) = y.as_chunks::<TILE>();
    let mut sums = [[simd.splat_f64s(0.0); P]; WIDTH];
    for (y, l) in rows.iter().zip(tiles) {
        for i in 0..TILE {
            for k in 0..WIDTH {
                sums[k] = plus(simd, sums[k], l[k * TILE + i], y[i]);
            }
        }
    }
    let n = left.len();
    for (i, y) in left.iter().enumerate() {
        for k in 0..WIDTH {
            sums[k] = plus(simd, sums[k], last[k * n + i], *y);
        }
    }
    sums
}
