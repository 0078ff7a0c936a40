//! The built-in elements, constraints and links of Trilith: one file each.
//!
//! | linear elements | constraints | links |
//! |---|---|---|
//! | [`Beam`], [`Truss`], [`Spring`], [`Mass`] | [`RigidBody`], [`RigidLink`], [`Diaphragm`], [`EqualDof`] | [`NLink`], [`Gap`], [`Hook`], [`Dashpot`] |
//!
//! To add one: write its file, then two lines here (`mod` with `pub use`, and registration).

mod dense;
mod parameters;

mod beam;
mod dashpot;
mod mass;
mod nlink;
mod rigid_body;

pub use beam::{Beam, MassMatrix};
pub use dashpot::{Dashpot, When};
pub use mass::Mass;
pub use nlink::{NLink, NLinkHistory};
pub use rigid_body::RigidBody;

use trilith_element::Register;

/// Offers every built-in kind.
pub fn register(to: &mut impl Register) {
    to.linear::<Beam>();
    to.linear::<Mass>();
    to.constraint::<RigidBody>();
    to.link::<NLink>();
    to.link::<Dashpot>();
}
