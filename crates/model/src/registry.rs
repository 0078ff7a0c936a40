//! The kinds that an application offers to model files.

use crate::schema;
use trilith_element::{
    Card, Category, ReadConstraint, ReadFunction, ReadLinear, ReadLink, ReadOutput, ReadSolver,
    Register,
};

/// How to make a member of a kind.
#[derive(Clone)]
pub(crate) enum Reader {
    Linear(ReadLinear),
    Constraint(ReadConstraint),
    Link(ReadLink),
    Function(ReadFunction),
    Output(ReadOutput),
    Solver(ReadSolver),
}

impl std::fmt::Debug for Reader {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.write_str(match self {
            Self::Linear(_) => "Linear",
            Self::Constraint(_) => "Constraint",
            Self::Link(_) => "Link",
            Self::Function(_) => "Function",
            Self::Output(_) => "Output",
            Self::Solver(_) => "Solver",
        })
    }
}

/// The kinds of elements, constraints, links, functions of time, outputs and solvers by name, in the order in which they
/// came.
///
/// A name that comes a second time does not replace the first; it is kept in
/// [`duplicates`](Self::duplicates), and no model is read with such a registry.
#[derive(Clone, Debug, Default)]
pub struct Registry {
    kinds: Vec<(&'static Card, Reader)>,
    duplicates: Vec<&'static str>,
}

impl Registry {
    /// An empty registry.
    #[must_use]
    pub fn new() -> Self {
        Self::default()
    }

    /// The cards, in the order of registration.
    pub fn cards(&self) -> impl Iterator<Item = &'static Card> + Clone + '_ {
        self.kinds.iter().map(|(card, _)| *card)
    }

    /// The cards of what may stand in `elements`.
    pub fn elements(&self) -> impl Iterator<Item = &'static Card> + Clone + '_ {
        let built = [Category::Linear, Category::Constraint, Category::Link];
        self.cards().filter(move |card| built.contains(&card.category))
    }

    /// The cards of functions of time, beside the built-in ones.
    pub fn functions(&self) -> impl Iterator<Item = &'static Card> + Clone + '_ {
        self.cards().filter(|card| card.category == Category::Function)
    }

    /// The cards of outputs, beside the built-in ones.
    pub fn outputs(&self) -> impl Iterator<Item = &'static Card> + Clone + '_ {
        self.cards().filter(|card| card.category == Category::Output)
    }

    /// The cards of solvers, beside the built-in ones.
    pub fn solvers(&self) -> impl Iterator<Item = &'static Card> + Clone + '_ {
        self.cards().filter(|card| card.category == Category::Solver)
    }

    /// The card of a kind.
    #[must_use]
    pub fn card(&self, kind: &str) -> Option<&'static Card> {
        self.cards().find(|card| card.kind == kind)
    }

    /// Names that were registered more than once, or that a built-in function of time, output or solver has.
    #[must_use]
    pub fn duplicates(&self) -> &[&'static str] {
        &self.duplicates
    }

    pub(crate) fn find(&self, kind: &str) -> Option<(&'static Card, &Reader)> {
        self.kinds.iter().find(|(card, _)| card.kind == kind).map(|(card, read)| (*card, read))
    }

    fn add(&mut self, card: &'static Card, reader: Reader) {
        let built_in = match card.category {
            Category::Function => schema::FUNCTIONS.names(),
            Category::Output => schema::OUTPUTS.names(),
            Category::Solver => schema::SOLVERS.to_vec(),
            _ => Vec::new(),
        };
        if built_in.contains(&card.kind) || self.card(card.kind).is_some() {
            self.duplicates.push(card.kind);
        } else {
            self.kinds.push((card, reader));
        }
    }
}

impl Register for Registry {
    fn add_linear(&mut self, card: &'static Card, read: ReadLinear) {
        self.add(card, Reader::Linear(read));
    }
    fn add_constraint(&mut self, card: &'static Card, read: ReadConstraint) {
        self.add(card, Reader::Constraint(read));
    }
    fn add_link(&mut self, card: &'static Card, read: ReadLink) {
        self.add(card, Reader::Link(read));
    }
    fn add_function(&mut self, card: &'static Card, read: ReadFunction) {
        self.add(card, Reader::Function(read));
    }
    fn add_output(&mut self, card: &'static Card, read: ReadOutput) {
        self.add(card, Reader::Output(read));
    }
    fn add_solver(&mut self, card: &'static Card, read: ReadSolver) {
        self.add(card, Reader::Solver(read));
    }
}
