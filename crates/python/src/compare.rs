//! One case in several ways.

use crate::column::Column;
use crate::failure::Failure;
use crate::model::json;
use crate::work::Watch;
use trilith::compare::{Compared, Comparison, Variant};
use trilith::model::Analysis;
use trilith::{Model, SolverKind};
use trilith_cli::told;

/// What is varied.
pub(crate) struct Ways {
    pub solvers: Vec<SolverKind>,
    pub dts: Vec<f64>,
    pub vectors: Vec<usize>,
    pub dummies: Vec<f64>,
    pub alphas: Vec<f64>,
    /// Whether the causes of differences are looked for.
    pub cause: bool,
}

/// A difference: output, of the peak, rms, lag in s, of the last value.
type DifferenceFacts = (String, f64, f64, f64, f64);
/// A variant: label, solver, summary as JSON, whether it is to be trusted, times, outputs, differences, and cause with
/// what shows it.
pub(crate) type Facts = (
    String,
    &'static str,
    String,
    bool,
    Column,
    Vec<(String, Column)>,
    Vec<DifferenceFacts>,
    Option<(&'static str, String)>,
);

/// Runs the ways; the program's text, and what each left.
pub(crate) fn compare(
    model: &mut Model,
    case: usize,
    ways: &Ways,
    watch: &Watch,
) -> Result<(String, Vec<Facts>), Failure> {
    let variants = variants(model, case, ways)?;
    let outputs: Vec<String> = model.outputs.iter().map(|o| o.name.clone()).collect();
    let result = {
        let mut comparison = Comparison::new(model, case, |_: &str| ()).until(&watch.interrupt);
        comparison.run(&variants, ways.cause)
    };
    let all = result.map_err(|e| Failure::of(&e, model))?;
    let facts = all.iter().map(|c| facts(c, &outputs)).collect::<Result<_, _>>()?;
    Ok((told::comparison(&all), facts))
}

fn facts(c: &Compared, outputs: &[String]) -> Result<Facts, Failure> {
    let histories = c.outcome.histories.iter().map(|h| Column::new(h.clone()));
    let differences =
        c.differences.iter().map(|d| (d.name.clone(), d.peak, d.rms, d.lag, d.residual));
    Ok((
        c.variant.to_string(),
        c.variant.solver.name(),
        json(&c.outcome.summary)?,
        c.outcome.good,
        Column::new(c.outcome.time.clone()),
        outputs.iter().cloned().zip(histories).collect(),
        differences.collect(),
        c.finding.as_ref().map(|f| (f.cause.word(), f.text.clone())),
    ))
}

/// Every combination, the first of each list before the others.
fn variants(model: &Model, case: usize, ways: &Ways) -> Result<Vec<Variant>, Failure> {
    let Analysis::Dynamic(dynamic) = &model.cases[case].analysis else {
        let message =
            format!("case \"{}\" is static: there is one solver for it", model.cases[case].name);
        return Err(Failure::argument(&message, Some("name a dynamic case")));
    };
    let Ways { solvers, dts, vectors, dummies, alphas, .. } = ways;
    let own = [dynamic.solution.solver];
    let solvers = if solvers.is_empty() { &own[..] } else { solvers };
    let mut all = Vec::new();
    for solver in solvers {
        let plain = Variant::new(*solver);
        let reduced = plain.is_reduced();
        // A list says nothing to a solver that has no such setting.
        let no_alpha = *solver == SolverKind::Fna;
        for dt in options(dts, true) {
            for vectors in options(vectors, reduced) {
                for dummies in options(dummies, reduced) {
                    for alpha in options(alphas, !no_alpha) {
                        all.push(Variant { dt, vectors, dummies, alpha, ..plain.clone() });
                    }
                }
            }
        }
    }
    if all.len() < 2 {
        let help = "such as solvers=[\"hht\", \"fna\"], dts=[0.01, 0.005] or vectors=[10, 20]";
        let message = "a comparison needs two solvers, or two values of a setting";
        return Err(Failure::argument(message, Some(help)));
    }
    Ok(all)
}

fn options<T: Copy>(list: &[T], takes: bool) -> Vec<Option<T>> {
    if list.is_empty() || !takes { vec![None] } else { list.iter().copied().map(Some).collect() }
}
