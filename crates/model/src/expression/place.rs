//! Where an error of an expression stands in the file.

use super::ExpressionError;
use crate::tree::Node;
use crate::{Diagnostic, Source, Span};
use std::sync::Arc;

/// Span of the text inside the quotes of a text node.
fn inner_span(source: &str, node: &Node, text: &str) -> Span {
    let whole = source.get(node.span.clone()).unwrap_or_default();
    match whole.find(text) {
        Some(at) if !text.is_empty() => node.span.start + at..node.span.start + at + text.len(),
        _ => node.span.clone(),
    }
}

/// An error of an expression in quotes as a diagnostic of the file.
#[must_use]
pub fn expression_diagnostic(
    error: ExpressionError,
    source: &Arc<Source>,
    node: &Node,
    text: &str,
) -> Diagnostic {
    let inner = inner_span(&source.text, node, text);
    // Escapes shift the characters of a text; the error then stands at the whole text.
    let span = if inner.len() == text.len() {
        inner.start + error.span.start.min(text.len())..inner.start + error.span.end.min(text.len())
    } else {
        node.span.clone()
    };
    let mut d = Diagnostic::new(error.code, error.message, span, source);
    d.help = error.help;
    d
}
