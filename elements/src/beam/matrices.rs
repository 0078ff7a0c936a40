//! Stiffness and mass of the [`Beam`] in local axes.

use super::{Beam, MassMatrix, Section, Stiffened};
use nalgebra::DMatrix;
use trilith_element::{Axis, ParameterError};

/// DOFs of one bending plane: deflections and rotations at i and j, and the sign of the rotation
/// (about local 3 the rotation is w′, about local 2 it is −w′).
pub(super) const IN_12: ([usize; 4], f64) = ([1, 5, 7, 11], 1.0);
pub(super) const IN_13: ([usize; 4], f64) = ([2, 4, 8, 10], -1.0);

fn add(to: &mut DMatrix<f64>, dofs: &[usize], signs: &[f64], values: &[f64]) {
    let n = dofs.len();
    for i in 0..n {
        for j in 0..n {
            to[(dofs[i], dofs[j])] += signs[i] * signs[j] * values[i * n + j];
        }
    }
}

fn in_plane(to: &mut DMatrix<f64>, (dofs, sign): ([usize; 4], f64), values: &[f64; 16]) {
    add(to, &dofs, &[1.0, sign, 1.0, sign], values);
}

/// Stiffness of bending with Φ; E I, length. \[Przemieniecki 1968, eq. 5.116\]
fn bending(ei: f64, phi: f64, l: f64) -> [f64; 16] {
    let f = ei / (l.powi(3) * (1.0 + phi));
    let (a, b) = ((4.0 + phi) * l * l, (2.0 - phi) * l * l);
    let (s, t) = (12.0, 6.0 * l);
    [s, t, -s, t, t, a, -t, b, -s, -t, s, -t, t, b, -t, a].map(|x| f * x)
}

/// Geometric stiffness of an axial force (tension positive) with cubic shapes. \[Przemieniecki 1968, eq. 15.34\]
fn geometric(tension: f64, l: f64) -> [f64; 16] {
    let f = tension / (30.0 * l);
    let (s, t, a, b) = (36.0, 3.0 * l, 4.0 * l * l, -l * l);
    [s, t, -s, t, t, a, -t, b, -s, -t, s, -t, t, b, -t, a].map(|x| f * x)
}

/// Consistent mass of bending with Φ; total mass, length. \[Przemieniecki 1968, eq. 11.30\]
fn bending_mass(mass: f64, phi: f64, l: f64) -> [f64; 16] {
    let f = mass / (1.0 + phi).powi(2);
    let p = phi * phi;
    let a = 13.0 / 35.0 + 0.7 * phi + p / 3.0;
    let b = (11.0 / 210.0 + 11.0 / 120.0 * phi + p / 24.0) * l;
    let c = 9.0 / 70.0 + 0.3 * phi + p / 6.0;
    let d = (13.0 / 420.0 + 3.0 / 40.0 * phi + p / 24.0) * l;
    let e = (1.0 / 105.0 + phi / 60.0 + p / 120.0) * l * l;
    let g = (1.0 / 140.0 + phi / 60.0 + p / 120.0) * l * l;
    [a, b, c, -d, b, e, d, -g, c, d, a, -b, -d, -g, -b, e].map(|x| f * x)
}

impl Beam {
    /// Stiffness and mass in local axes, between the nodes.
    pub(super) fn local(
        &self,
        whole: f64,
        l: f64,
        tension: f64,
    ) -> Result<(DMatrix<f64>, DMatrix<f64>), ParameterError> {
        let s = self.section();
        let [phi12, phi13] = self.shear_ratios(&s, l);
        let mut k = self.stiffness(&s, whole, l, tension);
        let per_length = self.density * s.area + self.distributed_mass;
        let mut m = match self.mass_matrix {
            MassMatrix::Lumped => DMatrix::zeros(12, 12),
            MassMatrix::Consistent => self.consistent(&s, per_length, l, phi12, phi13),
        };
        self.release(&mut k, &mut m, &mut [0.0; 12])?;
        if self.offset_i != 0.0 || self.offset_j != 0.0 {
            let arms = self.arms();
            k = arms.transpose() * k * &arms;
            m = arms.transpose() * m * &arms;
        }
        match self.mass_matrix {
            MassMatrix::Lumped => {
                for i in [0, 1, 2, 6, 7, 8] {
                    m[(i, i)] = 0.5 * per_length * whole;
                }
            }
            MassMatrix::Consistent => {
                rigid_rod(&mut m, 0, per_length, self.offset_i);
                rigid_rod(&mut m, 6, per_length, -self.offset_j);
            }
        }
        Ok((k, m))
    }

    /// Φ in the planes 1–2 and 1–3.
    pub(super) fn shear_ratios(&self, s: &Section, l: f64) -> [f64; 2] {
        let g = self.shear_modulus();
        let [area2, area3] = self.shear_areas(s);
        let ratio = |i: f64, area: Option<f64>| {
            area.map_or(0.0, |a| 12.0 * (self.young * i) / (g * a * l * l))
        };
        [ratio(s.i3, area2), ratio(s.i2, area3)]
    }

