//! Whether a checkpoint fits the run that is to go on from it.

use super::end_state::EndState;
use crate::error::SolveError;
use trilith_model::{Case, Model, ParameterValue, SolverKind};
use trilith_system::System;

/// Parameters of a model as a checkpoint holds them; numbers read back to the bit.
pub(super) fn parameters(model: &Model) -> Vec<(String, String)> {
    let text = |v: &ParameterValue| match v {
        ParameterValue::Number(x, _) => format!("{x:e}"),
        ParameterValue::Text(t) => t.clone(),
    };
    model.parameters.iter().map(|p| (p.name.clone(), text(&p.value))).collect()
}

/// Refuses a checkpoint of another model, case or solver, or of other parameters.
fn check_run(model: &Model, case: &Case, solver: &str, end: &EndState) -> Result<(), SolveError> {
    for (what, here, there) in [
        ("model", &*model.sha256(), &end.model),
        ("case", &*case.name, &end.case),
        ("solver", solver, &end.solver),
    ] {
        if here != there {
            return differs(what, there, here);
        }
    }
    for (a, b) in parameters(model).iter().zip(&end.parameters) {
        if a != b {
            return differs(&format!("parameter `{}`", b.0), &b.1, &a.1);
        }
    }
    Ok(())
}

fn differs(what: &str, there: &str, here: &str) -> Result<(), SolveError> {
    refuse(format!("its {what} is {there}, this run's is {here}"))
}

fn refuse(reason: String) -> Result<(), SolveError> {
    Err(SolveError::Checkpoint { reason })
}

/// Refuses any checkpoint for a static case.
pub(super) fn check_static(model: &Model, case: &Case, end: &EndState) -> Result<(), SolveError> {
    check_run(model, case, "static", end)?;
    refuse(format!("its case {} is static: there is no time to go on from", case.name))
}

/// Refuses a checkpoint of another model, other parameters, another case, solver or output step, and one
/// that was damaged.
pub(super) fn check(
    model: &Model,
    system: &System,
    case: &Case,
    kind: SolverKind,
    dt: f64,
    end: &EndState,
) -> Result<(), SolveError> {
    check_run(model, case, kind.name(), end)?;
    if dt != end.dt {
        return differs("output step", &format!("{} s", end.dt), &format!("{dt} s"));
    }
    let (links, state) = (&system.links, &end.state);
    let flat = [&state.d, &state.v, &state.f].iter().all(|x| x.len() == links.len());
    let active = [&state.stiffest, &state.pseudo];
    let active = active.iter().all(|x| x.len() == links.active.len());
    let tangents = [&state.tangents.k, &state.tangents.c];
    let blocks = end.memory.iter().flat_map(|m| [&m.k, &m.c]).chain(tangents);
    let whole = model.parameters.len() == end.parameters.len()
        && flat
        && active
        && end.load.len() == system.order()
        && state.history.len() == links.history_len
        && state.stored.len() == links.links.len()
        && end.ledger.links.len() == links.links.len()
        && { blocks }.all(|x| x.len() == links.block_len);
    if whole { Ok(()) } else { refuse("its arrays have not the sizes of this model".into()) }
}
