//! Lines, words and fixed columns of a text.

use crate::error::{Problem, ReadError};
use std::borrow::Cow;

/// The lines of a file.
pub(super) struct Text<'a> {
    pub file: String,
    pub lines: Vec<&'a str>,
}

/// The content of a file as text. Letters beyond ASCII in an old code page become marks; they stand in
/// headers only.
pub(super) fn decode(bytes: &[u8]) -> Result<Cow<'_, str>, Problem> {
    if bytes.iter().all(u8::is_ascii_whitespace) {
        return Err(Problem::Empty);
    }
    for (magic, name) in [
        (&b"PK\x03\x04"[..], "zip"),
        (b"\x1f\x8b", "gzip"),
        (b"BZh", "bzip2"),
        (b"7z\xbc\xaf", "7z"),
    ] {
        if bytes.starts_with(magic) {
            return Err(Problem::Packed(name));
        }
    }
    let head = &bytes[..bytes.len().min(65_536)];
    let control = head.iter().filter(|b| **b < 32 && !b"\t\n\r\x0c\x1a".contains(b)).count();
    if bytes.contains(&0) || 100 * control > head.len() {
        return Err(Problem::Binary);
    }
    Ok(String::from_utf8_lossy(bytes.strip_prefix(b"\xef\xbb\xbf").unwrap_or(bytes)))
}

impl Text<'_> {
    /// An error at a line (index from 0).
    pub fn fail(&self, line: Option<usize>, problem: Problem) -> ReadError {
        ReadError { file: self.file.clone(), line: line.map(|i| i + 1), problem }
    }

    /// Index of the first line at or behind `from` that holds the words, whatever their case.
    pub fn find(&self, from: usize, words: &str) -> Option<usize> {
        let words = words.to_lowercase();
        let lines = self.lines.iter().enumerate().skip(from);
        lines.map(|(i, l)| (i, l.to_lowercase())).find(|(_, l)| l.contains(&words)).map(|(i, _)| i)
    }

    /// A number of the header.
    pub fn header(&self, line: usize, text: &str, what: &'static str) -> Result<f64, ReadError> {
        number(text.trim()).ok_or_else(|| {
            self.fail(Some(line), Problem::Header { text: text.trim().to_owned(), what })
        })
    }

    /// A count of the header.
    pub fn count(&self, line: usize, text: &str, what: &'static str) -> Result<usize, ReadError> {
        text.trim().parse().map_err(|_| {
            self.fail(Some(line), Problem::Header { text: text.trim().to_owned(), what })
        })
    }

    /// `count` numbers from line `from` on, and the index of the line behind them. A line that `ends` says
    /// so of ends the block.
    pub fn numbers(
        &self,
        from: usize,
        count: usize,
        width: Option<usize>,
        ends: impl Fn(&str) -> bool,
    ) -> Result<(Vec<f64>, usize), ReadError> {
        let mut all = Vec::with_capacity(count.min(10_000_000));
        let mut at = from;
        while all.len() < count {
            let Some(line) = self.lines.get(at).filter(|l| !ends(l)) else {
                let problem = Problem::Truncated { stated: count, found: all.len() };
                return Err(self.fail(Some(at.saturating_sub(1)), problem));
            };
            for cell in cells(line, width) {
                let Some(x) = number(cell).filter(|x| x.is_finite()) else {
                    return Err(self.fail(Some(at), Problem::NotANumber(cell.to_owned())));
                };
                all.push(x);
            }
            at += 1;
        }
        if all.len() > count {
            let problem = Problem::TooMany { stated: count, found: all.len() };
            return Err(self.fail(Some(at - 1), problem));
        }
        Ok((all, at))
    }
}

/// The cells of a line: fields of a width where they fit, words otherwise. Fields of a fixed width may touch
/// each other.
fn cells(line: &str, width: Option<usize>) -> Vec<&str> {
    let words = || line.split([' ', '\t', ',', '\r']).filter(|w| !w.is_empty()).collect();
    let Some(width) = width.filter(|_| line.is_ascii()) else { return words() };
    let line = line.trim_end();
    let fields: Vec<&str> = (0..line.len().div_ceil(width))
        .map(|i| line[i * width..((i + 1) * width).min(line.len())].trim())
        .filter(|f| !f.is_empty())
        .collect();
    if fields.iter().all(|f| number(f).is_some()) { fields } else { words() }
}

