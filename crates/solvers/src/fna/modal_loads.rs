//! Modal loads of one motion on its way through a step.

use crate::structure::{LinkMap, ReducedSystem};
use crate::vector::equal;
use trilith_linalg::{Dense, Panel, Product, StepSums};

/// What one motion needs on its way through a step.
pub(crate) struct ModalLoads {
    /// Loads less link forces at the start and at the end of the step, and (B Φ)ᵀ of the pseudo-forces spread last,
    /// one after the other.
    pub(super) sources: Vec<f64>,
    /// The integral of q.
    pub(super) integral: Vec<f64>,
    /// Whether somebody asks for work.
    pub(super) works: bool,
    /// What the step completed last did, and what it lost where loads had jumped.
    pub(super) sums: StepSums,
    pub(super) lost: f64,
    /// Pseudo-forces spread last.
    pseudo: Vec<f64>,
    /// True of what laws damp, and of what any link acts on.
    pub(super) damped: Vec<bool>,
    pub(super) linked: Vec<bool>,
    /// The link coordinates whose rates laws depend on, and their rows of B Φ where these are few.
    rate_dependent: Vec<usize>,
    rows: Option<Product>,
}

impl ModalLoads {
    /// `rate_dependent`: the link coordinates whose rates laws depend on, `damped`: those whose forces depend on them.
    pub(crate) fn new(space: &ReducedSystem, rate_dependent: &[usize], damped: &[usize]) -> Self {
        let few = rate_dependent.len() <= Panel::MOST_ROWS;
        let rows = few.then(|| {
            let mut rows = Dense::zeros(rate_dependent.len(), space.order());
            for (i, a) in rate_dependent.iter().enumerate() {
                space.links.row(*a).for_each(|(j, c)| rows[(i, j)] = c);
            }
            Product::new(rows)
        });
        let touched = |some: &mut dyn Iterator<Item = usize>| {
            let mut touched = vec![false; space.order()];
            for a in some {
                space.links.row(a).filter(|(_, c)| *c != 0.0).for_each(|(i, _)| touched[i] = true);
            }
            touched
        };
        Self {
            damped: touched(&mut damped.iter().copied()),
            linked: touched(&mut (0..space.links.len())),
            pseudo: vec![0.0; space.links.len()],
            sources: vec![0.0; 3 * space.order()],
            integral: vec![0.0; space.order()],
            works: true,
            sums: StepSums::default(),
            lost: 0.0,
            rate_dependent: rate_dependent.to_vec(),
            rows,
        }
    }

    /// Rates that laws depend on, of velocities of the modes.
    #[inline]
    pub(crate) fn rates(&self, links: &LinkMap, v: &[f64], rates: &mut [f64]) {
        match &self.rows {
            Some(rows) => rows.times(v, rates),
            None => links.deform_some(v, &self.rate_dependent, rates),
        }
    }

    /// Where (B Φ)ᵀ f̃ of these pseudo-forces must go, unless they are those spread last.
    #[inline]
    pub(crate) fn renew_spread(&mut self, pseudo: &[f64]) -> Option<&mut [f64]> {
        if equal(&self.pseudo, pseudo) {
            return None;
        }
        self.pseudo.copy_from_slice(pseudo);
        let [_, _, spread] = self.parts();
        Some(spread)
    }

    /// Loads less link forces at both ends, and the link forces spread last.
    pub(super) fn parts(&mut self) -> [&mut [f64]; 3] {
        let n = self.sources.len() / 3;
        let (source0, rest) = self.sources.split_at_mut(n);
        let (source1, spread) = rest.split_at_mut(n);
        [source0, source1, spread]
    }
}
