//! A law in plain Python: what it is asked and how its answers are read.
//!
//! Three methods of the law are called for an answer, and nothing else of Python where they return numbers and tuples of
//! numbers; whatever else they return is left to `trilith._law.Plain`, which understands it or says what is wrong.

use crate::laws::{Call, no_answer};
use pyo3::exceptions::PyTypeError;
use pyo3::prelude::*;
use pyo3::types::{PyFloat, PyString, PyTuple, PyType};
use std::sync::{Mutex, PoisonError};
use trilith::element::{Energy, Kinematics, Response};
use trilith_foreign::{LawFunction, NoAnswer};

/// Laws with other parameters that are kept ready here; `trilith._law.Plain` keeps more of them.
const READY: usize = 16;

/// A law by its object of `trilith._law.Plain`, with what each answer takes of that.
#[derive(Debug)]
pub(crate) struct Plain {
    law: Py<PyAny>,
    force: Method,
    tangent: Option<Method>,
    energy: Option<Method>,
    /// True where tangents are two matrices.
    rates: bool,
    /// The classes of the history, and of the step that a method may ask for.
    memory: Py<PyAny>,
    step: Py<PyAny>,
    /// `numpy.array`, and `tuple.__new__`, which makes a named tuple of a tuple.
    array: Py<PyAny>,
    named: Py<PyAny>,
    ready: Mutex<Vec<Ready>>,
}

/// Parameters, and the law that has them.
type Ready = (Box<[f64]>, Py<PyAny>);

/// A method of the law, and whether it takes the step.
#[derive(Debug)]
struct Method {
    name: Py<PyString>,
    stepped: bool,
}

/// A question to the methods of a law.
struct Question<'a, 'py> {
    it: Bound<'py, PyAny>,
    d: Bound<'py, PyAny>,
    v: Bound<'py, PyAny>,
    at: &'a Kinematics<'a>,
    /// The history that is committed.
    memory: Bound<'py, PyAny>,
}

impl Plain {
    pub fn new(py: Python<'_>, law: Py<PyAny>) -> PyResult<Self> {
        let own = law.bind(py);
        let stepped = own.getattr("stepped")?;
        let method = |name: &str| -> PyResult<Option<Method>> {
            if !stepped.contains(name)? {
                return Ok(None);
            }
            let stepped = stepped.get_item(name)?.extract()?;
            Ok(Some(Method { name: PyString::intern(py, name).unbind(), stepped }))
        };
        let force = method("force")?.ok_or_else(|| PyTypeError::new_err("a law has a force"))?;
        let of_module =
            |module: &str, name: &str| Ok::<_, PyErr>(py.import(module)?.getattr(name)?.unbind());
        Ok(Self {
            force,
            tangent: method("tangent")?,
            energy: method("energy")?,
            rates: own.getattr("law")?.getattr("rates")?.is_truthy()?,
            memory: own.getattr("memory")?.unbind(),
            step: of_module("trilith._law", "LawStep")?,
            array: of_module("numpy", "array")?,
            named: PyType::new::<PyTuple>(py).getattr("__new__")?.unbind(),
            ready: Mutex::default(),
            law,
        })
    }

    fn ask<T>(&self, ask: impl FnOnce(&Bound<'_, PyAny>) -> PyResult<T>) -> Result<T, NoAnswer> {
        let ended = || NoAnswer::Failed("the interpreter has come to its end".into());
        let _call = Call::begin().ok_or_else(ended)?;
        let answer = Python::try_attach(|py| {
            let law = self.law.bind(py);
            ask(law).map_err(|e| no_answer(py, law, e))
        });
        answer.unwrap_or_else(|| Err(ended()))
    }

    /// The same where there is nothing to be refused but with words.
    fn tell<T>(&self, ask: impl FnOnce(&Bound<'_, PyAny>) -> PyResult<T>) -> Result<T, String> {
        self.ask(ask).map_err(|no| match no {
            NoAnswer::Refused(text) | NoAnswer::Failed(text) => text,
        })
    }

    /// The law with these parameters.
    fn at<'py>(&self, py: Python<'py>, parameters: &[f64]) -> PyResult<Bound<'py, PyAny>> {
        let ready = || self.ready.lock().unwrap_or_else(PoisonError::into_inner);
        if let Some((_, it)) = ready().iter().find(|(own, _)| **own == *parameters) {
            return Ok(it.bind(py).clone());
        }
        let it = self.law.bind(py).call_method1("at", (PyTuple::new(py, parameters)?,))?;
        let mut ready = ready();
        let last = if ready.len() == READY { Some(ready.remove(0)) } else { None };
        ready.push((parameters.into(), it.clone().unbind()));
        // The end of an object may run Python, which others may wait for who wait for this list.
        drop(ready);
        drop(last);
        Ok(it)
    }

