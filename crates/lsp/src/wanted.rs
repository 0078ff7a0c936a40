//! What may stand at a place of a model file, from the schema and the cards.

use trilith::element::dimension as d;
use trilith::element::{Dimension, Form, Parameter};
use trilith::model::schema::{self, Field, Group, Takes};

/// What a value may be.
#[derive(Clone, Debug)]
pub(crate) enum Wanted {
    /// Nothing is known of it.
    Anything,
    /// A text in quotes.
    Text,
    /// `true` or `false`.
    Flag,
    /// One of these names.
    Choice(Vec<&'static str>),
    /// A number of one of these dimensions; of any where there is none.
    Number(Vec<Dimension>),
    /// The name of an entry of this section.
    Name(&'static str),
    /// What `elements` hold; false: what `properties` hold, without nodes.
    Kind(bool),
    /// A block of a group.
    Block(&'static Group),
    /// Members of a group: names, or patterns of names.
    Members,
    /// Names of a section with a factor each, or the names alone.
    Factors(&'static str),
    /// A list of these, or one of them alone.
    List(Box<Wanted>),
    /// A map to these; its keys may be names of a section.
    Map(Option<&'static str>, Box<Wanted>),
}

/// Sections that names lead to.
pub(crate) const SECTIONS: [&str; 9] = [
    "nodes",
    "elements",
    "properties",
    "functions",
    "loads",
    "cases",
    "combinations",
    "outputs",
    "parameters",
];
/// The section of groups, which stand for nodes and elements.
pub(crate) const GROUPS: &str = "groups";

impl Wanted {
    /// What one of a list may be, or what may stand there itself.
    pub fn single(self) -> Self {
        match self {
            Self::List(inner) => inner.single(),
            other => other,
        }
    }

    /// What a field of the schema takes.
    pub fn field(f: &Field) -> Self {
        match f.takes {
            Takes::Text => Self::Text,
            Takes::Number(dimension, _) => Self::Number(vec![dimension]),
            Takes::Quantity => Self::Number(Vec::new()),
            Takes::Count(_) => Self::Number(vec![d::NONE]),
            Takes::Flag => Self::Flag,
            Takes::Choice(names) => Self::Choice(names.to_vec()),
            Takes::Name(what) => section(what).map_or(Self::Anything, Self::Name),
            Takes::One(g) => Self::Block(g),
            Takes::List(g) => Self::List(Box::new(Self::Block(g))),
            Takes::Map(g) => Self::Map(None, Box::new(Self::Block(g))),
            Takes::Words(words) => Self::in_words(f.name, words).unwrap_or(Self::Anything),
        }
    }

    /// What a field takes that the schema tells in words; none where this is not known.
    pub fn in_words(field: &str, words: &str) -> Option<Self> {
        let map = |values| Self::Map(None, Box::new(values));
        Some(match field {
            "nodes" if words.starts_with("a map") => map(Self::Number(vec![d::LENGTH])),
            "nodes" => Self::Name("nodes"),
            "supports" => {
                let all = [&schema::SUPPORTS[..], &schema::DIRECTIONS].concat();
                Self::Map(Some("nodes"), Box::new(Self::Choice(all)))
            }
            "cases" => Self::Factors("combinations"),
            "elements" => map(Self::Kind(true)),
            "properties" => map(Self::Kind(false)),
            "groups" => map(Self::Members),
            "loads" => map(Self::List(Box::new(Self::Block(&schema::LOADINGS)))),
            "parameters" => map(Self::Number(Vec::new())),
            "use" => Self::Name("properties"),
            "of" if words.contains("nodes") => Self::Name("nodes"),
            "of" if words.contains("outputs") => Self::Name("outputs"),
            "forces" => Self::List(Box::new(Self::Choice(schema::FORCES.to_vec()))),
            "about" => Self::Number(vec![d::LENGTH]),
            "at"
            | "from"
            | "to"
            | "points"
            | "effective_stiffness"
            | "p_delta_at"
            | "axis1"
            | "axis2"
            | "displacement"
            | "velocity"
            | "trim"
            | "spectrum"
            | "damping" => Self::Number(Vec::new()),
            "include" | "of" | "when" | "file" | "time" | "value" | "variable" | "component"
            | "class" => Self::Anything,
            _ => return None,
        })
    }

    /// What a parameter of a card takes.
    pub fn parameter(p: &Parameter) -> Self {
        match p.form {
            Form::Number(dimension)
            | Form::Numbers { dimension, .. }
            | Form::Matrix { dimension, .. } => Self::Number(vec![dimension]),
            Form::Power { .. } => Self::Number(Vec::new()),
            Form::OfAxis { along, about, .. } => Self::Number(vec![along, about]),
            Form::Choice(names) => Self::Choice(names.to_vec()),
            Form::Choices(names) => Self::List(Box::new(Self::Choice(names.to_vec()))),
            Form::Flag => Self::Flag,
            Form::Points => Self::Number(vec![d::LENGTH]),
            Form::Node => Self::Name("nodes"),
            Form::Text | Form::File | Form::SparseMatrix => Self::Text,
            Form::Labels => Self::Anything,
        }
    }
}

/// The section with the entries of which the schema says "name of a …".
pub(crate) fn section(what: &str) -> Option<&'static str> {
    SECTIONS.into_iter().find(|s| s.strip_suffix('s') == Some(what))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_field_of_the_schema_is_understood() {
        let groups = schema::groups().into_iter().chain([&schema::REPETITION]);
        let blocks = groups.flat_map(|g| g.blocks.iter().copied());
        let beside = [&schema::PLACE, &schema::ELEMENT, &schema::LINK, &schema::MEMBER];
        let fields = blocks.chain(beside).flat_map(|b| b.fields).chain(&schema::DERIVED);
        let mut seen = 0;
        for f in fields {
            seen += 1;
            match f.takes {
                Takes::Words(words) => {
                    assert!(Wanted::in_words(f.name, words).is_some(), "{}: {words}", f.name);
                }
                Takes::Name(what) => assert!(section(what).is_some(), "{}: {what}", f.name),
                _ => {}
            }
        }
        assert!(seen > 200, "{seen}");
    }

    #[test]
    fn sections_are_those_of_a_model() {
        let names = schema::MODEL.blocks[0].names();
        assert!(SECTIONS.iter().chain([&GROUPS]).all(|s| names.contains(s)));
    }
}
