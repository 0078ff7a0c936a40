//! The predictor of a step: where the tangents at its start put the forces.
//!
//! ```text
//! r = f₀ + k₀ (d* − d₀) + c₀ (v* − v₀) − k_e d* − f̃₀ + e        f̃ ← f̃₀ + J₀⁻¹ r        e: extrapolated residual
//! ```

use super::{Affine, Committed, Converged, LinkKernel, active, choose};
use crate::vector::residual;
use trilith_model::Kernel;

impl LinkKernel<'_> {
    /// Moves f̃ to where the tangents at the start of the step put it, with the residual that such predictions left in the
    /// steps before, [extrapolated](super::Extrapolation): where every law goes on along its tangents, that is the
    /// equilibrium. False where nothing has moved; else deformations and rates must follow the [`change`](Self::change).
    #[inline]
    pub(crate) fn predict(
        &mut self,
        affine: &Affine<'_>,
        from: &Committed<'_>,
        out: &mut Converged<'_>,
    ) -> bool {
        if self.kind != Kernel::Newton {
            return false;
        }
        self.deform(affine, out);
        let Self { layout, unknowns, residual: r, correction, .. } = self;
        let of_active = active(layout, from.f, correction);
        residual(of_active, &layout.effective_k, unknowns.d(), unknowns.pseudo(), r);
        let (k, c) = (&from.tangents.k, &from.tangents.c);
        let links = self.layout.links;
        if self.layout.complete {
            let d = choose(self.plain, &self.unknowns, out.d);
            self.blocks.add_change(k, [from.d, d], &mut self.residual);
            self.rate_blocks.add_change(c, [from.v, out.v], &mut self.residual);
        } else {
            self.pull.clear();
            self.pull.resize(links.len(), 0.0);
            self.blocks.add_change(k, [from.d, out.d], &mut self.pull);
            self.rate_blocks.add_change(c, [from.v, out.v], &mut self.pull);
            for (r, flat) in self.residual.iter_mut().zip(&links.active) {
                *r += self.pull[*flat];
            }
        }
        let expected = from.extrapolation.expect(affine.key, &mut self.residual);
        if self.residual.iter().all(|r| *r == 0.0) {
            return false;
        }
        let goes = self.go(affine, from.tangents, false);
        self.expected = expected && goes;
        goes
    }
}
