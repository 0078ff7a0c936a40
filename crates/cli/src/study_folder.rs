//! The folder of a study, looked at before anything runs.

use crate::Failure;
use crate::figure_files::Format;
use std::fs;
use std::path::{Path, PathBuf};
use trilith::results::FolderError;
use trilith_study::{Study, is_study_folder};

/// Refuses a folder in which results would replace an input, or what no study has made. The journal of a study stands
/// for its results; whose it is, is asked when it is opened.
pub(crate) fn look(study: &Study, folder: &Path, formats: &[Format]) -> Result<(), Failure> {
    let of_study = is_study_folder(folder);
    for path in written(study, folder, formats) {
        let same = |input: &&PathBuf| {
            let both = (fs::canonicalize(input), fs::canonicalize(&path));
            matches!(both, (Ok(a), Ok(b)) if a == b)
        };
        let models = study.sources().map(|source| &source.path);
        if let Some(input) = std::iter::once(&study.path).chain(models).find(same) {
            return Err(Failure::folder(&FolderError::Input(input.clone())));
        }
        if !of_study && fs::symlink_metadata(&path).is_ok() {
            return Err(Failure::folder(&FolderError::InTheWay { path, by: "sweep" }));
        }
    }
    Ok(())
}

/// What a study writes. Of figures those that are there: how many each drawing has is known at the end.
fn written(study: &Study, folder: &Path, formats: &[Format]) -> Vec<PathBuf> {
    let mut names = vec!["table.parquet", "table.csv", "study.html", "made_by.json"];
    if study.plan.samples.is_some() || study.plan.ensemble.is_some() || !study.over.is_empty() {
        names.push("statistics.csv");
    }
    if study.histories.is_some() {
        names.push("runs");
    }
    let mut all: Vec<PathBuf> = names.into_iter().map(|name| folder.join(name)).collect();
    let is_figure = |name: &str| {
        formats.iter().any(|format| {
            let number = name.strip_suffix(&format!(".{}", format.ending()));
            let number = number.and_then(|name| name.strip_prefix("figure_"));
            let number = number.and_then(|rest| rest.split('_').next()?.parse::<usize>().ok());
            number.is_some_and(|n| (1..=study.figures.len()).contains(&n))
        })
    };
    let there = fs::read_dir(folder).into_iter().flatten().flatten();
    all.extend(
        there.filter(|e| e.file_name().to_str().is_some_and(is_figure)).map(|entry| entry.path()),
    );
    all
}
