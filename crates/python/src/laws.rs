//! Laws of links from Python and from shared libraries.
//!
//! A run is in a thread without the interpreter's lock. A law in plain Python takes the lock for each answer, so that the laws of
//! a sweep on many threads wait for each other, and nobody waits for the law who holds the lock: the thread that waits for
//! the run gives it up meanwhile (`work`). A law that was compiled, and one of a library, is called by its address.

use crate::exercise;
use crate::failure::Failure;
use crate::plain::Plain;
use crate::work;
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;
use std::panic::{AssertUnwindSafe, catch_unwind, resume_unwind};
use std::path::PathBuf;
use std::sync::atomic::{AtomicBool, AtomicUsize, Ordering};
use std::sync::{Arc, Mutex, PoisonError};
use std::time::{Duration, Instant};
use trilith::Registry;
use trilith::element::Stroke;
use trilith::element::conformance::Kit;
use trilith_cli::told;
use trilith_foreign::{Compiled, Declaration, Kind, LawFunction, Library, NoAnswer};

/// A kind of link that is no built-in one.
#[pyclass(frozen, module = "trilith._native")]
pub(crate) struct Law {
    kind: Kind,
    digest: String,
}

/// The laws that a model is read with, beside the built-in ones.
#[derive(Clone, Default)]
pub(crate) struct Laws(Arc<[(Kind, String)]>);

impl Laws {
    pub fn new(all: &[Py<Law>]) -> Result<Self, Failure> {
        let built_in = trilith::registry();
        let mut names: Vec<&str> = Vec::new();
        for law in all {
            let name = law.get().kind.card().kind;
            if built_in.card(name).is_some() || names.contains(&name) {
                let whose = if names.contains(&name) { "another law" } else { "a built-in kind" };
                let message = format!("a law is called `{name}`, as {whose} is");
                return Err(Failure::argument(&message, Some("each kind needs a name of its own")));
            }
            names.push(name);
        }
        Ok(Self(all.iter().map(|l| (l.get().kind.clone(), l.get().digest.clone())).collect()))
    }

    /// All kinds that a model may name.
    pub fn registry(&self) -> Registry {
        let mut registry = trilith::registry();
        self.0.iter().for_each(|(kind, _)| kind.register(&mut registry));
        registry
    }

    /// Does what asks laws again and again. A thread that is new to Python would be made known to it, and forgotten, with every
    /// answer, which takes longer than the answer; here it is known all the time, and has the lock while it asks alone.
    pub fn beside<T: Send>(&self, job: impl FnOnce() -> T + Send) -> T {
        let call = (!self.0.is_empty()).then(Call::begin).flatten();
        if call.is_none() || Python::try_attach(|_| ()).is_none() {
            return job();
        }
        let done = Python::attach(|py| {
            py.detach(|| {
                let done = catch_unwind(AssertUnwindSafe(job));
                while OVER.load(Ordering::SeqCst) {
                    std::thread::park();
                }
                done
            })
        });
        done.unwrap_or_else(|panic| resume_unwind(panic))
    }

    /// Whether a kind is one of these.
    pub fn has(&self, name: &str) -> bool {
        self.0.iter().any(|(kind, _)| kind.card().kind == name)
    }

    /// What goes behind the build of the program where runs are kept.
    pub fn digest(&self) -> String {
        self.0.iter().map(|(kind, digest)| format!("+{}:{digest}", kind.card().kind)).collect()
    }
}

/// Calls of Python that are going on, and whether the interpreter comes to its end: none may begin then, as a thread that
/// waits for its lock would wait for ever, or be ended in the middle.
static CALLS: AtomicUsize = AtomicUsize::new(0);
static ENDING: AtomicBool = AtomicBool::new(false);

/// Nobody waits for laws any more: whoever would need the interpreter's lock from now on must not ask for it.
static OVER: AtomicBool = AtomicBool::new(false);

pub(crate) struct Call;

impl Call {
    pub fn begin() -> Option<Self> {
        CALLS.fetch_add(1, Ordering::SeqCst);
        let call = Self;
        (!ENDING.load(Ordering::SeqCst)).then_some(call)
    }
}

impl Drop for Call {
    fn drop(&mut self) {
        CALLS.fetch_sub(1, Ordering::SeqCst);
    }
}

/// No law in Python begins an answer from now on; waits for those that do, but not for one that has no end.
#[pyfunction]
pub(crate) fn end_of_laws(py: Python<'_>) {
    const LONGEST: Duration = Duration::from_secs(2);
    ENDING.store(true, Ordering::SeqCst);
    py.detach(|| {
        let start = Instant::now();
        while CALLS.load(Ordering::SeqCst) > 0 && start.elapsed() < LONGEST {
            std::thread::sleep(Duration::from_millis(1));
        }
        OVER.store(true, Ordering::SeqCst);
    });
}

/// Exceptions that laws have raised, by what is told of them; those that nobody asked for go one day.
static RAISED: Mutex<Vec<(String, PyErr)>> = Mutex::new(Vec::new());
const MOST_RAISED: usize = 16;

/// The exception behind a text that tells of it.
pub(crate) fn raised(py: Python<'_>, text: &str) -> Option<PyErr> {
    let all = RAISED.lock().unwrap_or_else(PoisonError::into_inner);
    let found = all.iter().rev().find(|(message, _)| text.contains(message.as_str()));
    found.map(|(_, e)| e.clone_ref(py))
}

