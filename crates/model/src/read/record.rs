//! Records: columns of CSV files.

use super::context::Context;
use crate::Span;
use crate::diagnostic::names_help;
use crate::tree::{Kind, Node};
use std::path::Path;

/// A column by position (from 0) or by the name in the header row.
pub(super) enum Column {
    Position(usize),
    Header(String),
}

/// A column as the file names it.
pub(super) fn column(
    c: &Context<'_>,
    node: Option<&Node>,
    name: &str,
    default: usize,
) -> Option<Column> {
    match node.map(|n| (&n.kind, n)) {
        None => Some(Column::Position(default)),
        Some((Kind::Text(header), _)) => Some(Column::Header(header.clone())),
        Some((_, node)) => c.count(node, name, 0).map(Column::Position),
    }
}

/// A CSV file: comma-separated, `#` comments, a header row or none.
pub(super) struct Record {
    shown: String,
    header: Option<Vec<String>>,
    /// Line in the file, and its cells.
    rows: Vec<(u64, Vec<String>)>,
}

impl Record {
    /// Reads a file; errors are told at `at` in the model.
    pub fn read(c: &Context<'_>, path: &Path, skip: usize, at: &Span) -> Option<Self> {
        let shown = path.display().to_string();
        let bytes = match std::fs::read(path) {
            Ok(bytes) => bytes,
            Err(error) => {
                let message = format!("the record {shown} cannot be read: {error}");
                let d = c.diagnostic("E0117", message, at.clone());
                c.report(d.help("the path counts from the folder of the model file"));
                return None;
            }
        };
        let body = bytes.strip_prefix(b"\xef\xbb\xbf").unwrap_or(&bytes);
        let mut reader = csv::ReaderBuilder::new()
            .has_headers(false)
            .flexible(true)
            .comment(Some(b'#'))
            .trim(csv::Trim::All)
            .from_reader(body);
        let mut rows = Vec::new();
        for record in reader.records() {
            match record {
                Ok(r) => {
                    let line = r.position().map_or(0, csv::Position::line);
                    rows.push((line, r.iter().map(str::to_owned).collect::<Vec<_>>()));
                }
                Err(error) => {
                    let message = format!("the record {shown} is no CSV: {error}");
                    c.report(c.diagnostic("E0117", message, at.clone()));
                    return None;
                }
            }
        }
        rows.drain(..skip.min(rows.len()));
        // A first row without any number names the columns.
        let named = rows.first().is_some_and(|(_, r)| r.iter().all(|x| x.parse::<f64>().is_err()));
        let header = named.then(|| rows.remove(0).1);
        Some(Self { shown, header, rows })
    }

    /// The numbers of a column.
    pub fn numbers(&self, c: &Context<'_>, column: &Column, at: &Span) -> Option<Vec<f64>> {
        let fail = |message: String, help: Option<String>| {
            let mut d = c.diagnostic("E0117", message, at.clone());
            d.help = help;
            c.report(d);
            None
        };
        let k = match (column, &self.header) {
            (Column::Position(k), _) => *k,
            (Column::Header(name), Some(header)) => match header.iter().position(|h| h == name) {
                Some(k) => k,
                None => {
                    let all = header.iter().map(String::as_str);
                    let help = names_help(name, "columns", all);
                    return fail(format!("{} has no column `{name}`", self.shown), Some(help));
                }
            },
            (Column::Header(name), None) => {
                let message = format!("{} has no header row, so no column `{name}`", self.shown);
                return fail(message, Some("give the position of the column, from 0".into()));
            }
        };
        let mut numbers = Vec::with_capacity(self.rows.len());
        for (line, row) in &self.rows {
            let Some(cell) = row.get(k) else {
                let message = format!(
                    "{}:{line}: there is no column {k}, the row has {}",
                    self.shown,
                    row.len()
                );
                return fail(message, Some("columns count from 0".into()));
            };
            match cell.parse::<f64>() {
                Ok(x) if x.is_finite() => numbers.push(x),
                _ => {
                    let message = format!("{}:{line}: `{cell}` is no finite number", self.shown);
                    return fail(message, None);
                }
            }
        }
        Some(numbers)
    }

    /// The place of a row, `file:line`.
    pub fn place(&self, row: usize) -> String {
        let line = self.rows.get(row).map_or(0, |(line, _)| *line);
        format!("{}:{line}", self.shown)
    }
}
