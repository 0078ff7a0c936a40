//! The cells of a text of columns, and where each stands.

use super::number::{number, with_comma};
use crate::error::Problem;

/// What stands between the cells of a row.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Separator {
    /// Blanks or tabs, any number of them.
    Blanks,
    /// One such character.
    Between(u8),
}

/// A row of cells.
#[derive(Clone, Debug)]
pub(super) struct Row {
    /// Line in the file, from 1.
    pub line: usize,
    /// What stands in the cells.
    pub cells: Vec<String>,
    /// Where the cells begin, in characters from 1.
    pub columns: Vec<usize>,
}

/// Most cells of a text.
const MOST_CELLS: usize = 16_000_000;

/// The rows that are no comments.
pub(super) fn rows(text: &str) -> Result<(Separator, Vec<Row>), Problem> {
    let separator = separator(text);
    let mut rows = Vec::new();
    let mut count = 0;
    let mut add = |row: Row| {
        count += row.cells.len();
        rows.push(row);
        if count > MOST_CELLS { Err(Problem::TooManyCells(MOST_CELLS)) } else { Ok(()) }
    };
    match separator {
        Separator::Blanks => {
            let lines = text.lines().enumerate();
            for (i, line) in lines.filter(|(_, l)| !l.trim().is_empty() && !comment(l)) {
                let cells = line.split_whitespace().map(str::to_owned).collect();
                add(Row { line: i + 1, cells, columns: words_at(line) })?;
            }
        }
        Separator::Between(separator) => {
            let mut reader = csv::ReaderBuilder::new()
                .has_headers(false)
                .flexible(true)
                .comment(Some(b'#'))
                .delimiter(separator)
                .trim(csv::Trim::All)
                .from_reader(text.as_bytes());
            let lines: Vec<&str> = text.lines().collect();
            for row in reader.records() {
                let row = row.map_err(|e| Problem::NoCsv(e.to_string()))?;
                let cells: Vec<String> = row.iter().map(str::to_owned).collect();
                if cells.first().is_some_and(|c| c.starts_with(['%', '!'])) {
                    continue;
                }
                // Comments and blank lines before a row may count as its first.
                let from = row.position().map_or(0, |p| p.line() as usize).saturating_sub(1);
                let none = lines.iter().skip(from);
                let none = none.take_while(|l| l.trim().is_empty() || l.starts_with('#')).count();
                let line = from + none;
                let columns = lines.get(line).map_or(Vec::new(), |l| cells_at(l, separator));
                add(Row { line: line + 1, cells, columns })?;
            }
        }
    }
    Ok((separator, rows))
}

fn comment(line: &str) -> bool {
    line.trim_start().starts_with(['#', '%', '!'])
}

/// What stands between the cells of the first row of numbers; without one, of the first that is no comment.
fn separator(text: &str) -> Separator {
    let rows = || text.lines().filter(|l| !l.trim().is_empty() && !comment(l));
    // The row of numbers tells more than one of words.
    let numbers = rows()
        .take(60)
        .find(|l| l.trim_start().starts_with(|c: char| c.is_ascii_digit() || "+-.".contains(c)));
    let Some(row) = numbers.or_else(|| rows().next()) else { return Separator::Blanks };
    let all = [b',', b';', b'\t'].into_iter().filter(|s| row.contains(char::from(*s)));
    let parts = |s: &u8| {
        let mut cells = row.split(char::from(*s)).map(str::trim).filter(|c| !c.is_empty());
        cells.all(|c| number(c).is_ok())
    };
    if let Some(s) = all.clone().find(parts) {
        return Separator::Between(s);
    }
    // Numbers with decimal commas: the comma parts nothing.
    let other = all.clone().find(|s| *s != b',');
    let fractions = |s: u8| row.split(char::from(s)).any(|c| with_comma(c.trim()));
    match other.filter(|s| fractions(*s)) {
        Some(s) => Separator::Between(s),
        None if row.split_whitespace().count() > 1
            && row
                .split_whitespace()
                .all(|c| number(c).is_ok() || with_comma(c.trim_end_matches(','))) =>
        {
            Separator::Blanks
        }
        None => all.map(Separator::Between).next().unwrap_or(Separator::Blanks),
    }
}

/// Where the words of a line begin, in characters from 1.
fn words_at(line: &str) -> Vec<usize> {
    let mut all = Vec::new();
    let mut blank = true;
    for (i, c) in line.chars().enumerate() {
        if blank && !c.is_whitespace() {
            all.push(i + 1);
        }
        blank = c.is_whitespace();
    }
    all
}

/// Where the cells between separators begin, in characters from 1; none stands within quotes.
fn cells_at(line: &str, separator: u8) -> Vec<usize> {
    let mut all = Vec::new();
    let (mut begins, mut quoted) = (true, false);
    for (i, c) in line.chars().enumerate() {
        if c == char::from(separator) && !quoted {
            if begins {
                all.push(i + 1);
            }
            begins = true;
            continue;
        }
        quoted ^= c == '"';
        if begins && !c.is_whitespace() {
            all.push(i + 1);
            begins = false;
        }
    }
    all
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_separator_is_what_parts_numbers() {
        for (row, s) in [
            ("0.1,0.2", Separator::Between(b',')),
            ("0.1, 0.2", Separator::Between(b',')),
            ("1;2", Separator::Between(b';')),
            ("0,1;0,2", Separator::Between(b';')),
            ("0,1\t0,2", Separator::Between(b'\t')),
            ("0,1 0,2", Separator::Blanks),
            ("0.1 0.2", Separator::Blanks),
            ("0.1,x", Separator::Between(b',')),
            ("0,1", Separator::Between(b',')),
        ] {
            assert_eq!(separator(row), s, "{row}");
        }
    }

    #[test]
    fn cells_have_their_columns() {
        assert_eq!(words_at("  0.1  µ 3"), [3, 8, 10]);
        assert_eq!(cells_at("0.1, \"a,b\",,3", b','), [1, 6, 12, 13]);
    }
}
