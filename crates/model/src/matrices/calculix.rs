//! Matrices of CalculiX, `*FREQUENCY, SOLVER=MATRIXSTORAGE`: stiffness in `.sti`, mass in `.mas`.
//!
//! A line for each entry of one triangle: row and column, from 1, and value. The file does not say how many there are, but
//! every row has its diagonal entry, a zero one as well, and every line ends.
//!
//! G. Dhondt, "CalculiX CrunchiX User's Manual", the card `*FREQUENCY`.

use super::{Entries, at_line, square, triplet, whole};
use trilith_element::FileError;

/// Rows and entries.
pub(super) fn read(bytes: &[u8], name: &str) -> Result<(usize, Entries), FileError> {
    let count = told(bytes).count();
    let mut entries = Entries::with_capacity(2 * count);
    let (mut size, mut last) = (0, 0);
    for (at, line) in told(bytes) {
        let (i, j, value) = triplet(line).map_err(|message| at_line(name, at, message))?;
        if i == 0 || j == 0 {
            let message = format!("entry ({i}, {j}): rows and columns count from 1");
            return Err(at_line(name, at, message));
        }
        (size, last) = (i.max(j).max(size), at);
        if size > count {
            let message = format!(
                "entry ({i}, {j}): there is no row {size} in a file of {count} entries, which has the diagonal entry of every row"
            );
            return Err(at_line(name, at, message));
        }
        // No more than there are lines, and checked below.
        let (i, j) = (i as u32 - 1, j as u32 - 1);
        entries.push((i, j, value));
        if i != j {
            entries.push((j, i, value));
        }
    }
    if last == 0 {
        return Err(whole(name, "the file is empty".into()));
    }
    let size = square(size, size).map_err(|message| whole(name, message))?;
    if !bytes.ends_with(b"\n") {
        let message = "the last line does not end: the file has been cut off".into();
        return Err(at_line(name, last, message));
    }
    let mut has = vec![false; size];
    entries.iter().filter(|(i, j, _)| i == j).for_each(|(i, ..)| has[*i as usize] = true);
    if let Some(row) = has.iter().position(|has| !has) {
        let message = format!(
            "the file ends without the diagonal entry of row {}, and has one of every row: it has been cut off",
            row + 1
        );
        return Err(at_line(name, last, message));
    }
    entries.sort_by_key(|e| (e.0, e.1));
    if let Some(two) = entries.windows(2).find(|e| (e[0].0, e[0].1) == (e[1].0, e[1].1)) {
        return Err(twice(bytes, name, two[0].0 as usize + 1, two[0].1 as usize + 1));
    }
    Ok((size, entries))
}

/// Lines that are not blank, counted from 1.
fn told(bytes: &[u8]) -> impl Iterator<Item = (usize, &[u8])> {
    let lines = bytes.split(|b| *b == b'\n').enumerate().map(|(i, line)| (i + 1, line));
    lines.filter(|(_, line)| !line.trim_ascii().is_empty())
}

fn twice(bytes: &[u8], name: &str, i: usize, j: usize) -> FileError {
    let same = |line| triplet(line).is_ok_and(|(a, b, _)| (a, b) == (i, j) || (a, b) == (j, i));
    let found: Vec<usize> =
        told(bytes).filter(|(_, line)| same(line)).map(|(at, _)| at).take(2).collect();
    let first = found.first().copied().unwrap_or(0);
    let message = format!(
        "the entry of rows {} and {} stands in line {first} already: each stands there once, in one triangle",
        i.min(j),
        i.max(j)
    );
    at_line(name, found.last().copied().unwrap_or(0), message)
}

#[cfg(test)]
mod tests;
