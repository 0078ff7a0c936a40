//! Matrix Market: a heading, comments, the size, and a line for each entry.
//!
//! R. F. Boisvert, R. Pozo, K. A. Remington, "The Matrix Market exchange formats: initial design", NISTIR 5935, 1996.

use super::{Entries, at_line, is_symmetric, square, text, triplet};
use std::fmt::Write;
use trilith_element::{FileError, SparseMatrix};

/// Characters of the shortest line of an entry, such as `1 1 0`.
const SHORTEST: usize = 6;

/// Rows and entries.
pub(super) fn read(bytes: &[u8], name: &str) -> Result<(usize, Entries), FileError> {
    let wrong = |line: usize, message: String| at_line(name, line, message);
    let mut lines = bytes.split(|b| *b == b'\n').enumerate().map(|(i, line)| (i + 1, line));
    let heading = lines.next().map_or(&b""[..], |(_, line)| line);
    let symmetric = heading_of(&text(heading)).map_err(|message| wrong(1, message))?;
    let is_blank = |line: &[u8]| line.trim_ascii().is_empty();
    let mut lines = lines.filter(|(_, line)| !line.starts_with(b"%") && !is_blank(line));
    let Some((at, line)) = lines.next() else {
        return Err(wrong(1, "no line with the size follows: the file is cut off".into()));
    };
    let size: Vec<Option<usize>> =
        text(line).split_ascii_whitespace().map(|w| w.parse().ok()).collect();
    let [Some(rows), Some(columns), Some(count)] = size[..] else {
        let message = format!(
            "`{}` is no size: rows, columns and number of entries are wanted",
            text(line).trim()
        );
        return Err(wrong(at, message));
    };
    let n = square(rows, columns).map_err(|message| wrong(at, message))?;
    let most = bytes.len() / SHORTEST + 1;
    let mut entries = Vec::with_capacity(count.min(most) * if symmetric { 2 } else { 1 });
    let (mut found, mut last) = (0, at);
    for (at, line) in lines {
        if found == count {
            let message = format!("more than the {count} entries that the size names");
            return Err(wrong(at, message));
        }
        let (i, j, value) = entry(line, n).map_err(|message| wrong(at, message))?;
        if symmetric && j > i {
            let message = format!(
                "entry ({}, {}) lies above the diagonal: a symmetric file holds the lower triangle",
                i + 1,
                j + 1
            );
            return Err(wrong(at, message));
        }
        entries.push((i, j, value));
        if symmetric && i != j {
            entries.push((j, i, value));
        }
        (found, last) = (found + 1, at);
    }
    if found < count {
        let message =
            format!("the file ends after {found} of {count} entries: it has been cut off");
        return Err(wrong(last, message));
    }
    Ok((n, entries))
}

/// True where only the lower triangle is given.
fn heading_of(line: &str) -> Result<bool, String> {
    let words: Vec<String> = line.split_ascii_whitespace().map(str::to_ascii_lowercase).collect();
    let words: Vec<&str> = words.iter().map(String::as_str).collect();
    let wanted = "`%%MatrixMarket matrix coordinate real symmetric` (or `general`) is wanted";
    match words[..] {
        ["%%matrixmarket", "matrix", "coordinate", "real" | "integer" | "double", symmetry] => {
            match symmetry {
                "symmetric" => Ok(true),
                "general" => Ok(false),
                other => {
                    Err(format!("a matrix that is `{other}` is none of a structure: {wanted}"))
                }
            }
        }
        ["%%matrixmarket", "matrix", "array", ..] => Err(format!(
            "the matrix is dense: {wanted}; `scipy.sparse.coo_matrix` before writing makes it so"
        )),
        ["%%matrixmarket", "matrix", "coordinate", field, ..] => {
            Err(format!("entries that are `{field}` are no stiffness, mass or damping: {wanted}"))
        }
        _ => Err(format!(
            "this is none of Matrix Market, `.npz`, CalculiX and DMIG: a first line {wanted}"
        )),
    }
}

/// Row and column from 0, and value.
fn entry(line: &[u8], n: usize) -> Result<(u32, u32, f64), String> {
    let (i, j, value) = triplet(line)?;
    let place = |at: usize, what: &str| match at {
        at if (1..=n).contains(&at) => Ok(at as u32 - 1),
        _ => Err(format!("there is no {what} {at}: the matrix has {n}, counted from 1")),
    };
    Ok((place(i, "row")?, place(j, "column")?, value))
}

pub(super) fn write(a: &SparseMatrix) -> String {
    let symmetric = is_symmetric(a);
    let kept = || a.entries.iter().filter(|(i, j, _)| !symmetric || j <= i);
    let symmetry = if symmetric { "symmetric" } else { "general" };
    let mut text = format!("%%MatrixMarket matrix coordinate real {symmetry}\n");
    // Writing to a String cannot fail.
    let _ = writeln!(text, "{} {} {}", a.size, a.size, kept().count());
    for (i, j, v) in kept() {
        let _ = writeln!(text, "{} {} {v:e}", i + 1, j + 1);
    }
    text
}
