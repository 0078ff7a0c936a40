//! Combinations of cases.

use super::Takes::Words;
use super::{Block, Field, Group, needed};

const CASES_COMBINED: Field = needed(
    "cases",
    Words("a map from names to factors, or a list of names"),
    "Cases, and combinations that stand before, with their factors; names in a list have the factor 1.",
);

/// Combinations.
pub static COMBINATIONS: Group = Group {
    name: "combinations",
    meaning: "What the extremes of several cases make together, output by output: `trilith combine` runs the cases and tells them. \
              A sum of cases holds where the structure is linear; links that slide or open are loaded by all at once in one case that \
              continues another with `after`.",
    blocks: &[
        &Block {
            name: "LinearAdd",
            meaning: "Largest values added, and smallest values. For static cases that is their sum; of motions it is beyond what happens at one time.",
            example: r#"LinearAdd(cases: { "gravity": 1.35, "wind": 1.5 })"#,
            fields: &[CASES_COMBINED],
        },
        &Block {
            name: "AbsoluteAdd",
            meaning: "Largest magnitudes added, to both sides.",
            example: r#"AbsoluteAdd(cases: ["along x", "along y"])"#,
            fields: &[CASES_COMBINED],
        },
        &Block {
            name: "Srss",
            meaning: "Root of the sum of the squares of the largest magnitudes, to both sides.",
            example: r#"Srss(cases: ["along x", "along y"])"#,
            fields: &[CASES_COMBINED],
        },
        &Block {
            name: "Envelope",
            meaning: "Largest of the largest values and smallest of the smallest, and which case they come from.",
            example: r#"Envelope(cases: ["quake 1", "quake 2", "quake 3"])"#,
            fields: &[CASES_COMBINED],
        },
    ],
};
