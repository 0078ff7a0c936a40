//! The built-in elements, constraints and links of Trilith.
//!
//! Every file of `src/` is one kind, with a folder of the same name where it is large. What several kinds share
//! lies in `src/shared/`; `src/tests.rs` tests what holds for all of them.
//!
//! | linear elements | constraints | links |
//! |---|---|---|
//! | [`Beam`], [`Inerter`], [`Mass`], [`Spring`], [`Superelement`], [`Truss`] | [`Diaphragm`], [`EqualDof`], [`RigidBody`], [`RigidLink`] | contacts: [`NLink`], [`Gap`], [`Hook`], [`ImpactHertz`], [`ImpactKelvin`], [`RockingBody`], [`BodyContact`] |
//! | | | dampers: [`BilinearDamper`], [`Dashpot`], [`FrequencyIndependentViscoelastic`], [`FrictionSpring`], [`MaxwellDamper`] |
//! | | | isolators: [`ElastomericBearing`], [`FrictionPendulum`], [`LeadRubber`], [`RubberIsolator`], [`TensionCompressionFriction`], [`TriplePendulum`] |
//! | | | springs: [`BoucWen`], [`IbarraMedinaKrawinkler`], [`LinearLink`], [`MultilinearElastic`], [`MultilinearPlastic`], [`PMMHinge`], [`SoilSpring`], [`Wen`] |
//!
//! To add one: write its file, then its lines here (`mod`, `pub use`, and one of registration).

mod shared;

mod beam;
mod bilinear_damper;
mod body_contact;
mod bouc_wen;
mod dashpot;
mod diaphragm;
mod elastomeric_bearing;
mod equal_dof;
mod frequency_independent_viscoelastic;
mod friction_pendulum;
mod friction_spring;
mod gap;
mod hook;
mod ibarra_medina_krawinkler;
mod impact_hertz;
mod impact_kelvin;
mod inerter;
mod lead_rubber;
mod linear_link;
mod mass;
mod maxwell_damper;
mod multilinear_elastic;
mod multilinear_plastic;
mod nlink;
mod pmm_hinge;
mod rigid_body;
mod rigid_link;
mod rocking_body;
mod rubber_isolator;
mod soil_spring;
mod spring;
mod superelement;
mod tension_compression_friction;
mod triple_pendulum;
mod truss;
mod wen;

pub use beam::{Beam, MassMatrix};
pub use bilinear_damper::BilinearDamper;
pub use body_contact::BodyContact;
pub use bouc_wen::{BoucWen, BoucWenHistory};
pub use dashpot::{Dashpot, When};
pub use diaphragm::{Diaphragm, Normal};
pub use elastomeric_bearing::{BearingHistory, ElastomericBearing};
pub use equal_dof::{DofName, EqualDof};
pub use frequency_independent_viscoelastic::FrequencyIndependentViscoelastic;
pub use friction_pendulum::{FrictionModel, FrictionPendulum, Surface};
pub use friction_spring::{Direction, FrictionSpring};
pub use gap::Gap;
pub use hook::Hook;
pub use ibarra_medina_krawinkler::{IbarraMedinaKrawinkler, Reloading};
pub use impact_hertz::{HertzModel, ImpactHertz};
pub use impact_kelvin::{Damps, ImpactKelvin};
pub use inerter::Inerter;
pub use lead_rubber::{LeadHistory, LeadRubber};
pub use linear_link::LinearLink;
pub use mass::Mass;
pub use maxwell_damper::MaxwellDamper;
pub use multilinear_elastic::MultilinearElastic;
pub use multilinear_plastic::{MultilinearPlastic, Rule};
pub use nlink::{NLink, NLinkHistory, NLinkRubbing};
pub use pmm_hinge::{PMMHinge, PMMHistory};
pub use rigid_body::RigidBody;
pub use rigid_link::RigidLink;
pub use rocking_body::RockingBody;
pub use rubber_isolator::{RubberHistory, RubberIsolator};
pub use shared::bouc_wen_plane::Coupling;
pub use shared::sliding::SlidingHistory;
pub use soil_spring::{Backbone, Sides, SoilHistory, SoilSpring};
pub use spring::Spring;
pub use superelement::Superelement;
pub use tension_compression_friction::TensionCompressionFriction;
pub use triple_pendulum::TriplePendulum;
pub use truss::Truss;
pub use wen::{Wen, WenHistory};

use trilith_element::Register;

/// Offers every built-in kind.
pub fn register(to: &mut impl Register) {
    to.linear::<Beam>();
    to.linear::<Inerter>();
    to.linear::<Mass>();
    to.linear::<Spring>();
    to.add_linear(&Superelement::CARD, superelement::reader());
    to.linear::<Truss>();
    to.constraint::<Diaphragm>();
    to.constraint::<EqualDof>();
    to.constraint::<RigidBody>();
    to.constraint::<RigidLink>();
    to.link::<BilinearDamper>();
    to.link::<BodyContact>();
    to.link::<BoucWen>();
    to.link::<Dashpot>();
    to.link::<ElastomericBearing>();
    to.link::<FrequencyIndependentViscoelastic>();
    to.link::<FrictionPendulum>();
    to.link::<FrictionSpring>();
    to.link::<Gap>();
    to.link::<Hook>();
    to.link::<IbarraMedinaKrawinkler>();
    to.link::<ImpactHertz>();
    to.link::<ImpactKelvin>();
    to.link::<LeadRubber>();
    to.link::<LinearLink>();
    to.link::<MaxwellDamper>();
    to.link::<MultilinearElastic>();
    to.link::<MultilinearPlastic>();
    to.link::<NLink>();
    to.link::<PMMHinge>();
    to.link::<RockingBody>();
    to.link::<RubberIsolator>();
    to.link::<SoilSpring>();
    to.link::<TensionCompressionFriction>();
    to.link::<TriplePendulum>();
    to.link::<Wen>();
}

#[cfg(test)]
mod tests;
