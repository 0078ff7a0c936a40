//! Errors as they are told: in the files that they stand in, with the indices of repetitions.

use super::{Place, Places};
use crate::expression::{ExpressionError, diagnostic_within};
use crate::{Diagnostic, Span, line_column};
use std::collections::HashMap;
use std::sync::Arc;

impl Places {
    /// An error of an expression in the text of a value, where it stands in that text.
    pub(crate) fn expression(&self, error: ExpressionError, span: &Span, text: &str) -> Diagnostic {
        let place = self.find(span);
        let whole = place.source.text.get(place.span).unwrap_or_default();
        diagnostic_within(error, self.main(), span, whole, text)
    }

    /// Errors as they are told: where they stand in the files, with the indices of repetitions. Of those that a text
    /// has again and again the first are told, with how often they come.
    pub(crate) fn told(&self, mut errors: Vec<Diagnostic>) -> Vec<Diagnostic> {
        errors.sort_by_key(|d| (!self.is_own(d), d.span.start));
        let mut found: Vec<Told> = Vec::with_capacity(errors.len());
        let mut first = HashMap::new();
        for d in errors {
            if !self.is_own(&d) {
                found.push(Told {
                    file: usize::MAX,
                    d,
                    indices: String::new(),
                    at: [0; 2],
                    more: 0,
                });
                continue;
            }
            let (at, file, place) = (d.span.start, self.file_of(d.span.start), self.find(&d.span));
            let key = (file, place.span.clone(), d.code);
            let before = first.get(&key).map(|i: &usize| &mut found[*i]);
            // What else is wrong the first time is told as well.
            match before.filter(|before| before.at[0] != at) {
                Some(before) => {
                    before.more += usize::from(before.at[1] != at);
                    before.at[1] = at;
                }
                None => {
                    first.entry(key).or_insert(found.len());
                    let indices = place.indices();
                    let d = self.placed(d, place);
                    found.push(Told { file, d, indices, at: [at; 2], more: 0 });
                }
            }
        }
        found.sort_by_key(|told| (told.file, told.d.span.start));
        let one = |Told { mut d, indices, more, .. }: Told| {
            match (indices.as_str(), more) {
                ("", _) => {}
                (with, 0) => d.message += &format!(", with {with}"),
                (with, more) => d.message += &format!(", with {with} and {more} times more"),
            }
            d
        };
        found.into_iter().map(one).collect()
    }

    fn is_own(&self, d: &Diagnostic) -> bool {
        Arc::ptr_eq(&d.source, self.main())
    }

    /// An error at its place.
    fn placed(&self, d: Diagnostic, place: Place) -> Diagnostic {
        let mut help = d.help;
        let mut related = Vec::with_capacity(d.related.len());
        for (span, mut label) in d.related {
            let there = self.find(&span);
            if !there.indices.is_empty() {
                label += &format!(", with {}", there.indices());
            }
            if Arc::ptr_eq(&there.source, &place.source) {
                related.push((there.span, label));
            } else {
                let (line, column) = line_column(&there.source.text, there.span.start);
                let other = format!("{label}: {}:{line}:{column}", there.source.path.display());
                help = Some(help.map_or(other.clone(), |help| format!("{help}; {other}")));
            }
        }
        // What an expression has put into a text is not right for all of its values.
        let suggestion = d.suggestion.and_then(|(span, text)| {
            let there = self.find(&span);
            let as_it_stands = there.source.text.get(there.span.clone())?;
            (!as_it_stands.contains('{')).then_some((there.span, text))
        });
        Diagnostic { source: place.source, span: place.span, help, related, suggestion, ..d }
    }
}

/// An error, its file and indices, how many further repetitions have it, and where the first and the last of them lie.
struct Told {
    file: usize,
    d: Diagnostic,
    indices: String,
    at: [usize; 2],
    more: usize,
}
