//! The built-in elements, constraints and links of Trilith: one file each.
//!
//! | linear elements | constraints | links |
//! |---|---|---|
//! | [`Beam`], [`Truss`], [`Spring`], [`Mass`] | [`RigidBody`], [`RigidLink`], [`Diaphragm`], [`EqualDof`] | [`NLink`], [`Gap`], [`Hook`], [`Dashpot`], [`LeadRubber`], [`MultilinearElastic`], [`MultilinearPlastic`], [`RockingBody`], [`RubberIsolator`], [`Wen`] |
//!
//! To add one: write its file, then its lines here (`mod`, `pub use`, and one of registration).

mod biaxial;
mod dense;
#[cfg(test)]
mod driven;
mod dual;
mod multilinear;
mod parameters;
mod restitution;

mod beam;
mod dashpot;
mod diaphragm;
mod equal_dof;
mod gap;
mod hook;
mod lead_rubber;
mod mass;
mod multilinear_elastic;
mod multilinear_plastic;
mod nlink;
mod rigid_body;
mod rigid_link;
mod rocking_body;
mod rubber_isolator;
mod spring;
mod truss;
mod wen;

pub use beam::{Beam, MassMatrix};
pub use dashpot::{Dashpot, When};
pub use diaphragm::{Diaphragm, Normal};
pub use equal_dof::{DofName, EqualDof};
pub use gap::Gap;
pub use hook::Hook;
pub use lead_rubber::{LeadHistory, LeadRubber};
pub use mass::Mass;
pub use multilinear_elastic::MultilinearElastic;
pub use multilinear_plastic::{MultilinearPlastic, Rule};
pub use nlink::{NLink, NLinkHistory};
pub use rigid_body::RigidBody;
pub use rigid_link::RigidLink;
pub use rocking_body::RockingBody;
pub use rubber_isolator::{RubberHistory, RubberIsolator};
pub use spring::Spring;
pub use truss::Truss;
pub use wen::{Wen, WenHistory};

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
    to.link::<LeadRubber>();
    to.link::<MultilinearElastic>();
    to.link::<MultilinearPlastic>();
    to.link::<RockingBody>();
    to.link::<RubberIsolator>();
    to.link::<Wen>();
}

#[cfg(test)]
mod tests;
