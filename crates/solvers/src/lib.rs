//! Solvers of Trilith: one march over time, interchangeable propagators, one link kernel.
//!
//! | solver | coordinates | rule for time |
//! |---|---|---|
//! | `fna` | Ritz vectors | exact for loads linear in the step |
//! | `hht` | all DOFs | HHT-α, one factorisation a step size |
//! | `ritz-hht` | Ritz vectors | HHT-α |
//! | `full-newton` | all DOFs | HHT-α, tangent factorised in every iteration |
//! | of other crates | all DOFs or Ritz vectors | their own |
//!
//! The code lies in rooms; each uses rooms above it in this table alone, by what their `mod.rs` lets out. A test of the
//! workspace reads the table and holds this.
//!
//! | room | what is computed there |
//! |---|---|
//! | `vector` | sums over vectors |
//! | `platform` | what a system may be without: threads, a clock |
//! | `error` | what stops a run before it begins |
//! | `craig_bampton` | matrices of few coordinates: constraint modes and fixed-interface modes |
//! | `basis` | Ritz vectors, modes, attachment vectors of massless DOFs, modal damping |
//! | `structure` | the linear structure in the coordinates of a solver, link map B |
//! | `kernel` | link forces: f̃ = law(d* − G f̃, v* − H f̃) − k_e d |
//! | `modal` | modal equations over a step, and the motion inside it |
//! | `step` | state, propagator contract, one step with its energies and the measures of its error |
//! | `contacts` | which links are contacts, and what these are to the model |
//! | `checks` | what is said of a model that is hardly meant so |
//! | `record` | outputs, energy ledger, extremes, observers |
//! | `march` | output steps, substeps, error control |
//! | `fna` | the propagator of FNA |
//! | `hht` | HHT-α, and full Newton iteration |
//! | `custom` | rules for time of other crates |
//! | `certificate` | how far outputs are off, estimated beside a run |
//! | `statics` | equilibrium along a path, initial values of massless directions |
//! | `run` | cases from start to end, checkpoints, results |
//! | `linearised` | modes with the links made linear, response spectrum analysis |
//! | `gradient` | derivatives of outputs by parameters of the model, forward through a march |
//! | `survey` | what a model weighs, what holds it, how it swings at rest |
//! | `together` | several motions of one structure in lock step |
//! | `lanes` | many analyses side by side, a lane of a vector register each |
//!
//! The page on architecture in the guide (`crates/guide/src/architecture.md`) leads through a run and through a step.

mod basis;
mod certificate;
mod checks;
mod contacts;
mod craig_bampton;
mod custom;
mod error;
mod fna;
pub mod gradient;
mod hht;
mod kernel;
pub mod lanes;
mod linearised;
mod march;
mod modal;
mod platform;
mod record;
mod run;
mod statics;
mod step;
mod structure;
mod survey;
mod together;
mod vector;

pub use basis::{Adequacy, BasisReport, ModeShape};
pub use certificate::OutputError;
pub use checks::of_model as warnings;
pub use contacts::{BearingSummary, StopSummary};
pub use craig_bampton::{CraigBampton, FixedModes, ReductionError};
pub use error::{LawFault, SolveError};
pub use linearised::{
    CombineDirections, CombineModes, LinearModes, Linearised, LinkStiffness, OutputMaximum, Secant,
    SpectrumRequest, linearised,
};
pub use record::{
    BaseShear, BaseShearSummary, ContactMemory, ContactMode, ContactSummary, EnergyBalance,
    EnergyTotals, LinkEnergy, Observer, Peak, Sample, Shape, StartEnergy,
};
pub use run::{
    CaseResult, EndState, RunOptions, SoFar, Status, Work, assemble, modes,
    of_outputs as warnings_of_outputs, run,
};
pub use step::State;
pub use survey::{Freedoms, Periods, Survey, frequencies, survey};
pub use together::{Member, run_together};
pub use trilith_linalg::threads::alone;
pub use trilith_linalg::vectors;
