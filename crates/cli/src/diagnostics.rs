//! Errors as the reader of a model file wants them: the line, a caret, and what would be right.

use annotate_snippets::{AnnotationKind, Group, Level, Patch, Renderer, Snippet};
use std::io::IsTerminal;
use std::path::Path;
use trilith::Diagnostic;
use trilith::model::{Source, Span};

/// All errors of a file, and their number.
pub(crate) fn all(diagnostics: &[Diagnostic]) -> String {
    let mut text: String =
        diagnostics.iter().map(|d| render(&groups(d)) + "\n").collect::<Vec<_>>().join("\n");
    if diagnostics.len() > 1 {
        text += &format!("\n{} errors\n", diagnostics.len());
    }
    text
}

/// An error that has a place in a model file.
pub(crate) fn at(message: &str, span: Span, source: &Source) -> String {
    let snippet = Snippet::source(source.text.as_str())
        .path(shown(&source.path))
        .annotation(AnnotationKind::Primary.span(clamped(&source.text, &span)));
    render(&[Level::ERROR.primary_title(message).element(snippet)]) + "\n"
}

/// An error without a place.
pub(crate) fn plain(message: &str, help: Option<&str>) -> String {
    let mut group = Group::with_title(Level::ERROR.primary_title(message));
    if let Some(help) = help {
        group = group.element(Level::HELP.message(help));
    }
    render(&[group]) + "\n"
}

/// A warning without a place.
pub(crate) fn warning(message: &str) -> String {
    render(&[Group::with_title(Level::WARNING.primary_title(message))]) + "\n"
}

fn groups(d: &Diagnostic) -> Vec<Group<'_>> {
    let text = d.source.text.as_str();
    let title = Level::ERROR.primary_title(d.message.as_str()).id(d.code);
    let mut group = if text.is_empty() {
        // A file that cannot be read.
        let origin = annotate_snippets::Origin::path(shown(&d.source.path));
        title.element(origin)
    } else {
        let primary = AnnotationKind::Primary.span(clamped(text, &d.span));
        let primary = if d.label.is_empty() { primary } else { primary.label(d.label.as_str()) };
        let related = d.related.iter().map(|(span, label)| {
            AnnotationKind::Context.span(clamped(text, span)).label(label.as_str())
        });
        let snippet = Snippet::source(text).path(shown(&d.source.path));
        title.element(snippet.annotation(primary).annotations(related))
    };
    let help = d.help.as_deref();
    match &d.suggestion {
        Some((span, replacement)) if !text.is_empty() => {
            let snippet = Snippet::source(text)
                .path(shown(&d.source.path))
                .patch(Patch::new(clamped(text, span), replacement.as_str()));
            let title = Level::HELP.secondary_title(help.unwrap_or("this would be right"));
            vec![group, title.element(snippet)]
        }
        _ => {
            if let Some(help) = help {
                group = group.element(Level::HELP.message(help));
            }
            vec![group]
        }
    }
}

fn shown(path: &Path) -> String {
    path.display().to_string()
}

/// The span inside the text, on boundaries of characters.
fn clamped(text: &str, span: &Span) -> Span {
    let boundary = |mut i: usize| {
        i = i.min(text.len());
        while !text.is_char_boundary(i) {
            i -= 1;
        }
        i
    };
    let start = boundary(span.start);
    start..boundary(span.end).max(start)
}

fn render(report: &[Group<'_>]) -> String {
    let colour = std::io::stderr().is_terminal() && std::env::var_os("NO_COLOR").is_none();
    let renderer = if colour { Renderer::styled() } else { Renderer::plain() };
    renderer.render(report)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn spans_outside_the_text_are_brought_inside() {
        assert_eq!(clamped("aé", &(2..9)), 1..3);
        assert_eq!(clamped("", &(4..6)), 0..0);
    }

    #[test]
    fn an_error_shows_file_line_column_and_help() {
        let source = std::sync::Arc::new(Source {
            path: "a.ron".into(),
            text: "(\n  nodse: {},\n)".into(),
            sha256: String::new(),
        });
        let d = Diagnostic::new("E0103", "unknown field `nodse`", 4..9, &source)
            .label("not known")
            .help("did you mean `nodes`?")
            .suggestion(4..9, "nodes");
        let text = all(&[d]);
        for part in ["error[E0103]", "a.ron:2:3", "^^^^^ not known", "did you mean", "+   nodes"] {
            assert!(text.contains(part), "{part} in\n{text}");
        }
    }
}
