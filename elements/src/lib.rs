//! The built-in elements, constraints and links of Trilith: one file each.
//!
//! | linear elements | constraints | links |
//! |---|---|---|
//! | [`Beam`], [`Truss`], [`Spring`], [`Mass`] | [`RigidBody`], [`RigidLink`], [`Diaphragm`], [`EqualDof`] | [`NLink`], [`Gap`], [`Hook`], [`Dashpot`], [`RockingBody`], [`FrictionPendulum`], [`TensionCompressionFriction`], [`TriplePendulum`] |
//!
//! To add one: write its file, then its lines here (`mod`, `pub use`, and one of registration).

mod dense;
mod parameters;
mod restitution;
mod sliding;

mod beam;
mod dashpot;
mod diaphragm;
mod equal_dof;
mod friction_pendulum;
mod gap;
mod hook;
mod mass;
mod nlink;
mod rigid_body;
mod rigid_link;
mod rocking_body;
mod spring;
mod tension_compression_friction;
mod triple_pendulum;
mod truss;

pub use beam::{Beam, MassMatrix};
pub use dashpot::{Dashpot, When};
pub use diaphragm::{Diaphragm, Normal};
pub use equal_dof::{DofName, EqualDof};
pub use friction_pendulum::{FrictionModel, FrictionPendulum, Surface};
pub use gap::Gap;
pub use hook::Hook;
pub use mass::Mass;
pub use nlink::{NLink, NLinkHistory};
pub use rigid_body::RigidBody;
pub use rigid_link::RigidLink;
pub use rocking_body::RockingBody;
pub use sliding::SlidingHistory;
pub use spring::Spring;
pub use tension_compression_friction::TensionCompressionFriction;
pub use triple_pendulum::TriplePendulum;
pub use truss::Truss;

use trilith_element::Register;

/// Offers every built-in kind.
pub fn register(to: &mut impl Register) {
    to.linear::<Beam>();
    to.linear::<Truss>();
    to.linear::<Spring>();
    to.linear::<Mass>();
    to.constraint::<RigidBody>();
    to.constraint::<RigidLink>();
    to.constraint::<Diaphragm>();
    to.constraint::<EqualDof>();
    to.link::<NLink>();
    to.link::<Gap>();
    to.link::<Hook>();
    to.link::<Dashpot>();
    to.link::<RockingBody>();
    to.link::<FrictionPendulum>();
    to.link::<TensionCompressionFriction>();
    to.link::<TriplePendulum>();
}

#[cfg(test)]
mod tests;
