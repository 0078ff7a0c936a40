//! The model after reading: plain data in SI, everything resolved to indices and checked.

use crate::sections::Shape;
use crate::{
    Analysis, Case, Combination, CustomSolver, Envelope, FloorSpectrum, Output, Places,
    TimeFunction,
};
use sha2::{Digest, Sha256};
use std::ops::Range;
use std::path::PathBuf;
use std::sync::Arc;
use trilith_element::{
    Axis, Constraint, Dimension, Dof, Frame, Geometry, LinearElement, Link, Member, NodalOutline,
    SpanLoad, Values, Vector3,
};

/// A byte range of the model file, or what [`Places`] leads back to one.
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
    /// Where the spans of its parts lead, in that file and in those that it includes.
    pub places: Places,
    /// The other files that were read: records and tables.
    pub files: Vec<PathBuf>,
    /// Restriction to a plane, if any.
    pub plane: Option<Plane>,
    /// Acceleration of gravity in m/s², acting along −Z.
    pub gravity: f64,
    /// Parameters with their final values, in file order.
    pub parameters: Vec<Parameter>,
    /// Nodes, in file order.
    pub nodes: Vec<Node>,
    /// The static case whose axial forces stiffen or soften the structure in every case (P-Δ).
    pub p_delta: Option<usize>,
    /// Fixed DOFs.
    pub supports: Vec<Support>,
    /// Elements, constraints and links, in file order.
    pub elements: Vec<Element>,
    /// Named groups of nodes and of elements, in file order.
    pub groups: Vec<Group>,
    /// The damping statement.
    pub damping: Damping,
    /// Time functions, in file order.
    pub functions: Vec<Function>,
    /// Load patterns, in file order.
    pub patterns: Vec<Pattern>,
    /// Analysis cases, in file order; a case continues only cases before it.
    pub cases: Vec<Case>,
    /// Combinations of cases, in file order; one takes only those before it.
    pub combinations: Vec<Combination>,
    /// Solvers of other crates: those that cases name, and those of the registry that need no parameter.
    pub solvers: Vec<CustomSolver>,
    /// What to record.
    pub outputs: Vec<Output>,
    /// Response spectra of recorded accelerations.
    pub spectra: Vec<FloorSpectrum>,
    /// Envelopes of forces along members.
    pub envelopes: Vec<Envelope>,
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
    pub values: Arc<Values>,
    /// Directions of local axes 1 and 2 as the file gives them.
    pub axes: [Option<Vector3>; 2],
    /// What its cross-section looks like, where it has a section that says so; for pictures alone.
    pub section: Option<Shape>,
}

/// Nodes or elements that one name stands for.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Group {
    /// Name.
    pub name: String,
    /// True for nodes, false for elements.
    pub of_nodes: bool,
    /// Their indices.
    pub members: Vec<usize>,
}

/// What a member is.
#[derive(Debug)]
pub enum Body {
    /// Adds to M, C, K.
    Linear(Arc<dyn LinearElement>),
    /// Eliminates DOFs.
    Constraint(Box<dyn Constraint>),
    /// A nonlinear link.
    Link(Arc<dyn Link>, LinkOptions),
}

/// What every link may say beside its law.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct LinkOptions {
    /// Effective stiffness of the linear dummy per coordinate of the law, set by the user (N/m or
    /// N·m/rad); `None`: chosen by the program.
    pub effective_stiffness: Option<Vec<f64>>,
    /// Where the shear deformation is measured, as distance from node j, m.
    pub shear_at: f64,
    /// Shares of the moment of the axial force over the shear (P-Δ) at the first and the second node; the ground counts
    /// as the first. What is left is a couple of shears between nodes apart. `None`: no such moment.
    pub p_delta_at: Option<[f64; 2]>,
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

/// A named set of forces.
#[derive(Clone, Debug)]
pub struct Pattern {
    /// Name.
    pub name: String,
    /// Forces at nodes.
    pub forces: Vec<NodalForce>,
    /// Loads along members.
    pub members: Vec<MemberLoad>,
}

/// A load along a member.
#[derive(Clone, Debug, PartialEq)]
pub struct MemberLoad {
    /// Index of the element.
    pub element: usize,
    /// What acts, in its local axes.
    pub load: SpanLoad,
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

/// SHA-256, hexadecimal.
pub(crate) fn sha256(bytes: &[u8]) -> String {
    Sha256::digest(bytes).iter().map(|b| format!("{b:02x}")).collect()
}

impl Element {
    /// What an element or a constraint looks like in pictures, where it says so; `nodes` are those of its model.
    #[must_use]
    pub fn outline(&self, nodes: &[Node]) -> Option<NodalOutline> {
        let places: Vec<Vector3> = self.nodes.iter().map(|n| nodes[*n].position).collect();
        let outline = match &self.body {
            Body::Linear(element) => element.outline(&Geometry::new(&places, self.frame)),
            Body::Constraint(constraint) => constraint.outline(&places),
            Body::Link(..) => None,
        };
        outline?.checked(places.len())
    }
}

impl Model {
    /// The files that the model file includes.
    pub fn included(&self) -> impl Iterator<Item = &Source> {
        self.places.files().skip(1).map(|source| &**source)
    }

    /// All files that it was read from: the model file, those that it includes, records and tables.
    #[must_use]
    pub fn inputs(&self) -> Vec<PathBuf> {
        let own = self.places.files().map(|source| source.path.clone());
        own.chain(self.files.iter().cloned()).collect()
    }

    /// What tells its text from that of another model: SHA-256 of the model file, hexadecimal; where it includes files,
    /// of the list of the sums of all.
    #[must_use]
    pub fn sha256(&self) -> String {
        let mut all = self.places.files().map(|source| source.sha256.as_str());
        match (all.next(), all.next()) {
            (Some(only), None) => only.to_owned(),
            _ => {
                let sums: Vec<&str> = self.places.files().map(|s| s.sha256.as_str()).collect();
                sha256(sums.join("\n").as_bytes())
            }
        }
    }

    /// The outputs that are written, each with its index.
    pub fn shown(&self) -> impl Iterator<Item = (usize, &Output)> + Clone {
        self.outputs.iter().enumerate().filter(|(_, o)| !o.hidden)
    }

    /// All loads that a case holds at its end: its own constant ones, and those of the cases that it continues.
    #[must_use]
    pub fn held_loads(&self, case: &Case) -> Vec<Load> {
        let chain = std::iter::successors(Some(case), |c| c.after.map(|i| &self.cases[i]));
        let own = |c: &Case| match &c.analysis {
            Analysis::Static(s) => s.loads.clone(),
            Analysis::Dynamic(d) => d.constant.clone(),
        };
        chain.flat_map(own).collect()
    }

    /// An element as a member, where it is one.
    #[must_use]
    pub fn member(&self, element: usize) -> Option<&dyn Member> {
        match &self.elements.get(element)?.body {
            Body::Linear(e) => e.member(),
            _ => None,
        }
    }

    /// Index of a case by name.
    #[must_use]
    pub fn case(&self, name: &str) -> Option<usize> {
        self.cases.iter().position(|c| c.name == name)
    }

    /// Index of an output by name.
    #[must_use]
    pub fn output(&self, name: &str) -> Option<usize> {
        self.outputs.iter().position(|o| o.name == name)
    }

    /// The local axes that a link coordinate runs along, for names in results.
    #[must_use]
    pub fn coordinate_name(axis: Axis) -> &'static str {
        axis.name()
    }
}
