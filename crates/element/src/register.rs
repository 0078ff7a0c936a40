//! How a crate offers its kinds to an application.

use crate::{
    Card, Constraint, DerivedOutput, Described, Integrator, LinearElement, Link, ParameterError,
    Values, Waveform,
};
use std::sync::Arc;

/// Makes something from its parameters; it may hold what it needs for that, such as a table that was read once.
pub type Read<T> = Arc<dyn Fn(&Values) -> Result<Box<T>, ParameterError> + Send + Sync>;
/// Makes a linear element from its parameters.
pub type ReadLinear = Read<dyn LinearElement>;
/// Makes a constraint from its parameters.
pub type ReadConstraint = Read<dyn Constraint>;
/// Makes a link from its parameters.
pub type ReadLink = Read<dyn Link>;
/// Makes a function of time from its parameters.
pub type ReadFunction = Read<dyn Waveform>;
/// Makes an output from its parameters.
pub type ReadOutput = Read<dyn DerivedOutput>;
/// Makes a rule for time from its parameters.
pub type ReadSolver = Read<dyn Integrator>;

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
    /// Takes a function of time by its reader.
    fn add_function(&mut self, card: &'static Card, read: ReadFunction);
    /// Takes an output by its reader.
    fn add_output(&mut self, card: &'static Card, read: ReadOutput);
    /// Takes a rule for time by its reader.
    fn add_solver(&mut self, card: &'static Card, read: ReadSolver);

    /// Offers a linear element.
    fn linear<E: LinearElement + Described + 'static>(&mut self) {
        self.add_linear(const { &E::CARD }, Arc::new(|v| Ok(Box::new(checked::<E>(v)?))));
    }
    /// Offers a constraint.
    fn constraint<E: Constraint + Described + 'static>(&mut self) {
        self.add_constraint(const { &E::CARD }, Arc::new(|v| Ok(Box::new(checked::<E>(v)?))));
    }
    /// Offers a link.
    fn link<E: Link + Described + 'static>(&mut self) {
        self.add_link(const { &E::CARD }, Arc::new(|v| Ok(Box::new(checked::<E>(v)?))));
    }
    /// Offers a function of time. Its card takes no nodes.
    fn function<F: Waveform + Described + 'static>(&mut self) {
        self.add_function(const { &F::CARD }, Arc::new(|v| Ok(Box::new(checked::<F>(v)?))));
    }
    /// Offers an output. Its card takes no nodes: what it is made of stands in `of`.
    fn output<O: DerivedOutput + Described + 'static>(&mut self) {
        self.add_output(const { &O::CARD }, Arc::new(|v| Ok(Box::new(checked::<O>(v)?))));
    }
    /// Offers a rule for time as a solver. Its card takes no nodes.
    fn solver<I: Integrator + Described + 'static>(&mut self) {
        self.add_solver(const { &I::CARD }, Arc::new(|v| Ok(Box::new(checked::<I>(v)?))));
    }
}

fn checked<E: Described>(values: &Values) -> Result<E, ParameterError> {
    let it: E = values.read()?;
    it.check()?;
    Ok(it)
}
