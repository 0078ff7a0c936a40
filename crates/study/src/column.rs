//! Columns: what a study keeps of a run.

use trilith::element::Dimension;
use trilith::model::file::{Quantity, Scope, evaluate};
use trilith::model::{Model, ParameterValue};
use trilith::results::{ENERGIES, Peak};
use trilith::solvers::{ContactSummary, EnergyTotals, Observer, Sample, Status};

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
    /// An energy at the end: index into [`ENERGIES`].
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

impl Measure {
    /// True where peaks do not tell it.
    pub(crate) fn is_over_time(&self) -> bool {
        matches!(self, Self::Rms(_) | Self::Duration(..))
    }
}

/// What a run left, as far as columns ask.
pub(crate) struct Left<'a> {
    pub status: &'a Status,
    /// Of the outputs, in the order of the model.
    pub peaks: &'a [Peak],
    pub energy: &'a EnergyTotals,
    pub contact: Option<&'a ContactSummary>,
    pub warnings: &'a [String],
}

/// Follows what peaks do not tell.
#[derive(Debug)]
pub(crate) struct Watch {
    rows: Vec<Integral>,
}

#[derive(Debug)]
struct Integral {
    output: usize,
    /// None: mean square; otherwise time above.
    above: Option<f64>,
    before: Option<(f64, f64)>,
    start: f64,
    sum: f64,
}

impl Watch {
    pub fn new(columns: &[Column]) -> Self {
        let row = |output, above| Integral { output, above, before: None, start: 0.0, sum: 0.0 };
        let rows = columns.iter().filter_map(|c| match c.measure {
            Measure::Rms(output) => Some(row(output, None)),
            Measure::Duration(output, above) => Some(row(output, Some(above))),
            _ => None,
        });
        Self { rows: rows.collect() }
    }
}

impl Observer for Watch {
    fn sample(&mut self, sample: &Sample<'_>) {
        for row in &mut self.rows {
            let Some(y) = sample.values.get(row.output) else { continue };
            row.add(sample.t, *y);
        }
    }

    fn wants_rates(&self) -> bool {
        false
    }
}

impl Integral {
    /// Straight lines between the moments.
    fn add(&mut self, t: f64, y: f64) {
        match self.before {
            None => self.start = t,
            Some((t0, y0)) => {
                let share = match self.above {
                    None => (y0 * y0 + y0 * y + y * y) / 3.0,
                    Some(limit) => time_above(y0 - limit, y - limit),
                };
                self.sum += (t - t0) * share;
            }
        }
        self.before = Some((t, y));
    }

    fn value(&self) -> f64 {
        match (self.above, self.before) {
            (Some(_), _) => self.sum,
            (None, Some((t, _))) if t > self.start => (self.sum / (t - self.start)).sqrt(),
            (None, Some((_, y))) => y.abs(),
            (None, None) => f64::NAN,
        }
    }
}

/// Share of a straight line from `a` to `b` that is above 0.
fn time_above(a: f64, b: f64) -> f64 {
    match (a > 0.0, b > 0.0) {
        (true, true) => 1.0,
        (false, false) => 0.0,
        (true, false) => a / (a - b),
        (false, true) => b / (b - a),
    }
}

/// Values of all columns of a run; none where there is no number.
pub(crate) fn values(
    columns: &[Column],
    model: &Model,
    left: &Left<'_>,
    watch: &Watch,
) -> Vec<Option<f64>> {
    let mut found: Vec<Option<f64>> = Vec::with_capacity(columns.len());
    let mut integrals = watch.rows.iter();
    let peak = |i: usize| left.peaks.get(i);
    for (k, column) in columns.iter().enumerate() {
        let value = match &column.measure {
            Measure::Peak(i) => peak(*i).map(|p| p.max.abs().max(p.min.abs())),
            Measure::Max(i) => peak(*i).map(|p| p.max),
            Measure::Min(i) => peak(*i).map(|p| p.min),
            Measure::TimeOfPeak(i) => {
                peak(*i).map(|p| if p.max.abs() >= p.min.abs() { p.t_max } else { p.t_min })
            }
            Measure::Final(i) => peak(*i).map(|p| p.last),
            Measure::Rms(_) | Measure::Duration(..) => integrals.next().map(Integral::value),
            Measure::Energy(i) => Some(energy(left.energy, *i)),
            Measure::EnergyError => Some(left.energy.error_relative),
            Measure::Uplift => left.contact.map(|c| c.max_uplift),
            Measure::Slip => left.contact.map(|c| c.max_slip),
            Measure::ResidualSlip => left.contact.map(|c| c.residual_slip),
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

fn energy(e: &EnergyTotals, index: usize) -> f64 {
    match ENERGIES[index] {
        "input" => e.input,
        "kinetic" => e.kinetic,
        "strain" => e.strain,
        "potential" => e.potential,
        "modal_damping" => e.modal_damping,
        "link_stored" => e.link_stored,
        "link_hysteretic" => e.link_hysteretic,
        "link_viscous" => e.link_viscous,
        "algorithmic" => e.algorithmic,
        _ => e.error,
    }
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

#[cfg(test)]
mod tests {
    use super::*;

    fn integral(above: Option<f64>, points: &[(f64, f64)]) -> f64 {
        let mut row = Integral { output: 0, above, before: None, start: 0.0, sum: 0.0 };
        points.iter().for_each(|(t, y)| row.add(*t, *y));
        row.value()
    }

    #[test]
    fn rms_and_durations_of_a_saw_are_exact() {
        let saw = [(1.0, 0.0), (2.0, 2.0), (4.0, -2.0)];
        assert!((integral(None, &saw) - (4.0 / 3.0f64).sqrt()).abs() < 1e-15);
        assert!((integral(Some(1.0), &saw) - 1.0).abs() < 1e-15);
        assert_eq!(integral(Some(2.0), &saw), 0.0);
        assert_eq!(integral(Some(-3.0), &saw), 3.0);
    }
}
