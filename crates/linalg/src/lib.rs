//! Matrices of Trilith: sparse assembly, products, factorisations, eigenproblems, small dense algebra.
//! The only crate that names a matrix backend.
//!
//! | backend | does |
//! |---|---|
//! | nalgebra-sparse | storage of sparse matrices |
//! | sprs | Matrix Market export |
//! | faer | sparse LDLᵀ and LU, dense LU, symmetric eigenproblems, products of dense matrices |
//! | memmap2 | memory on large pages, for factors |
//! | pulp | products of a dense matrix and a vector, projections on tall matrices, sums over modes, extrapolations, as wide as the processor allows |
//!
//! Threads share what is large, in pieces that do not depend on their number, so that results repeat bit for bit.

mod aligned;
mod beside;
mod dense;
mod eigen;
mod expm;
mod extrapolation;
mod few;
mod gemv;
mod lanczos;
mod large;
mod ldlt;
mod lu;
mod matrix_market;
mod modewise;
mod operator;
mod panel;
mod product;
mod simd;
mod sparse;
mod tall;
pub mod threads;
mod vector;

pub use beside::{mutual_products, turn_each};
pub use dense::{Dense, DenseLu, positive_inverse};
pub use eigen::{all_modes, symmetric_eigen};
pub use expm::{expm_small, phi_functions};
pub use extrapolation::{ORDERS, extrapolate};
pub use few::solve_few;
pub use lanczos::lowest_modes;
pub use ldlt::{Ldlt, StagedLdlt, StagedPlan, unsupported};
pub use lu::SparseLu;
pub use matrix_market::matrix_market;
pub use modewise::{
    ModalStep, OwnModes, StepSums, add_products, combine, weighted_square, work_of_linear,
};
pub use operator::SymmetricOperator;
pub use panel::Panel;
pub use product::{Product, Rows};
pub use simd::vectors;
pub use sparse::{Sparse, Triplets};
pub use tall::Columns;
pub use vector::{add, dot, equal, largest, residual, sized_residual};

/// What can go wrong in a factorisation or an eigenproblem.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum LinalgError {
    /// A pivot is zero: the matrix is singular.
    #[error("the matrix is singular at equation {equation}")]
    Singular {
        /// Row of the zero pivot.
        equation: usize,
    },
    /// A number of the matrix, or one that its factorisation makes, has left the range of numbers.
    #[error(
        "numbers beyond all bounds in equation {equation}: a length, a stiffness or a mass is absurdly large beside the others"
    )]
    NotFinite {
        /// Row of the first such number, or of the pivot that it spoils.
        equation: usize,
    },
    /// The backend refused for another reason.
    #[error("the factorisation failed: {reason}")]
    Backend {
        /// What the backend said.
        reason: String,
    },
    /// An iteration did not converge.
    #[error("{what} did not converge in {iterations} iterations")]
    NotConverged {
        /// What was sought.
        what: &'static str,
        /// Iterations made.
        iterations: usize,
    },
}
