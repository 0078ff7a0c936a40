//! The linear structure in the coordinates of a solver: all free DOFs, or a basis of Ritz vectors.

use super::link_map::LinkMap;
use crate::basis::{LowRank, ModalDamping, RitzBasis, Shapes, expand};
use std::sync::Arc;
use trilith_linalg::{Dense, Product, Sparse, Triplets};
use trilith_system::{LoadSet, System};

/// Matrices, link maps and loads in the coordinates of a solver.
#[derive(Debug)]
pub(crate) struct ReducedSystem {
    pub mass: Sparse,
    /// C beyond Rayleigh's.
    pub damping: Sparse,
    /// Shares of M and of K in C beside it, 1/s and s; modal damping has one of K beyond its modes.
    pub rayleigh: [f64; 2],
    /// Stiffness with the effective stiffnesses.
    pub stiffness: Sparse,
    pub modal: Option<LowRank>,
    /// B of the active coordinates.
    pub links: LinkMap,
    /// Effective stiffnesses of the active coordinates.
    pub effective_k: Vec<f64>,
    /// A column of forces for each load channel.
    pub forces: Product,
    /// Free DOFs = shape · coordinates; `None` where they are the coordinates.
    pub shape: Option<Arc<Shapes>>,
    /// What reads the coordinates of the static shapes, which are the last columns of `shape` and have no mass, out of
    /// a displacement.
    pub readers: Dense,
    /// Number of the static shapes, behind the modes, that dashpots tie to these.
    pub tied: usize,
}

impl ReducedSystem {
    /// All free DOFs; `effective` holds the effective stiffnesses of the flat link coordinates. Damping acts on the
    /// structure without effective stiffnesses, so C needs no correction for them.
    pub(crate) fn physical(
        system: &System,
        loads: &LoadSet,
        effective: &[f64],
        modal: Option<ModalDamping>,
    ) -> Self {
        let links = &system.links;
        let effective_k: Vec<f64> = links.active.iter().map(|i| effective[*i]).collect();
        let stiffness = system.stiffness_with(effective);
        let [of_mass, mut of_stiffness] = system.rayleigh;
        of_stiffness += modal.as_ref().map_or(0.0, |modal| modal.beyond);
        let damping = if of_stiffness == 0.0 || effective.iter().all(|k| *k == 0.0) {
            system.element_damping.clone()
        } else {
            let springs = system.springs(effective);
            Sparse::combine(&[(1.0, &system.element_damping), (-of_stiffness, &springs)])
        };
        let n = system.order();
        let mut forces = Dense::zeros(n, loads.channels.len());
        for (j, channel) in loads.channels.iter().enumerate() {
            forces.column_mut(j).copy_from_slice(&channel.force);
        }
        Self {
            mass: system.mass.clone(),
            damping,
            rayleigh: [of_mass, of_stiffness],
            stiffness,
            modal: modal.map(ModalDamping::less_beyond),
            links: LinkMap::Sparse(links.active.iter().map(|i| links.rows[*i].clone()).collect()),
            effective_k,
            forces: Product::new(forces),
            shape: None,
            readers: Dense::zeros(n, 0),
            tied: 0,
        }
    }

    /// The span of a basis, whose vectors are M-orthonormal modes of `K + effective stiffnesses`, and of its static
    /// shapes.
    pub(crate) fn reduced(
        system: &System,
        loads: &LoadSet,
        effective: &[f64],
        modal: Option<&ModalDamping>,
        basis: &RitzBasis,
    ) -> Self {
        let (modes, statics) = (basis.modes(), basis.statics());
        let phi = &*basis.shapes;
        let m = phi.len();
        let mut forces = Dense::zeros(m, loads.channels.len());
        for (j, channel) in loads.channels.iter().enumerate() {
            forces.column_mut(j).copy_from_slice(&phi.load(&channel.force));
        }
        let active = &system.links.active;
        let mut links = Dense::zeros(m, active.len());
        for (a, flat) in active.iter().enumerate() {
            links.column_mut(a).copy_from_slice(&phi.row(&system.links.rows[*flat]));
        }
        let effective_k: Vec<f64> = active.iter().map(|i| effective[*i]).collect();
        let omega2 = [&basis.omega2[..], &basis.statics.stiffness[..]].concat();
        let mut damping = if effective_k.iter().all(|k| *k == 0.0) {
            // The part of M and K is known: both are diagonal here.
            let mut damping = phi.congruence(&system.element_damping);
            let [of_mass, of_stiffness] = system.rayleigh;
            for j in 0..m {
                let mass = if j < modes { of_mass } else { 0.0 };
                damping[(j, j)] += mass + of_stiffness * omega2[j];
            }
            damping
        } else {
            phi.congruence(&system.damping())
        };
        if let Some(modal) = modal {
            let u = phi.loads(&modal.u);
            for k in 0..modal.rate.len() {
                for j in 0..m {
                    let s = modal.rate[k] * u[(j, k)];
                    for i in 0..m {
                        damping[(i, j)] += s * u[(i, k)];
                    }
                }
            }
        }
        // What couples static shapes with each other is rounding, and what they have with modes where nothing ties them.
        for r in 0..statics {
            let i = modes + r;
            let among = if basis.statics.is_tied(r) { modes } else { 0 };
            for j in among..m {
                (damping[(i, j)], damping[(j, i)]) = (0.0, 0.0);
            }
            // Modal damping has no share in them, however many modes the basis holds.
            damping[(i, i)] = basis.statics.damping[r];
        }
        Self {
            mass: diagonal(&[vec![1.0; modes], vec![0.0; statics]].concat()),
            damping: sparse(&damping),
            rayleigh: [0.0; 2],
            stiffness: diagonal(&omega2),
            modal: None,
            links: LinkMap::full(links),
            effective_k,
            forces: Product::new(forces),
            shape: Some(Arc::clone(&basis.shapes)),
            readers: basis.statics.readers.clone(),
            tied: (0..statics).take_while(|r| basis.statics.is_tied(*r)).count(),
        }
    }

