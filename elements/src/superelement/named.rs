//! Matrices whose rows have names, such as those of DMIG: brought to the same rows and tied to nodes.

use super::table::Ties;
use std::collections::BTreeSet;
use std::sync::Arc;
use trilith_element::{FileError, MeshRow, ParameterError, SparseMatrices, SparseMatrix};

/// Gives all matrices the rows that any of them has, in the order of the names, and ties those of nodes; `labels` are
/// those of the nodes of the element, in their order; those that are led need no row.
pub(super) fn tie(
    sparse: &mut SparseMatrices,
    labels: &[&str],
    led: &[usize],
) -> Result<(), ParameterError> {
    let others = [sparse.mass.as_ref(), sparse.damping.as_ref()];
    let all = std::iter::once(&sparse.stiffness).chain(others.into_iter().flatten());
    let rows: BTreeSet<MeshRow> = all.flat_map(|a| a.rows.iter().copied()).collect();
    let rows: Vec<MeshRow> = rows.into_iter().collect();
    sparse.stiffness = widened(&sparse.stiffness, &rows);
    sparse.mass = sparse.mass.as_ref().map(|a| widened(a, &rows));
    sparse.damping = sparse.damping.as_ref().map(|a| widened(a, &rows));
    let file = sparse.stiffness.name.clone();
    let wrong = |message: String| {
        let error = FileError { file: file.clone(), line: None, message };
        ParameterError::File { name: "stiffness".into(), message: error.to_string() }
    };
    let mut ties = Ties::new(rows.len(), labels, led).map_err(&wrong)?;
    for (i, row) in rows.iter().enumerate() {
        ties.add(i, &row.node.to_string(), row.dof).map_err(&wrong)?;
    }
    sparse.rows = ties.finished().map_err(&wrong)?;
    Ok(())
}

/// The matrix with zeros in the rows that it lacks; all lists of rows rise.
fn widened(a: &Arc<SparseMatrix>, rows: &[MeshRow]) -> Arc<SparseMatrix> {
    if a.rows == rows {
        return Arc::clone(a);
    }
    let place = |i: u32| rows.binary_search(&a.rows[i as usize]).unwrap_or_default() as u32;
    let entries = a.entries.iter().map(|(i, j, value)| (place(*i), place(*j), *value)).collect();
    Arc::new(SparseMatrix {
        size: rows.len(),
        entries,
        rows: rows.to_vec(),
        name: a.name.clone(),
        path: a.path.clone(),
        sha256: a.sha256.clone(),
    })
}
