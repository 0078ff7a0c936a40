//! Cards: what a kind of element is called, which parameters it takes, and where its law comes from.

use crate::dimension::{FORCE, LENGTH, MOMENT, NONE, ROTATIONAL_STIFFNESS, STIFFNESS};
use crate::{Dimension, ParameterError};
use serde::de::DeserializeOwned;

/// The description of one kind. The model reader checks a file against it and the catalogue prints it.
///
/// ```
/// use trilith_element::{Card, Category, NodeCount, Parameters};
///
/// #[derive(Parameters)]
/// struct Stop {
///     /// stiffness of the stop
///     #[parameter("k", unit = "N/m", range = Positive)]
///     k: f64,
///     /// clearance on both sides
///     #[parameter("g", unit = "m", range = NonNegative, default = 0.0)]
///     gap: f64,
/// }
///
/// const CARD: Card = Card::new("Stop", Category::Link, "Bilateral stop of equal clearances.")
///     .nodes(NodeCount::GROUND_OR_TWO)
///     .parameters(Stop::PARAMETERS)
///     .law("f = k (d − g) where d > g, k (d + g) where d < −g, else 0")
///     .source("first principles")
///     .example(r#""stop": Stop(nodes: ("a", "b"), k: "50 kN/m", gap: "2 cm")"#);
/// assert_eq!(CARD.parameter("gap").map(|p| p.symbol), Some("g"));
/// ```
#[derive(Clone, Copy, Debug)]
#[non_exhaustive]
pub struct Card {
    /// Name in model files, such as `NLink`.
    pub kind: &'static str,
    /// Which contract it fulfils.
    pub category: Category,
    /// One sentence: what it is.
    pub summary: &'static str,
    /// How many nodes it takes.
    pub nodes: NodeCount,
    /// The parameters, in the order in which they should be shown.
    pub parameters: &'static [Parameter],
    /// The law in Unicode, several lines.
    pub law: &'static str,
    /// Where the law comes from.
    pub source: &'static str,
    /// One line of a model file that uses it.
    pub example: &'static str,
    /// For links: the deformation that shows the law with the parameters of the example.
    pub exercise: Exercise,
}

/// An imposed cyclic deformation that shows what a link does; the catalogue draws it.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub struct Exercise {
    /// Cycles in a second, Hz.
    pub frequency: f64,
    /// One for each coordinate of the law.
    pub strokes: &'static [Stroke],
}

impl Exercise {
    /// For linear elements and constraints.
    pub const NONE: Self = Self { frequency: 1.0, strokes: &[] };

    /// Cycles of a frequency (Hz): a stroke for each coordinate of the law.
    #[must_use]
    pub const fn new(frequency: f64, strokes: &'static [Stroke]) -> Self {
        Self { frequency, strokes }
    }
}

/// Motion of one coordinate: `mean + amplitude · sin 2π(f t + phase)`.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub struct Stroke {
    /// Constant part, m or rad, applied before the cycles.
    pub mean: f64,
    /// Amplitude of the largest cycle, m or rad.
    pub amplitude: f64,
    /// Phase in cycles: 0.25 for an orbit with a coordinate of phase 0.
    pub phase: f64,
}

impl Stroke {
    /// Cycles in phase about a mean.
    #[must_use]
    pub const fn about(mean: f64, amplitude: f64) -> Self {
        Self { mean, amplitude, phase: 0.0 }
    }

    /// With a phase, in cycles.
    #[must_use]
    pub const fn with_phase(mut self, phase: f64) -> Self {
        self.phase = phase;
        self
    }
}

impl Card {
    /// A kind of this name, of this contract: one sentence says what it is.
    #[must_use]
    pub const fn new(kind: &'static str, category: Category, summary: &'static str) -> Self {
        Self {
            kind,
            category,
            summary,
            nodes: NodeCount::NONE,
            parameters: &[],
            law: "",
            source: "",
            example: "",
            exercise: Exercise::NONE,
        }
    }

    /// Under another name.
    #[must_use]
    pub const fn named(mut self, kind: &'static str) -> Self {
        self.kind = kind;
        self
    }

    /// With how many nodes it takes; none without.
    #[must_use]
    pub const fn nodes(mut self, nodes: NodeCount) -> Self {
        self.nodes = nodes;
        self
    }

