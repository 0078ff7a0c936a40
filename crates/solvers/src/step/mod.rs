//! One step of a motion: a propagator predicts, the link kernel solves, the propagator corrects.
//!
//! The state, the contract of propagators, links and loads of a step, and what its error is measured by.
//! May use `kernel`, `structure`, and `modal` for the motion inside a step.

mod account;
mod culprit;
mod difference;
mod link_equations;
mod propagator;
mod state;
mod stepper;
mod trapezoidal;
mod turning;
mod vibration;

pub(crate) use account::{Account, Suspicion, leaves_out};
pub(crate) use culprit::{Culprit, Wrong, asked_again, asked_twice, is_sound, not_finite};
pub(crate) use difference::{Difference, DisplacementNorms, difference_of, displacement_norms};
pub(crate) use link_equations::LinkEquations;
pub(crate) use propagator::{Forces, Propagator, StepWork, kinetic_and_strain};
pub use state::State;
pub(crate) use state::{LinksBefore, StepEnergy, StepFailure, untouched};
pub(crate) use stepper::{LinkStepper, Stepper, energy_rounding};
pub(crate) use trapezoidal::TrapezoidalWork;
pub(crate) use turning::Turning;
