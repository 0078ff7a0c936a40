//! A RON text as a tree in which everything knows its byte span.
//!
//! The parsing is done by `ron` alone: a `&RawValue` borrows from the text that is read, so its
//! address tells where it stands.

pub(crate) mod json;
mod numeric;
mod plain;
mod shape;

use crate::Span;
use plain::Lists;
use ron::value::RawValue;
use shape::{Key, Shape};
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
    pub related: Option<Span>,
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

/// Reads a whole text. A byte-order mark at the start is skipped.
pub(crate) fn parse(text: &str) -> Result<Node, TreeError> {
    let (text, mut lists) = plain::lift(text);
    let text = text.as_str();
    let body = text.strip_prefix('\u{feff}').unwrap_or(text);
    let lead = text.len() - body.len();
    let shape = options().from_str::<Shape<'_>>(body).map_err(|e| {
        let at = byte_of(body, e.span.start.line, e.span.start.col) + lead;
        let end = (byte_of(body, e.span.end.line, e.span.end.col) + lead).max(at);
        TreeError {
            code: "E0101",
            message: told(&e.code),
            span: at..end.max(next_char(text, at)),
            related: None,
        }
    })?;
    let (start, end) = (lead + comments(body), lead + body.trim_end().len());
    match lists.remove(&start) {
        Some(list) => Ok(list),
        None => build(text, &mut lists, shape, start..end, ""),
    }
}

/// What is wrong with a text. Of brackets within brackets `ron` speaks to programmers, about its own settings.
fn told(error: &ron::Error) -> String {
    match error {
        ron::Error::ExceededRecursionLimit => {
            "the brackets are nested too deeply here: no value of a file lies in more than a few"
                .into()
        }
        other => other.to_string(),
    }
}

/// Length of the blanks and comments that a text begins with.
fn comments(text: &str) -> usize {
    let mut rest = text.trim_start();
    loop {
        rest = if rest.starts_with("//") {
            rest.find('\n').map_or("", |i| &rest[i..])
        } else if rest.starts_with("/*") {
            &rest[block_comment(rest)..]
        } else {
            return text.len() - rest.len();
        }
        .trim_start();
    }
}

/// Length of the block comment that a text begins with, and of those inside it.
fn block_comment(text: &str) -> usize {
    let mut depth = 0_usize;
    let mut ends = text.char_indices().filter_map(|(i, _)| {
        let here = &text[i..];
        if here.starts_with("/*") {
            depth += 1;
        } else if here.starts_with("*/") {
            depth = depth.saturating_sub(1);
            return (depth == 0).then_some(i + 2);
        }
        None
    });
    ends.next().unwrap_or(text.len())
}

fn options() -> ron::Options {
    use ron::extensions::Extensions as E;
    ron::Options::default().with_default_extension(E::IMPLICIT_SOME | E::UNWRAP_NEWTYPES)
}

fn next_char(text: &str, at: usize) -> usize {
    at + text.get(at..).and_then(|rest| rest.chars().next()).map_or(0, char::len_utf8)
}

/// Byte of a line and column, both from 1, columns in characters.
fn byte_of(text: &str, line: usize, column: usize) -> usize {
    let start: usize =
        text.split_inclusive('\n').take(line.saturating_sub(1)).map(str::len).sum::<usize>();
    let rest = &text[start.min(text.len())..];
    let within = rest.char_indices().nth(column.saturating_sub(1)).map_or(rest.len(), |(i, _)| i);
    (start + within).min(text.len())
}

/// Byte offset of a slice of `text`.
fn offset(text: &str, part: &str) -> Option<usize> {
    let at = (part.as_ptr() as usize).wrapping_sub(text.as_ptr() as usize);
    (at <= text.len() && at + part.len() <= text.len()).then_some(at)
}

/// A raw value without the blanks and comments around it; `None` where only a parser can tell.
fn bare(raw: &str) -> Option<&str> {
    let body = raw[comments(raw)..].trim_end();
    // A comment behind a value ends with `*/`, or with the line it is on.
    let line = body.rfind('\n').map_or(body, |i| &body[i..]);
    (!body.is_empty() && !body.ends_with("*/") && !line.contains("//")).then_some(body)
}

fn child(text: &str, lists: &mut Lists, raw: &RawValue) -> Result<Node, TreeError> {
    let part = match bare(raw.get_ron()) {
        Some(part) => part,
        // `trim` trusts that the text is RON by itself; one that leans on an extension which the file
        // enables is not.
        None => RawValue::from_ron(raw.get_ron()).map(|r| r.trim().get_ron()).map_err(|e| {
            let start = offset(text, raw.get_ron()).unwrap_or(0);
            let span = start..start + raw.get_ron().len();
            TreeError { code: "E0101", message: told(&e.code), span, related: None }
        })?,
    };
    let start = offset(text, part).unwrap_or(0);
    if let Some(node) = lists.remove(&start).or_else(|| numeric::read(part, start)) {
        return Ok(node);
    }
    let span = start..start + part.len();
    let shape = options().from_str::<Shape<'_>>(part).map_err(|e| TreeError {
        code: "E0101",
        message: told(&e.code),
        span: span.clone(),
        related: None,
    })?;
    build(text, lists, shape, span, part)
}

/// The identifier that a value starts with.
fn leading_name(part: &str) -> Option<String> {
    let part = part.strip_prefix("r#").unwrap_or(part);
    let end = part.find(|c: char| !(c.is_alphanumeric() || c == '_')).unwrap_or(part.len());
    let name = &part[..end];
    name.starts_with(|c: char| c.is_alphabetic() || c == '_').then(|| name.to_owned())
}

fn build(
    text: &str,
    lists: &mut Lists,
    shape: Shape<'_>,
    span: Span,
    part: &str,
) -> Result<Node, TreeError> {
    let name = leading_name(part);
    let kind = match shape {
        Shape::Number(x) => Kind::Number(x),
        Shape::Flag(b) => Kind::Flag(b),
        Shape::Text(s) => Kind::Text(s),
        Shape::Unit => match name {
            Some(n) if !part.contains('(') => Kind::Name(n),
            name => Kind::Fields(name, Vec::new()),
        },
        Shape::Some(raw) => return child(text, lists, raw),
        Shape::List(items) => {
            let items: Vec<_> =
                items.into_iter().map(|r| child(text, lists, r)).collect::<Result<_, _>>()?;
            let name = if part.starts_with('[') { None } else { name };
            if items.is_empty() && !part.starts_with('[') {
                Kind::Fields(name, Vec::new())
            } else {
                Kind::List(name, items)
            }
        }
        Shape::Entries(entries) => {
            let mut out: Vec<Entry> = Vec::with_capacity(entries.len());
            let mut places: HashMap<String, usize> = HashMap::with_capacity(entries.len());
            for (key, raw) in entries {
                let value = child(text, lists, raw)?;
                let key_span = match &key {
                    Key::Borrowed(k) => {
                        offset(text, k).map_or(value.span.clone(), |at| at..at + k.len())
                    }
                    Key::Owned(_) => value.span.clone(),
                };
                let key = key.into_string();
                if let Some(first) = places.insert(key.clone(), out.len()).map(|i| &out[i]) {
                    return Err(TreeError {
                        code: "E0102",
                        message: format!("`{key}` is given twice"),
                        span: key_span,
                        related: Some(first.key_span.clone()),
                    });
                }
                out.push(Entry { key, key_span, value });
            }
            if part.starts_with('{') { Kind::Map(out) } else { Kind::Fields(name, out) }
        }
    };
    Ok(Node { span, kind })
}
