//! What is wrong with the file of a record, on which line, and what would be right.

use crate::finite::{LONGEST_STEP, MOST_SAMPLES, NotFinite, SHORTEST_STEP};
use std::fmt;

/// Characters of the longest text of a file that is quoted.
const LONGEST: usize = 16;

/// A text of a file as an error shows it: a short one in quotes, with control characters escaped; of a long one
/// its length, since it may be anything.
pub(crate) fn quoted(text: &str) -> String {
    let count = text.chars().count();
    if count > LONGEST {
        return format!("a text of {count} characters");
    }
    let mut shown = String::from("`");
    for c in text.chars() {
        if c.is_control() {
            shown.extend(c.escape_default());
        } else {
            shown.push(c);
        }
    }
    shown.push('`');
    shown
}

/// Why a file gives no record.
#[derive(Clone, Debug, PartialEq)]
pub struct ReadError {
    /// The file, as the user named it.
    pub file: String,
    /// The line, from 1, where one is to blame.
    pub line: Option<usize>,
    /// The character of the line, from 1, where one cell of it is to blame.
    pub column: Option<usize>,
    /// What is wrong.
    pub problem: Problem,
}

impl ReadError {
    /// What would be right, where that can be said in a sentence.
    #[must_use]
    pub fn help(&self) -> Option<String> {
        self.problem.help()
    }
}

impl fmt::Display for ReadError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match (self.line, self.column) {
            (Some(line), Some(column)) => {
                write!(f, "{}:{line}:{column}: {}", self.file, self.problem)
            }
            (Some(line), None) => write!(f, "{}:{line}: {}", self.file, self.problem),
            (None, _) => write!(f, "{}{}{}", self.file, self.problem.joint(), self.problem),
        }
    }
}

impl std::error::Error for ReadError {}

/// What can be wrong with a file.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum Problem {
    /// The system does not give it.
    #[error("cannot be read: {0}")]
    Unreadable(String),
    /// It has no content.
    #[error("is empty")]
    Empty,
    /// It is packed.
    #[error("is a packed file ({0})")]
    Packed(&'static str),
    /// It is no text.
    #[error("is a binary file, not a text")]
    Binary,
    /// No format fits.
    #[error("is in no format that is known here")]
    UnknownFormat,
    /// A line that the format needs is missing.
    #[error("has no {0}")]
    Missing(&'static str),
    /// A part of the header is no number.
    #[error("{} is no {what}", quoted(.text))]
    Header {
        /// What stands there.
        text: String,
        /// What should.
        what: &'static str,
    },
    /// The time step is stated nowhere.
    #[error("the time step is stated nowhere")]
    NoStep,
    /// A time step that is none, or beyond all use.
    #[error(
        "a time step of {0:?} s: must be between {min:e} s and {max:e} s",
        min = SHORTEST_STEP,
        max = LONGEST_STEP
    )]
    BadStep(f64),
    /// File and user state different steps.
    #[error("the file has a time step of {file} s, {given} s was given")]
    StepConflict {
        /// That of the file, s.
        file: f64,
        /// That of the user, s.
        given: f64,
    },
    /// Times of the samples are not evenly spaced.
    #[error("time steps are uneven: {found} s to {time} s, {step} s before")]
    Uneven {
        /// The step from the sample before, s.
        found: f64,
        /// Time of the sample, s.
        time: f64,
        /// The step so far, s.
        step: f64,
    },
    /// Time does not increase.
    #[error("time must increase: {time} s follows {before} s")]
    Order {
        /// Time of the sample, s.
        time: f64,
        /// Time of the one before, s.
        before: f64,
    },
    /// Times of their own, as film digitised by hand has them.
    #[error("the samples have times of their own (pairs of time and acceleration)")]
    Pairs,
    /// The unit is stated nowhere.
    #[error("the unit of the acceleration is stated nowhere")]
    NoUnit,
    /// A unit that is not known.
    #[error("{} is no unit of acceleration that is known here", quoted(.0))]
    UnknownUnit(String),
    /// Digitiser counts without a scale.
    #[error("the values are counts of the recorder")]
    Counts,
    /// File and user state different units.
    #[error("the file says 1 unit = {file} m/s², {given} m/s² was given")]
    UnitConflict {
        /// That of the file, m/s².
        file: f64,
        /// That of the user, m/s².
        given: f64,
    },
    /// Not a number.
    #[error("{} is no finite number", quoted(.0))]
    NotANumber(String),
    /// A number with a comma in it.
    #[error("{} has a comma within a number", quoted(.0))]
    DecimalComma(String),
    /// A motion that overflows.
    #[error(transparent)]
    NotFinite(#[from] NotFinite),
    /// More samples than a motion may have.
    #[error("there are more than {most} samples, the most of a motion", most = MOST_SAMPLES)]
    TooLong,
    /// More cells than a file of columns may have.
    #[error("there are more than {0} cells, the most of a file of columns")]
    TooManyCells(usize),
    /// Fewer values than stated.
    #[error("the file ends after {found} of {stated} values")]
    Truncated {
        /// Number in the header.
        stated: usize,
        /// Number of values.
        found: usize,
    },
    /// More values than stated.
    #[error("the header states {stated} values, there are {found}")]
    TooMany {
        /// Number in the header.
        stated: usize,
        /// Number of values.
        found: usize,
    },
    /// Too short to be a record.
    #[error("a record needs at least two samples, this one has {0}")]
    TooShort(usize),
    /// The data do not have the peak that the header states.
    #[error("the header states a peak of {stated} m/s², the data have {found} m/s²")]
    Peak {
        /// In the header, m/s².
        stated: f64,
        /// Of the data, m/s².
        found: f64,
    },
    /// Not an acceleration.
    #[error("the values are {0}, not an acceleration")]
    NotAcceleration(String),
    /// No such component.
    #[error("has no component `{name}`")]
    UnknownComponent {
        /// What was asked for.
        name: String,
        /// What there is.
        all: Vec<String>,
    },
    /// Several components, and none was chosen.
    #[error("has {} components", .0.len())]
    SeveralComponents(Vec<String>),
    /// A row without a column.
    #[error("there is no column {column}, the row has {cells}")]
    ShortRow {
        /// Position of the column, from 0.
        column: usize,
        /// Number of cells in the row.
        cells: usize,
    },
    /// No column of that name.
    #[error("has no column `{name}`")]
    UnknownColumn {
        /// The name.
        name: String,
        /// What there is.
        all: Vec<String>,
    },
    /// Columns have no names.
    #[error("has no header row, so no column `{0}`")]
    NoHeaderRow(String),
    /// Not separated values.
    #[error("is no CSV: {0}")]
    NoCsv(String),
}

