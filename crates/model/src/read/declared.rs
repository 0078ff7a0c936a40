//! Fields as the schema declares them: what a field takes, in which range, and what holds without it stand there alone.

use super::context::{Context, Fields};
use crate::expression::quantity;
use crate::named::Named;
use crate::schema::{Default, Field, Takes};
use crate::tree::Node;

impl<'n> Fields<'n> {
    fn declared(&self, key: &str) -> Field {
        let found = self.block.and_then(|block| block.fields.iter().find(|f| f.name == key));
        // Who asks for a field that the schema does not have learns it with the first file that is read.
        *found.unwrap_or_else(|| unreachable!("the schema declares `{key}`"))
    }

    /// The value of a field, or what stands for it; that a needed one is missing is reported.
    fn value<T>(
        &self,
        c: &Context<'_>,
        key: &str,
        read: impl FnOnce(&'n Node) -> Option<T>,
        plain: impl FnOnce(&'static str) -> Option<T>,
    ) -> Option<T> {
        match (self.get(key), self.declared(key).default) {
            (None, Default::Value(text)) => {
                Some(plain(text).unwrap_or_else(|| unreachable!("a default of `{key}`: {text}")))
            }
            (Some(node), _) => read(node),
            (None, _) => self.required(c, key).and_then(read),
        }
    }

    /// Nothing where the field is left out.
    fn given<T>(&self, key: &str, read: impl FnOnce() -> Option<T>) -> Option<Option<T>> {
        if self.get(key).is_some() { read().map(Some) } else { Some(None) }
    }

    /// A number in SI.
    ///
    /// # Panics
    /// Where the schema does not declare it so.
    #[must_use]
    pub fn number(&self, c: &Context<'_>, key: &str) -> Option<f64> {
        let Takes::Number(dimension, range) = self.declared(key).takes else {
            unreachable!("the schema declares `{key}` as a number")
        };
        let plain = |text: &str| quantity(text.trim_matches('"'), dimension).ok();
        self.value(c, key, |node| c.ranged(node, key, dimension, range), plain)
    }

    /// A number in SI where the file gives one.
    pub(crate) fn number_if(&self, c: &Context<'_>, key: &str) -> Option<Option<f64>> {
        self.given(key, || self.number(c, key))
    }

    /// A whole number.
    ///
    /// # Panics
    /// Where the schema does not declare it so.
    #[must_use]
    pub fn count(&self, c: &Context<'_>, key: &str) -> Option<usize> {
        let Takes::Count(least) = self.declared(key).takes else {
            unreachable!("the schema declares `{key}` as a count")
        };
        self.value(c, key, |node| c.count(node, key, least), |text| text.parse().ok())
    }

    /// A whole number where the file gives one.
    pub(crate) fn count_if(&self, c: &Context<'_>, key: &str) -> Option<Option<usize>> {
        self.given(key, || self.count(c, key))
    }

    /// True or false.
    ///
    /// # Panics
    /// Where the schema does not declare it so.
    #[must_use]
    pub fn flag(&self, c: &Context<'_>, key: &str) -> Option<bool> {
        self.value(c, key, |node| c.flag(node, key), |text| text.parse().ok())
    }

    /// What a field names; `what` says what its names are names of.
    pub(crate) fn named<T: Named>(&self, c: &Context<'_>, key: &str, what: &str) -> Option<T> {
        self.choice(c, key, what).map(|i| T::ALL[i])
    }

    /// Which of its names a field has; `what` says what they are names of.
    pub(crate) fn choice(&self, c: &Context<'_>, key: &str, what: &str) -> Option<usize> {
        let Takes::Choice(names) = self.declared(key).takes else {
            unreachable!("the schema declares `{key}` as a choice")
        };
        let plain = |text: &str| names.iter().position(|name| *name == text);
        self.value(c, key, |node| c.choice(node, what, names), plain)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::BasisKind;
    use crate::schema::{BASES, groups};

    /// What holds without a field can be read as the field would be.
    #[test]
    fn every_default_is_a_value_of_its_field() {
        let mut seen = 0;
        for field in groups().iter().flat_map(|g| g.blocks).flat_map(|b| b.fields) {
            let Default::Value(text) = field.default else { continue };
            seen += 1;
            let reads = match field.takes {
                Takes::Number(dimension, range) => {
                    let value = quantity(text.trim_matches('"'), dimension);
                    value.is_ok_and(|x| range.contains(x))
                }
                Takes::Count(least) => text.parse::<usize>().is_ok_and(|n| n >= least),
                Takes::Flag => text.parse::<bool>().is_ok(),
                Takes::Choice(names) => names.contains(&text),
                _ => true,
            };
            assert!(reads, "`{}`: {text}", field.name);
        }
        assert!(seen > 50, "{seen}");
    }

    /// Blocks that stand for the variants of an enum are in their order.
    #[test]
    fn blocks_have_the_names_of_what_they_stand_for() {
        assert_eq!(BASES.names(), BasisKind::NAMES);
    }
}
