//! The model after reading: plain data in SI, everything resolved to indices and checked.

use crate::TimeFunction;
use std::ops::Range;
use std::path::PathBuf;
use trilith_element::{
    Axis, Constraint, Dimension, Dof, Frame, LinearElement, Link, Values, Vector3,
};

/// A byte range of the model file.
pub type Span = Range<usize>;

/// The text a model was read from.
#[derive(Clone, Debug, Default)]
pub struct Source {
    /// Path as given by the user.
    pub path: PathBuf,
    /// The text.
    pub text: String,
    /// SHA-256 of the text, hexadecimal.
    pub sha256: String,
}

/// A model, ready for assembly.
#[derive(Debug)]
pub struct Model {
    /// Title.
    pub title: String,
    /// Where it came from.
    pub source: Source,
    /// Restriction to a plane, if any.
    pub plane: Option<Plane>,
    /// Acceleration of gravity in m/s², acting along −Z.
    pub gravity: f64,
    /// Parameters with their final values, in file order.
    pub parameters: Vec<Parameter>,
    /// Nodes, in file order.
    pub nodes: Vec<Node>,
    /// Fixed DOFs.
    pub supports: Vec<Support>,
    /// Elements, constraints and links, in file order.
    pub elements: Vec<Element>,
    /// The damping statement.
    pub damping: Damping,
    /// Time functions, in file order.
    pub functions: Vec<Function>,
    /// Load patterns, in file order.
    pub patterns: Vec<Pattern>,
    /// Analysis cases, in file order; a case continues only cases before it.
    pub cases: Vec<Case>,
    /// What to record.
    pub outputs: Vec<Output>,
}

/// A named parameter.
#[derive(Clone, Debug)]
pub struct Parameter {
    /// Name.
    pub name: String,
    /// Value: a number in SI with its dimension, or a text (a file name).
    pub value: ParameterValue,
}

/// Value of a parameter.
#[derive(Clone, Debug, PartialEq)]
pub enum ParameterValue {
    /// A number in SI.
    Number(f64, Dimension),
    /// A text.
    Text(String),
}

/// A plane model: the three DOFs out of the plane are fixed at every node.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Plane {
    /// Ux, Uz, Ry.
    XZ,
    /// Uy, Uz, Rx.
    YZ,
    /// Ux, Uy, Rz.
    XY,
}

impl Plane {
    /// The DOFs that stay.
    #[must_use]
    pub fn dofs(self) -> [Dof; 3] {
        match self {
            Self::XZ => [Dof::Ux, Dof::Uz, Dof::Ry],
            Self::YZ => [Dof::Uy, Dof::Uz, Dof::Rx],
            Self::XY => [Dof::Ux, Dof::Uy, Dof::Rz],
        }
    }
}

/// A node.
#[derive(Clone, Debug)]
pub struct Node {
    /// Name.
    pub name: String,
    /// Position, m.
    pub position: Vector3,
    /// Where the file defines it.
    pub span: Span,
}

/// Fixed DOFs of a node.
#[derive(Clone, Debug)]
pub struct Support {
    /// Index of the node.
    pub node: usize,
    /// Fixed directions, in the order of [`Dof::ALL`].
    pub fixed: [bool; 6],
    /// Where the file says so.
    pub span: Span,
}

/// A member of the structure.
#[derive(Debug)]
pub struct Element {
    /// Name.
    pub name: String,
    /// Kind, such as `Beam`.
    pub kind: &'static str,
    /// Indices of its nodes.
    pub nodes: Vec<usize>,
    /// Local axes.
    pub frame: Frame,
    /// What it is.
    pub body: Body,
    /// Where the file defines it.
    pub span: Span,
    /// The parameters of its kind in SI, defaults filled in, in the order of the card.
    pub values: Values,
    /// Directions of local axes 1 and 2 as the file gives them.
    pub axes: [Option<Vector3>; 2],
}

/// What a member is.
#[derive(Debug)]
pub enum Body {
    /// Adds to M, C, K.
    Linear(Box<dyn LinearElement>),
    /// Eliminates DOFs.
    Constraint(Box<dyn Constraint>),
    /// A nonlinear link.
    Link(Box<dyn Link>, LinkOptions),
}

/// What every link may say beside its law.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct LinkOptions {
    /// Effective stiffness of the linear dummy per coordinate of the law, set by the user (N/m or
    /// N·m/rad); `None`: chosen by the program.
    pub effective_stiffness: Option<Vec<f64>>,
    /// Where the shear deformation is measured, as distance from node j, m.
    pub shear_at: f64,
}

