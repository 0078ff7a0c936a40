//! Static shapes of links: what a unit force along a link coordinate bends, K̂⁻¹ bᵀ.

use super::attachment::AttachmentVectors;
use super::condensation::Condensation;
use super::solvable::{Solvable, block};
use trilith_system::System;

/// What makes static shapes of links.
#[derive(Clone, Copy)]
pub(super) struct LinkShapes<'a> {
    pub(super) system: &'a System,
    pub(super) rows: &'a Condensation,
    pub(super) hat: &'a Solvable,
    pub(super) statics: &'a AttachmentVectors,
}

/// A block of link coordinates on the way into a basis.
pub(super) struct OfLinks {
    /// b K̂⁻¹ bᵀ of each.
    pub(super) flexibility: Vec<f64>,
    /// Shapes of those that are taken: the rows that are kept, without what static shapes beside the modes hold of them.
    pub(super) taken: Vec<Vec<f64>>,
}

impl LinkShapes<'_> {
    /// Blocks of these link coordinates with the place of the first of each.
    pub(super) fn blocks<'b>(
        &self,
        links: &'b [usize],
    ) -> impl Iterator<Item = (usize, &'b [usize])> {
        let size = block(self.system.order());
        links.chunks(size).enumerate().map(move |(i, block)| (i * size, block))
    }

    /// Of a block, which of them are taken by their places in it.
    pub(super) fn of(&self, block: &[usize], is_taken: impl Fn(usize) -> bool) -> OfLinks {
        let (shapes, flexibility) = self.hat.static_shapes(self.system, block);
        let all = block.iter().zip(shapes).enumerate().filter(|(i, _)| is_taken(*i));
        OfLinks { taken: all.map(|(_, (link, x))| self.beside(*link, x)).collect(), flexibility }
    }

    fn beside(&self, link: usize, mut x: Vec<f64>) -> Vec<f64> {
        let row = &self.system.links.rows[link];
        self.statics.out_of_answer(|psi| row.iter().map(|(j, c)| c * psi[*j]).sum(), &mut x);
        self.rows.gathered(x)
    }
}
