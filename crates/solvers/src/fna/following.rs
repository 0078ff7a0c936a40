//! Static shapes that nothing damps: they follow loads and links at once.
//!
//! ```text
//! κ q = s        q̇₁ = (q₁ − q₀)/Δt + ½ Δt q̈₀        q̈₁ = (q̇₁ − q̇₀)/Δt
//! ```
//!
//! The rate goes on no further than the mean one says it does: see [`rate_at_end`].

use super::modes::Step;
use super::{ModalLoads, Modes};
use crate::structure::{JUMPED, Motion, acceleration, rate_at_end};

impl Modes {
    /// Rates of undamped static shapes at the end of a predicted step: the mean rate of the step, and half a step of the acceleration before, which
    /// makes them right at second order; errors in them die out by 1/√2 a step, whatever the link.
    #[inline]
    pub(super) fn predict_following(&self, now: &ModalLoads, from: &Motion, to: &mut Motion) {
        let n = self.space.order();
        for i in self.structure.undamped.iter().copied() {
            let more = 0.5 * self.size_now().dt * acceleration(from[2 * n + i]);
            // Laws that depend on the rate need it now, others as it is at last.
            to[n + i] = if now.damped[i] {
                rate_at_end(from[n + i], to[n + i], more)
            } else {
                to[n + i] + more
            };
        }
    }

    /// Accelerations of undamped static shapes, and what a load that jumps does to them at once: that is no rate, and nothing takes the
    /// work that it does beyond what their springs hold then, ½ (s₀ − κ q₀) (q₁ − q₀).
    ///
    /// Where a load bends, the rate jumps, and the acceleration before says nothing of the step: it goes on no
    /// further than the mean rate of the step says it does, and not against it.
    #[inline]
    pub(super) fn complete_following(&self, now: &mut ModalLoads, from: &Motion, to: &mut Motion) {
        let n = self.space.order();
        let Step { dt, per_dt, .. } = *self.size_now();
        now.lost = 0.0;
        for i in self.structure.undamped.iter().copied() {
            let jumped = now.sources[i] - self.structure.omega2[i] * from[i];
            now.lost += 0.5 * jumped * (to[i] - from[i]);
            let is_new = from[2 * n + i] == JUMPED;
            if !now.damped[i] && now.linked[i] && is_new {
                // Where links carry a share, only all of them say how far it jumped.
                to[n + i] = from[n + i];
            } else if !now.damped[i] {
                let predicted = 0.5 * dt * acceleration(from[2 * n + i]);
                let mean = to[n + i] - jumped / self.structure.omega2[i] * per_dt - predicted;
                to[n + i] = rate_at_end(from[n + i], mean, predicted);
            }
            // From the rate before a jump, or that of the start, to this one nothing accelerates.
            to[2 * n + i] = if is_new { 0.0 } else { (to[n + i] - from[n + i]) * per_dt };
        }
    }
}
