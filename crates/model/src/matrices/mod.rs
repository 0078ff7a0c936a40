//! Sparse matrices of files, as other programs write them.
//!
//! | file | form |
//! |---|---|
//! | `.mtx` | Matrix Market, coordinates, real or integer, symmetric or general |
//! | `.npz` | `scipy.sparse.save_npz`: CSR, CSC or COO, compressed or not |
//! | `.sti`, `.mas` | `SOLVER=MATRIXSTORAGE` of CalculiX: one triangle, line by line |
//! | `.pch` | `DMIG` entries of Nastran, which say what their rows are; `wall.pch:KAAX` where there are several matrices |
//! | `.op4` | OUTPUT4 of Nastran, formatted or not; `wall.op4:KAA` where there are several matrices |
//!
//! What a file is, it says itself or its name does: an archive begins with `PK`, Matrix Market with `%%`.

mod bulk;
mod calculix;
mod dmig;
mod market;
mod npy;
mod npz;
mod op4;

use crate::model::sha256;
use std::borrow::Cow;
use trilith_element::{FileError, SparseMatrix};

/// Rows of the largest matrix that is read.
const MOST_ROWS: usize = 10_000_000;

/// Row and column, from 0, and value.
type Entries = Vec<(u32, u32, f64)>;

/// Reads a square matrix of a file of any of these forms; `name` is that of the file, with that of a matrix in it behind a
/// colon where it holds several.
///
/// ```
/// let text = b"%%MatrixMarket matrix coordinate real symmetric\n2 2 2\n1 1 3\n2 1 -1\n";
/// assert_eq!(trilith_model::read_matrix(text, "k.mtx").expect("a matrix").entries.len(), 3);
/// ```
///
/// # Errors
/// What is wrong with it, with its line where it has lines.
pub fn read_matrix(bytes: &[u8], name: &str) -> Result<SparseMatrix, FileError> {
    read(bytes, name, "")
}

/// Reads a square matrix; `name` is that of the file as the model has it, with that of a matrix in it behind a colon where
/// the model gives one; `path` is where the file was found, empty for none.
///
/// # Errors
/// What is wrong with it, with its line where it has lines.
pub(crate) fn read(bytes: &[u8], name: &str, path: &str) -> Result<SparseMatrix, FileError> {
    let (file, which) = parted(name);
    let form = Form::of(bytes, file);
    if let (Some(which), false) = (which, matches!(form, Form::Dmig | Form::Op4)) {
        let message = format!("its matrix has no name: leave out `:{which}`");
        return Err(whole(file, message));
    }
    let mut rows = Vec::new();
    let (size, mut entries) = match form {
        Form::Npz => npz::read(bytes).map_err(|message| whole(file, message))?,
        Form::Market => market::read(bytes, file)?,
        Form::Calculix => calculix::read(bytes, file)?,
        Form::Op4 => op4::read(bytes, file, which)?,
        Form::Dmig => {
            let read = dmig::read(bytes, file, which)?;
            rows = read.0;
            (rows.len(), read.1)
        }
    };
    settle(&mut entries);
    let path = match which {
        Some(which) if !path.is_empty() => format!("{path}:{which}"),
        _ => path.to_owned(),
    };
    Ok(SparseMatrix { name: name.to_owned(), path, sha256: sha256(bytes), size, entries, rows })
}

/// The name of a file, and behind a colon that of a matrix in it: a letter and at most seven letters or digits more.
pub(crate) fn parted(name: &str) -> (&str, Option<&str>) {
    let is_name = |which: &str| {
        which.len() <= 8
            && which.starts_with(|c: char| c.is_ascii_alphabetic())
            && which.bytes().all(|b| b.is_ascii_alphanumeric())
    };
    match name.rsplit_once(':') {
        Some((file, which)) if !file.is_empty() && is_name(which) => (file, Some(which)),
        _ => (name, None),
    }
}

#[derive(Clone, Copy, PartialEq, Eq)]
enum Form {
    Npz,
    Market,
    Calculix,
    Dmig,
    Op4,
}

impl Form {
    fn of(bytes: &[u8], file: &str) -> Self {
        if bytes.starts_with(b"PK") {
            return Self::Npz;
        }
        let mut told = bytes.split(|b| *b == b'\n').map(<[u8]>::trim_ascii);
        let first = told.find(|line| !line.is_empty()).unwrap_or_default();
        if first.starts_with(b"%%") {
            return Self::Market;
        }
        let end = file.rsplit_once('.').map_or("", |(_, end)| end).to_ascii_lowercase();
        match end.as_str() {
            "sti" | "mas" => Self::Calculix,
            "pch" | "dmig" | "bdf" => Self::Dmig,
            "op4" => Self::Op4,
            "mtx" => Self::Market,
            _ if dmig::has(bytes) => Self::Dmig,
            _ if triplet(first).is_ok() => Self::Calculix,
            _ => Self::Market,
        }
    }
}