/// Damping of the structure, links and dashpots apart.
#[derive(Clone, Debug, Default, PartialEq)]
pub enum Damping {
    /// None.
    #[default]
    None,
    /// The same ratio in every mode of the structure (links excluded).
    Modal {
        /// Ratio to critical.
        ratio: f64,
    },
    /// Ratios interpolated linearly in frequency between points, constant beyond the ends.
    ModalTable {
        /// (frequency in Hz, ratio), frequencies rising.
        points: Vec<(f64, f64)>,
    },
    /// C = mass·M + stiffness·K, K of the structure without links.
    Rayleigh {
        /// Coefficient of M, 1/s.
        mass: f64,
        /// Coefficient of K, s.
        stiffness: f64,
    },
}

/// A named time function.
#[derive(Clone, Debug)]
pub struct Function {
    /// Name.
    pub name: String,
    /// The function.
    pub function: TimeFunction,
    /// Dimension of its values; `None` for plain numbers without unit, which stand for the dimension
    /// that is wanted where the function is used.
    pub dimension: Option<Dimension>,
}

/// A named set of nodal forces.
#[derive(Clone, Debug)]
pub struct Pattern {
    /// Name.
    pub name: String,
    /// The forces.
    pub forces: Vec<NodalForce>,
}

/// A force or moment at a node.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct NodalForce {
    /// Index of the node.
    pub node: usize,
    /// Direction.
    pub dof: Dof,
    /// N or N·m.
    pub value: f64,
}

/// A load that a static case applies, or a dynamic case holds constant.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Load {
    /// Weight of all masses along −Z.
    Gravity {
        /// Multiple of the weight.
        factor: f64,
    },
    /// A pattern.
    Pattern {
        /// Index of the pattern.
        pattern: usize,
        /// Multiple of it.
        factor: f64,
    },
}

/// An analysis case.
#[derive(Clone, Debug)]
pub struct Case {
    /// Name.
    pub name: String,
    /// The case whose end state it continues: displacements, link history and loads are carried on.
    pub after: Option<usize>,
    /// What is analysed.
    pub analysis: Analysis,
    /// Where the file defines it.
    pub span: Span,
}

/// What a case does.
#[derive(Clone, Debug)]
pub enum Analysis {
    /// Nonlinear static analysis.
    Static(StaticCase),
    /// Dynamic analysis.
    Dynamic(Box<DynamicCase>),
}

/// Nonlinear static analysis: loads grow from zero (or from the case before) to their value.
#[derive(Clone, Debug, PartialEq)]
pub struct StaticCase {
    /// Loads added in this case.
    pub loads: Vec<Load>,
    /// Load steps asked for; halved where they do not converge.
    pub steps: usize,
}

/// Dynamic analysis in time.
#[derive(Clone, Debug)]
pub struct DynamicCase {
    /// Length, s.
    pub duration: f64,
    /// Output step, s; the march substeps inside it by itself.
    pub dt: f64,
    /// Loads held constant from the start, beside those carried on from the case before.
    pub constant: Vec<Load>,
    /// Uniform base acceleration: displacements are then relative to the base.
    pub base: Vec<BaseMotion>,
    /// Patterns times functions.
    pub forces: Vec<ForceHistory>,
    /// Imposed displacements of supports.
    pub supports: Vec<SupportMotion>,
    /// Initial values at nodes, replacing those of the case before where given.
    pub initial: Vec<Initial>,
    /// How to solve it.
    pub solution: Solution,
}

/// One component of the uniform base acceleration.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct BaseMotion {
    /// Direction of positive acceleration: Ux, Uy or Uz.
    pub direction: Dof,
    /// Index of the function, m/s².
    pub function: usize,
    /// Factor.
    pub factor: f64,
}

/// A pattern that varies in time.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ForceHistory {
    /// Index of the pattern.
    pub pattern: usize,
    /// Index of the function, a pure number.
    pub function: usize,
    /// Factor.
    pub factor: f64,
}

/// Imposed displacement of one supported DOF.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SupportMotion {
    /// Index of the node.
    pub node: usize,
    /// Direction; must be fixed by a support.
    pub dof: Dof,
    /// Index of the function, m or rad.
    pub function: usize,
    /// Factor.
    pub factor: f64,
}

