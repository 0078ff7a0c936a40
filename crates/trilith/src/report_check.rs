//! Whether the files that a report is made from are whole, as they were written, and of one run.

use crate::run_report::{ReportError, SUMMARY};
use serde::Deserialize;
use serde_json::Value;
use std::path::Path;
use trilith_model::visible_line;
use trilith_report::{RunData, RunIdentity};
use trilith_results::{Summary, sha256};

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

/// Where a `report.json` states the SHA-256 of the rest of it: its first key.
const SUM: &str = "sha256";

/// A JSON object with the sum of its text before the rest.
pub(crate) fn sealed(object: &str) -> String {
    format!("{{\"{SUM}\":\"{}\",{}", sha256(object.as_bytes()), object.get(1..).unwrap_or_default())
}

/// The object in such a text, of which nothing was changed.
pub(crate) fn unsealed(path: &Path, text: &str) -> Result<String, ReportError> {
    let stated = text.strip_prefix(&format!("{{\"{SUM}\":\"")).and_then(|t| t.split_once("\","));
    let Some((stated, rest)) = stated else {
        return Err(ReportError::Incomplete { path: path.to_owned(), missing: vec![SUM] });
    };
    let object = format!("{{{rest}");
    let found = sha256(object.as_bytes());
    if found != stated {
        let (path, stated) = (path.to_owned(), visible_line(stated).into_owned());
        return Err(ReportError::Altered { path, key: SUM, stated, found });
    }
    Ok(object)
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
        return Err(ReportError::Altered { path: path(), key: "run_sha256", stated, found });
    }
    same("`run_sha256`", &summary["run_sha256"], run_sha256)
}
