//! One output step: its segments, with loads that jump between them.

use super::timeline::{Segment, Timeline};
use super::{March, StepControlState, Stop};
use crate::record::Ledger;
use crate::step::{State, StepEnergy};
use crate::structure::ReducedSystem;
use crate::vector::dot;
use trilith_model::{Side, StepControl};
use trilith_system::{Channel, LoadSet};

/// What changes during a run.
pub(crate) struct Moving {
    pub state: Box<State>,
    pub control: StepControlState,
    pub ledger: Ledger,
}

/// Which moment of a run is reported.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Moment {
    /// Behind a jump of the loads.
    Jump,
    /// The end of a substep in a segment of the output step.
    Substep(Segment),
}

/// Receives the moments of a run, their times and states.
pub(super) type Report<'a> = dyn FnMut(Moment, f64, &State, &Ledger) + 'a;

/// Steps that are made of a segment of the timeline at least.
pub(crate) fn at_least(step: StepControl) -> usize {
    match step {
        StepControl::Fixed { substeps } => substeps,
        StepControl::Adaptive { .. } => 1,
    }
}

/// How the amplitudes of the loads jump at a time; none where they do not.
pub(crate) fn jump(loads: &LoadSet, t: f64) -> Option<Vec<f64>> {
    let jump = |c: &Channel| c.track.at(t, Side::After) - c.track.at(t, Side::Before);
    let change: Vec<f64> = loads.channels.iter().map(jump).collect();
    change.iter().any(|x| *x != 0.0).then_some(change)
}

/// Makes an output step; `constant`: constant loads in the coordinates of the solver.
pub(crate) fn output_step(
    timeline: &Timeline,
    step: usize,
    march: &mut March<'_>,
    constant: &[f64],
    moving: &mut Moving,
    report: &mut Report<'_>,
) -> Result<(), Stop> {
    if let Some(segment) = timeline.plain(step) {
        return march_segment(march, segment, constant, moving, report);
    }
    for segment in timeline.pieces(step) {
        let Moving { state, ledger, .. } = &mut *moving;
        let t0 = segment.start;
        if t0 > 0.0 && timeline.is_jump(t0) {
            march.cut();
            if let Some(change) = jump(march.loads, t0) {
                march.stepper.jump(state, &change).map_err(Stop::Fatal)?;
                report(Moment::Jump, t0, state, ledger);
            }
        }
        march_segment(march, segment, constant, moving, report)?;
    }
    Ok(())
}

/// A segment of an output step.
#[inline]
fn march_segment(
    march: &mut March<'_>,
    segment: Segment,
    constant: &[f64],
    moving: &mut Moving,
    report: &mut Report<'_>,
) -> Result<(), Stop> {
    let Moving { state, control, ledger } = moving;
    let mut accept = |t: f64, s: &State, e: &StepEnergy| -> f64 {
        let energy = ledger.enter(e, potential(constant, s));
        report(Moment::Substep(segment), t, s, ledger);
        energy
    };
    march.segment(state, control, segment, &mut accept)
}

/// Σ of constant loads in the coordinates of the solver; empty where there are none.
pub(crate) fn constant_force(space: &ReducedSystem, loads: &LoadSet) -> Vec<f64> {
    if !loads.channels.iter().any(|c| c.conservative) {
        return Vec::new();
    }
    let amplitudes: Vec<f64> =
        loads.channels.iter().map(|c| f64::from(u8::from(c.conservative))).collect();
    space.force(&amplitudes)
}

/// Potential of the constant loads.
pub(crate) fn potential(constant: &[f64], state: &State) -> f64 {
    if constant.is_empty() { 0.0 } else { -dot(constant, &state.motion[..constant.len()]) }
}
