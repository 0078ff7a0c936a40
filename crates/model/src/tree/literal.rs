//! Numbers and texts as RON writes them.

use super::TreeError;
use crate::Span;

/// What is wrong with a number or a text, and where in it.
#[derive(Debug, PartialEq)]
pub(super) struct Wrong {
    message: String,
    span: Span,
}

impl Wrong {
    fn new(message: impl Into<String>, span: Span) -> Self {
        Self { message: message.into(), span }
    }

    /// Where the number or the text begins at a byte of the file.
    pub fn at(self, start: usize) -> TreeError {
        TreeError::text(self.message, start + self.span.start..start + self.span.end)
    }
}

type Literal<T> = Result<(T, usize), Wrong>;

/// A number that a text begins with, and its length.
pub(super) fn number(text: &str) -> Literal<f64> {
    let sign = usize::from(text.starts_with(['-', '+']));
    let negative = text.starts_with('-');
    let unsigned = &text[sign..];
    let signed = |x: f64| if negative { -x } else { x };
    for (word, value) in [("inf", f64::INFINITY), ("NaN", f64::NAN)] {
        if let Some(rest) = unsigned.strip_prefix(word)
            && let Some(suffix) = suffix(rest, &["", "f32", "f64"])
        {
            return Ok((signed(value), sign + word.len() + suffix));
        }
    }
    for (prefix, base) in [("0x", 16), ("0o", 8), ("0b", 2)] {
        if let Some(digits) = unsigned.strip_prefix(prefix) {
            let (x, length) = whole(digits, base, sign + prefix.len())?;
            return Ok((signed(x), sign + prefix.len() + length));
        }
    }
    let part = |c: char| c.is_ascii_digit() || matches!(c, 'e' | 'E' | '.' | '+' | '-' | '_');
    let length = sign + unsigned.find(|c| !part(c)).unwrap_or(unsigned.len());
    let written = &text[..length];
    // Underscores part digits.
    let parted = |(i, _): (usize, &str)| {
        let before = written[..i].chars().next_back();
        before.is_some_and(|c| c.is_ascii_digit() || matches!(c, '_' | 'e' | 'E'))
    };
    let plain = match written.contains('_') {
        true if written.match_indices('_').all(parted) => written.replace('_', ""),
        _ => String::new(),
    };
    let number = if plain.is_empty() { written } else { &plain };
    let Ok(x) = number.parse() else {
        return Err(Wrong::new(format!("`{written}` is no number"), 0..length));
    };
    let is_whole = !number.contains(['e', 'E', '.']);
    let of_whole = ["", "i8", "i16", "i32", "i64", "u8", "u16", "u32", "u64", "f32", "f64"];
    let suffixes = if is_whole { &of_whole[..] } else { &["", "f32", "f64"] };
    // Anything else behind it is told where its end is looked for.
    Ok((x, length + suffix(&text[length..], suffixes).unwrap_or(0)))
}

/// Length of the suffix that a text begins with, where a word ends behind it.
fn suffix(text: &str, known: &[&str]) -> Option<usize> {
    let word = text.find(|c: char| c != '_' && !c.is_alphanumeric()).unwrap_or(text.len());
    known.contains(&&text[..word]).then_some(word)
}

/// A whole number in another base.
fn whole(text: &str, base: u32, from: usize) -> Literal<f64> {
    let length = text.find(|c: char| c != '_' && !c.is_alphanumeric()).unwrap_or(text.len());
    let digits = text[..length].replace('_', "");
    match u64::from_str_radix(&digits, base) {
        Ok(x) if !text.starts_with('_') => Ok((x as f64, length)),
        _ => {
            let message = format!("`{}` is no whole number in base {base}", &text[..length]);
            Err(Wrong::new(message, from..from + length))
        }
    }
}

/// True for `r"…"`, `r#"…"#` and the like.
pub(super) fn is_raw_text(text: &str) -> bool {
    text.strip_prefix('r').is_some_and(|rest| rest.trim_start_matches('#').starts_with('"'))
}

