//! The report in the folder of a run.

use crate::{Analysis, Error, Run};
use std::path::{Path, PathBuf};
use trilith_report::{Collect, RunData, run_page};
use trilith_results::FileError;

/// Up to this many equations, modes are looked for where the run did not find them itself.
const MODES: usize = 1000;
/// What the page is made from, beside `summary.json`.
const DATA: &str = "report.json";
const PAGE: &str = "report.html";
const SUMMARY: &str = "summary.json";

/// A folder whose report cannot be made again.
#[derive(Debug, thiserror::Error)]
pub enum ReportError {
    /// A file that is not there or is no text.
    #[error("{} cannot be read: {cause}", .path.display())]
    Unreadable {
        /// The file.
        path: PathBuf,
        /// Why.
        cause: std::io::Error,
    },
    /// A file that is not what `trilith run` writes.
    #[error("{} is not what this program writes: {cause}", .path.display())]
    Foreign {
        /// The file.
        path: PathBuf,
        /// Where it differs.
        cause: serde_json::Error,
    },
}

impl Run {
    /// What the report of this run shows. `loops` names the links whose hysteresis loops are wanted; none:
    /// those that dissipate most.
    #[must_use]
    pub fn report(
        &self,
        analysis: &Analysis<'_>,
        overrides: &[(String, String)],
        loops: &[String],
    ) -> RunData {
        let model = analysis.model();
        let case = model.case(&self.result.case);
        let found = match &self.result.basis {
            Some(_) => None,
            // Nothing is lost where a structure has no modes.
            None if analysis.system().order() <= MODES => analysis.modes(case).ok(),
            None => None,
        };
        Collect {
            model,
            case: case.unwrap_or(model.cases.len()),
            dt: Some(self.result.end.dt).filter(|dt| *dt > 0.0),
            record: &self.record,
            summary: &self.summary(model),
            modes: self.result.basis.as_ref().or(found.as_ref()),
            overrides,
            loops,
        }
        .data()
    }
}

/// Writes `report.json` and `report.html` into the folder of a run, beside its `summary.json`.
///
/// # Errors
/// [`Error::File`] with the path, [`Error::Report`] where the folder has no summary.
pub fn write_report(dir: impl AsRef<Path>, data: &RunData) -> Result<PathBuf, Error> {
    let path = dir.as_ref().join(DATA);
    let text = serde_json::to_string(data)
        .map_err(|e| FileError { path: path.clone(), cause: e.into() })?;
    write(&path, &text)?;
    page(dir.as_ref(), data)
}

/// Makes `report.html` again from the files in the folder of a run.
///
/// # Errors
/// [`Error::Report`] where these are not there, [`Error::File`] where the page cannot be written.
pub fn rebuild_report(dir: impl AsRef<Path>) -> Result<PathBuf, Error> {
    let data: RunData = read(&dir.as_ref().join(DATA))?;
    page(dir.as_ref(), &data)
}

fn page(dir: &Path, data: &RunData) -> Result<PathBuf, Error> {
    let summary: serde_json::Value = read(&dir.join(SUMMARY))?;
    let path = dir.join(PAGE);
    write(&path, &run_page(&summary, data))?;
    Ok(path)
}

fn write(path: &Path, text: &str) -> Result<(), Error> {
    let path = path.to_owned();
    Ok(std::fs::write(&path, text).map_err(|cause| FileError { path, cause })?)
}

fn read<T: serde::de::DeserializeOwned>(path: &Path) -> Result<T, ReportError> {
    let text = std::fs::read_to_string(path)
        .map_err(|cause| ReportError::Unreadable { path: path.to_owned(), cause })?;
    serde_json::from_str(&text)
        .map_err(|cause| ReportError::Foreign { path: path.to_owned(), cause })
}
