//! Base shear: the horizontal force that a structure passes to its supports and to the ground.
//!
//! ```text
//!   V = tᵀ (K u + C u̇ + Bᵀ f)      t: everything that is free, moved by one unit along X or Y
//! ```
//!
//! The overturning moment is the same with everything turned about a point. Constraints must let it turn as a rigid body;
//! where they do not, such as `EqualDof` of nodes at different heights, what they pass on is in it.
//!
//! What acts between two places that are free drops out; what is left are the elements and links that stand on
//! supports or the ground, whatever leads to them, and what loads along members bring straight to supports. C is that of the elements and the share of K in Rayleigh damping.
//! Modal damping and its share of M act on the structure from outside, not through its supports, and are not in it.

use super::observer::{Observer, Sample};
use super::rows::Internal;
use crate::step::State;
use crate::structure::ReducedSystem;
use serde::{Deserialize, Serialize};
use trilith_linalg::Sparse;
use trilith_model::Model;
use trilith_system::System;

/// A term below this share of what it is the sum of is rounding.
const ROUNDING: f64 = 1e-12;

/// Sums of entries of each column, and of their magnitudes.
struct Columns(Vec<[f64; 2]>);

impl Columns {
    fn add(&mut self, entries: impl Iterator<Item = (usize, f64)>) {
        for (j, x) in entries {
            let [sum, size] = &mut self.0[j];
            *sum += x;
            *size += x.abs();
        }
    }

    /// What is left where more than rounding is.
    fn terms(self) -> Vec<(usize, f64)> {
        let left = self.0.into_iter().enumerate();
        let left = left.filter(|(_, [sum, size])| sum.abs() > ROUNDING * size);
        left.map(|(j, [sum, _])| (j, sum)).collect()
    }
}

/// The base shear along X and Y as rows over states.
pub(super) struct Rows {
    rows: [Internal; 2],
    /// True where moving supports have a share.
    pub(crate) supported: bool,
    /// True where loads along members have one.
    pub(crate) loaded: bool,
}

impl Rows {
    pub(crate) fn new(model: &Model, system: &System, space: &ReducedSystem) -> Self {
        let unit = |axis: usize| move |full: usize| system.inner.shift(full, axis);
        let rows = [0, 1].map(|axis| row(model, system, space, unit(axis)));
        let supported = rows.iter().any(Internal::is_supported);
        let loaded = rows.iter().any(|row| !row.loads.is_empty());
        Self { rows, supported, loaded }
    }

    /// Along X and Y, N. Displacements, velocities and accelerations of moving supports where these have a share.
    pub(crate) fn at(
        &self,
        order: usize,
        state: &State,
        supports: Option<&[Vec<f64>; 3]>,
        loads: &[f64],
    ) -> [f64; 2] {
        let motion = [&state.motion[..order], &state.motion[order..2 * order]];
        self.rows.each_ref().map(|row| row.at(motion, supports, &state.f, loads))
    }
}

/// tᵀ (K u + C u̇ + Bᵀ f); t: by how much each of the full DOFs is moved.
pub(super) fn row(
    model: &Model,
    system: &System,
    space: &ReducedSystem,
    t: impl Fn(usize) -> f64,
) -> Internal {
    let moved: Vec<f64> = system.reduction.free.iter().map(|full| t(*full)).collect();
    let terms = |parts: &[(&Sparse, f64)]| {
        let mut columns = Columns(vec![[0.0; 2]; parts.first().map_or(0, |(a, _)| a.columns())]);
        for (a, factor) in parts {
            let own = a.entries().filter(|(i, _, x)| moved[*i] != 0.0 && *x != 0.0);
            columns.add(own.map(|(i, j, x)| (j, factor * moved[i] * x)));
        }
        columns.terms()
    };
    let of_stiffness = system.rayleigh[1];
    let links = system.links.rows.iter().enumerate().filter_map(|(flat, row)| {
        let own = || row.iter().map(|(i, c)| moved[*i] * c);
        let (sum, size) = (own().sum::<f64>(), own().map(f64::abs).sum::<f64>());
        (sum.abs() > ROUNDING * size).then_some((flat, sum))
    });
    Internal {
        stiffness: (
            space.row(&terms(&[(&system.stiffness, 1.0)])),
            terms(&[(&system.stiffness_support, 1.0)]),
        ),
        damping: (
            space.row(&terms(&[(&system.element_damping, 1.0), (&system.stiffness, of_stiffness)])),
            terms(&[(&system.damping_support, 1.0)]),
        ),
        links: links.collect(),
        loads: system.loads_past(model, &t),
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
