//! Recorded quantities.

use std::sync::Arc;
use trilith_element::{Card, DerivedOutput, Dof, Values, Vector3};

/// A recorded quantity.
#[derive(Clone, Debug, PartialEq)]
pub struct Output {
    /// Name.
    pub name: String,
    /// SI unit.
    pub unit: String,
    /// What it is.
    pub quantity: Quantity,
    /// Other outputs are made from it, and nothing is written of it.
    pub hidden: bool,
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
    /// factor · a force inside a member in its local axes, loads along it included: that of the deformation of the
    /// member, without dashpots, and without the inertia of a consistent mass between the nodes.
    MemberForce {
        /// Index of the element.
        element: usize,
        /// Which force.
        force: MemberForce,
        /// Where: distance from the first node, m.
        at: f64,
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
    /// A number made of outputs before it, of another crate.
    Derived(Derived),
}

/// An output of another crate.
#[derive(Clone, Debug)]
pub struct Derived {
    /// Its card.
    pub card: &'static Card,
    /// The parameters it was made from.
    pub values: Arc<Values>,
    /// What makes it.
    pub output: Arc<dyn DerivedOutput>,
    /// Indices of the outputs it is made of.
    pub of: Vec<usize>,
}

/// The same kind of the same outputs, with the same parameters.
impl PartialEq for Derived {
    fn eq(&self, other: &Self) -> bool {
        self.card.kind == other.card.kind && self.values == other.values && self.of == other.of
    }
}

/// A force inside a member, as on a cut that looks along local 1 (SAP2000's signs).
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum MemberForce {
    /// Axial force, tension positive.
    N,
    /// Shear along local 2.
    V2,
    /// Shear along local 3.
    V3,
    /// Torsion about local 1.
    T,
    /// Moment about local 2; positive where it presses on the side of positive local 3.
    M2,
    /// Moment about local 3; positive where it presses on the side of positive local 2.
    M3,
}

impl MemberForce {
    /// All, in order.
    pub const ALL: [Self; 6] = [Self::N, Self::V2, Self::V3, Self::T, Self::M2, Self::M3];
    /// Their names.
    pub const NAMES: [&'static str; 6] = ["N", "V2", "V3", "T", "M2", "M3"];

    /// Name in model files and results.
    #[must_use]
    pub const fn name(self) -> &'static str {
        Self::NAMES[self as usize]
    }

    /// True for moments.
    #[must_use]
    pub const fn is_moment(self) -> bool {
        matches!(self, Self::T | Self::M2 | Self::M3)
    }
}

/// Forces along members, of which the largest and smallest over time are kept.
#[derive(Clone, Debug, PartialEq)]
pub struct Envelope {
    /// Name.
    pub name: String,
    /// The members.
    pub members: Vec<MemberEnvelope>,
}

/// The envelope of one member: its outputs stand one after the other, the forces of the first station, then those of
/// the next one.
#[derive(Clone, Debug, PartialEq)]
pub struct MemberEnvelope {
    /// Index of the element.
    pub element: usize,
    /// Which forces.
    pub forces: Vec<MemberForce>,
    /// Where: distances from the first node, m.
    pub stations: Vec<f64>,
    /// Index of its first output.
    pub first: usize,
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
