//! Outputs from other crates: numbers made of other outputs.
//!
//! A derived output is a function of outputs that stand before it in the model file, at the same moment. Those may be
//! `hidden`, and are anything that a model can record: motions, forces in links and members, history variables. It has
//! no memory; what must be remembered is a history variable of a link.

use crate::{Dimension, ParameterError};
use std::fmt::Debug;

/// A number made of other outputs.
pub trait DerivedOutput: Debug + Send + Sync {
    /// The dimension of its value, from those of what it is made of; an angle has none.
    ///
    /// # Errors
    /// What is wrong with them, and what would be right: their number, or a dimension.
    fn dimension(&self, of: &[Dimension]) -> Result<Dimension, ParameterError>;

    /// Its value, from theirs, all in SI.
    fn value(&self, of: &[f64]) -> f64;

    /// Its derivatives by each of them, for gradients and for extremes between two moments; `false`, and nothing
    /// written, where it has none.
    fn derivatives(&self, _of: &[f64], _by: &mut [f64]) -> bool {
        false
    }
}
