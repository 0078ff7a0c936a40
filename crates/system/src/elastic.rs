//! End forces of linear elements as rows over the reduced DOFs.

use crate::Reduction;
use trilith_element::{Dof, ElementMatrices, SparseMatrices, SparseRow};

/// An end force as a linear combination: `Σ stiffness · u + Σ damping · u̇`, over free and prescribed DOFs.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct EndForceRow {
    /// (reduced index, N/m …).
    pub stiffness: Vec<(usize, f64)>,
    /// (reduced index, N·s/m …).
    pub damping: Vec<(usize, f64)>,
}

/// The force of a support as a linear combination: `Σ stiffness · u + Σ damping · u̇ + Σ links · f`, and what
/// patterns of loads along members bring straight to it.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct ReactionRow {
    /// (reduced index, N/m …).
    pub stiffness: Vec<(usize, f64)>,
    /// (reduced index, N·s/m …); with the share of K in Rayleigh damping.
    pub damping: Vec<(usize, f64)>,
    /// (flat index of a link coordinate, share of its force).
    pub links: Vec<(usize, f64)>,
    /// (index of a load pattern, force of its loads along members), reversed.
    pub loads: Vec<(usize, f64)>,
}

/// The same of an element with sparse matrices, whose rows stand at these full DOFs.
pub(crate) fn sparse_end_force(
    own: &SparseMatrices,
    places: &[usize],
    (end, dof): (usize, Dof),
    reduction: &Reduction,
) -> EndForceRow {
    let mut force = EndForceRow::default();
    let Some(row) = own.rows.iter().position(|r| *r == SparseRow::Node(end, dof)) else {
        return force;
    };
    let parts =
        [(&mut force.stiffness, Some(&own.stiffness)), (&mut force.damping, own.damping.as_ref())];
    for (list, a) in parts {
        for (j, value) in a.into_iter().flat_map(|a| a.row(row)).filter(|(_, v)| *v != 0.0) {
            list.extend(reduction.expand(places[j]).iter().map(|(i, t)| (*i, value * t)));
        }
    }
    force
}

pub(crate) fn end_force_row(
    matrices: &ElementMatrices,
    nodes: &[usize],
    end: usize,
    dof: Dof,
    reduction: &Reduction,
) -> EndForceRow {
    let mut row = EndForceRow::default();
    let Some(i) = matrices.dofs.iter().position(|at| *at == (end, dof)) else { return row };
    for (j, (node, d)) in matrices.dofs.iter().enumerate() {
        for (reduced, t) in reduction.expand(6 * nodes[*node] + d.index()) {
            for (list, a) in
                [(&mut row.stiffness, &matrices.stiffness), (&mut row.damping, &matrices.damping)]
            {
                if a[(i, j)] != 0.0 {
                    list.push((*reduced, a[(i, j)] * t));
                }
            }
        }
    }
    row
}
