//! Reads RON: one pass over the text, in which everything learns where it stands.
//!
//! The grammar is that of the `ron` crate (github.com/ron-rs/ron, docs/grammar.md), as far as a file of values has use for it: no
//! bytes, no ranges. Options need no `Some`.

use super::literal::{self, Wrong};
use super::{Entry, Kind, Node, TreeError};
use crate::Span;
use std::collections::HashMap;

/// Brackets within brackets: what reads on goes down with them.
const DEPTH: usize = 64;
/// Fewer keys are searched one by one.
const FEW: usize = 16;

type Read<T> = Result<T, TreeError>;

/// Reads a whole text. A byte-order mark at the start is skipped.
pub(crate) fn parse(text: &str) -> Read<Node> {
    let at = if text.starts_with('\u{feff}') { '\u{feff}'.len_utf8() } else { 0 };
    let mut reader = Reader { text, at, depth: 0 };
    reader.skip_blanks()?;
    reader.skip_attributes()?;
    let node = reader.value()?;
    reader.skip_blanks()?;
    match reader.rest().is_empty() {
        true => Ok(without_name(node)),
        false => {
            let message = format!("{} stands behind the end of the value", reader.found());
            Err(reader.error(message))
        }
    }
}

/// The whole of a file is what it is, whatever it is called.
fn without_name(mut node: Node) -> Node {
    if let Kind::Fields(name, _) | Kind::List(name, _) = &mut node.kind {
        *name = None;
    }
    node
}

struct Reader<'a> {
    text: &'a str,
    /// Byte that comes next.
    at: usize,
    /// Brackets that are open.
    depth: usize,
}

/// What a name may begin with.
fn begins_name(c: char) -> bool {
    c == '_' || c.is_alphabetic()
}

fn goes_on_name(c: char) -> bool {
    c == '_' || c.is_alphanumeric()
}

/// A raw name, such as `r#a-b`, may have more.
fn goes_on_raw_name(c: char) -> bool {
    goes_on_name(c) || matches!(c, '.' | '+' | '-')
}

fn is_blank(c: char) -> bool {
    matches!(
        c,
        ' ' | '\t'
            | '\n'
            | '\r'
            | '\x0B'
            | '\x0C'
            | '\u{85}'
            | '\u{200E}'
            | '\u{200F}'
            | '\u{2028}'
            | '\u{2029}'
    )
}

