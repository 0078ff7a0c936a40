//! Pounding: springs with dissipation after a clearance.
//!
//! ```text
//!   δ = −(d + g),   N = k δ + c δ̇                          Kelvin, or c on approach alone
//!                   N = k δⁿ + 2 ξ √(m k δⁿ⁻¹) δ̇           on approach, else k δⁿ   [Jankowski 2005]
//!                   N = k δⁿ (1 + ξ δ̇/s)                   s: speed at first touch  [Muthukumar & DesRoches 2006]
//! ```
//!
//! The speed at first touch is an own unknown: it follows the speed while open and stays while closed.

use super::At;
use crate::oracle::number::Dual;
use crate::oracle::spec::{Hertz, Kelvin};

impl Kelvin {
    /// Force, and the branch of the law.
    pub(super) fn answer(&self, at: &At<'_>, f: &mut Dual) -> u32 {
        let depth = -(at.d[0] + self.opening.into());
        *f = Dual::default();
        if depth.0 < 0.0 {
            return 0;
        }
        let speed = -at.v[0];
        let damps = !at.still && (!self.approach || speed.0 > 0.0);
        let dash = if damps { self.c * speed } else { Dual::default() };
        let force = self.k * depth + dash;
        *f = if self.pull { -force } else { -force.above_zero() };
        1 + u32::from(damps) + 2 * u32::from(!self.pull && force.0 < 0.0)
    }
}

impl Hertz {
    /// Force, residual of the own equation, and the branch of the law.
    pub(super) fn answer(&self, at: &At<'_>, f: &mut Dual, g: &mut [Dual]) -> u32 {
        let depth = -(at.d[0] + self.opening.into());
        let speed = if at.still { Dual::default() } else { -at.v[0] };
        let open = depth.0 < 0.0;
        if let (Some(g), Some(z), Some(w)) = (g.first_mut(), at.z.first(), at.w.first()) {
            *g = at.creep * *w + if open { *z - speed } else { Dual::default() };
        }
        *f = Dual::default();
        if open {
            return 0;
        }
        let elastic = self.k * depth.signed_power(self.n);
        if self.slowest > 0.0 {
            let least = Dual::from(self.slowest);
            let touch = at.z.first().copied().filter(|s| s.0 > self.slowest).unwrap_or(least);
            let force = elastic * (Dual::from(1.0) + self.xi * (speed / touch));
            *f = -force.above_zero();
            return 1 + u32::from(force.0 < 0.0);
        }
        let mut force = elastic;
        if speed.0 > 0.0 {
            let slope = (self.mass * self.k) * depth.signed_power(self.n - 1.0);
            force = force + 2.0 * self.xi * slope.root() * speed;
        }
        *f = -force;
        1 + u32::from(speed.0 > 0.0)
    }
}
