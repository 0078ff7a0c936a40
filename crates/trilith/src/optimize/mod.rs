//! Values of parameters that make a goal smallest, with exact derivatives.
//!
//! ```
//! // A mass that strikes an isolator: how strong a dashpot makes its largest acceleration smallest?
//! let text = r#"(
//!     parameters: { "c": "200 N*s/m" },
//!     plane: XZ,
//!     nodes: { "m": (0, 0, 0) },
//!     supports: { "m": (Uz, Ry) },
//!     elements: {
//!         "mass": Mass(node: "m", mass: "100 kg"),
//!         "spring": Spring(node: "m", k2: "10 kN/m"),
//!         "damper": Dashpot(node: "m", axis: U2, c: "c"),
//!     },
//!     cases: { "strike": Dynamic(
//!         duration: "0.3 s", dt: "2 ms", solver: Hht,
//!         initial: [(node: "m", dof: Ux, velocity: "1 m/s")],
//!     ) },
//!     outputs: { "acceleration": Acceleration(node: "m", dof: Ux) },
//! )"#;
//! use trilith::optimize::{Variable, Wanted, optimize};
//!
//! let text = trilith::model::ModelText::new(text, "isolator.ron").expect("a text");
//! let wanted = Wanted {
//!     by: vec![Variable::new("c", "50 N*s/m", "2000 N*s/m")],
//!     minimise: vec!["acceleration".into()],
//!     ..Wanted::default()
//! };
//! let found = optimize(&text, &trilith::registry(), &wanted).expect("an optimum");
//! // c/(2 √(k m)) = 0.265, whatever the mass and the spring.
//! let ratio = found.best().x[0] / 2000.0;
//! assert!((ratio - 0.265).abs() < 0.01, "{ratio}");
//! ```
//!
//! The goal is an expression in outputs, each of which stands for its largest magnitude, and parameters; of several ones it is the largest,
//! searched for as the norm (Σ xᵖ)^(1/p), p = 40, over all extremes of their histories: it has derivatives where two are equal. Each run is one of
//! [`gradient`](crate::gradient::gradient): value and derivatives by all parameters together.
//!
//! Where a peak moves to another time or place, a goal has a kink. The search gets over such places and ends on one where there is nothing better
//! around; [`Stop`] says which it was. An optimum is that of the valley in which the search began.

mod course;
mod line;
mod search;
mod terms;
mod variables;

use crate::gradient::{self, GradientError};
use course::Course;
use std::cell::RefCell;
use std::sync::atomic::AtomicBool;
use terms::{Goal, Limit, Term};
use trilith_model::{Model, ModelText, Parameter, ParameterValue, Registry, SolverKind};
use trilith_solvers::gradient::Bend;
use variables::Range;
pub use variables::Variable;

/// Limits hold where they are broken by no more than this share of their bounds.
pub const HOLDS: f64 = search::HOLDS;

/// What to make smallest, by what.
#[derive(Clone, Debug)]
pub struct Wanted {
    /// Name of the case; `None`: the last.
    pub case: Option<String>,
    /// Solver; `None`: that of the case.
    pub solver: Option<SolverKind>,
    /// Output step in s; `None`: that of the case.
    pub dt: Option<f64>,
    /// Values of parameters in place of those of the file.
    pub set: Vec<(String, String)>,
    /// The parameters that are searched for; the search begins at their values. The name `c*` stands for all numbers whose names begin so.
    pub by: Vec<Variable>,
    /// The goal: an expression such as `roof + 0.1 m/kN * shear`; the largest of several. `drift*` stands for all outputs
    /// whose names begin so, `final(slide)` for a value at the end, a name in double quotes for itself.
    pub minimise: Vec<String>,
    /// Limits, such as `base_x <= 20 cm` or `c1 + c2 <= 3 MN*s/m`.
    pub limits: Vec<String>,
    /// Runs at most.
    pub max_runs: usize,
}

impl Default for Wanted {
    fn default() -> Self {
        Self {
            case: None,
            solver: None,
            dt: None,
            set: Vec::new(),
            by: Vec::new(),
            minimise: Vec::new(),
            limits: Vec::new(),
            max_runs: 50,
        }
    }
}

/// Why there is no optimum.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum OptimizeError {
    /// The model is wrong, or has no derivatives by these parameters.
    #[error(transparent)]
    Gradient(#[from] GradientError),
    /// No parameter to search for.
    #[error("there is no parameter to search for")]
    NoVariable,
    /// A parameter twice.
    #[error("parameter `{0}` stands there twice")]
    Twice(String),
    /// Bounds that are none.
    #[error("the bounds of `{name}` are wrong: {reason}")]
    Bounds {
        /// The parameter.
        name: String,
        /// Why.
        reason: String,
    },
    /// Nothing to make smallest.
    #[error("there is nothing to make smallest")]
    NoGoal,
    /// A goal or a limit that is none.
    #[error("`{text}` is wrong: {reason}")]
    Expression {
        /// As it was given.
        text: String,
        /// Why.
        reason: String,
    },
    /// The goal does not hang on the parameters.
    #[error("neither the goal nor a limit changes with {}", .0.iter().map(|n| format!("`{n}`")).collect::<Vec<_>>().join(", "))]
    NothingMoves(Vec<String>),
}

