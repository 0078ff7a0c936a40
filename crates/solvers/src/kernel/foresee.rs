//! The first guess of a step: where the tangents at its start put the forces.

use super::{Affine, Committed, Converged, LinkKernel};
use trilith_model::Kernel;
use trilith_system::LinkInstance;

/// The tangent of the force of an active coordinate by a flat coordinate.
pub(super) struct Pair {
    active: usize,
    other: usize,
    /// Its index in the tangents.
    at: usize,
}

/// All of a link; `place` is the active index of each flat coordinate.
pub(super) fn pairs<'a>(
    link: &'a LinkInstance,
    place: &'a [usize],
) -> impl Iterator<Item = Pair> + 'a {
    let n = link.range.len();
    let all = link.range.clone().enumerate().flat_map(move |(i, flat)| {
        let others = link.range.clone().enumerate();
        others.map(move |(j, other)| (place[flat], other, link.block.start + i * n + j))
    });
    all.filter(|(active, ..)| *active != usize::MAX).map(|(active, other, at)| Pair {
        active,
        other,
        at,
    })
}

impl LinkKernel<'_> {
    /// Moves f̃ to where the tangents at the start of the step put it: where every law goes on along them,
    /// that is the equilibrium. False where nothing is foreseen; else deformations and rates must follow the
    /// [`change`](Self::change).
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
        for Pair { active, other, at } in &self.pairs {
            self.residual[*active] += from.tangents.k[*at] * self.moved[*other];
        }
        if !self.rated_pairs.is_empty() {
            change(out.v, from.v, &mut self.moved);
        }
        for Pair { active, other, at } in &self.rated_pairs {
            self.residual[*active] += from.tangents.c[*at] * self.moved[*other];
        }
        if self.residual.iter().all(|r| *r == 0.0) {
            return false;
        }
        self.newton_correction(affine, from.tangents, false);
        if !self.residual.iter().all(|x| x.is_finite()) {
            self.factors.forget(affine.key);
            return false;
        }
        self.take(out);
        true
    }
}
