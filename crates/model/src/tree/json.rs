//! A JSON text as the tree of a RON one.
//!
//! | JSON | RON |
//! |---|---|
//! | `{"Beam": {"nodes": […], …}}`, one key that begins with a capital | `Beam(nodes: […], …)` |
//! | `{"Concrete": "C30/37"}` | `Concrete("C30/37")` |
//! | `{"node": "a", "dof": "Ux"}` | `(node: "a", dof: Ux)` |
//! | an object as the value of a section such as `nodes`, or of an index of `For` | a map `{"a": …}` |
//! | `"Fixed"`, `"Gravity"`, `"Steel"`: names that stand alone | `Fixed`, `Gravity`, `Steel` |
//!
//! All else is alike. `title` and `parameters` hold texts as they are.

use super::{Entry, Kind, Node, TreeError};
use crate::Span;
use crate::schema::{self, Default, Takes};
use std::collections::HashMap;

/// Brackets within brackets.
const DEEPEST: usize = 64;

/// Reads a whole JSON text.
pub(crate) fn parse(text: &str) -> Result<Node, TreeError> {
    let start = text.len() - text.trim_start_matches('\u{feff}').len();
    let maps = [maps(schema::MODEL.blocks), maps_inside()];
    let mut reader = Reader { text, at: start, maps, bare: bare() };
    let root = reader.value(Place::Plain, 0)?;
    reader.blanks();
    match reader.peek() {
        None => Ok(root),
        Some(_) => Err(reader.wrong("nothing more is wanted behind the model")),
    }
}

/// Fields of some blocks whose objects are maps from names.
fn maps(blocks: &[&schema::Block]) -> Vec<&'static str> {
    let fields = blocks.iter().flat_map(|b| b.fields);
    let is_map = |takes: Takes| match takes {
        Takes::Map(_) => true,
        Takes::Words(words) => words.starts_with("a map"),
        _ => false,
    };
    fields.filter(|f| is_map(f.takes)).map(|f| f.name).collect()
}

/// Those of blocks inside sections; `nodes` of an element may be one, too.
fn maps_inside() -> Vec<&'static str> {
    let inside = schema::groups().into_iter().filter(|g| !std::ptr::eq(*g, &schema::MODEL));
    inside.flat_map(|g| maps(g.blocks)).chain(["nodes"]).collect()
}

/// Names that may stand alone.
fn bare() -> Vec<&'static str> {
    let blocks = schema::groups().into_iter().flat_map(|g| g.blocks);
    let needs =
        |b: &&&schema::Block| b.fields.iter().any(|f| matches!(f.default, Default::Required));
    let alone = blocks.filter(|b| !b.name.is_empty() && !needs(b)).map(|b| b.name);
    alone.chain(schema::SUPPORTS).collect()
}

/// Where a value stands.
#[derive(Clone, Copy, PartialEq)]
enum Place {
    /// Objects are blocks.
    Plain,
    /// An object is a map.
    Map,
    /// Among the indices of `For`.
    Indices,
    /// Texts stay texts.
    Texts,
}

struct Reader<'a> {
    text: &'a str,
    at: usize,
    /// Of the model itself, and of blocks inside it.
    maps: [Vec<&'static str>; 2],
    bare: Vec<&'static str>,
}

