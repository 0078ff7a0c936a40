//! Ground motion records.

use crate::column::Column;
use crate::failure::Failure;
use crate::work;
use pyo3::prelude::*;
use std::path::PathBuf;
use std::sync::Arc;
use trilith::record::measure::{
    arias, cav, displacement, peak, significant_duration, spectrum, velocity,
};
use trilith::record::synthetic::KanaiTajimi;
use trilith::record::{Component, Format, Problem, ReadError, ReadOptions, acceleration_unit};
use trilith_cli::told;

/// One component of a ground motion.
#[pyclass(frozen, module = "trilith._native")]
pub(crate) struct Record(Arc<trilith::record::Record>);

#[pymethods]
impl Record {
    /// Acceleration, m/s².
    fn acceleration(&self) -> Column {
        Column::new(self.0.acceleration.clone())
    }

    /// Velocity, m/s.
    fn velocity(&self) -> Column {
        Column::new(velocity(&self.0.acceleration, self.0.dt))
    }

    /// Displacement, m.
    fn displacement(&self) -> Column {
        Column::new(displacement(&self.0.acceleration, self.0.dt))
    }

    /// Times, s.
    fn time(&self) -> Column {
        Column::new(self.0.times().collect())
    }

    #[getter]
    fn dt(&self) -> f64 {
        self.0.dt
    }

    #[getter]
    fn component(&self) -> &str {
        &self.0.component
    }

    #[getter]
    fn station(&self) -> &str {
        &self.0.station
    }

    #[getter]
    fn event(&self) -> &str {
        &self.0.event
    }

    #[getter]
    fn format(&self) -> Option<&'static str> {
        self.0.format.map(Format::name)
    }

    #[getter]
    fn notes(&self) -> Vec<String> {
        self.0.notes.clone()
    }

    /// Peak acceleration, velocity and displacement, Arias intensity, D5-75, D5-95, CAV; SI.
    fn measures(&self) -> [f64; 7] {
        let (a, dt) = (&self.0.acceleration, self.0.dt);
        let span = |from, to| {
            let [t0, t1] = significant_duration(a, dt, from, to);
            t1 - t0
        };
        [
            peak(a),
            peak(&velocity(a, dt)),
            peak(&displacement(a, dt)),
            arias(a, dt),
            span(0.05, 0.75),
            span(0.05, 0.95),
            cav(a, dt),
        ]
    }

    /// Response spectrum at periods (s) for a damping ratio: spectral displacement, pseudo-velocity, pseudo-acceleration,
    /// absolute acceleration.
    fn spectrum(&self, py: Python<'_>, periods: Vec<f64>, damping: f64) -> PyResult<[Column; 4]> {
        let record = Arc::clone(&self.0);
        work::run(py, move |_| {
            if let Some(t) = periods.iter().find(|t| !(t.is_finite() && **t > 0.0)) {
                let message = format!("{t} is no period: a number of seconds above 0 is wanted");
                return Err(Failure::argument(&message, None));
            }
            if !(0.0..1.0).contains(&damping) {
                let message = format!("{damping} is no damping ratio: at least 0 and below 1");
                return Err(Failure::argument(&message, None));
            }
            let s = spectrum(&record.acceleration, record.dt, &periods, damping);
            let all = |value: fn(&trilith::record::measure::Response) -> f64| {
                Column::new(s.responses.iter().map(value).collect())
            };
            Ok([all(|r| r.sd), all(|r| r.psv), all(|r| r.psa), all(|r| r.sa)])
        })
    }

    /// As a file for models.
    fn csv(&self) -> String {
        self.0.to_csv()
    }

    /// Of numbers: what was read, taken apart for a pickle.
    #[staticmethod]
    fn of(
        py: Python<'_>,
        acceleration: Vec<f64>,
        dt: f64,
        texts: (String, String, String),
        notes: Vec<String>,
    ) -> PyResult<Self> {
        let fail = |message: &str| Err(Failure::argument(message, None).into_exception(py));
        if acceleration.len() < 2 {
            return fail("a record needs at least two samples");
        }
        if let Some(i) = acceleration.iter().position(|a| !a.is_finite()) {
            return fail(&format!("sample {i} of the acceleration is no finite number"));
        }
        if !(dt.is_finite() && dt > 0.0) {
            return fail(&format!("{dt} is no time step: a number of seconds above 0 is wanted"));
        }
        let mut record = trilith::record::Record::new(acceleration, dt);
        (record.component, record.station, record.event) = texts;
        record.notes = notes;
        Ok(Self(Arc::new(record)))
    }
}

/// Reads the components of a file.
#[pyfunction]
#[pyo3(signature = (path, unit, dt, component))]
pub(crate) fn record(
    py: Python<'_>,
    path: PathBuf,
    unit: Option<String>,
    dt: Option<f64>,
    component: Option<String>,
) -> PyResult<Vec<Record>> {
    work::run(py, move |_| {
        let unit = unit.map(|text| {
            acceleration_unit(&text).ok_or_else(|| {
                let message = format!("`{text}` is no unit of acceleration");
                Failure::argument(&message, Some("such as \"g\", \"m/s^2\" or \"cm/s^2\""))
            })
        });
        let options = ReadOptions { format: None, unit: unit.transpose()?, dt };
        let mut all = trilith::record::read(&path, &options).map_err(|e| refuse(&e))?;
        if let Some(name) = component {
            let component = name.parse().map_or(Component::Name(name), Component::Number);
            let one = trilith::record::select(all, Some(&component), &path);
            all = vec![one.map_err(|e| refuse(&e))?];
        }
        Ok(all.into_iter().map(|r| Record(Arc::new(r))).collect())
    })
}

/// Makes a motion of filtered white noise.
#[pyfunction]
#[pyo3(signature = (seed, peak, duration, dt, frequency, damping))]
pub(crate) fn synthetic(
    py: Python<'_>,
    seed: u64,
    peak: Option<f64>,
    duration: Option<f64>,
    dt: Option<f64>,
    frequency: Option<f64>,
    damping: Option<f64>,
) -> PyResult<Record> {
    work::run(py, move |_| {
        let plain = KanaiTajimi::default();
        let made = KanaiTajimi {
            seed,
            peak: peak.unwrap_or(plain.peak),
            duration: duration.unwrap_or(plain.duration),
            dt: dt.unwrap_or(plain.dt),
            frequency: frequency.unwrap_or(plain.frequency),
            damping: damping.unwrap_or(plain.damping),
            ..plain
        };
        let record = made.make().map_err(|e| Failure::argument(&e.to_string(), None))?;
        Ok(Record(Arc::new(record)))
    })
}

fn refuse(error: &ReadError) -> Failure {
    let help = match &error.problem {
        Problem::NoUnit => Some("give unit=\"g\", or state it in the file: `# unit: g`".to_owned()),
        Problem::NoStep => Some("give dt=0.005, or a column of times".to_owned()),
        Problem::Counts => Some("give `unit`: the acceleration of one count".to_owned()),
        _ => error.help(),
    };
    let text = told::plain(&error.to_string(), help.as_deref());
    match &error.problem {
        Problem::Unreadable(_) => Failure::File(text),
        _ => Failure::Argument(text),
    }
}
