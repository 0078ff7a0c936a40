//! Runs, and what they leave.

use crate::column::{Column, Series};
use crate::failure::Failure;
use crate::laws::Laws;
use crate::links::LinkHistories;
use crate::model::json;
use crate::state::State;
use crate::work::{self, Watch};
use pyo3::prelude::*;
use serde_json::Value;
use std::path::PathBuf;
use std::sync::Arc;
use trilith::report::{RunData, named_figures, run_page};
use trilith::results::{ENERGIES, Summary};
use trilith::solvers::{EndState, LawFault, Status};
use trilith::{Analysis, Checkpoint, RunOptions, SolverKind};
use trilith_cli::told;

/// How to run.
pub(crate) struct Settings {
    pub case: usize,
    pub solver: Option<SolverKind>,
    pub dt: Option<f64>,
    pub until: Option<f64>,
    pub vectors: Option<usize>,
    pub errors: bool,
    pub histories: bool,
    pub frames: usize,
    pub start: Option<Arc<EndState>>,
}

/// What a run left.
pub(crate) struct Kept {
    pub model: Arc<trilith::Model>,
    pub run: trilith::Run,
    pub links: LinkHistories,
    set: Vec<(String, String)>,
    laws: Laws,
    summary: Summary,
}

/// A finished run.
#[pyclass(frozen, module = "trilith._native")]
pub(crate) struct Run(Arc<Kept>);

