//! What a parameter moves in masses, damping, stiffness and where links hang.

use super::around::WEIGHTS;
use crate::basis::LowRank;
use crate::structure::ReducedSystem;
use trilith_linalg::Sparse;

/// Derivatives of M, C, K and B.
pub(super) struct Structure {
    pub mass: Sparse,
    damping: Sparse,
    stiffness: Sparse,
    modal: Vec<(f64, LowRank)>,
    /// Of the rows of the active link coordinates; none where they stay.
    pub rows: Option<Vec<Vec<(usize, f64)>>>,
}

impl Structure {
    /// p −= ∂K u + ∂C v + ∂Bᵀ f; `f` of the active coordinates.
    pub(super) fn resist(&self, u: &[f64], v: &[f64], f: impl Fn(usize) -> f64, p: &mut [f64]) {
        self.stiffness.mul_add(-1.0, u, p);
        self.damping.mul_add(-1.0, v, p);
        for (weight, modal) in &self.modal {
            let mut y = vec![0.0; modal.rate.len()];
            modal.u.transpose_mul_add(1.0, v, &mut y);
            y.iter_mut().zip(&modal.rate).for_each(|(y, rate)| *y *= rate);
            modal.u.mul_add(-weight, &y, p);
        }
        for (a, row) in self.rows.iter().flatten().enumerate() {
            row.iter().for_each(|(i, c)| p[*i] -= c * f(a));
        }
    }

    /// None where nothing moves.
    pub(super) fn new(step: f64, spaces: &[ReducedSystem; 4]) -> Result<Option<Self>, String> {
        let order = spaces[0].order();
        if spaces.iter().any(|s| s.order() != order || s.links.len() != spaces[0].links.len()) {
            return Err("changes which directions are free".into());
        }
        let sum = |of: &dyn Fn(&ReducedSystem) -> Sparse| {
            let all = [0, 1, 2, 3].map(|i| of(&spaces[i]));
            let parts: Vec<_> = WEIGHTS.iter().zip(&all).map(|(w, a)| (w / step, a)).collect();
            let same = all.iter().all(|a| a.entries().eq(all[0].entries()));
            (Sparse::combine(&parts), same)
        };
        let (mass, same_mass) = sum(&|s| s.mass.clone());
        let (stiffness, same_stiffness) = sum(&|s| s.stiffness.clone());
        let (damping, same_damping) = sum(&|s| {
            let [of_mass, of_stiffness] = s.rayleigh;
            let parts = [(1.0, &s.damping), (of_mass, &s.mass), (of_stiffness, &s.stiffness)];
            Sparse::combine(&parts)
        });
        let like =
            |s: &ReducedSystem| s.modal.as_ref().map(|m| (m.u.values().to_vec(), m.rate.clone()));
        let first = like(&spaces[0]);
        let same_modal = spaces.iter().all(|s| like(s) == first);
        let weights = WEIGHTS.map(|w| w / step);
        let modal = match same_modal {
            true => Vec::new(),
            false => {
                let all = weights.iter().zip(spaces);
                all.filter_map(|(w, s)| s.modal.clone().map(|m| (*w, m))).collect()
            }
        };
        let row = |s: &ReducedSystem, a: usize| s.links.row(a).collect::<Vec<_>>();
        let moves = (0..spaces[0].links.len())
            .any(|a| spaces.iter().any(|s| row(s, a) != row(&spaces[0], a)));
        let rows = moves.then(|| {
            let of = |a: usize| {
                let terms = weights.iter().zip(spaces);
                let mut sum = std::collections::BTreeMap::new();
                for (w, s) in terms {
                    row(s, a).into_iter().for_each(|(i, c)| *sum.entry(i).or_insert(0.0) += w * c);
                }
                sum.into_iter().collect()
            };
            (0..spaces[0].links.len()).map(of).collect()
        });
        let still = same_mass && same_stiffness && same_damping && same_modal && rows.is_none();
        Ok((!still).then_some(Self { mass, damping, stiffness, modal, rows }))
    }
}
