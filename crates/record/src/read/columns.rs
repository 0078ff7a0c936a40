//! Columns of numbers: CSV, or separated by semicolons, tabs or blanks; `#`, `%` and `!` begin comments.

use super::cells::{Row, Separator, rows};
use super::number::{decimal_comma, first_number, like_number, number};
use super::text::{Text, last_digit};
use super::{ReadOptions, of_file, step, unit};
use crate::error::{Problem, ReadError};
use crate::unit::time_unit;
use crate::{Direction, MOST_SAMPLES, Record, acceleration_unit};
use std::path::Path;

/// A column by position (from 0) or by its name in the header row.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Column {
    /// From 0.
    Position(usize),
    /// The name in the header row, with or without the unit in brackets behind it.
    Header(String),
}

/// A file of columns.
#[derive(Clone, Debug)]
pub struct Columns {
    file: String,
    header: Option<Vec<String>>,
    separator: Separator,
    rows: Vec<Row>,
}

impl Columns {
    /// Reads a file and leaves out the first `skip` rows that are no comments.
    ///
    /// # Errors
    /// [`ReadError`] for a file that cannot be read, is empty, packed or binary, has more than [`MOST_SAMPLES`]
    /// rows, or whose quotes do not close, and for commas that are decimal ones between commas that part cells.
    pub fn read(path: impl AsRef<Path>, skip: usize) -> Result<Self, ReadError> {
        let file = path.as_ref().display().to_string();
        match crate::file::read(path) {
            Ok(bytes) => Self::parse(&bytes, file, skip),
            Err(e) => Err(of_file(file, Problem::Unreadable(e.to_string()))),
        }
    }

    fn parse(bytes: &[u8], file: String, skip: usize) -> Result<Self, ReadError> {
        let fail = |problem| of_file(file.clone(), problem);
        let text = super::text::decode(bytes).map_err(fail)?;
        let (separator, mut rows) = rows(&text).map_err(fail)?;
        rows.drain(..skip.min(rows.len()));
        // Rows without any number before the first with one: the last of them names the columns.
        let word = |r: &Row| !r.cells.iter().any(|x| like_number(x));
        let words = rows.iter().take_while(|r| word(r)).count();
        let words = if words == rows.len() { words.min(1) } else { words };
        let mut names = rows.drain(..words).map(|r| r.cells).collect::<Vec<_>>();
        let width = rows.first().map_or(0, |r| r.cells.len());
        let header = names.pop().map(|n| joined_units(n, width));
        if rows.len() > MOST_SAMPLES {
            return Err(fail(Problem::TooLong));
        }
        let columns = Self { file, header, separator, rows };
        columns.check_commas()?;
        Ok(columns)
    }

    /// Commas may part cells or stand for decimal points, not both.
    fn check_commas(&self) -> Result<(), ReadError> {
        if self.separator != Separator::Between(b',') {
            return Ok(());
        }
        let names = self.header.as_ref().map(Vec::len);
        let shown = |row: &Row| decimal_comma(&row.cells, names).map(|k| self.comma_at(row, k));
        self.rows.iter().find_map(shown).map_or(Ok(()), Err)
    }

    /// A comma behind a cell (from 0) that is a decimal one.
    fn comma_at(&self, row: &Row, k: usize) -> ReadError {
        let problem = Problem::DecimalComma(
            row.cells[k..].iter().take(2).cloned().collect::<Vec<_>>().join(","),
        );
        self.fail_at(row, k, problem)
    }

    /// An error at a cell (from 0) of a row.
    fn fail_at(&self, row: &Row, k: usize, problem: Problem) -> ReadError {
        let column = row.columns.get(k).copied();
        ReadError { file: self.file.clone(), line: Some(row.line), column, problem }
    }

    /// Number of rows of numbers.
    #[must_use]
    pub fn len(&self) -> usize {
        self.rows.len()
    }

