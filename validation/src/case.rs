//! A case: a model text, what is measured in its run, and what the measurement must give.

use serde::Serialize;
use trilith::solvers::{
    BasisReport, ContactMode, ContactSummary, EnergyTotals, LinkEnergy, Observer, RunOptions,
    Sample, Status,
};
use trilith::{Analysis, SolverKind};

/// Where a reference value comes from.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Kind {
    /// A formula, evaluated.
    ClosedForm,
    /// A number printed in the source.
    Published,
}

impl Kind {
    /// Name in reports.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::ClosedForm => "closed form",
            Self::Published => "published",
        }
    }
}

/// What runs a case.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Solver {
    /// Fast nonlinear analysis.
    Fna,
    /// Direct integration.
    Hht,
    /// The modes that FNA works with, without a run.
    Modes,
}

impl Solver {
    /// Name in reports.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::Fna => "fna",
            Self::Hht => "hht",
            Self::Modes => "modes",
        }
    }
}

/// How far a value may be off.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Tolerance {
    /// Share of the reference.
    Relative(f64),
    /// In the unit of the quantity.
    Absolute(f64),
}

/// The unit a quantity is reported in.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Unit {
    /// Name.
    pub name: &'static str,
    /// SI value of one.
    pub si: f64,
}

impl Unit {
    /// SI or no unit: the name is only a label.
    #[must_use]
    pub const fn si(name: &'static str) -> Self {
        Self { name, si: 1.0 }
    }
}

/// An inch.
pub const INCH: Unit = Unit { name: "in", si: 0.0254 };
/// A pound-force.
pub const POUND_FORCE: Unit = Unit { name: "lbf", si: 4.448_221_615_260_5 };
/// A thousand pounds-force.
pub const KIP: Unit = Unit { name: "kip", si: 4_448.221_615_260_5 };
/// A metre.
pub const METRE: Unit = Unit::si("m");
/// A second.
pub const SECOND: Unit = Unit::si("s");
/// A metre per second.
pub const SPEED: Unit = Unit::si("m/s");
/// A newton.
pub const NEWTON: Unit = Unit::si("N");
/// A joule.
pub const JOULE: Unit = Unit::si("J");
/// A radian.
pub const RADIAN: Unit = Unit::si("rad");
/// A pure number.
pub const NUMBER: Unit = Unit::si("");
/// A hertz.
pub const HERTZ: Unit = Unit { name: "Hz", si: std::f64::consts::TAU };

type Measure = Box<dyn Fn(&Trace) -> f64 + Send + Sync>;

/// One measured quantity and its reference.
pub struct Check {
    /// What is measured.
    pub quantity: String,
    /// What it must be, in its unit.
    pub reference: f64,
    /// Its unit.
    pub unit: Unit,
    /// How far it may be off.
    pub tolerance: Tolerance,
    /// Where the reference comes from.
    pub kind: Kind,
    /// The analysis of the model it is measured in; none: the last.
    pub analysis: Option<&'static str>,
    measure: Measure,
}

impl Check {
    /// A closed-form reference with a relative tolerance.
    pub fn new(
        quantity: impl Into<String>,
        unit: Unit,
        reference: f64,
        tolerance: f64,
        measure: impl Fn(&Trace) -> f64 + Send + Sync + 'static,
    ) -> Self {
        Self {
            quantity: quantity.into(),
            reference,
            unit,
            tolerance: Tolerance::Relative(tolerance),
            kind: Kind::ClosedForm,
            analysis: None,
            measure: Box::new(measure),
        }
    }

    /// The reference is printed in the source of the case.
    #[must_use]
    pub fn published(self) -> Self {
        Self { kind: Kind::Published, ..self }
    }

    /// The tolerance is in the unit of the quantity.
    #[must_use]
    pub fn absolute(self) -> Self {
        let (Tolerance::Relative(x) | Tolerance::Absolute(x)) = self.tolerance;
        Self { tolerance: Tolerance::Absolute(x), ..self }
    }

