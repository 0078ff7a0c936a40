//! Assembly of a model into reduced matrices.

use crate::blame::answered;
use crate::elastic::{EndForceRow, ReactionRow, end_force_row, sparse_end_force};
use crate::inner::sparse;
use crate::links::mark_used;
use crate::{ImpactMass, InnerRows, LinkSet, Massless, Reduction, SystemError};
use trilith_element::{Dof, ElementMatrices, Geometry};
use trilith_linalg::{Sparse, Triplets, unsupported};
use trilith_model::{Body, Damping, Element, MemberLoad, Model};

/// M ü + C u̇ + K u + Bᵀ f(B u, B u̇) = p(t) on the free DOFs; links are not in K.
#[derive(Debug)]
pub struct System {
    /// Elimination of supports and constraints.
    pub reduction: Reduction,
    /// Equations that are no directions of nodes.
    pub inner: InnerRows,
    /// Directions without mass.
    pub massless: Massless,
    /// M with the inertances, free × free, kg.
    pub mass: Sparse,
    /// C of elements alone, free × free, N·s/m; see [`damping`](Self::damping).
    pub element_damping: Sparse,
    /// Coefficients of M and K in Rayleigh damping, 1/s and s; 0 without.
    pub rayleigh: [f64; 2],
    /// K of the structure without links and dummies, free × free, N/m.
    pub stiffness: Sparse,
    /// The same blocks, free × prescribed.
    pub mass_support: Sparse,
    /// C of elements and the share of K in Rayleigh damping, free × prescribed; that of M acts on what moves
    /// against the supports, and these do not.
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
    /// True where every direction is fixed or prescribed: links are led, and nothing answers. The one equation is an
    /// oscillator of 1 kg and 1 N/m at rest, which nothing acts on and nothing follows.
    pub idle: bool,
}

impl System {
    /// Assembles without geometric stiffness, whatever the model says of P-Δ: `trilith_solvers::assemble` heeds it.
    ///
    /// # Errors
    /// [`SystemError`] where elements, constraints or supports do not fit together.
    pub fn without_axial_forces(model: &Model) -> Result<Self, SystemError> {
        Self::with_tension(model, vec![0.0; model.elements.len()])
    }

    /// Assembles with the geometric stiffness of an axial force (N, tension positive) in every element.
    ///
    /// # Errors
    /// As [`without_axial_forces`](Self::without_axial_forces).
    pub fn with_tension(model: &Model, tension: Vec<f64>) -> Result<Self, SystemError> {
        let mut inner = InnerRows::new(model)?;
        let count = 6 * model.nodes.len() + inner.len();
        let mut used = vec![false; count];
        let Full { stiffness, mass, damping, inertance } =
            full_entries(model, &tension, &inner, &mut used, |_| true)?;
        mark_used(model, &mut used);
        let mut reduction = Reduction::new(model, &inner, &mut used)?;
        let idle = reduction.order() == 0;
        if idle {
            if reduction.prescribed.is_empty() {
                return Err(SystemError::Empty);
            }
            reduction.add_idle();
        }
        let reduced = || {
            let of = |entries: Triplets| reduce(&entries, &reduction);
            [of(stiffness), reduce(&mass, &reduction), of(damping), of(inertance)]
        };
        let [k, m, c, b] = inner.follow(model, reduced)?;
        let (inertia, total_mass) = inertia(&mass, &reduction, &inner);
        drop(mass);
        let [k, m] = if idle { [k, m].map(of_idle) } else { [k, m] };
        let m = if b.free.stored() + b.support.stored() == 0 {
            m
        } else {
            Split {
                free: Sparse::combine(&[(1.0, &m.free), (1.0, &b.free)]),
                support: Sparse::combine(&[(1.0, &m.support), (1.0, &b.support)]),
            }
        };
        for (what, sum) in [("the stiffness", &k), ("the mass", &m), ("the damping", &c)] {
            within_bounds(what, sum, model, &reduction, &inner)?;
        }
        let rayleigh = match model.damping {
            Damping::Rayleigh { mass, stiffness } => [mass, stiffness],
            _ => [0.0; 2],
        };
        if rayleigh != [0.0; 2] {
            let sum = |c: &Sparse, m: &Sparse, k: &Sparse| {
                Sparse::combine(&[(1.0, c), (rayleigh[0], m), (rayleigh[1], k)])
            };
            let free = sum(&c.free, &m.free, &k.free);
            let support = sum(&c.support, &m.support, &k.support);
            within_bounds("the damping", &Split { free, support }, model, &reduction, &inner)?;
        }
        let damping_support = Sparse::combine(&[(1.0, &c.support), (rayleigh[1], &k.support)]);
        let mut links = LinkSet::new(model, &reduction)?;
        crate::impact::settle(&mut links, model, &m.free)?;
        let mut system = Self {
            massless: Massless::new(&m.free)?,
            mass: m.free,
            element_damping: c.free,
            rayleigh,
            stiffness: k.free,
            mass_support: m.support,
            damping_support,
            stiffness_support: k.support,
            links,
            inertia,
            total_mass,
            tension,
            idle,
            inner,
            reduction,
        };
        crate::massless::give_dummies(&mut system, model)?;
        Ok(system)
    }

