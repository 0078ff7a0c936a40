//! A RON text, or one in JSON, as a tree in which everything knows its byte span.

pub(crate) mod json;
mod literal;
mod reader;

pub(crate) use reader::parse;

use crate::Span;
use std::collections::HashMap;

/// A value of the file.
#[derive(Clone, Debug)]
pub struct Node {
    /// Where it stands, comments and blanks around it left out.
    pub span: Span,
    /// What it is.
    pub kind: Kind,
}

/// What a value is.
#[derive(Clone, Debug)]
pub enum Kind {
    /// A number; not necessarily finite.
    Number(f64),
    /// `true` or `false`.
    Flag(bool),
    /// A text in quotes.
    Text(String),
    /// A bare name such as `Fixed`.
    Name(String),
    /// `[a, b]`, `(a, b)` or `Name(a, b)`.
    List(Option<String>, Vec<Node>),
    /// `(a: 1)` or `Name(a: 1)`; also `()` and `Name()`.
    Fields(Option<String>, Vec<Entry>),
    /// `{"a": 1}`.
    Map(Vec<Entry>),
}

/// A key with its value.
#[derive(Clone, Debug)]
pub struct Entry {
    /// The key.
    pub key: String,
    /// Where the key stands.
    pub key_span: Span,
    /// The value.
    pub value: Node,
}

/// Entries whose key has come before, each with the place where it did.
pub(crate) fn twice(entries: &[Entry]) -> Vec<(&Entry, &Span)> {
    let mut first: HashMap<&str, &Span> = HashMap::with_capacity(entries.len());
    entries.iter().filter_map(|e| Some((e, first.insert(&e.key, &e.key_span)?))).collect()
}

/// An error of the text itself.
#[derive(Debug)]
pub(crate) struct TreeError {
    pub code: &'static str,
    pub message: String,
    pub span: Span,
    /// Other places that matter, and what they are.
    pub related: Vec<(Span, &'static str)>,
    pub help: Option<&'static str>,
}

impl TreeError {
    /// Of what is no text of its kind.
    fn text(message: String, span: Span) -> Self {
        Self { code: "E0101", message, span, related: Vec::new(), help: None }
    }

    /// Of an entry whose key has come before.
    fn twice(key: &str, key_span: Span, first: &Span) -> Self {
        let message = format!("`{key}` is given twice");
        let error = Self { code: "E0102", ..Self::text(message, key_span) };
        error.related(first.clone(), "first given here").help("keep one of the two")
    }

    fn related(mut self, span: Span, what: &'static str) -> Self {
        self.related.push((span, what));
        self
    }

    fn help(mut self, help: &'static str) -> Self {
        self.help = Some(help);
        self
    }
}

impl Node {
    /// In words, for messages.
    #[must_use]
    pub fn describe(&self) -> String {
        match &self.kind {
            Kind::Number(x) => format!("the number {x}"),
            Kind::Flag(b) => format!("`{b}`"),
            Kind::Text(s) => format!("the text \"{s}\""),
            Kind::Name(n) => format!("`{n}`"),
            Kind::List(None, _) => "a list".into(),
            Kind::Fields(None, _) => "fields in parentheses".into(),
            Kind::List(Some(n), _) | Kind::Fields(Some(n), _) => format!("`{n}(…)`"),
            Kind::Map(_) => "a map `{…}`".into(),
        }
    }

    /// The name of `Name`, `Name(…)`.
    #[must_use]
    pub fn name(&self) -> Option<&str> {
        match &self.kind {
            Kind::Name(n) => Some(n),
            Kind::List(n, _) | Kind::Fields(n, _) => n.as_deref(),
            _ => None,
        }
    }

    /// The span of the name of `Name(…)`, or of the whole value.
    #[must_use]
    pub fn name_span(&self) -> Span {
        let start = self.span.start;
        self.name().map_or(self.span.clone(), |n| start..(start + n.len()).min(self.span.end))
    }

    /// The items of a list without a name; one value that is no list counts as its only item.
    #[must_use]
    pub fn items(&self) -> Vec<&Self> {
        match &self.kind {
            Kind::List(None, items) => items.iter().collect(),
            Kind::Fields(None, entries) if entries.is_empty() => Vec::new(),
            _ => vec![self],
        }
    }

    /// Moves all spans.
    pub(crate) fn shift(&mut self, by: usize) {
        let moved = |span: &Span| span.start + by..span.end + by;
        self.span = moved(&self.span);
        match &mut self.kind {
            Kind::List(_, items) => items.iter_mut().for_each(|n| n.shift(by)),
            Kind::Fields(_, entries) | Kind::Map(entries) => {
                for e in entries {
                    e.key_span = moved(&e.key_span);
                    e.value.shift(by);
                }
            }
            Kind::Number(_) | Kind::Flag(_) | Kind::Text(_) | Kind::Name(_) => {}
        }
    }

    /// True for a list without a name.
    #[must_use]
    pub fn is_list(&self) -> bool {
        match &self.kind {
            Kind::List(None, _) => true,
            Kind::Fields(None, entries) => entries.is_empty(),
            _ => false,
        }
    }
}
