//! What can be wrong with the parameters of an element, a constraint or a link.

/// A parameter that cannot be right, told with its value and with what would be right.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum ParameterError {
    /// A value outside its range.
    #[error("`{name}` = {value} {unit}: must be {allowed}")]
    OutOfRange {
        /// Parameter name.
        name: String,
        /// The value given, in SI.
        value: f64,
        /// SI unit.
        unit: String,
        /// What would be right, such as `> 0`.
        allowed: String,
    },
    /// Parameters that contradict each other, or one that is missing beside another.
    #[error("{message}")]
    Inconsistent {
        /// The parameter to point at.
        name: String,
        /// What is wrong and what would be right.
        message: String,
    },
    /// A file that a parameter names and that does not hold what it should.
    #[error("`{name}`: {message}")]
    File {
        /// The parameter.
        name: String,
        /// What is wrong, with the name of the file and its line.
        message: String,
    },
    /// Nodes that the element cannot stand on (coincident, collinear with an axis …).
    #[error("{message}")]
    Geometry {
        /// What is wrong and what would be right.
        message: String,
    },
    /// A value of the wrong form.
    #[error("{message}")]
    Form {
        /// What is wrong and what would be right.
        message: String,
    },
}

impl ParameterError {
    /// The parameter the error is about, where it is about one.
    #[must_use]
    pub fn parameter(&self) -> Option<&str> {
        match self {
            Self::OutOfRange { name, .. }
            | Self::Inconsistent { name, .. }
            | Self::File { name, .. } => Some(name),
            _ => None,
        }
    }

    /// An [`Inconsistent`](Self::Inconsistent) error.
    pub fn inconsistent(name: &str, message: impl Into<String>) -> Self {
        Self::Inconsistent { name: name.to_owned(), message: message.into() }
    }

    /// A [`Geometry`](Self::Geometry) error.
    pub fn geometry(message: impl Into<String>) -> Self {
        Self::Geometry { message: message.into() }
    }
}

impl serde::de::Error for ParameterError {
    fn custom<T: std::fmt::Display>(message: T) -> Self {
        Self::Form { message: message.to_string() }
    }
}