/// A link: name, kind, and for each coordinate its name, whether it is a rotation, deformation and force.
type LinkFacts = (String, &'static str, Vec<(String, bool, Column, Column)>);

/// Runs a case.
pub(crate) fn run(
    model: Arc<trilith::Model>,
    set: Vec<(String, String)>,
    laws: Laws,
    settings: Settings,
    watch: &Watch,
) -> Result<Run, Failure> {
    let Settings { case, solver, dt, until, vectors, errors, histories, frames, start } = settings;
    let fail = |e: trilith::Error| Failure::of(&e, &model);
    let mut progress = |share| watch.tell(share);
    let options = RunOptions {
        case,
        solver,
        dt,
        until,
        vectors,
        substeps: None,
        step_errors: errors,
        from: start.map(Arc::unwrap_or_clone),
        progress: Some(&mut progress),
        interrupt: Some(&watch.interrupt),
    };
    let mut analysis = Analysis::new(Arc::clone(&model)).map_err(fail)?;
    let mut links = LinkHistories::default();
    let run = if histories {
        links = LinkHistories::new(&model);
        analysis = analysis.with_frames(frames).with_loops();
        analysis.observed(options, &mut [&mut links])
    } else {
        analysis.without_histories().run(options)
    };
    let run = run.map_err(fail)?;
    let summary = run.summary(&model);
    Ok(Run(Arc::new(Kept { model, run, links, set, laws, summary })))
}

impl Kept {
    /// What the page shows.
    fn data(&self, loops: &[String]) -> Result<RunData, Failure> {
        let analysis =
            Analysis::new(Arc::clone(&self.model)).map_err(|e| Failure::of(&e, &self.model))?;
        Ok(self.run.report(&analysis, &self.set, loops))
    }
}

#[pymethods]
impl Run {
    /// `summary.json`.
    fn summary(&self, py: Python<'_>) -> PyResult<String> {
        json(&self.0.summary).map_err(|e| e.into_exception(py))
    }

    /// What `trilith run` prints.
    fn text(&self) -> String {
        told::run(&self.0.model, &self.0.summary)
    }

    /// True for a run to be trusted.
    #[getter]
    fn good(&self) -> bool {
        self.0.run.result.status.is_good()
    }

    /// What is wrong with a law that is no built-in one, where that ended the run: as an exception, and its text.
    fn law_error<'py>(&self, py: Python<'py>) -> Option<Bound<'py, PyAny>> {
        let Status::Law { link, fault, .. } = &self.0.run.result.status else { return None };
        let element = self.0.model.elements.iter().find(|e| e.name == *link)?;
        if matches!(fault, LawFault::Refuses { .. }) || !self.0.laws.has(element.kind) {
            return None;
        }
        let text = format!("{} (kind {})", self.0.run.result.status.text(), element.kind);
        Some(Failure::Law(text).into_exception(py).into_value(py).into_bound(py).into_any())
    }

    /// The output times, s.
    fn time(&self) -> Column {
        Column::of(&self.0, Series::Time)
    }

    /// Outputs: name, history.
    fn outputs(&self) -> Vec<(String, Column)> {
        let one = |(i, o): (usize, &trilith::model::Output)| {
            (o.name.clone(), Column::of(&self.0, Series::Output(i)))
        };
        self.0.model.outputs.iter().enumerate().map(one).collect()
    }

    /// Energies: name, history.
    fn energies(&self) -> Vec<(&'static str, Column)> {
        let one =
            |(i, name): (usize, &&'static str)| (*name, Column::of(&self.0, Series::Energy(i)));
        ENERGIES.iter().enumerate().map(one).collect()
    }

    /// Links, where histories were kept.
    fn links(&self) -> Vec<LinkFacts> {
        let one = |l: &crate::links::LinkPlace| {
            let coordinate = |(i, (name, rotation)): (usize, (&String, &bool))| {
                let at = l.first + i;
                let d = Column::of(&self.0, Series::Deformation(at));
                let f = Column::of(&self.0, Series::Force(at));
                (name.clone(), *rotation, d, f)
            };
            let named = l.coordinates.iter().zip(&l.rotations).enumerate();
            (l.name.clone(), l.kind, named.map(coordinate).collect())
        };
        self.0.links.links.iter().map(one).collect()
    }

    /// The state at the end.
    fn end(&self) -> State {
        State(Arc::new(self.0.run.result.end.clone()))
    }

    /// What the page is made from, as JSON; `loops` names the links whose loops are wanted.
    fn data(&self, py: Python<'_>, loops: Vec<String>) -> PyResult<String> {
        let kept = Arc::clone(&self.0);
        work::run(py, move |_| {
            let links = kept.links.links.iter().map(|l| l.name.as_str());
            if let Some(name) = loops.iter().find(|n| !links.clone().any(|l| l == n.as_str())) {
                return Err(Failure::unknown("link", name, "links", links));
            }
            json(&kept.data(&loops)?)
        })
    }

    /// Writes all that `trilith run --out` writes but `made_by.json`; returns the files.
    fn write(&self, py: Python<'_>, folder: PathBuf, report: bool) -> PyResult<Vec<PathBuf>> {
        let kept = Arc::clone(&self.0);
        work::run(py, move |_| {
            let fail = |e: trilith::Error| Failure::of(&e, &kept.model);
            let mut files = kept.run.write(&kept.model, &folder).map_err(fail)?;
            if report {
                files.push(trilith::write_report(&folder, &kept.data(&[])?).map_err(fail)?);
            }
            Ok(files)
        })
    }

    /// Writes the state at the end as a checkpoint, which `trilith run --restart` takes.
    fn write_checkpoint(&self, py: Python<'_>, path: PathBuf) -> PyResult<()> {
        let kept = Arc::clone(&self.0);
        work::run(py, move |_| {
            let checkpoint = Checkpoint::new(kept.run.result.end.clone());
            checkpoint.write(&path).map_err(|e| Failure::File(told::plain(&e.to_string(), None)))
        })
    }
}

/// The page of a run that no folder keeps, from its summary and what [`Run::data`] gave.
#[pyfunction]
pub(crate) fn page(py: Python<'_>, summary: String, data: String) -> PyResult<String> {
    work::run(py, move |_| {
        let (summary, data) = parsed(&summary, &data)?;
        Ok(run_page(&summary, &data, &Value::Null))
    })
}

/// Figures of a run as SVG, by the names of outputs and links, `energy`, `ground`, `spectra` and `model`.
#[pyfunction]
pub(crate) fn pictures(
    py: Python<'_>,
    data: String,
    names: Vec<String>,
) -> PyResult<Vec<(String, String)>> {
    work::run(py, move |_| {
        let (_, data) = parsed("{}", &data)?;
        let all = names.iter().flat_map(|name| named_figures(&data, name));
        Ok(all.map(|(name, drawing)| (name, drawing.svg().to_owned())).collect())
    })
}

fn parsed(summary: &str, data: &str) -> Result<(Value, RunData), Failure> {
    let wrong =
        |e: serde_json::Error| Failure::argument(&format!("this is no data of a run: {e}"), None);
    Ok((serde_json::from_str(summary).map_err(wrong)?, serde_json::from_str(data).map_err(wrong)?))
}
