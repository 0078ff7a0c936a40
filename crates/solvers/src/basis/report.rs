//! What a basis holds of masses, loads and links.

use super::solvable::Flexibility;
use super::{Bases, RitzBasis};
use crate::vector::dot;
use serde::Serialize;
use trilith_linalg::{Dense, DenseLu};
use trilith_model::Model;
use trilith_system::System;

/// Modes shown in pictures.
const SHAPES: usize = 6;

/// Shares of flexibility that are equal but for this are the same.
const ROUNDED: f64 = 1e-9;

/// Participation of masses and loads, and the flexibility of every link coordinate that the basis holds;
/// `effective` and `shift` are those of K̂.
pub(super) fn report(
    model: &Model,
    system: &System,
    bases: &Bases,
    loads: &[(String, Vec<f64>)],
    effective: &[f64],
    shift: f64,
    exact: &Flexibility,
) -> BasisReport {
    // With the effective stiffnesses, which hold what links alone do.
    let basis = &bases.stepping;
    let m = basis.modes();
    let phi = &*basis.shapes;
    let rows = &system.links.rows;
    // K̂ in the basis: K is diagonal there, with κ for the static shapes, which have no mass.
    let mut reduced = Dense::zeros(phi.len(), phi.len());
    for j in 0..phi.len() {
        // What dashpots alone hold has no flexibility to be told.
        let of_static = || basis.statics.stiffness[j - m].max(1e-9);
        reduced[(j, j)] = basis.omega2.get(j).map_or_else(of_static, |w| w + shift);
    }
    let there = &system.links.effective;
    let more = effective.iter().zip(there).map(|(all, there)| all - there);
    for (row, effective_k) in rows.iter().zip(more).filter(|(_, k)| *k != 0.0) {
        let q = phi.row(row);
        for (j, b) in q.iter().enumerate() {
            for (a, sum) in q.iter().zip(reduced.column_mut(j)) {
                *sum += effective_k * a * b;
            }
        }
    }
    let reduced = DenseLu::new(&reduced);
    let share = |whole: f64, q: &[f64]| -> f64 {
        let mut y = q.to_vec();
        reduced.solve(&mut y);
        if whole > 0.0 { (dot(q, &y) / whole).min(1.0) } else { 1.0 }
    };
    let mut static_participation = Vec::with_capacity(loads.len());
    for ((name, p), whole) in loads.iter().zip(&exact.loads) {
        static_participation.push((name.clone(), share(*whole, &phi.load(p))));
    }
    let mut adequacy = Vec::with_capacity(exact.links.len());
    for (flat, whole) in system.links.active.iter().zip(&exact.links) {
        let coordinate = system.links.name(model, *flat);
        adequacy.push(Adequacy { coordinate, share: share(*whole, &phi.row(&rows[*flat])) });
    }
    // What only rounding tells apart is in the order of the names.
    let rank = |a: &Adequacy| (a.share / ROUNDED).round();
    adequacy.sort_by(|a: &Adequacy, b| {
        rank(a).total_cmp(&rank(b)).then_with(|| a.coordinate.cmp(&b.coordinate))
    });
    let basis = &bases.structural;
    let phi = &*basis.shapes;
    let inertia = Dense::from_columns(system.order(), 3, system.inertia.concat());
    let shares = phi.loads(&inertia);
    let totals = [0, 1, 2].map(|axis| system.mass_along(axis));
    let mass = |mode: usize, axis: usize| {
        let total = totals[axis];
        if total > 0.0 { shares[(mode, axis)].powi(2) / total } else { 0.0 }
    };
    BasisReport {
        vectors: m,
        static_shapes: bases.stepping.statics(),
        omega: basis.omega2.iter().map(|w| w.max(0.0).sqrt()).collect(),
        mass_participation: (0..m).map(|j| [0, 1, 2].map(|axis| mass(j, axis))).collect(),
        static_participation,
        adequacy,
        shapes: shapes(model, system, basis),
    }
}

/// The lowest modes that deform the structure, at its nodes.
fn shapes(model: &Model, system: &System, basis: &RitzBasis) -> Vec<ModeShape> {
    let bends = basis.omega2.iter().enumerate().filter(|(_, w)| **w > 0.0).take(SHAPES);
    let bends: Vec<usize> = bends.map(|(mode, _)| mode).collect();
    let [Some(first), Some(last)] = [bends.first(), bends.last()] else { return Vec::new() };
    let all = basis.shapes.some(*first..last + 1);
    let shape = |mode: usize| {
        let displacements = at_nodes(model, system, &all[mode - first]);
        ModeShape { mode, displacements }
    };
    bends.iter().map(|mode| shape(*mode)).collect()
}

/// Displacements of the free DOFs as six of every node, node after node. Supports stand still.
pub(crate) fn at_nodes(model: &Model, system: &System, free: &[f64]) -> Vec<f32> {
    let at = |i: usize| -> f64 {
        let terms = system.reduction.expand(i).iter();
        terms.filter_map(|(j, c)| free.get(*j).map(|x| c * x)).sum()
    };
    (0..6 * model.nodes.len()).map(|i| at(i) as f32).collect()
}

/// How well a basis holds the flexibility of a link coordinate.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Adequacy {
    /// Name, such as `"foot" U1`.
    pub coordinate: String,
    /// Share of the exact flexibility, 0 … 1.
    pub share: f64,
}

/// The basis of a reduced solver.
#[derive(Clone, Debug, Default, PartialEq, Serialize)]
pub struct BasisReport {
    /// Number of vectors with mass: modes.
    pub vectors: usize,
    /// Number of static shapes of massless DOFs, beside the modes.
    pub static_shapes: usize,
    /// Circular frequencies of the structure without links, rad/s, rising.
    pub omega: Vec<f64>,
    /// Share of the mass along X, Y, Z that each vector carries.
    pub mass_participation: Vec<[f64; 3]>,
    /// Static participation of each load direction, by name: share of the static response held.
    pub static_participation: Vec<(String, f64)>,
    /// Worst coordinates first.
    pub adequacy: Vec<Adequacy>,
    /// The lowest modes that deform the structure, for pictures.
    #[serde(skip)]
    pub shapes: Vec<ModeShape>,
}

/// What a mode looks like.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct ModeShape {
    /// Which mode it is: an index into [`BasisReport::omega`].
    pub mode: usize,
    /// Six displacements of every node, node after node; of any size.
    pub displacements: Vec<f32>,
}
