//! A rigid body in a plane on contact points, turned by a finite angle θ about its centre.
//!
//! ```text
//!   point at (x, z):  x' = x cos θ + z sin θ,  z' = z cos θ − x sin θ     turned from Z to X
//!   F = Σ f,   M = Σ (∂z'/∂θ f_z + ∂x'/∂θ f_x)                           virtual work
//! ```

use super::{At, contact};
use crate::oracle::number::Dual;
use crate::oracle::spec::Rocking;

/// Own unknowns of a point: its anchor.
const OWN: usize = 2;

impl Rocking {
    /// Number of own unknowns.
    pub(super) fn unknowns(&self) -> usize {
        OWN * self.points.len()
    }

    /// A stiffness of the size of the law, along Z, along X and about Y.
    pub(super) fn stiffness(&self) -> Vec<f64> {
        let count = self.points.len() as f64;
        let square: f64 = self.points.iter().map(|[x, _]| x * x).sum();
        let of = &self.contact;
        [count * of.kn, count * of.ks, square * of.kn].map(|k| 0.1 * k).to_vec()
    }

    /// Forces, residuals of the own equations, and the branch of the law.
    pub(super) fn answer(&self, at: &At<'_>, f: &mut [Dual], g: &mut [Dual]) -> u32 {
        let lowest = self.points.iter().fold(f64::INFINITY, |least, [_, z]| least.min(*z));
        let (sin, cos) = at.d[2].sin_cos();
        let (half, _) = (0.5 * at.d[2]).sin_cos();
        // cos θ − 1 without loss of figures.
        let less = -2.0 * (half * half);
        let mut branch = 0;
        f.fill(Dual::default());
        for (i, [x, z]) in self.points.iter().enumerate() {
            let (up, along) = (*z * less - *x * sin, *x * less + *z * sin);
            let (up_by, along_by) = (-(*z * sin) - *x * cos, *z * cos - *x * sin);
            let d = [at.d[0] + up, at.d[1] + along, Dual::default()];
            let v = [at.v[0] + up_by * at.v[2], at.v[1] + along_by * at.v[2], Dual::default()];
            let own = OWN * i..OWN * (i + 1);
            let point = At { d: &d, v: &v, z: &at.z[own.clone()], w: &at.w[own.clone()], ..*at };
            let law = crate::oracle::spec::Contact { opening: z - lowest, ..self.contact };
            let mut force = [Dual::default(); 3];
            branch = 6 * branch + contact(&law, &point, &mut force, &mut g[own]);
            f[0] = f[0] + force[0];
            f[1] = f[1] + force[1];
            f[2] = f[2] + up_by * force[0] + along_by * force[1];
        }
        branch
    }
}
