//! The load-dependent recursion: K̂ xᵢ₊₁ = M xᵢ, block after block.

use super::attachment::AttachmentVectors;
use super::condensation::Condensation;
use super::orthonormal::{FrequencyCut, Origin, OrthonormalBasis};
use super::solvable::{BLOCK, Solvable};
use crate::vector::dot;
use trilith_linalg::Dense;
use trilith_system::System;

/// Of a link coordinate and its static shape, what goes into the span.
pub(super) type OfLink<'a> = dyn Fn(usize, &[f64]) -> Vec<f64> + 'a;

/// Takes static shapes of links until `count` vectors are there, and returns their images under M.
pub(super) fn beyond(
    system: &System,
    hat: &Solvable,
    span: &mut OrthonormalBasis<'_>,
    beside: &OfLink<'_>,
    count: usize,
) -> Vec<Vec<f64>> {
    let first = span.len();
    for block in system.links.active.chunks(BLOCK) {
        if span.len() >= count {
            break;
        }
        hat.static_shapes(system, block, |shapes, _| {
            let own = block.iter().zip(shapes).map(|(link, x)| beside(*link, x)).collect();
            span.take_until(count, own, FrequencyCut::Modes);
        });
    }
    span.images_since(first)
}

/// What a recursion was about to go on with, but that is too fast for modes of interest.
pub(super) struct Fast {
    /// Vectors that were left out.
    pub(super) left: Vec<Vec<f64>>,
    /// Right-hand sides of what follows from those taken in the end.
    pub(super) block: Vec<Vec<f64>>,
}

impl Fast {
    /// Takes them, and what follows from them, until `count` vectors are there.
    pub(super) fn go_on(
        &mut self,
        span: &mut OrthonormalBasis<'_>,
        rows: &Condensation,
        hat: &Solvable,
        statics: &AttachmentVectors,
        count: usize,
    ) {
        let room = count.saturating_sub(span.len()).min(self.left.len());
        let taken = self.left.drain(..room).collect();
        let first = span.len();
        span.take(taken, Origin::Anywhere, FrequencyCut::None);
        self.block.extend(span.images_since(first));
        let block = std::mem::take(&mut self.block);
        self.block = recurse(span, rows, hat, statics, block, count, FrequencyCut::None);
    }
}

/// The load-dependent recursion from right-hand sides until `count` vectors are there or nothing new comes; returns
/// those it would go on with.
pub(super) fn recurse(
    span: &mut OrthonormalBasis<'_>,
    rows: &Condensation,
    hat: &Solvable,
    statics: &AttachmentVectors,
    mut block: Vec<Vec<f64>>,
    count: usize,
    cut: FrequencyCut,
) -> Vec<Vec<f64>> {
    while span.len() < count && !block.is_empty() {
        let mut next = Vec::new();
        span.next_block();
        while !block.is_empty() && span.len() < count {
            let rest = block.split_off(block.len().min(count - span.len()).min(BLOCK));
            let solved = solved(rows, hat, statics, std::mem::take(&mut block));
            // Where the loads have shown all they can, what is left of a vector is rounding.
            let first = span.len();
            span.take(solved, Origin::Recursion, cut);
            next.extend(span.images_since(first));
            block = rest;
        }
        block.extend(next);
    }
    block
}

/// K̂⁻¹ of right-hand sides, without what static shapes beside the modes hold of it; of both the rows that are kept.
fn solved(
    rows: &Condensation,
    hat: &Solvable,
    statics: &AttachmentVectors,
    block: Vec<Vec<f64>>,
) -> Vec<Vec<f64>> {
    let order = rows.order();
    let mut x = vec![0.0; order * block.len()];
    x.chunks_mut(order).zip(&block).for_each(|(x, p)| rows.scatter(p, x));
    drop(block);
    let p = if statics.len() > 0 { x.clone() } else { Vec::new() };
    hat.factor.solve(&mut x);
    for (p, x) in p.chunks(order).zip(x.chunks_mut(order)) {
        statics.out_of_answer(|psi| dot(psi, p), x);
    }
    x.chunks(order).map(|x| rows.gather(x).into_owned()).collect()
}

/// Takes what the vectors that are there set in motion, K̂⁻¹ M V, until `count` vectors are there or nothing new comes: sums of
/// all with scattered signs, which hold most of it in few vectors. \[Halko, Martinsson & Tropp 2011, section 4\]
pub(super) fn following(
    span: &mut OrthonormalBasis<'_>,
    rows: &Condensation,
    hat: &Solvable,
    statics: &AttachmentVectors,
    count: usize,
) {
    let known = span.len();
    let mut signs = Signs(SEED);
    for start in (0..known).step_by(BLOCK) {
        let there = span.len();
        let width = BLOCK.min(known - start).min(count - there);
        if width == 0 {
            break;
        }
        let mut sums = Dense::zeros(known, width);
        sums.values_mut().fill_with(|| signs.next());
        let block = span.images_of(&sums);
        let solved = solved(rows, hat, statics, block);
        span.take_until(count, solved, FrequencyCut::Modes);
        if span.len() == there {
            break;
        }
    }
}

/// Scattered signs, the same every time.
struct Signs(u64);

/// Where they begin.
const SEED: u64 = 0x9E37_79B9_7F4A_7C15;

impl Signs {
    fn next(&mut self) -> f64 {
        // \[Marsaglia 2003\]
        self.0 ^= self.0 << 13;
        self.0 ^= self.0 >> 7;
        self.0 ^= self.0 << 17;
        if self.0 >> 63 == 0 { 1.0 } else { -1.0 }
    }
}
