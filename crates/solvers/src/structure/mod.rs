//! The linear structure in the coordinates of a solver: all free DOFs, or those of a basis.
//!
//! Matrices, link map B, load columns, and how massless directions follow in direct integration.
//! May use `basis` and `error`.

mod acceleration;
mod followers;
mod link_map;
mod mode_set;
mod products;
mod reduced_system;

pub(crate) use acceleration::mass_acceleration;
pub(crate) use followers::{Followers, JUMPED, accelerate_at_once, acceleration, rate_at_end};
pub(crate) use link_map::LinkMap;
pub(crate) use mode_set::ModeSet;
pub(crate) use products::Products;
pub(crate) use reduced_system::ReducedSystem;

/// Displacements, velocities and accelerations in the coordinates of a solver, one after the other.
pub(crate) type Motion = Vec<f64>;
