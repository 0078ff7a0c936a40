//! What reads a file.

use crate::{registry, root};
use trilith::model::{Analysis, quantity};
use trilith::record::{ReadOptions, parse};
use trilith_element::dimension::LENGTH;
use trilith_model::read_text;
use trilith_solvers::{EndState, assemble};
use trilith_study::Study;

/// A reader of files.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Target {
    /// Of a model, with what `trilith check` makes of it.
    Model,
    /// Of a study and its model.
    Study,
    /// Of an acceleration record.
    Record,
    /// Of a checkpoint.
    Checkpoint,
    /// Of a quantity on the command line.
    Quantity,
}

impl Target {
    /// Reads; true where the file is let through.
    ///
    /// # Errors
    /// Where something is not a number.
    pub(super) fn read(self, bytes: &[u8]) -> Result<bool, &'static str> {
        let text = || String::from_utf8_lossy(bytes);
        match self {
            Self::Model => model(&text()),
            Self::Study => {
                let path = root().join("models/studies/mutant.ron");
                Ok(Study::read_text(&text(), path, &registry(), &[]).is_ok())
            }
            Self::Record => {
                let Ok(records) = parse(bytes, "mutant", &ReadOptions::default()) else {
                    return Ok(false);
                };
                let mut values = records.iter().flat_map(|r| &r.acceleration);
                if values.any(|a| !a.is_finite()) { Err("an acceleration") } else { Ok(true) }
            }
            Self::Checkpoint => Ok(serde_json::from_slice::<EndState>(bytes).is_ok()),
            Self::Quantity => match quantity(&text(), LENGTH) {
                Ok(x) if !x.is_finite() => Err("a quantity"),
                answer => Ok(answer.is_ok()),
            },
        }
    }
}

fn model(text: &str) -> Result<bool, &'static str> {
    let path = root().join("models/mutant.ron");
    let Ok(model) = read_text(text, path, &registry(), &[]) else { return Ok(false) };
    let Ok(system) = assemble(&model) else { return Ok(false) };
    for (matrix, place) in [(&system.stiffness, "a stiffness"), (&system.mass, "a mass")] {
        if matrix.entries().any(|(_, _, x)| !x.is_finite()) {
            return Err(place);
        }
    }
    let is_static = |a: &Analysis| matches!(a, Analysis::Static(_));
    for with_mass in [false, true] {
        if model.cases.iter().any(|c| is_static(&c.analysis) != with_mass)
            && system.check_supported(&model, with_mass).is_err()
        {
            return Ok(false);
        }
    }
    Ok(true)
}
