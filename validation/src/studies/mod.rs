//! The studies, one file a subject.

use crate::Study;

/// All studies.
#[must_use]
pub fn all() -> Vec<Study> {
    Vec::new()
}
