//! Exact derivatives of outputs by parameters of a model file.
//!
//! ```
//! let text = r#"(
//!     parameters: { "c": "2 kN*s/m" },
//!     plane: XZ,
//!     nodes: { "top": (0, 0, 1), "base": (0, 0, 0) },
//!     supports: { "base": Fixed },
//!     elements: {
//!         "mass": Mass(node: "top", mass: "1 t"),
//!         "spring": Spring(nodes: ("base", "top"), k1: "1 MN/m", k2: "39.4784 kN/m", r2: 1, r3: 1),
//!         "damper": Dashpot(nodes: ("base", "top"), axis: U2, c: "c"),
//!     },
//!     cases: {
//!         "swing": Dynamic(
//!             duration: "1 s", dt: "0.01 s", solver: Hht,
//!             initial: [(node: "top", dof: Ux, displacement: "2 cm")],
//!         ),
//!     },
//!     outputs: { "sway": Displacement(node: "top", dof: Ux) },
//! )"#;
//! let text = trilith::model::ModelText::new(text, "swing.ron").expect("a text");
//! let of = trilith::gradient::Wanted { by: vec!["c".into()], ..Default::default() };
//! let gradient = trilith::gradient::gradient(&text, &trilith::registry(), &of).expect("derivatives");
//! let sway = &gradient.outputs[0];
//! // A stronger damper lets it swing back less far.
//! assert!(sway.min.value < 0.0 && sway.min.by[0] > 0.0);
//! ```

use crate::Error;
use std::sync::atomic::AtomicBool;
use trilith_element::Dimension;
use trilith_model::{Analysis, Diagnostic, Model, ModelText, ParameterValue, Registry, SolverKind};
use trilith_solvers::gradient::gradient_until as gradient_until_of;
use trilith_solvers::gradient::{Around, Gradient, GradientOptions, OFFSETS, SMALL, Varied};
use trilith_solvers::{SolveError, assemble};

/// Step of differences between models, as share of the value of a parameter.
const STEP: f64 = 1e-3;

/// What to differentiate, and by what.
#[derive(Clone, Debug, Default)]
pub struct Wanted {
    /// Name of the case; `None`: the last.
    pub case: Option<String>,
    /// Solver; `None`: that of the case.
    pub solver: Option<SolverKind>,
    /// Output step in s; `None`: that of the case.
    pub dt: Option<f64>,
    /// Names of parameters; none: all that are numbers other than zero and leave the times of the case as they are.
    pub by: Vec<String>,
    /// Values of parameters in place of those of the file.
    pub set: Vec<(String, String)>,
    /// Whether the energy that loads and moving supports put in is wanted too.
    pub input: bool,
}

/// Where an output is named: what all links together have turned into heat until the end.
pub const HEAT: &str = "heat";
/// The beginning of the name of what one link has turned into heat until the end; its name follows.
pub const HEAT_OF: &str = "heat of ";
/// What loads and moving supports have put in until the end.
pub const INPUT: &str = "input";

/// Why there are no derivatives.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum GradientError {
    /// The model is wrong.
    #[error("the model is wrong: {}", .0.iter().map(ToString::to_string).collect::<Vec<_>>().join("; "))]
    Model(Vec<Diagnostic>),
    /// The model is wrong beside the value of a parameter.
    #[error("beside `{name}` = {value} the model is wrong: {}", .errors.first().map(ToString::to_string).unwrap_or_default())]
    Beside {
        /// Name of the parameter.
        name: String,
        /// The value beside its own.
        value: String,
        /// What is wrong there.
        errors: Vec<Diagnostic>,
    },
    /// A parameter that the model does not have.
    #[error("the model has no parameter `{name}`; its parameters are {}", .all.join(", "))]
    UnknownParameter {
        /// The name asked for.
        name: String,
        /// Those there are.
        all: Vec<String>,
    },
    /// A parameter that is a text.
    #[error("parameter `{name}` is a text: there are derivatives by numbers alone")]
    Text {
        /// Its name.
        name: String,
    },
    /// A parameter that is zero.
    #[error(
        "parameter `{name}` is zero, which tells nothing of its size: give it a small value, as by `--set {name}=…`"
    )]
    Zero {
        /// Its name.
        name: String,
    },
    /// The case cannot be run, or has no derivatives.
    #[error(transparent)]
    Run(#[from] Error),
}

impl GradientError {
    /// What is wrong with the model, where it is that.
    #[must_use]
    pub fn diagnostics(&self) -> &[Diagnostic] {
        match self {
            Self::Model(all) | Self::Beside { errors: all, .. } => all,
            _ => &[],
        }
    }
}

/// The value of a parameter of a model, and its dimension.
pub(crate) fn value_of(model: &Model, name: &str) -> Result<(f64, Dimension), GradientError> {
    let all = &model.parameters;
    match all.iter().find(|p| p.name == name).map(|p| &p.value) {
        Some(ParameterValue::Number(value, dimension)) => Ok((*value, *dimension)),
        Some(ParameterValue::Text(_)) => Err(GradientError::Text { name: name.into() }),
        None => {
            let all = all.iter().map(|p| format!("`{}`", p.name)).collect();
            Err(GradientError::UnknownParameter { name: name.into(), all })
        }
    }
}

