//! What is wrong with a model.

use crate::Span;

/// Something that cannot be in a [`Model`](crate::Model), wherever it was made.
#[derive(Clone, Debug, PartialEq)]
pub struct ModelError {
    /// What it is in, such as `case "shake"`.
    pub place: String,
    /// What is wrong there.
    pub fault: ModelFault,
    /// Where the file defines that; empty where no file does.
    pub span: Span,
}

impl std::fmt::Display for ModelError {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        write!(f, "{}: {}", self.place, self.fault)
    }
}

impl std::error::Error for ModelError {}

/// What is wrong with a part of a model.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum ModelFault {
    /// An index beyond the end.
    #[error("{what} {index} does not exist: {}", there_are(.count))]
    Index {
        /// What is counted, such as `node`.
        what: &'static str,
        /// The index.
        index: usize,
        /// How many there are.
        count: usize,
    },
    /// A number that cannot be.
    #[error("`{name}` = {value}: must be {allowed}")]
    Number {
        /// What it is.
        name: &'static str,
        /// The number, in SI.
        value: f64,
        /// What would be right.
        allowed: String,
    },
    /// Numbers that are too few or too many.
    #[error("`{name}` has {given} numbers: must be {wanted}")]
    Count {
        /// What it is.
        name: &'static str,
        /// How many there are.
        given: usize,
        /// What would be right.
        wanted: String,
    },
    /// A name that stands twice.
    #[error("there is another one of this name")]
    Twice,
    /// Nothing may have no name.
    #[error("it has no name")]
    NoName,
    /// A case that continues itself or one behind it.
    #[error("it continues case \"{after}\", which does not stand before it")]
    After {
        /// Name of the case that is continued.
        after: String,
    },
    /// Something that does not suit what it stands beside.
    #[error("{0}")]
    Unsuitable(String),
}

fn there_are(count: &usize) -> String {
    match count {
        0 => "there is none".into(),
        1 => "there is one, with index 0".into(),
        n => format!("there are {n}, with indices 0 to {}", n - 1),
    }
}
