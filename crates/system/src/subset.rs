//! Some of the linear elements of a model by themselves, on the directions that they use: no supports, no constraints.

use crate::assemble::{element_matrices, full_entries};
use crate::inner::sparse;
use crate::{System, SystemError};
use trilith_element::Dof;
use trilith_linalg::{Sparse, Triplets};
use trilith_model::{Body, Model};

/// A share of ‖K‖ ‖r‖ below which K r is rounding, as for files of matrices.
const ROUNDING: f64 = 1e-6;

/// Matrices of some of the linear elements.
#[derive(Debug)]
pub struct Subset {
    /// The full DOF of each row, rising: 6 · node + direction, and behind those of all nodes inner rows.
    pub full: Vec<usize>,
    /// K, with the geometric stiffness of the axial forces that the system has.
    pub stiffness: Sparse,
    /// M, inertances apart.
    pub mass: Sparse,
    /// C of the elements.
    pub damping: Sparse,
}

impl System {
    /// The matrices of the elements that are flagged, by their order in the model. Directions out of the plane of a
    /// model with one are left out.
    ///
    /// # Errors
    /// [`SystemError`] where an element has no matrices.
    pub fn subset(&self, model: &Model, flags: &[bool]) -> Result<Subset, SystemError> {
        let mut used = vec![false; 6 * model.nodes.len() + self.inner.len()];
        let wanted = |element: usize| flags.get(element).copied().unwrap_or(false);
        let entries = full_entries(model, &self.tension, &self.inner, &mut used, wanted)?;
        let stays = |full: &usize| match (model.plane, self.inner.dof(*full)) {
            (Some(plane), Some(dof)) => plane.dofs().contains(&dof),
            _ => true,
        };
        let full: Vec<usize> = (0..used.len()).filter(|i| used[*i]).filter(stays).collect();
        let mut place = vec![usize::MAX; used.len()];
        full.iter().enumerate().for_each(|(new, old)| place[*old] = new);
        let matrix = |all: &Triplets| {
            let mut own = Triplets::new(full.len(), full.len());
            for (i, j, value) in all.entries() {
                if place[i] != usize::MAX && place[j] != usize::MAX {
                    own.add(place[i], place[j], value);
                }
            }
            own.build()
        };
        let [stiffness, mass, damping] =
            [&entries.stiffness, &entries.mass, &entries.damping].map(matrix);
        Ok(Subset { full, stiffness, mass, damping })
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
