//! Smooth hysteresis: one axis that loses strength and stiffness, and two axes that share one strength.
//!
//! ```text
//!   ż = (ḋ/d_y) [A − ν |z|ⁿ (γ + β sgn(ḋ z))]/η,   ε̇ = z ḋ/d_y          [Baber & Wen 1981]
//!   żᵢ = ωᵢ − zᵢ Σⱼ aⱼ ωⱼ zⱼ,   ωⱼ = ḋⱼ/yⱼ,   aⱼ = 1 where ḋⱼ zⱼ > 0     [Park, Wen & Ang 1986]
//! ```

use super::At;
use crate::oracle::number::Dual;
use crate::oracle::spec::{Degrading, Shear};

impl Degrading {
    /// Rates of z and of ε over that of d/d_y.
    fn rates(&self, z: Dual, e: Dual, loading: bool) -> [Dual; 2] {
        let one = Dual::from(1.0);
        let a = Dual::from(self.a0) - self.delta_a * e;
        let least = 0.01 * self.a0;
        let a = if a.0 < least { least.into() } else { a };
        let shape = self.gamma + if loading { self.beta } else { -self.beta };
        let size = if z.0 < 0.0 { -z } else { z };
        let worn = (one + self.delta_nu * e) * (shape * size.signed_power(self.n));
        [(a - worn) / (one + self.delta_eta * e), z]
    }

    /// Force, residuals of the own equations, and the branch of the law.
    pub(super) fn answer(&self, at: &At<'_>, f: &mut Dual, g: &mut [Dual]) -> u32 {
        let (z, e) = (at.z[0], at.z[1]);
        *f = self.alpha * self.k * at.d[0] + (1.0 - self.alpha) * self.k * self.dy * z;
        let loading = at.v[0].0 * z.0 > 0.0;
        let rates = self.rates(z, e, loading);
        for i in 0..2 {
            g[i] = at.w[i] - (1.0 / self.dy) * at.v[0] * rates[i];
        }
        u32::from(loading)
    }

    /// z and ε after a slow, straight deformation from rest.
    pub(super) fn thrown(&self, d: f64) -> Vec<f64> {
        let sign = d.signum();
        let rate = |x: [f64; 2]| self.rates(x[0].into(), x[1].into(), true).map(|r| r.0);
        let [z, e] = straight([0.0; 2], d.abs() / self.dy, &rate);
        vec![sign * z, e]
    }
}

impl Shear {
    /// Forces, residuals of the own equations, and the branch of the law.
    pub(super) fn answer(&self, at: &At<'_>, f: &mut [Dual], g: &mut [Dual]) -> u32 {
        // Axial spring first, where there is one.
        let first = f.len() - 2;
        if first == 1 {
            f[0] = self.axial * at.d[0];
        }
        let (mut turn, mut branch) = (Dual::default(), 0);
        let omega = [0, 1].map(|i| (1.0 / self.yields[i]) * at.v[first + i]);
        for i in 0..2 {
            let loading = omega[i].0 * at.z[i].0 > 0.0;
            branch = 2 * branch + u32::from(loading);
            if loading {
                turn = turn + omega[i] * at.z[i];
            }
        }
        for i in 0..2 {
            f[first + i] = self.elastic[i] * at.d[first + i] + self.strength[i] * at.z[i];
            g[i] = at.w[i] - omega[i] + at.z[i] * turn;
        }
        branch
    }

    /// z after a slow, straight deformation from rest.
    pub(super) fn thrown(&self, d: &[f64]) -> Vec<f64> {
        let d = &d[d.len() - 2..];
        let omega = [0, 1].map(|i| d[i] / self.yields[i]);
        let rate = |z: [f64; 2]| {
            let turn: f64 = (0..2).map(|i| omega[i] * z[i]).filter(|x| *x > 0.0).sum();
            [0, 1].map(|i| omega[i] - z[i] * turn)
        };
        straight([0.0; 2], 1.0, &rate).to_vec()
    }
}

/// End of dx/ds = rate(x) from 0 to `length`, by the classical Runge–Kutta method.
pub(super) fn straight<const N: usize>(
    from: [f64; N],
    length: f64,
    rate: &dyn Fn([f64; N]) -> [f64; N],
) -> [f64; N] {
    let steps = 4000;
    let h = length / f64::from(steps);
    let ahead = |x: [f64; N], r: [f64; N], h: f64| std::array::from_fn(|i| x[i] + h * r[i]);
    (0..steps).fold(from, |x, _| {
        let a = rate(x);
        let b = rate(ahead(x, a, 0.5 * h));
        let c = rate(ahead(x, b, 0.5 * h));
        let d = rate(ahead(x, c, h));
        std::array::from_fn(|i| x[i] + h / 6.0 * (a[i] + 2.0 * (b[i] + c[i]) + d[i]))
    })
}
