//! Ten unlike structures as a user would run them, every output of them against the oracle.
//!
//! Each is a [`Structure`](build::Structure): one description that the text of the model and the equations
//! of the [oracle](crate::oracle) are made from. Nothing is set for the run but the output step.

mod block;
mod braces;
mod bridge;
mod build;
mod compare;
mod inerter;
mod isolated;
mod missile;
mod motion;
mod piping;
mod soil;
mod tank;

use crate::Study;

const SOURCE: &str =
    "Equations of motion by textbook, integrated by Radau IIA of order 5 (independent code)";

/// The structures.
pub(super) const STUDIES: [Study; 11] = [
    Study {
        id: "TS-1",
        title: "Frame of five storeys on friction pendulums",
        source: SOURCE,
        work: |found| compare::compare(found, &isolated::five_storeys()),
    },
    Study {
        id: "TS-2",
        title: "Frame of twenty storeys on hysteretic isolators",
        source: SOURCE,
        work: |found| compare::compare(found, &isolated::twenty_storeys()),
    },
    Study {
        id: "TS-3",
        title: "Columns on footings without mass on soil springs with dashpots",
        source: SOURCE,
        work: |found| compare::compare(found, &soil::columns()),
    },
    Study {
        id: "TS-4",
        title: "Isolated tank with impulsive and convective masses",
        source: SOURCE,
        work: |found| compare::compare(found, &tank::tank()),
    },
    Study {
        id: "TS-5",
        title: "Bridge that pounds, every pier with a motion of its own",
        source: SOURCE,
        work: |found| compare::compare(found, &bridge::bridge()),
    },
    Study {
        id: "TS-6",
        title: "Piping with stops and snubbers",
        source: SOURCE,
        work: |found| compare::compare(found, &piping::piping()),
    },
    Study {
        id: "TS-7",
        title: "Missile on a cantilever of 120 beams with a stop at its tip",
        source: SOURCE,
        work: |found| compare::compare(found, &missile::missile()),
    },
    Study {
        id: "TS-8a",
        title: "Block that slides and rocks under a sine",
        source: SOURCE,
        work: |found| compare::compare(found, &block::block(0.6, 1.5)),
    },
    Study {
        id: "TS-8b",
        title: "Block that rocks under a sine",
        source: SOURCE,
        work: |found| compare::compare(found, &block::block(0.8, 0.75)),
    },
    Study {
        id: "TS-9",
        title: "Building and oscillator with inerters",
        source: SOURCE,
        work: |found| compare::compare(found, &inerter::building()),
    },
    Study {
        id: "TS-10",
        title: "Braced frame with dampers in its braces",
        source: SOURCE,
        work: |found| compare::compare(found, &braces::frame()),
    },
];
