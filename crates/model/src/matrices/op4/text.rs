//! Formatted files: heads and counts in fields of eight characters, values in lines of a width that the head gives.

use super::super::bulk::real;
use super::super::{Entries, at_line, text};
use super::{Column, Found, Head, follows, head};
use trilith_element::FileError;

/// Lines of a file with their numbers, from 1.
struct Lines<'a> {
    all: Vec<(usize, &'a [u8])>,
    next: usize,
}

impl<'a> Lines<'a> {
    fn peek(&self) -> Option<(usize, &'a [u8])> {
        self.all.get(self.next).copied()
    }

    fn take(&mut self) -> Option<(usize, &'a [u8])> {
        let line = self.peek();
        self.next += usize::from(line.is_some());
        line
    }

    /// Number of the last line that was taken.
    fn at(&self) -> usize {
        self.next.checked_sub(1).and_then(|i| self.all.get(i)).map_or(1, |(at, _)| *at)
    }
}

type Wrong = (usize, String);

/// All matrices of a file.
pub(super) fn read(bytes: &[u8], file: &str) -> Result<Vec<Found>, FileError> {
    let told =
        bytes.split(|b| *b == b'\n').enumerate().map(|(i, line)| (i + 1, line.trim_ascii_end()));
    let mut lines = Lines { all: told.filter(|(_, l)| !l.is_empty()).collect(), next: 0 };
    let mut found = Vec::new();
    while lines.peek().is_some() {
        let one = matrix(&mut lines).map_err(|(at, message)| at_line(file, at, message))?;
        found.push(one);
    }
    if !bytes.ends_with(b"\n") && !found.is_empty() {
        let message = "the last line does not end: the file has been cut off".into();
        return Err(at_line(file, lines.at(), message));
    }
    Ok(found)
}

/// Whole numbers in fields of eight characters, as many as there are.
fn fields<const N: usize>(line: &[u8]) -> Option<[i64; N]> {
    let mut all = [0; N];
    for (i, number) in all.iter_mut().enumerate() {
        let field = line.get(8 * i..line.len().min(8 * i + 8))?;
        *number = std::str::from_utf8(field).ok()?.trim().parse().ok()?;
    }
    Some(all)
}

/// Values of a line have a point, and counts have none; the format of a head has one, behind whole numbers.
fn has_values(line: &[u8]) -> bool {
    line.contains(&b'.') && fields::<4>(line).is_none()
}

/// Characters of a value: 16 of `1P,5E16.9`.
fn width(format: &str) -> Option<usize> {
    let (_, behind) = format.rsplit_once(['E', 'e', 'D', 'd'])?;
    let (width, digits) = behind.split_once('.')?;
    let is_whole = |text: &str| !text.is_empty() && text.bytes().all(|b| b.is_ascii_digit());
    let width = width.parse().ok().filter(|w| (8..=80).contains(w))?;
    is_whole(digits.trim().trim_end_matches(')')).then_some(width)
}

fn matrix(lines: &mut Lines<'_>) -> Result<Found, Wrong> {
    let Some((at, line)) = lines.take() else { return Err((1, "the file is empty".into())) };
    let wrong = |message: String| (at, message);
    let no = || {
        let line = text(line);
        wrong(format!(
            "`{}` begins no matrix: numbers of columns and rows, form and type in eight characters each, a name and a format are wanted",
            line.trim()
        ))
    };
    let numbers: [i64; 4] = fields(line).ok_or_else(no)?;
    let name = std::str::from_utf8(line.get(32..line.len().min(40)).unwrap_or_default())
        .map_err(|_| no())?
        .trim()
        .to_owned();
    let is_name = name.starts_with(|c: char| c.is_ascii_alphabetic())
        && name.bytes().all(|b| b.is_ascii_alphanumeric());
    if !is_name {
        return Err(no());
    }
    let format = text(line.get(40..).unwrap_or_default()).trim().to_owned();
    let Some(width) = width(&format) else {
        return Err(wrong(format!(
            "`{format}` is no format of the values of matrix {name}: one such as 1P,5E16.9 is wanted"
        )));
    };
    let head = match head(numbers, &name) {
        Ok(head) => head,
        // Others of the file may be right: this one is passed over.
        Err(message) => {
            pass_over(lines, numbers[0])?;
            return Ok(Found {
                name: name.to_ascii_uppercase(),
                line: Some(at),
                matrix: Err(message),
            });
        }
    };
    let mut entries = Entries::new();
    let mut before = 0;
    loop {
        let cut = |at: usize| {
            (
                at,
                format!(
                    "matrix {} ends before its last record: the file has been cut off",
                    head.name
                ),
            )
        };
        let last = lines.at();
        let (at, line) = lines.take().ok_or_else(|| cut(last))?;
        let Some([column, row, words]) = fields::<3>(line).filter(|_| !has_values(line)) else {
            let line = text(line);
            let message = format!(
                "`{}` begins no column of matrix {}: its number, a row and a count are wanted in eight characters each",
                line.trim(),
                head.name
            );
            return Err((at, message));
        };
        follows(before, column, "column", &head.name).map_err(|message| (at, message))?;
        before = column;
        if column == head.size as i64 + 1 {
            // At least one value ends the matrix.
            if values(lines, width)?.is_empty() {
                return Err(cut(at));
            }
            break;
        }
        if column > head.size as i64 + 1 {
            let message =
                format!("matrix {} has {} columns, and no column {column}", head.name, head.size);
            return Err((at, message));
        }
        let mut own = Column { head: &head, column, entries: &mut entries };
        if row > 0 {
            let found = values(lines, width)?;
            counted(&head, column, words, found.len()).map_err(|message| (lines.at(), message))?;
            own.put(row, &found).map_err(|message| (at, message))?;
        } else {
            strings(lines, &mut own, (at, words), width)?;
        }
    }
    let name = head.name.clone();
    Ok(Found { name, line: Some(at), matrix: Ok((head.size, entries)) })
}

