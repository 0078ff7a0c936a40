//! Models: read once, then run as often as one likes.

use crate::combine;
use crate::compare::{self, Ways};
use crate::failure::{Failure, Told, placed};
use crate::laws::{Law, Laws};
use crate::modes::{self, ModeFacts};
use crate::optimize;
use crate::reduce::{self, ReductionFacts, fixed_modes};
use crate::run::{self, Run, Settings};
use crate::state::State;
use crate::work;
use pyo3::prelude::*;
use std::path::PathBuf;
use std::sync::Arc;
use trilith::model::{Analysis as Kind, Body, ModelText, ParameterValue, file, resolved};
use trilith::optimize::{Variable, Wanted};
use trilith::reduce::Request;
use trilith::{Analysis, SolverKind};
use trilith_cli::told;

/// A model, with the text that it was read from.
#[pyclass(frozen, module = "trilith._native")]
pub(crate) struct Model {
    pub model: Arc<trilith::Model>,
    pub text: Arc<str>,
    pub path: PathBuf,
    /// Values of parameters that replace those of the text.
    pub set: Vec<(String, String)>,
    /// What it may name beside the built-in kinds.
    pub laws: Laws,
}

/// A case: name, `static` or `dynamic`, the case before, and of a dynamic one duration, output step and solver.
type CaseFacts = (String, &'static str, Option<String>, Option<(f64, f64, &'static str)>);
/// An element: name, kind, category, nodes.
type ElementFacts = (String, &'static str, &'static str, Vec<String>);

#[pymethods]
impl Model {
    /// Reads a model file.
    #[staticmethod]
    fn load(
        py: Python<'_>,
        path: PathBuf,
        set: Vec<(String, String)>,
        laws: Vec<Py<Law>>,
    ) -> PyResult<Self> {
        work::run(py, move |_| {
            let text = file::open(&path, "model").map_err(|e| Failure::diagnostics(&e))?;
            Self::of(text, path, set, Laws::new(&laws)?)
        })
    }

    /// Reads a model text; `path` is its name in errors, and files are looked for in its folder.
    #[staticmethod]
    fn read(
        py: Python<'_>,
        text: String,
        path: PathBuf,
        set: Vec<(String, String)>,
        laws: Vec<Py<Law>>,
    ) -> PyResult<Self> {
        work::run(py, move |_| Self::of(text, path, set, Laws::new(&laws)?))
    }

    #[getter]
    fn title(&self) -> &str {
        &self.model.title
    }

    #[getter]
    fn text(&self) -> &str {
        &self.text
    }

    #[getter]
    fn path(&self) -> PathBuf {
        self.path.clone()
    }

    #[getter]
    fn set(&self) -> Vec<(String, String)> {
        self.set.clone()
    }

    #[getter]
    fn sha256(&self) -> String {
        self.model.sha256()
    }

    /// Parameters: name, number or text, unit (none for a text).
    fn parameters(&self) -> Vec<(String, Option<f64>, Option<String>, String)> {
        let one = |p: &trilith::model::Parameter| match &p.value {
            ParameterValue::Number(x, d) => (p.name.clone(), Some(*x), None, d.unit()),
            ParameterValue::Text(t) => (p.name.clone(), None, Some(t.clone()), String::new()),
        };
        self.model.parameters.iter().map(one).collect()
    }

    fn nodes(&self) -> Vec<(String, [f64; 3])> {
        self.model.nodes.iter().map(|n| (n.name.clone(), n.position)).collect()
    }

    fn elements(&self) -> Vec<ElementFacts> {
        let one = |e: &trilith::model::Element| {
            let category = match e.body {
                Body::Linear(_) => "linear",
                Body::Constraint(_) => "constraint",
                Body::Link(..) => "link",
            };
            let nodes = e.nodes.iter().map(|n| self.model.nodes[*n].name.clone()).collect();
            (e.name.clone(), e.kind, category, nodes)
        };
        self.model.elements.iter().map(one).collect()
    }

    fn cases(&self) -> Vec<CaseFacts> {
        let one = |c: &trilith::model::Case| {
            let after = c.after.map(|i| self.model.cases[i].name.clone());
            let (kind, dynamic) = match &c.analysis {
                Kind::Static(_) => ("static", None),
                Kind::Dynamic(d) => ("dynamic", Some((d.duration, d.dt, d.solution.solver.name()))),
            };
            (c.name.clone(), kind, after, dynamic)
        };
        self.model.cases.iter().map(one).collect()
    }

    /// Outputs: name, unit.
    fn outputs(&self) -> Vec<(String, String)> {
        self.model.outputs.iter().map(|o| (o.name.clone(), o.unit.clone())).collect()
    }

    /// The model with every default filled in, as RON.
    fn resolved(&self) -> String {
        resolved(&self.model)
    }

