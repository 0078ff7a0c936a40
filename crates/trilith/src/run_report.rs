//! The report in the folder of a run.

use crate::{Analysis, Error, Run, report_check};
use serde::de::DeserializeOwned;
use serde_json::Value;
use std::ops::Deref;
use std::path::{Path, PathBuf};
use trilith_model::Model;
use trilith_report::{Collect, RunData, Sections, run_page};
use trilith_results::{FileError, Summary};
use trilith_solvers::{Linearised, LinkStiffness};

/// Up to this many equations, modes are looked for where the run did not find them itself.
const MODES: usize = 1000;
/// Up to this many equations, modes with links are looked for.
const LINKED: usize = 5000;
/// How many.
const COUNT: usize = 12;
/// What the page is made from, beside `summary.json`.
const DATA: &str = "report.json";
const PAGE: &str = "report.html";
/// What made the folder, where the program wrote it.
const MADE: &str = "made_by.json";
pub(crate) const SUMMARY: &str = "summary.json";

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
    /// A file that lacks something.
    #[error("{} is incomplete: it has no {}", .path.display(), .missing.join(", "))]
    Incomplete {
        /// The file.
        path: PathBuf,
        /// Keys that are not there.
        missing: Vec<&'static str>,
    },
    /// Data of another program.
    #[error("{} has format {found}, this program reads format {known}", .path.display())]
    OtherFormat {
        /// The file.
        path: PathBuf,
        /// Its format.
        found: u32,
        /// The format that is read here.
        known: u32,
    },
    /// Files of two runs in one folder.
    #[error(
        "summary.json and report.json in {} are of two runs: the {what} of the first is {summary}, of the second {data}",
        .folder.display()
    )]
    TwoRuns {
        /// The folder.
        folder: PathBuf,
        /// What differs.
        what: &'static str,
        /// What `summary.json` says.
        summary: String,
        /// What `report.json` says.
        data: String,
    },
    /// A file in which something was changed after it was written.
    #[error(
        "{} is not as it was written: its `{key}` is {stated}, that of its content {found}",
        .path.display()
    )]
    Altered {
        /// The file.
        path: PathBuf,
        /// Where it states its sum.
        key: &'static str,
        /// The sum that it states.
        stated: String,
        /// The sum that its content has.
        found: String,
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
    pub fn report<M: Deref<Target = Model>>(
        &self,
        analysis: &Analysis<M>,
        overrides: &[(String, String)],
        loops: &[String],
    ) -> RunData {
        let summary = self.summary(analysis.model());
        self.report_of(analysis, &summary, overrides, loops, &Sections::all())
    }

    /// The same with the [summary](Self::summary) of this run, which is there already: its floor spectra take as long as a
    /// short march. What only sections show that are not wanted is left out.
    #[must_use]
    pub fn report_of<M: Deref<Target = Model>>(
        &self,
        analysis: &Analysis<M>,
        summary: &Summary,
        overrides: &[(String, String)],
        loops: &[String],
        sections: &Sections,
    ) -> RunData {
        let model = analysis.model();
        let case = model.case(&self.result.case);
        let found = match &self.result.basis {
            Some(_) => None,
            // Nothing is lost where a structure has no modes.
            None if analysis.system().order() <= MODES => analysis.modes(case).ok(),
            None => None,
        };
        let linear = match sections.have("modes") && analysis.system().order() <= LINKED {
            true => analysis.linearised(&LinkStiffness::Engaged, None).ok(),
            false => None,
        };
        let linear = linear.filter(Linearised::has_stiff_links);
        let linked = linear.as_ref().and_then(|linear| linear.modes(COUNT).ok());
        Collect {
            model,
            case: case.unwrap_or(model.cases.len()),
            dt: Some(self.result.end.dt).filter(|dt| *dt > 0.0),
            record: &self.record,
            summary,
            weight: analysis.system().total_mass * model.gravity.abs(),
            modes: self.result.basis.as_ref().or(found.as_ref()),
            linked: linear.as_ref().zip(linked.as_ref()),
            overrides,
            loops,
            sections,
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
    write(&path, &report_check::sealed(&text))?;
    page(dir.as_ref(), &summary(dir.as_ref())?, data)
}

/// Makes `report.html` again from the files in the folder of a run. They may come from another build of the program
/// that writes the same format.
///
/// # Errors
/// [`Error::Report`] where these are not there, not whole, not as they were written or not of one run;
/// [`Error::File`] where the page cannot be written.
pub fn rebuild_report(dir: impl AsRef<Path>) -> Result<PathBuf, Error> {
    let dir = dir.as_ref();
    let (path, text) = text(dir.join(DATA))?;
    report_check::format(&path, parsed(&path, &text)?)?;
    let data: RunData = parsed(&path, &report_check::unsealed(&path, &text)?)?;
    let summary = summary(dir)?;
    report_check::one_run(dir, &summary, &data)?;
    page(dir, &summary, &data)
}

fn summary(dir: &Path) -> Result<Value, ReportError> {
    let (path, text) = text(dir.join(SUMMARY))?;
    parsed(&path, &text)
}

fn page(dir: &Path, summary: &Value, data: &RunData) -> Result<PathBuf, Error> {
    let path = dir.join(PAGE);
    // Made by hand in a program there may be none.
    let made = trilith_record::file::read_text(dir.join(MADE)).ok();
    let made = made.and_then(|text| serde_json::from_str(&text).ok()).unwrap_or(Value::Null);
    write(&path, &run_page(summary, data, &made))?;
    Ok(path)
}

fn write(path: &Path, text: &str) -> Result<(), Error> {
    let path = path.to_owned();
    Ok(std::fs::write(&path, text).map_err(|cause| FileError { path, cause })?)
}

fn text(path: PathBuf) -> Result<(PathBuf, String), ReportError> {
    match trilith_record::file::read_text(&path) {
        Ok(text) => Ok((path, text)),
        Err(cause) => Err(ReportError::Unreadable { path, cause }),
    }
}

fn parsed<T: DeserializeOwned>(path: &Path, text: &str) -> Result<T, ReportError> {
    serde_json::from_str(text)
        .map_err(|cause| ReportError::Foreign { path: path.to_owned(), cause })
}
