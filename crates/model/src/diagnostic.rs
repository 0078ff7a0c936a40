//! What is wrong with a model file, where, and what would be right.

use crate::{Source, Span};
use std::fmt;
use std::sync::Arc;

/// One error of a model file.
///
/// Spans are bytes of `source.text`. The source is the model file, or a `--set` argument, whose path
/// is then `--set NAME=VALUE`.
#[derive(Clone, Debug)]
pub struct Diagnostic {
    /// Stable code, such as `E0103`.
    pub code: &'static str,
    /// What is wrong.
    pub message: String,
    /// The text that is wrong.
    pub span: Span,
    /// A few words that stand at the span.
    pub label: String,
    /// What would be right.
    pub help: Option<String>,
    /// Other places that matter, each with a few words.
    pub related: Vec<(Span, String)>,
    /// Text that should replace a span.
    pub suggestion: Option<(Span, String)>,
    /// The text that the spans refer to.
    pub source: Arc<Source>,
}

impl Diagnostic {
    /// An error with a code, a message and a place.
    #[must_use]
    pub fn new(
        code: &'static str,
        message: impl Into<String>,
        span: Span,
        source: &Arc<Source>,
    ) -> Self {
        Self {
            code,
            message: message.into(),
            span,
            label: String::new(),
            help: None,
            related: Vec::new(),
            suggestion: None,
            source: Arc::clone(source),
        }
    }

    /// With a few words at the span.
    #[must_use]
    pub fn label(mut self, label: impl Into<String>) -> Self {
        self.label = label.into();
        self
    }

    /// With what would be right.
    #[must_use]
    pub fn help(mut self, help: impl Into<String>) -> Self {
        self.help = Some(help.into());
        self
    }

    /// With another place that matters.
    #[must_use]
    pub fn related(mut self, span: Span, text: impl Into<String>) -> Self {
        self.related.push((span, text.into()));
        self
    }

    /// With a replacement for a span.
    #[must_use]
    pub fn suggestion(mut self, span: Span, text: impl Into<String>) -> Self {
        self.suggestion = Some((span, text.into()));
        self
    }

    /// Line of the span's start, from 1.
    #[must_use]
    pub fn line(&self) -> usize {
        line_column(&self.source.text, self.span.start).0
    }

    /// Column of the span's start in characters, from 1.
    #[must_use]
    pub fn column(&self) -> usize {
        line_column(&self.source.text, self.span.start).1
    }
}

/// Line and column (in characters) of a byte of a text, both from 1.
#[must_use]
pub fn line_column(text: &str, byte: usize) -> (usize, usize) {
    let mut end = byte.min(text.len());
    while !text.is_char_boundary(end) {
        end -= 1;
    }
    let before = &text[..end];
    let line_start = before.rfind('\n').map_or(0, |i| i + 1);
    (before.matches('\n').count() + 1, before[line_start..].chars().count() + 1)
}

impl fmt::Display for Diagnostic {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let path = self.source.path.display();
        let (line, column) = (self.line(), self.column());
        write!(f, "{path}:{line}:{column}: error[{}]: {}", self.code, self.message)?;
        if let Some(help) = &self.help {
            write!(f, "\n  help: {help}")?;
        }
        Ok(())
    }
}

impl std::error::Error for Diagnostic {}

/// Errors for which the names that there are are searched for the one that was meant: with thousands of wrong names
/// beside thousands of right ones the search would take longer than all else.
pub(crate) const SEARCHED: usize = 100;

/// The candidate that a misspelt name most likely means.
#[must_use]
pub fn closest<'a>(name: &str, candidates: impl IntoIterator<Item = &'a str>) -> Option<&'a str> {
    let lower = name.to_lowercase();
    candidates
        .into_iter()
        .map(|c| (c, strsim::damerau_levenshtein(&lower, &c.to_lowercase())))
        .filter(|(c, d)| {
            let length = name.chars().count().max(c.chars().count());
            // A single letter in place of another is no misspelling.
            *d <= (length / 3).max(1) && *d < length
        })
        .min_by_key(|(_, d)| *d)
        .map(|(c, _)| c)
}

/// `did you mean …?`, or the list of what there is.
#[must_use]
pub fn names_help<'a>(
    name: &str,
    what: &str,
    candidates: impl IntoIterator<Item = &'a str> + Clone,
) -> String {
    if let Some(c) = closest(name, candidates.clone()) {
        return format!("did you mean `{c}`?");
    }
    let all: Vec<String> = candidates.into_iter().map(|c| format!("`{c}`")).collect();
    match all.len() {
        0 => format!("there are no {what}"),
        1..=12 => format!("the {what} are {}", all.join(", ")),
        n => format!("the {n} {what} begin with {}", all[..12].join(", ")),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn columns_count_characters_and_lines_from_one() {
        assert_eq!(line_column("ab\nµé x", 3), (2, 1));
        assert_eq!(line_column("ab\nµé x", 8), (2, 4));
        assert_eq!(line_column("", 7), (1, 1));
    }

    #[test]
    fn a_near_name_is_offered_and_a_far_one_is_not() {
        assert_eq!(closest("stifness", ["stiffness", "opening"]), Some("stiffness"));
        assert_eq!(closest("zzz", ["stiffness", "opening"]), None);
        assert_eq!(closest("R", ["X", "Y"]), None);
    }

    #[test]
    fn display_names_file_line_and_column() {
        let source = Arc::new(Source {
            path: "a.ron".into(),
            text: "(\n  x: 1)".into(),
            sha256: String::new(),
        });
        let d = Diagnostic::new("E0103", "unknown field `x`", 4..5, &source).help("remove it");
        assert_eq!(d.to_string(), "a.ron:2:3: error[E0103]: unknown field `x`\n  help: remove it");
    }
}
