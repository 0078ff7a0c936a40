//! What is wrong with the matrices of an element, or the equations of a constraint.

use crate::definite::{NotDefinite, semi_definite, symmetric};
use crate::{Dof, ElementMatrices, Equation, Link, SquareMatrix};

/// Rounding that a matrix may show by a negative value: entries may come from a file with six digits.
const SLACK: f64 = 1e-6;

/// A row of a matrix, or a term of an equation: index into the nodes, and direction.
type Place = (usize, Dof);

/// Matrices or equations that cannot be those of an element or a constraint. Nodes are counted from 1 in the order of
/// the element.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum ElementFault {
    /// A matrix of another size than there are rows.
    #[error("{matrix} has {given} rows, and {rows} directions are listed")]
    Size {
        /// Such as `its stiffness`.
        matrix: &'static str,
        /// Rows of the matrix.
        given: usize,
        /// Directions listed.
        rows: usize,
    },
    /// A node that it does not have.
    #[error("it lists {} of its node {}, and it has {nodes}", .place.1.name(), .place.0 + 1)]
    Node {
        /// What is listed.
        place: Place,
        /// Number of its nodes.
        nodes: usize,
    },
    /// A direction listed twice.
    #[error("it lists {} of its node {} twice", .place.1.name(), .place.0 + 1)]
    Twice {
        /// What is listed.
        place: Place,
    },
    /// An entry that is no finite number.
    #[error("{matrix} is not finite: {value} in {}", entry(.row, .column))]
    NotFinite {
        /// Such as `its stiffness`.
        matrix: &'static str,
        /// Row.
        row: Place,
        /// Column.
        column: Place,
        /// The entry.
        value: f64,
    },
    /// Entries that mirror each other and differ.
    #[error(
        "{matrix} is not symmetric: {value:e} in {}, and {mirrored:e} where these change places; what is not symmetric is a link",
        entry(.row, .column)
    )]
    NotSymmetric {
        /// Such as `its stiffness`.
        matrix: &'static str,
        /// Row.
        row: Place,
        /// Column.
        column: Place,
        /// The entry.
        value: f64,
        /// The entry mirrored.
        mirrored: f64,
    },
    /// A diagonal entry that is negative, or zero beside others.
    #[error(
        "{matrix} is {value:e} on the diagonal in the direction of node {} {}: must be positive, or the whole row zero{}",
        .row.0 + 1, .row.1.name(), hint(.matrix)
    )]
    Diagonal {
        /// Such as `its stiffness`.
        matrix: &'static str,
        /// Row.
        row: Place,
        /// The entry.
        value: f64,
    },
    /// A motion of several directions with a negative energy.
    #[error(
        "{matrix} is not positive semi-definite: a motion of node {} {} and of directions listed before it has a negative energy{}",
        .row.0 + 1, .row.1.name(), hint(.matrix)
    )]
    Indefinite {
        /// Such as `its stiffness`.
        matrix: &'static str,
        /// The last of the directions.
        row: Place,
    },
    /// An engaged stiffness that cannot be one.
    #[error(
        "its engaged stiffness must be finite, symmetric and positive semi-definite: row {row} of its coordinates is not"
    )]
    Engaged {
        /// Row, from 1.
        row: usize,
    },
    /// A coefficient of an equation that is no finite number.
    #[error(
        "the coefficient of node {} {} in its equation for node {} {} is {value}",
        .term.0 + 1, .term.1.name(), .dependent.0 + 1, .dependent.1.name()
    )]
    Coefficient {
        /// The DOF that goes.
        dependent: Place,
        /// The DOF of the coefficient.
        term: Place,
        /// The coefficient.
        value: f64,
    },
}

fn entry((i, row): &Place, (j, column): &Place) -> String {
    format!("row node {} {}, column node {} {}", i + 1, row.name(), j + 1, column.name())
}

fn hint(matrix: &str) -> &'static str {
    if matrix == STIFFNESS {
        "; an element that is meant to soften says so (`LinearElement::softens`)"
    } else {
        ""
    }
}

const STIFFNESS: &str = "its stiffness";

impl ElementMatrices {
    /// Whether they can be those of an element with so many nodes: directions that exist, listed once, finite and
    /// symmetric entries; mass, damping and inertance positive semi-definite, and the stiffness unless it `softens`.
    ///
    /// # Errors
    /// The first [`ElementFault`].
    pub fn check(&self, nodes: usize, softens: bool) -> Result<(), ElementFault> {
        let Self { dofs, stiffness, mass, damping, inertance } = self;
        for (i, place) in dofs.iter().enumerate() {
            if place.0 >= nodes {
                return Err(ElementFault::Node { place: *place, nodes });
            }
            if dofs[..i].contains(place) {
                return Err(ElementFault::Twice { place: *place });
            }
        }
        let parts = [
            (STIFFNESS, stiffness, softens),
            ("its mass", mass, false),
            ("its damping", damping, false),
            ("its inertance", inertance, false),
        ];
        parts.into_iter().try_for_each(|(name, a, softens)| check_one(name, a, dofs, softens))
    }
}

