//! The catalogue of kinds.

use crate::laws::{Law, Laws};
use crate::work;
use pyo3::prelude::*;
use trilith::Registry;
use trilith::catalogue::{law_facts, parameter};
use trilith::element::{Card, Category, Default, Form, Parameter};

/// A parameter: name, then symbol, unit, range, default and meaning as the catalogue writes them; what form it has; its
/// choices; whether a file must give it.
type ParameterFacts = ([String; 6], &'static str, Vec<&'static str>, bool);
/// A kind: name, category, summary; least and most nodes (none for any number); parameters; law, source, example; and for
/// links coordinates and history variables.
pub(crate) type CardFacts = (
    &'static str,
    &'static str,
    &'static str,
    (usize, Option<usize>),
    Vec<ParameterFacts>,
    [&'static str; 3],
    Option<[String; 2]>,
);

/// All kinds of elements, constraints and links, from their cards; and these laws.
#[pyfunction]
#[pyo3(signature = (laws))]
pub(crate) fn elements(py: Python<'_>, laws: Vec<Py<Law>>) -> PyResult<Vec<CardFacts>> {
    // Facts of laws in Python are asked of them: not while the lock is held by somebody who waits for them.
    work::run(py, move |_| {
        let registry = Laws::new(&laws)?.registry();
        Ok(registry.cards().map(|card| card_facts(&registry, card)).collect())
    })
}

/// A card, from a registry that has the kind.
pub(crate) fn card_facts(registry: &Registry, card: &'static Card) -> CardFacts {
    let category = match card.category {
        Category::Linear => "linear",
        Category::Constraint => "constraint",
        Category::Link => "link",
        Category::Function => "function",
        Category::Output => "output",
        Category::Solver => "solver",
    };
    let most = Some(card.nodes.max).filter(|most| *most < usize::MAX);
    (
        card.kind,
        category,
        card.summary,
        (card.nodes.min, most),
        card.parameters.iter().map(facts).collect(),
        [card.law, card.source, card.example],
        law_facts(registry, card),
    )
}

fn facts(p: &Parameter) -> ParameterFacts {
    let (form, choices): (_, &[&str]) = match p.form {
        Form::Number(_) | Form::Power { .. } | Form::OfAxis { list: false, .. } => ("number", &[]),
        Form::Choice(names) => ("choice", names),
        Form::Choices(names) => ("choices", names),
        Form::Flag => ("flag", &[]),
        Form::Numbers { .. } | Form::OfAxis { list: true, .. } => ("numbers", &[]),
        Form::Matrix { .. } => ("matrix", &[]),
        Form::Points => ("points", &[]),
        Form::Node => ("node", &[]),
        Form::Text => ("text", &[]),
        Form::File | Form::SparseMatrix => ("file", &[]),
        Form::Labels => ("labels", &[]),
    };
    let required = matches!(p.default, Default::Required);
    (parameter(p), form, choices.to_vec(), required)
}
