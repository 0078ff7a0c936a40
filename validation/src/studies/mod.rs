//! The studies, one file a subject.

mod agreement;
mod basis;
mod calibration;
mod convergence;
mod frames;
mod numerical_damping;
mod opensees;
mod overturning;
mod random;
mod runs;
mod seed;
mod sensitivity;
mod structures;

use crate::{Item, Study};
pub use random::RANDOM_FNA;

/// All studies.
#[must_use]
pub fn all() -> Vec<Study> {
    [
        &seed::studies()[..],
        &agreement::STUDIES,
        &basis::STUDIES,
        &sensitivity::STUDIES,
        &numerical_damping::STUDIES,
        &convergence::STUDIES,
        &calibration::STUDIES,
        &overturning::STUDIES,
        &structures::STUDIES,
        &random::STUDIES,
    ]
    .concat()
}

/// Studies that need another program, or what is missing.
#[must_use]
pub fn with_programs() -> Vec<Item> {
    vec![opensees::item(), opensees::exported::item(), opensees::imported::item()]
}