impl Reader<'_> {
    fn peek(&self) -> Option<char> {
        self.text.get(self.at..)?.chars().next()
    }

    fn blanks(&mut self) {
        while self.peek().is_some_and(|c| matches!(c, ' ' | '\t' | '\n' | '\r')) {
            self.at += 1;
        }
    }

    /// An error at the place that is read.
    fn wrong(&self, message: &str) -> TreeError {
        let end = self.at + self.peek().map_or(0, char::len_utf8);
        self.wrong_at(message, self.at..end)
    }

    fn wrong_at(&self, message: &str, span: Span) -> TreeError {
        TreeError::text(message.into(), span)
    }

    fn eat(&mut self, wanted: char) -> bool {
        self.blanks();
        let is_there = self.peek() == Some(wanted);
        self.at += if is_there { wanted.len_utf8() } else { 0 };
        is_there
    }

    fn value(&mut self, place: Place, depth: usize) -> Result<Node, TreeError> {
        if depth > DEEPEST {
            return Err(self.wrong(
                "the brackets are nested too deeply here: no value of a file lies in more than a few",
            ));
        }
        self.blanks();
        let start = self.at;
        let kind = match self.peek() {
            Some('{') => return self.object(place, depth),
            Some('[') => {
                let inside = if place == Place::Texts { place } else { Place::Plain };
                Kind::List(None, self.list(inside, depth)?)
            }
            Some('"') => {
                let text = self.string()?;
                let stands_alone = place != Place::Texts && self.bare.contains(&text.as_str());
                if stands_alone { Kind::Name(text) } else { Kind::Text(text) }
            }
            _ => self.word()?,
        };
        Ok(Node { span: start..self.at, kind })
    }

    /// A number, `true` or `false`.
    fn word(&mut self) -> Result<Kind, TreeError> {
        let rest = &self.text[self.at..];
        let end = rest.find(|c: char| !(c.is_ascii_alphanumeric() || "+-.".contains(c)));
        let word = &rest[..end.unwrap_or(rest.len())];
        let span = self.at..self.at + word.len();
        let kind = match word {
            "true" => Kind::Flag(true),
            "false" => Kind::Flag(false),
            "null" => return Err(self.wrong_at("`null` says nothing: leave the field out", span)),
            "" => return Err(self.wrong("a value is wanted here")),
            number => match number.parse::<f64>() {
                Ok(x) if number.starts_with(|c: char| c == '-' || c.is_ascii_digit()) => {
                    Kind::Number(x)
                }
                _ => {
                    let message = format!("`{word}` is no value: put a text in quotes");
                    return Err(self.wrong_at(&message, span));
                }
            },
        };
        self.at = span.end;
        Ok(kind)
    }

    fn list(&mut self, inside: Place, depth: usize) -> Result<Vec<Node>, TreeError> {
        self.at += 1;
        let mut items = Vec::new();
        if self.eat(']') {
            return Ok(items);
        }
        loop {
            items.push(self.value(inside, depth + 1)?);
            if self.eat(']') {
                return Ok(items);
            }
            if !self.eat(',') {
                return Err(self.wrong("`,` or `]` is wanted here"));
            }
        }
    }

    fn object(&mut self, place: Place, depth: usize) -> Result<Node, TreeError> {
        let start = self.at;
        let entries = self.entries(place, depth)?;
        let span = start..self.at;
        let is_map = place == Place::Map;
        let named = |e: &Entry| e.key.starts_with(|c: char| c.is_uppercase());
        let kind = match (&entries[..], is_map) {
            (_, true) => Kind::Map(entries),
            ([only], _) if named(only) => {
                let name = only.key.clone();
                let Some(Entry { value, .. }) = entries.into_iter().next() else {
                    return Err(self.wrong_at("a name with its fields is wanted here", span));
                };
                match value.kind {
                    Kind::Fields(None, fields) => Kind::Fields(Some(name), fields),
                    Kind::List(None, items) => Kind::List(Some(name), items),
                    _ => Kind::List(Some(name), vec![value]),
                }
            }
            _ => Kind::Fields(None, entries),
        };
        Ok(Node { span, kind })
    }

    fn entries(&mut self, place: Place, depth: usize) -> Result<Vec<Entry>, TreeError> {
        self.at += 1;
        let mut entries: Vec<Entry> = Vec::new();
        let mut places: HashMap<String, usize> = HashMap::new();
        if self.eat('}') {
            return Ok(entries);
        }
        loop {
            self.blanks();
            if self.peek() != Some('"') {
                return Err(self.wrong("a name in quotes is wanted here"));
            }
            let start = self.at;
            let key = self.string()?;
            let key_span = start + 1..self.at - 1;
            if let Some(first) = places.insert(key.clone(), entries.len()) {
                return Err(TreeError::twice(&key, key_span, &entries[first].key_span));
            }
            if !self.eat(':') {
                return Err(self.wrong("`:` is wanted here"));
            }
            let inside = match (place, key.as_str()) {
                (Place::Texts, _) | (Place::Plain, "title") => Place::Texts,
                (Place::Plain, "For") => Place::Indices,
                (Place::Indices, "of" | "when") => Place::Plain,
                (Place::Indices, _) => Place::Map,
                (Place::Plain, key) if self.maps[depth.min(1)].contains(&key) => Place::Map,
                _ => Place::Plain,
            };
            let value = if depth == 0 && key == "parameters" {
                self.parameters(depth)?
            } else {
                self.value(inside, depth + 1)?
            };
            entries.push(Entry { key, key_span, value });
            if self.eat('}') {
                return Ok(entries);
            }
            if !self.eat(',') {
                return Err(self.wrong("`,` or `}` is wanted here"));
            }
        }
    }

    /// The map of the parameters, in which texts are what they are.
    fn parameters(&mut self, depth: usize) -> Result<Node, TreeError> {
        self.blanks();
        let start = self.at;
        if self.peek() != Some('{') {
            return self.value(Place::Plain, depth + 1);
        }
        let entries = self.entries(Place::Texts, depth + 1)?;
        Ok(Node { span: start..self.at, kind: Kind::Map(entries) })
    }

    fn string(&mut self) -> Result<String, TreeError> {
        let start = self.at;
        self.at += 1;
        let mut out = String::new();
        loop {
            let Some(c) = self.peek() else {
                return Err(self.wrong_at("this text has no end", start..start + 1));
            };
            self.at += c.len_utf8();
            match c {
                '"' => return Ok(out),
                '\\' => out.push(self.escaped()?),
                c if c < ' ' => {
                    self.at -= 1;
                    return Err(self.wrong("a line of a text ends with `\\n`"));
                }
                c => out.push(c),
            }
        }
    }

    /// What stands behind a backslash.
    fn escaped(&mut self) -> Result<char, TreeError> {
        let start = self.at - 1;
        let c = self.peek();
        self.at += c.map_or(0, char::len_utf8);
        let plain = match c {
            Some(c @ ('"' | '\\' | '/')) => c,
            Some('n') => '\n',
            Some('t') => '\t',
            Some('r') => '\r',
            Some('b') => '\u{8}',
            Some('f') => '\u{c}',
            Some('u') => {
                let first = self.hexadecimal(start)?;
                let pair = (0xd800..0xdc00).contains(&first);
                let code = if pair && self.text[self.at..].starts_with("\\u") {
                    self.at += 2;
                    let second = self.hexadecimal(start)?;
                    0x10000 + ((first - 0xd800) << 10) + (second.wrapping_sub(0xdc00) & 0x3ff)
                } else {
                    first
                };
                return char::from_u32(code).ok_or_else(|| {
                    self.wrong_at("this is no character of Unicode", start..self.at)
                });
            }
            _ => return Err(self.wrong_at("there is no such escape in JSON", start..self.at)),
        };
        Ok(plain)
    }

    fn hexadecimal(&mut self, start: usize) -> Result<u32, TreeError> {
        let digits = self.text.get(self.at..self.at + 4);
        let code = digits.and_then(|d| u32::from_str_radix(d, 16).ok());
        let Some(code) = code.filter(|_| digits.is_some_and(|d| !d.starts_with('+'))) else {
            let end = (self.at + 4).min(self.text.len());
            let end = (start..=end).rev().find(|i| self.text.is_char_boundary(*i)).unwrap_or(start);
            return Err(self.wrong_at("four hexadecimal digits are wanted here", start..end));
        };
        self.at += 4;
        Ok(code)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn told(text: &str) -> String {
        match parse(text) {
            Ok(node) => format!("{:?}", node.kind),
            Err(e) => format!("{} {:?} {}", e.code, e.span, e.message),
        }
    }

    #[test]
    fn damaged_texts_are_told_where_they_are() {
        for (text, code, at) in [
            ("{", "E0101", 1..1),
            ("{\"a\": [1, 2}", "E0101", 11..12),
            ("{\"a\" 1}", "E0101", 5..6),
            ("{\"a\": 1, \"a\": 2}", "E0102", 10..11),
            ("{\"a\": nul}", "E0101", 6..9),
            ("{\"a\": null}", "E0101", 6..10),
            ("{\"a\": \"x}", "E0101", 6..7),
            ("{\"a\": \"\\q\"}", "E0101", 7..9),
            ("{\"a\": \"\\u00é\"}", "E0101", 7..13),
            ("{\"a\": \"\\ud800\"}", "E0101", 7..13),
            ("{\"a\": NaN}", "E0101", 6..9),
            ("{\"a\": 1} 2", "E0101", 9..10),
        ] {
            let e = parse(text).expect_err(text);
            assert_eq!((e.code, e.span.clone()), (code, at), "{text}: {}", e.message);
        }
        let deep = "[".repeat(100_000);
        assert!(told(&deep).contains("nested too deeply"));
    }

    #[test]
    fn texts_are_unescaped() {
        let node = parse("{\"title\": \"a\\u00e9\\n\\\"\\ud83d\\ude00\"}").unwrap();
        let Kind::Fields(None, entries) = node.kind else { panic!("no fields") };
        assert!(matches!(&entries[0].value.kind, Kind::Text(t) if t == "aé\n\"😀"));
    }
}
