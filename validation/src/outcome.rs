//! What a case or a study found.

use crate::case::{Claim, Tolerance};
use serde::Serialize;
use trilith_report::Figure;

/// What a case or a study found.
#[derive(Clone, Debug)]
pub struct Outcome {
    /// Short name.
    pub id: &'static str,
    /// What it shows.
    pub title: &'static str,
    /// Where references and tolerances come from.
    pub source: &'static str,
    /// Paragraphs for the page.
    pub text: Vec<String>,
    /// Comparisons.
    pub rows: Vec<Row>,
    /// Figures.
    pub figures: Vec<Figure>,
    /// Why it could not be made here: what it needs is not part of the project and was not found.
    pub unavailable: Option<String>,
    /// Tables of what was measured without a verdict.
    pub tables: Vec<Table>,
}

/// A table with a row of heads.
#[derive(Clone, Debug)]
pub struct Table {
    /// Heads of the columns.
    pub head: Vec<String>,
    /// Rows.
    pub rows: Vec<Vec<String>>,
}

impl Outcome {
    /// Neither passed nor failed: what it needs is not there.
    #[must_use]
    pub fn unavailable(
        id: &'static str,
        title: &'static str,
        source: &'static str,
        reason: &str,
    ) -> Self {
        let (text, rows, figures) = (vec![format!("Not run: {reason}.")], Vec::new(), Vec::new());
        let (tables, unavailable) = (Vec::new(), Some(reason.to_owned()));
        Self { id, title, source, text, rows, figures, tables, unavailable }
    }

    /// True where every comparison passes, and there is one.
    #[must_use]
    pub fn pass(&self) -> bool {
        !self.rows.is_empty() && self.rows.iter().all(|r| r.pass)
    }

    /// True where it was run and does not pass.
    #[must_use]
    pub fn fails(&self) -> bool {
        self.unavailable.is_none() && !self.pass()
    }
}

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
    /// `closed form`, `published`, `other code` or `theory`.
    pub kind: String,
    /// `fna`, `hht` or `modes`; studies: what was compared.
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

impl Row {
    /// Compares a value with what it must be. A note means that the run is not to be trusted.
    #[must_use]
    pub fn new(
        id: &str,
        source: &str,
        claim: Claim,
        solver: &str,
        value: f64,
        note: Option<String>,
    ) -> Self {
        let (tolerance, scale, measure) = match claim.tolerance {
            Tolerance::Relative(x) => (x, claim.reference.abs(), "relative"),
            Tolerance::Absolute(x) => (x, 1.0, "absolute"),
            Tolerance::AtLeast => (0.0, 1.0, "at least"),
            Tolerance::AtMost => (0.0, 1.0, "at most"),
        };
        let error = match claim.tolerance {
            Tolerance::AtLeast => (claim.reference - value).max(0.0),
            Tolerance::AtMost => (value - claim.reference).max(0.0),
            _ => (value - claim.reference) / scale,
        };
        // `max` swallows what is not a number.
        let error = if value.is_finite() { error } else { f64::NAN };
        let finite = |x: f64| x.is_finite().then_some(x);
        Self {
            id: id.into(),
            quantity: claim.quantity,
            unit: claim.unit.into(),
            reference: claim.reference,
            source: source.into(),
            kind: claim.kind.name().into(),
            solver: solver.into(),
            value: finite(value),
            error: finite(error),
            tolerance,
            measure: measure.into(),
            pass: error.abs() <= tolerance && note.is_none(),
            note: note.or_else(|| (!value.is_finite()).then(|| "not found in the run".into())),
        }
    }
}
