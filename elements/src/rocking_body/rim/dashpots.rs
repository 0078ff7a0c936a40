//! Dashpots along the arc of a rim that is pressed.

use super::arc::{Arc, Pressed};
use super::{ALL, Motion, Rim};
use crate::shared::dual::Dual;
use crate::shared::spatial::V3;
use std::f64::consts::PI;
use trilith_element::lanes::Real;

/// What the dashpots do at one moment.
pub(super) struct Damped<const N: usize, R> {
    /// Normal force, and the force conjugate to (w₁, w₂).
    pub(super) normal: Dual<N, R>,
    pub(super) q: [Dual<N, R>; 2],
    /// Power, W.
    pub(super) power: R,
}

impl<R: Real> Rim<R> {
    /// Forces of the dashpots.
    #[inline(always)]
    pub(super) fn dashpots<const N: usize>(
        &self,
        m: &Motion<N, R>,
        p: &Pressed<N, R>,
    ) -> Damped<N, R> {
        let (w, arc) = (&m.r[2], &p.arc);
        let two = self.damping.of(2.0);
        let c = self.damping * two.of(0.5 / PI);
        let turning = [
            w[1] * m.spin[2] - w[2] * m.spin[1],
            w[2] * m.spin[0] - w[0] * m.spin[2],
            w[0] * m.spin[1] - w[1] * m.spin[0],
        ];
        let sinking = turning[2] * self.depth + -m.rate[2];
        let low = &arc.low;
        let across = [-low[1], low[0]];
        let first = (turning[0] * low[0] + turning[1] * low[1]) * -self.radius;
        let second = (turning[0] * across[0] + turning[1] * across[1]) * -self.radius;
        let product = arc.sine * arc.cosine;
        let (even, odd) = (arc.half + product, arc.half - product);
        let normal = (sinking * arc.half + first * arc.sine) * (two * c);
        let towards = (sinking * arc.sine * two + first * even) * c;
        let sideways = second * odd * c;
        let power = normal.x * sinking.x + towards.x * first.x + sideways.x * second.x;
        let q = [
            (towards * low[0] + sideways * across[0]) * -self.radius,
            (towards * low[1] + sideways * across[1]) * -self.radius,
        ];
        Damped { normal, q, power }
    }

    /// Tangents of the dashpots by (u̇, Ω): of the normal force and of what is conjugate to (w₁, w₂).
    #[inline(always)]
    pub(super) fn by_rates(&self, w: &V3<R>, arc: &Arc<ALL, R>) -> [[R; 6]; 3] {
        let (zero, two) = (w[0].of(0.0), w[0].of(2.0));
        let (c, rho) = (self.damping * two.of(0.5 / PI), self.radius);
        let low = [arc.low[0].x, arc.low[1].x];
        let across = [-low[1], low[0]];
        let product = arc.sine.x * arc.cosine.x;
        let (even, odd) = (c * (arc.half.x + product), c * (arc.half.x - product));
        let mixed = -(two * c * rho * arc.sine.x);
        // By the sinking of the centre and by the turning (w × Ω)₁, (w × Ω)₂.
        let mut by = [[zero; 3]; 3];
        by[0][0] = two * c * arc.half.x;
        for i in 0..2 {
            by[0][1 + i] = mixed * low[i];
            by[1 + i][0] = mixed * low[i];
            for j in 0..2 {
                by[1 + i][1 + j] =
                    rho * rho * (even * low[i] * low[j] + odd * across[i] * across[j]);
            }
        }
        let h = self.depth;
        let spin = [[-(h * w[1]), h * w[0], zero], [zero, -w[2], w[1]], [w[2], zero, -w[0]]];
        let mut all = [[zero; 6]; 3];
        for i in 0..3 {
            all[i][2] = -by[i][0];
            for j in 0..3 {
                all[i][3 + j] =
                    by[i][0] * spin[0][j] + by[i][1] * spin[1][j] + by[i][2] * spin[2][j];
            }
        }
        all
    }
}
