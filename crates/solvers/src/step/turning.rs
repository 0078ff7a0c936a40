//! Where the motion of a link turns inside a step: its law is evaluated there.
//!
//! A law sees the ends of a step. A friction contact that comes to rest and slips back within one has moved
//! forward on the whole, and its law tells the force of slip forward; two halves say the same where it turns in the
//! second. So a step at whose end a deformation runs against the way it made is evaluated again:
//!
//! ```text
//! d(s) = d₀ + v₀ s + (v₁ − v₀) s²/(2 Δt)      v₀ = 2 (d₁ − d₀)/Δt − v₁      it turns at s = Δt − τ
//! τ = Δt |v₁| / (|v₀| + |v₁|)
//! ```
//!
//! The law goes from the start to the turning point and from there to the end. What its forces are away from
//! those of the step, at the end or, beyond the tangents of the end, at the turning point, has acted for τ. That
//! impulse p = δf τ is an error of the velocity; its energy is ½ p²/m, with the mass 1/m = 2 Hᵢᵢ/Δt that the step
//! itself shows there. Beyond the step, a force that is off at its end stays so until the link slips again: the energy
//! ½ δf²/k of that force on the spring of the link counts as well, as far as the link has come since it turned.

use super::state::State;
use crate::kernel::{ForceScale, LawResponse};
use trilith_element::Kinematics;
use trilith_system::{Laws, LinkSet};

/// Room for one link.
#[derive(Default)]
pub(crate) struct Turning {
    d: Vec<f64>,
    v: Vec<f64>,
    v0: Vec<f64>,
    there: LawResponse,
    after: LawResponse,
    apart: Vec<f64>,
    /// Largest force, of translations and of rotations, that the last evaluation found off at the end of a step, N and N·m.
    pub behind: ForceScale,
}

impl Turning {
    /// Energy of the impulses that a step of length `dt` has missed, J; `rates` at its end and `softness` Hᵢᵢ of all
    /// link coordinates, which is 0 where the structure cannot follow.
    pub(crate) fn missed(
        &mut self,
        laws: &Laws<'_>,
        links: &LinkSet,
        from: &State,
        to: &State,
        rates: &[f64],
        softness: &[f64],
        dt: f64,
    ) -> f64 {
        let mut energy = 0.0;
        self.behind = [0.0; 2];
        for (law, link) in laws.iter().filter(|(law, _)| law.damping_constant().is_none()) {
            let r = link.range.clone();
            let turns = |i: &usize| {
                let start = 2.0 * (to.d[*i] - from.d[*i]) / dt - rates[*i];
                softness[*i] > 0.0 && start * rates[*i] < 0.0
            };
            for i in r.clone().filter(turns) {
                let n = r.len();
                self.v0.clear();
                self.v0.extend(r.clone().map(|j| 2.0 * (to.d[j] - from.d[j]) / dt - rates[j]));
                let (start, end) = (self.v0[i - r.start].abs(), rates[i].abs());
                let left = dt * end / (start + end);
                let s = dt - left;
                self.d.clear();
                self.v.clear();
                for (j, v0) in r.clone().zip(&self.v0) {
                    let slope = (rates[j] - v0) / dt;
                    self.d.push(from.d[j] + s * (v0 + 0.5 * slope * s));
                    self.v.push(v0 + slope * s);
                }
                let committed = &from.history[link.history.clone()];
                let (d0, d1) = (&from.d[r.clone()], &to.d[r.clone()]);
                let at = Kinematics::new([&self.d, &self.v], [d0, &self.v0], s);
                self.there.of((law, link), &at, committed);
                // At the turning point, beyond what the tangents at the end say.
                let (k1, c1) =
                    (&to.tangents.k[link.block.clone()], &to.tangents.c[link.block.clone()]);
                self.apart.clear();
                for (row, f) in self.there.f.iter().enumerate() {
                    let mut expected = to.f[r.start + row];
                    for j in 0..n {
                        expected += k1[row * n + j] * (self.d[j] - d1[j]);
                        expected += c1[row * n + j] * (self.v[j] - rates[r.start + j]);
                    }
                    self.apart.push((f - expected).abs());
                }
                let (d0, v0) = (&self.d[..], &self.v[..]);
                let at = Kinematics::new([d1, &rates[r.clone()]], [d0, v0], left);
                self.after.of((law, link), &at, &self.there.history);
                for (j, flat) in r.clone().enumerate() {
                    let behind = (self.after.f[j] - to.f[flat]).abs();
                    let most = &mut self.behind[usize::from(links.rotational[flat])];
                    *most = most.max(behind);
                    let missed = self.apart[j].max(behind) * left;
                    let way = (d1[j] - self.d[j]).abs();
                    let kept = 0.5 * behind * way.min(behind / self.after.k[j * n + j].abs());
                    energy += (missed * missed * softness[flat] / dt).max(kept);
                }
            }
        }
        energy
    }
}