    /// Mean diagonal of the stiffness where there is some, N/m; else what would move the mean mass at 1 rad/s.
    pub(crate) fn usual_stiffness(&self) -> f64 {
        let mean = |a: &Sparse| a.diagonal().iter().sum::<f64>() / self.order() as f64;
        [mean(&self.stiffness), mean(&self.mass)].into_iter().find(|x| *x > 0.0).unwrap_or(1.0)
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

    /// C of elements and Rayleigh damping, free × free, N·s/m; modal damping is not in it. It is made anew:
    /// kept, it would weigh as much as K.
    #[must_use]
    pub fn damping(&self) -> Sparse {
        let [of_mass, of_stiffness] = self.rayleigh;
        if of_mass == 0.0 && of_stiffness == 0.0 {
            return self.element_damping.clone();
        }
        Sparse::combine(&[
            (1.0, &self.element_damping),
            (of_mass, &self.mass),
            (of_stiffness, &self.stiffness),
        ])
    }

    /// K + Bᵀ diag(values) B; `values` on the flat link coordinates, such as dummies.
    #[must_use]
    pub fn stiffness_with(&self, values: &[f64]) -> Sparse {
        if values.iter().all(|x| *x == 0.0) {
            return self.stiffness.clone();
        }
        Sparse::combine(&[(1.0, &self.stiffness), (1.0, &self.springs(values))])
    }

    /// Bᵀ diag(values) B; `values` on the flat link coordinates.
    #[must_use]
    pub fn springs(&self, values: &[f64]) -> Sparse {
        let mut sum = Triplets::new(self.order(), self.order());
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
            let held = self.links.viscous(model).into_iter().map(|held| f64::from(u8::from(held)));
            let of_links = self.springs(&held.collect::<Vec<_>>());
            let own = self.damping();
            let size = |a: f64| if a > 0.0 { a } else { 1.0 };
            let share = size(mean(&own)) / size(mean(&of_links));
            let damping = Sparse::combine(&[(1.0, &own), (share, &of_links)]);
            let viscous = mean(&damping);
            let rate = if viscous > 0.0 && stiff > 0.0 { stiff / viscous } else { 1.0 };
            k = Sparse::combine(&[(1.0, &k), (shift, &self.mass), (rate, &damping)]);
        }
        let loose = unsupported(&k)?;
        let Some(first) = loose.first() else { return Ok(()) };
        let span = self.inner.span(model, self.reduction.free[*first]);
        let directions = loose.iter().map(|i| self.direction(model, *i)).collect();
        Err(SystemError::Unsupported { directions, with_mass, span })
    }

    /// Node name and direction of a free DOF, or which row of which element it is.
    #[must_use]
    pub fn direction(&self, model: &Model, free: usize) -> (String, &'static str) {
        self.inner.name(model, self.reduction.free[free])
    }

    /// Axial force of a linear element with two nodes at a displacement of the free DOFs, supports at
    /// rest; N, tension positive. 0 for every other member.
    #[must_use]
    pub fn axial_force(&self, model: &Model, element: usize, u: &[f64]) -> f64 {
        let e = &model.elements[element];
        let Some(m) = self.matrices(model, element).filter(|_| e.nodes.len() == 2) else {
            return 0.0;
        };
        let along = [Dof::Ux, Dof::Uy, Dof::Uz].into_iter().zip(e.frame.0[0]);
        along
            .map(|(dof, c)| {
                let row = end_force_row(&m, &e.nodes, 1, dof, &self.reduction).stiffness;
                c * row.iter().map(|(j, k)| k * u.get(*j).unwrap_or(&0.0)).sum::<f64>()
            })
            .sum()
    }

