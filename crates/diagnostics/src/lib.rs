//! Errors as the reader of a model file wants them: the line, a caret, and what would be right.
//!
//! One place for all faces of the project: the program, the package for Python and the page with the engine in it say
//! the same. The renderer decides on colours.
//!
//! ```
//! use trilith_diagnostics::{Renderer, all};
//! use trilith_model::{ModelText, Registry};
//!
//! let text = ModelText::new("(nodse: {})", "frame.ron").expect("RON");
//! let errors = text.read(&Registry::default(), &[]).expect_err("a field that is not there");
//! assert!(all(&Renderer::plain(), &errors).contains("frame.ron:1:2"));
//! ```

use annotate_snippets::{AnnotationKind, Group, Level, Patch, Snippet};
use std::borrow::Cow;
use std::path::Path;
use trilith_model::{Diagnostic, Place, Span, visible, visible_line};

pub use annotate_snippets::Renderer;

/// Errors of a file that are shown; of more, the number is told.
const SHOWN: usize = 50;

/// A path in a line of its own.
#[must_use]
pub fn shown(path: &Path) -> String {
    visible_line(&path.display().to_string()).into_owned()
}

/// The errors of a file, and their number.
#[must_use]
pub fn all(renderer: &Renderer, diagnostics: &[Diagnostic]) -> String {
    let shown = diagnostics.iter().take(SHOWN);
    let shown = shown.map(|d| render(renderer, &groups(d)) + "\n");
    let mut text: String = shown.collect::<Vec<_>>().join("\n");
    if let Some(more) = diagnostics.len().checked_sub(SHOWN).filter(|more| *more > 0) {
        text += &format!("\n… and {more} more\n");
    }
    if diagnostics.len() > 1 {
        text += &format!("\n{} errors\n", diagnostics.len());
    }
    text
}

/// An error that has a place in a model file.
#[must_use]
pub fn at(renderer: &Renderer, message: &str, place: &Place) -> String {
    let source = &place.source;
    let primary = AnnotationKind::Primary.span(clamped(&source.text, &place.span));
    let indices = place.indices();
    let label = format!("with {indices}");
    let primary = if indices.is_empty() { primary } else { primary.label(legible(&label)) };
    let snippet =
        Snippet::source(source.text.as_str()).path(shown(&source.path)).annotation(primary);
    render(renderer, &[Level::ERROR.primary_title(legible(message)).element(snippet)]) + "\n"
}

/// An error without a place.
#[must_use]
pub fn plain(renderer: &Renderer, message: &str, help: Option<&str>) -> String {
    let mut group = Group::with_title(Level::ERROR.primary_title(legible(message)));
    if let Some(help) = help {
        group = group.element(Level::HELP.message(legible(help)));
    }
    render(renderer, &[group]) + "\n"
}

/// A warning without a place.
#[must_use]
pub fn warning(renderer: &Renderer, message: &str) -> String {
    let group = Group::with_title(Level::WARNING.primary_title(legible(message)));
    render(renderer, &[group]) + "\n"
}

fn groups(d: &Diagnostic) -> Vec<Group<'_>> {
    let text = d.source.text.as_str();
    let title = Level::ERROR.primary_title(legible(&d.message)).id(d.code);
    let mut group = if text.is_empty() {
        // A file that cannot be read.
        let origin = annotate_snippets::Origin::path(shown(&d.source.path));
        title.element(origin)
    } else {
        let primary = AnnotationKind::Primary.span(clamped(text, &d.span));
        let primary = if d.label.is_empty() { primary } else { primary.label(legible(&d.label)) };
        let related = d.related.iter().map(|(span, label)| {
            AnnotationKind::Context.span(clamped(text, span)).label(legible(label))
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
            let title = Level::HELP.secondary_title(legible(help.unwrap_or("this would be right")));
            vec![group, title.element(snippet)]
        }
        _ => {
            if let Some(help) = help {
                group = group.element(Level::HELP.message(legible(help)));
            }
            vec![group]
        }
    }
}

/// Digits of a number from which on it is shown in powers of ten.
const LONG: usize = 22;