/// A number as an expression of this dimension that is read to the bit.
pub(crate) fn expression(value: f64, dimension: Dimension) -> String {
    if dimension.is_none() {
        format!("{value:?}")
    } else {
        format!("{value:?} {}", dimension.unit())
    }
}

/// Models beside the value of a parameter.
struct Beside<'a> {
    text: &'a ModelText,
    registry: &'a Registry,
    set: &'a [(String, String)],
    name: &'a str,
    value: f64,
    dimension: Dimension,
}

impl Beside<'_> {
    fn at(&self, by: f64) -> Result<Model, GradientError> {
        let value = expression(self.value + by, self.dimension);
        let mut set = self.set.to_vec();
        set.retain(|(name, _)| name != self.name);
        set.push((self.name.to_owned(), value.clone()));
        let name = self.name.to_owned();
        let model = self.text.read(self.registry, &set);
        model.map_err(|errors| GradientError::Beside { name, value, errors })
    }

    fn around(&self) -> Result<Around, GradientError> {
        let step = STEP * self.value.abs();
        let [a, b, c, d] = OFFSETS.map(|offset| self.at(offset * step));
        Ok(Around {
            of: Varied { name: self.name.to_owned(), value: self.value, step },
            near: [a?, b?, c?, d?],
            close: [self.at(-SMALL * step)?, self.at(SMALL * step)?],
        })
    }
}

/// The model around the values of some of its parameters.
///
/// # Errors
/// [`GradientError`] where one is unknown, zero or a text, or where the model is wrong beside its value.
pub fn around(
    text: &ModelText,
    registry: &Registry,
    set: &[(String, String)],
    model: &Model,
    names: &[String],
) -> Result<Vec<Around>, GradientError> {
    let one = |name: &String| {
        let (value, dimension) = value_of(model, name)?;
        if value == 0.0 {
            return Err(GradientError::Zero { name: name.clone() });
        }
        Beside { text, registry, set, name, value, dimension }.around()
    };
    names.iter().map(one).collect()
}

/// Names of the parameters that are numbers other than zero.
#[must_use]
pub fn numbers(model: &Model) -> Vec<String> {
    let number =
        |value: &ParameterValue| matches!(value, ParameterValue::Number(x, _) if *x != 0.0);
    model.parameters.iter().filter(|p| number(&p.value)).map(|p| p.name.clone()).collect()
}

/// True where a case has the same length and output step on both sides of a parameter.
fn keeps_its_times(around: &Around, case: usize) -> bool {
    let [low, .., high] = &around.near;
    match (low.cases.get(case).map(|c| &c.analysis), high.cases.get(case).map(|c| &c.analysis)) {
        (Some(Analysis::Dynamic(a)), Some(Analysis::Dynamic(b))) => {
            a.duration == b.duration && a.dt == b.dt
        }
        _ => true,
    }
}

/// Runs a case and finds the derivatives of all its outputs by parameters.
///
/// # Errors
/// [`GradientError`] where a parameter is none, or moves what must stay as it is.
pub fn gradient(
    text: &ModelText,
    registry: &Registry,
    wanted: &Wanted,
) -> Result<Gradient, GradientError> {
    whole(text, registry, wanted, None).map(|whole| whole.found)
}

/// The same; a flag ends it at the next output step once it is true.
///
/// # Errors
/// As [`gradient`], and [`Error::Interrupted`].
pub fn gradient_until(
    text: &ModelText,
    registry: &Registry,
    wanted: &Wanted,
    interrupt: &AtomicBool,
) -> Result<Gradient, GradientError> {
    whole(text, registry, wanted, Some(interrupt)).map(|whole| whole.found)
}

/// Derivatives, and what they were made of.
#[cfg_attr(
    not(feature = "optimize"),
    expect(dead_code, reason = "`optimize` alone asks for the models")
)]
pub(crate) struct Whole {
    pub model: Model,
    /// The model around each parameter.
    pub around: Vec<Around>,
    pub found: Gradient,
}

/// As [`gradient`], with the models.
pub(crate) fn whole(
    text: &ModelText,
    registry: &Registry,
    wanted: &Wanted,
    interrupt: Option<&AtomicBool>,
) -> Result<Whole, GradientError> {
    let model = text.read(registry, &wanted.set).map_err(GradientError::Model)?;
    let names = if wanted.by.is_empty() { numbers(&model) } else { wanted.by.clone() };
    let mut around = around(text, registry, &wanted.set, &model, &names)?;
    let case = match &wanted.case {
        Some(name) => model.case(name).ok_or_else(|| Error::unknown_case(&model, name))?,
        None => model.cases.len().saturating_sub(1),
    };
    if wanted.by.is_empty() {
        around.retain(|around| keeps_its_times(around, case));
    }
    let Wanted { solver, dt, input, .. } = *wanted;
    let options = GradientOptions { case, solver, dt, input };
    let system = assemble(&model).map_err(Error::from)?;
    let found = gradient_until_of(&model, &system, options, &around, interrupt);
    let found = found.map_err(|e| match e {
        SolveError::Interrupted { .. } if interrupt.is_some() => Error::Interrupted,
        e => e.into(),
    })?;
    drop(system);
    Ok(Whole { model, around, found })
}