    /// Measured in this analysis of the model.
    #[must_use]
    pub fn in_analysis(self, name: &'static str) -> Self {
        Self { analysis: Some(name), ..self }
    }
}

/// A case.
pub struct Case {
    /// Short name.
    pub id: &'static str,
    /// What it shows.
    pub title: &'static str,
    /// Where references and tolerance come from.
    pub source: &'static str,
    /// The model.
    pub text: String,
    /// Parameters set over those of the text.
    pub set: Vec<(String, String)>,
    /// What runs it.
    pub solvers: &'static [Solver],
    /// What is compared.
    pub checks: Vec<Check>,
}

/// Both integrators.
pub const BOTH: &[Solver] = &[Solver::Fna, Solver::Hht];

/// One comparison.
#[derive(Clone, Debug, Serialize)]
pub struct Row {
    /// Case.
    pub id: String,
    /// Quantity.
    pub quantity: String,
    /// Unit.
    pub unit: String,
    /// Reference in that unit.
    pub reference: f64,
    /// Source of the reference.
    pub source: String,
    /// `closed form` or `published`.
    pub kind: String,
    /// `fna`, `hht` or `modes`.
    pub solver: String,
    /// Value in the unit; none where there was no run.
    pub value: Option<f64>,
    /// Deviation, as share of the reference or in the unit, as the tolerance is.
    pub error: Option<f64>,
    /// Tolerance.
    pub tolerance: f64,
    /// `relative` or `absolute`.
    pub measure: String,
    /// Within the tolerance, by a run that the solver itself calls converged.
    pub pass: bool,
    /// Why there is no value, or what the solver complained about.
    pub note: Option<String>,
}

impl Case {
    /// Runs the case under each of its solvers.
    #[must_use]
    pub fn run(&self) -> Vec<Row> {
        let model = match trilith::read_text(
            &self.text,
            format!("{}.ron", self.id),
            &trilith::registry(),
            &self.set,
        ) {
            Ok(model) => model,
            Err(errors) => {
                let all: Vec<String> = errors.iter().map(ToString::to_string).collect();
                return self.failed(&all.join("; "));
            }
        };
        let analysis = match Analysis::new(&model) {
            Ok(analysis) => analysis,
            Err(error) => return self.failed(&error.to_string()),
        };
        let mut names: Vec<Option<&'static str>> = Vec::new();
        for check in &self.checks {
            if !names.contains(&check.analysis) {
                names.push(check.analysis);
            }
        }
        let mut rows = Vec::new();
        for &solver in self.solvers {
            let traces: Vec<_> =
                names.iter().map(|name| Trace::of(&model, &analysis, solver, *name)).collect();
            for check in &self.checks {
                let at = names.iter().position(|n| *n == check.analysis).unwrap_or(0);
                let (value, note) = match &traces[at] {
                    Ok(trace) => ((check.measure)(trace) / check.unit.si, trace.complaint.clone()),
                    Err(message) => (f64::NAN, Some(message.clone())),
                };
                rows.push(self.row(check, solver, value, note));
            }
        }
        rows
    }

    /// The rows of a case that could not be run.
    #[must_use]
    pub fn failed(&self, reason: &str) -> Vec<Row> {
        let pairs = self.solvers.iter().flat_map(|s| self.checks.iter().map(move |c| (s, c)));
        pairs.map(|(s, c)| self.row(c, *s, f64::NAN, Some(reason.to_owned()))).collect()
    }

    fn row(&self, check: &Check, solver: Solver, value: f64, note: Option<String>) -> Row {
        let (tolerance, scale, measure) = match check.tolerance {
            Tolerance::Relative(x) => (x, check.reference.abs(), "relative"),
            Tolerance::Absolute(x) => (x, 1.0, "absolute"),
        };
        let error = (value - check.reference) / scale;
        let finite = |x: f64| x.is_finite().then_some(x);
        Row {
            id: self.id.into(),
            quantity: check.quantity.clone(),
            unit: check.unit.name.into(),
            reference: check.reference,
            source: self.source.into(),
            kind: check.kind.name().into(),
            solver: solver.name().into(),
            value: finite(value),
            error: finite(error),
            tolerance,
            measure: measure.into(),
            pass: error.abs() <= tolerance && note.is_none(),
            note: note.or_else(|| (!value.is_finite()).then(|| "not found in the run".into())),
        }
    }
}

