//! Modal equations, solved exactly for sources that are linear in a step.
//!
//! Coefficients of a step of a length, for modes alone or coupled by damping, and the motion inside a step.
//! May use `structure`, for the mark of an acceleration that has jumped and for sets of modes; it knows no links.

mod closed_form;
mod coupled;
mod recurrence;
pub(crate) mod single_mode;

pub(crate) use closed_form::ClosedForm;
pub(crate) use recurrence::{Recurrence, Structure};
pub(crate) use single_mode::Mode;
