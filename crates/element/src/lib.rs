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
pub use link::{Contact, ContactUse, Coordinates, Energy, Impact, Kinematics, Link, Response};
pub use member::{Member, SpanLoad};
pub use outline::{NodalOutline, Outline};
pub use register::{
    Read, ReadConstraint, ReadFunction, ReadLinear, ReadLink, ReadOutput, ReadSolver, Register,
};
pub use sparse::{MeshRow, SparseMatrices, SparseMatrix, SparseRow};
pub use values::{Value, Values};
pub use waveform::{Side, Stretch, Waveform};
