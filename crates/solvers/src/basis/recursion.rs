//! The load-dependent recursion: K̂ xᵢ₊₁ = M xᵢ, block after block.

use super::attachment::AttachmentVectors;
use super::condensation::Condensation;
use super::orthonormal::{FrequencyCut, Origin, OrthonormalBasis};
use super::solvable::{BLOCK, Solvable};
use crate::vector::dot;
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
    let mut images = Vec::new();
    for block in system.links.active.chunks(BLOCK) {
        if span.len() >= count {
            break;
        }
        hat.static_shapes(system, block, |shapes, _| {
            let own = block.iter().zip(shapes).map(|(link, x)| beside(*link, x)).collect();
            images.extend(span.take_until(count, own, FrequencyCut::Modes));
        });
    }
    images
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
        self.block.extend(span.take(taken, Origin::Anywhere, FrequencyCut::None));
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
    let order = rows.order();
    while span.len() < count && !block.is_empty() {
        let mut next = Vec::new();
        span.next_block();
        while !block.is_empty() && span.len() < count {
            let rest = block.split_off(block.len().min(count - span.len()).min(BLOCK));
            let mut x = vec![0.0; order * block.len()];
            x.chunks_mut(order).zip(&block).for_each(|(x, p)| rows.scatter(p, x));
            drop(block);
            let p = if statics.len() > 0 { x.clone() } else { Vec::new() };
            hat.factor.solve(&mut x);
            for (p, x) in p.chunks(order).zip(x.chunks_mut(order)) {
                statics.out_of_answer(|psi| dot(psi, p), x);
            }
            let solved = x.chunks(order).map(|x| rows.gather(x).into_owned()).collect();
            drop(x);
            // Where the loads have shown all they can, what is left of a vector is rounding.
            next.extend(span.take(solved, Origin::Recursion, cut));
            block = rest;
        }
        block.extend(next);
    }
    block
}
