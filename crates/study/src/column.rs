//! Columns: what a study keeps of a run.

use crate::finished::Finished;
use crate::number::Number;
use trilith::element::Dimension;
use trilith::model::file::{Quantity, Scope, evaluate};
use trilith::model::{Model, ParameterValue};
use trilith::solvers::lanes::Integral;
use trilith::solvers::{Observer, Sample};

/// A number that a study keeps of every run.
#[derive(Clone, Debug, PartialEq)]
pub struct Column {
    /// Name.
    pub name: String,
    /// SI unit.
    pub unit: String,
    /// Its dimension.
    pub dimension: Dimension,
    /// What it is.
    pub measure: Measure,
}

/// How a number is found. Outputs are given by their index in the model.
#[derive(Clone, Debug, PartialEq)]
pub enum Measure {
    /// Largest absolute value of an output.
    Peak(usize),
    /// Largest value.
    Max(usize),
    /// Smallest value.
    Min(usize),
    /// Time of the largest absolute value.
    TimeOfPeak(usize),
    /// Value at the end.
    Final(usize),
    /// Root of the mean square over time.
    Rms(usize),
    /// Time during which the output is above a value.
    Duration(usize, f64),
    /// An energy at the end: index into [`ENERGIES`](trilith::results::ENERGIES).
    Energy(usize),
    /// Share of the energy that is unaccounted for.
    EnergyError,
    /// Largest gap of any contact.
    Uplift,
    /// Largest distance of any contact from where it started.
    Slip,
    /// The same at the end.
    ResidualSlip,
    /// An expression in parameters of the model and columns before it.
    Expression(String),
}

/// Outputs that columns take over time: how long above a value, or as root of the mean square.
pub(crate) fn over_time(columns: &[Column]) -> Vec<(usize, Option<f64>)> {
    let of = |c: &Column| match c.measure {
        Measure::Rms(output) => Some((output, None)),
        Measure::Duration(output, above) => Some((output, Some(above))),
        _ => None,
    };
    columns.iter().filter_map(of).collect()
}

/// Follows what columns take over time.
#[derive(Debug)]
pub(crate) struct Watch {
    rows: Vec<(usize, Option<f64>)>,
    /// From the first moment on, with the time of the last.
    integrals: Vec<Integral<f64>>,
    last: f64,
}

impl Watch {
    pub fn new(columns: &[Column]) -> Self {
        Self { rows: over_time(columns), integrals: Vec::new(), last: 0.0 }
    }

    pub fn values(&self) -> Vec<f64> {
        self.integrals.iter().map(Integral::value).collect()
    }
}

impl Observer for Watch {
    fn sample(&mut self, sample: &Sample<'_>) {
        let now = |output: usize| sample.values.get(output).copied().unwrap_or(f64::NAN);
        if self.integrals.is_empty() {
            let first =
                |(output, above): &(usize, Option<f64>)| Integral::new(now(*output), *above);
            self.integrals = self.rows.iter().map(first).collect();
        } else {
            for (integral, (output, _)) in self.integrals.iter_mut().zip(&self.rows) {
                integral.advance(sample.t - self.last, now(*output));
            }
        }
        self.last = sample.t;
    }

    fn wants_rates(&self) -> bool {
        false
    }
}

/// Values of all columns of a run; none where there is no number.
pub(crate) fn values(columns: &[Column], model: &Model, left: &Finished) -> Vec<Option<f64>> {
    let mut found: Vec<Option<f64>> = Vec::with_capacity(columns.len());
    let mut integrals = left.integrals.iter().map(|x| x.0);
    let peak = |i: usize| left.peaks.get(i).map(|p| p.map(|x| x.0));
    let contact = left.contact.as_ref();
    let energy = |i: usize| left.energy.get(i).map(|x: &Number| x.0);
    for (k, column) in columns.iter().enumerate() {
        let value = match &column.measure {
            Measure::Peak(i) => peak(*i).map(|[max, _, min, ..]| max.abs().max(min.abs())),
            Measure::Max(i) => peak(*i).map(|[max, ..]| max),
            Measure::Min(i) => peak(*i).map(|[_, _, min, ..]| min),
            Measure::TimeOfPeak(i) => {
                peak(*i).map(
                    |[max, t_max, min, t_min, _]| {
                        if max.abs() >= min.abs() { t_max } else { t_min }
                    },
                )
            }
            Measure::Final(i) => peak(*i).map(|[.., last]| last),
            Measure::Rms(_) | Measure::Duration(..) => integrals.next(),
            Measure::Energy(i) => energy(*i),
            Measure::EnergyError => energy(left.energy.len() - 1),
            Measure::Uplift => contact.map(|c| c.uplift.0),
            Measure::Slip => contact.map(|c| c.slip.0),
            Measure::ResidualSlip => contact.map(|c| c.residual_slip.0),
            Measure::Expression(text) => {
                let known = columns[..k].iter().zip(&found);
                let mut scope = Known::of(model);
                for (column, value) in known {
                    scope.add(&column.name, value.unwrap_or(f64::NAN), column.dimension);
                }
                evaluate(text, &mut scope).ok().map(|q| q.value)
            }
        };
        found.push(value.filter(|x| x.is_finite()));
    }
    found
}

/// Names with values: parameters of a model and columns.
#[derive(Debug, Default)]
pub(crate) struct Known(Vec<(String, Quantity)>);

impl Known {
    /// The numbers among the parameters of a model.
    pub fn of(model: &Model) -> Self {
        let number = |p: &trilith::model::Parameter| match p.value {
            ParameterValue::Number(value, dimension) => {
                let measured = !dimension.is_none();
                Some((p.name.clone(), Quantity { value, dimension, measured }))
            }
            ParameterValue::Text(_) => None,
        };
        Self(model.parameters.iter().filter_map(number).collect())
    }

    /// Adds a number; a later one hides an earlier one of the same name.
    pub fn add(&mut self, name: &str, value: f64, dimension: Dimension) {
        self.0.push((name.to_owned(), Quantity { value, dimension, measured: true }));
    }

    fn find(&self, name: &str) -> Option<Quantity> {
        self.0.iter().rev().find(|(n, _)| n == name).map(|(_, q)| *q)
    }
}

impl Scope for Known {
    fn names(&self) -> Vec<&str> {
        self.0.iter().map(|(n, _)| n.as_str()).collect()
    }
    fn has(&self, name: &str) -> bool {
        self.find(name).is_some()
    }
    fn value(&mut self, name: &str) -> Result<Quantity, Option<(&'static str, String)>> {
        self.find(name).ok_or(None)
    }
}
