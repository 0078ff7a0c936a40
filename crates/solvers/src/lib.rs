//! Solvers of Trilith: one march over time, interchangeable propagators, one link kernel.
//!
//! | solver | space | rule for time |
//! |---|---|---|
//! | `fna` | Ritz vectors | exact for loads linear in the step |
//! | `hht` | all DOFs | HHT-α, one factorisation a step size |
//! | `ritz-hht` | Ritz vectors | HHT-α |
//! | `full-newton` | all DOFs | HHT-α, tangent factorised in every iteration |

mod answer;
mod apart;
mod aside;
mod balance;
mod base_shear;
mod basis;
mod bearings;
mod case;
mod certificate;
mod clock;
mod companion;
mod condensation;
mod contact_mode;
mod contact_role;
mod damping;
mod defect;
mod drag;
mod dynamic;
mod equations;
mod error;
mod followers;
mod full_newton;
mod hht;
mod imbalance;
mod inside;
mod joints;
mod kernel;
mod kicks;
pub mod lanes;
mod ledger;
mod link_map;
mod link_side;
mod march;
mod massless;
mod modal;
mod observe;
mod output_step;
mod outputs;
mod overlap;
mod p_delta;
mod peak;
mod plausible;
mod products;
mod propagator;
mod samples;
mod shadow;
mod shapes;
mod single_mode;
mod space;
mod span;
mod start;
mod statics;
mod stepper;
mod stops;
mod timeline;
mod together;
mod touches;
mod turning;
mod vector;
mod vibration;
mod view;

pub use balance::EnergyBalance;
pub use base_shear::{BaseShear, BaseShearSummary};
pub use bearings::BearingSummary;
pub use case::{EndState, RunOptions, SoFar, modes, run};
pub use certificate::OutputError;
pub use contact_mode::{ContactMemory, ContactMode, ContactSummary};
pub use error::SolveError;
pub use observe::{
    Adequacy, BasisReport, CaseResult, EnergyTotals, LinkEnergy, ModeShape, Observer, Sample,
    Shape, StartEnergy, Status, Work,
};
pub use p_delta::assemble;
pub use peak::Peak;
pub use plausible::{of_model as warnings, of_outputs as warnings_of_outputs};
pub use stepper::State;
pub use stops::StopSummary;
pub use together::{Member, run_together};
