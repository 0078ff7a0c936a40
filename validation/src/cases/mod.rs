//! The cases, one file a group.

mod beam_stop;
mod bearings;
mod block;
mod block_rocking;
mod block_start;
mod bouc_wen;
mod dampers;
mod elastic;
mod frames;
mod hinges_and_soil;
mod hysteretic;
mod impact;
mod inerter;
mod isolated;
mod links;
mod maxwell;
mod modes;
mod p_delta;
mod pounding;
mod records;
mod restitution;
mod ritz;
mod rocking_body;
mod seal;
mod series_dampers;
mod sliding;
mod sliding_driven;
mod time_integration;

use crate::{Case, Item};

/// All cases.
#[must_use]
pub fn all() -> Vec<Case> {
    [
        sliding::cases(),
        sliding_driven::cases(),
        dampers::cases(),
        maxwell::cases(),
        series_dampers::cases(),
        inerter::cases(),
        seal::cases(),
        links::cases(),
        bearings::cases(),
        elastic::cases(),
        hysteretic::cases(),
        hinges_and_soil::cases(),
        bouc_wen::cases(),
        restitution::cases(),
        impact::cases(),
        pounding::cases(),
        beam_stop::cases(),
        block::cases(),
        block_start::cases(),
        block_rocking::cases(),
        rocking_body::cases(),
        modes::cases(),
        p_delta::cases(),
        ritz::cases(),
        time_integration::cases(),
        frames::cases(),
    ]
    .into_iter()
    .flatten()
    .collect()
}

/// The cases that need a ground motion record, or word of its absence.
#[must_use]
pub fn with_record() -> Vec<Item> {
    records::items()
}

/// A parameter set over that of a text.
fn set(name: &str, value: impl ToString) -> (String, String) {
    (name.to_owned(), value.to_string())
}
