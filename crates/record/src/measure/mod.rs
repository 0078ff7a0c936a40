//! Intensity measures and response spectra.
//!
//! All of them take the acceleration as straight between samples.

mod fourier;
mod intensity;
mod motion;
mod rotated;
mod spectrum;

pub use fourier::{Fourier, fourier};
pub(crate) use fourier::{inverse, transform};
pub use intensity::{arias, cav, husid, significant_duration};
pub use motion::{displacement, peak, velocity};
pub use rotated::{Rotated, rotated, rotated_peak};
pub use spectrum::{Oscillator, Response, Spectrum, periods, pseudo_accelerations, spectrum};
pub(crate) use spectrum::{Step, steps_per_sample};
