//! Matrices of elements with many rows, by their entries.

use crate::Dof;
use std::fmt;
use std::sync::Arc;

/// A square matrix by its entries, as a file gives it.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct SparseMatrix {
    /// Name of the file as the model has it.
    pub name: String,
    /// Where the file was found; empty where the model holds what is in it.
    pub path: String,
    /// SHA-256 of the file, hexadecimal.
    pub sha256: String,
    /// Rows and columns.
    pub size: usize,
    /// Row, column and value of every entry, by rising row and in it by rising column, none twice.
    pub entries: Vec<(u32, u32, f64)>,
    /// What each row is, rising, where the file itself says so; empty where it does not.
    pub rows: Vec<MeshRow>,
}

/// A row as a file names it, ordered by node and direction.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub struct MeshRow {
    /// Number of the node in the mesh.
    pub node: u32,
    /// Its direction; none of a scalar point, such as the amplitude of a mode.
    pub dof: Option<Dof>,
}

/// As `12.1`: the node, and its direction from 1; 0 for none.
impl fmt::Display for MeshRow {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}.{}", self.node, self.dof.map_or(0, |dof| dof.index() + 1))
    }
}

impl SparseMatrix {
    /// How the file calls a row, counted here from 0: `12.1` where it says what its rows are, or its number from 1.
    #[must_use]
    pub fn row_name(&self, row: usize) -> String {
        self.rows.get(row).map_or_else(|| (row + 1).to_string(), MeshRow::to_string)
    }

    /// The entries of one row: column and value, by rising column.
    pub fn row(&self, row: usize) -> impl Iterator<Item = (usize, f64)> + '_ {
        let first = self.entries.partition_point(|e| (e.0 as usize) < row);
        let own = self.entries[first..].iter().take_while(move |e| e.0 as usize == row);
        own.map(|(_, j, v)| (*j as usize, *v))
    }

    /// Where each row begins in the entries, and the last ends; `size + 1` numbers.
    #[must_use]
    pub fn offsets(&self) -> Vec<usize> {
        let mut offsets = vec![0; self.size + 1];
        self.entries.iter().for_each(|e| offsets[e.0 as usize + 1] += 1);
        for i in 0..self.size {
            offsets[i + 1] += offsets[i];
        }
        offsets
    }

    /// The diagonal.
    #[must_use]
    pub fn diagonal(&self) -> Vec<f64> {
        let mut diagonal = vec![0.0; self.size];
        let own = self.entries.iter().filter(|(i, j, _)| i == j);
        own.for_each(|(i, _, v)| diagonal[*i as usize] = *v);
        diagonal
    }

    /// `y += A x`.
    pub fn mul_add(&self, x: &[f64], y: &mut [f64]) {
        for (i, j, v) in &self.entries {
            y[*i as usize] += v * x[*j as usize];
        }
    }
}

/// What a row of [`SparseMatrices`] is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum SparseRow {
    /// A direction of a node of the element, by its index in the element.
    Node(usize, Dof),
    /// An equation of the element's own; its direction in global axes, where it has one.
    Inner(Option<Dof>),
}

/// The matrices of an element with many rows, in global axes and SI. Rows that are no directions of its nodes become
/// equations of the system.
#[derive(Clone, Debug)]
pub struct SparseMatrices {
    /// What each row is; no direction of a node twice.
    pub rows: Vec<SparseRow>,
    /// Stiffness; symmetric, positive semi-definite.
    pub stiffness: Arc<SparseMatrix>,
    /// Mass; symmetric, positive semi-definite.
    pub mass: Option<Arc<SparseMatrix>>,
    /// Damping; symmetric, positive semi-definite.
    pub damping: Option<Arc<SparseMatrix>>,
    /// Directions of its nodes that are no rows and follow these.
    pub recovered: Vec<Recovered>,
}

/// A direction of a node that follows the rows of an element, `u = Σ share · u_row`: what moves inside a structure that
/// has been reduced. Forces on it act on the rows as its work says.
#[derive(Clone, Debug, PartialEq)]
pub struct Recovered {
    /// Index of the node in the element.
    pub node: usize,
    /// Its direction.
    pub dof: Dof,
    /// Row and share of each row that it follows.
    pub terms: Vec<(u32, f64)>,
}