    /// True where there is no row of numbers.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.rows.is_empty()
    }

    /// The numbers of a column.
    ///
    /// # Errors
    /// [`ReadError`] where there is no such column, a row is too short, or a cell is no finite number.
    pub fn numbers(&self, column: &Column) -> Result<Vec<f64>, ReadError> {
        let k = self.position(column)?;
        self.rows.iter().map(|row| self.cell_number(row, k)).collect()
    }

    fn cell_number(&self, row: &Row, k: usize) -> Result<f64, ReadError> {
        let cells = row.cells.len();
        let cell = row.cells.get(k).ok_or(Problem::ShortRow { column: k, cells });
        cell.and_then(|cell| number(cell)).map_err(|problem| self.fail_at(row, k, problem))
    }

    /// The unit of acceleration in brackets behind the name of a column, m/s².
    #[must_use]
    pub fn unit(&self, column: usize) -> Option<f64> {
        split_unit(self.header.as_ref()?.get(column)?).1.and_then(acceleration_unit)
    }

    /// The place of a row (from 0), `file:line`.
    #[must_use]
    pub fn place(&self, row: usize) -> String {
        format!("{}:{}", self.file, self.rows.get(row).map_or(0, |r| r.line))
    }

    fn position(&self, column: &Column) -> Result<usize, ReadError> {
        let fail = |problem| Err(of_file(self.file.clone(), problem));
        match (column, &self.header) {
            (Column::Position(k), _) => Ok(*k),
            (Column::Header(name), Some(header)) => {
                let exact = header.iter().position(|h| h == name);
                match exact.or_else(|| header.iter().position(|h| split_unit(h).0 == name)) {
                    Some(k) => Ok(k),
                    None => fail(Problem::UnknownColumn { name: name.clone(), all: self.names() }),
                }
            }
            (Column::Header(name), None) => fail(Problem::NoHeaderRow(name.clone())),
        }
    }

    /// The names of the columns; none of a file without any number, which is not one of columns.
    fn names(&self) -> Vec<String> {
        let has_number = |r: &Row| r.cells.iter().any(|cell| number(cell).is_ok());
        if !self.rows.iter().any(has_number) {
            return Vec::new();
        }
        self.header.clone().unwrap_or_default()
    }

    fn cell(&self, row: usize, column: usize) -> &str {
        self.rows.get(row).and_then(|r| r.cells.get(column)).map_or("", String::as_str)
    }
}

/// `t [s] a [g]` split at blanks: units go to the names before them.
fn joined_units(names: Vec<String>, width: usize) -> Vec<String> {
    if names.len() <= width {
        return names;
    }
    let mut joined: Vec<String> = Vec::new();
    for name in &names {
        match joined.last_mut() {
            Some(last) if name.starts_with(['[', '(']) => *last = format!("{last} {name}"),
            _ => joined.push(name.clone()),
        }
    }
    joined
}

/// `north [g]` → (`north`, `g`).
fn split_unit(name: &str) -> (&str, Option<&str>) {
    let brackets = [('[', ']'), ('(', ')')];
    let found = brackets.iter().find_map(|(open, close)| {
        let at = name.find(*open)?;
        let unit = name[at + 1..].strip_suffix(*close)?;
        Some((name[..at].trim(), Some(unit.trim())))
    });
    found.unwrap_or((name, None))
}

pub(super) fn read(
    bytes: &[u8],
    text: &Text<'_>,
    options: &ReadOptions,
) -> Result<Vec<Record>, ReadError> {
    let columns = Columns::parse(bytes, text.file.clone(), 0)?;
    if columns.is_empty() {
        return Err(text.fail(None, Problem::TooShort(0)));
    }
    let (said_unit, unit_line) = statement(text, &["units", "unit"], |rest| {
        let word = rest.split([',', ';']).next().unwrap_or_default();
        Ok(acceleration_unit(word).or_else(|| acceleration_unit(word.split(' ').next()?)))
    })?;
    let (said_step, step_line) = statement(text, &["dt", "time step", "delta t"], |rest| {
        let Some((x, unit)) = first_number(rest)? else { return Ok(None) };
        let unit = unit.trim_start().split([' ', ',', ';', ')']).next().unwrap_or_default();
        Ok(Some(x * time_unit(unit).unwrap_or(1.0)))
    })?;
    let width = columns.rows.iter().map(|r| r.cells.len()).max().unwrap_or(1);
    let header = columns.header.clone().unwrap_or_default();
    let unit_of = |k: usize| -> Result<f64, ReadError> {
        let named = match header.get(k).and_then(|h| split_unit(h).1) {
            Some(word) => match acceleration_unit(word) {
                Some(unit) => Some(unit),
                None => return Err(text.fail(None, Problem::UnknownUnit(word.into()))),
            },
            None => None,
        };
        unit(text, unit_line, named.or(said_unit), options.unit)
    };
    let name = |k: usize| match header.get(k) {
        Some(h) => split_unit(h).0.to_owned(),
        None => format!("column {}", k + 1),
    };
    let make = |values: Vec<f64>, k: usize, dt: f64| -> Result<Record, ReadError> {
        let unit = unit_of(k)?;
        let mut record = Record::new(values.into_iter().map(|a| a * unit).collect(), dt);
        record.component = name(k);
        record.direction = Direction::from_name(&record.component);
        Ok(record)
    };
    if width == 1 {
        let values = columns.numbers(&Column::Position(0))?;
        let dt = step(text, step_line, said_step, options.dt)?;
        return Ok(vec![make(values, 0, dt)?]);
    }
    let times = columns.numbers(&Column::Position(0))?;
    let rises = times.windows(2).all(|w| w[1] > w[0]);
    let falls = times.windows(2).any(|w| w[1] < w[0]);
    let untimed = said_step.is_some() || options.dt.is_some();
    if !rises && falls && untimed && columns.header.is_none() {
        // Values row after row, as in old catalogues. Pairs of digits may as well be numbers with decimal
        // commas, one in a row.
        let whole = |r: &Row| r.cells.len() == 2 && decimal_comma(&r.cells, Some(1)).is_some();
        if columns.separator == Separator::Between(b',') && columns.rows.iter().all(whole) {
            return Err(columns.comma_at(&columns.rows[0], 0));
        }
        let mut values = Vec::new();
        for row in &columns.rows {
            for k in 0..row.cells.len() {
                values.push(columns.cell_number(row, k)?);
            }
        }
        let dt = step(text, step_line, said_step, options.dt)?;
        return Ok(vec![make(values, 0, dt)?]);
    }
    let seconds = header.first().and_then(|h| split_unit(h).1).and_then(time_unit).unwrap_or(1.0);
    let times: Vec<f64> = times.iter().map(|t| t * seconds).collect();
    let found = even_step(&columns, text, &times, seconds)?;
    let dt = step(text, step_line, Some(found), options.dt.or(said_step))?;
    let mut records = Vec::new();
    for k in 1..width {
        records.push(make(columns.numbers(&Column::Position(k))?, k, dt)?);
    }
    if times[0] != 0.0 {
        let note = format!("times count from the first sample at {} s", times[0]);
        records.iter_mut().for_each(|r| r.notes.push(note.clone()));
    }
    Ok(records)
}

