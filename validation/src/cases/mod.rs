//! The cases, one file a group.

mod block;
mod dampers;
mod impact;
mod links;
mod modes;
mod sliding;
mod time_integration;

use crate::Case;

/// All cases.
#[must_use]
pub fn all() -> Vec<Case> {
    [
        sliding::cases(),
        dampers::cases(),
        links::cases(),
        impact::cases(),
        block::cases(),
        modes::cases(),
        time_integration::cases(),
    ]
    .into_iter()
    .flatten()
    .collect()
}

/// A parameter set over that of a text.
fn set(name: &str, value: impl ToString) -> (String, String) {
    (name.to_owned(), value.to_string())
}
