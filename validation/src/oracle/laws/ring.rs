//! Ring spring: f = k (d − s) between two lines through −u₀, of slopes k₁ and k₂; s slips on them, stays where the
//! rings are closed, and is nothing where the lines lie beyond k d. [Filiatrault, Tremblay & Kar 2000]

use super::At;
use crate::oracle::number::Dual;
use crate::oracle::spec::Ring;

impl Ring {
    /// Force, residual of the own equation, and the branch of the law.
    pub(super) fn answer(&self, at: &At<'_>, f: &mut Dual, g: &mut Dual) -> u32 {
        let (d, s) = (at.d[0], at.z[0]);
        *f = self.k * (d - s);
        *g = at.creep * at.w[0];
        let side = if d.0 < 0.0 { -1.0 } else { 1.0 };
        let (depth, slip) = (side * d, side * s);
        if depth.0 > self.us {
            return 0;
        }
        let line = |slope: f64| {
            let at = (slope / self.k) * (depth + self.u0.into());
            if at.0 < depth.0 { at } else { depth }
        };
        let stretch = depth - slip;
        let over = (stretch - line(self.k1)).above_zero();
        let under = (line(self.k2) - stretch).above_zero();
        *g = *g - side * (over - under);
        let branch = if over.0 > 0.0 { 1 } else { 2 * u32::from(under.0 > 0.0) };
        1 + branch + 3 * u32::from(side < 0.0)
    }

    /// Slip after a slow, straight deformation from rest.
    pub(super) fn thrown(&self, d: f64) -> f64 {
        let depth = d.abs().min(self.us);
        let held = depth.min(self.k1 / self.k * (depth + self.u0));
        d.signum() * (depth - held)
    }
}
