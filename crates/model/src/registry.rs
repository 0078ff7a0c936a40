//! The kinds that an application offers to model files.

use trilith_element::Register;
use trilith_element::{Card, Constraint, LinearElement, Link, ParameterError, Values};

/// How to make a member of a kind.
#[derive(Clone, Copy, Debug)]
pub(crate) enum Reader {
    Linear(fn(&Values) -> Result<Box<dyn LinearElement>, ParameterError>),
    Constraint(fn(&Values) -> Result<Box<dyn Constraint>, ParameterError>),
    Link(fn(&Values) -> Result<Box<dyn Link>, ParameterError>),
}

/// The kinds of elements, constraints and links by name, in the order in which they came.
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

    /// The card of a kind.
    #[must_use]
    pub fn card(&self, kind: &str) -> Option<&'static Card> {
        self.find(kind).map(|(card, _)| card)
    }

    /// Names that were registered more than once.
    #[must_use]
    pub fn duplicates(&self) -> &[&'static str] {
        &self.duplicates
    }

    pub(crate) fn find(&self, kind: &str) -> Option<(&'static Card, Reader)> {
        self.kinds.iter().find(|(card, _)| card.kind == kind).copied()
    }

    fn add(&mut self, card: &'static Card, reader: Reader) {
        if self.card(card.kind).is_some() {
            self.duplicates.push(card.kind);
        } else {
            self.kinds.push((card, reader));
        }
    }
}

impl Register for Registry {
    fn add_linear(
        &mut self,
        card: &'static Card,
        read: fn(&Values) -> Result<Box<dyn LinearElement>, ParameterError>,
    ) {
        self.add(card, Reader::Linear(read));
    }
    fn add_constraint(
        &mut self,
        card: &'static Card,
        read: fn(&Values) -> Result<Box<dyn Constraint>, ParameterError>,
    ) {
        self.add(card, Reader::Constraint(read));
    }
    fn add_link(
        &mut self,
        card: &'static Card,
        read: fn(&Values) -> Result<Box<dyn Link>, ParameterError>,
    ) {
        self.add(card, Reader::Link(read));
    }
}