    /// Stiffness in local axes between the flexible ends, nothing released.
    pub(super) fn stiffness(&self, s: &Section, whole: f64, l: f64, tension: f64) -> DMatrix<f64> {
        let g = self.shear_modulus();
        let (ei2, ei3) = (self.young * s.i2, self.young * s.i3);
        let [phi12, phi13] = self.shear_ratios(s, l);
        let rod = [1.0, -1.0, -1.0, 1.0];
        let along = match self.offsets_stiffen {
            Stiffened::All => l,
            Stiffened::Bending => whole,
        };

        let mut k = DMatrix::zeros(12, 12);
        add(&mut k, &[0, 6], &[1.0; 2], &rod.map(|x| x * self.young * s.area / along));
        add(&mut k, &[3, 9], &[1.0; 2], &rod.map(|x| x * g * s.torsion / along));
        in_plane(&mut k, IN_12, &bending(ei3, phi12, l));
        in_plane(&mut k, IN_13, &bending(ei2, phi13, l));
        for (plane, ei) in [(IN_12, ei3), (IN_13, ei2)] {
            if ei > 0.0 {
                in_plane(&mut k, plane, &geometric(tension, l));
            } else {
                let [a, _, b, _] = plane.0;
                add(&mut k, &[a, b], &[1.0; 2], &rod.map(|x| x * tension / l));
            }
        }
        k
    }

    fn consistent(&self, s: &Section, per_length: f64, l: f64, p12: f64, p13: f64) -> DMatrix<f64> {
        let mass = per_length * l;
        let rod = [1.0 / 3.0, 1.0 / 6.0, 1.0 / 6.0, 1.0 / 3.0];
        let mut m = DMatrix::zeros(12, 12);
        add(&mut m, &[0, 6], &[1.0; 2], &rod.map(|x| x * mass));
        if s.torsion > 0.0 {
            let polar = self.density * (s.i2 + s.i3) * l;
            add(&mut m, &[3, 9], &[1.0; 2], &rod.map(|x| x * polar));
        }
        for (plane, phi, i) in [(IN_12, p12, s.i3), (IN_13, p13, s.i2)] {
            if i > 0.0 {
                in_plane(&mut m, plane, &bending_mass(mass, phi, l));
            } else {
                // Without bending stiffness the mass moves as that of a rod does.
                let [a, _, b, _] = plane.0;
                add(&mut m, &[a, b], &[1.0; 2], &rod.map(|x| x * mass));
            }
        }
        m
    }

    /// Condenses the released directions out of both matrices and out of forces on the flexible ends.
    pub(super) fn release(
        &self,
        k: &mut DMatrix<f64>,
        m: &mut DMatrix<f64>,
        p: &mut [f64; 12],
    ) -> Result<(), ParameterError> {
        let original = k.diagonal();
        let ends = [("release_i", &self.release_i, 0), ("release_j", &self.release_j, 6)];
        let mut gone = [false; 12];
        for (name, axes, offset) in ends {
            for axis in axes {
                let s = offset + axis.index();
                if gone[s] || original[s] == 0.0 {
                    continue;
                }
                if k[(s, s)] <= 1e-10 * original[s] {
                    return Err(ParameterError::inconsistent(name, mechanism(*axis)));
                }
                // u_s = −Σ k_sr u_r / k_ss for the rest; both matrices follow.
                let mut t = DMatrix::identity(12, 12);
                for r in 0..12 {
                    t[(s, r)] = if r == s || gone[r] { 0.0 } else { -k[(s, r)] / k[(s, s)] };
                }
                let released = p[s];
                for (r, p) in p.iter_mut().enumerate() {
                    *p = if r == s { 0.0 } else { *p + t[(s, r)] * released };
                }
                *k = t.transpose() * &*k * &t;
                *m = t.transpose() * &*m * &t;
                gone[s] = true;
            }
        }
        for s in 0..12 {
            if gone[s] || k[(s, s)] <= 1e-10 * original[s] {
                k.row_mut(s).fill(0.0);
                k.column_mut(s).fill(0.0);
            }
        }
        Ok(())
    }

    /// Displacements of the flexible ends from those of the nodes: u + θ × (± offset along 1).
    pub(super) fn arms(&self) -> DMatrix<f64> {
        let mut t = DMatrix::identity(12, 12);
        for (at, arm) in [(0, self.offset_i), (6, -self.offset_j)] {
            t[(at + 1, at + 5)] = arm;
            t[(at + 2, at + 4)] = -arm;
        }
        t
    }
}

fn mechanism(axis: Axis) -> String {
    format!("releasing {} here as well leaves the beam a mechanism", axis.name())
}

/// Adds a rigid rod that reaches from a node by `arm` (signed) along local 1.
fn rigid_rod(m: &mut DMatrix<f64>, at: usize, per_length: f64, arm: f64) {
    let mass = per_length * arm.abs();
    let (first, second) = (mass * arm / 2.0, mass * arm * arm / 3.0);
    add(m, &[at], &[1.0], &[mass]);
    add(m, &[at + 1, at + 5], &[1.0; 2], &[mass, first, first, second]);
    add(m, &[at + 2, at + 4], &[1.0, -1.0], &[mass, first, first, second]);
}
