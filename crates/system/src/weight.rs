//! Mass of a model as it stands: how much, where, and how it may move as a rigid body.
//!
//! ```text
//!   F = M r        r: everything moved by one unit along X, Y or Z
//!   m = rᵀ F       centre: where one force F has the moment that all of them have
//! ```

use crate::System;
use crate::assemble::element_matrices;
use crate::inner::sparse;
use trilith_element::{Vector3, cross};
use trilith_model::Model;

/// A part of ‖K‖ ‖r‖ below which K r is rounding.
const ROUNDING: f64 = 1e-9;

/// All masses of a model, supports included and inertances apart.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct MassSum {
    /// Along X, Y and Z, kg.
    pub mass: [f64; 3],
    /// Their centre, m; of a model without mass the mean of its nodes.
    pub centre: Vector3,
    /// Of the mass along Z that of directions which supports hold, kg.
    pub on_supports: f64,
}

/// The motions of a body that is rigid.
pub const RIGID: [&str; 6] = ["X", "Y", "Z", "about X", "about Y", "about Z"];

impl System {
    /// Mass that a unit acceleration along an axis (0: X, …) moves in the free directions, without inertances, kg.
    #[must_use]
    pub fn mass_along(&self, axis: usize) -> f64 {
        let own = self.reduction.free.iter().zip(&self.inertia[axis]);
        own.map(|(full, m)| self.inner.shift(*full, axis) * m).sum()
    }

    /// Sums up the masses of all elements.
    #[must_use]
    pub fn mass_sum(&self, model: &Model) -> MassSum {
        let (mut mass, mut moment) = ([0.0; 3], [[0.0; 3]; 3]);
        let mut on_supports = 0.0;
        for (element, e) in model.elements.iter().enumerate() {
            if let Some((own, places)) = sparse(e).zip(self.inner.places(element)) {
                let Some(of_mass) = &own.mass else { continue };
                for along in 0..3 {
                    let shifts: Vec<f64> =
                        places.iter().map(|full| self.inner.shift(*full, along)).collect();
                    let mut forces = vec![0.0; places.len()];
                    of_mass.mul_add(&shifts, &mut forces);
                    for ((full, shift), force) in places.iter().zip(&shifts).zip(forces) {
                        mass[along] += shift * force;
                        for (axis, sum) in moment[along].iter_mut().enumerate() {
                            *sum += self.inner.turn(model, *full, axis, [0.0; 3]) * force;
                        }
                        if along == 2 && self.reduction.expand(*full).is_empty() {
                            on_supports += shift * force;
                        }
                    }
                }
                continue;
            }
            let Ok(Some(m)) = element_matrices(model, e, 0.0) else { continue };
            if m.mass.is_zero() {
                continue;
            }
            for (i, (node, dof)) in m.dofs.iter().enumerate() {
                let node = e.nodes[*node];
                for along in 0..3 {
                    let moved = m.dofs.iter().enumerate().filter(|(_, d)| d.1.index() == along);
                    let force: f64 = moved.map(|(j, _)| m.mass[(i, j)]).sum();
                    let mut f = [0.0; 3];
                    if dof.is_rotation() {
                        moment[along][dof.index() - 3] += force;
                        continue;
                    }
                    f[dof.index()] = force;
                    if dof.index() == along {
                        mass[along] += force;
                        let full = 6 * node + dof.index();
                        if along == 2 && self.reduction.expand(full).is_empty() {
                            on_supports += force;
                        }
                    }
                    let arm = cross(model.nodes[node].position, f);
                    moment[along].iter_mut().zip(arm).for_each(|(sum, x)| *sum += x);
                }
            }
        }
        MassSum { mass, centre: centre(model, mass, moment), on_supports }
    }

    /// Which of the motions of a rigid body (as [`RIGID`] counts them, turns about a point) `stiffness` lets everything
    /// that is free make; one that comes of those before is left out.
    #[must_use]
    pub fn rigid_freedoms(
        &self,
        model: &Model,
        stiffness: &trilith_linalg::Sparse,
        about: Vector3,
    ) -> Vec<usize> {
        let mut found: Vec<(usize, Vec<f64>)> = Vec::new();
        for motion in 0..RIGID.len() {
            let mut r = self.rigid_motion(model, motion, about);
            let size = norm(&r);
            for (_, other) in &found {
                let share: f64 = r.iter().zip(other).map(|(a, b)| a * b).sum();
                r.iter_mut().zip(other).for_each(|(x, y)| *x -= share * y);
            }
            let left = norm(&r);
            // Lengths of the model are of the size of a metre, or of thousands.
            if left <= ROUNDING * size || size == 0.0 {
                continue;
            }
            r.iter_mut().for_each(|x| *x /= left);
            let mut bound = vec![0.0; r.len()];
            for (i, j, k) in stiffness.entries() {
                bound[i] += (k * r[j]).abs();
            }
            if norm(&stiffness.mul(&r)) <= ROUNDING * norm(&bound) {
                found.push((motion, r));
            }
        }
        found.into_iter().map(|(motion, _)| motion).collect()
    }

    /// A motion of a rigid body on the free DOFs.
    fn rigid_motion(&self, model: &Model, motion: usize, about: Vector3) -> Vec<f64> {
        let (turns, axis) = (motion >= 3, motion % 3);
        let at = |full: &usize| match turns {
            true => self.inner.turn(model, *full, axis, about),
            false => self.inner.shift(*full, axis),
        };
        self.reduction.free.iter().map(at).collect()
    }
}

fn norm(x: &[f64]) -> f64 {
    x.iter().map(|a| a * a).sum::<f64>().sqrt()
}

/// Where forces with these moments about the origin act, each along its axis; the mean of the nodes where there are none.
fn centre(model: &Model, mass: [f64; 3], moment: [[f64; 3]; 3]) -> Vector3 {
    let count = model.nodes.len().max(1) as f64;
    let mean = |i: usize| model.nodes.iter().map(|n| n.position[i]).sum::<f64>() / count;
    let mut centre = [0, 1, 2].map(mean);
    let [x, y, z] = mass;
    // x × F: a force along Z at (x, y) has (y, −x, 0), one along X at height z has (0, z, −y).
    if z > 0.0 {
        (centre[0], centre[1]) = (-moment[2][1] / z, moment[2][0] / z);
    } else if y > 0.0 {
        centre[0] = moment[1][2] / y;
    }
    if x > 0.0 {
        centre[2] = moment[0][1] / x;
        if z <= 0.0 {
            centre[1] = -moment[0][2] / x;
        }
    } else if y > 0.0 {
        centre[2] = -moment[1][0] / y;
    }
    centre
}