    /// With its parameters, in the order in which they should be shown.
    #[must_use]
    pub const fn parameters(mut self, parameters: &'static [Parameter]) -> Self {
        self.parameters = parameters;
        self
    }

    /// With its law in Unicode, several lines.
    #[must_use]
    pub const fn law(mut self, law: &'static str) -> Self {
        self.law = law;
        self
    }

    /// With the source of the law.
    #[must_use]
    pub const fn source(mut self, source: &'static str) -> Self {
        self.source = source;
        self
    }

    /// With a line of a model file that uses it.
    #[must_use]
    pub const fn example(mut self, example: &'static str) -> Self {
        self.example = example;
        self
    }

    /// With the deformation that shows a law, with the parameters of the example; none without.
    #[must_use]
    pub const fn exercise(mut self, exercise: Exercise) -> Self {
        self.exercise = exercise;
        self
    }

    /// The parameter of that name.
    #[must_use]
    pub fn parameter(&self, name: &str) -> Option<&'static Parameter> {
        self.parameters.iter().find(|p| p.name == name)
    }
}

/// Which contract a kind fulfils.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Category {
    /// Adds to M, C, K once.
    Linear,
    /// Equations between DOFs.
    Constraint,
    /// A nonlinear law.
    Link,
    /// A function of time.
    Function,
    /// A number made of other outputs.
    Output,
    /// A rule for time.
    Solver,
}

/// How many nodes a kind takes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct NodeCount {
    /// At least.
    pub min: usize,
    /// At most.
    pub max: usize,
}

impl NodeCount {
    /// One node and the ground, or two nodes.
    pub const GROUND_OR_TWO: Self = Self { min: 1, max: 2 };
    /// None: functions of time, outputs, solvers.
    pub const NONE: Self = Self::exactly(0);
    /// Exactly `n`.
    #[must_use]
    pub const fn exactly(n: usize) -> Self {
        Self { min: n, max: n }
    }
    /// `n` or more.
    #[must_use]
    pub const fn at_least(n: usize) -> Self {
        Self { min: n, max: usize::MAX }
    }
}

/// One parameter of a kind.
#[derive(Clone, Copy, Debug)]
#[non_exhaustive]
pub struct Parameter {
    /// Name in model files.
    pub name: &'static str,
    /// Symbol in the law.
    pub symbol: &'static str,
    /// Number with a dimension, choice, flag …
    pub form: Form,
    /// Admissible values of a number.
    pub range: Range,
    /// What holds where the file says nothing.
    pub default: Default,
    /// One sentence of meaning.
    pub meaning: &'static str,
}

impl Parameter {
    /// A parameter of any form, as [`Parameters`](crate::Parameters) makes them of the fields of a struct.
    #[must_use]
    pub const fn new(
        name: &'static str,
        symbol: &'static str,
        form: Form,
        default: Default,
        meaning: &'static str,
    ) -> Self {
        Self { name, symbol, form, range: Range::Any, default, meaning }
    }

    /// The same of another form.
    #[must_use]
    pub const fn of(mut self, form: Form) -> Self {
        self.form = form;
        self
    }

    /// The same with another range.
    #[must_use]
    pub const fn within(mut self, range: Range) -> Self {
        self.range = range;
        self
    }
}

