//! What a law does to one body.

use nalgebra::{Matrix3, SMatrix, Vector3};
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

/// Ω × J Ω of a body with moments of inertia J at a spin Ω, added to what a law answers for its rotations, which are the
/// coordinates from `first` on of `n`.
pub(crate) fn add_gyroscopic(
    inertia: [f64; 3],
    spin: &[f64],
    first: usize,
    out: &mut Response<'_>,
) {
    let inertia = Matrix3::from_diagonal(&Vector3::from(inertia));
    let spin = Vector3::new(spin[0], spin[1], spin[2]);
    let momentum = inertia * spin;
    let moment = spin.cross(&momentum);
    let by_spin = spin.cross_matrix() * inertia - momentum.cross_matrix();
    let n = out.f.len();
    for i in 0..3 {
        out.f[first + i] += moment[i];
        for j in 0..3 {
            out.c[n * (first + i) + first + j] += by_spin[(i, j)];
        }
    }
}
