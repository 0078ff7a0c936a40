//! The stiffness that a basis is made with, made regular.

use crate::error::SolveError;
use crate::vector::dot;
use trilith_linalg::{LinalgError, Sparse, StagedLdlt, unsupported};
use trilith_model::Model;
use trilith_system::System;

/// A pivot below this share of its diagonal is rounding: nothing holds the equation.
pub(super) const PIVOT: f64 = 1e-11;
/// Vectors found together: as many as fit into so many bytes, and between these.
const TOGETHER: usize = 64 << 20;
const FEW: usize = 16;
const MANY: usize = 32;
/// Automatic effective stiffnesses as a share of the engaged stiffness of a link.
const DUMMY_SHARE: f64 = 1e-3;

/// K̂ = K + Bᵀ diag(effective stiffnesses) B + shift M + rate C and its factor.
pub(super) struct Solvable {
    pub(super) effective: Vec<f64>,
    /// Bᵀ diag(effective stiffnesses) B.
    pub(super) springs: Sparse,
    /// Of the mass where the structure can move freely, 1/s².
    pub(super) shift: f64,
    /// Of the dashpots where they alone hold a massless direction, 1/s.
    pub(super) rate: f64,
    pub(super) factor: StagedLdlt,
}

/// What the report needs of K̂⁻¹: p K̂⁻¹ p of the loads, and b K̂⁻¹ bᵀ of the active link coordinates.
pub(super) struct Flexibility {
    pub(super) loads: Vec<f64>,
    pub(super) links: Vec<f64>,
}

/// How many vectors of so many equations are found together: products of many with all before them take a fifth less time
/// than those of few, but all of them lie in memory.
pub(super) fn block(order: usize) -> usize {
    (TOGETHER / (size_of::<f64>() * order.max(1))).clamp(FEW, MANY)
}

impl Solvable {
    /// K̂ as a sum; made, it would weigh as much as K.
    pub(super) fn parts<'a>(&'a self, system: &'a System) -> [(f64, &'a Sparse); 4] {
        [
            (1.0, &system.stiffness),
            (1.0, &self.springs),
            (self.shift, &system.mass),
            (self.rate, &system.element_damping),
        ]
    }

    /// `known`: of the links, where they have been found already.
    pub(super) fn flexibility(
        &self,
        system: &System,
        loads: &[(String, Vec<f64>)],
        known: Option<Vec<f64>>,
    ) -> Flexibility {
        let of_loads = loads.iter().map(|(_, p)| {
            let mut x = p.clone();
            self.factor.solve(&mut x);
            dot(p, &x)
        });
        let loads = of_loads.collect();
        let links = known.unwrap_or_else(|| {
            let blocks = system.links.active.chunks(block(system.order()));
            blocks.flat_map(|block| self.static_shapes(system, block).1).collect()
        });
        Flexibility { loads, links }
    }

    /// K̂⁻¹ bᵀ of some link coordinates, and b of them.
    pub(super) fn static_shapes(
        &self,
        system: &System,
        block: &[usize],
    ) -> (Vec<Vec<f64>>, Vec<f64>) {
        let rows = || block.iter().map(|flat| &system.links.rows[*flat]);
        let force = |row: &Vec<(usize, f64)>| {
            let mut p = vec![0.0; system.order()];
            row.iter().for_each(|(i, c)| p[*i] += c);
            p
        };
        let mut shapes: Vec<Vec<f64>> = rows().map(force).collect();
        self.factor.solve_each(&mut shapes);
        let along = |(x, row): (&Vec<f64>, &Vec<(usize, f64)>)| -> f64 {
            row.iter().map(|(i, c)| c * x[*i]).sum()
        };
        let flexibility = shapes.iter().zip(rows()).map(along).collect();
        (shapes, flexibility)
    }
}

pub(super) fn solvable(model: &Model, system: &System) -> Result<Solvable, SolveError> {
    let links = &system.links;
    let engaged = links.engaged(model);
    let pairs = || engaged.iter().zip(&links.effective);
    let effective: Vec<f64> =
        pairs().map(|(e, user)| if *user > 0.0 { *user } else { DUMMY_SHARE * e }).collect();
    let springs = system.springs(&effective);
    let held_by = [(1.0, &system.stiffness), (1.0, &springs)];
    // What effective stiffnesses hold, the links hold when engaged, unless the user's stand where they never do.
    let as_links = pairs().all(|(e, user)| *user <= 0.0 || *e > 0.0);
    if as_links && let Some(factor) = held(&held_by)? {
        return Ok(Solvable { effective, springs, shift: 0.0, rate: 0.0, factor });
    }
    system.check_supported(model, true)?;
    let k = Sparse::combine(&held_by);
    let (mut shift, mut rate) = (0.0, 0.0);
    if !unsupported(&k)?.is_empty() {
        let sum = |a: &Sparse| a.diagonal().iter().sum::<f64>();
        let (stiff, heavy) = (sum(&k), sum(&system.mass));
        // A mass shift makes regular what can move freely, dashpots what they alone hold.
        shift = if stiff > 0.0 && heavy > 0.0 { 1e-6 * stiff / heavy } else { 1.0 };
        let viscous = sum(&system.element_damping);
        let by_mass = || Sparse::combine(&[(1.0, &k), (shift, &system.mass)]);
        if viscous > 0.0 && !unsupported(&by_mass())?.is_empty() {
            rate = if stiff > 0.0 { stiff / viscous } else { 1.0 };
        }
    }
    let parts = [(1.0, &k), (shift, &system.mass), (rate, &system.element_damping)];
    let factor = StagedLdlt::alone(&parts)?;
    Ok(Solvable { effective, springs, shift, rate, factor })
}

/// The factor of a sum, where no pivot is rounding. Scaling to a unit diagonal would divide each pivot by its
/// diagonal entry, so this is the test of [`unsupported`] without a second factorisation.
pub(super) fn held(parts: &[(f64, &Sparse)]) -> Result<Option<StagedLdlt>, SolveError> {
    let mut diagonal = vec![0.0; parts.first().map_or(0, |(_, a)| a.rows())];
    for (factor, part) in parts {
        diagonal.iter_mut().zip(part.diagonal()).for_each(|(sum, d)| *sum += factor * d);
    }
    if diagonal.iter().any(|d| *d <= 0.0) {
        return Ok(None);
    }
    let factor = match StagedLdlt::alone(parts) {
        Err(LinalgError::Singular { .. }) => return Ok(None),
        other => other?,
    };
    let mut all = true;
    factor.pivots(|equation, pivot| all &= pivot > PIVOT * diagonal[equation]);
    Ok(all.then_some(factor))
}
