//! The kits of linear elements and of constraints.
//!
//! | property | claim about an element |
//! |---|---|
//! | matrices | directions that exist, listed once; finite, symmetric, positive semi-definite (the stiffness unless the element [softens](crate::LinearElement::softens)) |
//! | purity   | equal questions get equal matrices, bit for bit |
//! | rigid    | motions as a rigid body meet no stiffness, no damping and no inertance (unless it has one node, and so holds to the ground) |
//! | place    | elsewhere, and turned with its frame, it is the same (unless [`ElementKit::in_global_axes`]) |
//! | exact    | two halves in a row are the whole (where [`ElementKit::divisible`]): what a patch test asks of a member |
//!
//! | property | claim about a constraint |
//! |---|---|
//! | equations | nodes that exist, finite coefficients, each DOF goes once and is not tied to itself |
//! | purity    | equal questions get equal equations |
//! | rigid     | motions as a rigid body satisfy them, so that no force comes from nowhere (rotations unless [`ConstraintKit::only_translations`]) |
//! | place     | elsewhere they are the same |
//!
//! ```
//! use trilith_element::conformance::ElementKit;
//! # use trilith_element::*;
//! # #[derive(Debug)] struct Rod;
//! # impl LinearElement for Rod {
//! #     fn matrices(&self, at: &Geometry<'_>) -> Result<ElementMatrices, ParameterError> {
//! #         let all = [Dof::Ux, Dof::Uy, Dof::Uz];
//! #         let mut m = ElementMatrices::zeros((0..2).flat_map(|n| all.map(|d| (n, d))).collect());
//! #         let b: Vec<f64> = [-1.0, 1.0].iter().flat_map(|s| at.frame.0[0].map(|c| s * c)).collect();
//! #         let k = 1e6 / at.length();
//! #         for i in 0..6 { for j in 0..6 { m.stiffness[(i, j)] = k * b[i] * b[j] } }
//! #         Ok(m)
//! #     }
//! # }
//! // A rod, in several places; two of half its length in a row are as stiff.
//! ElementKit::new(&[[0.0; 3], [3.0, 1.0, 2.0]]).divisible().check(&Rod)?;
//! # Ok::<(), trilith_element::conformance::StructureError>(())
//! ```

mod constraint;
mod element;
mod error;
#[cfg(test)]
mod tests;

pub use constraint::ConstraintKit;
pub use element::ElementKit;
pub use error::StructureError;

use crate::{Dof, Vector3, cross};

/// Motions as a rigid body over six DOFs a node: translations, then rotations about the origin.
fn rigid_motions(nodes: &[Vector3]) -> Vec<Vec<f64>> {
    (0..6)
        .map(|which| {
            let mut axis = [0.0; 3];
            axis[which % 3] = 1.0;
            nodes
                .iter()
                .flat_map(|x| {
                    let (moved, turned) =
                        if which < 3 { (axis, [0.0; 3]) } else { (cross(axis, *x), axis) };
                    moved.into_iter().chain(turned)
                })
                .collect()
        })
        .collect()
}

fn full((node, dof): (usize, Dof)) -> usize {
    6 * node + dof.index()
}
