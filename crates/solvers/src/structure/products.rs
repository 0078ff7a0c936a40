//! Products with the matrices of a space, in few passes over them.
//!
//! ```text
//! C = a₀ M + a₁ K + C′ + U R Uᵀ        K u + C v = K (u + a₁ v) + a₀ M v + C′ v + U R Uᵀ v
//! ```
//!
//! so Rayleigh damping costs no pass of its own; C′, of dashpots, has few entries.

use super::Motion;
use super::reduced_system::ReducedSystem;
use trilith_linalg::SymmetricOperator;

/// M, K and the damping beyond Rayleigh's.
pub(crate) struct Products {
    mass: SymmetricOperator,
    stiffness: SymmetricOperator,
    damping: SymmetricOperator,
    rayleigh: [f64; 2],
}

/// Energies of a step, J; damping in W.
pub(crate) struct Energies {
    /// Kinetic energy and strain energy.
    pub start: [f64; 2],
    pub end: [f64; 2],
    /// Power of damping at a velocity.
    pub damping: f64,
}

impl Products {
    pub(crate) fn new(space: &ReducedSystem) -> Self {
        Self {
            mass: SymmetricOperator::new(&space.mass),
            stiffness: SymmetricOperator::new(&space.stiffness),
            damping: SymmetricOperator::new(&space.damping),
            rayleigh: space.rayleigh,
        }
    }

    /// `p −= K u + C v`. Workspace: `rank` for modal damping, `sum` of the order of the space.
    pub(crate) fn resist(
        &self,
        space: &ReducedSystem,
        u: &[f64],
        v: &[f64],
        rank: &mut [f64],
        sum: &mut [f64],
        p: &mut [f64],
    ) {
        let [a0, a1] = self.rayleigh;
        if a1 == 0.0 {
            self.stiffness.mul_add(-1.0, u, p);
        } else {
            sum.iter_mut().zip(u.iter().zip(v)).for_each(|(s, (u, v))| *s = u + a1 * v);
            self.stiffness.mul_add(-1.0, sum, p);
        }
        if a0 != 0.0 {
            self.mass.mul_add(-a0, v, p);
        }
        self.damping.mul_add(-1.0, v, p);
        if let Some(modal) = &space.modal {
            rank.fill(0.0);
            modal.u.transpose_mul_add(1.0, v, rank);
            rank.iter_mut().zip(&modal.rate).for_each(|(y, r)| *y *= r);
            modal.u.mul_add(-1.0, rank, p);
        }
    }

    /// Energies of two motions, and the power of damping at the velocity `v`.
    pub(crate) fn energies(
        &self,
        space: &ReducedSystem,
        [from, to]: [&Motion; 2],
        v: &[f64],
        rank: &mut [f64],
    ) -> Energies {
        let n = v.len();
        let [a0, a1] = self.rayleigh;
        let ([u0, u1], [v0, v1]) = ([&from[..n], &to[..n]], [&from[n..2 * n], &to[n..2 * n]]);
        let [k0, k1, mass] = self.mass.forms(|i| [v0[i], v1[i], v[i]]);
        let ([e0, e1], stiff) = if a1 == 0.0 {
            (self.stiffness.forms(|i| [u0[i], u1[i]]), 0.0)
        } else {
            let [e0, e1, stiff] = self.stiffness.forms(|i| [u0[i], u1[i], v[i]]);
            ([e0, e1], stiff)
        };
        let [rest] = self.damping.forms(|i| [v[i]]);
        let mut damping = a0 * mass + a1 * stiff + rest;
        if let Some(modal) = &space.modal {
            rank.fill(0.0);
            modal.u.transpose_mul_add(1.0, v, rank);
            damping += rank.iter().zip(&modal.rate).map(|(y, r)| r * y * y).sum::<f64>();
        }
        Energies { start: [0.5 * k0, 0.5 * e0], end: [0.5 * k1, 0.5 * e1], damping }
    }
}
