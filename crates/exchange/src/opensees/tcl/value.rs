//! Values of a script: texts that remember where they were written, and lists in them.

use std::rc::Rc;

/// Where in the files of a script something was written: the file, and the bytes in it.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Place {
    /// Number of the file.
    pub file: usize,
    /// Bytes of its text.
    pub span: std::ops::Range<usize>,
}

/// A text, and where it was written where it stands there word for word: what is wrong in a body is told at its own line.
#[derive(Clone, Debug)]
pub struct Value {
    /// The text.
    pub text: Rc<String>,
    /// File and byte at which it begins.
    pub origin: Option<(usize, usize)>,
}

impl Value {
    /// Nothing.
    pub fn empty() -> Self {
        Self::new(String::new())
    }

    /// A text that was made.
    pub fn new(text: impl Into<String>) -> Self {
        Self { text: Rc::new(text.into()), origin: None }
    }

    /// A list.
    pub fn list<T: AsRef<str>>(items: &[T]) -> Self {
        let all: Vec<String> = items.iter().map(|i| quoted(i.as_ref())).collect();
        Self::new(all.join(" "))
    }

    /// The text.
    pub fn str(&self) -> &str {
        &self.text
    }

    /// Its items, where braces and quotes stand in pairs.
    pub fn items(&self) -> Result<Vec<Value>, String> {
        let all = items(&self.text)?;
        let item = |(text, at): (String, Option<usize>)| Value {
            text: Rc::new(text),
            origin: self.origin.zip(at).map(|((file, start), at)| (file, start + at)),
        };
        Ok(all.into_iter().map(item).collect())
    }
}

/// Items of a list, each with the byte where it stands word for word.
fn items(text: &str) -> Result<Vec<(String, Option<usize>)>, String> {
    let bytes = text.as_bytes();
    let (mut out, mut i) = (Vec::new(), 0);
    loop {
        i = skip_space(bytes, i);
        if i >= bytes.len() {
            return Ok(out);
        }
        match bytes[i] {
            b'{' => {
                let end = closing(text, i).ok_or("a list with a brace that does not close")?;
                out.push((text[i + 1..end].to_owned(), Some(i + 1)));
                i = end + 1;
                if i < bytes.len() && !is_space(bytes, i) {
                    return Err("a list with something right behind a closing brace".into());
                }
            }
            b'"' => {
                let start = i + 1;
                i = start;
                while i < bytes.len() && bytes[i] != b'"' {
                    i += if bytes[i] == b'\\' { 2 } else { 1 };
                }
                if i >= bytes.len() {
                    return Err("a list with quotes that do not end".into());
                }
                out.push((unescaped(&text[start..i]), None));
                i += 1;
            }
            _ => {
                let start = i;
                while i < bytes.len() && !is_space(bytes, i) {
                    i += if bytes[i] == b'\\' { 2 } else { 1 };
                }
                let mut end = i.min(bytes.len());
                while !text.is_char_boundary(end) {
                    end += 1;
                }
                i = end;
                let raw = &text[start..end];
                let whole = !raw.contains('\\');
                out.push((unescaped(raw), whole.then_some(start)));
            }
        }
    }
}

fn is_space(bytes: &[u8], i: usize) -> bool {
    bytes[i].is_ascii_whitespace()
        || bytes[i] == b'\\' && matches!(bytes.get(i + 1), Some(b'\n' | b'\r'))
}

fn skip_space(bytes: &[u8], mut i: usize) -> usize {
    while i < bytes.len() && is_space(bytes, i) {
        i += 1;
    }
    i
}

/// The byte of the brace that closes the one at `open`.
pub fn closing(text: &str, open: usize) -> Option<usize> {
    let bytes = text.as_bytes();
    let (mut depth, mut i) = (0_usize, open);
    while i < bytes.len() {
        match bytes[i] {
            b'\\' => i += 1,
            b'{' => depth += 1,
            b'}' => {
                depth -= 1;
                if depth == 0 {
                    return Some(i);
                }
            }
            _ => {}
        }
        i += 1;
    }
    None
}

/// A text with its backslashes read.
fn unescaped(text: &str) -> String {
    let mut out = String::with_capacity(text.len());
    let mut rest = text;
    while let Some(at) = rest.find('\\') {
        out.push_str(&rest[..at]);
        let (c, used) = escape(&rest[at..]);
        out.push_str(&c);
        rest = &rest[at + used..];
    }
    out.push_str(rest);
    out
}