/// One run.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Evaluation {
    /// Values of the parameters, SI.
    pub x: Vec<f64>,
    /// The goal, SI; of several the largest.
    pub goal: f64,
    /// The goal as it is searched with: the norm of several, or the same.
    pub smooth: f64,
    /// By how much limits are broken, as shares of their bounds; below zero where they are not.
    pub beyond: Vec<f64>,
    /// Both sides of each limit, SI.
    pub sides: Vec<[f64; 2]>,
    /// Substeps of the run.
    pub substeps: usize,
    /// Why there is none of this, where the run failed.
    pub failed: Option<String>,
}

impl Evaluation {
    /// By how much the worst limit is broken; 0 where all hold.
    #[must_use]
    pub fn broken(&self) -> f64 {
        self.beyond.iter().fold(0.0, |m, x| x.max(m))
    }
}

/// Why a search ended.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum Stop {
    /// The derivatives are zero, but for a few thousandths of the goal over the whole range of the parameters.
    Smallest,
    /// Nothing around is better although there are derivatives: a kink, where a peak moves to another time or place, or a gain below
    /// what the steps of runs make of a result.
    Kink,
    /// No value of the parameters was found with which all limits hold.
    Limits,
    /// As many runs as there may be.
    Spent,
    /// Somebody wanted an end.
    Interrupted,
}

impl Stop {
    /// Name in JSON.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::Smallest => "smallest",
            Self::Kink => "kink",
            Self::Limits => "limits",
            Self::Spent => "spent",
            Self::Interrupted => "interrupted",
        }
    }
}

/// A limit at the end.
#[derive(Clone, Debug, PartialEq)]
pub struct Limited {
    /// As it was given.
    pub text: String,
    /// Its left side with the best values, SI.
    pub value: f64,
    /// Its bound, SI.
    pub bound: f64,
    /// Unit of both.
    pub unit: String,
    /// By how much it is broken, as share of the bound; below zero where it is not.
    pub beyond: f64,
    /// What the bound costs: one per cent more of it changes the goal by so many per cent of that at the start; 0 where it does not matter.
    pub multiplier: f64,
}

/// What was found.
#[derive(Clone, Debug)]
pub struct Optimum {
    /// Names of the parameters.
    pub parameters: Vec<String>,
    /// Their units.
    pub units: Vec<String>,
    /// Their bounds, SI.
    pub bounds: Vec<[f64; 2]>,
    /// What is made smallest, one by one.
    pub goal: Vec<String>,
    /// Unit of the goal.
    pub goal_unit: String,
    /// All runs; the first one is that of the values of the file.
    pub runs: Vec<Evaluation>,
    /// Index of the best: the smallest goal among those in which all limits hold, or else the least broken one.
    pub best: usize,
    /// The limits with the best values.
    pub limits: Vec<Limited>,
    /// Why the search ended.
    pub stop: Stop,
    /// How often it began anew, because a goal with kinks had led it to where nothing was better along its way.
    pub restarts: usize,
    /// Links whose laws bend at the end of substeps of the best run: derivatives are those of one side there.
    pub bends: Vec<Bend>,
    /// Parameters whose values were outside the bounds or on one, and where the search began.
    pub moved: Vec<(String, f64)>,
}

impl Optimum {
    /// The best run.
    #[must_use]
    pub fn best(&self) -> &Evaluation {
        &self.runs[self.best]
    }

    /// True where all limits hold.
    #[must_use]
    pub fn holds(&self) -> bool {
        self.best().broken() <= HOLDS
    }

    /// The best values as expressions that are read to the bit, for [`read`](crate::read).
    #[must_use]
    pub fn set(&self) -> Vec<(String, String)> {
        let all = self.parameters.iter().zip(&self.units).zip(&self.best().x);
        let one = |x: f64, unit: &str| match unit {
            "1" | "" => format!("{x:?}"),
            unit => format!("{x:?} {unit}"),
        };
        all.map(|((name, unit), x)| (name.clone(), one(*x, unit))).collect()
    }
}

/// Searches for the values of parameters that make a goal smallest.
///
/// # Errors
/// [`OptimizeError`] where the model, the parameters, the goal or a limit are wrong, and where there are no derivatives.
pub fn optimize(
    text: &ModelText,
    registry: &Registry,
    wanted: &Wanted,
) -> Result<Optimum, OptimizeError> {
    optimize_with(text, registry, wanted, &mut |_, _| (), &AtomicBool::new(false))
}

