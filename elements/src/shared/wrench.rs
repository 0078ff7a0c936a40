//! What a law does to one body.

use super::lever::Carried;
use super::spatial::{M3, V3, cross, cross_matrix};
use nalgebra::SMatrix;
use trilith_element::lanes::Real;
use trilith_element::{Energy, Response};

/// Force (global axes) and moment (axes of the body) on a node with their tangents by its displacement, turn, velocity
/// and spin, and energies.
#[derive(Default)]
pub(crate) struct Wrench {
    pub f: [f64; 6],
    pub k: SMatrix<f64, 6, 6>,
    pub c: SMatrix<f64, 6, 6>,
    pub energy: Energy,
}

impl Wrench {
    /// What is carried to the node, and energies.
    pub fn new(it: &Carried<f64>, energy: Energy) -> Self {
        let of = |m: &[[f64; 6]; 6]| SMatrix::from_fn(|i, j| m[i][j]);
        Self { f: it.f, k: of(&it.k), c: of(&it.c), energy }
    }

    /// Adds energies.
    pub fn count(&mut self, energy: &Energy) {
        self.energy.stored += energy.stored;
        self.energy.hysteretic += energy.hysteretic;
        self.energy.viscous += energy.viscous;
    }

    /// It as the answer of a law with one node.
    pub fn write(&self, out: &mut Response<'_>) {
        out.f.copy_from_slice(&self.f);
        for i in 0..6 {
            for j in 0..6 {
                out.k[6 * i + j] = self.k[(i, j)];
                out.c[6 * i + j] = self.c[(i, j)];
            }
        }
        *out.energy = self.energy;
    }
}

/// Ω × J Ω of a body with moments of inertia J at a spin Ω, and its derivative by Ω.
#[inline(always)]
pub(crate) fn gyroscopic<R: Real>(inertia: &V3<R>, spin: &V3<R>) -> (V3<R>, M3<R>) {
    let mut momentum = *spin;
    let mut by_spin = cross_matrix(spin);
    for j in 0..3 {
        momentum[j] = inertia[j] * spin[j];
        for row in &mut by_spin {
            row[j] = row[j] * inertia[j];
        }
    }
    let own = cross_matrix(&momentum);
    for i in 0..3 {
        for j in 0..3 {
            by_spin[i][j] = by_spin[i][j] - own[i][j];
        }
    }
    (cross(spin, &momentum), by_spin)
}

/// The same added to what a law answers for its rotations, which are the
/// coordinates from `first` on of `n`.
pub(crate) fn add_gyroscopic(
    inertia: [f64; 3],
    spin: &[f64],
    first: usize,
    out: &mut Response<'_>,
) {
    let (moment, by_spin) = gyroscopic(&inertia, &[spin[0], spin[1], spin[2]]);
    let n = out.f.len();
    for i in 0..3 {
        out.f[first + i] += moment[i];
        for j in 0..3 {
            out.c[n * (first + i) + first + j] += by_spin[i][j];
        }
    }
}
