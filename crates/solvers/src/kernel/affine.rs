//! What a step gives the link kernel, and what it takes from it.

use super::{ComplianceMatrix, Extrapolation};
use crate::structure::ModeSet;
use serde::{Deserialize, Serialize};
use trilith_system::{Answers, Tangents};

/// What the matrices of a step depend on.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub(crate) struct StepKey {
    /// Length, s.
    pub dt: f64,
    /// Modes that move by average acceleration, where the exact rule would go too far.
    pub average: ModeSet,
}

impl StepKey {
    /// Of a step of a length, s, that no mode makes by average acceleration.
    pub fn exact(dt: f64) -> Self {
        Self { dt, average: ModeSet::default() }
    }
}

/// What the link equations need of a prediction: deformations of the active coordinates, and the rates of those that
/// are `rate_dependent`, one after the other: laws depend on them.
pub(crate) struct Wanted<'a> {
    pub d: &'a mut [f64],
    pub v: &'a mut [f64],
    pub rate_dependent: &'a [usize],
}

/// What the linear step gives the kernel.
pub(crate) struct Affine<'a> {
    /// Deformation and rate that supports add, flat, where they move.
    pub support: Option<[&'a [f64]; 2]>,
    /// Compliances, active × active, symmetric.
    pub g: &'a ComplianceMatrix,
    pub h: &'a ComplianceMatrix,
    /// Identity of the compliances: a factor made with others is not used again.
    pub key: &'a StepKey,
}

/// The committed side of a step, flat.
pub(crate) struct Committed<'a> {
    pub d: &'a [f64],
    pub v: &'a [f64],
    pub f: &'a [f64],
    pub history: &'a [f64],
    pub tangents: &'a Tangents,
    pub extrapolation: &'a Extrapolation,
    pub dt: f64,
}

/// Where the converged values go, flat; `pseudo` is f̃ of the active coordinates. Rates that no law depends on stay as they
/// are.
pub(crate) struct Converged<'a> {
    pub d: &'a mut [f64],
    pub v: &'a mut [f64],
    pub laws: Answers<'a>,
    pub pseudo: &'a mut [f64],
    pub extrapolation: &'a mut Extrapolation,
}

/// Where the iteration of the link equations starts.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Guess {
    /// At the pseudo-forces with which the step was predicted.
    Unchanged,
    /// Where the tangents at the start of the step put them, and what such guesses lacked in the steps before.
    Tangents,
}