/// The same; `on_run` is shown every run with its number from 0 once it is made, and the flag ends the search once it is true, at the next
/// output step.
///
/// # Errors
/// As [`optimize`], and [`Error::Interrupted`](crate::Error::Interrupted) where not even the first run came to its end.
pub fn optimize_with(
    text: &ModelText,
    registry: &Registry,
    wanted: &Wanted,
    on_run: &mut dyn FnMut(usize, &Evaluation),
    interrupt: &AtomicBool,
) -> Result<Optimum, OptimizeError> {
    let model = text.read(registry, &wanted.set).map_err(GradientError::Model)?;
    if wanted.by.is_empty() {
        return Err(OptimizeError::NoVariable);
    }
    let (mut ranges, mut start, mut moved) = (Vec::new(), Vec::new(), Vec::new());
    let by = expanded(&wanted.by, &model)?;
    for (i, variable) in by.iter().enumerate() {
        if by[..i].iter().any(|v| v.name == variable.name) {
            return Err(OptimizeError::Twice(variable.name.clone()));
        }
        let (value, dimension) = gradient::value_of(&model, &variable.name)?;
        let range = Range::new(variable, dimension)?;
        let y = range.start(value);
        if (range.at(y) - value).abs() > 1e-9 * (range.high - range.low) {
            moved.push((variable.name.clone(), range.at(y)));
        }
        start.push(y);
        ranges.push(range);
    }
    let goal = Goal::new(&wanted.minimise, &model)?;
    let limits =
        wanted.limits.iter().map(|l| Limit::new(l, &model)).collect::<Result<Vec<_>, _>>()?;
    let input = goal.terms.iter().any(Term::names_input) || limits.iter().any(Limit::names_input);
    let names: Vec<String> = ranges.iter().map(|r| r.name.clone()).collect();
    let of_gradient = gradient::Wanted {
        case: wanted.case.clone(),
        solver: wanted.solver,
        dt: wanted.dt,
        by: names.clone(),
        set: wanted.set.clone(),
        input,
    };
    let most = wanted.max_runs.max(1);
    let course = Course::new(
        (text, registry),
        of_gradient,
        &ranges,
        (&goal, &limits),
        most,
        (on_run, interrupt),
    );
    let course = RefCell::new(course);
    let ended = search::search(&course, start)?;
    let mut course = course.into_inner();
    if course.told.is_empty() {
        return Err(GradientError::Run(crate::Error::Interrupted).into());
    }
    let best = best(&course.told);
    let bends = course.bends.swap_remove(best);
    let evaluation = &course.told[best];
    let limits = limits.iter().enumerate().map(|(i, limit)| Limited {
        text: limit.text.clone(),
        value: evaluation.sides[i][0],
        bound: evaluation.sides[i][1],
        unit: course.limit_units[i].clone(),
        beyond: evaluation.beyond[i],
        multiplier: ended.multipliers[i],
    });
    Ok(Optimum {
        parameters: names,
        units: ranges.iter().map(|r| r.dimension.unit()).collect(),
        bounds: ranges.iter().map(|r| [r.low, r.high]).collect(),
        goal: goal.terms.iter().map(|t| t.text.clone()).collect(),
        goal_unit: course.goal_unit,
        limits: limits.collect(),
        best,
        stop: ended.stop,
        restarts: ended.restarts,
        bends,
        moved,
        runs: course.told,
    })
}

/// Variables whose names end with `*` stand for all parameters whose names begin so and that are numbers.
fn expanded(by: &[Variable], model: &Model) -> Result<Vec<Variable>, OptimizeError> {
    let mut all = Vec::new();
    for variable in by {
        let Some(begin) = variable.name.strip_suffix('*') else {
            all.push(variable.clone());
            continue;
        };
        let numbers =
            model.parameters.iter().filter(|p| matches!(p.value, ParameterValue::Number(..)));
        let before = all.len();
        let one = |p: &Parameter| Variable { name: p.name.clone(), ..variable.clone() };
        all.extend(numbers.filter(|p| p.name.starts_with(begin)).map(one));
        if all.len() == before {
            let (name, reason) = (variable.name.clone(), "no parameter begins so".into());
            return Err(OptimizeError::Bounds { name, reason });
        }
    }
    Ok(all)
}

/// The best of runs, the first of which has not failed.
fn best(runs: &[Evaluation]) -> usize {
    let key = |e: &Evaluation| {
        let broken = e.broken();
        if broken <= HOLDS { (0.0, e.smooth) } else { (broken, e.smooth) }
    };
    let mut best = 0;
    for (i, run) in runs.iter().enumerate().filter(|(_, r)| r.failed.is_none()) {
        if key(run) < key(&runs[best]) {
            best = i;
        }
    }
    best
}
