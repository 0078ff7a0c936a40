//! The law of a sliding bearing with a concave surface of small slopes.
//!
//! ```text
//!   N = −kₙ d₁ where it is pressed, else 0,   q = kₛ (d − z),   |q| ≤ μ(|ż|) N
//!   f₁ = −N,   f = q + N d/R,   μ(v) = μ_fast − (μ_fast − μ_slow) e^(−r v)
//! ```
//!
//! What slides is the anchor z, and its rate is the velocity of sliding that the coefficient hangs on.
//! [Zayas, Low & Mahin 1990; Constantinou, Mokha & Reinhorn 1990]

use super::{At, friction, slip};
use crate::oracle::number::Dual;
use crate::oracle::spec::Pendulum;

impl Pendulum {
    /// A stiffness of the size that the law has, for each coordinate.
    pub(super) fn stiffness(&self) -> Vec<f64> {
        vec![0.1 * self.kn, 0.1 * self.ks, 0.1 * self.ks]
    }

    /// Forces, residuals of the own equations, and the branch of the law.
    pub(super) fn answer(&self, at: &At<'_>, f: &mut [Dual], g: &mut [Dual]) -> u32 {
        let normal = self.kn * (-at.d[0]).above_zero();
        f[0] = -normal;
        let mu = |v: Dual| friction(&[self.slow, self.fast, self.rate], v, at.still);
        let slips = slip(self.ks, &|v| mu(v) * normal, at, &at.d[1..], &mut f[1..], g);
        for i in 0..2 {
            f[i + 1] = f[i + 1] + (1.0 / self.radius) * normal * at.d[i + 1];
        }
        2 * slips + u32::from(at.d[0].0 <= 0.0)
    }
}
