//! A case: a model text, what is measured in its run, and what the measurement must give.

use crate::{Outcome, Row, Trace, Unit, figures};
use trilith::{Analysis, Registry, SolverKind};

/// Where a reference value comes from.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Kind {
    /// A formula, evaluated.
    ClosedForm,
    /// A number printed in the source.
    Published,
    /// A number of another, independent program.
    OtherCode,
    /// What theory says of the method itself, such as its order.
    Theory,
}

impl Kind {
    /// Name in reports.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::ClosedForm => "closed form",
            Self::Published => "published",
            Self::OtherCode => "other code",
            Self::Theory => "theory",
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
    /// The integrator; none for modes.
    fn kind(self) -> Option<SolverKind> {
        match self {
            Self::Fna => Some(SolverKind::Fna),
            Self::Hht => Some(SolverKind::Hht),
            Self::Modes => None,
        }
    }

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
    /// The reference is a lower bound.
    AtLeast,
    /// The reference is an upper bound.
    AtMost,
}

/// What a value must be.
#[derive(Clone, Debug)]
pub struct Claim {
    /// What is measured.
    pub quantity: String,
    /// What it must be, in its unit.
    pub reference: f64,
    /// Its unit.
    pub unit: &'static str,
    /// How far it may be off.
    pub tolerance: Tolerance,
    /// Where the reference comes from.
    pub kind: Kind,
}

/// Where a figure shows the reference of a check.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Mark {
    /// The reference is the value of this output at this time.
    Value(&'static str, f64),
    /// The reference is the time at which this output has this value, SI.
    Time(&'static str, f64),
}

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
    /// Where the figure shows the reference.
    pub mark: Option<Mark>,
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
            mark: None,
            measure: Box::new(measure),
        }
    }

    /// The value of an output at a time against a closed form, with a mark in the figure.
    #[must_use]
    pub fn at(output: &'static str, unit: Unit, t: f64, reference: f64, tolerance: f64) -> Self {
        let measure = move |r: &Trace| r.at(output, t);
        Self::new(format!("{output}({t})"), unit, reference, tolerance, measure).mark(output, t)
    }

    /// The reference is the value of this output at this time: the figure shows it there.
    #[must_use]
    pub fn mark(self, output: &'static str, t: f64) -> Self {
        Self { mark: Some(Mark::Value(output, t)), ..self }
    }

    /// The reference is the time at which this output has this value, SI: the figure shows it there.
    #[must_use]
    pub fn mark_time(self, output: &'static str, level: f64) -> Self {
        Self { mark: Some(Mark::Time(output, level)), ..self }
    }

    fn claim(&self) -> Claim {
        Claim {
            quantity: self.quantity.clone(),
            reference: self.reference,
            unit: self.unit.name,
            tolerance: self.tolerance,
            kind: self.kind,
        }
    }

    /// The reference is printed in the source of the case.
    #[must_use]
    pub fn published(self) -> Self {
        Self { kind: Kind::Published, ..self }
    }

    /// The reference was computed by an independent program.
    #[must_use]
    pub fn other_code(self) -> Self {
        Self { kind: Kind::OtherCode, ..self }
    }

    /// The tolerance is in the unit of the quantity.
    #[must_use]
    pub fn absolute(self) -> Self {
        match self.tolerance {
            Tolerance::Relative(x) => Self { tolerance: Tolerance::Absolute(x), ..self },
            _ => self,
        }
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
    /// What the figure shows.
    pub view: View,
}

