//! Matrices of Nastran's module OUTPUT4, formatted or not: column by column, by strings of values.
//!
//! ```text
//!   NCOL NROW FORM TYPE NAME      a matrix: form 6 symmetric, 1 and 2 square; type 1, 2 real (single, double precision)
//!   ICOL IROW NW                  a column of NW words from row IROW on; IROW = 0: in strings
//!     IS                            string: L words from row I on, IS = I + 65536 (L + 1)
//!     L+1 I                         the same where NROW is negative (BIGMAT)
//!   NCOL+1 …                      the end, with at least one value
//! ```
//!
//! Columns without entries are left out. A value of double precision has two words; some programs count values
//! instead in formatted files. Unformatted ones are Fortran's: each record between two copies of its length in bytes.
//!
//! Siemens, "NX Nastran DMAP Programmer's Guide", 2007: module OUTPUT4, remarks 1 to 3.

mod binary;
#[cfg(test)]
mod tests;
mod text;

use super::{Entries, parted, square, whole};
use std::fmt::Write;
use trilith_element::{FileError, SparseMatrix};

/// What begins a matrix.
#[derive(Clone, Debug)]
struct Head {
    name: String,
    size: usize,
    /// Words of a value.
    words: usize,
    big: bool,
}

/// What a head says: columns, rows, form, type, name. None for a matrix that is none of a structure, with the reason.
fn head([columns, rows, form, kind]: [i64; 4], name: &str) -> Result<Head, String> {
    let own = name.trim().to_ascii_uppercase();
    if !matches!(form, 1 | 2 | 6) {
        return Err(format!(
            "the form of matrix {own} is {form}: must be 6 (symmetric), 1 or 2 (square, rectangular)"
        ));
    }
    let words = match kind {
        1 => 1,
        2 => 2,
        3 | 4 => {
            return Err(format!(
                "matrix {own} is complex (type {kind}), and no stiffness, mass or damping: a real one is wanted, type 1 or 2"
            ));
        }
        other => return Err(format!("the type of matrix {own} is {other}: must be 1 or 2")),
    };
    let count = |n: i64| usize::try_from(n).map_err(|_| format!("matrix {own} has {n} columns"));
    let size = square(count(rows.saturating_abs())?, count(columns)?)
        .map_err(|message| format!("{own}: {message}"))?;
    Ok(Head { name: own, size, words, big: rows < 0 })
}

/// A matrix of the file, or why it is none of a structure.
struct Found {
    name: String,
    /// Line of its head; none in a file without lines.
    line: Option<usize>,
    matrix: Result<(usize, Entries), String>,
}

/// Rows and entries of one matrix of the file; of the only square one where none is named.
pub(super) fn read(
    bytes: &[u8],
    file: &str,
    which: Option<&str>,
) -> Result<(usize, Entries), FileError> {
    let all = match binary::order(bytes) {
        Some(order) => binary::read(bytes, order).map_err(|message| whole(file, message))?,
        None => text::read(bytes, file)?,
    };
    let names = || all.iter().map(|m| m.name.as_str()).collect::<Vec<_>>().join(", ");
    let mut found: Vec<&Found> = match which {
        Some(which) => all.iter().filter(|m| m.name.eq_ignore_ascii_case(which)).collect(),
        None => all.iter().filter(|m| m.matrix.is_ok()).collect(),
    };
    if found.is_empty() && which.is_none() {
        found = all.iter().collect();
    }
    match (&found[..], which) {
        ([one], _) => one.matrix.clone().map_err(|message| FileError {
            file: file.to_owned(),
            line: one.line,
            message,
        }),
        ([], Some(which)) => {
            Err(whole(file, format!("there is no matrix `{which}`: the file has {}", names())))
        }
        ([], None) => Err(whole(file, "no matrix begins in the file".into())),
        ([first, ..], Some(_)) => {
            Err(whole(file, format!("the file has several matrices {}", first.name)))
        }
        ([first, ..], None) => Err(whole(
            file,
            format!(
                "the file has the matrices {}: name one of them, as in `{file}:{}`",
                names(),
                first.name
            ),
        )),
    }
}

/// Values of one column on their way to the entries.
struct Column<'a> {
    head: &'a Head,
    /// From 1.
    column: i64,
    entries: &'a mut Entries,
}

impl Column<'_> {
    /// Values from a row on, from 1.
    fn put(&mut self, row: i64, values: &[f64]) -> Result<(), String> {
        let (size, name) = (self.head.size as i64, &self.head.name);
        let last = row.saturating_add(values.len() as i64 - 1);
        if row < 1 || last > size {
            return Err(format!(
                "rows {row} to {last} in column {} of matrix {name}, which has {size}",
                self.column
            ));
        }
        for (i, value) in values.iter().enumerate() {
            if !value.is_finite() {
                return Err(format!(
                    "{value} in row {}, column {} of matrix {name}: must be a finite number",
                    row + i as i64,
                    self.column
                ));
            }
            if *value != 0.0 {
                self.entries.push((row as u32 - 1 + i as u32, self.column as u32 - 1, *value));
            }
        }
        Ok(())
    }
}

/// Columns rise, and so do the rows in them: nothing is given twice.
fn follows(before: i64, next: i64, what: &str, name: &str) -> Result<(), String> {
    if next > before {
        return Ok(());
    }
    Err(format!("{what} {next} of matrix {name} comes after {what} {before}: must rise"))
}

/// A formatted file of double precision, in columns from their first entry to their last.
pub(super) fn write(a: &SparseMatrix) -> String {
    let own = parted(&a.name).1.unwrap_or("A");
    let form = if super::is_symmetric(a) { 6 } else { 1 };
    let mut columns: Vec<Vec<(u32, f64)>> = vec![Vec::new(); a.size];
    a.entries.iter().for_each(|(i, j, v)| columns[*j as usize].push((*i, *v)));
    // Writing to a String cannot fail.
    let mut text = String::new();
    let _ = writeln!(text, "{:8}{:8}{form:8}{:8}{own:8}1P,3E24.16", a.size, a.size, 2);
    let number = |x: f64| {
        let digits = format!("{x:.16E}");
        let (mantissa, exponent) = digits.split_once('E').unwrap_or((&digits, "0"));
        let exponent: i32 = exponent.parse().unwrap_or_default();
        format!("{:>24}", format!("{mantissa}E{exponent:+03}"))
    };
    for (j, column) in columns.iter().enumerate() {
        let [Some((first, _)), Some((last, _))] = [column.first(), column.last()] else { continue };
        let mut values = vec![0.0; (last - first + 1) as usize];
        column.iter().for_each(|(i, v)| values[(i - first) as usize] = *v);
        let _ = writeln!(text, "{:8}{:8}{:8}", j + 1, first + 1, 2 * values.len());
        for three in values.chunks(3) {
            let _ = writeln!(text, "{}", three.iter().map(|x| number(*x)).collect::<String>());
        }
    }
    let _ = writeln!(text, "{:8}{:8}{:8}\n{}", a.size + 1, 1, 2, number(1.0));
    text
}
