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
    /// has again and again the first is told, with their number.
    pub(crate) fn told(&self, mut errors: Vec<Diagnostic>) -> Vec<Diagnostic> {
        errors.sort_by_key(|d| (!self.is_own(d), d.span.start));
        let mut found: Vec<(usize, Diagnostic, String, usize)> = Vec::with_capacity(errors.len());
        let mut first = HashMap::new();
        for d in errors {
            if !self.is_own(&d) {
                found.push((usize::MAX, d, String::new(), 0));
                continue;
            }
            let (file, place) = (self.file_of(d.span.start), self.find(&d.span));
            let repeated = !place.indices.is_empty();
            let key = (file, place.span.clone(), d.code);
            if let Some(i) = first.get(&key).copied().filter(|_| repeated) {
                let (.., more): &mut (_, _, _, usize) = &mut found[i];
                *more += 1;
                continue;
            }
            first.insert(key, found.len());
            let indices = place.indices();
            found.push((file, self.placed(d, place), indices, 0));
        }
        found.sort_by_key(|(file, d, ..)| (*file, d.span.start));
        let one = |(_, mut d, indices, more): (usize, Diagnostic, String, usize)| {
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
