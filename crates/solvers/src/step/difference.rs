//! How far two states of a motion are apart, and what of it counts.
//!
//! ```text
//! energy        ½ Δu̇ᵀ M Δu̇ + ½ Δuᵀ K Δu + ½ Σ |Δd Δf|        J
//! motion        √(Δuᵀ M Δu)                                    kg^½ m
//! deformation   max |Δd|        force   max |Δf|               translations and rotations apart
//! ```

use super::state::State;
use crate::kernel::ForceScale;
use crate::structure::{Motion, ReducedSystem};
use crate::vector::larger;
use serde::{Deserialize, Serialize};
use trilith_system::LinkSet;

/// Displacements, or differences of such.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub(crate) struct DisplacementNorms {
    /// √(uᵀ M u), kg^½ m.
    pub motion: f64,
    /// Largest deformation of the links: of translations and of rotations, m and rad.
    pub deformation: [f64; 2],
}

impl DisplacementNorms {
    fn parts(&self) -> [f64; 3] {
        let [translation, rotation] = self.deformation;
        [self.motion, translation, rotation]
    }

    /// The larger of each part.
    pub(crate) fn reach(&mut self, other: &Self) {
        self.motion = larger(self.motion, other.motion);
        for (x, y) in self.deformation.iter_mut().zip(other.deformation) {
            *x = larger(*x, y);
        }
    }

    /// The largest of its parts over those of another, each of which is at least a share of those of a third.
    pub(crate) fn over(&self, other: &Self, share: f64, most: &Self) -> f64 {
        let parts = self.parts().into_iter().zip(other.parts()).zip(most.parts());
        parts
            .filter(|((x, _), _)| *x > 0.0)
            .map(|((x, y), most)| x / larger(y, share * most).max(f64::MIN_POSITIVE))
            .fold(0.0, larger)
    }
}

/// What two states differ in.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Difference {
    /// Squared energy norm, the springs of the links included, J.
    pub energy: f64,
    /// Displacements.
    pub displacement: DisplacementNorms,
    /// Largest difference of link forces, and the largest forces so far.
    pub force: ForceScale,
    pub forces: ForceScale,
}

/// The displacements of a state, or how far they are from those of another.
pub(crate) fn displacement_norms(
    space: &ReducedSystem,
    links: &LinkSet,
    a: &State,
    b: Option<&State>,
    difference: &mut Motion,
) -> DisplacementNorms {
    let n = space.order();
    difference.clear();
    match b {
        Some(b) => difference.extend((0..n).map(|i| a.motion[i] - b.motion[i])),
        None => difference.extend_from_slice(&a.motion[..n]),
    }
    let motion = space.mass.bilinear(difference, difference).max(0.0).sqrt();
    let mut deformation = [0.0; 2];
    for (i, rotational) in links.rotational.iter().enumerate() {
        let of = &mut deformation[usize::from(*rotational)];
        *of = larger(*of, (a.d[i] - b.map_or(0.0, |b| b.d[i])).abs());
    }
    DisplacementNorms { motion, deformation }
}

/// How far two states are apart; `energy` of a motion by the structure.
pub(crate) fn difference_of(
    space: &ReducedSystem,
    links: &LinkSet,
    energy: impl Fn(&[f64]) -> (f64, f64),
    a: &State,
    b: &State,
    difference: &mut Motion,
) -> Difference {
    let displacement = displacement_norms(space, links, a, Some(b), difference);
    difference.clear();
    difference.extend(a.motion.iter().zip(&b.motion).map(|(x, y)| x - y));
    let (kinetic, strain) = energy(difference);
    let mut of_links = 0.0;
    let mut force: ForceScale = [0.0; 2];
    for (i, rotational) in links.rotational.iter().enumerate() {
        let change = (a.f[i] - b.f[i]).abs();
        of_links += (a.d[i] - b.d[i]).abs() * change;
        let of = &mut force[usize::from(*rotational)];
        *of = larger(*of, change);
    }
    let energy = kinetic.abs() + strain.abs() + 0.5 * of_links;
    // The largest forces so far hold those of this step.
    let forces = [0, 1].map(|kind| larger(a.scale[kind], b.scale[kind]));
    Difference { energy, displacement, force, forces }
}

impl Difference {
    /// Largest difference of link forces over the largest force of the kind so far, which counts as so much at least.
    pub(crate) fn share_of_force(&self, least: &ForceScale) -> f64 {
        let kinds = (0..2).filter(|kind| self.force[*kind] > 0.0);
        let share = |kind: usize| self.force[kind] / larger(self.forces[kind], least[kind]);
        kinds.map(share).fold(0.0, larger)
    }
}
