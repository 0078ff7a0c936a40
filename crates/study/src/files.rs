//! The files of a finished study.

use crate::table::{self, replaced};
use crate::{Records, Study, StudyError};
use std::io::Write;
use std::path::{Path, PathBuf};

pub(crate) fn write(
    study: &Study,
    records: &Records,
    left_out: usize,
    folder: &Path,
) -> Result<Vec<PathBuf>, StudyError> {
    let runs = &records.rows();
    let mut written = Vec::new();
    let mut path = |name: &str| {
        written.push(folder.join(name));
        folder.join(name)
    };
    table::write(study, runs, [&path("table.parquet"), &path("table.csv")])?;
    if study.has_groups() {
        study.statistics(runs).write_csv(&path("statistics.csv"))?;
    }
    let html = crate::page::page(study, runs, left_out);
    replaced(&path("study.html"), |file| file.write_all(html.as_bytes()))?;
    Ok(written)
}