    fn array<'py>(&self, py: Python<'py>, x: &[f64]) -> PyResult<Bound<'py, PyAny>> {
        self.array.bind(py).call1((PyTuple::new(py, x)?,))
    }

    fn history<'py>(&self, py: Python<'py>, x: &[f64]) -> PyResult<Bound<'py, PyAny>> {
        self.named.bind(py).call1((&self.memory, PyTuple::new(py, x)?))
    }

    fn question<'a, 'py>(
        &self,
        py: Python<'py>,
        parameters: &[f64],
        at: &'a Kinematics<'a>,
        committed: &[f64],
    ) -> PyResult<Question<'a, 'py>> {
        Ok(Question {
            it: self.at(py, parameters)?,
            d: self.array(py, at.d)?,
            v: self.array(py, at.v)?,
            at,
            memory: self.history(py, committed)?,
        })
    }

    /// What a method returns; `history`: what it is told of it.
    fn call<'py>(
        &self,
        method: &Method,
        asked: &Question<'_, 'py>,
        history: &Bound<'py, PyAny>,
    ) -> PyResult<Bound<'py, PyAny>> {
        let Question { it, d, v, at, memory } = asked;
        let py = it.py();
        let name = method.name.bind(py);
        if !method.stepped {
            return it.call_method1(name, (d, v, history));
        }
        let step = (self.array(py, at.d0)?, self.array(py, at.v0)?, at.dt, memory);
        let step = self.named.bind(py).call1((&self.step, step))?;
        it.call_method1(name, (d, v, history, step))
    }

    /// Forces, and the history at the end of the step.
    fn forces(
        &self,
        law: &Bound<'_, PyAny>,
        asked: &Question<'_, '_>,
        trial: &mut [f64],
        f: &mut [f64],
    ) -> PyResult<()> {
        let given = self.call(&self.force, asked, &asked.memory)?;
        let read = match trial.len() {
            0 => plain_numbers(&given, f),
            _ => {
                pair(&given).is_some_and(|[x, y]| plain_numbers(&x, f) && plain_numbers(&y, trial))
            }
        };
        if !read {
            let (forces, history): (Vec<f64>, Vec<f64>) =
                law.call_method1("forces", (given,))?.extract()?;
            copy(&forces, f);
            copy(&history, trial);
        }
        Ok(())
    }
}

/// Reads a number; false where it is something else.
fn plain_number(given: &Bound<'_, PyAny>, to: &mut f64) -> bool {
    given.cast::<PyFloat>().map(|x| *to = x.value()).is_ok()
}

/// Reads a tuple of as many numbers as there are places; of one the number alone will do.
fn plain_numbers(given: &Bound<'_, PyAny>, to: &mut [f64]) -> bool {
    if let [one] = &mut *to
        && plain_number(given, one)
    {
        return true;
    }
    given.cast::<PyTuple>().is_ok_and(|all| {
        all.len() == to.len() && to.iter_mut().zip(all).all(|(to, x)| plain_number(&x, to))
    })
}

/// What a tuple of two holds.
fn pair<'py>(given: &Bound<'py, PyAny>) -> Option<[Bound<'py, PyAny>; 2]> {
    let pair = given.cast::<PyTuple>().ok().filter(|pair| pair.len() == 2)?;
    Some([pair.get_item(0).ok()?, pair.get_item(1).ok()?])
}

/// Copies a list whose length `trilith._law.Plain` has looked at.
fn copy(from: &[f64], to: &mut [f64]) {
    to.iter_mut().zip(from).for_each(|(to, from)| *to = *from);
}

impl LawFunction for Plain {
    fn respond(
        &self,
        parameters: &[f64],
        at: &Kinematics<'_>,
        committed: &[f64],
        trial: &mut [f64],
        out: &mut Response<'_>,
    ) -> Result<(), NoAnswer> {
        self.ask(|law| {
            let py = law.py();
            let asked = self.question(py, parameters, at, committed)?;
            self.forces(law, &asked, trial, out.f)?;
            if let Some(method) = &self.tangent {
                let given = self.call(method, &asked, &asked.memory)?;
                // Of more coordinates they are lists of rows.
                let read = match (&mut *out.k, &mut *out.c, self.rates) {
                    ([k], _, false) => plain_number(&given, k),
                    ([k], [c], true) => pair(&given)
                        .is_some_and(|[x, y]| plain_number(&x, k) && plain_number(&y, c)),
                    _ => false,
                };
                if !read {
                    let (k, c): (Vec<f64>, Vec<f64>) =
                        law.call_method1("tangents", (given,))?.extract()?;
                    copy(&k, out.k);
                    copy(&c, out.c);
                }
            }
            if let Some(method) = &self.energy {
                let given = self.call(method, &asked, &self.history(py, trial)?)?;
                let mut all = [0.0; 3];
                if !plain_numbers(&given, &mut all) {
                    let energies: Vec<f64> = law.call_method1("energies", (given,))?.extract()?;
                    copy(&energies, &mut all);
                }
                let [stored, hysteretic, viscous] = all;
                *out.energy = Energy::new(stored, hysteretic, viscous);
            }
            Ok(())
        })
    }

    fn force(
        &self,
        parameters: &[f64],
        at: &Kinematics<'_>,
        committed: &[f64],
        trial: &mut [f64],
        out: &mut Response<'_>,
    ) -> Result<(), NoAnswer> {
        self.ask(|law| {
            let asked = self.question(law.py(), parameters, at, committed)?;
            self.forces(law, &asked, trial, out.f)
        })
    }

    fn check(&self, parameters: &[f64]) -> Result<(), String> {
        self.tell(|law| law.call_method1("check", (PyTuple::new(law.py(), parameters)?,)).map(drop))
    }

    fn engaged(&self, parameters: &[f64], k: &mut [f64]) -> Result<bool, String> {
        let given = self.tell(|law| {
            let given = law.call_method1("engaged", (PyTuple::new(law.py(), parameters)?,))?;
            given.extract::<Option<Vec<f64>>>()
        })?;
        Ok(given.inspect(|given| copy(given, k)).is_some())
    }

    fn at_rest(&self, parameters: &[f64], history: &mut [f64]) -> Result<(), String> {
        let given = self.tell(|law| {
            let given = law.call_method1("at_rest", (PyTuple::new(law.py(), parameters)?,))?;
            given.extract::<Option<Vec<f64>>>()
        })?;
        given.inspect(|given| copy(given, history));
        Ok(())
    }
}
