//! Sweeps: one small model with many values of its parameters, several analyses side by side.
//!
//! ```text
//! registers hold one number of each of eight analyses; all make a step at once
//! q, q̇:  the exact recurrences of FNA, with coefficients of each analysis
//! f = law(d* − G f, v* − H f):  Newton in the link coordinates; who has converged is held by a mask
//! ```
//!
//! An analysis that goes alone fills the registers with what it has of a kind itself: modes, link coordinates, links of
//! one law, outputs.
//!
//! With fixed steps all are at the same time (`march`); one that finds no equilibrium in a step makes that in halves
//! (`pieces`). With adaptive steps each has a time and a length of its own (`adaptive`, `way`), and its errors are those
//! of the ordinary engine (`error`, `turning`); output steps are halved beforehand where modes or links are too fast for
//! them. Who finds no equilibrium in however short a step, or an error that no step is short enough for, is given up and
//! says so: the caller runs it on the ordinary engine. So does who ends as no model is meant to (`watch`): lanes warn of nothing.
//!
//! Every analysis gives the same bits whoever its neighbours are, and alone.
//!
//! A model fits where it is solved by `fna` with Newton's method, it has few modes and link coordinates (`ROOM` in `setup`),
//! its modes are not coupled by damping, no support moves a link, and every link that has no form for lanes, and so is asked
//! for one lane after the other (`each`), says what it stores and loses. A body that may overturn needs adaptive steps.

mod adaptive;
mod blocks;
mod coefficients;
mod contact;
mod each;
mod error;
mod form;
mod grid;
mod integral;
mod laws;
mod loads;
mod march;
mod newton;
mod outcome;
mod outputs;
mod peaks;
mod pieces;
mod plan;
mod prepare;
mod record;
mod rules;
mod search;
mod setup;
mod show;
mod sizes;
mod small;
mod state;
mod step;
mod tables;
mod trial;
mod turning;
mod uncoupled;
mod watch;
mod way;

pub use integral::Integral;
pub use march::{Instructions, march, march_by};
pub use prepare::prepare;
pub use setup::LaneSetup;
pub use tables::Tables;

use crate::record::{ContactSummary, EnergyTotals, LinkEnergy};

/// Analyses that go side by side.
#[must_use]
pub fn width() -> usize {
    march::width()
}

/// Takes what an analysis has left as soon as it is there, with its index; where it says no, none is begun any more.
pub type Done<'a> = &'a mut dyn FnMut(usize, LaneOutcome) -> bool;

/// What one analysis of a sweep left.
#[derive(Clone, Debug)]
pub struct LaneOutcome {
    /// Time at which it found no equilibrium and was given up, s; what follows is rubbish then.
    pub lost: Option<f64>,
    /// Time at which it ended because a body has overturned, s, and the index of its element.
    pub overturned: Option<(f64, usize)>,
    /// Steps.
    pub steps: usize,
    /// Evaluations of the link laws.
    pub iterations: usize,
    /// Extremes of the outputs, in the order of the model.
    pub outputs: Vec<crate::Peak>,
    /// What was to be [taken over time](LaneSetup::take_over_time).
    pub integrals: Vec<f64>,
    /// Energies at the end.
    pub energy: EnergyTotals,
    /// Energies of each link at the end: (index of the element, energies).
    pub link_energy: Vec<(usize, LinkEnergy)>,
    /// How the contacts behaved.
    pub contact: Option<ContactSummary>,
    /// True where the ordinary engine warns: a node has left, a contact was pressed in too deep, or all motion counts
    /// for nothing beside what stands in springs.
    pub noticed: bool,
}