/// What a run showed.
#[derive(Clone, Debug, Default)]
pub struct Trace {
    names: Vec<String>,
    time: Vec<f64>,
    values: Vec<Vec<f64>>,
    rates: Vec<Vec<f64>>,
    energy: Vec<EnergyTotals>,
    links: Vec<(String, LinkEnergy)>,
    /// How the contacts behaved.
    pub contact: Option<ContactSummary>,
    /// The basis.
    pub basis: Option<BasisReport>,
    complaint: Option<String>,
}

impl Observer for Trace {
    fn sample(&mut self, s: &Sample<'_>) {
        // After a jump of loads the same moment is shown again: the later values count.
        if self.time.last().is_some_and(|t| *t >= s.t) {
            self.time.pop();
            self.values.pop();
            self.rates.pop();
            self.energy.pop();
        }
        self.time.push(s.t);
        self.values.push(s.values.to_vec());
        self.rates.push(s.rates.to_vec());
        self.energy.push(*s.energy);
    }
}

impl Trace {
    fn of(
        model: &trilith::Model,
        analysis: &Analysis<'_>,
        solver: Solver,
        name: Option<&str>,
    ) -> Result<Self, String> {
        let case = match name {
            Some(name) => model.case(name).ok_or_else(|| format!("no analysis `{name}`"))?,
            None => model.cases.len().saturating_sub(1),
        };
        let kind = match solver {
            Solver::Modes => {
                let basis = analysis.modes(Some(case)).map_err(|e| e.to_string())?;
                return Ok(Self { basis: Some(basis), ..Self::default() });
            }
            Solver::Fna => SolverKind::Fna,
            Solver::Hht => SolverKind::Hht,
        };
        let mut trace = Self {
            names: model.outputs.iter().map(|o| o.name.clone()).collect(),
            ..Self::default()
        };
        let mut contact = ContactMode::new();
        let options = RunOptions { case, solver: Some(kind), ..RunOptions::default() };
        let result = trilith::solvers::run(
            model,
            analysis.system(),
            options,
            &mut [&mut trace, &mut contact],
        )
        .map_err(|e| e.to_string())?;
        trace.contact = contact.summary();
        trace.links = result
            .link_energy
            .iter()
            .filter_map(|(e, l)| model.elements.get(*e).map(|x| (x.name.clone(), *l)))
            .collect();
        trace.basis = result.basis;
        if result.status != Status::Converged {
            trace.complaint = Some(result.status.text());
        }
        Ok(trace)
    }

    fn index(&self, name: &str) -> Option<usize> {
        self.names.iter().position(|n| n == name)
    }

    /// Value of output `c` between samples `i` and `i + 1`, `s` from 0 to 1: cubic where the rates are
    /// known, linear elsewhere.
    fn between(&self, c: usize, i: usize, s: f64) -> f64 {
        let j = (i + 1).min(self.time.len() - 1);
        let (a, b) = (self.values[i][c], self.values[j][c]);
        let h = self.time[j] - self.time[i];
        let (da, db) = (self.rates[i][c] * h, self.rates[j][c] * h);
        if !(da.is_finite() && db.is_finite()) {
            return a + s * (b - a);
        }
        let t = 1.0 - s;
        a * t * t * (1.0 + 2.0 * s) + b * s * s * (3.0 - 2.0 * s) + da * s * t * t - db * s * s * t
    }

    /// Value of an output at a time.
    #[must_use]
    pub fn at(&self, name: &str, t: f64) -> f64 {
        let (Some(c), Some(last)) = (self.index(name), self.time.last()) else { return f64::NAN };
        if t > last * (1.0 + 1e-9) {
            return f64::NAN;
        }
        let i = self.time.partition_point(|x| *x <= t).saturating_sub(1);
        let end = (i + 1).min(self.time.len() - 1);
        let h = self.time[end] - self.time[i];
        self.between(c, i, if h > 0.0 { (t - self.time[i]) / h } else { 0.0 })
    }

