//! What one analysis brings to a sweep, as [`prepare`](super::prepare) makes it.

use super::form::{Extent, Form, Law};
use super::grid::{Grid, Piece};
use super::rules::stiffness_ratio;
use super::tables::Table;
use super::watch::Watch;
use crate::march::StepControlState;
use crate::modal::{Mode, single_mode};
use std::any::TypeId;
use std::sync::Arc;
use trilith_element::Contact;
use trilith_model::Combine;
use trilith_system::Track;

/// What must be equal for analyses to go side by side.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Shape {
    pub modes: usize,
    pub links: Vec<(TypeId, Vec<usize>, Extent)>,
    pub channels: Vec<(u8, bool)>,
    pub outputs: Vec<(u8, Vec<usize>)>,
    /// Outputs that are taken over time: how long above a value, or as mean square.
    pub integrals: Vec<(usize, Option<f64>)>,
    /// Indices of the contacts that a body may stand on.
    pub feet: Vec<usize>,
    pub grid: Grid,
    pub is_adaptive: bool,
}

/// One output over modal coordinates and lane coordinates.
#[derive(Clone, Debug)]
pub(super) enum Output {
    /// On displacements (0), velocities (1) or accelerations (2), and on the loads of each channel (base
    /// acceleration).
    Motion { order: usize, own: Vec<f64>, base: Vec<f64> },
    /// On displacements and velocities, and Σ on forces of lane coordinates.
    Internal { stiffness: Vec<f64>, damping: Vec<f64>, links: Vec<(usize, f64)> },
    /// Deformation of a lane coordinate.
    Deformation { at: usize, factor: f64 },
    /// Σ on forces of lane coordinates.
    Force { terms: Vec<(usize, f64)> },
    /// History.
    History { at: usize },
    /// Of a coordinate that nothing deforms.
    Zero,
    /// Of outputs before, each times its factor.
    Combination { how: Combine, constant: f64, terms: Vec<(usize, f64)> },
}

impl Output {
    /// What it is, and of what.
    pub fn kind(&self) -> (u8, Vec<usize>) {
        match self {
            Self::Motion { order, .. } => (0, vec![*order]),
            Self::Internal { links, .. } => (1, links.iter().map(|t| t.0).collect()),
            Self::Deformation { at, .. } => (2, vec![*at]),
            Self::Force { terms } => (3, terms.iter().map(|t| t.0).collect()),
            Self::History { at } => (4, vec![*at]),
            Self::Zero => (5, Vec::new()),
            Self::Combination { how, terms, .. } => {
                (6 + *how as u8, terms.iter().map(|t| t.0).collect())
            }
        }
    }
}

/// How the control of the steps starts.
#[derive(Clone, Debug)]
pub(super) struct Adaptive {
    pub tolerance: f64,
    pub control: StepControlState,
    /// Substeps that may be tried.
    pub budget: usize,
}

/// One analysis, ready to go in a lane.
#[derive(Debug)]
pub struct LaneSetup {
    pub(super) shape: Shape,
    /// Coefficients of the usual step.
    pub rule: Vec<Mode>,
    pub(super) omega2: Vec<f64>,
    pub(super) damping: Vec<f64>,
    /// B of the lane coordinates over the modes.
    pub(super) rows: Vec<Vec<f64>>,
    pub(super) rotational: Vec<bool>,
    pub(super) forms: Vec<Form>,
    /// Index of the element of each link.
    pub(super) elements: Vec<usize>,
    /// Load of each channel over the modes.
    pub(super) forces: Vec<Vec<f64>>,
    /// Track of each channel, of unit amplitude where it varies, and its amplitude.
    pub(super) tracks: Vec<(Track, f64)>,
    pub(super) conservative: Vec<bool>,
    /// Table and amplitude of each channel that varies.
    pub(super) tables: Vec<Option<(Arc<Table>, f64)>>,
    /// Steps of output steps that are not steps of the grid.
    pub(super) cut: Vec<(usize, Vec<Piece>)>,
    pub(super) outputs: Vec<Output>,
    pub(super) q: Vec<f64>,
    pub(super) p: Vec<f64>,
    pub(super) a: Vec<f64>,
    pub(super) d: Vec<f64>,
    pub(super) v: Vec<f64>,
    pub(super) f: Vec<f64>,
    /// Stiffness of each coordinate, and the largest so far.
    pub(super) stiffness: Vec<f64>,
    pub(super) stiffest: Vec<f64>,
    /// Stiffness where the links are engaged.
    pub(super) engaged: Vec<f64>,
    pub(super) history: Vec<f64>,
    pub(super) stored: Vec<f64>,
    pub(super) scale: [f64; 2],
    pub(super) kinetic: f64,
    pub(super) strain: f64,
    pub(super) potential: f64,
    pub(super) watch: Watch,
    pub(super) contacts: Vec<Contact>,
    /// True where something stands on them, or falls onto them.
    pub(super) stands: bool,
    pub(super) values: Vec<f64>,
    pub(super) rates: Vec<f64>,
    /// Where steps are adaptive.
    pub(super) adaptive: Option<Adaptive>,
    /// Largest share of the energy that may be unaccounted for.
    pub energy_limit: f64,
    pub(super) tolerance: f64,
}

impl LaneSetup {
    /// Coefficients of a step of this length, s.
    pub(super) fn modes_of(&self, length: f64) -> Vec<Mode> {
        modes_of(&self.omega2, &self.damping, length)
    }

    /// Largest eigenvalue of G k of the engaged links in a step of which this are the modes.
    pub(super) fn stiffness_ratio(&self, modes: &[Mode]) -> f64 {
        stiffness_ratio(&self.rows, modes, &self.engaged)
    }

    /// Outputs, by their index in the model, of which the time above a value is wanted, or, where there is none, the
    /// root of the mean square.
    #[must_use]
    pub fn take_over_time(mut self, outputs: &[(usize, Option<f64>)]) -> Self {
        self.shape.integrals = outputs.to_vec();
        self
    }

    /// True where a law is not written over lanes: each link answers for itself.
    #[must_use]
    pub fn asks_links(&self) -> bool {
        self.forms.iter().any(|form| matches!(form.law, Law::One(_)))
    }

    /// True where both can go side by side.
    #[must_use]
    pub fn fits(&self, other: &Self) -> bool {
        self.shape == other.shape
    }
}

/// Modes, and link coordinates, at most.
pub(super) const ROOM: usize = 24;
/// Coordinates of one link at most, where there are others.
pub(super) const WIDEST: usize = 3;
/// Modes and coordinates of a body in space, which is the only link then.
pub(super) const BODY: usize = 6;

/// Coefficients of modes in a step of this length, s.
pub(super) fn modes_of(omega2: &[f64], damping: &[f64], step: f64) -> Vec<Mode> {
    omega2.iter().zip(damping).map(|(w, c)| single_mode::exact(*w, *c, step)).collect()
}