/// The form of a parameter.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Form {
    /// A number of this dimension.
    Number(Dimension),
    /// A number of dimension `base / over^exponent`, the exponent being another parameter.
    Power {
        /// Numerator.
        base: Dimension,
        /// Dimension that is raised to the power.
        over: Dimension,
        /// Name of the parameter that holds the exponent.
        exponent: &'static str,
    },
    /// A number, or a list of any length, whose dimension follows the local axis of the link: `along`
    /// where the parameter `axis` names U1, U2 or U3, `about` where it names R1, R2 or R3.
    OfAxis {
        /// Dimension along an axis.
        along: Dimension,
        /// Dimension about an axis.
        about: Dimension,
        /// A list instead of one number.
        list: bool,
    },
    /// One of these names.
    Choice(&'static [&'static str]),
    /// Several different names out of these, in a list.
    Choices(&'static [&'static str]),
    /// `true` or `false`.
    Flag,
    /// A list of `count` numbers of one dimension (any count where `None`).
    Numbers {
        /// Dimension of each.
        dimension: Dimension,
        /// How many.
        count: Option<usize>,
    },
    /// A matrix of `size` × `size` numbers, as a list of rows; translations first, then
    /// rotations, of this category of stiffness or damping.
    Matrix {
        /// Rows and columns.
        size: usize,
        /// Dimension of the translational block; each rotational row or column adds a length.
        dimension: Dimension,
        /// It must be symmetric.
        symmetric: bool,
    },
    /// A list of positions, three lengths each.
    Points,
    /// The name of a node of the model.
    Node,
    /// A text in quotes.
    Text,
    /// A text file, by its path from the folder of the model file; the law gets a [`FileText`](crate::FileText).
    File,
    /// A file with a sparse matrix, by its path from the folder of the model file: Matrix Market, `.npz` of SciPy, `.sti`
    /// and `.mas` of CalculiX, DMIG of Nastran (`"wall.pch:KAAX"` where it has several); the kind gets a
    /// [`SparseMatrix`](crate::SparseMatrix).
    SparseMatrix,
    /// A text for each node in its order: what the files of the element call it. The model may give them as keys of
    /// `nodes`; the names of the nodes where it gives none.
    Labels,
}

impl Form {
    /// A stiffness along or about the link's axis.
    pub const STIFFNESS_OF_AXIS: Self = Self::of_axis(STIFFNESS, ROTATIONAL_STIFFNESS);
    /// A force along or a moment about the link's axis.
    pub const FORCE_OF_AXIS: Self = Self::of_axis(FORCE, MOMENT);
    /// A displacement along or a rotation about the link's axis.
    pub const DEFORMATION_OF_AXIS: Self = Self::of_axis(LENGTH, NONE);

    const fn of_axis(along: Dimension, about: Dimension) -> Self {
        Self::OfAxis { along, about, list: false }
    }

    /// A list of such numbers.
    #[must_use]
    pub const fn list(self) -> Self {
        match self {
            Self::OfAxis { along, about, .. } => Self::OfAxis { along, about, list: true },
            Self::Number(dimension) => Self::Numbers { dimension, count: None },
            other => other,
        }
    }
}

/// Admissible numbers.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Range {
    /// Any finite number.
    Any,
    /// `> 0`.
    Positive,
    /// `≥ 0`.
    NonNegative,
    /// Between two bounds, both included.
    Within(f64, f64),
    /// Above the first, up to and including the second.
    Above(f64, f64),
}

impl Range {
    /// True where the number is admissible.
    #[must_use]
    pub fn contains(self, x: f64) -> bool {
        x.is_finite()
            && match self {
                Self::Any => true,
                Self::Positive => x > 0.0,
                Self::NonNegative => x >= 0.0,
                Self::Within(a, b) => (a..=b).contains(&x),
                Self::Above(a, b) => x > a && x <= b,
            }
    }

    /// In words, such as `> 0`.
    #[must_use]
    pub fn text(self) -> String {
        match self {
            Self::Any => "any finite number".into(),
            Self::Positive => "> 0".into(),
            Self::NonNegative => "≥ 0".into(),
            // The numbers beside 0 and 1, which are not included themselves.
            Self::Within(f64::MIN_POSITIVE, b) if b == 1.0 - f64::EPSILON => "> 0 and < 1".into(),
            Self::Within(a, b) => format!("between {a} and {b}"),
            Self::Above(a, b) => format!("> {a} and ≤ {b}"),
        }
    }
}

/// What holds where a file gives no value.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Default {
    /// The file must give it.
    Required,
    /// It stays absent (an `Option` in the law).
    Absent,
    /// This number, in SI.
    Number(f64),
    /// This choice, or this text.
    Choice(&'static str),
    /// This flag.
    Flag(bool),
}

/// A kind that has a card and can be read from a model file.
///
/// The struct is the parameters: [`Parameters`](crate::Parameters) makes those of the card from its fields, numbers arrive
/// in SI and within their ranges. Use `#[serde(deny_unknown_fields)]`.
pub trait Described: DeserializeOwned {
    /// The card.
    const CARD: Card;

    /// Checks what the card cannot say: parameters that depend on each other.
    ///
    /// # Errors
    /// What is wrong and what would be right.
    fn check(&self) -> Result<(), ParameterError> {
        Ok(())
    }
}