/// What an exception means, in words that `Plain.words` finds for it.
pub(crate) fn no_answer(py: Python<'_>, law: &Bound<'_, PyAny>, e: PyErr) -> NoAnswer {
    let words = law.call_method1("words", (e.value(py), e.traceback(py)));
    let words = words.and_then(|words| words.extract::<(bool, String)>());
    let (refused, text) = words.unwrap_or_else(|_| (false, e.to_string()));
    if refused {
        return NoAnswer::Refused(text);
    }
    let mut all = RAISED.lock().unwrap_or_else(PoisonError::into_inner);
    if all.len() == MOST_RAISED {
        all.remove(0);
    }
    all.push((text.clone(), e));
    NoAnswer::Failed(text)
}

fn declaration(text: &str) -> Result<Declaration, Failure> {
    serde_json::from_str(text).map_err(|e| Failure::argument(&format!("the law: {e}"), None))
}

fn made(
    py: Python<'_>,
    declaration: &Declaration,
    function: Arc<dyn LawFunction>,
    digest: String,
) -> PyResult<Law> {
    let kind = Kind::new(declaration, function);
    let kind = kind.map_err(|e| Failure::argument(&e.to_string(), None).into_exception(py))?;
    Ok(Law { kind, digest })
}

#[pymethods]
impl Law {
    /// A law in Python.
    #[staticmethod]
    fn plain(py: Python<'_>, text: &str, function: Py<PyAny>, digest: String) -> PyResult<Self> {
        let declaration = declaration(text).map_err(|e| e.into_exception(py))?;
        made(py, &declaration, Arc::new(Plain::new(py, function)?), digest)
    }

    /// A law that was compiled, by its address, which is good as long as `keep` is there; and the same in Python, which says
    /// what is wrong.
    #[staticmethod]
    fn compiled(
        py: Python<'_>,
        text: &str,
        function: Py<PyAny>,
        address: usize,
        keep: Py<PyAny>,
        digest: String,
    ) -> PyResult<Self> {
        let declaration = declaration(text).map_err(|e| e.into_exception(py))?;
        let plain = Plain::new(py, function.clone_ref(py))?;
        // The lengths are known once the declaration is understood.
        let sizes = Kind::new(&declaration, Arc::new(Plain::new(py, function)?))
            .map_err(|e| Failure::argument(&e.to_string(), None).into_exception(py))?
            .sizes();
        // SAFETY: `trilith._compiled`, the only caller, compiles a function of this signature for these lengths, which holds no
        // reference to the interpreter and catches what is raised in it; `keep` is the object that holds its code.
        #[allow(unsafe_code)]
        let compiled = unsafe { Compiled::new(address, sizes, Arc::new(keep), plain) };
        let compiled = compiled.ok_or_else(|| PyValueError::new_err("an address of 0"))?;
        made(py, &declaration, Arc::new(compiled), digest)
    }

    /// The laws of a shared library.
    #[staticmethod]
    fn library(py: Python<'_>, path: PathBuf) -> PyResult<Vec<Self>> {
        let opened = work::run(py, move |_| {
            let plain = |text: String| Failure::File(told::plain(&text, None));
            let kinds = Library::open(&path).map_err(|e| plain(e.to_string()))?;
            let bytes = std::fs::read(&path);
            let bytes = bytes.map_err(|e| plain(format!("{}: {e}", path.display())))?;
            Ok((kinds, trilith::results::sha256(&bytes)))
        });
        let (kinds, digest) = opened?;
        Ok(kinds.into_iter().map(|kind| Self { kind, digest: digest.clone() }).collect())
    }

    /// Its name in model files.
    #[getter]
    fn kind(&self) -> &'static str {
        self.kind.card().kind
    }

    /// Whether it says what it stores and turns to heat.
    #[getter]
    fn accounts(&self) -> bool {
        self.kind.accounts()
    }
}

/// What the conformance kit looked at: tangent columns, those at kinks, largest error of the energy balance, coordinates.
type Conformance = (usize, usize, f64, Vec<String>);

/// Leads a law along random paths and asks whether it keeps the contract of links.
#[pyfunction]
#[pyo3(signature = (kind, laws, set, amplitude, mean, frequency, flags, paths, seed, tolerance))]
pub(crate) fn conform(
    py: Python<'_>,
    kind: String,
    laws: Vec<Py<Law>>,
    set: Vec<(String, String)>,
    amplitude: Vec<(String, String)>,
    mean: Vec<(String, String)>,
    frequency: Option<f64>,
    flags: (bool, bool),
    paths: usize,
    seed: u64,
    tolerance: f64,
) -> PyResult<Conformance> {
    work::run(py, move |_| {
        let registry = Laws::new(&laws)?.registry();
        let specimen = exercise::specimen(&registry, &kind, &set)?;
        let motion = exercise::motion(&specimen, &amplitude, &mean, frequency, 1)?;
        let size = |s: &Stroke| if s.amplitude == 0.0 { s.mean.abs() } else { s.amplitude.abs() };
        let sizes: Vec<f64> = motion.strokes.iter().map(size).collect();
        let means: Vec<f64> = motion.strokes.iter().map(|s| s.mean).collect();
        let (rate_independent, active) = flags;
        let mut kit = Kit::new(&sizes, motion.frequency)
            .about(&means)
            .paths(paths)
            .seed(seed)
            .energy_tolerance(tolerance);
        if rate_independent {
            kit = kit.rate_independent();
        }
        if active {
            kit = kit.active();
        }
        let report = kit.check(&*specimen.law).map_err(|e| {
            Failure::Conformance(format!(
                "{} does not keep the contract of links: {e}",
                specimen.line
            ))
        })?;
        let coordinates = specimen.coordinates().into_iter().map(|c| c.name).collect();
        Ok((report.tangents, report.skipped, report.energy_error, coordinates))
    })
}
