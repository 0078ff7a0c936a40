//! A block of a model file as text, with the fields that the schema declares.

use super::{factor, text};
use crate::schema::{Block, Default, Field, Takes};
use trilith_element::{Dimension, Values};

/// `Name(field: value, …)` in the making. A field that the schema does not declare, or not so, is a fault of the program, and
/// so is a block without one that a file must give or that has a default.
pub(crate) struct BlockText {
    name: String,
    declared: Vec<Field>,
    fields: Vec<(String, String)>,
}

impl BlockText {
    /// A block of the schema.
    pub(super) fn new(block: &Block) -> Self {
        Self::of_kind(block.name).with(block.fields)
    }

    /// A kind with fields of its own.
    pub(super) fn of_kind(kind: &str) -> Self {
        Self { name: kind.into(), declared: Vec::new(), fields: Vec::new() }
    }

    /// The same with more fields.
    pub(super) fn with(mut self, fields: &[Field]) -> Self {
        self.declared.extend(fields);
        self
    }

    /// The same without a field that another one stands for.
    pub(super) fn without(mut self, key: &str) -> Self {
        self.declared.retain(|field| field.name != key);
        self
    }

    fn declared(&self, key: &str) -> Field {
        let found = self.declared.iter().find(|f| f.name == key);
        *found.unwrap_or_else(|| unreachable!("the schema declares `{key}` of `{}`", self.name))
    }

    /// Text of a field that the schema declares so.
    fn written(self, key: &'static str, is: fn(&Takes) -> bool, value: String) -> Self {
        if !is(&self.declared(key).takes) {
            unreachable!("the schema declares `{key}` of `{}` as something else", self.name);
        }
        self.value(key, value)
    }

    /// What is neither a number nor a name: lists, points, blocks.
    pub(super) fn value(mut self, key: &'static str, value: String) -> Self {
        self.declared(key);
        self.fields.push((key.into(), value));
        self
    }

    /// A number in SI.
    pub(crate) fn number(self, key: &'static str, x: f64) -> Self {
        self.written(key, |takes| matches!(takes, Takes::Number(..)), format!("{x:?}"))
    }

    /// A number where there is one.
    pub(crate) fn number_if(self, key: &'static str, x: Option<f64>) -> Self {
        match x {
            Some(x) => self.number(key, x),
            None => self,
        }
    }

    /// A whole number.
    pub(crate) fn count(self, key: &'static str, n: usize) -> Self {
        self.written(key, |takes| matches!(takes, Takes::Count(_)), n.to_string())
    }

    /// A whole number where there is one.
    pub(crate) fn count_if(self, key: &'static str, n: Option<usize>) -> Self {
        match n {
            Some(n) => self.count(key, n),
            None => self,
        }
    }

    /// True or false.
    pub(crate) fn flag(self, key: &'static str, is: bool) -> Self {
        self.written(key, |takes| matches!(takes, Takes::Flag), is.to_string())
    }

    /// One of the names of a field.
    pub(crate) fn choice(self, key: &'static str, name: &str) -> Self {
        let Takes::Choice(names) = self.declared(key).takes else {
            unreachable!("the schema declares `{key}` as a choice")
        };
        if !names.contains(&name) {
            unreachable!("the schema has no `{name}` for `{key}`");
        }
        self.value(key, name.into())
    }

    /// What has a name in the model.
    pub(super) fn named(self, key: &'static str, name: &str) -> Self {
        self.value(key, text(name))
    }

    /// A number with a unit where it has one.
    pub(super) fn quantity(self, key: &'static str, x: f64, dimension: Dimension) -> Self {
        self.written(key, |takes| matches!(takes, Takes::Quantity), factor(x, dimension))
    }

    /// Values one after the other.
    pub(super) fn list(self, key: &'static str, items: impl Iterator<Item = String>) -> Self {
        self.value(key, list(items))
    }

    /// The fields of a card.
    pub(super) fn values(mut self, values: &Values) -> Self {
        let own = values.0.iter().map(|(name, v)| (name.clone(), super::value(v)));
        self.fields.extend(own);
        self
    }

    /// The text.
    pub(super) fn end(self) -> String {
        for field in &self.declared {
            let is_there = self.fields.iter().any(|(key, _)| *key == field.name);
            if !is_there && !matches!(field.default, Default::Absent(_)) {
                unreachable!("`{}` of `{}` is written", field.name, self.name);
            }
        }
        let fields: Vec<_> = self.fields.iter().map(|(key, v)| format!("{key}: {v}")).collect();
        match (&*self.name, &*fields) {
            (name, []) if !name.is_empty() => name.into(),
            (name, fields) => format!("{name}({})", fields.join(", ")),
        }
    }
}

/// `[a, b]`.
pub(super) fn list(items: impl Iterator<Item = String>) -> String {
    format!("[{}]", items.collect::<Vec<_>>().join(", "))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::schema::{FIXED, RAYLEIGH, STEP};

    #[test]
    fn a_block_is_its_fields_in_the_order_in_which_they_came() {
        let text = BlockText::new(&RAYLEIGH).number("stiffness", 1e-3).number("mass", 0.0).end();
        assert_eq!(text, "Rayleigh(stiffness: 0.001, mass: 0.0)");
        let text = BlockText::new(&STEP).value("amplitude", "1.0".into()).number("start", 0.0);
        assert_eq!(text.number_if("end", None).end(), "Step(amplitude: 1.0, start: 0.0)");
    }

    /// A field that somebody adds to the schema alone is missed at once.
    #[test]
    #[should_panic(expected = "`stiffness` of `Rayleigh` is written")]
    fn a_field_with_a_default_cannot_be_left_out() {
        BlockText::new(&RAYLEIGH).number("mass", 0.0).end();
    }

    #[test]
    #[should_panic(expected = "the schema declares `substep` of `Fixed`")]
    fn a_field_that_the_schema_does_not_have_cannot_be_written() {
        let _ = BlockText::new(&FIXED).count("substep", 1);
    }

    #[test]
    #[should_panic(expected = "declares `substeps` of `Fixed` as something else")]
    fn a_field_cannot_be_written_as_what_it_is_not() {
        let _ = BlockText::new(&FIXED).number("substeps", 1.0);
    }
}
