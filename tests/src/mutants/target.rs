//! What reads a file.

use crate::{registry, root};
use serde_json::Value;
use trilith::RunOptions;
use trilith::exercise::{Coordinate, History};
use trilith::model::{Analysis, Model, quantity};
use trilith::record::{ReadOptions, parse};
use trilith::report::{RunData, run_page};
use trilith_element::dimension::LENGTH;
use trilith_exchange::{Options, sap2000};
use trilith_model::read_text;
use trilith_solvers::{EndState, assemble};
use trilith_study::Study;

/// A reader of files.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Target {
    /// Of a model, with what `trilith check` makes of it.
    Model,
    /// Of a model, whose last case is then run.
    Run,
    /// Of a study and its model.
    Study,
    /// Of an acceleration record.
    Record,
    /// Of a text model of SAP2000, and of the model that comes of it.
    Import,
    /// Of a checkpoint, behind its checksum.
    Checkpoint,
    /// Of the data of a report, behind their checksum, with the page of them.
    Report,
    /// Of a history that a link is led along.
    History,
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
            Self::Model => Ok(model(&text())?.is_some()),
            Self::Run => match model(&text())? {
                Some(model) => run(&model),
                None => Ok(false),
            },
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
            Self::Import => match sap2000::import(bytes, &Options::default()) {
                Ok(import) => Ok(model(&import.draft.to_ron())?.is_some()),
                Err(_) => Ok(false),
            },
            Self::Checkpoint => Ok(serde_json::from_slice::<EndState>(bytes).is_ok()),
            Self::Report => {
                let Ok(data) = serde_json::from_slice::<RunData>(bytes) else { return Ok(false) };
                Ok(!run_page(&Value::Null, &data, &Value::Null).is_empty())
            }
            Self::History => {
                let u1 = Coordinate { name: "U1".into(), rotation: false };
                let Ok(history) = History::parse(&text(), &[u1]) else { return Ok(false) };
                let all = history.time.iter().chain(&history.deformation[0]);
                if all.copied().all(f64::is_finite) { Ok(true) } else { Err("a history") }
            }
            Self::Quantity => match quantity(&text(), LENGTH) {
                Ok(x) if !x.is_finite() => Err("a quantity"),
                answer => Ok(answer.is_ok()),
            },
        }
    }
}

/// A model as `trilith check` lets it through.
fn model(text: &str) -> Result<Option<Model>, &'static str> {
    let path = root().join("models/mutant.ron");
    let Ok(model) = read_text(text, path, &registry(), &[]) else { return Ok(None) };
    let Ok(system) = assemble(&model) else { return Ok(None) };
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
            return Ok(None);
        }
    }
    Ok(Some(model))
}

/// Substeps that a run may take.
const WORK: usize = 500;

/// Runs the last case, within its budget; true where it came to its end.
fn run(model: &Model) -> Result<bool, &'static str> {
    let Some(case) = model.cases.len().checked_sub(1) else { return Ok(false) };
    let Ok(analysis) = trilith::Analysis::new(model) else { return Ok(false) };
    let options = RunOptions { case, substeps: Some(WORK), ..RunOptions::default() };
    let Ok(run) = analysis.without_histories().run(options) else { return Ok(false) };
    let good = run.result.status.is_good();
    let mut peaks = run.record.peaks().iter().flat_map(|p| [p.max, p.min, p.last]);
    let finite = peaks.all(f64::is_finite);
    if good && !finite { Err("a result") } else { Ok(good) }
}
