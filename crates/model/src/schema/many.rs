//! Many at once: repetition, groups, other files.

use super::Takes::Words;
use super::{Block, Group, absent, needed};

/// Sections that an included file may hold, beside `units` of its own bare numbers and `include`.
pub const INCLUDED: [&str; 13] = [
    "parameters",
    "nodes",
    "supports",
    "properties",
    "elements",
    "groups",
    "functions",
    "loads",
    "cases",
    "combinations",
    "outputs",
    "spectra",
    "envelopes",
];
/// Sections in which nothing is repeated, and braces stand for themselves.
pub const AS_IT_STANDS: [&str; 3] = ["include", "units", "parameters"];

/// What a group may be of.
pub static GROUP_KINDS: [&str; 2] = ["Nodes", "Elements"];

/// Repetition.
pub static REPETITION: Group = Group {
    name: "repetition",
    meaning: "As the value of an entry of a map it makes many entries, as an item of a list many items.",
    blocks: &[&Block {
        name: "For",
        meaning: "Repeats `of` for all values of its indices, the last index running fastest. Any other name among the \
                  fields is an index; it takes `\"0 to 4\"` (both ends included, with expressions such as `\"1 to storeys\"`), \
                  a list of values, or a map from what stands in names to values.",
        example: r#"For(i: "1 to 4", d: [Ux, Uy], when: "i != 2", of: Displacement(node: "m", dof: "{d}", factor: "2*i"))"#,
        fields: &[
            needed("of", Words("anything that may stand in its place"), "What is repeated."),
            absent(
                "when",
                Words("a condition in quotes: comparisons `== != < <= > >=`, `and`, `or`, `not`"),
                "always",
                "Which repetitions are made.",
            ),
        ],
    }],
};
