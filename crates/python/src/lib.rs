//! Trilith for Python: the native half of the package `trilith`, module `trilith._native`.
//!
//! What a user meets is written in Python (`python/trilith`), with types and documentation; here is what calls the
//! library and hands over what it found. Four rules hold all through it:
//!
//! - Whatever may take long goes through `work`: in a thread of its own, without the interpreter's lock, so that Ctrl-C
//!   is answered at once and other threads of Python go on. A panic comes out as an exception.
//! - Results stay where the library left them. A `column::Column` shows NumPy a list of numbers in place, by the array
//!   interface, which needs no unsafe code here, and NumPy itself is not loaded before the first of them is looked at.
//! - What is unsafe is in the crate `foreign`, but for one line of `laws` that vouches for the address of a law that was
//!   compiled in Python.
//! - Errors carry the text of the program, caret included (`trilith_cli::told`).

mod catalogue;
mod column;
mod combine;
mod compare;
mod exercise;
mod failure;
mod laws;
mod links;
mod model;
mod modes;
mod optimize;
mod plain;
mod record;
mod reduce;
mod run;
mod schema;
mod state;
mod study;
mod sweep;
mod work;

use pyo3::prelude::*;

/// The native half of `trilith`; nothing in here is meant to be called by users.
#[pymodule(gil_used = false)]
mod _native {
    use super::{PyResult, Python};
    #[pymodule_export]
    use crate::catalogue::elements;
    #[pymodule_export]
    use crate::column::Column;
    #[pymodule_export]
    use crate::exercise::exercise;
    #[pymodule_export]
    use crate::laws::{Law, conform, end_of_laws};
    #[pymodule_export]
    use crate::model::Model;
    #[pymodule_export]
    use crate::record::{Record, record, synthetic};
    #[pymodule_export]
    use crate::run::{Run, page, pictures};
    #[pymodule_export]
    use crate::schema::schema;
    #[pymodule_export]
    use crate::state::State;
    #[pymodule_export]
    use crate::study::{Study, machine_of_results};
    #[pymodule_export]
    use crate::sweep::sweep;
    use pyo3::prelude::*;
    use pyo3::types::PyModule;
    use std::ffi::OsString;

    #[pymodule_init]
    fn init(module: &Bound<'_, PyModule>) -> PyResult<()> {
        module.add("VERSION", trilith::VERSION)?;
        module.add("HEADER", trilith_foreign::HEADER)?;
        module.add("BUILD", trilith::BUILD)
    }

    /// Runs the program `trilith` with these arguments, the first being its name, and ends the process.
    #[pyfunction]
    fn program(py: Python<'_>, arguments: Vec<OsString>) {
        py.detach(|| trilith_cli::main_of(trilith::registry(), arguments))
    }

    /// Fails as no code should, for the test that a panic comes out as an exception.
    #[pyfunction]
    fn panic_for_a_test(py: Python<'_>) -> PyResult<()> {
        crate::work::run(py, |_| -> Result<(), crate::failure::Failure> { panic!("on purpose") })
    }
}
