//! A study: many runs behind one statement.

use crate::case::{Claim, Kind, Tolerance};
use crate::{Outcome, Row, Table};
use trilith_report::Figure;

/// A study.
#[derive(Clone, Copy, Debug)]
pub struct Study {
    /// Short name.
    pub id: &'static str,
    /// What it shows.
    pub title: &'static str,
    /// Where references and tolerances come from.
    pub source: &'static str,
    /// Makes the runs and says what they gave.
    pub work: fn(&mut Findings) -> Result<(), String>,
}

/// What a study has found so far.
#[derive(Clone, Debug, Default)]
pub struct Findings {
    text: Vec<String>,
    figures: Vec<Figure>,
    tables: Vec<Table>,
    claims: Vec<(Claim, String, f64)>,
}

impl Findings {
    /// Adds a paragraph.
    pub fn text(&mut self, text: impl Into<String>) {
        self.text.push(text.into());
    }

    /// Adds a figure.
    pub fn figure(&mut self, figure: Figure) {
        self.figures.push(figure);
    }

    /// Adds a table of what was measured without a verdict, such as times.
    pub fn table(&mut self, head: &[&str], rows: Vec<Vec<String>>) {
        let head = head.iter().map(|h| (*h).to_owned()).collect();
        self.tables.push(Table { head, rows });
    }

    /// Compares a value with a reference. `solver`: what gave the value.
    pub fn check(
        &mut self,
        quantity: impl Into<String>,
        unit: &'static str,
        (reference, kind): (f64, Kind),
        tolerance: Tolerance,
        solver: &str,
        value: f64,
    ) {
        let quantity = quantity.into();
        let claim = Claim { quantity, reference, unit, tolerance, kind };
        self.claims.push((claim, solver.to_owned(), value));
    }
}

impl Study {
    /// Makes the runs.
    #[must_use]
    pub fn run(&self) -> Outcome {
        let mut found = Findings::default();
        let result = (self.work)(&mut found);
        if let Err(reason) = result {
            return self.failed(&reason);
        }
        let rows = found.claims.into_iter().map(|(claim, solver, value)| {
            Row::new(self.id, self.source, claim, &solver, value, None)
        });
        let rows = self.outcome(rows.collect());
        Outcome { text: found.text, figures: found.figures, tables: found.tables, ..rows }
    }

    /// A study that could not be made.
    #[must_use]
    pub fn failed(&self, reason: &str) -> Outcome {
        let claim = Claim {
            quantity: "the study runs".into(),
            reference: 1.0,
            unit: "",
            tolerance: Tolerance::Absolute(0.0),
            kind: Kind::Theory,
        };
        let row = Row::new(self.id, self.source, claim, "all", f64::NAN, Some(reason.into()));
        self.outcome(vec![row])
    }

    fn outcome(&self, rows: Vec<Row>) -> Outcome {
        let Self { id, title, source, .. } = *self;
        Outcome {
            id,
            title,
            source,
            text: Vec::new(),
            rows,
            figures: Vec::new(),
            unavailable: None,
            tables: Vec::new(),
        }
    }
}
