//! Linear elements: what adds to K, M and C once.

use crate::{Dof, Geometry, Member, NodalOutline, ParameterError, SparseMatrices};
use std::fmt::Debug;

/// A small dense square matrix, row by row.
#[derive(Clone, Debug, PartialEq)]
pub struct SquareMatrix {
    size: usize,
    values: Vec<f64>,
}

impl SquareMatrix {
    /// Zero matrix of `size` rows.
    #[must_use]
    pub fn zeros(size: usize) -> Self {
        Self { size, values: vec![0.0; size * size] }
    }

    /// Rows and columns.
    #[must_use]
    pub fn size(&self) -> usize {
        self.size
    }

    /// The values, row by row; length `size²`.
    #[must_use]
    pub fn values(&self) -> &[f64] {
        &self.values
    }

    /// True where no value differs from zero.
    #[must_use]
    pub fn is_zero(&self) -> bool {
        self.values.iter().all(|x| *x == 0.0)
    }
}

impl std::ops::Index<(usize, usize)> for SquareMatrix {
    type Output = f64;
    fn index(&self, (i, j): (usize, usize)) -> &f64 {
        &self.values[i * self.size + j]
    }
}

impl std::ops::IndexMut<(usize, usize)> for SquareMatrix {
    fn index_mut(&mut self, (i, j): (usize, usize)) -> &mut f64 {
        &mut self.values[i * self.size + j]
    }
}

/// The matrices of one element in global axes; rows and columns follow `dofs`.
#[derive(Clone, Debug)]
#[non_exhaustive]
pub struct ElementMatrices {
    /// Index into the element's nodes, and direction, of each row.
    pub dofs: Vec<(usize, Dof)>,
    /// Stiffness in N/m, N, N·m; symmetric, and positive semi-definite unless the element
    /// [softens](LinearElement::softens) or carries an axial force.
    pub stiffness: SquareMatrix,
    /// Mass in kg, kg·m, kg·m²; symmetric, positive semi-definite.
    pub mass: SquareMatrix,
    /// Damping in N·s/m …; symmetric, positive semi-definite.
    pub damping: SquareMatrix,
    /// Inertance in kg, kg·m, kg·m²; symmetric, positive semi-definite. It adds to the mass in the
    /// equation of motion, but has no weight, and a motion of the ground puts no load on it.
    pub inertance: SquareMatrix,
}

impl ElementMatrices {
    /// All zero, for these rows.
    #[must_use]
    pub fn zeros(dofs: Vec<(usize, Dof)>) -> Self {
        let n = dofs.len();
        Self {
            dofs,
            stiffness: SquareMatrix::zeros(n),
            mass: SquareMatrix::zeros(n),
            damping: SquareMatrix::zeros(n),
            inertance: SquareMatrix::zeros(n),
        }
    }
}

/// Adds to M, C, K in global axes, once: beams, trusses, springs, masses.
pub trait LinearElement: Send + Sync + Debug {
    /// The matrices of the element at this geometry. A DOF that gets neither stiffness nor mass nor
    /// damping should not be listed: the system takes a listed DOF for one that the element uses.
    ///
    /// # Errors
    /// [`ParameterError`] where geometry and parameters do not suit each other.
    fn matrices(&self, at: &Geometry<'_>) -> Result<ElementMatrices, ParameterError>;

    /// Matrices of an element with many rows, beside [`matrices`](Self::matrices), which then lists no direction; `None`
    /// for an element that has no others.
    fn sparse(&self) -> Option<&SparseMatrices> {
        None
    }

    /// True for an element that is meant to take stiffness from the structure, as a spring that buckles does: its own
    /// need not be positive semi-definite. What all elements hold together must be.
    fn softens(&self) -> bool {
        false
    }

    /// The element as a member that loads may act on between its two nodes; `None` where it is none. Its forces in
    /// local axes are then recorded at any place along it.
    fn member(&self) -> Option<&dyn Member> {
        None
    }

    /// What it looks like in a picture. One between two nodes that does not say is drawn as a line, others not at all.
    fn outline(&self, _at: &Geometry<'_>) -> Option<NodalOutline> {
        None
    }
}
