//! What the program says of errors and results, as plain text, for other faces of it: a package for another language
//! says the same.

use trilith::combine::Combinations;
use trilith::compare::Compared;
use trilith::optimize::Optimum;
use trilith::results::Summary;
use trilith::solvers::gradient::Gradient;
use trilith::solvers::{BasisReport, LinearModes, Linearised, SolveError};
use trilith::{Diagnostic, Error, Model};
use trilith_diagnostics::{self as diagnostics, Renderer};

/// All errors of a model file, each with its line and a caret.
#[must_use]
pub fn diagnostics(all: &[Diagnostic]) -> String {
    diagnostics::all(&Renderer::plain(), all)
}

/// A structure or a run that cannot be made, shown in the model file where it has a place there.
#[must_use]
pub fn error(error: &Error, model: &Model) -> String {
    let renderer = Renderer::plain();
    match error.span() {
        Some(span) => diagnostics::at(&renderer, &error.to_string(), &model.places.find(&span)),
        None => diagnostics::plain(&renderer, &error.to_string(), None),
    }
}

/// True for an error that no other model file would help against, but other settings or more work might.
#[must_use]
pub fn is_of_the_run(error: &Error) -> bool {
    matches!(
        error,
        Error::Solve(
            SolveError::StaticNotConverged { .. }
                | SolveError::JointNotHeld { .. }
                | SolveError::Predecessor { .. }
                | SolveError::Interrupted { .. }
        ) | Error::Interrupted
    )
}

/// Something wrong outside a model file, and what would be right.
#[must_use]
pub fn plain(message: &str, help: Option<&str>) -> String {
    diagnostics::plain(&Renderer::plain(), message, help)
}

/// What `trilith run` prints.
#[must_use]
pub fn run(model: &Model, summary: &Summary) -> String {
    crate::report::text(model, summary)
}

/// What `trilith modes --links …` prints of modes with links.
#[must_use]
pub fn linked_modes(linear: &Linearised<'_>, modes: &LinearModes) -> String {
    crate::modes::linked::told(linear, modes)
}

/// What `trilith modes` prints below the title.
#[must_use]
pub fn modes(report: &BasisReport) -> String {
    crate::modes::text(report)
}

/// What `trilith compare` prints below the title; `all` has one or more.
#[must_use]
pub fn comparison(all: &[Compared]) -> String {
    if all.is_empty() { String::new() } else { crate::compare::text(all) }
}

/// What `trilith combine` prints.
#[must_use]
pub fn combinations(model: &Model, found: &Combinations) -> String {
    crate::combine::page(model, found)
}

/// What `trilith gradient` prints of these outputs, and of the energy put in where that was found.
#[must_use]
pub fn gradient(model: &Model, case: &str, found: &Gradient, outputs: &[usize]) -> String {
    use crate::gradient::Asked;
    let input = found.input.iter().map(|_| Asked::Input);
    let asked: Vec<_> = outputs.iter().map(|o| Asked::Output(*o)).chain(input).collect();
    crate::gradient::page(model, &crate::gradient::told(model, case, found, &asked))
}

/// What `trilith optimize` prints, but for the command of the best run, and what it gives as JSON.
#[must_use]
pub fn optimum(
    model: &Model,
    case: &str,
    found: &Optimum,
    most: usize,
) -> (String, impl serde::Serialize) {
    let told = crate::optimize::told(&model.title, case, found, "");
    let page = crate::optimize::page(&told, found, most);
    (page, serde_json::to_value(told).unwrap_or_default())
}
