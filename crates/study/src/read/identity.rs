//! What tells the runs of a study from those of another.

use crate::{Column, Condition, Identity, Plan};
use sha2::{Digest, Sha256};
use std::path::PathBuf;
use trilith::element::{FileText, Value};
use trilith::model::{Model, ModelText};
use trilith::{Registry, SolverKind};

/// Most combinations of texts whose time functions are looked at one by one.
const MOST: usize = 10_000;

fn hexadecimal(digest: impl AsRef<[u8]>) -> String {
    digest.as_ref().iter().map(|b| format!("{b:02x}")).collect()
}

/// What a model has read from other files: its functions of time, and files that parameters of elements name.
fn seen_of(model: &Model) -> String {
    let mut all = format!("{:?}", model.functions);
    let mut told: Vec<&FileText> = Vec::new();
    for (_, value) in model.elements.iter().flat_map(|e| &e.values.0) {
        if let Value::File(file) = value
            && !told.contains(&&**file)
        {
            told.push(file);
            all += &format!("{file:?}");
        }
        if let Value::Matrix(matrix) = value {
            all += &matrix.sha256;
        }
    }
    all
}

/// Figures, events and statistics are left out: they can change without a run. `files` gets those that models read beside
/// their own.
pub(super) fn identity(
    parsed: &ModelText,
    plan: &Plan,
    registry: &Registry,
    first: &[(String, String)],
    how: &(usize, Option<SolverKind>, Option<String>),
    columns: &[Column],
    stop: &Option<Option<Condition>>,
    files: &mut Vec<PathBuf>,
) -> Option<Identity> {
    let mut read = |model: &Model| {
        for path in &model.files {
            if !files.contains(path) {
                files.push(path.clone());
            }
        }
    };
    let study = hexadecimal(Sha256::digest(format!("{plan:?}\n{how:?}\n{columns:?}\n{stop:?}")));
    // Records are named by texts: every text of every axis and point, one after the other.
    let mut motions = Sha256::new();
    let model = parsed.read(registry, first).ok()?;
    motions.update(seen_of(&model));
    read(&model);
    let is_text = |name: &str| {
        let text = |p: &trilith::model::Parameter| {
            p.name == name && matches!(p.value, trilith::model::ParameterValue::Text(_))
        };
        model.parameters.iter().any(text)
    };
    let axes = plan.axes.iter().flat_map(|a| a.values.iter().map(|v| (&a.name, v)));
    let points = plan.rows.iter().flatten().map(|(n, v)| (n, v));
    let mut seen: Vec<(&String, &String)> = Vec::new();
    for (name, value) in axes.chain(points).filter(|(name, _)| is_text(name)) {
        if seen.contains(&(name, value)) || seen.len() > MOST {
            continue;
        }
        seen.push((name, value));
        let mut set = first.to_vec();
        set.retain(|(n, _)| n != name);
        set.push((name.clone(), value.clone()));
        if let Ok(model) = parsed.read(registry, &set) {
            motions.update(seen_of(&model));
            read(&model);
        }
    }
    Some(Identity {
        version: trilith::VERSION.to_owned(),
        build: trilith::BUILD.to_owned(),
        study,
        model: String::new(),
        motions: hexadecimal(motions.finalize()),
        runs: 0,
    })
}
