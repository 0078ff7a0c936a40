//! What ends a command early.

use crate::diagnostics;
use crate::interrupt::INTERRUPTED;
use trilith::results::FolderError;
use trilith::solvers::SolveError;
use trilith::{Diagnostic, Error, Model};

/// A text for stderr and an exit status.
pub(crate) struct Failure {
    pub text: String,
    pub status: i32,
}

impl Failure {
    /// All errors of a model file.
    pub fn diagnostics(all: &[Diagnostic]) -> Self {
        Self { text: diagnostics::all(all), status: 2 }
    }

    /// Wrong input outside the model file.
    pub fn input(message: &str, help: Option<&str>) -> Self {
        Self { text: diagnostics::plain(message, help), status: 2 }
    }

    /// A file that cannot be written.
    pub fn unwritable(path: &std::path::Path, error: &std::io::Error) -> Self {
        Self::input(&format!("{} cannot be written: {error}", path.display()), None)
    }

    /// A folder that results cannot go to.
    pub fn folder(error: &FolderError) -> Self {
        let help = match error {
            FolderError::NotAFolder(_) | FolderError::Input(_) => {
                Some("`--out DIR` names another folder")
            }
            FolderError::InTheWay { .. } => {
                Some("move it elsewhere, or `--out DIR` names another folder")
            }
            FolderError::Taken(_) => Some("wait for its end, or `--out DIR` names another folder"),
            _ => None,
        };
        Self::input(&error.to_string(), help)
    }

    /// A structure or a run that cannot be made, shown in the model file where it has a place there.
    pub fn of(error: &Error, model: &Model) -> Self {
        let status = match error {
            Error::Solve(
                SolveError::StaticNotConverged { .. }
                | SolveError::JointNotHeld { .. }
                | SolveError::Law { .. }
                | SolveError::Predecessor { .. },
            ) => 1,
            Error::Solve(SolveError::Interrupted { .. }) => INTERRUPTED,
            _ => 2,
        };
        let text = match error.span() {
            Some(span) => diagnostics::at(&error.to_string(), &model.places.find(&span)),
            None => diagnostics::plain(&error.to_string(), None),
        };
        Self { text, status }
    }
}
