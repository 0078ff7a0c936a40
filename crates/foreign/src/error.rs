//! What can be wrong with a law that is made at run time.

use std::path::PathBuf;

/// A declaration that cannot be that of a law.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum DeclarationError {
    /// The name of the kind is none that a model file could write.
    #[error("`{name}` is no name of a kind: a capital letter, then letters, digits and _")]
    Kind {
        /// The name.
        name: String,
    },
    /// The name of the kind is a word that model files use for something else.
    #[error("`{name}` is a word of model files: a kind needs another name")]
    Reserved {
        /// The name.
        name: String,
    },
    /// A parameter or a history variable with a name that is none.
    #[error(
        "{kind}: `{name}` is no name of a {what}: letters, digits and _, not beginning with a digit"
    )]
    Name {
        /// The kind.
        kind: String,
        /// `parameter` or `history variable`.
        what: &'static str,
        /// The name.
        name: String,
    },
    /// A name that comes twice.
    #[error("{kind}: the {what} `{name}` is there twice")]
    Twice {
        /// The kind.
        kind: String,
        /// `parameter`, `history variable` or `axis`.
        what: &'static str,
        /// The name.
        name: String,
    },
    /// A parameter with the name of a field that every link has.
    #[error(
        "{kind}: a parameter must not be called `{name}`, which every link takes beside its parameters"
    )]
    Taken {
        /// The kind.
        kind: String,
        /// The name.
        name: String,
    },
    /// A unit that is none, or not of SI.
    #[error(
        "{kind}: the unit `{unit}` of `{name}` is none of SI: such as N/m, N*s/m, m, rad or 1; in a law everything is in SI"
    )]
    Unit {
        /// The kind.
        kind: String,
        /// Parameter or history variable.
        name: String,
        /// The unit.
        unit: String,
    },
    /// A default or an example that is no value of its parameter.
    #[error("{kind}: the value {value} of `{name}`: {why}")]
    Value {
        /// The kind.
        kind: String,
        /// The parameter.
        name: String,
        /// The value.
        value: String,
        /// What is wrong.
        why: String,
    },
    /// A range whose bounds are none.
    #[error("{kind}: the range of `{name}` goes from {low} to {high}")]
    Range {
        /// The kind.
        kind: String,
        /// The parameter.
        name: String,
        /// Lower bound.
        low: String,
        /// Upper bound.
        high: String,
    },
    /// A coordinate that is no local axis, or none at all.
    #[error("{kind}: its coordinates `{axes}` must be one or more of U1, U2, U3, R1, R2, R3")]
    Axes {
        /// The kind.
        kind: String,
        /// What is declared.
        axes: String,
    },
    /// More history variables than a law may have.
    #[error("{kind}: {count} history variables, and {most} are the most")]
    History {
        /// The kind.
        kind: String,
        /// How many.
        count: usize,
        /// How many there may be.
        most: usize,
    },
    /// Amplitudes that do not fit the coordinates, or are no sizes.
    #[error(
        "{kind}: its amplitudes must be {count} positive numbers, one for each coordinate, and its frequency positive"
    )]
    Amplitude {
        /// The kind.
        kind: String,
        /// Number of coordinates.
        count: usize,
    },
}

/// A library whose laws cannot be taken.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum ForeignError {
    /// It cannot be opened.
    #[error("the library {} cannot be opened: {why}", .path.display())]
    Open {
        /// Its path.
        path: PathBuf,
        /// What the system says.
        why: String,
    },
    /// It is no library of laws.
    #[error("the library {} has no laws: it does not export `trilith_law_at` of trilith_link.h", .path.display())]
    NoLaws {
        /// Its path.
        path: PathBuf,
    },
    /// One of its tables cannot be that of a law.
    #[error("law {index} of the library {}: {why}", .path.display())]
    Table {
        /// Its path.
        path: PathBuf,
        /// Which one, from 0.
        index: usize,
        /// What is wrong.
        why: String,
    },
    /// One of its laws is declared in a way that cannot be.
    #[error("the library {}: {error}", .path.display())]
    Declaration {
        /// Its path.
        path: PathBuf,
        /// What is wrong.
        error: Box<DeclarationError>,
    },
}
