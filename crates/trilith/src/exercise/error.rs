//! Why a link cannot be exercised.

use crate::element::Category;
use crate::model::Diagnostic;

/// Why a link cannot be exercised.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum ExerciseError {
    /// There is no kind of that name.
    #[error("there is no kind `{0}`")]
    UnknownKind(String),
    /// The kind has no law.
    #[error("{kind} is {}: only links can be exercised", article(.category))]
    NotALink {
        /// The kind.
        kind: &'static str,
        /// What it is.
        category: Category,
    },
    /// The parameters are refused, as they would be in a model file.
    #[error("{}", .0.iter().map(ToString::to_string).collect::<Vec<_>>().join("\n"))]
    Parameters(Vec<Diagnostic>),
    /// The motion of the card does not fit the coordinates that the parameters give the law.
    #[error(
        "the card of {kind} has an exercise for {strokes} coordinates, and this law has {}: {}",
        .coordinates.len(), .coordinates.join(", ")
    )]
    NoStrokes {
        /// The kind.
        kind: &'static str,
        /// Strokes of its card.
        strokes: usize,
        /// Coordinates of the law.
        coordinates: Vec<String>,
    },
    /// The law has no answer, and says why.
    #[error("the law has no answer at t = {time} s: {why}")]
    Refuses {
        /// When, s.
        time: f64,
        /// Its own words.
        why: String,
    },
    /// The law gives something that is not finite.
    #[error("the law gives a force or energy that is not finite at t = {0} s")]
    NotFinite(f64),
}

fn article(category: &Category) -> &'static str {
    match category {
        Category::Linear => "a linear element",
        Category::Constraint => "a constraint",
        Category::Link => "a link",
        Category::Function => "a function of time",
        Category::Output => "an output",
        Category::Solver => "a solver",
    }
}