impl<'a> Reader<'a> {
    fn rest(&self) -> &'a str {
        &self.text[self.at..]
    }

    fn peek(&self) -> Option<u8> {
        self.text.as_bytes().get(self.at).copied()
    }

    /// Takes a character of one byte, where it comes next.
    fn take(&mut self, byte: u8) -> bool {
        let there = self.peek() == Some(byte);
        self.at += usize::from(there);
        there
    }

    /// What comes next, in words.
    fn found(&self) -> String {
        let rest = self.rest();
        let Some(first) = rest.chars().next() else { return "the end of the text".into() };
        format!("`{}`", &rest[..self.length(first)])
    }

    /// Bytes of what comes next: a name, or a character.
    fn length(&self, first: char) -> usize {
        match goes_on_name(first) {
            true => self.rest().find(|c| !goes_on_name(c)).unwrap_or(self.rest().len()),
            false => first.len_utf8(),
        }
    }

    /// What is wrong with that which comes next.
    fn error(&self, message: String) -> TreeError {
        let length = self.rest().chars().next().map_or(0, |first| self.length(first));
        TreeError::text(message, self.at..self.at + length)
    }

    fn skip_blanks(&mut self) -> Read<()> {
        loop {
            match self.peek() {
                Some(b' ' | b'\n' | b'\t' | b'\r') => self.at += 1,
                Some(b'/') => self.skip_comment()?,
                Some(0x0B | 0x0C | 0x80..) if self.rest().starts_with(is_blank) => {
                    self.at += self.rest().chars().next().map_or(0, char::len_utf8);
                }
                _ => return Ok(()),
            }
        }
    }

    fn skip_comment(&mut self) -> Read<()> {
        let rest = self.rest();
        if rest.starts_with("//") {
            self.at += rest.find('\n').unwrap_or(rest.len());
            return Ok(());
        }
        if !rest.starts_with("/*") {
            let message = "`/` begins a comment as `//` or `/*`; values are calculated with in texts, such as \"a / 2\"";
            return Err(self.error(message.into()));
        }
        let (mut depth, mut at) = (0_usize, 0);
        loop {
            let Some(next) = rest[at..].find(['*', '/']) else {
                let message = "a comment that begins with `/*` does not end: `*/` is missing";
                return Err(TreeError::text(message.into(), self.at..self.at + 2));
            };
            at += next;
            let step = match &rest.as_bytes()[at..] {
                [b'/', b'*', ..] => {
                    depth += 1;
                    2
                }
                [b'*', b'/', ..] => {
                    depth -= 1;
                    2
                }
                _ => 1,
            };
            at += step;
            if depth == 0 {
                self.at += at;
                return Ok(());
            }
        }
    }

    /// `#![enable(…)]` and the like: what `ron` can be told by them goes without saying here.
    fn skip_attributes(&mut self) -> Read<()> {
        while self.rest().starts_with('#') {
            let end = self.rest().starts_with("#![").then(|| self.rest().find(']')).flatten();
            let Some(end) = end else {
                return Err(self.error(
                    "a `#` begins an attribute, such as `#![enable(implicit_some)]`".into(),
                ));
            };
            self.at += end + 1;
            self.skip_blanks()?;
        }
        Ok(())
    }

    fn value(&mut self) -> Read<Node> {
        let start = self.at;
        let kind = match self.peek() {
            Some(b'(') => self.in_parentheses(None)?,
            Some(b'[') => Kind::List(None, self.list(b']')?),
            Some(b'{') => Kind::Map(self.map()?),
            Some(b'"') => Kind::Text(self.literal(literal::text)?),
            Some(b'\'') => Kind::Text(self.literal(literal::character)?),
            Some(b'0'..=b'9' | b'-' | b'+' | b'.') => Kind::Number(self.literal(literal::number)?),
            Some(b'r') if literal::is_raw_text(self.rest()) => {
                Kind::Text(self.literal(literal::raw_text)?)
            }
            Some(_) if self.rest().starts_with(begins_name) => return self.named(),
            _ => return Err(self.error(format!("a value is wanted here, not {}", self.found()))),
        };
        Ok(Node { span: start..self.at, kind })
    }

    /// A name and what it may stand before.
    fn named(&mut self) -> Read<Node> {
        let start = self.at;
        let name = self.name();
        let end = self.at;
        let kind = match name {
            "true" => Kind::Flag(true),
            "false" => Kind::Flag(false),
            "inf" | "inff32" | "inff64" => Kind::Number(f64::INFINITY),
            "NaN" | "NaNf32" | "NaNf64" => Kind::Number(f64::NAN),
            _ => {
                self.skip_blanks()?;
                if self.peek() == Some(b'(') {
                    if name == "Some" {
                        return self.wrapped();
                    }
                    let kind = self.in_parentheses(Some(name))?;
                    return Ok(Node { span: start..self.at, kind });
                }
                self.at = end;
                Kind::Name(name.to_owned())
            }
        };
        Ok(Node { span: start..end, kind })
    }

    /// A name, raw or not, without its `r#`.
    fn name(&mut self) -> &'a str {
        let rest = self.rest();
        let raw = rest.strip_prefix("r#").filter(|raw| raw.starts_with(goes_on_raw_name));
        let (name, goes_on): (_, fn(char) -> bool) = match raw {
            Some(raw) => (raw, goes_on_raw_name),
            None => (rest, goes_on_name),
        };
        let name = &name[..name.find(|c| !goes_on(c)).unwrap_or(name.len())];
        self.at += rest.len() - raw.unwrap_or(rest).len() + name.len();
        name
    }

    /// `(…)`, behind a name or not.
    fn in_parentheses(&mut self, name: Option<&str>) -> Read<Kind> {
        let open = self.at;
        self.at += 1;
        self.skip_blanks()?;
        let named = self.rest().starts_with(begins_name) && {
            // A field has a colon behind its name.
            let first = self.at;
            self.name();
            self.skip_blanks()?;
            let field = self.peek() == Some(b':');
            self.at = first;
            field
        };
        self.at = open;
        if named {
            return Ok(Kind::Fields(name.map(str::to_owned), self.fields()?));
        }
        let items = self.list(b')')?;
        let name = name.map(str::to_owned);
        Ok(if items.is_empty() { Kind::Fields(name, Vec::new()) } else { Kind::List(name, items) })
    }

    /// The value in `Some(…)`.
    fn wrapped(&mut self) -> Read<Node> {
        let open = self.at;
        let mut items = self.list(b')')?;
        let one = items.pop().filter(|_| items.is_empty());
        one.ok_or_else(|| {
            let message = "`Some(…)` has one value in it, or is left out";
            TreeError::text(message.into(), open..self.at)
        })
    }

    /// What is between brackets, from one that opens to the one that closes them.
    fn between<T>(&mut self, close: u8, one: fn(&mut Self, &mut T) -> Read<()>) -> Read<T>
    where
        T: Default,
    {
        let open = self.at..self.at + 1;
        if self.depth == DEPTH {
            let message = "the brackets are nested too deeply here: no value of a file lies in more than a few";
            return Err(TreeError::text(message.into(), open));
        }
        self.depth += 1;
        self.at += 1;
        let mut all = T::default();
        loop {
            self.skip_blanks()?;
            if self.take(close) {
                break;
            }
            if self.rest().is_empty() {
                return Err(self.unclosed(close, open));
            }
            let start = self.at;
            one(self, &mut all)?;
            let end = self.at;
            self.skip_blanks()?;
            if self.take(b',') {
                continue;
            }
            if self.take(close) {
                break;
            }
            return Err(self.no_end(close, open, start..end));
        }
        self.depth -= 1;
        Ok(all)
    }

    fn unclosed(&self, close: u8, open: Span) -> TreeError {
        let message = format!("the text ends here, and a `{}` is missing", char::from(close));
        self.error(message).related(open, "opened here")
    }

    /// Behind a value in brackets comes neither a comma nor their end.
    fn no_end(&self, close: u8, open: Span, before: Span) -> TreeError {
        if self.rest().is_empty() {
            return self.unclosed(close, open);
        }
        let message =
            format!("`,` or `{}` is wanted here, not {}", char::from(close), self.found());
        let error = self.error(message).related(open.clone(), "opened here");
        let part = &self.text[before.clone()];
        let is_text = part.ends_with('"');
        if is_text && part.contains('\n') {
            let begin = before.start + part[..part.len() - 1].rfind('"').unwrap_or(0);
            return error
                .related(begin..begin + 1, "the text before it begins here")
                .help("it goes on over the end of its line: its closing `\"` may be missing");
        }
        let another = !self.rest().starts_with([')', ']', '}']);
        if another && self.text[before.end..self.at].contains('\n') {
            // Where it is missing is another line than that of what comes next.
            let start = part.rfind('\n').map_or(before.start, |_| before.end - 1);
            let message = "`,` is missing behind this".into();
            return TreeError::text(message, start..before.end).related(open, "opened here");
        }
        let is_number = part.ends_with(|c: char| c.is_ascii_digit() || c == '.');
        if is_number && self.rest().starts_with(char::is_alphabetic) {
            return error.help("a number with a unit is a text, such as \"2.5 kN/m\"");
        }
        error
    }

    fn list(&mut self, close: u8) -> Read<Vec<Node>> {
        self.between(close, |reader, items: &mut Vec<Node>| {
            items.push(reader.value()?);
            Ok(())
        })
    }

    fn fields(&mut self) -> Read<Vec<Entry>> {
        let all: Entries = self.between(b')', |reader, all: &mut Entries| {
            if !reader.rest().starts_with(begins_name) {
                let message = format!("the name of a field is wanted here, not {}", reader.found());
                return Err(reader.error(message));
            }
            let start = reader.at;
            let key = reader.name();
            let key_span = reader.at - key.len()..reader.at;
            reader.entry(all, key.to_owned(), key_span, start)
        })?;
        Ok(all.list)
    }

    fn map(&mut self) -> Read<Vec<Entry>> {
        let all: Entries = self.between(b'}', |reader, all: &mut Entries| {
            let start = reader.at;
            let read = match reader.peek() {
                Some(b'"') => literal::text,
                Some(b'r') if literal::is_raw_text(reader.rest()) => literal::raw_text,
                _ => {
                    let message = format!(
                        "a name in quotes is wanted here, such as `\"a\": …`, not {}",
                        reader.found()
                    );
                    return Err(reader.error(message));
                }
            };
            let key = reader.literal(read)?;
            // Without the quotes, and without what makes a text raw.
            let whole = &reader.text[start..reader.at];
            let quotes = whole.find('"').unwrap_or(0) + 1..whole.rfind('"').unwrap_or(whole.len());
            reader.entry(all, key, start + quotes.start..start + quotes.end, start)
        })?;
        Ok(all.list)
    }

    /// The value of a key that was read, and both to the others; `start`: where the key begins with its quotes.
    fn entry(&mut self, all: &mut Entries, key: String, key_span: Span, start: usize) -> Read<()> {
        let end = self.at;
        self.skip_blanks()?;
        if !self.take(b':') {
            let (key, found) = (&self.text[start..end], self.found());
            return Err(self.error(format!("`:` is wanted behind {key}, not {found}")));
        }
        self.skip_blanks()?;
        let value = self.value()?;
        all.add(Entry { key, key_span, value })
    }

    /// A number or a text.
    fn literal<T>(&mut self, read: fn(&str) -> Result<(T, usize), Wrong>) -> Read<T> {
        let (value, length) = read(self.rest()).map_err(|wrong| wrong.at(self.at))?;
        self.at += length;
        Ok(value)
    }
}

/// Entries with different keys.
#[derive(Default)]
struct Entries {
    list: Vec<Entry>,
    /// Where the keys are, once there are many.
    places: HashMap<String, usize>,
}

impl Entries {
    fn add(&mut self, entry: Entry) -> Read<()> {
        if self.list.len() == FEW {
            self.places = self.list.iter().enumerate().map(|(i, e)| (e.key.clone(), i)).collect();
        }
        let before = match self.list.len() < FEW {
            true => self.list.iter().position(|e| e.key == entry.key),
            false => self.places.insert(entry.key.clone(), self.list.len()),
        };
        match before {
            Some(first) => {
                let first = &self.list[first].key_span;
                Err(TreeError::twice(&entry.key, entry.key_span.clone(), first))
            }
            None => {
                self.list.push(entry);
                Ok(())
            }
        }
    }
}

#[cfg(test)]
mod tests;