/// What a comment or a line of words says behind a key: `# unit: g`, `dt = 0.01 s`.
fn statement(
    text: &Text<'_>,
    keys: &[&str],
    value: impl Fn(&str) -> Result<Option<f64>, Problem>,
) -> Result<(Option<f64>, Option<usize>), ReadError> {
    for (i, line) in text.lines.iter().enumerate().take(60) {
        if line.trim_start().starts_with(|c: char| c.is_ascii_digit()) {
            break;
        }
        let lower = line.to_lowercase();
        for key in keys {
            let Some(at) = lower.find(key) else { continue };
            let rest = lower[at + key.len()..].trim_start();
            let Some(rest) = rest.strip_prefix([':', '=']) else { continue };
            let said = value(rest.trim()).map_err(|problem| text.fail(Some(i), problem))?;
            if let Some(x) = said {
                return Ok((Some(x), Some(i)));
            }
        }
    }
    Ok((None, None))
}

/// The step of evenly spaced times; how far one may be off follows from the digits it is written with.
fn even_step(
    columns: &Columns,
    text: &Text<'_>,
    times: &[f64],
    seconds: f64,
) -> Result<f64, ReadError> {
    let n = times.len();
    if n < 2 {
        return Err(text.fail(None, Problem::TooShort(n)));
    }
    let line = |i: usize| columns.rows.get(i).map(|r| r.line - 1);
    if let Some(i) = (1..n).find(|&i| times[i] <= times[i - 1]) {
        let problem = Problem::Order { time: times[i], before: times[i - 1] };
        return Err(text.fail(line(i), problem));
    }
    let dt = (times[n - 1] - times[0]) / (n - 1) as f64;
    let digit =
        seconds * (0..n.min(50)).map(|i| last_digit(columns.cell(i, 0))).fold(1.0, f64::min);
    let off = (1e-3 * dt).max((1.1 * digit).min(0.2 * dt));
    let even = |i: usize| (times[i] - times[0] - i as f64 * dt).abs() <= off;
    if !(1..n).all(even) {
        // The first step that differs from the first.
        let first = times[1] - times[0];
        let bad = (2..n).find(|&i| (times[i] - times[i - 1] - first).abs() > off.max(1e-3 * first));
        let i = bad.unwrap_or(1);
        let problem = Problem::Uneven {
            found: round(times[i] - times[i - 1]),
            time: times[i],
            step: round(first),
        };
        return Err(text.fail(line(i), problem));
    }
    Ok(round(dt))
}

/// Ten significant digits: what differences of decimal numbers leave behind goes away.
fn round(x: f64) -> f64 {
    format!("{x:.9e}").parse().unwrap_or(x)
}
