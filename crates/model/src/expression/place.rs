//! Where an error of an expression stands in the file.

use super::ExpressionError;
use crate::tree::Node;
use crate::{Diagnostic, Source, Span};
use std::sync::Arc;

/// An error of an expression in quotes as a diagnostic of the file.
#[must_use]
pub fn expression_diagnostic(
    error: ExpressionError,
    source: &Arc<Source>,
    node: &Node,
    text: &str,
) -> Diagnostic {
    let whole = source.text.get(node.span.clone()).unwrap_or_default();
    diagnostic_within(error, source, &node.span, whole, text)
}

/// The same of a text that stands at a span and reads `whole` there, quotes included.
pub(crate) fn diagnostic_within(
    error: ExpressionError,
    source: &Arc<Source>,
    at: &Span,
    whole: &str,
    text: &str,
) -> Diagnostic {
    // Escapes and indices shift the characters of a text; the error then stands at the whole text.
    let span = match whole.find(text) {
        Some(quote) if !text.is_empty() => {
            let start = at.start + quote;
            start + error.span.start.min(text.len())..start + error.span.end.min(text.len())
        }
        _ => at.clone(),
    };
    let mut d = Diagnostic::new(error.code, error.message, span, source);
    d.help = error.help;
    d
}
