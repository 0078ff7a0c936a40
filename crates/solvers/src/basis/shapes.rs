//! Vectors of a basis, of which only the rows are kept that the others follow from.

use super::condensation::Condensation;
use std::sync::Arc;
use trilith_linalg::{Dense, Sparse};

/// Vectors completed together.
const BLOCK: usize = 4;

/// Vectors over the free DOFs: free DOFs × number.
#[derive(Clone, Debug)]
pub(crate) struct Shapes {
    rows: Arc<Condensation>,
    /// The rows that are kept × number.
    kept: Dense,
}

/// The free DOFs at these coordinates, which are themselves those where there is no shape.
pub(crate) fn expand(shape: Option<&Shapes>, q: &[f64]) -> Vec<f64> {
    shape.map_or_else(|| q.to_vec(), |shape| shape.expand(q))
}

impl Shapes {
    /// Of the rows that are kept.
    pub(crate) fn new(rows: Arc<Condensation>, kept: Dense) -> Self {
        Self { rows, kept }
    }

    pub(crate) fn len(&self) -> usize {
        self.kept.columns()
    }

    pub(crate) fn rows(&self) -> &Condensation {
        &self.rows
    }

    /// What is kept of one of them.
    pub(crate) fn kept(&self, j: usize) -> &[f64] {
        self.kept.column(j)
    }

    /// What is kept of each.
    pub(crate) fn kept_mut(&mut self) -> &mut Dense {
        &mut self.kept
    }

    /// One of them with zeros where it is not kept: enough for products with masses and links.
    pub(crate) fn heavy(&self, j: usize) -> Vec<f64> {
        let mut u = vec![0.0; self.rows.order()];
        self.rows.scatter(self.kept.column(j), &mut u);
        u
    }

    /// One of them.
    pub(crate) fn column(&self, j: usize) -> Vec<f64> {
        self.rows.complete(self.kept.column(j))
    }

    /// A row over the free DOFs as a row over the vectors.
    pub(crate) fn row(&self, free: &[(usize, f64)]) -> Vec<f64> {
        let row = self.rows.row(free);
        let of = |j| {
            let column = self.kept.column(j);
            row.iter().map(|(i, c)| c * column[*i]).sum()
        };
        (0..self.len()).map(of).collect()
    }

    /// Φᵀ p.
    pub(crate) fn load(&self, p: &[f64]) -> Vec<f64> {
        let mut q = vec![0.0; self.len()];
        self.kept.transpose_mul_add(1.0, &self.rows.condense(p), &mut q);
        q
    }

    /// Φᵀ P.
    pub(crate) fn loads(&self, p: &Dense) -> Dense {
        if self.rows.is_none() {
            return self.kept.transpose_times(p);
        }
        let condensed = self.rows.condense(p.values()).into_owned();
        self.kept.transpose_times(&Dense::from_columns(self.rows.kept(), p.columns(), condensed))
    }

    /// Φ q.
    pub(crate) fn expand(&self, q: &[f64]) -> Vec<f64> {
        let mut u = vec![0.0; self.rows.kept()];
        self.kept.mul_add(1.0, q, &mut u);
        if self.rows.is_none() { u } else { self.rows.complete(&u) }
    }

    /// Φᵀ A Φ of the first vectors, for a symmetric A.
    pub(crate) fn congruence(&self, a: &Sparse, count: usize) -> Dense {
        self.reduced(a, count, |p, image| image.copy_from_slice(&self.rows.condense(p)))
    }

    /// The same for the stiffness, with or without effective stiffnesses: no force is left on what follows.
    pub(crate) fn stiffness(&self, k: &Sparse, count: usize) -> Dense {
        let order = self.rows.order();
        self.reduced(k, count, |p, image| {
            for (p, image) in p.chunks(order).zip(image.chunks_mut(self.rows.kept())) {
                image.copy_from_slice(&self.rows.gather(p));
            }
        })
    }

    /// Φᵀ A Φ with the images A Φ brought to the rows that are kept.
    fn reduced(&self, a: &Sparse, count: usize, bring: impl Fn(&[f64], &mut [f64])) -> Dense {
        if self.rows.is_none() {
            return self.kept.congruence(a, count);
        }
        let kept = self.rows.kept().max(1);
        self.kept.congruence_by(count, |x, images| {
            for (x, image) in x.chunks(BLOCK * kept).zip(images.chunks_mut(BLOCK * kept)) {
                let all = self.rows.complete(x);
                let mut own = vec![0.0; all.len()];
                a.symmetric_products(&all, &mut own);
                bring(&own, image);
            }
        })
    }

    /// More vectors behind these.
    pub(crate) fn beside(self, others: &Dense) -> Self {
        if others.columns() == 0 {
            return self;
        }
        let count = self.len() + others.columns();
        let mut values = self.kept.values().to_vec();
        for j in 0..others.columns() {
            values.extend_from_slice(&self.rows.gather(others.column(j)));
        }
        let kept = Dense::from_columns(self.rows.kept(), count, values);
        Self { rows: self.rows, kept }
    }
}
