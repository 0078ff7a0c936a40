//! Whether the files that a report is made from are whole, as they were written, and of one run.

use crate::run_report::{ReportError, SUMMARY};
use serde::Deserialize;
use serde_json::Value;
use std::path::Path;
use trilith_report::{RunData, RunIdentity};
use trilith_results::Summary;

/// What a summary has, whatever the run.
const KEYS: [&str; 17] = [
    "version",
    "build",
    "run_sha256",
    "model",
    "parameters",
    "case",
    "solver",
    "status",
    "message",
    "work",
    "outputs",
    "energy",
    "link_energy",
    "contact",
    "basis",
    "spectra",
    "warnings",
];

/// What `report.json` says of itself; its other keys hang on that.
#[derive(Deserialize)]
pub(crate) struct Head {
    format: Option<u32>,
}

/// Refuses a `report.json` that another program must read.
pub(crate) fn format(path: &Path, head: Head) -> Result<(), ReportError> {
    let known = RunData::FORMAT;
    match head.format {
        Some(found) if found == known => Ok(()),
        Some(found) => Err(ReportError::OtherFormat { path: path.to_owned(), found, known }),
        None => Err(ReportError::Incomplete { path: path.to_owned(), missing: vec!["format"] }),
    }
}

/// Refuses a summary that is not whole or was altered, and one of another run than the data beside it.
pub(crate) fn one_run(dir: &Path, summary: &Value, data: &RunData) -> Result<(), ReportError> {
    let path = || dir.join(SUMMARY);
    let missing: Vec<_> = KEYS.into_iter().filter(|key| summary.get(key).is_none()).collect();
    if !missing.is_empty() {
        return Err(ReportError::Incomplete { path: path(), missing });
    }
    let text = |value: &Value| value.as_str().map_or_else(|| value.to_string(), str::to_owned);
    let RunIdentity { version, build, model, case, solver, run_sha256 } = &data.run;
    let same = |what, there: &Value, here: &str| {
        let summary = text(there);
        if summary == here {
            return Ok(());
        }
        let (folder, data) = (dir.to_owned(), here.to_owned());
        Err(ReportError::TwoRuns { folder, what, summary, data })
    };
    same("SHA-256 of the model", &summary["model"]["sha256"], model)?;
    same("case", &summary["case"], case)?;
    same("solver", &summary["solver"], solver)?;
    same("version of the program", &summary["version"], version)?;
    same("build of the program", &summary["build"], build)?;
    let (stated, found) = (text(&summary["run_sha256"]), Summary::digest(summary));
    if stated != found {
        return Err(ReportError::Altered { path: path(), stated, found });
    }
    same("`run_sha256`", &summary["run_sha256"], run_sha256)
}
