//! Words of a command: braces, quotes, variables, brackets.

use super::interpreter::{Flow, Interpreter, Outcome};
use super::value::{Place, Value, closing, escape};
use std::rc::Rc;

/// A command's words and where they were written.
type Command = (Vec<Value>, Vec<Place>);
/// Where a text begins that was written word for word.
type Origin = Option<(usize, usize)>;

impl Interpreter<'_> {
    /// The next command of a text from a byte on.
    pub(super) fn next_command(
        &mut self,
        text: &str,
        at: &mut usize,
        origin: Origin,
        around: &Place,
    ) -> Result<Option<Command>, Flow> {
        let bytes = text.as_bytes();
        loop {
            while *at < bytes.len()
                && (bytes[*at].is_ascii_whitespace() || bytes[*at] == b';' || joined(bytes, *at))
            {
                *at += 1;
            }
            if bytes.get(*at) != Some(&b'#') {
                break;
            }
            while *at < bytes.len() && bytes[*at] != b'\n' {
                *at += if bytes[*at] == b'\\' { 2 } else { 1 };
            }
            *at = (*at).min(bytes.len());
        }
        if *at >= bytes.len() {
            return Ok(None);
        }
        let place = |start: usize, end: usize| match origin {
            Some((file, first)) => Place { file, span: first + start..first + end },
            None => around.clone(),
        };
        let (mut words, mut places) = (Vec::new(), Vec::new());
        loop {
            while *at < bytes.len()
                && (matches!(bytes[*at], b' ' | b'\t' | b'\r' | 0x0c) || joined(bytes, *at))
            {
                *at += if joined(bytes, *at) { 2 } else { 1 };
            }
            *at = (*at).min(bytes.len());
            if *at >= bytes.len() || matches!(bytes[*at], b'\n' | b';') {
                break;
            }
            let start = *at;
            if words.is_empty() {
                // What goes wrong inside a word is told there until the whole command is known.
                self.places = vec![place(start, start + 1)];
            }
            let spread = text[start..].starts_with("{*}")
                && bytes.get(start + 3).is_some_and(|b| !b.is_ascii_whitespace() && *b != b';');
            if spread {
                *at += 3;
            }
            self.places[0] = place(start, start + 1);
            let value = self.word(text, at, origin)?;
            let here = place(start, *at);
            if spread {
                let items = value.items().map_err(|e| self.wrong(&e, ""))?;
                self.spend(value.text.len())?;
                places.extend(items.iter().map(|_| here.clone()));
                words.extend(items);
            } else {
                words.push(value);
                places.push(here);
            }
        }
        if places.is_empty() {
            places.push(place(*at, *at));
        }
        Ok(Some((words, places)))
    }

    fn word(&mut self, text: &str, at: &mut usize, origin: Origin) -> Outcome {
        let bytes = text.as_bytes();
        let from = |start: usize| origin.map(|(file, first)| (file, first + start));
        match bytes[*at] {
            b'{' => {
                let Some(end) = closing(text, *at) else {
                    let e = self.wrong(
                        "a brace that does not close",
                        "a `}` for each `{`, in comments as well",
                    );
                    return Err(e);
                };
                let start = *at + 1;
                *at = end + 1;
                self.ends(text, *at, "a closing brace")?;
                Ok(Value { text: Rc::new(text[start..end].to_owned()), origin: from(start) })
            }
            b'"' => {
                *at += 1;
                let start = *at;
                let (out, plain) = self.pieces(text, at, origin, |b| b == b'"')?;
                if *at >= bytes.len() {
                    return Err(self.wrong("quotes that do not end", "a second `\"`"));
                }
                *at += 1;
                self.ends(text, *at, "closing quotes")?;
                Ok(Value { text: Rc::new(out), origin: if plain { from(start) } else { None } })
            }
            _ => {
                let start = *at;
                if bytes[start] == b'$' || bytes[start] == b'[' {
                    let (value, end) = self.substitute(text, start, origin, true)?;
                    if end >= bytes.len() || ends_word(bytes[end]) {
                        *at = end;
                        return Ok(value);
                    }
                    // More follows: both are joined, and what was substituted is not asked again.
                    *at = end;
                    let (more, _) = self.pieces(text, at, origin, ends_word)?;
                    return self.value(format!("{}{more}", value.str()));
                }
                let (out, plain) = self.pieces(text, at, origin, ends_word)?;
                Ok(Value { text: Rc::new(out), origin: if plain { from(start) } else { None } })
            }
        }
    }

    fn ends(&mut self, text: &str, at: usize, what: &str) -> Result<(), Flow> {
        let bytes = text.as_bytes();
        if at >= bytes.len() || ends_word(bytes[at]) || joined(bytes, at) {
            return Ok(());
        }
        let rest: String = text[at..].chars().take(10).collect();
        Err(self.wrong(&format!("`{rest}` right behind {what}"), "a space between words"))
    }

    /// Text with what is substituted in it, up to a byte; whether it stands word for word.
    fn pieces(
        &mut self,
        text: &str,
        at: &mut usize,
        origin: Origin,
        end: fn(u8) -> bool,
    ) -> Result<(String, bool), Flow> {
        let bytes = text.as_bytes();
        let (mut out, mut plain) = (String::new(), true);
        while *at < bytes.len() && !end(bytes[*at]) {
            match bytes[*at] {
                b'$' | b'[' => {
                    let (value, next) = self.substitute(text, *at, origin, true)?;
                    out += value.str();
                    self.bounded(out.len())?;
                    *at = next;
                    plain = false;
                }
                b'\\' => {
                    if joined(bytes, *at) && end(b' ') {
                        break;
                    }
                    let (c, used) = escape(&text[*at..]);
                    out += &c;
                    *at += used;
                    plain = false;
                }
                _ => {
                    let rest = &text[*at..];
                    let n = rest.char_indices().nth(1).map_or(rest.len(), |(i, _)| i);
                    out += &rest[..n];
                    *at += n;
                }
            }
        }
        Ok((out, plain))
    }

    /// What `$name`, `$name(index)`, `${name}` or `[command]` at a byte stands for, and the byte behind it. Where it is not
    /// `live`, it is only read over.
    pub(super) fn substitute(
        &mut self,
        text: &str,
        at: usize,
        origin: Origin,
        live: bool,
    ) -> Result<(Value, usize), Flow> {
        let bytes = text.as_bytes();
        if bytes[at] == b'[' {
            let Some(end) = bracket(text, at) else {
                return Err(self.wrong("a bracket that does not close", "a `]` for each `[`"));
            };
            if !live {
                return Ok((Value::empty(), end + 1));
            }
            let inner = text[at + 1..end].to_owned();
            let origin = origin.map(|(file, first)| (file, first + at + 1));
            let value = self.evaluate(&Value { text: Rc::new(inner), origin })?;
            return Ok((value, end + 1));
        }
        let start = at + 1;
        if bytes.get(start) == Some(&b'{') {
            let Some(end) = text[start..].find('}').map(|n| start + n) else {
                return Err(self.wrong("`${` without its `}`", ""));
            };
            let name = &text[start + 1..end];
            let value = if live { self.get(name)? } else { Value::empty() };
            return Ok((value, end + 1));
        }
        let mut end = start;
        while let Some(c) = text[end..].chars().next() {
            if !c.is_alphanumeric() && c != '_' && !text[end..].starts_with("::") {
                break;
            }
            end += if c == ':' { 2 } else { c.len_utf8() };
        }
        if end == start {
            return Ok((Value::new("$"), start));
        }
        let name = &text[start..end];
        if bytes.get(end) != Some(&b'(') {
            let value = if live { self.get(name)? } else { Value::empty() };
            return Ok((value, end));
        }
        let mut inner = end + 1;
        let index = if live {
            self.pieces(text, &mut inner, origin, |b| b == b')')?.0
        } else {
            inner = text[inner..].find(')').map_or(bytes.len(), |n| inner + n);
            String::new()
        };
        if inner >= bytes.len() {
            return Err(self.wrong(&format!("`${name}(` without its `)`"), ""));
        }
        let value = if live { self.get(&format!("{name}({index})"))? } else { Value::empty() };
        Ok((value, inner + 1))
    }
}