    pub(crate) fn order(&self) -> usize {
        self.mass.rows()
    }

    /// Σ amplitude · force.
    pub(crate) fn force(&self, amplitudes: &[f64]) -> Vec<f64> {
        let mut p = vec![0.0; self.order()];
        self.force_into(amplitudes, &mut p);
        p
    }

    /// The same, into a given place.
    pub(crate) fn force_into(&self, amplitudes: &[f64], p: &mut [f64]) {
        self.forces.times(amplitudes, p);
    }

    /// M + `c` C + `k` K as a sum, without modal damping.
    pub(crate) fn sum(&self, c: f64, k: f64) -> [(f64, &Sparse); 3] {
        let [of_mass, of_stiffness] = self.rayleigh;
        [
            (1.0 + c * of_mass, &self.mass),
            (c, &self.damping),
            (k + c * of_stiffness, &self.stiffness),
        ]
    }

    /// `p += s · C v`, modal damping included.
    pub(crate) fn damp(&self, s: f64, v: &[f64], p: &mut [f64]) {
        self.damping.mul_add(s, v, p);
        let [of_mass, of_stiffness] = self.rayleigh;
        if of_mass != 0.0 {
            self.mass.mul_add(s * of_mass, v, p);
        }
        if of_stiffness != 0.0 {
            self.stiffness.mul_add(s * of_stiffness, v, p);
        }
        if let Some(modal) = &self.modal {
            modal.mul_add(s, v, p);
        }
    }

    /// Coordinates of a displacement (or velocity) of the free DOFs: Φᵀ M u, and those of the static shapes.
    pub(crate) fn coordinates(&self, system: &System, u: &[f64]) -> Vec<f64> {
        match &self.shape {
            None => u.to_vec(),
            Some(phi) => {
                let mut q = phi.load(&system.mass.mul(u));
                let modes = q.len() - self.readers.columns();
                for (j, x) in q[modes..].iter_mut().enumerate() {
                    *x = self.readers.column(j).iter().zip(u).map(|(a, b)| a * b).sum();
                }
                q
            }
        }
    }

    /// Displacements of the free DOFs.
    pub(crate) fn expand(&self, q: &[f64]) -> Vec<f64> {
        expand(self.shape.as_deref(), q)
    }

    /// A row over the free DOFs as a row over the coordinates.
    pub(crate) fn row(&self, free: &[(usize, f64)]) -> Vec<(usize, f64)> {
        match &self.shape {
            None => free.to_vec(),
            Some(phi) => phi.row(free).into_iter().enumerate().collect(),
        }
    }
}

fn diagonal(values: &[f64]) -> Sparse {
    let mut t = Triplets::new(values.len(), values.len());
    for (i, v) in values.iter().enumerate() {
        t.add(i, i, *v);
    }
    t.build()
}

/// Entries that are rounding against their diagonal are dropped.
fn sparse(a: &Dense) -> Sparse {
    let n = a.rows();
    let mut t = Triplets::new(n, n);
    for j in 0..n {
        for i in 0..n {
            let x = a[(i, j)];
            let size = (a[(i, i)].abs() * a[(j, j)].abs()).sqrt();
            if i == j || x.abs() > 1e-11 * size {
                t.add(i, j, x);
            }
        }
    }
    t.build()
}
