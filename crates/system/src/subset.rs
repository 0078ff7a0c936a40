//! Some of the linear elements and constraints of a model by themselves, on the directions that they use: no supports.

use crate::assemble::{element_matrices, full_entries};
use crate::inner::sparse;
use crate::{Reduction, System, SystemError};
use trilith_element::Dof;
use trilith_linalg::{Sparse, Triplets};
use trilith_model::{Body, Model};

/// A share of ‖K‖ ‖r‖ below which K r is rounding, as for files of matrices.
const ROUNDING: f64 = 1e-6;

/// Matrices of some of the linear elements, and what follows them by constraints.
#[derive(Debug)]
pub struct Subset {
    /// The full DOF of each row, rising: 6 · node + direction, and behind those of all nodes inner rows.
    pub full: Vec<usize>,
    /// Full DOFs that follow rows by constraints, rising: shares of rows.
    pub following: Vec<(usize, Vec<(usize, f64)>)>,
    /// K, with the geometric stiffness of the axial forces that the system has.
    pub stiffness: Sparse,
    /// M, inertances apart.
    pub mass: Sparse,
    /// C of the elements.
    pub damping: Sparse,
}

impl System {
    /// The matrices of the elements that are flagged, by their order in the model; constraints among them are
    /// eliminated, so that nodes that are kept follow each other alone. Directions out of the plane of a model with one are
    /// left out.
    ///
    /// # Errors
    /// [`SystemError`] where an element has no matrices.
    pub fn subset(
        &self,
        model: &Model,
        flags: &[bool],
        kept: &[bool],
    ) -> Result<Subset, SystemError> {
        let count = 6 * model.nodes.len() + self.inner.len();
        let mut used = vec![false; count];
        let wanted = |element: usize| flags.get(element).copied().unwrap_or(false);
        let entries = full_entries(model, &self.tension, &self.inner, &mut used, wanted)?;
        let is_kept = |full: usize| self.inner.node(full).is_some_and(|node| kept[node]);
        let reduction = Reduction::of_part(model, &self.inner, flags, is_kept, &mut used)?;
        // Those that are kept stand among the others.
        let all: Vec<usize> = reduction.free.iter().chain(&reduction.prescribed).copied().collect();
        let mut full = all.clone();
        full.sort_unstable();
        let row_of = |full_dof: usize| full.binary_search(&full_dof).ok();
        let rows: Vec<usize> = all.iter().filter_map(|i| row_of(*i)).collect();
        let matrix = |all: &Triplets| {
            let mut own = Triplets::new(full.len(), full.len());
            for (i, j, value) in all.entries() {
                for (row, a) in reduction.expand(i) {
                    for (column, b) in reduction.expand(j) {
                        own.add(rows[*row], rows[*column], value * (a * b));
                    }
                }
            }
            own.build()
        };
        let [stiffness, mass, damping] =
            [&entries.stiffness, &entries.mass, &entries.damping].map(matrix);
        // Directions out of the plane have no terms.
        let follows = |i: usize| {
            let terms = reduction.expand(i);
            let own = || terms.iter().map(|(index, share)| (rows[*index], *share)).collect();
            (used[i] && !terms.is_empty() && row_of(i).is_none()).then(|| (i, own()))
        };
        let following = (0..count).filter_map(follows).collect();
        Ok(Subset { full, following, stiffness, mass, damping })
    }

    /// True for an element whose stiffness or damping resists when all of it moves along an axis: it stands on the
    /// ground by itself.
    #[must_use]
    pub fn stands_on_ground(&self, model: &Model, element: usize) -> bool {
        let e = &model.elements[element];
        let own = sparse(e).zip(self.inner.places(element));
        let m = element_matrices(model, e, self.tension[element]).ok().flatten();
        let along = |axis: usize| {
            if model.plane.is_some_and(|plane| !plane.dofs().contains(&Dof::ALL[axis])) {
                return false;
            }
            if let Some((own, places)) = own {
                let shifts: Vec<f64> = places.iter().map(|p| self.inner.shift(*p, axis)).collect();
                let all = [Some(&own.stiffness), own.damping.as_ref()];
                return all.into_iter().flatten().any(|a| {
                    let entries = a.entries.iter();
                    resists(
                        places.len(),
                        entries.map(|(i, j, v)| (*i as usize, v * shifts[*j as usize])),
                    )
                });
            }
            let Some(m) = &m else { return false };
            let count = m.dofs.len();
            [&m.stiffness, &m.damping].into_iter().any(|a| {
                let moved = (0..count).filter(|j| m.dofs[*j].1.index() == axis);
                resists(count, moved.flat_map(|j| (0..count).map(move |i| (i, a[(i, j)]))))
            })
        };
        (0..3).any(along)
    }

    /// True for an element that has inertance: mass that neither weighs nor follows the ground.
    #[must_use]
    pub fn has_inertance(&self, model: &Model, element: usize) -> bool {
        let e = &model.elements[element];
        matches!(e.body, Body::Linear(_))
            && matches!(element_matrices(model, e, 0.0), Ok(Some(m)) if !m.inertance.is_zero())
    }
}

/// True where terms of rows add up to more than rounding.
fn resists(rows: usize, terms: impl Iterator<Item = (usize, f64)>) -> bool {
    let (mut sum, mut most) = (vec![0.0; rows], vec![0.0; rows]);
    for (row, term) in terms {
        sum[row] += term;
        most[row] += term.abs();
    }
    let norm = |x: &[f64]| x.iter().map(|a| a * a).sum::<f64>().sqrt();
    norm(&sum) > ROUNDING * norm(&most)
}