fn ends_word(b: u8) -> bool {
    matches!(b, b' ' | b'\t' | b'\r' | b'\n' | 0x0c | b';')
}

/// True at a backslash that joins two lines.
fn joined(bytes: &[u8], at: usize) -> bool {
    bytes[at] == b'\\'
        && (bytes.get(at + 1) == Some(&b'\n')
            || bytes.get(at + 1) == Some(&b'\r') && bytes.get(at + 2) == Some(&b'\n'))
}

/// The byte of the bracket that closes the one at `open`: braces and quotes at the beginning of words are read over.
fn bracket(text: &str, open: usize) -> Option<usize> {
    let bytes = text.as_bytes();
    let (mut depth, mut i, mut fresh, mut quoted) = (0_usize, open, false, Vec::new());
    while i < bytes.len() {
        match bytes[i] {
            b'\\' => i += 1,
            b'"' if quoted.last() == Some(&depth) => _ = quoted.pop(),
            b'"' if fresh && quoted.last() != Some(&depth) => quoted.push(depth),
            b'{' if (fresh || i > 0 && bytes[i - 1] == b'$') && quoted.last() != Some(&depth) => {
                i = closing(text, i)?
            }
            b'[' => depth += 1,
            b']' if quoted.last() != Some(&depth) => {
                depth = depth.checked_sub(1)?;
                if depth == 0 {
                    return Some(i);
                }
            }
            _ => {}
        }
        fresh = bytes.get(i).is_some_and(|b| b.is_ascii_whitespace() || matches!(b, b'[' | b';'));
        i += 1;
    }
    None
}
