//! How a crate offers its kinds to an application.

use crate::{Card, Constraint, Described, LinearElement, Link, ParameterError, Values};

/// Makes a linear element from its parameters.
pub type ReadLinear = fn(&Values) -> Result<Box<dyn LinearElement>, ParameterError>;
/// Makes a constraint from its parameters.
pub type ReadConstraint = fn(&Values) -> Result<Box<dyn Constraint>, ParameterError>;
/// Makes a link from its parameters.
pub type ReadLink = fn(&Values) -> Result<Box<dyn Link>, ParameterError>;

/// The face of a registry that a crate of elements sees.
///
/// ```ignore
/// pub fn register(to: &mut impl Register) {
///     to.link::<Gap>();
/// }
/// ```
pub trait Register {
    /// Takes a linear element by its reader.
    fn add_linear(&mut self, card: &'static Card, read: ReadLinear);
    /// Takes a constraint by its reader.
    fn add_constraint(&mut self, card: &'static Card, read: ReadConstraint);
    /// Takes a link by its reader.
    fn add_link(&mut self, card: &'static Card, read: ReadLink);

    /// Offers a linear element.
    fn linear<E: LinearElement + Described + 'static>(&mut self) {
        self.add_linear(const { &E::CARD }, |v| Ok(Box::new(checked::<E>(v)?)));
    }
    /// Offers a constraint.
    fn constraint<E: Constraint + Described + 'static>(&mut self) {
        self.add_constraint(const { &E::CARD }, |v| Ok(Box::new(checked::<E>(v)?)));
    }
    /// Offers a link.
    fn link<E: Link + Described + 'static>(&mut self) {
        self.add_link(const { &E::CARD }, |v| Ok(Box::new(checked::<E>(v)?)));
    }
}

fn checked<E: Described>(values: &Values) -> Result<E, ParameterError> {
    let it: E = values.read()?;
    it.check()?;
    Ok(it)
}
