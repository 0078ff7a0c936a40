//! `trilith run --figure`: single figures of a run as files.

use crate::Failure;
use crate::figure_files::{self, Format};
use crate::names;
use std::path::{Path, PathBuf};
use trilith::model::Body;
use trilith::report::{ENERGY, GROUND, SPECTRA, named_figures};
use trilith::{Analysis, Model, Run};

/// Names of outputs, of links, or `energy`, `ground`, `spectra`.
pub(crate) fn check(model: &Model, names: &[String]) -> Result<(), Failure> {
    let known: Vec<&str> = [ENERGY, GROUND, SPECTRA]
        .into_iter()
        .chain(model.outputs.iter().map(|o| o.name.as_str()))
        .chain(links(model))
        .collect();
    match names.iter().find(|n| !known.contains(&n.as_str())) {
        None => Ok(()),
        Some(name) => {
            let help = names::help(name, "figures", "--figure", known.into_iter());
            Err(Failure::input(&format!("there is no figure of \"{name}\""), Some(&help)))
        }
    }
}

fn links(model: &Model) -> impl Iterator<Item = &str> + Clone {
    model.elements.iter().filter(|e| matches!(e.body, Body::Link(..))).map(|e| e.name.as_str())
}

/// Writes the figures into the folder of a run.
pub(crate) fn write(
    analysis: &Analysis<'_>,
    run: &Run,
    dir: &Path,
    names: &[String],
    formats: &[Format],
) -> Result<Vec<PathBuf>, Failure> {
    if names.is_empty() {
        return Ok(Vec::new());
    }
    let loops: Vec<String> = names
        .iter()
        .filter(|n| links(analysis.model()).any(|l| l == n.as_str()))
        .cloned()
        .collect();
    let data = run.report(analysis, &[], &loops);
    let mut written = Vec::new();
    for name in names {
        let figures = named_figures(&data, name);
        if figures.is_empty() {
            let message = format!(
                "nothing to draw of \"{name}\": it was not recorded in this case, or does not move"
            );
            return Err(Failure::input(&message, None));
        }
        for (file, figure) in figures {
            written.extend(figure_files::write(dir, &file, &figure, formats)?);
        }
    }
    Ok(written)
}