impl Problem {
    /// What joins the name of the file and the sentence.
    fn joint(&self) -> &'static str {
        match self {
            Self::Unreadable(_)
            | Self::Empty
            | Self::Packed(_)
            | Self::Binary
            | Self::UnknownFormat
            | Self::Missing(_)
            | Self::UnknownComponent { .. }
            | Self::SeveralComponents(_)
            | Self::UnknownColumn { .. }
            | Self::NoHeaderRow(_)
            | Self::NoCsv(_) => " ",
            _ => ": ",
        }
    }

    fn help(&self) -> Option<String> {
        let names = |all: &[String]| {
            all.iter()
                .enumerate()
                .map(|(i, n)| format!("{} `{n}`", i + 1))
                .collect::<Vec<_>>()
                .join(", ")
        };
        Some(match self {
            Self::Packed(_) => "unpack it first".into(),
            Self::Binary => {
                "records are read as text: AT2, COSMOS, CSMIP, K-NET, ESM, or columns".into()
            }
            Self::UnknownFormat | Self::Missing(_) => format!(
                "the formats are {}; columns of numbers may have comments behind `#` and one header row",
                crate::Format::ALL.map(crate::Format::name).join(", ")
            ),
            Self::NoStep => "give the time step, or a column of times".into(),
            Self::NoUnit => {
                "give the unit, or state it in the file, as in `# unit: g` or a header \
                             `t [s], a [g]`"
                    .into()
            }
            Self::UnknownUnit(_) => {
                format!("known are {}", crate::unit::KNOWN.map(|(n, _)| n).join(", "))
            }
            Self::Counts => "give the unit as the acceleration of one count".into(),
            Self::UnitConflict { .. } | Self::StepConflict { .. } => {
                "leave it to the file, or correct the file".into()
            }
            Self::Uneven { .. } => "a record has even steps; a function `Table` takes any".into(),
            Self::Pairs => "take the corrected record (volume 2), which has even steps".into(),
            Self::Truncated { .. } | Self::TooMany { .. } => {
                "the file may be cut off or changed: fetch it again".into()
            }
            Self::DecimalComma(_) => {
                "numbers have a decimal point and no commas: `0.005`, not `0,005`".into()
            }
            Self::TooLong => "cut the record to its strong part, or take a longer time step".into(),
            Self::NotFinite(_) => "look at the values, their unit and the time step".into(),
            Self::Peak { .. } => {
                "unit or values are not what the header says: fetch the file again".into()
            }
            Self::UnknownComponent { all, .. } | Self::SeveralComponents(all) => {
                format!("name one, or give its number: {}", names(all))
            }
            Self::ShortRow { .. } => "columns count from 0".into(),
            Self::NoHeaderRow(_) => "give the position of the column, from 0".into(),
            _ => return None,
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn only_short_texts_are_quoted_and_without_control_characters() {
        assert_eq!(quoted("0.05x"), "`0.05x`");
        assert_eq!(quoted("a\u{1b}[1m"), "`a\\u{1b}[1m`");
        assert_eq!(quoted("root:x:0:0:root:/root:/bin/sh"), "a text of 29 characters");
    }
}
