//! `For(i: "0 to 4", k: ["a", "b"], when: "i != 2", of: …)`.

use super::{Expanded, Expander, Here};
use crate::expression::evaluate;
use crate::places::{Listed, Values};
use crate::schema;
use crate::tree::{Entry, Kind, Node};
use crate::{Span, units};
use std::sync::Arc;

/// Indices at one place.
const MOST_INDICES: usize = 8;
/// Largest value of an index.
const LARGEST: f64 = 1e15;
const FORMS: &str = "write `\"0 to 4\"` (both ends included), a list such as `[\"a\", \"b\"]`, or a map such as \
                     `{\"a\": \"0 m\", \"b\": \"6 m\"}` or `{\"a\": (x: \"0 m\", y: 0)}`";

/// A repetition whose fields are known.
pub(super) struct Repetition<'n> {
    indices: Vec<(Arc<str>, &'n Entry)>,
    when: Option<(&'n Node, &'n str)>,
    /// What is repeated.
    pub of: &'n Node,
}

impl Repetition<'_> {
    pub const NAME: &'static str = schema::REPETITION.blocks[0].name;
}

impl Expander<'_, '_> {
    /// The repetition that a value is; none where it is none.
    pub(super) fn repetition<'n>(
        &mut self,
        node: &'n Node,
        here: Here,
    ) -> Expanded<Option<Repetition<'n>>> {
        if node.name() != Some(Repetition::NAME) {
            return Ok(None);
        }
        let whole = here.span(&node.name_span());
        let Kind::Fields(_, entries) = &node.kind else {
            let message = "a repetition has named fields".to_owned();
            return self.refuse("E0105", message, &example(), whole);
        };
        let (mut indices, mut when, mut of) = (Vec::new(), None, None);
        for e in entries {
            match (e.key.as_str(), &e.value.kind) {
                ("of", _) => of = Some(&e.value),
                ("when", Kind::Text(text)) => when = Some((&e.value, text.as_str())),
                ("when", _) => {
                    let message = format!("`when` is {}: must be a text", e.value.describe());
                    let help = "write a condition in quotes, such as `\"i != k\"`";
                    return self.refuse("E0105", message, help, here.span(&e.value.span));
                }
                (name, _) => {
                    self.check_name(e, here)?;
                    indices.push((Arc::from(name), e));
                }
            }
        }
        let Some(of) = of else {
            let message = "a repetition has no `of`".to_owned();
            let help = format!("`of` is what is repeated: {}", example());
            return self.refuse("E0104", message, &help, whole);
        };
        if indices.is_empty() {
            let message = "a repetition has no index".to_owned();
            return self.refuse("E0104", message, &example(), whole);
        }
        if self.places.indices(here.to).len() + indices.len() > MOST_INDICES {
            let message = format!("more than {MOST_INDICES} indices at one place");
            return self.refuse("E0112", message, "use fewer", whole);
        }
        Ok(Some(Repetition { indices, when, of }))
    }

    /// An index hides nothing: no parameter, no unit, no index around it.
    fn check_name(&mut self, e: &Entry, here: Here) -> Expanded<()> {
        let (name, at) = (&e.key, here.span(&e.key_span));
        let mut letters = name.chars();
        let good = letters.next().is_some_and(|c| c.is_alphabetic() || c == '_')
            && letters.all(|c| c.is_alphanumeric() || c == '_');
        let taken = if !good {
            "letters, digits and `_`, beginning with a letter, name an index".to_owned()
        } else if self.c.parameters().text(name).is_some()
            || crate::expression::Scope::has(self.c.parameters(), name)
        {
            "it is a parameter of the model".to_owned()
        } else if self.places.indices(at.start).contains(&name.as_str()) {
            "it is an index of the repetition around this one".to_owned()
        } else if let Some(unit) = units::find(name) {
            format!("it is a unit of {}: `2 {name}` would not be `2*{name}`", unit.dimension.unit())
        } else if name == "pi" {
            "it is the number π".to_owned()
        } else {
            return Ok(());
        };
        let message = format!("`{name}` cannot name an index: {taken}");
        self.refuse("E0105", message, "choose another name", at)
    }

    /// Does something for all values of the indices. `text`: what is repeated as it stands, which begins where `here`
    /// counts from or later.
    pub(super) fn repeat(
        &mut self,
        of: &Repetition<'_>,
        text: &Span,
        here: Here,
        each: &mut dyn FnMut(&mut Self, Here) -> Expanded<()>,
    ) -> Expanded<()> {
        self.over(of, 0, text, here, each)
    }

    fn over(
        &mut self,
        of: &Repetition<'_>,
        depth: usize,
        text: &Span,
        here: Here,
        each: &mut dyn FnMut(&mut Self, Here) -> Expanded<()>,
    ) -> Expanded<()> {
        let Some((name, e)) = of.indices.get(depth) else {
            return match of.when {
                Some((node, when)) if !self.holds(when, &here.span(&node.span))? => Ok(()),
                _ => each(self, here),
            };
        };
        // Values of the index before may have brought further names.
        self.check_name(e, here)?;
        let values = self.range(e, here)?;
        let at = here.span(&e.value.span);
        // Before any of it is made.
        self.spend_entries(values.count(), &at)?;
        let Some((start, length)) = self.places.repeat(here.span(text), name, &values) else {
            return self.too_much(super::MOST_VALUES, "values", &at);
        };
        for n in 0..values.count() {
            let here = Here { from: text.start, to: start + n * length };
            self.over(of, depth + 1, text, here, each)?;
        }
        Ok(())
    }

    /// What an index runs through.
    fn range(&mut self, index: &Entry, here: Here) -> Expanded<Values> {
        let (name, node) = (&index.key, &index.value);
        let span = here.span(&node.span);
        let mut names: Vec<String> = Vec::new();
        let listed: Vec<Listed> = match &node.kind {
            Kind::Text(text) => return self.whole(name, text, &span),
            Kind::List(None, items) => {
                items.iter().map(|n| self.listed(name, n, here)).collect::<Expanded<_>>()?
            }
            Kind::Map(entries) => {
                if let Some(Entry {
                    value: Node { kind: Kind::Fields(None, fields), .. }, ..
                }) = entries.first()
                {
                    for e in fields {
                        self.check_name(e, here)?;
                        if e.key == *name {
                            let message = format!("`{name}` is the index itself");
                            let at = here.span(&e.key_span);
                            return self.refuse("E0105", message, "choose another name", at);
                        }
                    }
                    names = fields.iter().map(|e| e.key.clone()).collect();
                }
                let one = |e: &Entry| {
                    let key = self.fill(&e.key, &here.span(&e.key_span))?;
                    self.row(name, key, &e.value, &names, here)
                };
                entries.iter().map(one).collect::<Expanded<_>>()?
            }
            Kind::Fields(None, entries) if entries.is_empty() => Vec::new(),
            _ => {
                let message = format!("the index `{name}` runs through {}", node.describe());
                return self.refuse("E0105", message, FORMS, span);
            }
        };
        if listed.is_empty() {
            let message = format!("the index `{name}` runs through nothing");
            return self.refuse("E0104", message, FORMS, span);
        }
        Ok(Values::Listed(listed.into(), names.into()))
    }

    /// A value with a name of its own, or several with the same names as those of the first.
    fn row(
        &mut self,
        index: &str,
        key: String,
        value: &Node,
        names: &[String],
        here: Here,
    ) -> Expanded<Listed> {
        let Kind::Fields(None, fields) = &value.kind else {
            if names.is_empty() {
                return Ok(Listed { name: key, ..self.listed(index, value, here)? });
            }
            return self.uneven(&key, names, value, here);
        };
        if !fields.iter().map(|e| &e.key).eq(names) {
            return self.uneven(&key, names, value, here);
        }
        let more = fields.iter().map(|e| self.listed(&e.key, &e.value, here));
        Ok(Listed { name: key, number: None, more: more.collect::<Expanded<_>>()? })
    }

    fn uneven<T>(&mut self, key: &str, names: &[String], value: &Node, here: Here) -> Expanded<T> {
        let message = format!("`{key}` has other names than the first of these values");
        let help = match names.is_empty() {
            true => "give a number or a text, as the first does".to_owned(),
            false => format!("all have ({}), in this order", names.join(", ")),
        };
        self.refuse("E0105", message, &help, here.span(&value.span))
    }

    /// An item of a list: a number, a quantity, or a name.
    fn listed(&mut self, index: &str, node: &Node, here: Here) -> Expanded<Listed> {
        let span = here.span(&node.span);
        match &node.kind {
            Kind::Number(x) if x.is_finite() => {
                let number = Some(crate::expression::Quantity::bare(*x));
                Ok(Listed { name: x.to_string(), number, more: Vec::new() })
            }
            Kind::Name(name) => Ok(Listed { name: name.clone(), number: None, more: Vec::new() }),
            Kind::Text(text) => {
                let name = self.fill(text, &span)?;
                // What is no expression is a name.
                let number = evaluate(&name, &mut self.scope(span.start)).ok();
                Ok(Listed { name, number, more: Vec::new() })
            }
            _ => {
                let message = format!("the index `{index}` takes {} as a value", node.describe());
                let help = "a value of an index is a number, a text in quotes, or a name";
                self.refuse("E0105", message, help, span)
            }
        }
    }

    /// `"0 to 4"`.
    fn whole(&mut self, name: &str, text: &str, span: &Span) -> Expanded<Values> {
        let words = text.match_indices("to").map(|(i, _)| i);
        let blank = |c: Option<char>| c.is_some_and(char::is_whitespace);
        let mut middles = words.filter(|i| {
            blank(text[..*i].chars().next_back()) && blank(text[i + 2..].chars().next())
        });
        let (Some(middle), None) = (middles.next(), middles.next()) else {
            let help = match text.split_once("..") {
                Some((a, b)) => format!(
                    "write `\"{} to {}\"`: both ends are included",
                    a.trim(),
                    b.trim_start_matches('=').trim()
                ),
                None => FORMS.to_owned(),
            };
            let message = format!("the index `{name}` does not run through `{text}`");
            return self.refuse("E0105", message, &help, span.clone());
        };
        let mut ends = [0.0; 2];
        for (end, part) in ends.iter_mut().zip([0..middle, middle + 2..text.len()]) {
            match evaluate(&text[part.clone()], &mut self.scope(span.start)) {
                Ok(q)
                    if q.dimension.is_none()
                        && q.value.fract() == 0.0
                        && q.value.abs() <= LARGEST =>
                {
                    *end = q.value;
                }
                Ok(q) => {
                    let end = text[part].trim();
                    let message = format!(
                        "`{end}` is {}{}: an index runs from one whole number to another",
                        q.value,
                        match q.dimension.unit().as_str() {
                            "1" => String::new(),
                            unit => format!(" {unit}"),
                        },
                    );
                    return self.refuse("E0112", message, FORMS, span.clone());
                }
                Err(error) => {
                    let moved = error.map(|mut e| {
                        e.span = e.span.start + part.start..e.span.end + part.start;
                        e
                    });
                    return self.refuse_expression(moved, span, text);
                }
            }
        }
        let [first, last] = ends;
        let count = if last < first { 0 } else { (last - first) as usize + 1 };
        Ok(Values::Whole { first: first as i64, count })
    }
}

fn example() -> String {
    format!("write `{}`", schema::REPETITION.blocks[0].example)
}
