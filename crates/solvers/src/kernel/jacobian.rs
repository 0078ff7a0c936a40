//! The link equations of a whole step, linearised: for what goes beside a run and is solved once.

use super::compliance::{Compliance, ComplianceMatrix};
use super::layout::Layout;
use super::modal_jacobian::ModalJacobian;
use trilith_linalg::{Dense, DenseLu};
use trilith_system::Tangents;

/// J = I + (k − k_e) G + c H, factorised.
pub(crate) enum Jacobian {
    Full(DenseLu),
    Modal(Box<ModalJacobian>),
}

impl Jacobian {
    pub fn new(
        layout: &Layout<'_>,
        Compliance { g, h, .. }: &Compliance,
        tangents: &Tangents,
    ) -> Self {
        let (g, h) = match (g, h) {
            (ComplianceMatrix::Modal(g), ComplianceMatrix::Modal(h)) => {
                return Self::Modal(Box::new(ModalJacobian::new(layout, tangents, [g, h], 0.0)));
            }
            _ => (&*g.all(), &*h.all()),
        };
        let n = g.rows();
        // By rows: G and H are symmetric.
        let mut rows = Dense::zeros(n, n);
        for a in 0..n {
            let row = rows.column_mut(a);
            row[a] = 1.0;
            for (b, k, c) in layout.tangents_of(a, tangents) {
                let pairs = row.iter_mut().zip(g.column(b).iter().zip(h.column(b)));
                pairs.for_each(|(x, (g, h))| *x += k * g + c * h);
            }
        }
        Self::Full(DenseLu::new(&rows.transpose()))
    }

    /// Right-hand sides become solutions.
    pub fn solve(&self, x: &mut [f64]) {
        match self {
            Self::Full(all) => all.solve(x),
            Self::Modal(modal) => modal.solve_alone(x),
        }
    }
}
