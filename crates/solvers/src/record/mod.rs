//! What a run shows while it goes on: outputs, energies, contacts, base shear.
//!
//! Outputs as rows over a state, the energy ledger, extremes, and the observers that are shown accepted states.
//! May use `step`, `structure`, `modal` for looks inside a step, `contacts` and `checks` for what is noticed on the way.

mod balance;
mod base_shear;
mod contact_mode;
mod coordinates;
mod energy;
mod inside;
mod ledger;
mod observer;
mod outputs;
pub(crate) mod peak;
mod rows;
mod view;

pub use balance::EnergyBalance;
pub use base_shear::{BaseShear, BaseShearSummary};
pub(crate) use contact_mode::Seen;
pub use contact_mode::{ContactMemory, ContactMode, ContactSummary};
pub use energy::{EnergyTotals, LinkEnergy, StartEnergy};
pub(crate) use ledger::Ledger;
pub use observer::{Observer, Sample, Shape};
pub(crate) use outputs::{Outputs, has_modal_peak, move_derived};
pub use peak::Peak;
pub(crate) use rows::{Internal, Row};
pub(crate) use view::{Viewer, needs_rates, show_static};
