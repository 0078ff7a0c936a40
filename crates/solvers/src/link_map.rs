//! The map B from the coordinates of a solver to the deformations of the links.

use trilith_linalg::Dense;

/// B of the active link coordinates: a few terms each on the free DOFs, full rows on a basis.
#[derive(Clone, Debug)]
pub(crate) enum LinkMap {
    /// (coordinate, factor) of each row.
    Sparse(Vec<Vec<(usize, f64)>>),
    /// Bᵀ: one column for each link coordinate.
    Full(Dense),
}

impl LinkMap {
    /// Number of link coordinates.
    pub(crate) fn len(&self) -> usize {
        match self {
            Self::Sparse(rows) => rows.len(),
            Self::Full(columns) => columns.columns(),
        }
    }

    /// Terms of one row.
    pub(crate) fn row(&self, a: usize) -> Box<dyn Iterator<Item = (usize, f64)> + '_> {
        match self {
            Self::Sparse(rows) => Box::new(rows[a].iter().copied()),
            Self::Full(columns) => Box::new(columns.column(a).iter().copied().enumerate()),
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
            Self::Full(columns) => {
                d.fill(0.0);
                columns.transpose_mul_add(1.0, u, d);
            }
        }
    }

    /// `d = B u` of two vectors.
    pub(crate) fn deform_pair(&self, u: [&[f64]; 2], d: [&mut [f64]; 2]) {
        match self {
            Self::Sparse(_) => u.into_iter().zip(d).for_each(|(u, d)| self.deform(u, d)),
            Self::Full(columns) => {
                let [a, b] = d;
                a.fill(0.0);
                b.fill(0.0);
                columns.transpose_mul_add_pair(1.0, u, [a, b]);
            }
        }
    }

    /// `d = B u` of many vectors (u, d).
    pub(crate) fn deform_each(&self, pairs: &mut [(&[f64], &mut [f64])]) {
        match self {
            Self::Sparse(_) => pairs.iter_mut().for_each(|(u, d)| self.deform(u, d)),
            Self::Full(columns) => {
                pairs.iter_mut().for_each(|(_, d)| d.fill(0.0));
                columns.transpose_mul_add_each(1.0, pairs);
            }
        }
    }

    /// `p += Bᵀ f` of many vectors (f, p).
    pub(crate) fn spread_each(&self, pairs: &mut [(&[f64], &mut [f64])]) {
        match self {
            Self::Sparse(_) => pairs.iter_mut().for_each(|(f, p)| self.spread(1.0, f, p)),
            Self::Full(columns) => columns.mul_add_each(1.0, pairs),
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
            Self::Full(columns) => columns.mul_add(s, f, p),
        }
    }
}
