//! The example of a card as an entry of a model file whose parameters can be changed.

use crate::element::{Card, Form, Parameter};

/// `"name": Kind(field: value, …)`, taken apart. Values are RON as written.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Entry {
    pub name: String,
    pub kind: String,
    pub fields: Vec<(String, String)>,
}

/// The pieces between commas of a text that goes on to a closing bracket.
fn pieces(text: &str) -> Option<Vec<&str>> {
    let (mut depth, mut quoted, mut start) = (0_usize, false, 0);
    let mut found = Vec::new();
    for (i, c) in text.char_indices() {
        match c {
            '"' => quoted = !quoted,
            _ if quoted => {}
            '(' | '[' | '{' => depth += 1,
            ')' | ']' | '}' if depth == 0 => {
                found.push(text[start..i].trim());
                found.retain(|p: &&str| !p.is_empty());
                return Some(found);
            }
            ')' | ']' | '}' => depth -= 1,
            ',' if depth == 0 => {
                found.push(text[start..i].trim());
                start = i + 1;
            }
            _ => {}
        }
    }
    None
}

fn quoted(text: &str) -> impl Iterator<Item = &str> {
    text.split('"').skip(1).step_by(2)
}

impl Entry {
    /// The example of a card; none where it is not written as an entry of a model file.
    pub fn of(card: &Card) -> Option<Self> {
        let (head, rest) = card.example.split_once('(')?;
        let (name, kind) = head.rsplit_once(':')?;
        let field = |piece: &str| {
            let (key, value) = piece.split_once(':')?;
            Some((key.trim().to_owned(), value.trim().to_owned()))
        };
        Some(Self {
            name: quoted(name).next()?.to_owned(),
            kind: kind.trim().to_owned(),
            fields: pieces(rest)?.into_iter().map(field).collect::<Option<_>>()?,
        })
    }

    /// Gives a field another value, or takes it away.
    pub fn set(&mut self, key: &str, value: Option<String>) {
        let at = self.fields.iter().position(|(k, _)| k == key);
        match (at, value) {
            (Some(i), Some(value)) => self.fields[i].1 = value,
            (Some(i), None) => drop(self.fields.remove(i)),
            (None, Some(value)) => self.fields.push((key.to_owned(), value)),
            (None, None) => {}
        }
    }

    /// Gives a parameter the value of an argument such as `k=2 MN/m`; `none` takes it away.
    pub fn set_parameter(&mut self, card: &Card, name: &str, value: &str) {
        let value = (value != "none").then(|| written(card.parameter(name), value));
        self.set(name, value);
    }

    /// The nodes that it stands on, in order.
    pub fn nodes(&self) -> Vec<String> {
        let place = self.fields.iter().find(|(k, _)| k == "nodes" || k == "node");
        place.map(|(_, v)| quoted(v).map(str::to_owned).collect()).unwrap_or_default()
    }

    /// Nodes, then those that parameters name.
    pub fn all_nodes(&self, card: &Card) -> Vec<String> {
        let mut all = self.nodes();
        let named = |key: &str| card.parameter(key).is_some_and(|p| p.form == Form::Node);
        for (_, value) in self.fields.iter().filter(|(k, _)| named(k)) {
            all.extend(quoted(value).map(str::to_owned));
        }
        let mut seen = Vec::new();
        all.retain(|n| !seen.contains(n) && (seen.push(n.clone()), true).1);
        all
    }

    /// The same with a prefix to its name and to those of all its nodes.
    pub fn renamed(&self, prefix: &str, card: &Card) -> Self {
        let place = |key: &str| {
            key == "nodes"
                || key == "node"
                || card.parameter(key).is_some_and(|p| p.form == Form::Node)
        };
        // Names stand at the odd places between quotes.
        let renamed = |value: &str| {
            let parts = value.split('"').enumerate();
            let parts: Vec<_> = parts
                .map(|(i, part)| if i % 2 == 1 { format!("{prefix}{part}") } else { part.into() })
                .collect();
            parts.join("\"")
        };
        let fields = self
            .fields
            .iter()
            .map(|(k, v)| (k.clone(), if place(k) { renamed(v) } else { v.clone() }));
        Self {
            name: format!("{prefix}{}", self.name),
            kind: self.kind.clone(),
            fields: fields.collect(),
        }
    }