/// An error about a file as a whole.
fn whole(name: &str, message: String) -> FileError {
    FileError { file: name.to_owned(), line: None, message }
}

/// An error about a line, counted from 1.
fn at_line(name: &str, line: usize, message: String) -> FileError {
    FileError { file: name.to_owned(), line: Some(line), message }
}

fn text(line: &[u8]) -> Cow<'_, str> {
    String::from_utf8_lossy(line)
}

/// Row and column as they stand in a line, and a value that is finite.
fn triplet(line: &[u8]) -> Result<(usize, usize, f64), String> {
    let no = || format!("`{}` is no entry: row, column and value are wanted", text(line).trim());
    let line = std::str::from_utf8(line).map_err(|_| no())?;
    let mut words = line.split_ascii_whitespace();
    let mut next = || words.next().ok_or_else(no);
    let (i, j, value) = (next()?, next()?, next()?);
    if words.next().is_some() {
        return Err(no());
    }
    let place = |word: &str| word.parse::<usize>().map_err(|_| no());
    let (i, j) = (place(i)?, place(j)?);
    let value: f64 = value.parse().map_err(|_| no())?;
    if !value.is_finite() {
        return Err(format!("entry ({i}, {j}) is {value}: must be a finite number"));
    }
    Ok((i, j, value))
}

/// The size of a matrix that a file says it holds.
fn square(rows: usize, columns: usize) -> Result<usize, String> {
    if rows != columns {
        return Err(format!("the matrix has {rows} rows and {columns} columns: must be square"));
    }
    if rows == 0 {
        return Err("the matrix has no rows".into());
    }
    if rows > MOST_ROWS {
        return Err(format!("the matrix has {rows} rows: at most {MOST_ROWS} are read"));
    }
    Ok(rows)
}

/// Entries by row and column; those at one place are added up in the order of the file.
fn settle(entries: &mut Entries) {
    let in_order = entries.windows(2).all(|e| (e[0].0, e[0].1) < (e[1].0, e[1].1));
    if !in_order {
        entries.sort_by_key(|e| (e.0, e.1));
        entries.dedup_by(|next, sum| {
            let same = (next.0, next.1) == (sum.0, sum.1);
            if same {
                sum.2 += next.2;
            }
            same
        });
    }
    entries.shrink_to_fit();
}

/// A matrix as a text that reads back to it under its name: Matrix Market, `DMIG` entries where its rows have names, or
/// OUTPUT4 where it has one and its rows have none.
pub(crate) fn written(a: &SparseMatrix) -> String {
    match (a.rows.is_empty(), parted(&a.name).1) {
        (false, _) => dmig::write(a),
        (true, Some(_)) => op4::write(a),
        (true, None) => market::write(a),
    }
}

/// How a matrix is written.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum MatrixForm {
    /// Matrix Market, `.mtx`.
    Market,
    /// As `scipy.sparse.save_npz` writes it, `.npz`, in rows (CSR).
    Npz,
    /// `DMIG` entries of Nastran, `.pch`; the rows must have names.
    Dmig,
    /// OUTPUT4 of Nastran, formatted, `.op4`.
    Op4,
}

/// A matrix as a file that reads back to it.
///
/// # Errors
/// Where an archive would be larger than its format knows.
pub fn matrix_file(a: &SparseMatrix, form: MatrixForm) -> std::io::Result<Vec<u8>> {
    match form {
        MatrixForm::Market => Ok(market::write(a).into_bytes()),
        MatrixForm::Npz => npz::write(a),
        MatrixForm::Dmig => Ok(dmig::write(a).into_bytes()),
        MatrixForm::Op4 => Ok(op4::write(a).into_bytes()),
    }
}

/// True where every entry has its equal on the other side of the diagonal.
fn is_symmetric(a: &SparseMatrix) -> bool {
    let mirrored =
        |(i, j, v): &(u32, u32, f64)| i == j || a.row(*j as usize).any(|e| e == (*i as usize, *v));
    a.entries.iter().all(mirrored)
}

#[cfg(test)]
mod tests;
