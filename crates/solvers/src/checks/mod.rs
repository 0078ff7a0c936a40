//! What is said of a model that is hardly meant so: contacts that are too soft, parts that have left, bodies in each other.
//!
//! Findings from the model alone, from the end of a case, and from what was noticed on the way.
//! May use `contacts` and `step`.

mod overlap;
mod plausible;

pub(crate) use overlap::{Overlaps, Place};
pub use plausible::of_model;
pub(crate) use plausible::{
    End, FAR, Noticed, PRESSED, Pressed, away, beyond, drives, of_dynamic, of_static, rounded,
    size, weightless,
};