/// What a backslash and what follows it stand for, and how many bytes that takes.
pub fn escape(text: &str) -> (String, usize) {
    let mut chars = text.chars();
    chars.next();
    let Some(c) = chars.next() else { return ("\\".into(), 1) };
    let code = |digits: &str, most: usize, radix: u32| {
        let n = digits.chars().take(most).take_while(|c| c.is_digit(radix)).count();
        let value = u32::from_str_radix(&digits[..n], radix).ok().and_then(char::from_u32);
        value.map(|c| (c.to_string(), 2 + n))
    };
    let rest = chars.as_str();
    match c {
        'n' => ("\n".into(), 2),
        't' => ("\t".into(), 2),
        'r' => ("\r".into(), 2),
        'a' | 'b' | 'f' | 'v' => (" ".into(), 2),
        'x' => code(rest, 2, 16).unwrap_or(("x".into(), 2)),
        'u' => code(rest, 4, 16).unwrap_or(("u".into(), 2)),
        '\n' => (" ".into(), 2 + rest.len() - rest.trim_start_matches([' ', '\t']).len()),
        '\r' if rest.starts_with('\n') => {
            let rest = &rest[1..];
            (" ".into(), 3 + rest.len() - rest.trim_start_matches([' ', '\t']).len())
        }
        c => (c.to_string(), 1 + c.len_utf8()),
    }
}

/// An item as it stands in a list.
pub fn quoted(item: &str) -> String {
    let special = |c: char| c.is_whitespace() || "{}[]$\";\\".contains(c);
    if item.is_empty() {
        return "{}".into();
    }
    if !item.contains(special) && !item.starts_with('#') {
        return item.into();
    }
    let braced = format!("{{{item}}}");
    if !item.ends_with('\\') && closing(&braced, 0) == Some(braced.len() - 1) {
        return braced;
    }
    item.chars().fold(String::new(), |mut out, c| {
        match c {
            '\n' => out.push_str("\\n"),
            c if special(c) => out.extend(['\\', c]),
            c => out.push(c),
        }
        out
    })
}

/// A number of a script.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Number {
    /// A whole number.
    Whole(i64),
    /// Any other.
    Real(f64),
}

impl Number {
    /// Reads a number: decimal, `0x…`, `0b…`, `0o…`, and with a leading zero octal, as Tcl 8 has it.
    pub fn read(text: &str) -> Option<Self> {
        let text = text.trim();
        let (negative, plain) = match text.as_bytes().first()? {
            b'-' => (true, &text[1..]),
            b'+' => (false, &text[1..]),
            _ => (false, text),
        };
        let lower = plain.to_ascii_lowercase();
        let radix = |digits: &str, radix: u32| {
            let good = !digits.is_empty() && digits.chars().all(|c| c.is_digit(radix));
            let signed = format!("{}{digits}", if negative { "-" } else { "" });
            good.then(|| i64::from_str_radix(&signed, radix).ok()).flatten().map(Self::Whole)
        };
        for (front, base) in [("0x", 16), ("0b", 2), ("0o", 8)] {
            if let Some(digits) = lower.strip_prefix(front) {
                return radix(digits, base);
            }
        }
        if !lower.is_empty() && lower.bytes().all(|b| b.is_ascii_digit()) {
            if lower.len() > 1 && lower.starts_with('0') {
                return radix(&lower, 8);
            }
            if let Some(n) = radix(&lower, 10) {
                return Some(n);
            }
        }
        if !lower.starts_with(|c: char| c.is_ascii_digit() || c == '.') {
            return None;
        }
        let x: f64 = text.parse().ok()?;
        x.is_finite().then_some(Self::Real(x))
    }

    /// Its value.
    pub fn real(self) -> f64 {
        match self {
            Self::Whole(i) => i as f64,
            Self::Real(x) => x,
        }
    }

    /// As Tcl writes it: a real number is told from a whole one.
    pub fn text(self) -> String {
        match self {
            Self::Whole(i) => i.to_string(),
            Self::Real(x) => format!("{x:?}"),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn split(text: &str) -> Vec<String> {
        Value::new(text).items().unwrap().iter().map(|v| v.str().to_owned()).collect()
    }

    #[test]
    fn lists_are_read_and_written() {
        assert_eq!(split("a {b {c d}} \"e f\" g\\ h"), ["a", "b {c d}", "e f", "g h"]);
        for items in [vec!["a b", "", "{", "c\\", "d;e$f[g]"], vec!["}{", "\n", "#x"]] {
            assert_eq!(split(Value::list(&items).str()), items);
        }
        assert!(Value::new("{a").items().is_err() && Value::new("{a}b").items().is_err());
    }

    #[test]
    fn numbers_are_those_of_tcl() {
        let whole = |t: &str| Number::read(t) == Some(Number::Whole(-8));
        assert!(whole("-8") && whole("-0x8") && whole(" -010 ") && whole("-0b1000"));
        assert_eq!(Number::read("08"), None);
        assert_eq!(Number::read("1e3"), Some(Number::Real(1000.0)));
        assert_eq!(Number::read(".5"), Some(Number::Real(0.5)));
        for no in ["", "-", "1e999", "inf", "nan", "1x", "0x"] {
            assert_eq!(Number::read(no), None, "{no}");
        }
        assert_eq!(Number::Real(2.0).text(), "2.0");
    }
}
