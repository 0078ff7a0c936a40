//! The cases, one file a group.

mod beam_stop;
mod block;
mod block_rocking;
mod block_start;
mod dampers;
mod elastic;
mod impact;
mod links;
mod maxwell;
mod modes;
mod restitution;
mod ritz;
mod sliding;
mod sliding_driven;
mod time_integration;

use crate::Case;

/// All cases.
#[must_use]
pub fn all() -> Vec<Case> {
    [
        sliding::cases(),
        sliding_driven::cases(),
        dampers::cases(),
        maxwell::cases(),
        links::cases(),
        elastic::cases(),
        restitution::cases(),
        impact::cases(),
        beam_stop::cases(),
        block::cases(),
        block_start::cases(),
        block_rocking::cases(),
        modes::cases(),
        ritz::cases(),
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
