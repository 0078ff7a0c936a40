//! A link law in a crate of its own, as a third party would write it: it depends on the contract only.
//!
//! An application offers it beside the built-in kinds with one line:
//! `trilith_thirdparty_example::register(&mut registry)`.

mod cubic_spring;

pub use cubic_spring::{CubicSpring, CubicSpringHistory};

use trilith_element::Register;

/// Offers every kind of this crate.
pub fn register(to: &mut impl Register) {
    to.link::<CubicSpring>();
}
