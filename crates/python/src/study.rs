//! Studies.

use crate::column::Column;
use crate::failure::Failure;
use crate::laws::{Law, Laws};
use crate::work;
use pyo3::prelude::*;
use pyo3::types::PyBytes;
use std::path::PathBuf;
use std::sync::Arc;
use trilith_cli::told;
use trilith_study::{
    Data, How, Part, Progress, Shard, StudyError, Table, Values, execute, machine, status,
};

/// A column of the table: numbers (not a number where there is none), or texts.
type ColumnFacts = (String, String, Option<Column>, Option<Vec<Option<String>>>);

/// Title, columns, files, runs that were on disk, that were in the store, that failed, new runs in lanes, why none went
/// there.
type Facts = (String, Vec<ColumnFacts>, Vec<PathBuf>, usize, usize, usize, usize, Option<String>);

/// Which part (0 of 0: the whole), runs that it has, of how many, runs that failed, series to go.
type PartFacts = (usize, usize, usize, usize, usize, usize);

/// A study that has been read.
#[pyclass(frozen, module = "trilith._native")]
pub(crate) struct Study {
    study: Arc<trilith_study::Study>,
    laws: Laws,
}

fn failure(e: &StudyError) -> Failure {
    let text = told::plain(&e.to_string(), Some(e.help()));
    match e {
        StudyError::Interrupted { .. } => Failure::Run(text),
        _ => Failure::File(text),
    }
}

fn shard_of((index, of): (usize, usize)) -> Result<Shard, Failure> {
    let wrong = || Failure::argument(&format!("there is no part {index} of {of}"), Some(PARTS));
    Shard::new(index, of).ok_or_else(wrong)
}

const PARTS: &str = "parts are counted from 1, such as `(3, 20)`, and there are 1000 at most";

#[pymethods]
impl Study {
    #[new]
    fn new(
        py: Python<'_>,
        path: PathBuf,
        set: Vec<(String, String)>,
        laws: Vec<Py<Law>>,
    ) -> PyResult<Self> {
        work::run(py, move |_| {
            let laws = Laws::new(&laws)?;
            let read = trilith_study::Study::read(&path, &laws.registry(), &set);
            let mut study = read.map_err(|e| Failure::diagnostics(&e))?;
            // Runs with other laws are those of another program.
            study.identity.build += &laws.digest();
            Ok(Self { study: Arc::new(study), laws })
        })
    }

    /// Its title.
    #[getter]
    fn title(&self) -> String {
        self.study.title.clone()
    }

    /// What tells its runs from those of another: version, build, sums of study, model and motions, number of runs.
    #[getter]
    fn identity(&self) -> (String, String, String, String, String, usize) {
        let i = self.study.identity.clone();
        (i.version, i.build, i.study, i.model, i.motions, i.runs)
    }

    /// Number of series of runs that follow each other.
    #[getter]
    fn series(&self) -> usize {
        self.study.identity.runs / self.study.plan.chain_length()
    }

    /// True where histories of runs are kept.
    #[getter]
    fn keeps_histories(&self) -> bool {
        self.study.histories.is_some()
    }

    /// The files that it is read from: its own, those of the model, and those that its runs read.
    #[getter]
    fn files(&self) -> Vec<PathBuf> {
        let study = &self.study;
        let mut all = vec![study.path.clone()];
        all.extend(study.sources().map(|source| source.path.clone()));
        all.extend(study.files.iter().cloned());
        all
    }

    /// Runs it, or a part of it, into a folder, or goes on with it. `shard`: which part of how many; `gather`: makes no run.
    #[pyo3(signature = (folder, threads, shard, gather, retry_failed, store, progress))]
    #[expect(clippy::too_many_arguments, reason = "of a function of Python")]
    fn run(
        &self,
        py: Python<'_>,
        folder: PathBuf,
        threads: Option<usize>,
        shard: Option<(usize, usize)>,
        gather: bool,
        retry_failed: bool,
        store: Option<PathBuf>,
        progress: Option<Bound<'_, PyAny>>,
    ) -> PyResult<Facts> {
        let (study, laws) = (Arc::clone(&self.study), self.laws.clone());
        work::with_progress(py, progress.as_ref(), move |watch| {
            let part = match shard {
                Some(shard) => Part::Shard(shard_of(shard)?),
                None if gather => Part::Gather,
                None => Part::All,
            };
            let cores = std::thread::available_parallelism().map_or(1, std::num::NonZero::get);
            let show = |p: Progress| watch.tell(p.done as f64 / p.total.max(1) as f64);
            let threads = threads.unwrap_or(cores);
            let how = How { threads, part, retry_failed, store: store.as_deref() };
            let registry = laws.registry();
            let results = execute(&study, &registry, &folder, how, &show, &watch.interrupt)
                .map_err(|e| failure(&e))?;
            let table = Table::of(&study, &results.records.rows());
            let (resumed, reused, failed) = (results.resumed, results.reused, results.failed());
            let columns = table.columns.into_iter().map(column).collect();
            let title = study.title.clone();
            let (files, beside, alone) = (results.files, results.beside, results.alone);
            Ok((title, columns, files, resumed, reused, failed, beside, alone))
        })
    }

    /// How far the parts in a folder are, and how many series are to go in all.
    fn status(&self, py: Python<'_>, folder: PathBuf) -> PyResult<(Vec<PartFacts>, usize)> {
        let study = Arc::clone(&self.study);
        work::run(py, move |_| {
            let (parts, open) = status(&study, &folder).map_err(|e| failure(&e))?;
            let facts = |p: &trilith_study::PartStatus| {
                let (index, of) = match p.part {
                    Part::Shard(shard) => (shard.index(), shard.of()),
                    Part::All | Part::Gather => (0, 0),
                };
                (index, of, p.done, p.of, p.failed, p.open)
            };
            Ok((parts.iter().map(facts).collect(), open))
        })
    }

    /// The parts of so many that are not done in a folder, by their number, each with a journal of what is known of it.
    fn open_parts(
        &self,
        py: Python<'_>,
        folder: PathBuf,
        of: usize,
        retry_failed: bool,
    ) -> PyResult<Vec<(usize, Py<PyBytes>)>> {
        let study = Arc::clone(&self.study);
        let parts = work::run(py, move |_| {
            shard_of((1, of))?;
            study.open_parts(&folder, of, retry_failed).map_err(|e| failure(&e))
        })?;
        let one =
            |(shard, known): (Shard, Vec<u8>)| (shard.index(), PyBytes::new(py, &known).unbind());
        Ok(parts.into_iter().map(one).collect())
    }

    /// Adds the journal of what a part has made elsewhere to that of the part in a folder; returns how many runs it has.
    fn take_part(
        &self,
        py: Python<'_>,
        folder: PathBuf,
        shard: (usize, usize),
        journal: Vec<u8>,
    ) -> PyResult<usize> {
        let study = Arc::clone(&self.study);
        work::run(py, move |_| {
            study.take_part(&folder, shard_of(shard)?, &journal).map_err(|e| failure(&e))
        })
    }
}

/// What results hang on beside the program; machines that say the same come to the same bits.
#[pyfunction]
#[pyo3(name = "machine")]
pub(crate) fn machine_of_results() -> String {
    machine()
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