/// Initial displacement and velocity of one DOF.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Initial {
    /// Index of the node.
    pub node: usize,
    /// Direction.
    pub dof: Dof,
    /// m or rad.
    pub displacement: Option<f64>,
    /// m/s or rad/s.
    pub velocity: Option<f64>,
}

/// How a dynamic case is solved.
#[derive(Clone, Debug, PartialEq)]
pub struct Solution {
    /// Solver that runs where the command line names none.
    pub solver: SolverKind,
    /// Step control.
    pub step: StepControl,
    /// Solution of the link equations.
    pub kernel: Kernel,
    /// Largest share of the energy that may be unaccounted for before the run says so.
    pub energy_limit: f64,
    /// Settings of FNA and of other solvers on a Ritz basis.
    pub basis: Basis,
    /// HHT parameter α ∈ [−1/3, 0].
    pub alpha: f64,
}

impl Default for Solution {
    fn default() -> Self {
        Self {
            solver: SolverKind::Fna,
            step: StepControl::default(),
            kernel: Kernel::Newton,
            energy_limit: 1e-3,
            basis: Basis::default(),
            alpha: 0.0,
        }
    }
}

/// The solvers.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum SolverKind {
    /// Ritz basis, modal recurrences exact for loads linear in the step.
    Fna,
    /// All DOFs, HHT-α.
    Hht,
    /// Ritz basis, HHT-α.
    RitzHht,
    /// All DOFs, HHT-α with the tangent assembled and factorised in every iteration.
    FullNewton,
}

impl SolverKind {
    /// All, in order.
    pub const ALL: [Self; 4] = [Self::Fna, Self::Hht, Self::RitzHht, Self::FullNewton];

    /// Name on the command line and in results.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::Fna => "fna",
            Self::Hht => "hht",
            Self::RitzHht => "ritz-hht",
            Self::FullNewton => "full-newton",
        }
    }
}

/// Step control.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum StepControl {
    /// Substeps chosen so that the local error stays below the tolerance.
    Adaptive {
        /// Error of a step in the energy norm, relative to the largest energy so far (square root).
        tolerance: f64,
    },
    /// The output step cut into this many equal substeps; halved only where a step does not converge.
    Fixed {
        /// Substeps per output step.
        substeps: usize,
    },
}

impl Default for StepControl {
    fn default() -> Self {
        Self::Adaptive { tolerance: 1e-4 }
    }
}

/// Solution of the link equations in a step.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Kernel {
    /// Newton with the full tangents of the laws.
    Newton,
    /// Wilson's constant-stiffness iteration.
    FixedPoint,
}

/// Basis of FNA.
#[derive(Clone, Debug, PartialEq)]
pub struct Basis {
    /// Which vectors.
    pub kind: BasisKind,
    /// How many; `None`: chosen by the program.
    pub vectors: Option<usize>,
    /// Flexibility of every link coordinate that the basis must hold, as share of the exact one.
    pub adequacy: f64,
}

impl Default for Basis {
    fn default() -> Self {
        Self { kind: BasisKind::Ritz, vectors: None, adequacy: 0.99 }
    }
}

/// Kind of basis.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum BasisKind {
    /// Load-dependent Ritz vectors and one static vector per link coordinate.
    Ritz,
    /// Exact eigenvectors and one static vector per link coordinate.
    Eigen,
    /// All eigenvectors: the complete basis.
    Complete,
}

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
    /// factor · force of a link.
    LinkForce {
        /// Index of the element.
        element: usize,
        /// Coordinate of the law.
        coordinate: usize,
        /// Factor.
        factor: f64,
    },
    /// A history variable of a link.
    LinkHistory {
        /// Index of the element.
        element: usize,
        /// Index of the variable.
        field: usize,
    },
    /// factor · global end force that a linear element exerts on one of its nodes' DOFs (K u + C u̇ of the element).
    ElementForce {
        /// Index of the element.
        element: usize,
        /// Index into its nodes.
        end: usize,
        /// Direction.
        dof: Dof,
        /// Factor.
        factor: f64,
    },
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

impl Model {
    /// Index of a case by name.
    #[must_use]
    pub fn case(&self, name: &str) -> Option<usize> {
        self.cases.iter().position(|c| c.name == name)
    }

    /// The local axes that a link coordinate runs along, for names in results.
    #[must_use]
    pub fn coordinate_name(axis: Axis) -> &'static str {
        axis.name()
    }
}