/// What the figure of a case shows.
#[derive(Default)]
pub enum View {
    /// The error of every quantity as share of its tolerance.
    #[default]
    Errors,
    /// Outputs over time, one figure each.
    Histories(Vec<Curve>),
    /// One output over another, for loops.
    Path {
        /// Along the horizontal axis: output and unit.
        x: (&'static str, Unit),
        /// Along the vertical axis.
        y: (&'static str, Unit),
        /// Reference, in these units.
        reference: Vec<(f64, f64)>,
    },
    /// Several of these.
    Several(Vec<View>),
}

/// An output over time.
pub struct Curve {
    /// The output.
    pub output: &'static str,
    /// Unit it is shown in.
    pub unit: Unit,
    /// The analysis of the model it is shown of; none: the last.
    pub analysis: Option<&'static str>,
    /// Time that is shown; none: all.
    pub span: Option<(f64, f64)>,
    /// The reference as a function of time, in the unit.
    pub reference: Option<Box<dyn Fn(f64) -> f64 + Send + Sync>>,
}

impl Curve {
    /// An output over all of the last analysis.
    #[must_use]
    pub fn new(output: &'static str, unit: Unit) -> Self {
        Self { output, unit, analysis: None, span: None, reference: None }
    }

    /// With a reference, in the unit of the curve; not a number where there is none.
    #[must_use]
    pub fn against(self, reference: impl Fn(f64) -> f64 + Send + Sync + 'static) -> Self {
        Self { reference: Some(Box::new(reference)), ..self }
    }

    /// Shown from one time to another.
    #[must_use]
    pub fn over(self, from: f64, to: f64) -> Self {
        Self { span: Some((from, to)), ..self }
    }

    /// Of this analysis of the model.
    #[must_use]
    pub fn in_analysis(self, name: &'static str) -> Self {
        Self { analysis: Some(name), ..self }
    }
}

impl View {
    /// Histories of outputs.
    #[must_use]
    pub fn histories(curves: impl IntoIterator<Item = Curve>) -> Self {
        Self::Histories(curves.into_iter().collect())
    }

    /// The analyses it looks at.
    fn analyses(&self) -> Vec<Option<&'static str>> {
        match self {
            Self::Histories(curves) => curves.iter().map(|c| c.analysis).collect(),
            Self::Path { .. } => vec![None],
            Self::Several(views) => views.iter().flat_map(Self::analyses).collect(),
            Self::Errors => Vec::new(),
        }
    }
}

/// Both integrators.
pub const BOTH: &[Solver] = &[Solver::Fna, Solver::Hht];

impl Case {
    /// Runs the case under each of its solvers.
    #[must_use]
    pub fn run(&self) -> Outcome {
        self.run_with(&trilith::registry())
    }

    /// The same with other kinds of elements than the built-in ones.
    #[must_use]
    pub fn run_with(&self, kinds: &Registry) -> Outcome {
        match self.compute(kinds) {
            Ok((rows, figures)) => Outcome { figures, ..self.outcome(rows) },
            Err(reason) => self.failed(&reason),
        }
    }

    /// Rows and figures of the runs.
    fn compute(&self, kinds: &Registry) -> Result<(Vec<Row>, Vec<trilith_report::Figure>), String> {
        let model = crate::trace::read_with(kinds, &self.text, self.id, &self.set)?;
        let analysis = Analysis::new(&model).map_err(|e| e.to_string())?;
        let mut names: Vec<Option<&'static str>> = Vec::new();
        for name in self.checks.iter().map(|c| c.analysis).chain(self.view.analyses()) {
            if !names.contains(&name) {
                names.push(name);
            }
        }
        let (mut rows, mut seen) = (Vec::new(), Vec::new());
        for &solver in self.solvers {
            let traces: Vec<_> = names
                .iter()
                .map(|name| match solver.kind() {
                    Some(kind) => Trace::of(&model, &analysis, kind, *name),
                    None => Trace::modes(&model, &analysis, *name),
                })
                .collect();
            for check in &self.checks {
                let at = names.iter().position(|n| *n == check.analysis).unwrap_or(0);
                let (value, note) = match &traces[at] {
                    Ok(trace) => ((check.measure)(trace) / check.unit.si, trace.complaint.clone()),
                    Err(message) => (f64::NAN, Some(message.clone())),
                };
                rows.push(self.row(check, solver, value, note));
            }
            let traces = names.iter().copied().zip(traces);
            seen.extend(traces.filter_map(|(name, t)| Some((solver, name, t.ok()?))));
        }
        let figures = figures::of_case(self, &rows, &seen);
        Ok((rows, figures))
    }

    /// A case that could not be run.
    #[must_use]
    pub fn failed(&self, reason: &str) -> Outcome {
        let pairs = self.solvers.iter().flat_map(|s| self.checks.iter().map(move |c| (s, c)));
        let rows = pairs.map(|(s, c)| self.row(c, *s, f64::NAN, Some(reason.to_owned())));
        self.outcome(rows.collect())
    }

    fn outcome(&self, rows: Vec<Row>) -> Outcome {
        Outcome {
            id: self.id,
            title: self.title,
            source: self.source,
            text: Vec::new(),
            rows,
            figures: Vec::new(),
            unavailable: None,
            tables: Vec::new(),
        }
    }

    fn row(&self, check: &Check, solver: Solver, value: f64, note: Option<String>) -> Row {
        Row::new(self.id, self.source, check.claim(), solver.name(), value, note)
    }
}
