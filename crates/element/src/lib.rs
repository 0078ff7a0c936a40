//! The contract of Trilith: everything that the author of an element, a constraint or a link needs.
//!
//! | a member of the structure | implements | answers |
//! |---|---|---|
//! | beam, truss, spring, mass | [`LinearElement`] | its K, M and C, once |
//! | rigid body, diaphragm | [`Constraint`] | linear equations between DOFs, which are eliminated |
//! | gap, friction contact, dashpot | [`Link`] | force and tangents for a deformation, again and again |
//! | load or motion | [`Waveform`] | what it does in time |
//! | recorded number | [`DerivedOutput`] | a function of other outputs |
//! | solver | [`Integrator`] | a linear step of the structure |
//!
//! Nothing implements two of them. Every kind describes its parameters in a [`Card`], from which the
//! model reader takes names, units, ranges and defaults, and the catalogue its pages. A kind is offered
//! to an application with one line: `registry.link::<MyLink>()` (see [`Register`]).
//!
//! Structs that the contract hands over or asks for are made by their constructors (`Card::new`, `Contact::new`,
//! `Equation::new` …), so that they may have more fields one day.
//!
//! To test a link of your own, give it to the [conformance kit](conformance::Kit), which leads it along random
//! paths, and to a [`Driver`], which leads it along yours.
//!
//! SI units throughout: m, kg, s, N, rad.

mod card;
mod constraint;
mod definite;
mod derived;
mod driver;
mod error;
mod fault;
mod file;
mod frame;
mod history;
mod integrator;
mod linear;
mod link;
mod member;
mod outline;
mod register;
mod sparse;
mod values;
mod waveform;

pub mod conformance;
pub mod dimension;
pub mod lanes;

pub use card::{
    Card, Category, Default, Described, Exercise, Form, NodeCount, Parameter, Range, Stroke,
};
pub use constraint::{Constraint, Equation};
pub use derived::DerivedOutput;
pub use dimension::Dimension;
pub use driver::{Answer, Driver};
pub use error::ParameterError;
pub use fault::ElementFault;
pub use file::{FileError, FileText};
pub use frame::{Axis, Dof, Frame, Geometry, Vector3, cross, dot, norm, sub};
pub use history::{Field, History};
pub use integrator::{Factor, Integrator, LinearStep, LinearStructure, Motion, MotionMut};
pub use linear::{ElementMatrices, LinearElement, SquareMatrix};
pub use link::{
    Contact, ContactUse, Coordinates, Energy, Impact, Kinematics, LawFailed, Link, Response,
};
pub use member::{Member, SpanLoad};
pub use outline::{NodalOutline, Outline};
pub use register::{
    Read, ReadConstraint, ReadFunction, ReadLinear, ReadLink, ReadOutput, ReadSolver, Register,
};
pub use sparse::{MeshRow, Recovered, SparseMatrices, SparseMatrix, SparseRow};
/// The names of an enum that a parameter chooses from: `NAMES`, one for each variant.
///
/// ```
/// #[derive(trilith_element::Choices)]
/// enum Sides {
///     Both,
///     Tension,
/// }
/// assert_eq!(Sides::NAMES, ["Both", "Tension"]);
/// ```
pub use trilith_derive::Choices;
/// The parameters of a card from the fields of the struct that holds them: `PARAMETERS`.
///
/// The documentation of a field is the meaning of the parameter. Its type says the form: a number (`f64`), a list
/// (`Vec<f64>`, `[f64; N]`), a flag (`bool`), a text (`String`); an `Option` may stay absent. The rest is in
/// `#[parameter(…)]`: first the symbol, where there is one, then
///
/// | key | says | example |
/// |---|---|---|
/// | `unit` | unit of a number in SI, `"1"` for a pure one | `unit = "N·s/m"` |
/// | `about` | the unit where the link's `axis` is R1, R2 or R3 | `unit = "N/m", about = "N·m/rad"` |
/// | `per`, `exponent` | a unit divided by a power, the exponent being another parameter | `unit = "N", per = "m/s", exponent = "alpha"` |
/// | `range` | a [`Range`]; any finite number without | `range = Within(0.0, 1.0)` |
/// | `default` | what holds where the file says nothing; required without | `default = 0.02` |
/// | `choices` | names to choose from, one or (`Vec`) several | `choices = Sides::NAMES, default = "Both"` |
/// | `form` | any other [`Form`] | `form = File` |
///
/// A field that is no parameter has `#[serde(skip)]`. The table of what was said is the documentation of `PARAMETERS`.
/// A crate that has the contract by way of the facade says so above the struct: `#[parameters(crate = trilith::element)]`.
///
/// ```
/// use trilith_element::{Axis, Default, Parameters, Range};
///
/// #[derive(Parameters)]
/// struct Stop {
///     /// stiffness of the stop
///     #[parameter("k", unit = "N/m", range = Positive)]
///     k: f64,
///     /// clearance on both sides
///     #[parameter("g", unit = "m", range = NonNegative, default = 0.0)]
///     gap: f64,
///     /// local axis
///     #[parameter(choices = ["U1", "U2", "U3"], default = "U1")]
///     axis: Axis,
/// }
/// let [k, gap, axis] = Stop::PARAMETERS else { unreachable!() };
/// assert_eq!((k.name, k.symbol, k.meaning), ("k", "k", "stiffness of the stop"));
/// assert_eq!((gap.range, gap.default), (Range::NonNegative, Default::Number(0.0)));
/// assert_eq!(axis.default, Default::Choice("U1"));
/// ```
pub use trilith_derive::Parameters;
pub use values::{Value, Values};
pub use waveform::{Side, Stretch, Waveform};
