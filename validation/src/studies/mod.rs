//! The studies, one file a subject.

mod calibration;

use crate::Study;

/// All studies.
#[must_use]
pub fn all() -> Vec<Study> {
    [&calibration::STUDIES[..]].concat()
}
