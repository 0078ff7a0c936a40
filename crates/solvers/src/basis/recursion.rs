//! The load-dependent recursion: K̂ xᵢ₊₁ = M xᵢ, block after block.

use super::attachment::AttachmentVectors;
use super::condensation::Condensation;
use super::link_shapes::LinkShapes;
use super::orthonormal::{FrequencyCut, Origin, OrthonormalBasis};
use super::solvable::{Solvable, block as together};
use crate::vector::dot;
use trilith_linalg::Dense;

/// Takes static shapes of links until `count` vectors are there, and returns their images under M.
pub(super) fn beyond(
    shapes: LinkShapes<'_>,
    span: &mut OrthonormalBasis<'_>,
    count: usize,
) -> Vec<Vec<f64>> {
    let first = span.len();
    for (_, block) in shapes.blocks(&shapes.system.links.active) {
        if span.len() >= count {
            break;
        }
        span.take_until(count, shapes.of(block, |_| true).taken, FrequencyCut::Modes);
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
    let most = together(rows.order());
    while span.len() < count && !block.is_empty() {
        let mut next = Vec::new();
        span.next_block();
        while !block.is_empty() && span.len() < count {
            let rest = block.split_off(block.len().min(count - span.len()).min(most));
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
    let mut x: Vec<Vec<f64>> = block.into_iter().map(|p| rows.scattered(p)).collect();
    let p = if statics.len() > 0 { x.clone() } else { Vec::new() };
    hat.factor.solve_each(&mut x);
    for (p, x) in p.iter().zip(&mut x) {
        statics.out_of_answer(|psi| dot(psi, p), x);
    }
    x.into_iter().map(|x| rows.gathered(x)).collect()
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
    let (mut signs, most) = (Signs(SEED), together(rows.order()));
    for start in (0..known).step_by(most) {
        let there = span.len();
        let width = most.min(known - start).min(count - there);
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
