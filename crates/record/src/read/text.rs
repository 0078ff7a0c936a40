//! Lines, words and fixed columns of a text.

use super::number::{first_number, like_number, number, words};
use crate::MOST_SAMPLES;
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
        ReadError { file: self.file.clone(), line: line.map(|i| i + 1), column: None, problem }
    }

    /// An error at a cell of a line (index from 0).
    pub fn fail_at(&self, line: usize, cell: &str, problem: Problem) -> ReadError {
        let column = self.lines.get(line).and_then(|l| column(l, cell));
        ReadError { column, ..self.fail(Some(line), problem) }
    }

    /// Index of the first line at or behind `from` that holds the words, whatever their case.
    pub fn find(&self, from: usize, words: &str) -> Option<usize> {
        let words = words.to_lowercase();
        let lines = self.lines.iter().enumerate().skip(from);
        lines.map(|(i, l)| (i, l.to_lowercase())).find(|(_, l)| l.contains(&words)).map(|(i, _)| i)
    }

    /// A number of the header.
    pub fn header(&self, line: usize, text: &str, what: &'static str) -> Result<f64, ReadError> {
        let text = text.trim();
        number(text).map_err(|problem| {
            let problem = match problem {
                Problem::NotANumber(text) => Problem::Header { text, what },
                other => other,
            };
            self.fail_at(line, text, problem)
        })
    }

    /// The first number of a part of a line, and what stands behind it.
    pub fn first_number<'r>(
        &self,
        line: usize,
        part: &'r str,
    ) -> Result<Option<(f64, &'r str)>, ReadError> {
        first_number(part).map_err(|problem| self.fail(Some(line), problem))
    }

    /// A count of the header.
    pub fn count(&self, line: usize, text: &str, what: &'static str) -> Result<usize, ReadError> {
        let text = text.trim();
        text.parse()
            .map_err(|_| self.fail_at(line, text, Problem::Header { text: text.to_owned(), what }))
    }

    /// `count` numbers from line `from` on, no fewer and no more, and the index of the line behind them. Line
    /// `stated` says how many. A line that `ends` says so of ends the block, and so does one of words behind
    /// the last number.
    pub fn numbers(
        &self,
        stated: usize,
        from: usize,
        count: usize,
        width: Option<usize>,
        ends: impl Fn(&str) -> bool,
    ) -> Result<(Vec<f64>, usize), ReadError> {
        if count > MOST_SAMPLES {
            return Err(self.fail(Some(stated), Problem::TooLong));
        }
        let mut all = Vec::with_capacity(count);
        let mut at = from;
        while all.len() < count {
            let Some(line) = self.lines.get(at).filter(|l| !ends(l)) else {
                let problem = Problem::Truncated { stated: count, found: all.len() };
                return Err(self.fail(Some(at.saturating_sub(1)), problem));
            };
            for cell in cells(line, width) {
                all.push(number(cell).map_err(|problem| self.fail_at(at, cell, problem))?);
            }
            at += 1;
        }
        // What is too much is counted to its end.
        let mut found = all.len();
        while let Some(line) = self.lines.get(at).filter(|l| !ends(l)) {
            let cells = cells(line, width);
            // Fields that touch each other are no words.
            if cells.first().is_some_and(|cell| !like_number(cell)) {
                break;
            }
            found += cells.len();
            at += 1;
        }
        if found > count {
            let problem = Problem::TooMany { stated: count, found };
            return Err(self.fail(Some(stated), problem));
        }
        Ok((all, at))
    }
}

/// True for a line that begins with a number, or with what is one but for its commas.
pub(super) fn numeric(line: &str) -> bool {
    words(line).first().is_some_and(|w| like_number(w))
}

/// Where a cell of a line begins, in characters from 1; `None` for a text that is no part of the line.
fn column(line: &str, cell: &str) -> Option<usize> {
    let at = (cell.as_ptr() as usize).checked_sub(line.as_ptr() as usize)?;
    line.get(at..at.checked_add(cell.len())?)?;
    line.get(..at).map(|before| before.chars().count() + 1)
}

/// The cells of a line: fields of a width where they fit, words otherwise. Fields of a fixed width may touch
/// each other.
fn cells(line: &str, width: Option<usize>) -> Vec<&str> {
    let Some(width) = width.filter(|_| line.is_ascii()) else { return words(line) };
    let whole = line.trim_end();
    let fields: Vec<&str> = (0..whole.len().div_ceil(width))
        .map(|i| whole[i * width..((i + 1) * width).min(whole.len())].trim())
        .filter(|f| !f.is_empty())
        .collect();
    if fields.iter().all(|f| number(f).is_ok()) { fields } else { words(line) }
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
        assert_eq!(cells(" 1.,2.", None), ["1.", "2."]);
        assert_eq!(cells("   0,12345   0,23456", Some(10)), ["0,12345", "0,23456"]);
    }

    #[test]
    fn a_cell_has_its_column() {
        let line = " µ  0.5 x";
        assert_eq!(column(line, &line[5..8]), Some(5));
        assert_eq!(column(line, "elsewhere"), None);
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
