//! Links, an element, a constraint, a function of time, an output and a solver in a crate of their own, as a third party
//! would write them.
//!
//! [`TensionBracing`] has a memory, [`CubicSpring`] has none, [`MeasuredSpring`] reads a file, [`Actuator`] looks at the clock; each is a file that needs
//! nothing but `trilith_element`, and so are [`TaperedBar`], [`Gearing`], [`Friedlander`], [`Interaction`] and
//! [`CentralDifference`]. An application offers them beside the
//! built-in kinds with one line, `trilith_thirdparty_example::register(&mut registry)`: `src/main.rs` is one.
//! The README of the crate leads to a link of your own.

mod actuator;
mod central_difference;
mod cubic_spring;
mod friedlander;
mod gearing;
mod interaction;
mod measured_spring;
mod tapered_bar;
mod tension_bracing;

pub use actuator::{Actuator, Clock};
pub use central_difference::CentralDifference;
pub use cubic_spring::CubicSpring;
pub use friedlander::Friedlander;
pub use gearing::Gearing;
pub use interaction::Interaction;
pub use measured_spring::{Curve, MeasuredSpring};
pub use tapered_bar::TaperedBar;
pub use tension_bracing::{TensionBracing, TensionBracingHistory};

use trilith_element::Register;

/// Offers every kind of this crate.
pub fn register(to: &mut impl Register) {
    to.link::<TensionBracing>();
    to.link::<Actuator>();
    to.link::<CubicSpring>();
    to.link::<MeasuredSpring>();
    to.linear::<TaperedBar>();
    to.constraint::<Gearing>();
    to.function::<Friedlander>();
    to.output::<Interaction>();
    to.solver::<CentralDifference>();
}
