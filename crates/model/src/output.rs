//! Recorded quantities.

use trilith_element::{Dof, Vector3};

/// A recorded quantity.
#[derive(Clone, Debug, PartialEq)]
pub struct Output {
    /// Name.
    pub name: String,
    /// SI unit.
    pub unit: String,
    /// What it is.
    pub quantity: Quantity,
}

/// What is recorded.
#[derive(Clone, Debug, PartialEq)]
pub enum Quantity {
    /// Σ factor · displacement.
    Displacement(Vec<NodalTerm>),
    /// Σ factor · velocity.
    Velocity(Vec<NodalTerm>),
    /// Σ factor · acceleration; absolute: with the base acceleration added.
    Acceleration {
        /// Terms.
        terms: Vec<NodalTerm>,
        /// Add the base acceleration.
        absolute: bool,
    },
    /// factor · deformation of a link.
    LinkDeformation {
        /// Index of the element.
        element: usize,
        /// Coordinate of the law (position in its coordinates).
        coordinate: usize,
        /// Factor.
        factor: f64,
    },
    /// Σ factor · force of a link.
    LinkForce(Vec<LinkTerm>),
    /// A history variable of a link.
    LinkHistory {
        /// Index of the element.
        element: usize,
        /// Index of the variable.
        field: usize,
    },
    /// factor · Σ global end force that linear elements exert on one of their nodes' DOFs (K u + C u̇ of the element).
    ElementForce {
        /// Indices of the elements.
        elements: Vec<usize>,
        /// Index into their nodes.
        end: usize,
        /// Direction.
        dof: Dof,
        /// Factor.
        factor: f64,
    },
    /// Horizontal force that the structure passes to its supports and to the ground.
    BaseShear {
        /// Ux or Uy.
        direction: Dof,
    },
    /// Moment about a point of what the structure passes to its supports and to the ground; positive as of a force
    /// along the direction above that point.
    Overturning {
        /// Ux or Uy.
        direction: Dof,
        /// The point, m.
        about: Vector3,
    },
    /// factor · Σ force of supports on the structure along one direction that they fix: K u + C u̇ of the elements there
    /// and the forces of links. What acts on these directions themselves is not in it.
    Reaction {
        /// Indices of the nodes.
        nodes: Vec<usize>,
        /// Direction.
        dof: Dof,
        /// Factor.
        factor: f64,
    },
    /// Outputs before it, put together.
    Combination {
        /// How.
        how: Combine,
        /// Added to a sum; 0 otherwise.
        constant: f64,
        /// (index of the output, factor).
        terms: Vec<(usize, f64)>,
    },
}

/// How outputs are put together, each times its factor.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Combine {
    /// Their sum.
    Sum,
    /// Root of the sum of their squares.
    Norm,
    /// The largest.
    Largest,
    /// The smallest.
    Smallest,
}

impl Combine {
    /// The names in model files, in the order of the kinds.
    pub const NAMES: [&'static str; 4] = ["Sum", "Norm", "Largest", "Smallest"];
    /// All kinds.
    pub const ALL: [Self; 4] = [Self::Sum, Self::Norm, Self::Largest, Self::Smallest];
}

/// One term of a nodal output.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct NodalTerm {
    /// Index of the node.
    pub node: usize,
    /// Direction.
    pub dof: Dof,
    /// Factor.
    pub factor: f64,
}

/// One term of a force of links.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LinkTerm {
    /// Index of the element.
    pub element: usize,
    /// Coordinate of the law.
    pub coordinate: usize,
    /// Factor.
    pub factor: f64,
}

/// The response spectrum of what an output records: how much equipment at that place is shaken.
#[derive(Clone, Debug, PartialEq)]
pub struct FloorSpectrum {
    /// Name.
    pub name: String,
    /// Index of the output: an absolute acceleration.
    pub output: usize,
    /// Damping of the oscillators, shares of critical.
    pub damping: Vec<f64>,
    /// Their periods, s.
    pub periods: Vec<f64>,
}
