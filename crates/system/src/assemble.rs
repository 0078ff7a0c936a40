//! Assembly of a model into reduced matrices.

use crate::elastic::{EndForceRow, end_force_row};
use crate::links::mark_used;
use crate::{ImpactMass, LinkSet, Reduction, SystemError};
use trilith_element::{Dof, ElementMatrices, Geometry};
use trilith_linalg::{Sparse, Triplets, unsupported};
use trilith_model::{Body, Damping, Model};

/// M ü + C u̇ + K u + Bᵀ f(B u, B u̇) = p(t) on the free DOFs; links are not in K.
#[derive(Debug)]
pub struct System {
    /// Elimination of supports and constraints.
    pub reduction: Reduction,
    /// M with the inertances, free × free, kg.
    pub mass: Sparse,
    /// C of elements and Rayleigh damping, free × free, N·s/m. Modal damping is not in it.
    pub damping: Sparse,
    /// Shares of M and of K in C, 1/s and s: zero without Rayleigh damping.
    pub rayleigh: [f64; 2],
    /// K of the structure without links and dummies, free × free, N/m.
    pub stiffness: Sparse,
    /// The same blocks, free × prescribed.
    pub mass_support: Sparse,
    /// The same blocks, free × prescribed.
    pub damping_support: Sparse,
    /// The same blocks, free × prescribed.
    pub stiffness_support: Sparse,
    /// The links.
    pub links: LinkSet,
    /// Tᵀ M r for unit translations along X, Y, Z, inertances apart: inertia per unit acceleration, kg.
    pub inertia: [Vec<f64>; 3],
    /// Sum of all masses along Z, supports included and inertances apart, kg.
    pub total_mass: f64,
    /// Axial force of every element that K was made with, N, tension positive; zeros without P-Δ.
    pub tension: Vec<f64>,
    matrices: Vec<Option<ElementMatrices>>,
}

impl System {
    /// Assembles.
    ///
    /// # Errors
    /// [`SystemError`] where elements, constraints or supports do not fit together.
    pub fn new(model: &Model) -> Result<Self, SystemError> {
        Self::with_tension(model, vec![0.0; model.elements.len()])
    }

    /// Assembles with the geometric stiffness of an axial force (N, tension positive) in every element.
    ///
    /// # Errors
    /// As [`new`](Self::new).
    pub fn with_tension(model: &Model, tension: Vec<f64>) -> Result<Self, SystemError> {
        let matrices = element_matrices(model, &tension)?;
        let count = 6 * model.nodes.len();
        let mut used = vec![false; count];
        for (e, m) in model.elements.iter().zip(&matrices) {
            for (node, dof) in m.iter().flat_map(|m| &m.dofs) {
                used[6 * e.nodes[*node] + dof.index()] = true;
            }
        }
        mark_used(model, &mut used);
        let reduction = Reduction::new(model, &mut used)?;
        if reduction.order() == 0 {
            return Err(SystemError::Empty);
        }
        let [k, m, c, b] = full_matrices(model, &matrices, count);
        let t = reduction.matrix();
        let m_reduced = Sparse::combine(&[(1.0, &m), (1.0, &b)]).congruence(&t);
        let (k, c_elements) = (k.congruence(&t), c.congruence(&t));
        let (a0, a1) = match model.damping {
            Damping::Rayleigh { mass, stiffness } => (mass, stiffness),
            _ => (0.0, 0.0),
        };
        let c = Sparse::combine(&[(1.0, &c_elements), (a0, &m_reduced), (a1, &k)]);
        let order = reduction.order();
        let free: Vec<usize> = (0..order).collect();
        let support: Vec<usize> = (order..order + reduction.prescribed.len()).collect();
        let inertia = [0, 1, 2].map(|axis| {
            let r: Vec<f64> = (0..count).map(|i| f64::from(u8::from(i % 6 == axis))).collect();
            let mut p = vec![0.0; t.columns()];
            t.transpose_mul_add(1.0, &m.mul(&r), &mut p);
            p.truncate(order);
            p
        });
        let r: Vec<f64> = (0..count).map(|i| f64::from(u8::from(i % 6 == 2))).collect();
        let mut links = LinkSet::new(model, &reduction, &used)?;
        let mass = m_reduced.block(&free, &free);
        crate::impact::settle(&mut links, model, &mass)?;
        Ok(Self {
            mass,
            damping: c.block(&free, &free),
            rayleigh: [a0, a1],
            stiffness: k.block(&free, &free),
            mass_support: m_reduced.block(&free, &support),
            damping_support: c.block(&free, &support),
            stiffness_support: k.block(&free, &support),
            links,
            inertia,
            total_mass: m.bilinear(&r, &r),
            tension,
            reduction,
            matrices,
        })
    }

    /// The contacts whose dashpot a restitution can set, and the masses that strike them.
    ///
    /// # Errors
    /// [`SystemError::Linalg`] where the masses cannot be factorised.
    pub fn impact_masses(&self, model: &Model) -> Result<Vec<ImpactMass>, SystemError> {
        crate::impact::masses(&self.links, model, &self.mass)
    }

    /// Number of free DOFs.
    #[must_use]
    pub fn order(&self) -> usize {
        self.reduction.order()
    }

