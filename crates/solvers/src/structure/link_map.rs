//! The map B from the coordinates of a solver to the deformations of the links.

use std::sync::Arc;
use trilith_linalg::{Dense, Panel};

/// B of the active link coordinates: a few terms each on the free DOFs, full rows on a basis.
#[derive(Clone, Debug)]
pub(crate) enum LinkMap {
    /// (coordinate, factor) of each row.
    Sparse(Vec<Vec<(usize, f64)>>),
    /// Full rows.
    Full(FullMap),
}

/// B of full rows.
#[derive(Clone, Debug)]
pub(crate) struct FullMap {
    /// Bᵀ: one column for each link coordinate.
    columns: Arc<Dense>,
    /// B and Bᵀ once more, where they have few rows.
    deform: Option<Panel>,
    spread: Option<Panel>,
}

impl LinkMap {
    /// Of full rows, as the columns of Bᵀ.
    pub(crate) fn full(columns: Dense) -> Self {
        let few = columns.columns() <= Panel::MOST_ROWS;
        let deform = few.then(|| Panel::new(&columns.transpose()));
        let spread = Panel::of_few(&columns);
        Self::Full(FullMap { deform, spread, columns: Arc::new(columns) })
    }

    /// Bᵀ of full rows: one column for each link coordinate.
    pub(crate) fn columns(&self) -> Option<&Arc<Dense>> {
        match self {
            Self::Sparse(_) => None,
            Self::Full(full) => Some(&full.columns),
        }
    }

    /// Number of link coordinates.
    pub(crate) fn len(&self) -> usize {
        match self {
            Self::Sparse(rows) => rows.len(),
            Self::Full(full) => full.columns.columns(),
        }
    }

    /// Terms of one row.
    pub(crate) fn row(&self, a: usize) -> Box<dyn Iterator<Item = (usize, f64)> + '_> {
        match self {
            Self::Sparse(rows) => Box::new(rows[a].iter().copied()),
            Self::Full(full) => Box::new(full.columns.column(a).iter().copied().enumerate()),
        }
    }

    /// `d = B u`.
    #[inline]
    pub(crate) fn deform(&self, u: &[f64], d: &mut [f64]) {
        match self {
            Self::Sparse(rows) => {
                for (x, row) in d.iter_mut().zip(rows) {
                    *x = row.iter().map(|(j, c)| c * u[*j]).sum();
                }
            }
            Self::Full(FullMap { deform: Some(panel), .. }) => panel.times(u, d),
            Self::Full(full) => {
                d.fill(0.0);
                full.columns.transpose_mul_add(1.0, u, d);
            }
        }
    }

    /// `d = B u` of some link coordinates, one after the other.
    pub(crate) fn deform_some(&self, u: &[f64], which: &[usize], d: &mut [f64]) {
        if which.len() == self.len() {
            return self.deform(u, d);
        }
        for (a, d) in which.iter().zip(d) {
            *d = match self {
                Self::Sparse(rows) => rows[*a].iter().map(|(j, c)| c * u[*j]).sum(),
                Self::Full(full) => full.columns.column_dot(*a, u),
            };
        }
    }

    /// `d = B u` of many vectors (u, d).
    pub(crate) fn deform_each(&self, pairs: &mut [(&[f64], &mut [f64])]) {
        match self {
            Self::Full(FullMap { deform: None, columns, .. }) => {
                pairs.iter_mut().for_each(|(_, d)| d.fill(0.0));
                columns.transpose_mul_add_each(1.0, pairs);
            }
            _ => pairs.iter_mut().for_each(|(u, d)| self.deform(u, d)),
        }
    }

    /// `p = Bᵀ f`.
    #[inline]
    pub(crate) fn spread_into(&self, f: &[f64], p: &mut [f64]) {
        if let Self::Full(FullMap { spread: Some(panel), .. }) = self {
            return panel.times(f, p);
        }
        p.fill(0.0);
        self.spread(1.0, f, p);
    }

    /// `p = Bᵀ f` of many vectors (f, p).
    pub(crate) fn spread_each(&self, pairs: &mut [(&[f64], &mut [f64])]) {
        match self {
            Self::Full(FullMap { spread: None, columns, .. }) => {
                pairs.iter_mut().for_each(|(_, p)| p.fill(0.0));
                columns.mul_add_each(1.0, pairs);
            }
            _ => pairs.iter_mut().for_each(|(f, p)| self.spread_into(f, p)),
        }
    }

    /// `p += s · Bᵀ f`.
    pub(crate) fn spread(&self, s: f64, f: &[f64], p: &mut [f64]) {
        match self {
            Self::Sparse(rows) => {
                for (row, x) in rows.iter().zip(f).filter(|(_, x)| **x != 0.0) {
                    for (j, c) in row {
                        p[*j] += s * c * x;
                    }
                }
            }
            Self::Full(full) => full.columns.mul_add(s, f, p),
        }
    }
}
