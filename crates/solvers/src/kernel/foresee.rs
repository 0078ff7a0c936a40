//! The first guess of a step: where the tangents at its start put the forces.

use super::{Affine, Committed, Converged, LinkKernel};
use trilith_model::Kernel;

impl LinkKernel<'_> {
    /// Moves f̃ to where the tangents at the start of the step put it, and what the steps before left
    /// [unforeseen](super::Unforeseen): where every law goes on along its tangents, that is the equilibrium.
    /// False where nothing is foreseen; else deformations and rates must follow the [`change`](Self::change).
    pub(crate) fn foresee(
        &mut self,
        affine: &Affine<'_>,
        from: &Committed<'_>,
        out: &mut Converged<'_>,
    ) -> bool {
        if self.kind != Kernel::Newton {
            return false;
        }
        self.deform(affine, out);
        let change = |now: &[f64], then: &[f64], to: &mut Vec<f64>| {
            to.clear();
            to.extend(now.iter().zip(then).map(|(now, then)| now - then));
        };
        change(out.d, from.d, &mut self.moved);
        self.leave(from.f, out.pseudo);
        let (k, c) = (&from.tangents.k, &from.tangents.c);
        if self.complete {
            self.blocks.mul_add(k, &self.moved, &mut self.residual);
            if !self.rated_blocks.is_empty() {
                change(out.v, from.v, &mut self.moved);
                self.rated_blocks.mul_add(c, &self.moved, &mut self.residual);
            }
        } else {
            self.pull.clear();
            self.pull.resize(self.moved.len(), 0.0);
            self.blocks.mul_add(k, &self.moved, &mut self.pull);
            change(out.v, from.v, &mut self.moved);
            self.rated_blocks.mul_add(c, &self.moved, &mut self.pull);
            for (r, flat) in self.residual.iter_mut().zip(&self.links.active) {
                *r += self.pull[*flat];
            }
        }
        let expected = from.unforeseen.expect(affine.key, &mut self.residual);
        if self.residual.iter().all(|r| *r == 0.0) {
            return false;
        }
        self.newton_correction(affine, from.tangents, false);
        if !self.residual.iter().all(|x| x.is_finite()) {
            self.factors.forget(affine.key);
            return false;
        }
        self.take(out);
        self.expected = expected;
        true
    }
}
