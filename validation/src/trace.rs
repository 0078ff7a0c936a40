//! What a run showed, and what can be asked about it.

use trilith::solvers::{
    BasisReport, ContactMode, ContactSummary, EnergyTotals, LinkEnergy, Observer, RunOptions,
    Sample, Work,
};
use trilith::{Analysis, Model, Registry, SolverKind};

/// What a run showed.
#[derive(Clone, Debug, Default)]
pub struct Trace {
    names: Vec<String>,
    time: Vec<f64>,
    values: Vec<Vec<f64>>,
    rates: Vec<Vec<f64>>,
    energy: Vec<EnergyTotals>,
    links: Vec<(String, LinkEnergy)>,
    /// Number of equations of the structure.
    pub equations: usize,
    /// How the contacts behaved.
    pub contact: Option<ContactSummary>,
    /// The basis.
    pub basis: Option<BasisReport>,
    /// How much work the run was.
    pub work: Work,
    /// What the solver itself complained about.
    pub complaint: Option<String>,
}

fn index(model: &Model, name: Option<&str>) -> Result<usize, String> {
    match name {
        Some(name) => model.case(name).ok_or_else(|| format!("no analysis `{name}`")),
        None => model.cases.len().checked_sub(1).ok_or_else(|| "the model has no analysis".into()),
    }
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

/// Reads the text of a model of built-in kinds.
///
/// # Errors
/// All its diagnostics in one line.
pub fn read(text: &str, id: &str, set: &[(String, String)]) -> Result<Model, String> {
    read_with(&trilith::registry(), text, id, set)
}

/// Reads the text of a model of these kinds.
///
/// # Errors
/// All its diagnostics in one line.
pub fn read_with(
    kinds: &Registry,
    text: &str,
    id: &str,
    set: &[(String, String)],
) -> Result<Model, String> {
    trilith::read_text(text, format!("{id}.ron"), kinds, set)
        .map_err(|errors| errors.iter().map(ToString::to_string).collect::<Vec<_>>().join("; "))
}

impl Trace {
    /// Runs the last case of a text, changed by `change` first.
    ///
    /// # Errors
    /// What is wrong with the model, or why it cannot be run.
    pub fn run(
        text: &str,
        set: &[(&str, &dyn ToString)],
        solver: SolverKind,
        change: impl FnOnce(&mut Model),
    ) -> Result<Self, String> {
        let set: Vec<_> = set.iter().map(|(n, v)| ((*n).to_owned(), v.to_string())).collect();
        let mut model = read(text, "study", &set)?;
        change(&mut model);
        let analysis = Analysis::new(&model).map_err(|e| e.to_string())?;
        Self::of(&model, &analysis, solver, None)
    }

    /// The modes of a case (none: the last), without a run.
    pub(crate) fn modes(
        model: &Model,
        analysis: &Analysis<&Model>,
        name: Option<&str>,
    ) -> Result<Self, String> {
        let basis = analysis.modes(Some(index(model, name)?)).map_err(|e| e.to_string())?;
        Ok(Self { basis: Some(basis), ..Self::default() })
    }

    /// Runs a case (none: the last).
    pub(crate) fn of(
        model: &Model,
        analysis: &Analysis<&Model>,
        solver: SolverKind,
        name: Option<&str>,
    ) -> Result<Self, String> {
        let mut trace = Self {
            names: model.outputs.iter().map(|o| o.name.clone()).collect(),
            ..Self::default()
        };
        trace.equations = analysis.system().order();
        let mut contact = ContactMode::new(model, analysis.system());
        let options =
            RunOptions { case: index(model, name)?, solver: Some(solver), ..RunOptions::default() };
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
        trace.work = result.work;
        if !result.status.is_good() {
            trace.complaint = Some(result.status.text());
        }
        Ok(trace)
    }

    /// (time, value) of an output at every substep; empty where there is no such output.
    #[must_use]
    pub fn history(&self, name: &str) -> Vec<(f64, f64)> {
        let Some(c) = self.index(name) else { return Vec::new() };
        self.time.iter().zip(&self.values).map(|(t, v)| (*t, v[c])).collect()
    }

    /// Names of the outputs.
    #[must_use]
    pub fn outputs(&self) -> &[String] {
        &self.names
    }

    /// (time, energies) at every substep.
    #[must_use]
    pub fn energies(&self) -> Vec<(f64, EnergyTotals)> {
        self.time.iter().copied().zip(self.energy.iter().copied()).collect()
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

    /// Work on one link over the whole run from rest: what it stores at the end, and its heat, J.
    #[must_use]
    pub fn absorbed(&self, link: &str) -> f64 {
        let found = self.links.iter().find(|(n, _)| n == link);
        found.map_or(f64::NAN, |(_, e)| e.stored + e.hysteretic + e.viscous)
    }

    /// Circular frequency of mode `i` (from 0), rad/s.
    #[must_use]
    pub fn omega(&self, i: usize) -> f64 {
        self.basis.as_ref().and_then(|b| b.omega.get(i)).copied().unwrap_or(f64::NAN)
    }
}
