//! What a model file may hold beside the parameters of elements.

use pyo3::prelude::*;
use trilith::model::schema::{
    Block, Default, ELEMENT, FORCE, Field, LINK, PLACE, REPETITION, Takes, groups,
};

/// A field: name, meaning, what it takes (a word, its choices, the group of blocks), default in words.
type FieldFacts =
    (&'static str, &'static str, (&'static str, Vec<&'static str>, Option<&'static str>), String);
/// A block: name (empty for none), meaning, example, fields.
type BlockFacts = (&'static str, &'static str, &'static str, Vec<FieldFacts>);

/// All groups of blocks, the model first; then what other places hold: `place`, `element` and `link` of elements, `force` of
/// loads, and what repeats.
#[pyfunction]
pub(crate) fn schema() -> Vec<(&'static str, &'static str, Vec<BlockFacts>)> {
    let facts =
        |b: &'static Block| (b.name, b.meaning, b.example, b.fields.iter().map(field).collect());
    let blocks = |all: &'static [&'static Block]| all.iter().map(|b| facts(b)).collect();
    let mut all: Vec<_> = groups().iter().map(|g| (g.name, g.meaning, blocks(g.blocks))).collect();
    all.push((REPETITION.name, REPETITION.meaning, blocks(REPETITION.blocks)));
    for (name, block) in
        [("place", &PLACE), ("element", &ELEMENT), ("link", &LINK), ("force", &FORCE)]
    {
        all.push((name, block.meaning, vec![facts(block)]));
    }
    all
}

fn field(f: &'static Field) -> FieldFacts {
    let none = Vec::new;
    let takes = match f.takes {
        Takes::Text => ("text", none(), None),
        Takes::Number(..) | Takes::Quantity => ("number", none(), None),
        Takes::Count(_) => ("count", none(), None),
        Takes::Flag => ("flag", none(), None),
        Takes::Choice(names) => ("choice", names.to_vec(), None),
        Takes::Name(_) => ("name", none(), None),
        Takes::One(g) => ("one", none(), Some(g.name)),
        Takes::List(g) => ("list", none(), Some(g.name)),
        Takes::Map(g) => ("map", none(), Some(g.name)),
        Takes::Words(_) => ("any", none(), None),
    };
    let default = match f.default {
        Default::Required => "required".to_owned(),
        Default::Absent("") => "none".to_owned(),
        Default::Absent(words) => words.to_owned(),
        Default::Value(ron) => format!("`{ron}`"),
    };
    (f.name, f.meaning, takes, default)
}