    /// What there is to say of the model before it runs, the text of the program last.
    fn check(&self, py: Python<'_>) -> PyResult<Vec<(Told, String)>> {
        let model = Arc::clone(&self.model);
        work::run(py, move |_| Ok(check(&model)))
    }

    /// Modes of a case.
    fn modes(&self, py: Python<'_>, case: Option<String>) -> PyResult<ModeFacts> {
        let model = Arc::clone(&self.model);
        work::run(py, move |_| modes::of_structure(&model, case.as_deref()))
    }

    /// Modes with links.
    fn linked_modes(
        &self,
        py: Python<'_>,
        links: String,
        after: Option<String>,
        amplitude: Option<f64>,
        of: Option<Vec<String>>,
        count: usize,
    ) -> PyResult<ModeFacts> {
        let model = Arc::clone(&self.model);
        work::run(py, move |_| {
            let wanted = modes::Wanted { links: &links, amplitude, of: of.as_deref() };
            modes::linked(&model, &wanted, after.as_deref(), count)
        })
    }

    /// Runs a case.
    #[pyo3(signature = (case, solver, dt, until, vectors, errors, histories, frames, start, progress))]
    fn run(
        &self,
        py: Python<'_>,
        case: Option<String>,
        solver: Option<String>,
        dt: Option<f64>,
        until: Option<f64>,
        vectors: Option<usize>,
        errors: bool,
        histories: bool,
        frames: usize,
        start: Option<Py<State>>,
        progress: Option<Bound<'_, PyAny>>,
    ) -> PyResult<Run> {
        let model = Arc::clone(&self.model);
        let start = start.map(|state| Arc::clone(&state.get().0));
        let (set, laws) = (self.set.clone(), self.laws.clone());
        work::with_progress(py, progress.as_ref(), move |watch| {
            let case = index(&model, case.as_deref())?;
            let solver = solver.as_deref().map(kind).transpose()?;
            let settings =
                Settings { case, solver, dt, until, vectors, errors, histories, frames, start };
            laws.clone().beside(|| run::run(model, set, laws, settings, watch))
        })
    }

    /// Runs a case in several ways.
    #[pyo3(signature = (case, solvers, dts, vectors, dummies, alphas, cause))]
    fn compare(
        &self,
        py: Python<'_>,
        case: Option<String>,
        solvers: Vec<String>,
        dts: Vec<f64>,
        vectors: Vec<usize>,
        dummies: Vec<f64>,
        alphas: Vec<f64>,
        cause: bool,
    ) -> PyResult<(String, Vec<compare::Facts>)> {
        let (text, path, set) = (Arc::clone(&self.text), self.path.clone(), self.set.clone());
        let laws = self.laws.clone();
        work::run(py, move |watch| {
            // The comparison changes the model that it works on.
            let read = trilith::read_text(&text, path, &laws.registry(), &set);
            let mut model = read.map_err(|e| Failure::diagnostics(&e))?;
            let case = index(&model, case.as_deref())?;
            let solvers = solvers.iter().map(|s| kind(s)).collect::<Result<Vec<_>, _>>()?;
            let ways = Ways { solvers, dts, vectors, dummies, alphas, cause };
            compare::compare(&mut model, case, &ways, watch)
        })
    }

    /// Sums and envelopes of the extremes of cases.
    #[pyo3(signature = (of, progress))]
    fn combine(
        &self,
        py: Python<'_>,
        of: Vec<String>,
        progress: Option<Bound<'_, PyAny>>,
    ) -> PyResult<combine::CombinationFacts> {
        let model = Arc::clone(&self.model);
        work::with_progress(py, progress.as_ref(), move |watch| {
            combine::combine(&model, &of, watch)
        })
    }

    /// A superelement in place of a part.
    #[pyo3(signature = (part, modes, up_to, keep, recover, recover_all, out))]
    fn reduce(
        &self,
        py: Python<'_>,
        part: Vec<String>,
        modes: Option<usize>,
        up_to: Option<f64>,
        keep: Option<Vec<String>>,
        recover: Vec<String>,
        recover_all: bool,
        out: Option<(PathBuf, String)>,
    ) -> PyResult<ReductionFacts> {
        let model = Arc::clone(&self.model);
        let modes = fixed_modes(modes, up_to);
        let request = Request { part, keep, recover, recover_all, modes };
        work::run(py, move |_| {
            let out = out.as_ref().map(|(dir, form)| (dir.as_path(), form.as_str()));
            reduce::reduce(&model, &request, out)
        })
    }

