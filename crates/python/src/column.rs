//! Lists of numbers that NumPy reads where they stand.

use crate::run::Kept;
use pyo3::prelude::*;
use pyo3::types::PyDict;
use std::sync::Arc;

/// A list of numbers, never changed. `numpy.asarray` makes a read-only array of it without a copy, which keeps it alive.
#[pyclass(frozen, module = "trilith._native")]
pub(crate) struct Column(Place);

/// Where the numbers are.
enum Place {
    Own(Vec<f64>),
    Of(Arc<Kept>, Series),
}

/// A list in what a run left.
#[derive(Clone, Copy)]
pub(crate) enum Series {
    Time,
    Output(usize),
    Energy(usize),
    Deformation(usize),
    Force(usize),
}

impl Column {
    /// Numbers of its own.
    pub fn new(values: Vec<f64>) -> Self {
        Self(Place::Own(values))
    }

    /// Numbers of a run.
    pub fn of(run: &Arc<Kept>, series: Series) -> Self {
        Self(Place::Of(Arc::clone(run), series))
    }

    fn values(&self) -> &[f64] {
        match &self.0 {
            Place::Own(values) => values,
            Place::Of(kept, series) => {
                let record = &kept.run.record;
                let all = match series {
                    Series::Time => Some(record.time()),
                    Series::Output(i) => record.history(*i),
                    Series::Energy(i) => record.energy().get(*i).map(Vec::as_slice),
                    Series::Deformation(i) => kept.links.deformation(*i),
                    Series::Force(i) => kept.links.force(*i),
                };
                all.unwrap_or_default()
            }
        }
    }
}

#[pymethods]
impl Column {
    fn __len__(&self) -> usize {
        self.values().len()
    }

    /// Version 3 of NumPy's array interface: where the numbers are, and that they are to be read only. The array that is
    /// made of it holds this object, and this object holds the numbers, which nothing moves.
    #[getter]
    fn __array_interface__<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyDict>> {
        let values = self.values();
        let all = PyDict::new(py);
        all.set_item("version", 3)?;
        all.set_item("typestr", if cfg!(target_endian = "little") { "<f8" } else { ">f8" })?;
        all.set_item("shape", (values.len(),))?;
        all.set_item("data", (values.as_ptr().addr(), true))?;
        Ok(all)
    }
}
