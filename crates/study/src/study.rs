//! A study, checked and ready to run.

use crate::shape::Shape;
use crate::{Column, Condition, Drawing, Identity, Plan};
use std::path::PathBuf;
use trilith::element::Dimension;
use trilith::model::{Diagnostic, Model, ModelText, Source};
use trilith::{Registry, SolverKind};

/// A study, checked and ready to run.
#[derive(Debug)]
pub struct Study {
    /// Title.
    pub title: String,
    /// Path of the study file.
    pub path: PathBuf,
    /// Path of the model.
    pub model_path: PathBuf,
    /// Title of the model.
    pub model_title: String,
    /// Other files that its runs read, such as records, as far as they are named by texts of axes and points.
    pub files: Vec<PathBuf>,
    /// Its runs.
    pub plan: Plan,
    /// What is kept of each run.
    pub columns: Vec<Column>,
    /// A series along the axis of the plan ends with the first run where this holds.
    pub stop: Option<Condition>,
    /// Runs whose histories are kept.
    pub histories: Option<Condition>,
    /// What is counted, by name.
    pub events: Vec<(String, Condition)>,
    /// Axes over which statistics are taken, beside samples and ensemble.
    pub over: Vec<usize>,
    /// Scatter of the response over that of the parameters above which a point counts as sensitive.
    pub sensitive_above: f64,
    /// Figures.
    pub figures: Vec<Drawing>,
    /// What tells its runs from those of another.
    pub identity: Identity,
    /// Parameters that differ between runs, in the order of the table.
    pub varied: Vec<String>,
    pub(crate) text: ModelText,
    /// What the models of all runs have alike.
    pub(crate) shape: Shape,
    pub(crate) case: usize,
    /// Its name, where the study says it.
    pub(crate) case_named: Option<String>,
    /// Name of the combination that runs in its place.
    pub(crate) combination: Option<String>,
    pub(crate) solver: Option<SolverKind>,
    /// Dimension of each varied parameter; none for a text.
    pub(crate) kinds: Vec<Option<Dimension>>,
}

impl Study {
    /// The model file and those that it includes.
    pub fn sources(&self) -> impl Iterator<Item = &Source> {
        self.text.sources()
    }

    /// Name of the case, where the study names one.
    #[must_use]
    pub fn case_named(&self) -> Option<&str> {
        self.case_named.as_deref()
    }

    /// The solver, where the study names one.
    #[must_use]
    pub fn solver(&self) -> Option<SolverKind> {
        self.solver
    }

    /// The model with the values of a run.
    ///
    /// # Errors
    /// What is wrong with the model at these values.
    pub fn model_of(&self, registry: &Registry, run: usize) -> Result<Model, Vec<Diagnostic>> {
        let set = self.plan.nominal(&self.plan.place(run));
        self.text.read(registry, &set)
    }

    /// True where a varied parameter is a text.
    #[must_use]
    pub fn is_text(&self, name: &str) -> bool {
        self.varied.iter().position(|n| n == name).is_some_and(|i| self.kinds[i].is_none())
    }

    /// SI unit of a column or a varied parameter; empty for a pure number.
    #[must_use]
    pub fn unit(&self, name: &str) -> String {
        if let Some(column) = self.columns.iter().find(|c| c.name == name) {
            return column.unit.clone();
        }
        let kind = self.varied.iter().position(|n| n == name).and_then(|i| self.kinds[i]);
        kind.filter(|d| !d.is_none()).map_or_else(String::new, Dimension::unit)
    }

    /// Name and unit for an axis of a figure.
    #[must_use]
    pub fn label(&self, name: &str) -> String {
        match self.unit(name).as_str() {
            "" | "1" => name.replace('_', " "),
            unit => format!("{} [{unit}]", name.replace('_', " ")),
        }
    }
}
