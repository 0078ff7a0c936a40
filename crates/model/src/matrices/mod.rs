//! Sparse matrices of files, as other programs write them.
//!
//! | file | form |
//! |---|---|
//! | `.mtx` | Matrix Market, coordinates, real or integer, symmetric or general |
//! | `.npz` | `scipy.sparse.save_npz`: CSR, CSC or COO, compressed or not |
//!
//! What a file is, it says itself: an archive begins with `PK`, all else is taken for Matrix Market.

mod market;
mod npy;
mod npz;

use crate::model::sha256;
use trilith_element::{FileError, SparseMatrix};

/// Rows of the largest matrix that is read.
const MOST_ROWS: usize = 10_000_000;

/// Row and column, from 0, and value.
type Entries = Vec<(u32, u32, f64)>;

/// Reads a square matrix; `name` is that of the file as the model has it, `path` where it was found.
///
/// # Errors
/// What is wrong with it, with its line where it has lines.
pub(crate) fn read(bytes: &[u8], name: &str, path: &str) -> Result<SparseMatrix, FileError> {
    let (size, mut entries) = match bytes.starts_with(b"PK") {
        true => npz::read(bytes).map_err(|message| whole(name, message))?,
        false => market::read(bytes, name)?,
    };
    settle(&mut entries);
    let (name, path) = (name.to_owned(), path.to_owned());
    Ok(SparseMatrix { name, path, sha256: sha256(bytes), size, entries })
}

/// An error about a file as a whole.
fn whole(name: &str, message: String) -> FileError {
    FileError { file: name.to_owned(), line: None, message }
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

/// A matrix as a Matrix Market text, its lower triangle where it is symmetric.
pub(crate) fn market_text(a: &SparseMatrix) -> String {
    market::write(a)
}

#[cfg(test)]
mod tests;
