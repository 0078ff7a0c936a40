//! RON model files: schema, quantities with units, parameters, diagnostics, registry, time functions.

mod model;
mod time_function;

pub use model::*;
pub use time_function::{Side, TimeFunction};
