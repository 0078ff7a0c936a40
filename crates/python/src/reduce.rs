//! A superelement in place of a part of a model.

use crate::failure::Failure;
use crate::model::json;
use serde_json::json as object;
use std::path::{Path, PathBuf};
use std::sync::Arc;
use trilith::Analysis;
use trilith::model::Model;
use trilith::reduce::{FILES, FixedModes, MatrixForm, ReduceError, Reduced, Request};
use trilith::results::{Folder, FolderError, Writer};

/// The reduced model as one text, or as a file where it was to be written; and what became of what, as JSON.
pub(crate) type ReductionFacts = (Option<String>, Option<PathBuf>, String);

/// The fixed-interface modes: up to a frequency in Hz, so many, or all.
pub(crate) fn fixed_modes(count: Option<usize>, up_to: Option<f64>) -> FixedModes {
    match (count, up_to) {
        (_, Some(frequency)) => FixedModes::UpTo(frequency),
        (Some(count), None) => FixedModes::Count(count),
        (None, None) => FixedModes::All,
    }
}

/// Reduces a part; `out`: the folder that the files go to, and the form of the matrices.
pub(crate) fn reduce(
    model: &Arc<Model>,
    request: &Request,
    out: Option<(&Path, &str)>,
) -> Result<ReductionFacts, Failure> {
    let form = out.map(|(_, form)| matrix_form(form)).transpose()?;
    let analysis = Analysis::new(Arc::clone(model)).map_err(|e| Failure::of(&e, model))?;
    let reduced = analysis.reduce(request).map_err(|e| refused(&e, model))?;
    let facts = object!({
        "name": reduced.name,
        "elements": reduced.elements,
        "equations": reduced.equations,
        "kept": reduced.kept,
        "recovered": reduced.recovered,
        "rows": reduced.rows,
        "frequency": reduced.frequencies,
        "available": reduced.available,
        "effective_mass": reduced.effective_mass,
        "inner_mass": reduced.inner_mass,
    });
    let (text, path) = match out.zip(form) {
        Some(((dir, _), form)) => (None, Some(write(&reduced, model, dir, form)?)),
        None => (Some(reduced.text()), None),
    };
    Ok((text, path, json(&facts)?))
}

/// Writes the files of a reduced model; the path of the model.
fn write(
    reduced: &Reduced<'_>,
    model: &Model,
    dir: &Path,
    form: MatrixForm,
) -> Result<PathBuf, Failure> {
    let failed = |e: std::io::Error| Failure::File(format!("{}: {e}", dir.display()));
    let of_folder = |e: FolderError| Failure::File(e.to_string());
    let files = reduced.files(form).map_err(failed)?;
    let writes = files.iter().map(|(name, _)| name.clone()).collect();
    let writer = Writer { name: "reduce", own: &FILES, writes, inputs: model.inputs() };
    let folder = Folder::open(dir, writer).map_err(of_folder)?;
    for (name, content) in files {
        std::fs::write(folder.path().join(name), content).map_err(failed)?;
    }
    folder.publish().map_err(of_folder)?;
    Ok(dir.join(FILES[0]))
}

fn matrix_form(name: &str) -> Result<MatrixForm, Failure> {
    match name {
        "npz" => Ok(MatrixForm::Npz),
        "mtx" => Ok(MatrixForm::Market),
        "dmig" => Ok(MatrixForm::Dmig),
        "op4" => Ok(MatrixForm::Op4),
        _ => {
            Err(Failure::unknown("form of matrices", name, "forms", ["npz", "mtx", "dmig", "op4"]))
        }
    }
}

fn refused(error: &ReduceError, model: &Model) -> Failure {
    match error {
        ReduceError::Model(e) => Failure::of(e, model),
        ReduceError::Reduction(e) => Failure::Run(e.to_string()),
        e => Failure::argument(&e.to_string(), e.help()),
    }
}