    /// The force that an element exerts against the displacement of one of its nodes' DOFs, as a row
    /// over the reduced DOFs.
    #[must_use]
    pub fn end_force(&self, model: &Model, element: usize, end: usize, dof: Dof) -> EndForceRow {
        if let Some((own, places)) =
            sparse(&model.elements[element]).zip(self.inner.places(element))
        {
            return sparse_end_force(own, places, (end, dof), &self.reduction);
        }
        match self.matrices(model, element) {
            Some(m) => end_force_row(&m, &model.elements[element].nodes, end, dof, &self.reduction),
            None => EndForceRow::default(),
        }
    }

    /// What a support gives the structure at a direction that it fixes.
    #[must_use]
    pub fn reaction(&self, model: &Model, node: usize, dof: Dof) -> ReactionRow {
        let mut row = ReactionRow::default();
        for (element, e) in model.elements.iter().enumerate() {
            for end in (0..e.nodes.len()).filter(|end| e.nodes[*end] == node) {
                let own = self.end_force(model, element, end, dof);
                let of_stiffness = own.stiffness.iter().map(|(j, k)| (*j, self.rayleigh[1] * k));
                row.damping.extend(own.damping.iter().copied().chain(of_stiffness));
                row.stiffness.extend(own.stiffness);
            }
        }
        row.links = self.links.forces_on(model, node, dof);
        let full = 6 * node + dof.index();
        for (pattern, p) in model.patterns.iter().enumerate() {
            let all = p.members.iter().flat_map(|load| self.member_load(model, load));
            let sum: f64 = all.filter(|(i, _)| *i == full).map(|(_, force)| force).sum();
            if sum != 0.0 {
                row.loads.push((pattern, -sum));
            }
        }
        row
    }

    /// Axial force of an element that a load along it makes where nothing moves, mean of both ends; N, tension positive.
    #[must_use]
    pub fn held_tension(&self, model: &Model, load: &MemberLoad) -> f64 {
        let axes = model.elements[load.element].frame.0[0];
        let [i, j] = [0, 1].map(|end| {
            let ends = self.member_load(model, load);
            (0..3).map(|k| axes[k] * ends[6 * end + k].1).sum::<f64>()
        });
        0.5 * (i - j)
    }

    /// Matrices of an element, made once more: kept, they would outweigh everything else.
    fn matrices(&self, model: &Model, element: usize) -> Option<ElementMatrices> {
        element_matrices(model, &model.elements[element], self.tension[element]).ok().flatten()
    }
}

pub(crate) fn element_matrices(
    model: &Model,
    e: &Element,
    tension: f64,
) -> Result<Option<ElementMatrices>, SystemError> {
    let Body::Linear(element) = &e.body else { return Ok(None) };
    let nodes: Vec<_> = e.nodes.iter().map(|n| model.nodes[*n].position).collect();
    let refuse = |reason: String| SystemError::Element {
        element: e.name.clone(),
        reason,
        span: e.span.clone(),
    };
    let geometry = Geometry::new(&nodes, e.frame).with_tension(tension);
    let m = answered(|| element.matrices(&geometry))
        .map_err(|said| refuse(format!("its matrices panicked: {said}")))?
        .map_err(|x| refuse(x.to_string()))?;
    // An axial force softens every element.
    let softens = tension != 0.0 || element.softens();
    m.check(e.nodes.len(), softens).map_err(|fault| refuse(fault.to_string()))?;
    Ok(Some(m))
}

/// Entries over all DOFs.
pub(crate) struct Full {
    pub stiffness: Triplets,
    pub mass: Triplets,
    pub damping: Triplets,
    pub inertance: Triplets,
}