    /// The last value of an output.
    #[must_use]
    pub fn last(&self, name: &str) -> f64 {
        let c = self.index(name);
        c.and_then(|c| self.values.last().map(|v| v[c])).unwrap_or(f64::NAN)
    }

    /// (time, value) of the largest `sign` · value of an output from `from` to `to`.
    #[must_use]
    pub fn extreme(&self, name: &str, sign: f64, from: f64, to: f64) -> (f64, f64) {
        const PARTS: usize = 64;
        let mut best = (f64::NAN, f64::NAN);
        let Some(c) = self.index(name) else { return best };
        for i in 0..self.time.len().saturating_sub(1) {
            let (t0, t1) = (self.time[i], self.time[i + 1]);
            if t1 < from || t0 > to {
                continue;
            }
            for k in 0..=PARTS {
                let s = k as f64 / PARTS as f64;
                let (t, v) = (t0 + s * (t1 - t0), self.between(c, i, s));
                let better = best.1.is_nan() || sign * v > sign * best.1;
                if better && t >= from && t <= to {
                    best = (t, v);
                }
            }
        }
        best
    }

    /// Largest value of an output from `from` to `to`.
    #[must_use]
    pub fn max(&self, name: &str, from: f64, to: f64) -> f64 {
        self.extreme(name, 1.0, from, to).1
    }

    /// Smallest value of an output from `from` to `to`.
    #[must_use]
    pub fn min(&self, name: &str, from: f64, to: f64) -> f64 {
        self.extreme(name, -1.0, from, to).1
    }

    /// Largest absolute value of an output from `from` to `to`.
    #[must_use]
    pub fn peak(&self, name: &str, from: f64, to: f64) -> f64 {
        self.max(name, from, to).abs().max(self.min(name, from, to).abs())
    }

    /// The times at which an output passes a level.
    #[must_use]
    pub fn crossings(&self, name: &str, level: f64) -> Vec<f64> {
        let mut found = Vec::new();
        let Some(c) = self.index(name) else { return found };
        for i in 0..self.time.len().saturating_sub(1) {
            let (a, b) = (self.values[i][c] - level, self.values[i + 1][c] - level);
            if a == 0.0 || (a > 0.0) == (b > 0.0) {
                continue;
            }
            let (mut low, mut high) = (0.0, 1.0);
            for _ in 0..60 {
                let middle = 0.5 * (low + high);
                if (self.between(c, i, middle) - level > 0.0) == (a > 0.0) {
                    low = middle;
                } else {
                    high = middle;
                }
            }
            found.push(self.time[i] + low * (self.time[i + 1] - self.time[i]));
        }
        found
    }

    /// The `n`-th (from 0) time at which an output passes a level.
    #[must_use]
    pub fn crossing(&self, name: &str, level: f64, n: usize) -> f64 {
        self.crossings(name, level).get(n).copied().unwrap_or(f64::NAN)
    }

    /// Heat of friction of all links up to a time, J.
    #[must_use]
    pub fn friction_heat(&self, t: f64) -> f64 {
        let i = self.time.partition_point(|x| *x < t * (1.0 - 1e-12));
        self.energy.get(i).map_or(f64::NAN, |e| e.link_hysteretic)
    }

    /// Heat of one link over the whole run, J.
    #[must_use]
    pub fn heat(&self, link: &str) -> f64 {
        let found = self.links.iter().find(|(n, _)| n == link);
        found.map_or(f64::NAN, |(_, e)| e.hysteretic + e.viscous)
    }

    /// Circular frequency of mode `i` (from 0), rad/s.
    #[must_use]
    pub fn omega(&self, i: usize) -> f64 {
        self.basis.as_ref().and_then(|b| b.omega.get(i)).copied().unwrap_or(f64::NAN)
    }
}
