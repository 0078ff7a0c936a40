//! Derivatives of outputs by parameters, and values of parameters that make a goal smallest.

use crate::column::Column;
use crate::failure::Failure;
use crate::model::json;
use crate::work::Watch;
use trilith::gradient::{self, GradientError};
use trilith::model::ModelText;
use trilith::optimize::{self, OptimizeError, Stop};
use trilith::solvers::SolveError;
use trilith::solvers::gradient::{Extreme, OutputGradient};
use trilith::{Error, Model, Registry};
use trilith_cli::told;

/// A value: time in s, the value, derivatives by each parameter.
type ValueFacts = (f64, f64, Vec<f64>);
/// An output: name, unit, history, derivatives of it by each parameter; largest, smallest value, largest magnitude and value at the end.
type OutputFacts = (String, String, Column, Vec<Column>, [ValueFacts; 4]);
/// The program's text; times; parameters with value and unit; outputs; what links have turned into heat, and what loads and supports have put in, where that is
/// asked for, until the end, with derivatives; links whose laws bend, when first and how often; substeps.
pub(crate) type GradientFacts = (
    String,
    Column,
    Vec<(String, f64, String)>,
    Vec<OutputFacts>,
    Vec<(String, f64, Vec<f64>)>,
    Option<(f64, Vec<f64>)>,
    Vec<(String, f64, usize)>,
    usize,
);
/// The program's text, and all that was found as JSON.
pub(crate) type OptimumFacts = (String, String);

/// Finds the derivatives of some outputs, or of all; `of` may name the energy put in among them.
pub(crate) fn gradient(
    model: &Model,
    (text, kinds): (&ModelText, &Registry),
    mut wanted: gradient::Wanted,
    of: &[String],
    watch: &Watch,
) -> Result<GradientFacts, Failure> {
    let index = |name: &String| {
        let place = model.output(name);
        let all = model.outputs.iter().map(|o| o.name.as_str());
        place.ok_or_else(|| Failure::unknown("output", name, "outputs", all))
    };
    let outputs = match of {
        [] => model.shown().map(|(i, _)| i).collect(),
        of => {
            let mut named: Vec<_> = of.iter().collect();
            if model.output(gradient::INPUT).is_none() {
                named.retain(|name| *name != gradient::INPUT);
                wanted.input = named.len() < of.len();
            }
            named.into_iter().map(index).collect::<Result<Vec<_>, _>>()?
        }
    };
    if outputs.is_empty() && !wanted.input {
        return Err(Failure::argument("the model has no output", None));
    }
    let found = gradient::gradient_until(text, kinds, &wanted, &watch.interrupt);
    let found = found.map_err(|e| refused(e, model))?;
    let case = wanted.case.as_deref().unwrap_or_default();
    let page = told::gradient(model, case, &found, &outputs);
    let unit = |name: &str| {
        let unit = model.parameters.iter().find(|p| p.name == name).map(|p| &p.value);
        match unit {
            Some(trilith::model::ParameterValue::Number(_, d)) => d.unit(),
            _ => String::new(),
        }
    };
    let parameters = found.parameters.iter().zip(&found.values);
    let parameters = parameters.map(|(name, x)| (name.clone(), *x, unit(name))).collect();
    let end = found.time.last().copied().unwrap_or(0.0);
    let facts = outputs.iter().map(|o| facts(&found.outputs[*o], &model.outputs[*o].unit, end));
    Ok((
        page,
        Column::new(found.time.clone()),
        parameters,
        facts.collect(),
        found.heat.iter().map(|h| (h.link.clone(), h.heat, h.by.clone())).collect(),
        found.input.clone(),
        found.bends.iter().map(|b| (b.link.clone(), b.t, b.count)).collect(),
        found.substeps,
    ))
}

fn facts(of: &OutputGradient, unit: &str, end: f64) -> OutputFacts {
    let value = |e: Extreme| (e.t, e.value, e.by);
    let (last, by) = of.last().unwrap_or_default();
    (
        of.name.clone(),
        unit.to_owned(),
        Column::new(of.history.clone()),
        of.by.iter().map(|by| Column::new(by.clone())).collect(),
        [value(of.max.clone()), value(of.min.clone()), value(of.peak()), (end, last, by)],
    )
}

/// Searches, until somebody wants an end.
pub(crate) fn optimize(
    model: &Model,
    (text, kinds): (&ModelText, &Registry),
    wanted: &optimize::Wanted,
    watch: &Watch,
) -> Result<OptimumFacts, Failure> {
    let mut on_run = |i: usize, _: &optimize::Evaluation| {
        watch.tell((i + 1) as f64 / wanted.max_runs as f64);
    };
    let found = optimize::optimize_with(text, kinds, wanted, &mut on_run, &watch.interrupt);
    let found = found.map_err(|e| match e {
        OptimizeError::Gradient(e) => refused(e, model),
        e => Failure::argument(&e.to_string(), None),
    })?;
    if found.stop == Stop::Interrupted {
        return Err(Failure::of(&Error::Interrupted, model));
    }
    let case = wanted.case.as_deref().unwrap_or_default();
    let (page, facts) = told::optimum(model, case, &found, wanted.max_runs);
    Ok((page, json(&facts)?))
}

/// Why there are no derivatives.
fn refused(error: GradientError, model: &Model) -> Failure {
    match error {
        GradientError::Run(Error::Solve(e @ SolveError::NoGradient { .. })) => {
            Failure::Run(told::error(&e.into(), model))
        }
        GradientError::Run(e) => Failure::of(&e, model),
        GradientError::Model(all) => Failure::diagnostics(&all),
        GradientError::UnknownParameter { name, .. } => {
            let all = model.parameters.iter().map(|p| p.name.as_str());
            Failure::unknown("parameter", &name, "parameters", all)
        }
        GradientError::Beside { ref errors, .. } => Failure::Model(
            told::plain(&error.to_string(), None),
            errors.iter().map(crate::failure::diagnostic).collect(),
        ),
        e => Failure::argument(&e.to_string(), None),
    }
}