    /// K + Bᵀ diag(values) B; `values` on the flat link coordinates, such as dummies.
    #[must_use]
    pub fn stiffness_with(&self, values: &[f64]) -> Sparse {
        let mut sum = Triplets::new(self.order(), self.order());
        for (i, j, v) in self.stiffness.entries() {
            sum.add(i, j, v);
        }
        for (row, x) in self.links.rows.iter().zip(values).filter(|(_, x)| **x != 0.0) {
            for (i, a) in row {
                for (j, b) in row {
                    sum.add(*i, *j, a * x * b);
                }
            }
        }
        sum.build()
    }

    /// Refuses a structure that can move without stiffness (links count with the stiffness they have
    /// when engaged) and, in dynamics, without mass.
    ///
    /// # Errors
    /// [`SystemError::Unsupported`] with node and direction.
    pub fn check_supported(&self, model: &Model, with_mass: bool) -> Result<(), SystemError> {
        let mut k = self.stiffness_with(&self.links.engaged(model));
        if with_mass {
            let mean = |a: &Sparse| a.diagonal().iter().sum::<f64>() / self.order() as f64;
            let (stiff, heavy) = (mean(&k), mean(&self.mass));
            let shift = if heavy > 0.0 && stiff > 0.0 { stiff / heavy } else { 1.0 };
            // Velocity-proportional elements hold a direction as well.
            let viscous = mean(&self.damping);
            let rate = if viscous > 0.0 && stiff > 0.0 { stiff / viscous } else { 1.0 };
            k = Sparse::combine(&[(1.0, &k), (shift, &self.mass), (rate, &self.damping)]);
        }
        let loose = unsupported(&k)?;
        let Some(first) = loose.first() else { return Ok(()) };
        let span = model.nodes[self.reduction.free[*first] / 6].span.clone();
        let directions = loose.iter().map(|i| self.direction(model, *i)).collect();
        Err(SystemError::Unsupported { directions, with_mass, span })
    }

    /// Node name and direction of a free DOF.
    #[must_use]
    pub fn direction(&self, model: &Model, free: usize) -> (String, &'static str) {
        let full = self.reduction.free[free];
        (model.nodes[full / 6].name.clone(), Dof::ALL[full % 6].name())
    }

    /// Axial force of a linear element with two nodes at a displacement of the free DOFs, supports at
    /// rest; N, tension positive. 0 for every other member.
    #[must_use]
    pub fn axial_force(&self, model: &Model, element: usize, u: &[f64]) -> f64 {
        let e = &model.elements[element];
        if e.nodes.len() != 2 || self.matrices[element].is_none() {
            return 0.0;
        }
        let along = [Dof::Ux, Dof::Uy, Dof::Uz].into_iter().zip(e.frame.0[0]);
        along
            .map(|(dof, c)| {
                let row = self.end_force(model, element, 1, dof).stiffness;
                c * row.iter().map(|(j, k)| k * u.get(*j).unwrap_or(&0.0)).sum::<f64>()
            })
            .sum()
    }

    /// The force that an element exerts against the displacement of one of its nodes' DOFs, as a row
    /// over the reduced DOFs.
    #[must_use]
    pub fn end_force(&self, model: &Model, element: usize, end: usize, dof: Dof) -> EndForceRow {
        match &self.matrices[element] {
            Some(m) => end_force_row(m, &model.elements[element].nodes, end, dof, &self.reduction),
            None => EndForceRow::default(),
        }
    }
}

fn element_matrices(
    model: &Model,
    tension: &[f64],
) -> Result<Vec<Option<ElementMatrices>>, SystemError> {
    model
        .elements
        .iter()
        .zip(tension)
        .map(|(e, tension)| {
            let Body::Linear(element) = &e.body else { return Ok(None) };
            let nodes: Vec<_> = e.nodes.iter().map(|n| model.nodes[*n].position).collect();
            let refuse = |reason: String| SystemError::Element {
                element: e.name.clone(),
                reason,
                span: e.span.clone(),
            };
            let m = element
                .matrices(&Geometry { nodes: &nodes, frame: e.frame, tension: *tension })
                .map_err(|x| refuse(x.to_string()))?;
            let finite = [&m.stiffness, &m.mass, &m.damping, &m.inertance]
                .iter()
                .all(|a| a.values().iter().all(|x| x.is_finite()));
            if finite { Ok(Some(m)) } else { Err(refuse("its matrices are not finite".into())) }
        })
        .collect()
}

/// K, M, C and the inertances over all DOFs.
fn full_matrices(model: &Model, matrices: &[Option<ElementMatrices>], count: usize) -> [Sparse; 4] {
    let mut sums = [(); 4].map(|()| Triplets::new(count, count));
    for (e, m) in model.elements.iter().zip(matrices) {
        let Some(m) = m else { continue };
        let full: Vec<usize> = m.dofs.iter().map(|(n, d)| 6 * e.nodes[*n] + d.index()).collect();
        let parts = [&m.stiffness, &m.mass, &m.damping, &m.inertance];
        for (sum, a) in sums.iter_mut().zip(parts) {
            for (i, row) in full.iter().enumerate() {
                for (j, column) in full.iter().enumerate() {
                    if a[(i, j)] != 0.0 {
                        sum.add(*row, *column, a[(i, j)]);
                    }
                }
            }
        }
    }
    sums.map(|s| s.build())
}
