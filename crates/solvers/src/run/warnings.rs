//! What there is to say of a case from the extremes of its outputs alone, where nobody watched it on its way.

use super::case::constant_load;
use super::p_delta::assemble;
use super::result::Status;
use crate::checks::{FAR, away, beyond, drives, of_model, size, weightless};
use crate::error::SolveError;
use crate::record::Peak;
use trilith_model::{Analysis, Case, DynamicCase, Load, Model, Quantity, Side};

/// As of a run, as far as outputs tell: weights that are missing, displacements that are larger than the model, what
/// the model says by itself. Contacts that are too soft and bodies that meet on the way leave no trace in outputs.
///
/// # Errors
/// As an assembly has them.
pub fn of_outputs(
    model: &Model,
    case: usize,
    (status, peaks): (&Status, &[Peak]),
) -> Result<Vec<String>, SolveError> {
    let own = &model.cases[case];
    let Analysis::Dynamic(analysis) = &own.analysis else { return Ok(Vec::new()) };
    let mut all = Vec::new();
    let loads = held(model, own);
    let weight = |load: &Load| matches!(load, Load::Gravity { factor } if *factor != 0.0);
    if drives(analysis) && !(model.gravity != 0.0 && loads.iter().any(weight)) {
        let system = assemble(model)?;
        let constant = constant_load(model, &system, &loads);
        all.extend(weightless(model, &system, own, analysis, &constant));
    }
    // One that fell over is far from its place, and the status says why.
    if !matches!(status, Status::Overturned { .. }) {
        all.extend(left(model, analysis, peaks)?);
    }
    all.extend(of_model(model)?);
    Ok(all)
}

/// Constant loads of a case and of those that it continues.
fn held(model: &Model, case: &Case) -> Vec<Load> {
    let earlier = std::iter::successors(case.after, |case| model.cases[*case].after);
    let all = std::iter::once(case).chain(earlier.map(|i| &model.cases[i]));
    let loads = all.flat_map(|case| match &case.analysis {
        Analysis::Static(of) => &of.loads,
        Analysis::Dynamic(of) => &of.constant,
    });
    loads.cloned().collect()
}

/// The farthest of the nodes that outputs tell of, where it is farther than the model is large.
fn left(
    model: &Model,
    analysis: &DynamicCase,
    peaks: &[Peak],
) -> Result<Option<String>, SolveError> {
    let moved = model.outputs.iter().zip(peaks).filter_map(|(output, peak)| {
        let Quantity::Displacement(terms) = &output.quantity else { return None };
        let [term] = &terms[..] else { return None };
        let whole = term.dof.index() < 3 && term.factor.abs() == 1.0;
        whole.then_some((term.node, peak.last.abs()))
    });
    let Some((node, moved)) = moved.max_by(|a, b| a.1.total_cmp(&b.1)) else { return Ok(None) };
    let Some(size) = size(model) else {
        return Ok((moved > FAR).then(|| away(model, node, moved)));
    };
    if moved <= size {
        return Ok(None);
    }
    let mut carried = 0.0;
    if !analysis.supports.is_empty() {
        let system = assemble(model)?;
        let loads = system.dynamic_loads(model, analysis, vec![0.0; system.order()]);
        let count = system.reduction.prescribed.len();
        let [supports, _, _] = loads.prescribed(analysis.duration, Side::Before, count);
        carried = supports.iter().fold(0.0, |most: f64, u| most.max(u.abs()));
    }
    Ok((moved > size + carried).then(|| beyond(model, node, moved, size)))
}
