//! The cases, one file a group.

mod beam_stop;
mod block;
mod block_rocking;
mod block_start;
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
        beam_stop::cases(),
        block::cases(),
        block_start::cases(),
        block_rocking::cases(),
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
