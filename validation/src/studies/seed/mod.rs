//! The benchmark of rigid blocks by FNA: every test and figure of the paper, one file a test.
//!
//! The paper gives no size, stiffness or duration, so its curves can be laid beside these by shape and
//! mode; numbers are compared with closed forms, with the few the paper prints, and with an independent
//! event-driven program for the block of the shipped models.

mod chart;
mod compliant;
mod drop;
mod energy;
mod modes;
mod plots;
mod pulse;
mod reference;
mod rocking;
mod statics;
mod vertical;

use crate::{Study, Trace};
use trilith::model::{Analysis, TimeFunction};
use trilith::{Model, SolverKind};

/// Title of the paper.
const PAPER: &str = "Methodology for Prediction of Sliding and Rocking of Rigid Bodies Using Fast \
                     Non-Linear Analysis (FNA) Formulation";
/// The shipped block under sine pulses.
const BLOCK: &str = include_str!("../../../../models/rigid_block.ron");
/// The shipped block that is lifted and dropped.
const DROP: &str = include_str!("../../../../models/rigid_block_drop.ron");
/// The shipped block that rocks freely.
const ROCKING: &str = include_str!("../../../../models/rigid_block_rocking.ron");

const BOTH: [SolverKind; 2] = [SolverKind::Fna, SolverKind::Hht];

pub(super) fn studies() -> Vec<Study> {
    // The charts take longest.
    let parts = [
        chart::studies(),
        compliant::studies(),
        modes::studies(),
        pulse::studies(),
        vertical::studies(),
        drop::studies(),
        rocking::studies(),
        energy::studies(),
        statics::studies(),
    ];
    parts.concat()
}

/// Runs the last case of a text; a run that the solver itself doubts is an error.
fn run(
    text: &str,
    set: &[(&'static str, f64)],
    solver: SolverKind,
    change: impl FnOnce(&mut Model),
) -> Result<Trace, String> {
    let set: Vec<(&str, &dyn ToString)> =
        set.iter().map(|(name, value)| (*name, value as &dyn ToString)).collect();
    let trace = Trace::run(text, &set, solver, change)?;
    match &trace.complaint {
        Some(complaint) => Err(complaint.clone()),
        None => Ok(trace),
    }
}

/// Puts another function in the place of the one with this name.
fn replace(model: &mut Model, name: &str, with: TimeFunction) {
    for f in model.functions.iter_mut().filter(|f| f.name == name) {
        f.function = with.clone();
    }
}

/// Sets the output step of the dynamic case, s.
fn step(model: &mut Model, dt: f64) {
    for case in &mut model.cases {
        if let Analysis::Dynamic(dynamic) = &mut case.analysis {
            dynamic.dt = dt;
        }
    }
}