/// The entries of all elements that are `wanted`, by their indices; marks the DOFs that they use.
pub(crate) fn full_entries(
    model: &Model,
    tension: &[f64],
    inner: &InnerRows,
    used: &mut [bool],
    wanted: impl Fn(usize) -> bool,
) -> Result<Full, SystemError> {
    let none = || Triplets::new(used.len(), used.len());
    let mut full = Full { stiffness: none(), mass: none(), damping: none(), inertance: none() };
    let mut places = Vec::new();
    let all = model.elements.iter().zip(tension).enumerate();
    for (element, (e, tension)) in all.filter(|(element, _)| wanted(*element)) {
        let Some(m) = element_matrices(model, e, *tension)? else { continue };
        if let Some((own, places)) = sparse(e).zip(inner.places(element)) {
            let parts = [
                (&mut full.stiffness, Some(&own.stiffness)),
                (&mut full.mass, own.mass.as_ref()),
                (&mut full.damping, own.damping.as_ref()),
            ];
            for (sum, a) in parts {
                let entries = a.into_iter().flat_map(|a| &a.entries).filter(|e| e.2 != 0.0);
                for (i, j, value) in entries {
                    let (row, column) = (places[*i as usize], places[*j as usize]);
                    used[row] = true;
                    sum.add(row, column, *value);
                }
            }
        }
        places.clear();
        places.extend(m.dofs.iter().map(|(n, d)| 6 * e.nodes[*n] + d.index()));
        places.iter().for_each(|i| used[*i] = true);
        let parts = [
            (&mut full.stiffness, &m.stiffness),
            (&mut full.mass, &m.mass),
            (&mut full.damping, &m.damping),
            (&mut full.inertance, &m.inertance),
        ];
        for (sum, a) in parts {
            for (row, values) in places.iter().zip(a.values().chunks(places.len().max(1))) {
                for (column, value) in places.iter().zip(values).filter(|(_, v)| **v != 0.0) {
                    sum.add(*row, *column, *value);
                }
            }
        }
    }
    Ok(full)
}

/// A matrix over the free DOFs, and its columns of prescribed ones.
struct Split {
    free: Sparse,
    support: Sparse,
}

/// Stiffness or mass of the equation of a system in which nothing is free.
fn of_idle(block: Split) -> Split {
    let mut one = Triplets::new(1, 1);
    one.add(0, 0, 1.0);
    Split { free: one.build(), ..block }
}

/// Tᵀ A T, rows of the free DOFs.
fn reduce(full: &Triplets, reduction: &Reduction) -> Split {
    let order = reduction.order();
    let mut free = Triplets::new(order, order);
    let mut support = Triplets::new(order, reduction.prescribed.len());
    for (i, j, v) in full.entries() {
        for (row, a) in reduction.expand(i).iter().filter(|(row, _)| *row < order) {
            for (column, b) in reduction.expand(j) {
                match column.checked_sub(order) {
                    None => free.add(*row, *column, v * (a * b)),
                    Some(column) => support.add(*row, column, v * (a * b)),
                }
            }
        }
    }
    Split { free: free.build(), support: support.build() }
}

/// Refuses sums that have overflowed: no factorisation could say where they come from.
fn within_bounds(
    what: &'static str,
    sum: &Split,
    model: &Model,
    reduction: &Reduction,
    inner: &InnerRows,
) -> Result<(), SystemError> {
    let Some(row) = sum.free.not_finite().or(sum.support.not_finite()) else { return Ok(()) };
    let full = reduction.free[row];
    let (node, direction) = inner.name(model, full);
    Err(SystemError::Overflow { what, node, direction, span: inner.span(model, full) })
}

/// Tᵀ M r of unit translations, and the mass along Z.
fn inertia(mass: &Triplets, reduction: &Reduction, inner: &InnerRows) -> ([Vec<f64>; 3], f64) {
    let order = reduction.order();
    let mut all = [(); 3].map(|()| vec![0.0; order]);
    let mut total = 0.0;
    for (i, j, v) in mass.entries() {
        let of_nodes = [i, j].iter().all(|full| inner.node(*full).is_some());
        if !of_nodes {
            for (axis, p) in all.iter_mut().enumerate() {
                let share = v * inner.shift(j, axis);
                let rows = reduction.expand(i).iter().filter(|(row, _)| *row < order);
                rows.for_each(|(row, a)| p[*row] += a * share);
            }
            total += inner.shift(i, 2) * v * inner.shift(j, 2);
            continue;
        }
        let Some(p) = all.get_mut(j % 6) else { continue };
        for (row, a) in reduction.expand(i).iter().filter(|(row, _)| *row < order) {
            p[*row] += a * v;
        }
        if i % 6 == 2 && j % 6 == 2 {
            total += v;
        }
    }
    (all, total)
}
