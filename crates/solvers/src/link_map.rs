//! The map B from the coordinates of a solver to the deformations of the links.

use std::ops::Range;
use trilith_linalg::Dense;

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
    columns: Dense,
    /// B itself where it has not many rows: a short result is made faster in this form.
    rows: Option<Dense>,
}

/// Numbers of rows with which B is kept a second time: with fewer, sums of products over the modes are as fast,
/// and with more as well.
const SHORT: Range<usize> = 24..128;

impl LinkMap {
    /// Of full rows, as the columns of Bᵀ.
    pub(crate) fn full(columns: Dense) -> Self {
        let rows = SHORT.contains(&columns.columns()).then(|| columns.transpose());
        Self::Full(FullMap { columns, rows })
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
    pub(crate) fn deform(&self, u: &[f64], d: &mut [f64]) {
        match self {
            Self::Sparse(rows) => {
                for (x, row) in d.iter_mut().zip(rows) {
                    *x = row.iter().map(|(j, c)| c * u[*j]).sum();
                }
            }
            Self::Full(FullMap { columns, rows }) => {
                d.fill(0.0);
                match rows {
                    Some(rows) => rows.mul_add(1.0, u, d),
                    None => columns.transpose_mul_add(1.0, u, d),
                }
            }
        }
    }

    /// `d = B u` of some link coordinates; the others stay.
    pub(crate) fn deform_some(&self, u: &[f64], which: &[usize], d: &mut [f64]) {
        if which.len() == d.len() {
            return self.deform(u, d);
        }
        for a in which {
            d[*a] = match self {
                Self::Sparse(rows) => rows[*a].iter().map(|(j, c)| c * u[*j]).sum(),
                Self::Full(full) => full.columns.column_dot(*a, u),
            };
        }
    }

    /// `d = B u` of many vectors (u, d).
    pub(crate) fn deform_each(&self, pairs: &mut [(&[f64], &mut [f64])]) {
        match self {
            Self::Sparse(_) => pairs.iter_mut().for_each(|(u, d)| self.deform(u, d)),
            Self::Full(FullMap { columns, rows }) => {
                pairs.iter_mut().for_each(|(_, d)| d.fill(0.0));
                match rows {
                    Some(rows) => rows.mul_add_each(1.0, pairs),
                    None => columns.transpose_mul_add_each(1.0, pairs),
                }
            }
        }
    }

    /// `p += Bᵀ f` of many vectors (f, p).
    pub(crate) fn spread_each(&self, pairs: &mut [(&[f64], &mut [f64])]) {
        match self {
            Self::Sparse(_) => pairs.iter_mut().for_each(|(f, p)| self.spread(1.0, f, p)),
            Self::Full(full) => full.columns.mul_add_each(1.0, pairs),
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