fn check_one(
    matrix: &'static str,
    a: &SquareMatrix,
    dofs: &[Place],
    softens: bool,
) -> Result<(), ElementFault> {
    let (given, rows) = (a.size(), dofs.len());
    if given != rows {
        return Err(ElementFault::Size { matrix, given, rows });
    }
    if a.is_zero() {
        return Ok(());
    }
    let found = match softens {
        true => symmetric(a.values(), rows),
        false => semi_definite(a.values(), rows, SLACK),
    };
    found.map_err(|fault| match fault {
        NotDefinite::NotFinite { row, column, value } => {
            ElementFault::NotFinite { matrix, row: dofs[row], column: dofs[column], value }
        }
        NotDefinite::NotSymmetric { row, column, value, mirrored } => {
            let (row, column) = (dofs[row], dofs[column]);
            ElementFault::NotSymmetric { matrix, row, column, value, mirrored }
        }
        NotDefinite::Diagonal { row, value } => {
            ElementFault::Diagonal { matrix, row: dofs[row], value }
        }
        NotDefinite::Pivot { row } => ElementFault::Indefinite { matrix, row: dofs[row] },
    })
}

impl dyn Link {
    /// Whether its [engaged stiffness](Link::engaged_stiffness) is finite, symmetric and positive semi-definite.
    ///
    /// # Errors
    /// [`ElementFault::Engaged`].
    pub fn check_engaged(&self) -> Result<(), ElementFault> {
        let n = self.coordinates().len();
        let mut k = vec![0.0; n * n];
        self.engaged_stiffness(&mut k);
        semi_definite(&k, n, SLACK).map_err(|fault| match fault {
            NotDefinite::NotFinite { row, .. }
            | NotDefinite::NotSymmetric { row, .. }
            | NotDefinite::Diagonal { row, .. }
            | NotDefinite::Pivot { row } => ElementFault::Engaged { row: row + 1 },
        })
    }
}

impl Equation {
    /// Whether it can be an equation of a constraint with so many nodes: nodes that exist, finite coefficients.
    ///
    /// # Errors
    /// The first [`ElementFault`].
    pub fn check(&self, nodes: usize) -> Result<(), ElementFault> {
        let Self { dependent, terms } = self;
        let mut all = terms.iter().map(|(place, _)| place).chain([dependent]);
        if let Some(place) = all.find(|place| place.0 >= nodes) {
            return Err(ElementFault::Node { place: *place, nodes });
        }
        match terms.iter().find(|(_, value)| !value.is_finite()) {
            Some((term, value)) => {
                let (dependent, term, value) = (*dependent, *term, *value);
                Err(ElementFault::Coefficient { dependent, term, value })
            }
            None => Ok(()),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn rod() -> ElementMatrices {
        let mut m = ElementMatrices::zeros(vec![(0, Dof::Ux), (1, Dof::Ux)]);
        for i in 0..2 {
            for j in 0..2 {
                m.stiffness[(i, j)] = if i == j { 10.0 } else { -10.0 };
            }
            m.mass[(i, i)] = 2.0;
        }
        m
    }

    #[test]
    fn what_is_wrong_with_an_element_is_told_with_its_entry() {
        assert_eq!(rod().check(2, false), Ok(()));
        let told = |change: fn(&mut ElementMatrices)| {
            let mut m = rod();
            change(&mut m);
            m.check(2, false).expect_err("a fault").to_string()
        };
        assert_eq!(
            told(|m| m.stiffness[(1, 0)] = -9.0),
            "its stiffness is not symmetric: -9e0 in row node 2 Ux, column node 1 Ux, and -1e1 where these change places; what is not symmetric is a link"
        );
        assert_eq!(
            told(|m| m.mass[(1, 1)] = -2.0),
            "its mass is -2e0 on the diagonal in the direction of node 2 Ux: must be positive, or the whole row zero"
        );
        assert!(told(|m| m.stiffness[(0, 0)] = 9.0).contains("not positive semi-definite"));
        assert!(
            told(|m| m.damping[(0, 0)] = f64::NAN).starts_with("its damping is not finite: NaN")
        );
        assert_eq!(told(|m| m.dofs[1].0 = 2), "it lists Ux of its node 3, and it has 2");
        assert_eq!(told(|m| m.dofs[1].0 = 0), "it lists Ux of its node 1 twice");
        let size = told(|m| m.inertance = SquareMatrix::zeros(3));
        assert_eq!(size, "its inertance has 3 rows, and 2 directions are listed");
    }

    #[test]
    fn an_element_may_soften_if_it_says_so() {
        let mut m = rod();
        m.stiffness[(0, 0)] = -10.0;
        assert!(m.check(2, false).is_err());
        assert_eq!(m.check(2, true), Ok(()));
    }

    #[test]
    fn coefficients_and_nodes_of_an_equation_are_looked_at() {
        let equation = |node, value| Equation {
            dependent: (1, Dof::Uz),
            terms: vec![((0, Dof::Uz), 1.0), ((node, Dof::Ry), value)],
        };
        assert_eq!(equation(0, -2.0).check(2), Ok(()));
        let told = |e: Equation| e.check(2).expect_err("a fault").to_string();
        assert_eq!(told(equation(4, 1.0)), "it lists Ry of its node 5, and it has 2");
        assert_eq!(
            told(equation(0, f64::NAN)),
            "the coefficient of node 1 Ry in its equation for node 2 Uz is NaN"
        );
    }
}