/// The strings of a column whose record stands in this line and counts so many words.
fn strings(
    lines: &mut Lines<'_>,
    column: &mut Column<'_>,
    (at, words): (usize, i64),
    width: usize,
) -> Result<(), Wrong> {
    let head = column.head;
    let (mut sum, mut before) = (0_i64, 0);
    while sum < words {
        let Some((at, line)) = lines.take() else {
            let message = format!(
                "column {} of matrix {} ends after {sum} of {words} words: the file has been cut off",
                column.column, head.name
            );
            return Err((lines.at(), message));
        };
        let told = match head.big {
            true => fields::<2>(line).map(|[length, row]| (row, length)),
            false => std::str::from_utf8(line)
                .ok()
                .and_then(|l| l.trim().parse::<i64>().ok())
                .map(|is| (is % 65536, is / 65536)),
        };
        let Some((row, length)) = told.filter(|(_, length)| *length > 1 && !has_values(line))
        else {
            let line = text(line);
            let wanted = if head.big { "L + 1 and its row" } else { "row + 65536 (L + 1)" };
            let message = format!(
                "`{}` begins no string of column {} of matrix {}: {wanted} is wanted",
                line.trim(),
                column.column,
                head.name
            );
            return Err((at, message));
        };
        follows(before, row, "row", &head.name).map_err(|message| (at, message))?;
        let found = values(lines, width)?;
        counted(head, column.column, length - 1, found.len())
            .map_err(|message| (lines.at(), message))?;
        column.put(row, &found).map_err(|message| (at, message))?;
        before = row + found.len() as i64 - 1;
        sum = sum.saturating_add(length + if head.big { 1 } else { 0 });
    }
    if sum > words {
        let message = format!(
            "the strings of column {} of matrix {} have {sum} words, and its record counts {words}",
            column.column, head.name
        );
        return Err((at, message));
    }
    Ok(())
}

/// The values of the lines that follow.
fn values(lines: &mut Lines<'_>, width: usize) -> Result<Vec<f64>, Wrong> {
    let mut all = Vec::new();
    while let Some((at, line)) = lines.peek().filter(|(_, line)| has_values(line)) {
        for field in line.chunks(width) {
            let told = std::str::from_utf8(field).unwrap_or("\u{fffd}").trim();
            let value = real(told).filter(|_| field.len() == width).ok_or_else(|| {
                (at, format!("`{told}` is no number of {width} characters, or has been cut off"))
            })?;
            all.push(value);
        }
        lines.next += 1;
    }
    Ok(all)
}

/// So many values are as many words as were counted, or, as some programs count, as many values.
fn counted(head: &Head, column: i64, words: i64, values: usize) -> Result<(), String> {
    if [values, head.words * values].iter().any(|n| i64::try_from(*n) == Ok(words)) {
        return Ok(());
    }
    Err(format!(
        "{values} values in column {column} of matrix {}, where {words} words are counted: the file may have been cut off",
        head.name
    ))
}

/// Goes behind a matrix of so many columns that is not read.
fn pass_over(lines: &mut Lines<'_>, columns: i64) -> Result<(), Wrong> {
    let is_end = |line: &[u8]| fields::<3>(line).is_some_and(|f| f[0] == columns.saturating_add(1));
    while let Some((_, line)) = lines.take() {
        if !has_values(line) && is_end(line) {
            while lines.peek().is_some_and(|(_, line)| has_values(line)) {
                lines.next += 1;
            }
            return Ok(());
        }
    }
    Err((lines.at(), "a matrix ends before its last record: the file has been cut off".into()))
}
