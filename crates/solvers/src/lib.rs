//! Solvers of Trilith: one march over time, interchangeable propagators, one link kernel.
//!
//! | solver | space | rule for time |
//! |---|---|---|
//! | `fna` | Ritz vectors | exact for loads linear in the step |
//! | `hht` | all DOFs | HHT-α, one factorisation a step size |
//! | `ritz-hht` | Ritz vectors | HHT-α |
//! | `full-newton` | all DOFs | HHT-α, tangent factorised in every iteration |

mod basis;
mod certificate;
mod checks;
mod contacts;
mod error;
mod fna;
mod hht;
mod kernel;
pub mod lanes;
mod march;
mod modal;
mod record;
mod run;
mod statics;
mod step;
mod structure;
mod together;
mod vector;

pub use basis::{Adequacy, BasisReport, ModeShape};
pub use certificate::OutputError;
pub use checks::of_model as warnings;
pub use contacts::{BearingSummary, StopSummary};
pub use error::SolveError;
pub use record::{
    BaseShear, BaseShearSummary, ContactMemory, ContactMode, ContactSummary, EnergyBalance,
    EnergyTotals, LinkEnergy, Observer, Peak, Sample, Shape, StartEnergy,
};
pub use run::{
    CaseResult, EndState, RunOptions, SoFar, Status, Work, assemble, modes,
    of_outputs as warnings_of_outputs, run,
};
pub use step::State;
pub use together::{Member, run_together};