/// Fields of a fixed width, empty ones included.
pub(super) fn fields(line: &str, width: usize) -> Vec<&str> {
    if !line.is_ascii() {
        return Vec::new();
    }
    let line = line.trim_end();
    (0..line.len().div_ceil(width))
        .map(|i| line[i * width..((i + 1) * width).min(line.len())].trim())
        .collect()
}

/// A number as Fortran and others write it: `1.0D-3` too.
pub(super) fn number(text: &str) -> Option<f64> {
    text.parse().ok().or_else(|| text.replace(['d', 'D'], "e").parse().ok())
}

/// The first number at or behind a place of a text, with a point before or within it: ` .005 sec`.
pub(super) fn first_number(text: &str) -> Option<(f64, &str)> {
    let start = text.find(|c: char| c.is_ascii_digit() || c == '-' || c == '.')?;
    let rest = &text[start..];
    let end = rest
        .char_indices()
        .find(|(i, c)| {
            let exponent = matches!(c, 'e' | 'E')
                && rest[i + 1..].starts_with(|c: char| c.is_ascii_digit() || c == '-' || c == '+');
            let sign = (*c == '-' || *c == '+') && (*i == 0 || rest[..*i].ends_with(['e', 'E']));
            !(c.is_ascii_digit() || *c == '.' || exponent || sign)
        })
        .map_or(rest.len(), |(i, _)| i);
    // A full stop behind the number is none of it.
    match rest[..end].parse() {
        Ok(x) => Some((x, &rest[end..])),
        Err(_) => rest[..end].trim_end_matches('.').parse().ok().map(|x| (x, &rest[end..])),
    }
}

/// Width of the fields in a Fortran format such as `(8F10.5)`, `(10I8)`, `(1F15.6E)`.
pub(super) fn width(text: &str) -> Option<usize> {
    let open = text.rfind('(')?;
    let inside: String = text[open + 1..].chars().take_while(|c| *c != ')').collect();
    let letter = inside.find(|c: char| "fFiIeEgG".contains(c))?;
    let digits: String = inside[letter + 1..].chars().take_while(char::is_ascii_digit).collect();
    digits.parse().ok().filter(|w| (1..=64).contains(w))
}

/// What one step of the last digit of a number is: 0.001 for `12.345`.
pub(super) fn last_digit(text: &str) -> f64 {
    let mantissa = text.split(['e', 'E']).next().unwrap_or_default();
    let decimals = mantissa.split_once('.').map_or(0, |(_, d)| d.trim().len());
    10f64.powi(-(decimals as i32))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn fields_may_touch_and_words_may_be_free() {
        assert_eq!(cells("  -.123456 -1.234567", Some(10)), ["-.123456", "-1.234567"]);
        assert_eq!(cells("-12.123456-11.234567", Some(10)), ["-12.123456", "-11.234567"]);
        assert_eq!(cells("1 2 3", Some(10)), ["1", "2", "3"]);
        assert_eq!(cells(" 1,2", None), ["1", "2"]);
    }

    #[test]
    fn numbers_are_found_in_sentences() {
        assert_eq!(first_number("at  .005 sec, in").map(|x| x.0), Some(0.005));
        assert_eq!(first_number("= -267.957 CM").map(|x| x.0), Some(-267.957));
        assert_eq!(first_number("1.2E-03x").map(|x| x.0), Some(1.2e-3));
        assert_eq!(first_number("none"), None);
    }

    #[test]
    fn widths_come_from_fortran_formats() {
        for (text, w) in [("(8f10.6)", 10), ("Format= (10I8)", 8), ("(1F15.6E)", 15)] {
            assert_eq!(width(text), Some(w), "{text}");
        }
        assert_eq!(width("no format"), None);
        assert_eq!(last_digit("720.386"), 0.001);
        assert_eq!(last_digit("12"), 1.0);
    }

    #[test]
    fn what_is_no_text_is_named() {
        assert_eq!(decode(b" \n").unwrap_err(), Problem::Empty);
        assert_eq!(decode(b"PK\x03\x04...").unwrap_err(), Problem::Packed("zip"));
        assert_eq!(decode(b"a\0b").unwrap_err(), Problem::Binary);
        assert!(decode(b"Koeln \xf6").is_ok());
    }
}
