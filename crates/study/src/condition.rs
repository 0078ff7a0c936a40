//! Conditions on a run: what stops a series, what asks for histories, what is counted.

use crate::{Column, Row};
use trilith::report::short;

/// A condition on a finished run.
#[derive(Clone, Debug, PartialEq)]
pub enum Condition {
    /// Every run.
    All,
    /// A body has fallen over.
    Overturned,
    /// The run did not come to a trusted end.
    Failed,
    /// A column is above a value.
    Above(String, f64),
    /// A column is below a value.
    Below(String, f64),
    /// The response mode over the whole run.
    Mode(String),
    /// Any of these.
    Any(Vec<Self>),
}

impl Condition {
    /// True where it holds. A run that has fallen over is above every value: what it would have reached has
    /// no end.
    #[must_use]
    pub fn holds(&self, columns: &[Column], run: Row<'_>) -> bool {
        let value = |name: &str| {
            let column = columns.iter().position(|c| c.name == name);
            column.and_then(|i| run.value(i))
        };
        match self {
            Self::All => true,
            Self::Overturned => run.overturned(),
            Self::Failed => !run.good(),
            Self::Above(name, limit) => run.overturned() || value(name).is_some_and(|x| x > *limit),
            Self::Below(name, limit) => {
                !run.overturned() && value(name).is_some_and(|x| x < *limit)
            }
            Self::Mode(mode) => run.mode() == Some(mode),
            Self::Any(all) => all.iter().any(|c| c.holds(columns, run)),
        }
    }

    /// In words.
    #[must_use]
    pub fn text(&self) -> String {
        match self {
            Self::All => "all runs".into(),
            Self::Overturned => "overturned".into(),
            Self::Failed => "failed".into(),
            Self::Above(name, limit) => format!("{name} > {limit}"),
            Self::Below(name, limit) => format!("{name} < {limit}"),
            Self::Mode(mode) => format!("mode {mode}"),
            Self::Any(all) => all.iter().map(Self::text).collect::<Vec<_>>().join(" or "),
        }
    }
}

impl crate::Study {
    /// A condition in words for a reader, with units.
    pub(crate) fn words(&self, condition: &Condition) -> String {
        let limit = |name: &str, sign: &str, x: f64| {
            let unit = self.unit(name);
            let text = format!("{} {sign} {} {unit}", name.replace('_', " "), short(x, 6));
            text.trim_end().to_owned()
        };
        match condition {
            Condition::Above(name, x) => limit(name, ">", *x),
            Condition::Below(name, x) => limit(name, "<", *x),
            Condition::Any(all) => {
                all.iter().map(|c| self.words(c)).collect::<Vec<_>>().join(" or ")
            }
            other => other.text(),
        }
    }
}
