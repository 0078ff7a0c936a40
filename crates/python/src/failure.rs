//! What goes wrong, as the exceptions of `trilith._errors`.

use crate::laws;
use pyo3::prelude::*;
use trilith::model::{file::names_help, line_column};
use trilith::solvers::{LawFault, SolveError};
use trilith::{Diagnostic, Error, Model};
use trilith_cli::told;

/// One thing that is said of a model: level, code, message, label, help, file, line and column from 1 (0 for no place).
pub(crate) type Told = (&'static str, String, String, String, Option<String>, String, usize, usize);

/// Why a call gives no result.
#[derive(Debug)]
pub(crate) enum Failure {
    /// The model is wrong: `ModelError`.
    Model(String, Vec<Told>),
    /// It is right, but the run cannot be made: `RunError`.
    Run(String),
    /// A law is wrong: `LawError`, with the exception that it raised as its cause.
    Law(String),
    /// An argument is wrong: `ArgumentError`.
    Argument(String),
    /// A law does not keep the contract of links: `ConformanceError`.
    Conformance(String),
    /// A file cannot be read or written: `FileError`.
    File(String),
    /// A defect of Trilith: `InternalError`.
    Internal(String),
}

impl Failure {
    /// All errors of a model file.
    pub fn diagnostics(all: &[Diagnostic]) -> Self {
        Self::Model(told::diagnostics(all), all.iter().map(diagnostic).collect())
    }

    /// A structure or a run that cannot be made.
    pub fn of(error: &Error, model: &Model) -> Self {
        let text = told::error(error, model);
        match error {
            Error::File(_) | Error::Report(_) => Self::File(text),
            Error::Solve(SolveError::Law { fault, .. })
                if !matches!(fault, LawFault::Refuses { .. }) =>
            {
                Self::Law(text)
            }
            Error::UnknownCase { .. } | Error::UnknownOutput(_) => Self::Argument(text),
            e if told::is_of_the_run(e) => Self::Run(text),
            e => Self::Model(text, vec![placed(e, model)]),
        }
    }

    /// A wrong argument, and what would be right.
    pub fn argument(message: &str, help: Option<&str>) -> Self {
        Self::Argument(told::plain(message, help))
    }

    /// A name that there is not.
    pub fn unknown<'a>(
        what: &str,
        name: &str,
        all: &str,
        names: impl IntoIterator<Item = &'a str> + Clone,
    ) -> Self {
        let message = format!("there is no {what} \"{name}\"");
        Self::argument(&message, Some(&names_help(name, all, names)))
    }

    pub fn into_exception(self, py: Python<'_>) -> PyErr {
        let cause = match &self {
            Self::Law(text) | Self::Model(text, _) => laws::raised(py, text),
            _ => None,
        };
        match self.raised(py) {
            Ok(exception) => {
                let exception = PyErr::from_value(exception);
                if cause.is_some() {
                    exception.set_cause(py, cause);
                }
                exception
            }
            Err(e) => e,
        }
    }

    fn raised(self, py: Python<'_>) -> PyResult<Bound<'_, PyAny>> {
        let errors = py.import("trilith._errors")?;
        let (class, text) = match self {
            Self::Model(text, told) => {
                return errors.getattr("ModelError")?.call1((text.trim_end(), told));
            }
            Self::Run(text) => ("RunError", text),
            Self::Law(text) => ("LawError", text),
            Self::Conformance(text) => ("ConformanceError", text),
            Self::Argument(text) => ("ArgumentError", text),
            Self::File(text) => ("FileError", text),
            Self::Internal(text) => ("InternalError", text),
        };
        errors.getattr(class)?.call1((text.trim_end(),))
    }
}

/// An error of a model file.
pub(crate) fn diagnostic(d: &Diagnostic) -> Told {
    let file = d.source.path.display().to_string();
    let (line, column) = if d.source.text.is_empty() { (0, 0) } else { (d.line(), d.column()) };
    ("error", d.code.into(), d.message.clone(), d.label.clone(), d.help.clone(), file, line, column)
}

/// An error of the assembly, where the model has a place for it.
pub(crate) fn placed(error: &Error, model: &Model) -> Told {
    let place = error.span().map(|span| model.places.find(&span));
    let (file, (line, column)) = match &place {
        Some(p) => (p.source.path.clone(), line_column(&p.source.text, p.span.start)),
        None => (model.source.path.clone(), (0, 0)),
    };
    let indices = place.as_ref().map(|p| p.indices()).filter(|i| !i.is_empty());
    let label = indices.map_or_else(String::new, |i| format!("with {i}"));
    let file = file.display().to_string();
    ("error", String::new(), error.to_string(), label, None, file, line, column)
}
