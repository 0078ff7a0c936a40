//! RON model files: schema, quantities with units, parameters, diagnostics, registry, time functions.
//!
//! [`read`] turns a file into a [`Model`] in SI with every reference resolved to an index, or into
//! all [`Diagnostic`]s of the file at once. Sections of other files that it includes come in first, repetitions are
//! expanded before anything is read, and [`Places`] leads spans back to where they came from. [`resolved`] writes a model as a file in which every
//! default is filled in and every expression evaluated.

mod analysis;
mod check;
mod combination;
mod custom;
mod diagnostic;
mod expand;
mod expression;
mod include;
mod matrices;
mod model;
mod named;
mod output;
mod parameters;
mod places;
mod plain;
mod read;
mod registry;
mod resolved;
pub mod ron_value;
pub mod schema;
pub mod sections;
mod solver;
mod table;
mod time_function;
mod tree;
mod units;

/// What other RON files than models are read with: values with their places, fields whose names are
/// checked, quantities, errors.
pub mod file {
    pub use crate::diagnostic::{closest, names_help};
    pub use crate::expression::{
        ExpressionError, NoNames, Quantity, Scope, evaluate, expression_diagnostic,
    };
    pub use crate::read::{Context, Fields, fits, open, parse, resembles_model};
    pub use crate::tree::{Entry, Kind, Node};
}

pub use analysis::*;
pub use check::{ModelError, ModelFault};
pub use combination::{Combination, CombinationTerm, CombineCases};
pub use custom::Custom;
pub use diagnostic::{Diagnostic, line_column};
pub use expression::quantity;
pub use include::OpenTexts;
pub use matrices::{MatrixForm, matrix_file, read_matrix};
pub use model::*;
pub use output::*;
pub use places::{Place, Places};
pub use read::{ModelText, read, read_text};
pub use registry::Registry;
pub use resolved::{Replacement, resolved, resolved_with};
pub use solver::{CustomSolver, SolverKind};
pub use table::{AfterEnd, Interpolation, Table, TableError};
pub use time_function::{Corner, Harmonic, Side, Stretch, TimeFunction};
pub use trilith_record::{visible, visible_line};
pub use units::{STANDARD_GRAVITY, si_dimension};
