//! Constraints.

use super::error::MOTIONS;
use super::{StructureError as Broken, full, rigid_motions};
use crate::{Constraint, Equation, Vector3};

/// Rounding, as a share of the sizes that add up.
const ROUNDING: f64 = 1e-12;

/// How a constraint is examined; see the [module](super::super).
#[derive(Clone, Debug)]
pub struct ConstraintKit {
    nodes: Vec<Vector3>,
    rotations: bool,
}

impl ConstraintKit {
    /// For a constraint of nodes at these positions, m.
    #[must_use]
    pub fn new(nodes: &[Vector3]) -> Self {
        Self { nodes: nodes.to_vec(), rotations: true }
    }

    /// It is about directions, wherever its nodes are: rotations need not satisfy it.
    #[must_use]
    pub fn only_translations(mut self) -> Self {
        self.rotations = false;
        self
    }

    /// Examines a constraint.
    ///
    /// # Errors
    /// The first property that does not hold, with its numbers.
    pub fn check(&self, constraint: &dyn Constraint) -> Result<(), Broken> {
        let nodes = &self.nodes[..];
        let own = constraint.equations(nodes)?;
        own.iter().try_for_each(|equation| equation.check(nodes.len()))?;
        if constraint.equations(nodes)? != own {
            return Err(Broken::Impure { what: "equations" });
        }
        for (i, equation) in own.iter().enumerate() {
            dependent(equation, &own[..i])?;
        }
        let motions = if self.rotations { 6 } else { 3 };
        for (motion, u) in MOTIONS.into_iter().zip(rigid_motions(nodes)).take(motions) {
            own.iter().try_for_each(|equation| rigid(equation, motion, &u))?;
        }
        let by = [3.0, -5.0, 7.0];
        let moved: Vec<Vector3> =
            nodes.iter().map(|x| std::array::from_fn(|i| x[i] + by[i])).collect();
        let there = constraint.equations(&moved)?;
        if there.len() != own.len() {
            return Err(Broken::Impure { what: "equations, in another place" });
        }
        own.iter().zip(&there).try_for_each(|(a, b)| same(a, b))
    }

    /// [`check`](Self::check) for tests.
    ///
    /// # Panics
    /// Where the constraint does not conform, with what is wrong.
    #[track_caller]
    pub fn assert(&self, constraint: &dyn Constraint) {
        if let Err(error) = self.check(constraint) {
            panic!("{constraint:?} does not conform: {error}");
        }
    }
}

fn dependent(equation: &Equation, before: &[Equation]) -> Result<(), Broken> {
    let Equation { dependent, terms } = equation;
    let why = if terms.iter().any(|(at, c)| at == dependent && *c != 0.0) {
        "goes by an equation that it is a term of itself"
    } else if before.iter().any(|e| e.dependent == *dependent) {
        "goes by two equations"
    } else {
        return Ok(());
    };
    let (node, direction) = (dependent.0 + 1, dependent.1.name());
    Err(Broken::Dependent { node, direction, why })
}

fn rigid(equation: &Equation, motion: &'static str, u: &[f64]) -> Result<(), Broken> {
    let Equation { dependent, terms } = equation;
    let parts = || terms.iter().map(|(at, c)| c * u[full(*at)]).chain([-u[full(*dependent)]]);
    let (value, size) = (parts().sum::<f64>(), parts().map(f64::abs).sum::<f64>());
    if value.abs() <= ROUNDING * size {
        return Ok(());
    }
    let (node, direction) = (dependent.0 + 1, dependent.1.name());
    Err(Broken::Rigid { motion, what: "an equation that it breaks", node, direction, value })
}

fn same(a: &Equation, b: &Equation) -> Result<(), Broken> {
    let places = |e: &Equation| e.terms.iter().map(|(at, _)| *at).collect::<Vec<_>>();
    if a.dependent != b.dependent || places(a) != places(b) {
        return Err(Broken::Impure { what: "equations, in another place" });
    }
    let place = |(node, dof): (usize, crate::Dof)| (node + 1, dof.name());
    for ((at, expected), (_, value)) in a.terms.iter().zip(&b.terms) {
        if (value - expected).abs() > ROUNDING * (10.0 + expected.abs()) {
            return Err(Broken::Place {
                how: "moved",
                what: "equation",
                row: place(a.dependent),
                column: place(*at),
                value: *value,
                expected: *expected,
            });
        }
    }
    Ok(())
}
