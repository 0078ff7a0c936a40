//! Reading whole models with made-up kinds.

mod bounds;
mod combinations;
mod damaged;
mod grouped;
mod in_json;
mod included;
mod kinds;
mod refusals;
mod repetition;
mod waveforms;
mod whole;

use crate::{Diagnostic, Model, read_text};
use kinds::registry;

/// The smallest model, with `extra` fields at its top level.
fn small(extra: &str) -> String {
    format!(
        r#"(
    nodes: {{ "a": (0, 0, 0), "b": (0, 0, "2 m") }},
    elements: {{ "k": Spring(nodes: ("a", "b"), stiffness: "1 kN/m") }},
    cases: {{ "rest": Static(loads: [Gravity]) }},
    {extra}
)"#
    )
}

fn model(text: &str) -> Model {
    model_with(text, &[])
}

fn model_with(text: &str, overrides: &[(&str, &str)]) -> Model {
    read_with(text, overrides).unwrap_or_else(|e| panic!("{}", shown(&e)))
}

fn errors(text: &str) -> Vec<Diagnostic> {
    read_with(text, &[]).expect_err("the model should be refused")
}

fn read_with(text: &str, overrides: &[(&str, &str)]) -> Result<Model, Vec<Diagnostic>> {
    let overrides: Vec<_> =
        overrides.iter().map(|(n, v)| ((*n).to_owned(), (*v).to_owned())).collect();
    read_text(text, "test.ron", &registry(), &overrides)
}

fn shown(errors: &[Diagnostic]) -> String {
    errors.iter().map(ToString::to_string).collect::<Vec<_>>().join("\n")
}
