//! Can a matrix be a stiffness, a mass or a damping?

use std::sync::Arc;
use trilith_element::{ParameterError, SparseMatrix};

/// Two entries that mirror each other may differ by this share of what their diagonal entries allow.
const ROUNDING: f64 = 1e-8;
/// An entry may be larger than its diagonal entries allow by this share: files have as few as six digits.
const SLACK: f64 = 1e-5;

/// The matrix, symmetric to the bit: finite, symmetric up to rounding, no diagonal entry negative, and none so small
/// beside another in its row that a motion of the two has a negative energy. Whether larger groups of rows are positive
/// semi-definite, the assembly sees.
pub(super) fn checked(
    name: &str,
    a: &Arc<SparseMatrix>,
) -> Result<Arc<SparseMatrix>, ParameterError> {
    let wrong = |message: String| {
        Err(ParameterError::File {
            name: name.to_owned(),
            message: format!("{}: {message}", a.name),
        })
    };
    let row = |i: u32| a.row_name(i as usize);
    let diagonal = a.diagonal();
    if let Some((i, j, value)) = a.entries.iter().find(|e| !e.2.is_finite()) {
        return wrong(format!("{value} in row {}, column {}", row(*i), row(*j)));
    }
    let most = diagonal.iter().fold(0.0_f64, |most, d| most.max(d.abs()));
    if let Some(i) = diagonal.iter().position(|d| *d < -1e-12 * most) {
        return wrong(format!(
            "the diagonal entry of row {} is {:e}: must not be negative",
            a.row_name(i),
            diagonal[i]
        ));
    }
    let offsets = a.offsets();
    let mirrored = |i: u32, j: u32| {
        let row = &a.entries[offsets[j as usize]..offsets[j as usize + 1]];
        row.binary_search_by_key(&i, |e| e.1).map_or(0.0, |k| row[k].2)
    };
    let allowed =
        |i: u32, j: u32| (diagonal[i as usize].max(0.0) * diagonal[j as usize].max(0.0)).sqrt();
    let mut worst: Option<(f64, u32, u32, f64, f64)> = None;
    let mut alike = true;
    // Row after row, the mirror images in each other row come one after the other.
    let mut next = offsets.clone();
    for (i, j, value) in &a.entries {
        let (at, end) = (&mut next[*j as usize], offsets[*j as usize + 1]);
        *at += a.entries[*at..end].iter().take_while(|e| e.1 < *i).count();
        let other = a.entries[*at..end].first().filter(|e| e.1 == *i).map_or(0.0, |e| e.2);
        if other == *value {
            continue;
        }
        alike = false;
        let size = allowed(*i, *j).max(value.abs()).max(other.abs());
        let share = (value - other).abs() / size;
        if share > ROUNDING && worst.is_none_or(|(most, ..)| share > most) {
            worst = Some((share, *i, *j, *value, other));
        }
    }
    if let Some((_, i, j, value, other)) = worst {
        let (i, j) = (row(i), row(j));
        let relative = (value - other).abs() / value.abs().max(other.abs());
        return wrong(format!(
            "the matrix is not symmetric: {value:e} in row {i}, column {j}, and {other:e} in row {j}, column {i}, a difference of {relative:.1e}, the largest of all; must be symmetric"
        ));
    }
    let over = |e: &&(u32, u32, f64)| {
        e.0 != e.1 && e.2.abs() > (1.0 + SLACK) * allowed(e.0, e.1) + 1e-12 * most
    };
    if let Some((i, j, value)) = a.entries.iter().find(over) {
        return wrong(format!(
            "{value:e} in row {}, column {}, beside {:e} and {:e} on the diagonal: a motion of the two has a negative energy, and the matrix must be positive semi-definite",
            row(*i),
            row(*j),
            diagonal[*i as usize],
            diagonal[*j as usize]
        ));
    }
    if alike {
        return Ok(Arc::clone(a));
    }
    let mut even = SparseMatrix::clone(a);
    for e in &mut even.entries {
        e.2 = 0.5 * (e.2 + mirrored(e.0, e.1));
    }
    // Entries without a mirror image are rounding.
    even.entries.retain(|(i, j, _)| i == j || has(a, &offsets, *j, *i));
    Ok(Arc::new(even))
}

fn has(a: &SparseMatrix, offsets: &[usize], i: u32, j: u32) -> bool {
    let row = &a.entries[offsets[i as usize]..offsets[i as usize + 1]];
    row.binary_search_by_key(&j, |e| e.1).is_ok()
}
