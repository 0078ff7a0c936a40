//! The solvers, built in and from other crates.

use crate::{Analysis, Model};
use std::sync::Arc;
use trilith_element::{Card, Integrator, Values};

/// The solvers.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum SolverKind {
    /// Ritz basis, modal recurrences exact for loads linear in the step.
    Fna,
    /// All DOFs, HHT-α.
    Hht,
    /// Ritz basis, HHT-α.
    RitzHht,
    /// All DOFs, HHT-α with the tangent assembled and factorised in every iteration.
    FullNewton,
    /// A rule for time from another crate.
    Custom {
        /// The name of its kind.
        name: &'static str,
        /// True where it works on a basis, not on all DOFs.
        reduced: bool,
        /// Index among the [`solvers`](crate::Model::solvers) of the model.
        at: usize,
    },
}

impl SolverKind {
    /// All that are built in, in order.
    pub const ALL: [Self; 4] = [Self::Fna, Self::Hht, Self::RitzHht, Self::FullNewton];

    /// Name on the command line and in results; that of the kind where another crate offers it.
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            Self::Fna => "fna",
            Self::Hht => "hht",
            Self::RitzHht => "ritz-hht",
            Self::FullNewton => "full-newton",
            Self::Custom { name, .. } => name,
        }
    }

    /// Whether it works on a basis, not on all DOFs.
    #[must_use]
    pub const fn is_reduced(self) -> bool {
        matches!(self, Self::Fna | Self::RitzHht | Self::Custom { reduced: true, .. })
    }
}

/// A solver of another crate, with its parameters.
#[derive(Clone, Debug)]
pub struct CustomSolver {
    /// Its card.
    pub card: &'static Card,
    /// The parameters it was made from.
    pub values: Arc<Values>,
    /// The rule for time.
    pub integrator: Arc<dyn Integrator>,
}

impl CustomSolver {
    /// Its kind, as the entry at this index of the solvers of a model.
    #[must_use]
    pub fn kind(&self, at: usize) -> SolverKind {
        SolverKind::Custom { name: self.card.kind, reduced: self.integrator.on_basis(), at }
    }
}

impl Model {
    /// The solver of this name that a case (an index) can be run with: its own, one that is built in, or another of the
    /// registry that the model was read with.
    #[must_use]
    pub fn solver(&self, name: &str, case: usize) -> Option<SolverKind> {
        let own = match self.cases.get(case).map(|case| &case.analysis) {
            Some(Analysis::Dynamic(dynamic)) => Some(dynamic.solution.solver),
            _ => None,
        };
        let built_in = || SolverKind::ALL.into_iter().find(|kind| kind.name() == name);
        let other = || self.solvers.iter().position(|solver| solver.card.kind == name);
        own.filter(|kind| kind.name() == name)
            .or_else(built_in)
            .or_else(|| other().map(|at| self.solvers[at].kind(at)))
    }

    /// The names of all solvers that its cases can be run with.
    #[must_use]
    pub fn solver_names(&self) -> Vec<&'static str> {
        let mut names: Vec<&str> = SolverKind::ALL.map(SolverKind::name).to_vec();
        for solver in &self.solvers {
            if !names.contains(&solver.card.kind) {
                names.push(solver.card.kind);
            }
        }
        names
    }
}
