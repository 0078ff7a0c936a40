//! The files of a finished study.

use crate::table::{self, replaced};
use crate::{Record, Study, StudyError};
use std::io::Write;
use std::path::{Path, PathBuf};

pub(crate) fn write(
    study: &Study,
    records: &[Record],
    left_out: usize,
    folder: &Path,
) -> Result<Vec<PathBuf>, StudyError> {
    let mut written = Vec::new();
    let mut path = |name: &str| {
        written.push(folder.join(name));
        folder.join(name)
    };
    table::write(study, records, [&path("table.parquet"), &path("table.csv")])?;
    if study.has_groups() {
        study.statistics(records).write_csv(&path("statistics.csv"))?;
    }
    let html = crate::page::page(study, records, left_out);
    replaced(&path("study.html"), |file| file.write_all(html.as_bytes()))?;
    Ok(written)
}
