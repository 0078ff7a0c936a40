//! The state at the end of a run, from which another goes on.

use crate::failure::Failure;
use pyo3::prelude::*;
use pyo3::types::PyBytes;
use std::sync::Arc;
use trilith::solvers::EndState;

/// The state at the end of a run.
#[pyclass(frozen, module = "trilith._native")]
pub(crate) struct State(pub Arc<EndState>);

#[pymethods]
impl State {
    /// From what [`to_bytes`](Self::to_bytes) gave.
    #[staticmethod]
    fn from_bytes(py: Python<'_>, bytes: &[u8]) -> PyResult<Self> {
        let read = serde_json::from_slice(bytes).map(Arc::new);
        read.map(Self).map_err(|e| {
            Failure::argument(&format!("these bytes are no state of a run: {e}"), None)
                .into_exception(py)
        })
    }

    /// All of it; numbers read back to the bit.
    fn to_bytes<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyBytes>> {
        let bytes = serde_json::to_vec(&*self.0)
            .map_err(|e| Failure::Internal(e.to_string()).into_exception(py))?;
        Ok(PyBytes::new(py, &bytes))
    }

    /// Time in the case, s.
    #[getter]
    fn time(&self) -> f64 {
        self.0.time
    }

    /// Name of the case.
    #[getter]
    fn case(&self) -> &str {
        &self.0.case
    }

    /// Name of the solver.
    #[getter]
    fn solver(&self) -> &str {
        &self.0.solver
    }

    /// For pickles and copies.
    fn __reduce__<'py>(
        &self,
        py: Python<'py>,
    ) -> PyResult<(Bound<'py, PyAny>, (Bound<'py, PyBytes>,))> {
        Ok((py.get_type::<Self>().getattr("from_bytes")?, (self.to_bytes(py)?,)))
    }

    fn __repr__(&self) -> String {
        let EndState { case, solver, time, .. } = &*self.0;
        format!("<State of case '{case}' by {solver} at {time} s>")
    }

    fn __eq__(&self, other: &Self) -> bool {
        *self.0 == *other.0
    }
}
