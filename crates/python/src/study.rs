//! Studies.

use crate::column::Column;
use crate::failure::Failure;
use crate::work;
use pyo3::prelude::*;
use std::path::PathBuf;
use trilith_cli::told;
use trilith_study::{Data, How, Progress, Study, StudyError, Table, Values, execute};

/// A column of the table: numbers (not a number where there is none), or texts.
type ColumnFacts = (String, String, Option<Column>, Option<Vec<Option<String>>>);

/// Title, columns, files, runs that were on disk, runs that failed, new runs in lanes, why none went there.
type Facts = (String, Vec<ColumnFacts>, Vec<PathBuf>, usize, usize, usize, Option<String>);

/// Runs a study into a folder, or goes on with it.
#[pyfunction]
#[pyo3(signature = (path, set, folder, threads, progress))]
pub(crate) fn study(
    py: Python<'_>,
    path: PathBuf,
    set: Vec<(String, String)>,
    folder: PathBuf,
    threads: Option<usize>,
    progress: Option<Bound<'_, PyAny>>,
) -> PyResult<Facts> {
    work::with_progress(py, progress.as_ref(), move |watch| {
        let registry = trilith::registry();
        let study = Study::read(&path, &registry, &set).map_err(|e| Failure::diagnostics(&e))?;
        let cores = std::thread::available_parallelism().map_or(1, std::num::NonZero::get);
        let show = |p: Progress| watch.tell(p.done as f64 / p.total.max(1) as f64);
        let how = How::threads(threads.unwrap_or(cores));
        let results =
            execute(&study, &registry, &folder, how, &show, &watch.interrupt).map_err(|e| {
                let text = told::plain(&e.to_string(), Some(e.help()));
                match e {
                    StudyError::Interrupted { .. } => Failure::Run(text),
                    _ => Failure::File(text),
                }
            })?;
        let table = Table::of(&study, &results.records);
        let (resumed, failed, beside) = (results.resumed, results.failed(), results.beside);
        let columns = table.columns.into_iter().map(column).collect();
        let title = study.title;
        Ok((title, columns, results.files, resumed, failed, beside, results.alone))
    })
}

fn column(data: Data) -> ColumnFacts {
    let Data { name, unit, values } = data;
    let numbers = |all: Vec<f64>| (Some(Column::new(all)), None);
    let (numbers, texts) = match values {
        Values::Counts(all) => {
            numbers(all.into_iter().map(|x| x.map_or(f64::NAN, |x| x as f64)).collect())
        }
        Values::Numbers(all) => numbers(all.into_iter().map(|x| x.unwrap_or(f64::NAN)).collect()),
        Values::Flags(all) => numbers(
            all.into_iter().map(|x| x.map_or(f64::NAN, |x| f64::from(u8::from(x)))).collect(),
        ),
        Values::Texts(all) => (None, Some(all)),
    };
    (name, unit, numbers, texts)
}