    /// Derivatives of outputs by parameters.
    #[pyo3(signature = (case, solver, dt, by, of))]
    fn gradient(
        &self,
        py: Python<'_>,
        case: Option<String>,
        solver: Option<String>,
        dt: Option<f64>,
        by: Vec<String>,
        of: Vec<String>,
    ) -> PyResult<optimize::GradientFacts> {
        let (text, path, set) = (Arc::clone(&self.text), self.path.clone(), self.set.clone());
        let (model, laws) = (Arc::clone(&self.model), self.laws.clone());
        work::run(py, move |watch| {
            let text = ModelText::new(&text, path).map_err(|e| Failure::diagnostics(&e))?;
            let case = model.cases[index(&model, case.as_deref())?].name.clone();
            let solver = solver.as_deref().map(kind).transpose()?;
            let case = Some(case);
            let wanted = trilith::gradient::Wanted { case, solver, dt, by, set, input: false };
            optimize::gradient(&model, (&text, &laws.registry()), wanted, &of, watch)
        })
    }

    /// Values of parameters that make a goal smallest: parameters as name, bounds, and whether steps are shares of the value.
    #[pyo3(signature = (case, solver, dt, by, minimise, limits, max_runs, progress))]
    fn optimize(
        &self,
        py: Python<'_>,
        case: Option<String>,
        solver: Option<String>,
        dt: Option<f64>,
        by: Vec<(String, String, String, bool)>,
        minimise: Vec<String>,
        limits: Vec<String>,
        max_runs: usize,
        progress: Option<Bound<'_, PyAny>>,
    ) -> PyResult<optimize::OptimumFacts> {
        let (text, path, set) = (Arc::clone(&self.text), self.path.clone(), self.set.clone());
        let (model, laws) = (Arc::clone(&self.model), self.laws.clone());
        work::with_progress(py, progress.as_ref(), move |watch| {
            let text = ModelText::new(&text, path).map_err(|e| Failure::diagnostics(&e))?;
            let case = model.cases[index(&model, case.as_deref())?].name.clone();
            let solver = solver.as_deref().map(kind).transpose()?;
            let variable =
                |(name, low, high, logarithmic)| Variable { name, low, high, logarithmic };
            let by = by.into_iter().map(variable).collect();
            let case = Some(case);
            let wanted = Wanted { case, solver, dt, set, by, minimise, limits, max_runs };
            optimize::optimize(&model, (&text, &laws.registry()), &wanted, watch)
        })
    }
}

impl Model {
    fn of(
        text: String,
        path: PathBuf,
        set: Vec<(String, String)>,
        laws: Laws,
    ) -> Result<Self, Failure> {
        let model = trilith::read_text(&text, &path, &laws.registry(), &set)
            .map_err(|e| Failure::diagnostics(&e))?;
        Ok(Self { model: Arc::new(model), text: text.into(), path, set, laws })
    }
}

/// A value as JSON.
pub(crate) fn json(value: &impl serde::Serialize) -> Result<String, Failure> {
    serde_json::to_string(value).map_err(|e| Failure::Internal(e.to_string()))
}

/// The case of that name, or the last.
pub(crate) fn index(model: &trilith::Model, name: Option<&str>) -> Result<usize, Failure> {
    let Some(name) = name else {
        let last = model.cases.len().checked_sub(1);
        return last.ok_or_else(|| Failure::argument("the model has no case", None));
    };
    let names = model.cases.iter().map(|c| c.name.as_str());
    model.case(name).ok_or_else(|| Failure::unknown("case", name, "cases", names))
}

/// The solver of that name.
pub(crate) fn kind(name: &str) -> Result<SolverKind, Failure> {
    let names = SolverKind::ALL.iter().map(|s| s.name());
    let found = SolverKind::ALL.into_iter().find(|s| s.name() == name);
    found.ok_or_else(|| Failure::unknown("solver", name, "solvers", names))
}

/// What `trilith check` says: the first error of the assembly, or all warnings.
fn check(model: &trilith::Model) -> Vec<(Told, String)> {
    let wrong = |e: trilith::Error| vec![(placed(&e, model), told::error(&e, model))];
    let analysis = match Analysis::new(model) {
        Ok(analysis) => analysis,
        Err(e) => return wrong(e),
    };
    let is_static = |k: &Kind| matches!(k, Kind::Static(_));
    for with_mass in [false, true] {
        if model.cases.iter().any(|c| is_static(&c.analysis) != with_mass)
            && let Err(e) = analysis.system().check_supported(model, with_mass)
        {
            return wrong(e.into());
        }
    }
    let warning = |message: String| {
        let file = model.source.path.display().to_string();
        let text = format!("warning: {message}");
        (("warning", String::new(), message, String::new(), None, file, 0, 0), text)
    };
    match trilith::solvers::warnings(model) {
        Ok(warnings) => warnings.into_iter().map(warning).collect(),
        Err(e) => wrong(e.into()),
    }
}
