//! One model with many values of its parameters.

use crate::column::Column;
use crate::failure::Failure;
use crate::model::{Model, index};
use crate::work;
use pyo3::prelude::*;
use std::sync::Arc;
use trilith::Error;
use trilith::model::ParameterValue;
use trilith::results::Peak;
use trilith::solvers::{ContactSummary, Status};
use trilith::sweep::{Combination, Engine, Outcome, Sweep, SweepError};
use trilith_cli::told;

/// A column of numbers by its name.
type Named = (String, Column);

/// What a sweep gave, a row for each combination.
#[derive(Default)]
struct Rows {
    status: Vec<&'static str>,
    good: Vec<bool>,
    message: Vec<String>,
    engine: Vec<&'static str>,
    modes: Vec<Option<(&'static str, &'static str)>>,
}

/// Columns: status, whether to be trusted, message, engine, contact modes; then numbers by name.
type Table = (
    Vec<&'static str>,
    Vec<bool>,
    Vec<String>,
    Vec<&'static str>,
    Vec<Option<(&'static str, &'static str)>>,
    Vec<(String, [Column; 5])>,
    Vec<Named>,
);

/// Numbers that every run has, beside its outputs.
const NUMBERS: [&str; 16] = [
    "energy.input",
    "energy.kinetic",
    "energy.strain",
    "energy.potential",
    "energy.modal_damping",
    "energy.link_stored",
    "energy.link_hysteretic",
    "energy.link_viscous",
    "energy.algorithmic",
    "energy.error",
    "energy.error_relative",
    "steps",
    "iterations",
    "contact.max_uplift",
    "contact.max_slip",
    "contact.residual_slip",
];

/// Runs all combinations, several to a core where the model fits.
#[pyfunction]
#[pyo3(signature = (model, case, combinations, fixed_steps, threads))]
pub(crate) fn sweep(
    py: Python<'_>,
    model: &Bound<'_, Model>,
    case: Option<String>,
    combinations: Vec<Combination>,
    fixed_steps: Option<usize>,
    threads: Option<usize>,
) -> PyResult<Table> {
    let it = model.get();
    let (first, text, path) = (Arc::clone(&it.model), Arc::clone(&it.text), it.path.clone());
    let (set, laws) = (it.set.clone(), it.laws.clone());
    work::run(py, move |watch| {
        let case = index(&first, case.as_deref())?;
        known(&first, &combinations)?;
        let mut sweep = Sweep::new(&*text, path, laws.registry())
            .case(first.cases[case].name.clone())
            .until(Arc::clone(&watch.interrupt));
        if let Some(substeps) = fixed_steps {
            sweep = sweep.fixed_steps(substeps);
        }
        if let Some(threads) = threads {
            sweep = sweep.threads(threads);
        }
        // What the model was read with holds for all, but where a combination says otherwise.
        let whole: Vec<Combination> = combinations.into_iter().map(|c| over(&set, c)).collect();
        Ok(table(&first, &sweep.run(&whole)))
    })
}

fn over(set: &[(String, String)], combination: Combination) -> Combination {
    let kept = set.iter().filter(|(name, _)| !combination.iter().any(|(own, _)| own == name));
    let mut all: Combination = kept.cloned().collect();
    all.extend(combination);
    all
}

/// Refuses names that are no parameters before anything runs.
fn known(model: &trilith::Model, combinations: &[Combination]) -> Result<(), Failure> {
    let names = model.parameters.iter().map(|p| p.name.as_str());
    for (name, value) in combinations.iter().flatten() {
        let Some(parameter) = model.parameters.iter().find(|p| p.name == *name) else {
            return Err(Failure::unknown("parameter", name, "parameters", names));
        };
        let number = matches!(parameter.value, ParameterValue::Number(..));
        if number && ["nan", "inf", "-inf", "NaN"].contains(&value.as_str()) {
            let message =
                format!("the value `{value}` of parameter \"{name}\" is no finite number");
            return Err(Failure::argument(&message, None));
        }
    }
    Ok(())
}

fn table(model: &trilith::Model, outcomes: &[Result<Outcome, SweepError>]) -> Table {
    let n = outcomes.len();
    let mut rows = Rows::default();
    let columns = || vec![f64::NAN; n];
    let mut peaks: Vec<[Vec<f64>; 5]> =
        model.outputs.iter().map(|_| std::array::from_fn(|_| columns())).collect();
    let mut numbers: Vec<Vec<f64>> = NUMBERS.iter().map(|_| columns()).collect();
    for (row, outcome) in outcomes.iter().enumerate() {
        let o = match outcome {
            Ok(outcome) => outcome,
            Err(e) => {
                let (status, message) = failed(e, model);
                rows.push(status, false, message, "none", None);
                continue;
            }
        };
        let message = match o.status {
            Status::Converged => o.warnings.join("\n"),
            ref other => other.text(),
        };
        let engine = match o.engine {
            Engine::Lanes => "lanes",
            Engine::Ordinary(_) => "ordinary",
            Engine::Rerun => "rerun",
        };
        let contact = o.contact.as_ref();
        let modes = contact.map(|c| (c.initial_mode, c.mode));
        rows.push(o.status.word(), o.status.is_good(), message, engine, modes);
        for (columns, (_, peak)) in peaks.iter_mut().zip(&o.outputs.0) {
            let Peak { max, t_max, min, t_min, last } = *peak;
            columns.iter_mut().zip([max, t_max, min, t_min, last]).for_each(|(c, x)| c[row] = x);
        }
        for (column, x) in numbers.iter_mut().zip(of(o, contact)) {
            column[row] = x;
        }
    }
    let names = model.outputs.iter().map(|o| o.name.clone());
    let peaks = names.zip(peaks.into_iter().map(|five| five.map(Column::new))).collect();
    let numbers = numbers.into_iter().map(Column::new);
    let numbers = NUMBERS.iter().map(|name| (*name).to_owned()).zip(numbers).collect();
    let Rows { status, good, message, engine, modes } = rows;
    (status, good, message, engine, modes, peaks, numbers)
}

/// In the order of [`NUMBERS`].
fn of(o: &Outcome, contact: Option<&ContactSummary>) -> [f64; NUMBERS.len()] {
    let of_contact = |value: fn(&ContactSummary) -> f64| contact.map_or(f64::NAN, value);
    let mut all = [0.0; NUMBERS.len()];
    let (energies, more) = all.split_at_mut(11);
    energies.copy_from_slice(&o.energy.values());
    more.copy_from_slice(&[
        o.steps as f64,
        o.iterations as f64,
        of_contact(|c| c.max_uplift),
        of_contact(|c| c.max_slip),
        of_contact(|c| c.residual_slip),
    ]);
    all
}

fn failed(error: &SweepError, model: &trilith::Model) -> (&'static str, String) {
    match error {
        SweepError::Model(all) => ("model error", told::diagnostics(all)),
        SweepError::Run(Error::Interrupted) => ("interrupted", "interrupted".into()),
        SweepError::Run(e) => ("error", told::error(e, model)),
        other => ("error", other.to_string()),
    }
}

impl Rows {
    fn push(
        &mut self,
        status: &'static str,
        good: bool,
        message: String,
        engine: &'static str,
        modes: Option<(&'static str, &'static str)>,
    ) {
        self.status.push(status);
        self.good.push(good);
        self.message.push(message);
        self.engine.push(engine);
        self.modes.push(modes);
    }
}
