//! What answers for a law.

use std::fmt::Debug;
use trilith_element::{Kinematics, Response};

/// Why there is no answer.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum NoAnswer {
    /// The law holds no more there, in words of its own: shorter steps are tried.
    Refused(String),
    /// Something is wrong with it: the run ends with these words.
    Failed(String),
}

/// Lengths of the lists that a function sees.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Sizes {
    /// Parameters.
    pub parameters: usize,
    /// Coordinates n.
    pub coordinates: usize,
    /// History variables h.
    pub history: usize,
}

/// A law as the [`Link`](trilith_element::Link) that it becomes has it, with its parameters beside: numbers in SI, in the
/// order of the declaration. It is asked from several threads at once.
pub trait LawFunction: Send + Sync + Debug {
    /// Force and trial history; tangents and energies too where the declaration says that it gives them.
    ///
    /// # Errors
    /// [`NoAnswer`].
    fn respond(
        &self,
        parameters: &[f64],
        at: &Kinematics<'_>,
        committed: &[f64],
        trial: &mut [f64],
        out: &mut Response<'_>,
    ) -> Result<(), NoAnswer>;

    /// Force and trial history alone, for differences.
    ///
    /// # Errors
    /// [`NoAnswer`].
    fn force(
        &self,
        parameters: &[f64],
        at: &Kinematics<'_>,
        committed: &[f64],
        trial: &mut [f64],
        out: &mut Response<'_>,
    ) -> Result<(), NoAnswer> {
        self.respond(parameters, at, committed, trial, out)
    }

    /// Whether the parameters go together.
    ///
    /// # Errors
    /// What is wrong and what would be right.
    fn check(&self, _parameters: &[f64]) -> Result<(), String> {
        Ok(())
    }

    /// The stiffness where the law is engaged, row by row, zeros on entry; false where it does not say.
    ///
    /// # Errors
    /// What went wrong.
    fn engaged(&self, _parameters: &[f64], _k: &mut [f64]) -> Result<bool, String> {
        Ok(false)
    }

    /// The history before anything has happened; zeros on entry.
    ///
    /// # Errors
    /// What went wrong.
    fn at_rest(&self, _parameters: &[f64], _history: &mut [f64]) -> Result<(), String> {
        Ok(())
    }
}
