//! `trilith run --figure`: single figures of a run as files.

use crate::Failure;
use crate::figure_files::{self, Format};
use crate::names;
use std::path::{Path, PathBuf};
use trilith::element::{Coordinates, Dof};
use trilith::model::{Body, Element};
use trilith::report::{ENERGY, GROUND, MODEL, RunData, SPECTRA, named_figures};
use trilith::{Analysis, Model, Run};

/// Names of outputs, of links, or `energy`, `ground`, `spectra`, `model`.
pub(crate) fn check(model: &Model, names: &[String]) -> Result<(), Failure> {
    let known: Vec<&str> = [ENERGY, GROUND, SPECTRA, MODEL]
        .into_iter()
        .chain(model.shown().map(|(_, o)| o.name.as_str()))
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

/// Most figures of the ground motion: one for each direction, and its spectrum.
const MOTIONS: usize = 12;

/// The names that files of these figures may have.
pub(crate) fn files(model: &Model, names: &[String], formats: &[Format]) -> Vec<String> {
    let mut all = Vec::new();
    for name in names {
        let links = || model.elements.iter().filter(|e| e.name == *name);
        if name == GROUND || name == SPECTRA {
            let most = MOTIONS.max(model.spectra.len());
            all.extend((1..=most).map(|i| format!("{name}_{i}")));
        }
        all.extend(links().flat_map(|e| coordinates(model, e)).map(|c| format!("{name}_{c}")));
        all.push(name.clone());
    }
    let plain = |c: char| if c.is_alphanumeric() || "_-.".contains(c) { c } else { '_' };
    let all = all.iter().map(|name| name.chars().map(plain).collect::<String>());
    all.flat_map(|name| formats.iter().map(move |f| format!("{name}.{}", f.ending()))).collect()
}

/// The names of what a link works on.
fn coordinates(model: &Model, element: &Element) -> Vec<String> {
    let Body::Link(law, _) = &element.body else { return Vec::new() };
    match law.coordinates() {
        Coordinates::Local(axes) => axes.iter().map(|axis| axis.name().to_owned()).collect(),
        Coordinates::Nodal { nodes } => {
            let nodes = element.nodes.iter().take(nodes).map(|n| &model.nodes[*n].name);
            let of = |node: &String| Dof::ALL.map(|dof| format!("{node} {}", dof.name()));
            let all = nodes.flat_map(of);
            all.chain(Dof::ALL.map(|dof| dof.name().to_owned())).collect()
        }
    }
}

/// What the figures show.
pub(crate) fn data(analysis: &Analysis<&Model>, run: &Run, names: &[String]) -> RunData {
    let loops: Vec<String> = names
        .iter()
        .filter(|n| links(analysis.model()).any(|l| l == n.as_str()))
        .cloned()
        .collect();
    run.report(analysis, &[], &loops)
}

/// Writes the figures into the folder of a run.
pub(crate) fn write(
    data: &RunData,
    dir: &Path,
    names: &[String],
    formats: &[Format],
) -> Result<Vec<PathBuf>, Failure> {
    let mut written = Vec::new();
    for name in names {
        let figures = named_figures(data, name);
        if figures.is_empty() {
            let message = format!(
                "nothing to draw of \"{name}\": it was not recorded in this case, or does not move"
            );
            return Err(Failure::input(&message, None));
        }
        for (file, drawing) in figures {
            written.extend(figure_files::write(dir, &file, &drawing, formats)?);
        }
    }
    Ok(written)
}
