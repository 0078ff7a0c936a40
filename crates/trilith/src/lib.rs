//! Small finite-element models with nonlinear links, solved by fast nonlinear analysis or direct
//! integration.
//!
//! ```
//! let text = r#"(
//!     plane: XZ,
//!     nodes: { "top": (0, 0, 1), "base": (0, 0, 0) },
//!     supports: { "base": Fixed },
//!     elements: {
//!         "mass": Mass(node: "top", mass: "1 kg"),
//!         "spring": Spring(nodes: ("base", "top"), k1: "1 kN/m", k2: "39.4784 N/m", r2: 1, r3: 1),
//!         "stop": Gap(nodes: ("base", "top"), k: "1 kN/m", opening: "1 cm"),
//!     },
//!     cases: {
//!         "swing": Dynamic(
//!             duration: "2 s", dt: "0.01 s",
//!             initial: [(node: "top", dof: Ux, displacement: "2 cm")],
//!         ),
//!     },
//!     outputs: { "sway": Displacement(node: "top", dof: Ux) },
//! )"#;
//! let model = trilith::read_text(text, "swing.ron", &trilith::registry(), &[]).expect("a model");
//! let run = trilith::run(&model, "swing").expect("a run");
//! let sway = run.peak("sway").expect("an output");
//! assert!((sway.max - 0.02).abs() < 1e-4 && (sway.min + 0.02).abs() < 2e-4);
//! assert_eq!(run.time().len(), run.history("sway").expect("an output").len());
//! ```
//!
//! - [`read`] turns a model file into a [`Model`], with [`Values`] of its parameters, or into [`Diagnostics`], all its errors at once.
//! - [`ModelBuilder`] makes a model in code, block by block.
//! - [`run`] runs a case as the file says; [`Analysis`] runs several, with options: a [`CaseRun`] each.
//! - [`Checkpoint`] keeps where a run stopped in a file, for `from` of a later one's [`RunOptions`].
//! - [`write_report`] makes the page of a run, [`rebuild_report`] makes it again from its folder.
//! - [`mod@combine`] makes sums and envelopes of the extremes of several cases.
//! - [`compare`] solves a case in several ways and finds why the results differ.
//! - [`exercise`] shows what a link does on its own, [`catalogue`] what kinds there are.
//! - [`json_schema`] is the schema of models in JSON.
//! - [`generate`] makes models from a few numbers.
//! - [`sweep`] runs a model with many values of its parameters, several analyses side by side.
//! - [`mod@gradient`] finds exact derivatives of outputs by parameters.
//! - [`mod@reduce`] puts a superelement of few rows in place of a part (Craig–Bampton).
//! - `optimize` (a feature, on by default) finds the values of parameters that make a goal smallest.
//! - [`calibrate`] finds dashpots from coefficients of restitution.
//! - A link of your own: implement [`element::Link`], offer it with `registry.link::<MyLink>()`.
//!
//! Everything beneath is in the modules [`element`], [`elements`], [`mod@record`], [`model`], [`system`],
//! [`solvers`], [`results`] and [`report`].

mod analysis;
mod builder;
pub mod calibrate;
mod case_run;
pub mod catalogue;
mod checkpoint;
pub mod combine;
pub mod compare;
mod error;
pub mod exercise;
pub mod generate;
pub mod gradient;
mod lanes;
#[cfg(feature = "optimize")]
pub mod optimize;
mod reading;
pub mod reduce;
mod report_check;
mod run_report;
mod schema;
pub mod sweep;
pub mod theory;
mod version;

/// The contract that elements, constraints and links fulfil.
pub mod element {
    pub use trilith_element::*;
}
/// The built-in elements, constraints and links.
pub mod elements {
    pub use trilith_elements::*;
}
/// Ground motion records: readers, processing, measures, response spectra, synthetic motions.
pub mod record {
    pub use trilith_record::*;
}
/// Models and the files they are read from.
pub mod model {
    pub use trilith_model::*;
}
/// Models as equations.
pub mod system {
    pub use trilith_system::*;
}
/// Solvers and what observes them.
pub mod solvers {
    pub use trilith_solvers::*;
}
/// Recorders and files.
pub mod results {
    pub use trilith_results::*;
}

/// Figures and pages.
pub mod report {
    pub use trilith_report::*;
}

pub use analysis::{Analysis, Run};
pub use builder::{ModelBuilder, block, word};
pub use case_run::CaseRun;
pub use checkpoint::{Checkpoint, CheckpointError};
pub use element::Register;
pub use error::Error;
pub use model::{Diagnostic, Model, Registry, SolverKind};
pub use reading::{Diagnostics, Value, Values, read, read_text};
pub use run_report::{ReportError, rebuild_report, write_report};
pub use schema::json_schema;
pub use solvers::RunOptions;
pub use version::{BUILD, LONG_VERSION, VERSION};

/// A registry with every built-in kind.
#[must_use]
pub fn registry() -> Registry {
    let mut registry = Registry::new();
    trilith_elements::register(&mut registry);
    registry
}

/// Runs a case of a model as its file says.
///
/// # Errors
/// [`Error`] where the case does not exist, the structure is not one, or the run cannot be made.
pub fn run(model: &Model, case: &str) -> Result<Run, Error> {
    let case = model.case(case).ok_or_else(|| Error::unknown_case(model, case))?;
    Analysis::new(model)?.run(RunOptions { case, ..RunOptions::default() })
}
