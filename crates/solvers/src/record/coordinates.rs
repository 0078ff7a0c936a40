//! What the coordinates of a solver make of the free DOFs.

use crate::basis::Shapes;
use std::sync::{Arc, OnceLock};
use trilith_linalg::Dense;
use trilith_system::System;

/// Where nodes are led by fewer than one in so many free DOFs, these are made alone.
const WORTH_IT: usize = 4;

/// The coordinates of a solver: how many, and what they make of the free DOFs, unless they are these.
pub(super) struct Coordinates {
    pub(super) order: usize,
    shape: Option<Arc<Shapes>>,
    leading: OnceLock<Option<Leading>>,
}

/// The free DOFs that lead nodes, where they are few: most equations may be inside of parts that no node sees.
struct Leading {
    dofs: Vec<usize>,
    /// Coordinates × number of them.
    rows: Dense,
}

impl Leading {
    fn new(system: &System, shape: &Shapes, directions: usize) -> Option<Self> {
        let terms = (0..directions).flat_map(|full| system.reduction.expand(full));
        let mut dofs: Vec<usize> = terms.map(|(j, _)| *j).filter(|j| *j < system.order()).collect();
        dofs.sort_unstable();
        dofs.dedup();
        if WORTH_IT * dofs.len() > system.order() {
            return None;
        }
        let rows = dofs.iter().flat_map(|dof| shape.row(&[(*dof, 1.0)])).collect();
        let rows = Dense::from_columns(shape.len(), dofs.len(), rows);
        Some(Self { dofs, rows })
    }
}

impl Coordinates {
    pub(super) fn new(order: usize, shape: Option<Arc<Shapes>>) -> Self {
        Self { order, shape, leading: OnceLock::new() }
    }

    /// The free DOFs of some motions that lead the first directions of nodes; others may be zero.
    pub(super) fn leading(
        &self,
        system: &System,
        motions: &[&[f64]],
        directions: usize,
    ) -> Vec<Vec<f64>> {
        let Some(shape) = &self.shape else { return motions.iter().map(|q| q.to_vec()).collect() };
        let q = Dense::from_columns(self.order, motions.len(), motions.concat());
        let leading = self.leading.get_or_init(|| Leading::new(system, shape, directions));
        let Some(Leading { dofs, rows }) = leading else { return shape.expand_each(&q) };
        let values = rows.transpose_times(&q);
        let free = (0..q.columns()).map(|j| {
            let mut free = vec![0.0; system.order()];
            dofs.iter().zip(values.column(j)).for_each(|(dof, x)| free[*dof] = *x);
            free
        });
        free.collect()
    }
}