/// A raw text, and its length.
pub(super) fn raw_text(text: &str) -> Literal<String> {
    let hashes = text[1..].find(|c| c != '#').unwrap_or(0);
    let open = 1 + hashes + 1;
    let close = format!("\"{}", "#".repeat(hashes));
    match text[open..].find(&close) {
        Some(end) => Ok((text[open..open + end].to_owned(), open + end + close.len())),
        None => Err(unclosed(&close, open)),
    }
}

fn unclosed(close: &str, open: usize) -> Wrong {
    Wrong::new(format!("the text that begins here does not end: `{close}` is missing"), 0..open)
}

/// A text in quotes, and its length.
pub(super) fn text(text: &str) -> Literal<String> {
    let (mut out, mut at) = (String::new(), 1);
    loop {
        let Some(next) = text[at..].find(['"', '\\']) else { return Err(unclosed("\"", 1)) };
        out.push_str(&text[at..at + next]);
        at += next;
        if text.as_bytes()[at] == b'"' {
            return Ok((out, at + 1));
        }
        at += escape(text, at, &mut out)?;
    }
}

/// A character in quotes, and its length.
pub(super) fn character(text: &str) -> Literal<String> {
    let mut out = String::new();
    let length = match text[1..].chars().next() {
        Some('\\') => escape(text, 1, &mut out)?,
        Some(c) => {
            out.push(c);
            c.len_utf8()
        }
        None => 0,
    };
    match text[1 + length..].starts_with('\'') {
        true => Ok((out, 1 + length + 1)),
        false => Err(Wrong::new("a text stands between `\"` and `\"`", 0..1)),
    }
}

/// What a backslash and that behind it stand for; its length.
fn escape(text: &str, at: usize, out: &mut String) -> Result<usize, Wrong> {
    let rest = &text[at + 1..];
    let Some(first) = rest.chars().next() else { return Err(unclosed("\"", 1)) };
    let plain = match first {
        '"' | '\'' | '\\' => first,
        'n' => '\n',
        'r' => '\r',
        't' => '\t',
        '0' => '\0',
        // The end of a line, with the blanks that the next one begins with.
        '\n' | '\r' => {
            let line = if rest.starts_with("\r\n") { 2 } else { 1 };
            let next = rest[line..].trim_start_matches([' ', '\t', '\n', '\r']);
            return Ok(1 + rest.len() - next.len());
        }
        'x' => return bytes(rest, at, out),
        'u' => {
            let digits = rest.strip_prefix("u{").and_then(|r| Some(&r[..r.find('}')?]));
            let digits =
                digits.filter(|d| d.len() <= 6 && d.chars().all(|c| c.is_ascii_hexdigit()));
            let code = digits.and_then(|d| u32::from_str_radix(d, 16).ok());
            let (Some(digits), Some(c)) = (digits, code.and_then(char::from_u32)) else {
                let end = at + 2 + usize::from(rest[1..].starts_with('{'));
                return Err(Wrong::new(
                    "`\\u{…}` has the number of a character in it, such as `\\u{e9}`",
                    at..end,
                ));
            };
            out.push(c);
            return Ok("\\u{}".len() + digits.len());
        }
        other => {
            let message = format!("`\\{other}` stands for nothing; a backslash itself is `\\\\`");
            return Err(Wrong::new(message, at..at + 1 + other.len_utf8()));
        }
    };
    out.push(plain);
    Ok(1 + first.len_utf8())
}

/// `\xNN`, as often as a character has bytes.
fn bytes(text: &str, at: usize, out: &mut String) -> Result<usize, Wrong> {
    let mut all = Vec::new();
    let mut rest = Some(text);
    while let Some(two) = rest.and_then(|r| r.strip_prefix('x')?.get(..2)) {
        // A sign is no digit.
        let digits = Some(two).filter(|two| !two.starts_with('+'));
        let Some(Ok(byte)) = digits.map(|two| u8::from_str_radix(two, 16)) else { break };
        all.push(byte);
        if let Ok(c) = std::str::from_utf8(&all) {
            out.push_str(c);
            return Ok(4 * all.len());
        }
        rest = text.get(4 * all.len() - 1..).and_then(|r| r.strip_prefix('\\'));
        if all.len() == 4 {
            break;
        }
    }
    Err(Wrong::new("`\\xNN` has two digits in base 16, and all bytes of a character", at..at + 2))
}
