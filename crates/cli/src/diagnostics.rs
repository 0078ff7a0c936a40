//! Errors and warnings for a terminal: with colours where it shows them.

use std::io::IsTerminal;
use trilith::Diagnostic;
use trilith::model::Place;
use trilith_diagnostics::Renderer;

/// The errors of a file, and their number.
pub(crate) fn all(diagnostics: &[Diagnostic]) -> String {
    trilith_diagnostics::all(&for_terminal(), diagnostics)
}

/// An error that has a place in a model file.
pub(crate) fn at(message: &str, place: &Place) -> String {
    trilith_diagnostics::at(&for_terminal(), message, place)
}

/// An error without a place.
pub(crate) fn plain(message: &str, help: Option<&str>) -> String {
    trilith_diagnostics::plain(&for_terminal(), message, help)
}

/// A warning without a place.
pub(crate) fn warning(message: &str) -> String {
    trilith_diagnostics::warning(&for_terminal(), message)
}

fn for_terminal() -> Renderer {
    let colour = std::io::stderr().is_terminal() && std::env::var_os("NO_COLOR").is_none();
    if colour { Renderer::styled() } else { Renderer::plain() }
}
