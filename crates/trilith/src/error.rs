//! What can go wrong between a model and its results.

use trilith_model::{Model, ModelError, Span};
use trilith_results::FileError;
use trilith_solvers::SolveError;
use trilith_system::SystemError;

/// What can go wrong between a model and its results.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum Error {
    /// A case that the model does not have.
    #[error("there is no case \"{name}\"; the cases are {}", .cases.join(", "))]
    UnknownCase {
        /// The name asked for.
        name: String,
        /// The names there are.
        cases: Vec<String>,
    },
    /// An output that the model does not have.
    #[error("the model has no output \"{0}\"")]
    UnknownOutput(String),
    /// The model cannot be one: it was made or changed in code, and refers to what does not exist, or holds numbers
    /// that cannot be.
    #[error("this is no model:{}", listed(.0))]
    Model(Vec<ModelError>),
    /// The structure cannot be assembled.
    #[error(transparent)]
    System(#[from] SystemError),
    /// The run cannot be made.
    #[error(transparent)]
    Solve(#[from] SolveError),
    /// The model cannot be calibrated.
    #[error(transparent)]
    Calibration(#[from] crate::calibrate::CalibrationError),
    /// The report of a folder cannot be made.
    #[error(transparent)]
    Report(#[from] crate::ReportError),
    /// A file cannot be written.
    #[error(transparent)]
    File(#[from] FileError),
    /// Somebody wanted an end.
    #[error("interrupted")]
    Interrupted,
}

impl Error {
    /// A case that a model does not have.
    #[must_use]
    pub fn unknown_case(model: &Model, name: &str) -> Self {
        let cases = model.cases.iter().map(|c| format!("\"{}\"", c.name)).collect();
        Self::UnknownCase { name: name.to_owned(), cases }
    }

    /// The place in the model file, where there is one.
    #[must_use]
    pub fn span(&self) -> Option<Span> {
        match self {
            Self::Model(all) => all.iter().map(|e| e.span.clone()).find(|span| !span.is_empty()),
            Self::System(e) => e.span(),
            Self::Solve(e) => e.span(),
            _ => None,
        }
    }
}

/// One a line.
fn listed(errors: &[ModelError]) -> String {
    errors.iter().map(|e| format!("\n  {e}")).collect()
}