/// A text as a terminal may show it, without numbers of hundreds of digits.
fn legible(text: &str) -> Cow<'_, str> {
    let text = visible(text);
    let part_of_number = |c: char| c.is_ascii_digit() || c == '.';
    if !text.split(|c| !part_of_number(c)).any(|part| part.len() >= LONG) {
        return text;
    }
    let mut out = String::with_capacity(text.len());
    let mut rest = &*text;
    while let Some(start) = rest.find(part_of_number) {
        let (before, from) = rest.split_at(start);
        let end = from.find(|c| !part_of_number(c)).unwrap_or(from.len());
        let (number, behind) = from.split_at(end);
        // Of a name, an expression or a power of ten it is a part.
        let alone = !before.ends_with(|c: char| c.is_alphanumeric() || c == '_')
            && !behind.starts_with(|c: char| c.is_alphanumeric() || c == '_');
        out += before;
        match number.trim_end_matches('.').parse::<f64>() {
            Ok(x) if alone && number.len() >= LONG => {
                out += &format!("{x:e}");
                out += if number.ends_with('.') { "." } else { "" };
            }
            _ => out += number,
        }
        rest = behind;
    }
    out += rest;
    Cow::Owned(out)
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

fn render(renderer: &Renderer, report: &[Group<'_>]) -> String {
    // The renderer shows control characters of ASCII in lines of a file by signs of their own, and lets the others
    // through; it has no use for these itself.
    renderer.render(report).replace(|c: char| matches!(c, '\u{80}'..='\u{9f}'), "\u{fffd}")
}

#[cfg(test)]
mod tests {
    use super::*;
    use trilith_model::Source;

    const PLAIN: Renderer = Renderer::plain();

    #[test]
    fn numbers_of_hundreds_of_digits_are_shown_in_powers_of_ten() {
        let (huge, tiny) = (1e300, 2.5e-30);
        let told = legible(&format!("a stiffness of {huge} N/m, {tiny} m; -{huge}.")).into_owned();
        assert_eq!(told, "a stiffness of 1e300 N/m, 2.5e-30 m; -1e300.");
        let hash = "the SHA-256 1234567890123456789012345678901234567890ab, 1.25 m at 3.";
        assert_eq!(legible(hash), hash);
    }

    #[test]
    fn spans_outside_the_text_are_brought_inside() {
        assert_eq!(clamped("aé", &(2..9)), 1..3);
        assert_eq!(clamped("", &(4..6)), 0..0);
    }

    #[test]
    fn of_many_errors_the_first_are_shown_and_all_are_counted() {
        let source = std::sync::Arc::new(Source {
            path: "a.ron".into(),
            text: "(\n  nodse: {},\n)".into(),
            sha256: String::new(),
        });
        let errors = |n: usize| {
            let one = |i: usize| Diagnostic::new("E0103", format!("wrong {i}"), 4..9, &source);
            all(&PLAIN, &(0..n).map(one).collect::<Vec<_>>())
        };
        let text = errors(SHOWN);
        assert!(text.contains("wrong 49") && !text.contains("more"), "{text}");
        assert!(text.ends_with("\n50 errors\n"), "{text}");
        let text = errors(5000);
        assert!(text.contains("wrong 49") && !text.contains("wrong 50"), "{text}");
        assert!(text.ends_with("\n… and 4950 more\n\n5000 errors\n"), "{text}");
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
        let text = all(&PLAIN, &[d]);
        for part in ["error[E0103]", "a.ron:2:3", "^^^^^ not known", "did you mean", "+   nodes"] {
            assert!(text.contains(part), "{part} in\n{text}");
        }
    }

    #[test]
    fn nothing_in_a_text_reaches_the_terminal_as_a_command() {
        let source = std::sync::Arc::new(Source {
            path: "a\u{1b}.ron".into(),
            text: "(\n  \u{1b}[31m\u{9b}31m nodse: {},\n)".into(),
            sha256: String::new(),
        });
        let d = Diagnostic::new("E0103", "m\u{1b}\u{9b}", 15..20, &source)
            .label("l\u{1b}\u{9b}")
            .help("h\u{1b}\u{9b}")
            .suggestion(15..20, "nodes");
        let indices = vec![("i".to_owned(), "\u{1b}\u{9b}".to_owned())];
        let at = at(&PLAIN, "m\u{1b}\u{9b}", &Place { source, span: 15..20, indices });
        let texts = [
            all(&PLAIN, &[d]),
            at,
            plain(&PLAIN, "m\u{1b}", Some("h\u{1b}\u{9b}")),
            warning(&PLAIN, "\u{9b}"),
        ];
        for text in texts {
            assert!(!text.contains(|c: char| c.is_control() && c != '\n'), "{text:?}");
        }
    }
}
