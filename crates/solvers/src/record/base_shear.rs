//! Base shear: the horizontal force that a structure passes to its supports and to the ground.
//!
//! ```text
//!   V = tᵀ (K u + C u̇ + Bᵀ f)      t: everything that is free, moved by one unit along X or Y
//! ```
//!
//! What acts between two places that are free drops out; what is left are the elements and links that stand on
//! supports or the ground, whatever leads to them. C is that of the elements and the share of K in Rayleigh damping.
//! Modal damping and its share of M act on the structure from outside, not through its supports, and are not in it.

use super::observer::{Observer, Sample};
use crate::step::State;
use crate::structure::ReducedSystem;
use serde::{Deserialize, Serialize};
use std::collections::BTreeMap;
use trilith_linalg::Sparse;
use trilith_system::System;

/// A term below this share of what it is the sum of is rounding.
const ROUNDING: f64 = 1e-12;

/// Terms over the coordinates of a solver, and over the moving supports.
type Terms = (Vec<(usize, f64)>, Vec<(usize, f64)>);

/// The base shear along one axis as a row over a state.
struct Row {
    stiffness: Terms,
    damping: Terms,
    /// Over the forces of links.
    links: Vec<(usize, f64)>,
}

/// What is left of a sum of columns, where more than rounding is.
#[derive(Default)]
struct Columns(BTreeMap<usize, [f64; 2]>);

impl Columns {
    fn add(&mut self, entries: impl Iterator<Item = (usize, f64)>) {
        for (j, x) in entries {
            let [sum, size] = self.0.entry(j).or_default();
            *sum += x;
            *size += x.abs();
        }
    }

    fn terms(self) -> Vec<(usize, f64)> {
        let left = self.0.into_iter().filter(|(_, [sum, size])| sum.abs() > ROUNDING * size);
        left.map(|(j, [sum, _])| (j, sum)).collect()
    }
}

/// The base shear along X and Y as rows over states.
pub(super) struct Rows {
    rows: [Row; 2],
    /// True where moving supports have a share.
    pub(crate) supported: bool,
}

impl Rows {
    pub(crate) fn new(system: &System, space: &ReducedSystem) -> Self {
        let rows = [0, 1].map(|axis| row(system, space, axis));
        let moved = |row: &Row| !(row.stiffness.1.is_empty() && row.damping.1.is_empty());
        let supported = rows.iter().any(moved);
        Self { rows, supported }
    }

    /// Along X and Y, N. Displacements, velocities and accelerations of moving supports where these have a share.
    pub(crate) fn at(
        &self,
        order: usize,
        state: &State,
        supports: Option<&[Vec<f64>; 3]>,
    ) -> [f64; 2] {
        let (u, v) = (&state.motion[..order], &state.motion[order..2 * order]);
        self.rows.each_ref().map(|row| {
            let mut force = sum(&row.stiffness.0, u) + sum(&row.damping.0, v);
            if let Some([u, v, _]) = supports {
                force += sum(&row.stiffness.1, u) + sum(&row.damping.1, v);
            }
            force + sum(&row.links, &state.f)
        })
    }
}

fn sum(terms: &[(usize, f64)], x: &[f64]) -> f64 {
    terms.iter().map(|(i, c)| c * x[*i]).sum()
}

fn row(system: &System, space: &ReducedSystem, axis: usize) -> Row {
    let moves = |i: usize| system.reduction.free[i] % 6 == axis;
    let of_rows = |a: &Sparse, factor: f64| -> Vec<(usize, f64)> {
        let own = a.entries().filter(|(i, _, x)| moves(*i) && *x != 0.0);
        own.map(|(_, j, x)| (j, factor * x)).collect()
    };
    let terms = |parts: &[(&Sparse, f64)]| {
        let mut columns = Columns::default();
        parts.iter().for_each(|(a, factor)| columns.add(of_rows(a, *factor).into_iter()));
        columns.terms()
    };
    let of_stiffness = system.rayleigh[1];
    let links = system.links.rows.iter().enumerate().filter_map(|(flat, row)| {
        let own = || row.iter().filter(|(i, _)| moves(*i)).map(|(_, c)| *c);
        let (sum, size) = (own().sum::<f64>(), own().map(f64::abs).sum::<f64>());
        (sum.abs() > ROUNDING * size).then_some((flat, sum))
    });
    Row {
        stiffness: (
            space.row(&terms(&[(&system.stiffness, 1.0)])),
            terms(&[(&system.stiffness_support, 1.0)]),
        ),
        damping: (
            space.row(&terms(&[(&system.element_damping, 1.0), (&system.stiffness, of_stiffness)])),
            terms(&[(&system.damping_support, 1.0)]),
        ),
        links: links.collect(),
    }
}

/// The largest base shear of a run.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct BaseShearSummary {
    /// Largest absolute value along X and Y at the ends of all steps, N.
    pub max: [f64; 2],
    /// When these were, s.
    pub time: [f64; 2],
}

/// Observer that keeps the largest base shear.
#[derive(Clone, Debug, Default)]
pub struct BaseShear(BaseShearSummary);

impl BaseShear {
    /// Goes on from what an earlier part of the case left.
    #[must_use]
    pub fn after(so_far: BaseShearSummary) -> Self {
        Self(so_far)
    }

    /// What it has seen.
    #[must_use]
    pub fn summary(&self) -> BaseShearSummary {
        self.0.clone()
    }
}

impl Observer for BaseShear {
    fn sample(&mut self, sample: &Sample<'_>) {
        for axis in 0..2 {
            let force = sample.base_shear[axis].abs();
            if force > self.0.max[axis] {
                (self.0.max[axis], self.0.time[axis]) = (force, sample.t);
            }
        }
    }

    fn wants_rates(&self) -> bool {
        false
    }

    fn wants_base_shear(&self) -> bool {
        true
    }
}
