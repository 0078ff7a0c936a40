//! Bearings that slide: pressed and pulled, and on four concave surfaces one above the other.
//!
//! ```text
//!   f₁ = kₙ (d₁ + g_c) + c ḋ₁ pressed, kₜ (d₁ − g_t) + c ḋ₁ pulled, never against the contact;  N = |f₁|
//!   |q| ≤ μ N,   f = q − f₁ u/R                                               [Roussis & Constantinou 2006]
//!
//!   F = N wᵢ/Rᵢ + qᵢ + stop(wᵢ) of every surface,   Σ wᵢ = u,   |qᵢ| ≤ μᵢ N     [Fenz & Constantinou 2008]
//! ```

use super::{At, friction, slip};
use crate::oracle::number::Dual;
use crate::oracle::spec::{Tension, Triple};

impl Tension {
    /// Forces, residuals of the own equations, and the branch of the law.
    pub(super) fn answer(&self, at: &At<'_>, f: &mut [Dual], g: &mut [Dual]) -> u32 {
        let dash = if at.still { Dual::default() } else { self.c * at.v[0] };
        let (pressed, pulled) = (at.d[0] + self.gaps[0].into(), at.d[0] - self.gaps[1].into());
        let (mut along, mut side) = (Dual::default(), 0);
        if pressed.0 <= 0.0 {
            let force = self.stiff[0] * pressed + dash;
            (along, side) = (-(-force).above_zero(), 1 + u32::from(force.0 > 0.0));
        } else if pulled.0 >= 0.0 {
            let force = self.stiff[1] * pulled + dash;
            (along, side) = (force.above_zero(), 3 + u32::from(force.0 < 0.0));
        }
        f[0] = along;
        let normal = if along.0 < 0.0 { -along } else { along };
        let mu = &self.friction[usize::from(side > 2)];
        let limit = |rate: Dual| friction(mu, rate, at.still) * normal;
        let slips = slip(self.ks, &limit, at, &at.d[1..], &mut f[1..], g);
        if normal.0 == 0.0 {
            // What is left is the creep of the anchor.
            f[1..].fill(Dual::default());
        } else if self.radius > 0.0 {
            for i in 1..3 {
                f[i] = f[i] - (1.0 / self.radius) * along * at.d[i];
            }
        }
        5 * slips + side
    }
}

impl Triple {
    /// Radii of the ways of the four surfaces.
    fn ways(&self) -> [f64; 4] {
        let [a, b, c, d] = self.radii;
        [a - b, b, c, d - c]
    }

    /// Ways to the four rims; 0: none.
    fn rims(&self) -> [f64; 4] {
        let [a, b, c, d] = self.radii;
        let [p, q, r, s] = self.capacities;
        let beside =
            |own: f64, other: f64, share: f64| if own > 0.0 { own + other * share } else { 0.0 };
        [p * (1.0 - b / a), beside(q, p, b / a), beside(r, s, c / d), s * (1.0 - c / d)]
    }

    /// Forces, residuals of the own equations, and the branch of the law. Own unknowns: ways of the first three surfaces,
    /// anchors of all.
    pub(super) fn answer(&self, at: &At<'_>, f: &mut [Dual], g: &mut [Dual]) -> u32 {
        let normal = self.kn * (-at.d[0]).above_zero();
        f[0] = -normal;
        let (ways, rims) = (self.ways(), self.rims());
        let mut w = [[Dual::default(); 2]; 4];
        for x in 0..2 {
            w[3][x] = at.d[1 + x];
            for i in 0..3 {
                w[i][x] = at.z[2 * i + x];
                w[3][x] = w[3][x] - w[i][x];
            }
        }
        let mut forces = [[Dual::default(); 2]; 4];
        let (mut branch, mut at_rim) = (u32::from(at.d[0].0 <= 0.0), false);
        for i in 0..4 {
            let own = 6 + 2 * i..8 + 2 * i;
            let anchor = At { z: &at.z[own.clone()], w: &at.w[own.clone()], ..*at };
            let limit = |rate: Dual| friction(&self.friction[i], rate, at.still) * normal;
            let slips = slip(self.ks, &limit, &anchor, &w[i], &mut forces[i], &mut g[own]);
            let length = (w[i][0] * w[i][0] + w[i][1] * w[i][1]).root();
            let stopped = rims[i] > 0.0 && length.0 > rims[i];
            at_rim |= stopped;
            for x in 0..2 {
                forces[i][x] = forces[i][x] + (1.0 / ways[i]) * normal * w[i][x];
                if stopped {
                    let beyond = self.stop * (length - rims[i].into());
                    forces[i][x] = forces[i][x] + beyond * (w[i][x] / length);
                }
            }
            branch = 4 * branch + 2 * u32::from(stopped) + slips;
        }
        // Lifted, the parts share further motion as their radii, up to their rims.
        let lifted = normal.0 == 0.0 && !at_rim;
        let all: f64 = ways.iter().sum();
        for x in 0..2 {
            f[1 + x] = forces[3][x];
            for i in 0..3 {
                let own = 2 * i + x;
                g[own] = if lifted {
                    at.creep * (at.w[own] - (ways[i] / all) * at.v[1 + x])
                } else {
                    (1.0 / self.ks) * (forces[i][x] - forces[3][x])
                };
            }
        }
        branch
    }
}