    /// As one line of a model file.
    pub fn line(&self) -> String {
        let fields: Vec<_> = self.fields.iter().map(|(k, v)| format!("{k}: {v}")).collect();
        format!("\"{}\": {}({})", self.name, self.kind, fields.join(", "))
    }

    /// A model that holds it and nothing else, a field a line so that errors point well.
    pub fn model(&self, card: &Card) -> String {
        let place = |(i, n): (usize, &String)| format!("\"{n}\": ({i}, 0, 0)");
        let nodes: Vec<_> = self.all_nodes(card).iter().enumerate().map(place).collect();
        let fields = self.fields.iter().map(|(k, v)| format!("            {k}: {v},\n"));
        format!(
            "(\n    nodes: {{ {} }},\n    elements: {{\n        \"{}\": {}(\n{}        ),\n    }},\n    \
             cases: {{ \"rest\": Static(loads: []) }},\n)\n",
            nodes.join(", "),
            self.name,
            self.kind,
            fields.collect::<String>(),
        )
    }
}

/// The value of an argument as RON: numbers with units in quotes, lists in brackets.
fn written(parameter: Option<&Parameter>, value: &str) -> String {
    let quote = |text: &str| {
        if text.starts_with('"') { text.to_owned() } else { format!("\"{text}\"") }
    };
    // Everything between brackets and commas is a number.
    let numbers = || {
        let mut out = String::new();
        let mut rest = value;
        while !rest.is_empty() {
            let end = rest.find(['[', ']', '(', ')', ',']).unwrap_or(rest.len());
            let item = rest[..end].trim();
            if !item.is_empty() {
                out += &quote(item);
            }
            let next = (end + 1).min(rest.len());
            out += &rest[end..next];
            rest = &rest[next..];
        }
        out
    };
    let bracketed = |text: String| {
        if value.starts_with(['[', '(']) { text } else { format!("[{text}]") }
    };
    match parameter.map(|p| p.form) {
        Some(Form::Choice(_) | Form::Flag) => value.to_owned(),
        Some(Form::Choices(_)) => bracketed(value.to_owned()),
        Some(
            Form::Numbers { .. }
            | Form::OfAxis { list: true, .. }
            | Form::Matrix { .. }
            | Form::Points,
        ) => bracketed(numbers()),
        None if value.starts_with(['[', '(']) => numbers(),
        _ => quote(value),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::element::{Default, Described};
    use crate::elements::{Dashpot, Gap};

    #[test]
    fn an_example_is_taken_apart_and_put_together() {
        let entry = Entry::of(&Gap::CARD).unwrap();
        assert_eq!((entry.name.as_str(), entry.kind.as_str()), ("stop", "Gap"));
        assert_eq!(entry.nodes(), ["a", "b"]);
        assert_eq!(entry.line(), Gap::CARD.example);
        let mut entry = entry;
        entry.set_parameter(&Gap::CARD, "k", "5 kN/m");
        entry.set_parameter(&Gap::CARD, "axis", "U2");
        entry.set_parameter(&Gap::CARD, "opening", "none");
        let line = r#""stop": Gap(nodes: ("a", "b"), k: "5 kN/m", axis: U2)"#;
        assert_eq!(entry.line(), line);
        let line = r#""x stop": Gap(nodes: ("x a", "x b"), k: "5 kN/m", axis: U2)"#;
        assert_eq!(entry.renamed("x ", &Gap::CARD).line(), line);
    }

    #[test]
    fn lists_and_numbers_are_written_as_in_model_files() {
        let list = Parameter::new("x", "", Form::STIFFNESS_OF_AXIS.list(), Default::Required, "");
        assert_eq!(written(Some(&list), "1 kN/m, 2 kN/m"), r#"["1 kN/m","2 kN/m"]"#);
        assert_eq!(written(Some(&list), "[1, 2]"), r#"["1","2"]"#);
        assert_eq!(written(None, "(0, 0, 1)"), r#"("0","0","1")"#);
        assert_eq!(written(Dashpot::CARD.parameter("c"), "20 kN/(m/s)"), r#""20 kN/(m/s)""#);
        assert_eq!(written(Dashpot::CARD.parameter("pull"), "true"), "true");
    }
}
