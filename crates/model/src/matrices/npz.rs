//! A sparse matrix as `scipy.sparse.save_npz` writes it: an archive of arrays.
//!
//! ```text
//!   csr  row i: columns indices[indptr[i] .. indptr[i + 1]], values data there
//!   csc  the same with rows and columns in each other's place
//!   coo  row, col, data
//! ```

use super::npy::{Numbers, file, numbers, text};
use super::{Entries, square};
use std::io::{self, Cursor, Read, Write};
use trilith_element::SparseMatrix;
use zip::write::SimpleFileOptions;
use zip::{ZipArchive, ZipWriter};

/// Bytes of the largest array that is unpacked: 1 GiB.
const MOST_BYTES: u64 = 1 << 30;

type Archive<'a> = ZipArchive<Cursor<&'a [u8]>>;

/// Rows and entries.
pub(super) fn read(bytes: &[u8]) -> Result<(usize, Entries), String> {
    let mut archive = ZipArchive::new(Cursor::new(bytes))
        .map_err(|e| format!("the archive cannot be opened ({e}): it may have been cut off"))?;
    let format = within("format", &member(&mut archive, "format")?, text)?;
    let shape = whole(&mut archive, "shape")?;
    let [rows, columns] = shape[..] else {
        return Err("`shape` of the archive is not two numbers".into());
    };
    let size = |n: i64| usize::try_from(n).map_err(|_| format!("`shape` of the archive is {n}"));
    let n = square(size(rows)?, size(columns)?)?;
    let values = match within("data", &member(&mut archive, "data")?, numbers)? {
        Numbers::Real(values) => values,
        Numbers::Whole(values) => values.into_iter().map(|v| v as f64).collect(),
    };
    let (outer, inner) = match format.as_str() {
        "csr" | "csc" => {
            let starts = whole(&mut archive, "indptr")?;
            (spread(&starts, n, values.len())?, whole(&mut archive, "indices")?)
        }
        "coo" => (whole(&mut archive, "row")?, whole(&mut archive, "col")?),
        other => {
            return Err(format!(
                "the matrix is stored as `{other}`: `csr`, `csc` and `coo` are read; `.tocsr()` before `save_npz` makes it so"
            ));
        }
    };
    if outer.len() != values.len() || inner.len() != values.len() {
        return Err(format!(
            "the archive has {} values in {} rows and {} columns: as many of each are wanted",
            values.len(),
            outer.len(),
            inner.len()
        ));
    }
    let place = |at: i64| {
        let found = u32::try_from(at).ok().filter(|at| (*at as usize) < n);
        found.ok_or_else(|| {
            format!("the archive has an entry in row or column {at} of {n}, counted from 0")
        })
    };
    let mut entries = Vec::with_capacity(values.len());
    for ((outer, inner), value) in outer.into_iter().zip(inner).zip(values) {
        let (a, b) = (place(outer)?, place(inner)?);
        let (i, j) = if format == "csc" { (b, a) } else { (a, b) };
        if !value.is_finite() {
            return Err(format!(
                "entry ({}, {}), counted from 1, is {value}: must be a finite number",
                i + 1,
                j + 1
            ));
        }
        entries.push((i, j, value));
    }
    Ok((n, entries))
}

/// The row of each value, from where rows begin.
fn spread(starts: &[i64], n: usize, values: usize) -> Result<Vec<i64>, String> {
    let rises = starts.windows(2).all(|s| s[0] <= s[1]);
    let ends = (starts.first(), starts.last()) == (Some(&0), Some(&(values as i64)));
    if starts.len() != n + 1 || !rises || !ends {
        return Err(format!(
            "`indptr` of the archive has {} numbers for {n} rows and {values} values: {} are wanted, rising from 0 to {values}",
            starts.len(),
            n + 1
        ));
    }
    let own = |(i, s): (usize, &[i64])| std::iter::repeat_n(i as i64, (s[1] - s[0]) as usize);
    Ok(starts.windows(2).enumerate().flat_map(own).collect())
}

/// The bytes of an array.
fn member(archive: &mut Archive<'_>, name: &str) -> Result<Vec<u8>, String> {
    let held = archive.by_name(&format!("{name}.npy"));
    let file = held.map_err(|_| {
        format!("the archive has no `{name}`: a matrix of `scipy.sparse.save_npz` is wanted")
    })?;
    let mut bytes = Vec::new();
    let read = file.take(MOST_BYTES + 1).read_to_end(&mut bytes);
    read.map_err(|e| format!("`{name}` of the archive is damaged: {e}"))?;
    if bytes.len() as u64 > MOST_BYTES {
        return Err(format!("`{name}` of the archive is larger than 1 GiB, the most that is read"));
    }
    Ok(bytes)
}

fn within<T>(
    name: &str,
    bytes: &[u8],
    read: impl Fn(&[u8]) -> Result<T, String>,
) -> Result<T, String> {
    read(bytes).map_err(|message| format!("`{name}` of the archive: {message}"))
}

fn whole(archive: &mut Archive<'_>, name: &str) -> Result<Vec<i64>, String> {
    match within(name, &member(archive, name)?, numbers)? {
        Numbers::Whole(numbers) => Ok(numbers),
        Numbers::Real(_) => Err(format!("`{name}` of the archive holds no whole numbers")),
    }
}

/// A matrix in rows (CSR); the same bytes whenever it is written.
pub(super) fn write(a: &SparseMatrix) -> io::Result<Vec<u8>> {
    let count = format!("({},)", a.entries.len());
    let starts = a.offsets().into_iter().flat_map(|s| (s as i64).to_le_bytes());
    let arrays = [
        ("indices", file("<i4", &count, a.entries.iter().flat_map(|e| (e.1 as i32).to_le_bytes()))),
        ("indptr", file("<i8", &format!("({},)", a.size + 1), starts)),
        ("format", file("|S3", "()", *b"csr")),
        ("shape", file("<i8", "(2,)", [a.size as i64; 2].into_iter().flat_map(i64::to_le_bytes))),
        ("data", file("<f8", &count, a.entries.iter().flat_map(|e| e.2.to_le_bytes()))),
    ];
    let mut archive = ZipWriter::new(Cursor::new(Vec::new()));
    for (name, bytes) in arrays {
        let options = SimpleFileOptions::default().last_modified_time(zip::DateTime::default());
        archive.start_file(format!("{name}.npy"), options)?;
        archive.write_all(&bytes)?;
    }
    Ok(archive.finish()?.into_inner())
}
