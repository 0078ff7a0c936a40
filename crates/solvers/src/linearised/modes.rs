//! Modes of the linearised structure.
//!
//! ```text
//! (K_l − ω² M) φ = 0,  φᵀ M φ = 1        Γ = φᵀ M r        share of mass: Γ² / rᵀ M r
//! ξ = Σ E_D (B φ)² / D² / 2π ω²                             (over the cycles of amplitude D)
//! ```

use super::Linearised;
use crate::error::SolveError;
use crate::vector::dot;
use std::f64::consts::TAU;
use trilith_linalg::{Dense, Ldlt, Sparse, lowest_modes};

/// Eigenvalues below this share of the scale are motions without stiffness.
const FREE: f64 = 1e-8;
/// How far below zero the shift goes, in turns, as a share of the scale; the structure may be unstable by so much.
const SHIFTS: [f64; 5] = [1e-3, 1e-1, 1e1, 1e3, 1e5];

/// The lowest modes of a structure with linear links.
#[derive(Clone, Debug)]
pub struct LinearModes {
    /// ω², rad²/s², rising; 0: free; negative: the structure falls that way.
    pub omega2: Vec<f64>,
    /// M-orthonormal shapes on the free DOFs, a column each.
    pub shapes: Dense,
    /// Γ along X, Y, Z, √kg.
    pub participation: Vec<[f64; 3]>,
    /// Mass that may move along X, Y, Z, kg.
    pub mass: [f64; 3],
    /// Share of it.
    pub mass_share: Vec<[f64; 3]>,
    /// Damping ratio that the cycles of the links give; 0 without cycles.
    pub damping: Vec<f64>,
}

impl Linearised<'_> {
    /// So many of the lowest modes, or all there are.
    ///
    /// # Errors
    /// [`SolveError::NoMass`] without mass, [`SolveError::Linalg`] where the structure has no modes.
    pub fn modes(&self, count: usize) -> Result<LinearModes, SolveError> {
        let system = self.system;
        if system.idle || system.mass.diagonal().iter().all(|m| *m <= 0.0) {
            return Err(SolveError::NoMass);
        }
        let k = self.stiffness();
        let sum = |d: Vec<f64>| d.iter().map(|x| x.abs()).sum::<f64>();
        let scale = 1e-6 * sum(k.diagonal()) / sum(system.mass.diagonal());
        // Where nothing holds anything, any scale will do.
        let scale = if scale > 0.0 { scale } else { 1.0 };
        // The shift must lie below all: K − σM is positive definite.
        let is_below = |sigma: &f64| {
            let shifted = Sparse::combine(&[(1.0, &k), (-sigma, &system.mass)]);
            Ldlt::new(&shifted).is_ok_and(|factor| factor.negative_pivots() == 0)
        };
        let sigma = SHIFTS.iter().map(|share| -share * scale).find(is_below);
        let sigma = sigma.ok_or(SolveError::NoModes)?;
        let (mut omega2, shapes) = lowest_modes(&k, &system.mass, count, sigma)?;
        let lowest = omega2.iter().copied().find(|w| *w > FREE * scale).unwrap_or(scale);
        omega2.iter_mut().filter(|w| w.abs() <= FREE * lowest).for_each(|w| *w = 0.0);
        let participation: Vec<[f64; 3]> = (0..omega2.len())
            .map(|j| [0, 1, 2].map(|axis: usize| dot(shapes.column(j), &system.inertia[axis])))
            .collect();
        let mass = [0, 1, 2].map(|axis| system.mass_along(axis));
        let share = |gamma: &[f64; 3]| {
            [0, 1, 2]
                .map(|a: usize| if mass[a] > 0.0 { gamma[a] * gamma[a] / mass[a] } else { 0.0 })
        };
        let mass_share = participation.iter().map(share).collect();
        let damping =
            (0..omega2.len()).map(|j| self.cycle_damping(shapes.column(j), omega2[j])).collect();
        Ok(LinearModes { omega2, shapes, participation, mass, mass_share, damping })
    }

    fn cycle_damping(&self, shape: &[f64], omega2: f64) -> f64 {
        if self.secants.is_empty() || omega2 <= 0.0 {
            return 0.0;
        }
        let (d, _) = self.links_under(shape);
        let of = |s: &super::Secant| s.heat * (d[s.flat] / s.amplitude).powi(2);
        self.secants.iter().map(of).sum::<f64>() / (TAU * omega2)
    }
}
