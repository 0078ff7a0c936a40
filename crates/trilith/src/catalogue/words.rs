//! Cards in words.

use crate::element::{Category, Default, Dimension, Form, NodeCount, Parameter, Range};

/// A category in words.
#[must_use]
pub fn category(category: Category) -> &'static str {
    match category {
        Category::Linear => "linear element",
        Category::Constraint => "constraint",
        Category::Link => "link",
        Category::Function => "function of time",
        Category::Output => "output",
        Category::Solver => "solver",
    }
}

/// A parameter as a row: name, symbol, unit, range, default, meaning.
#[must_use]
pub fn parameter(p: &Parameter) -> [String; 6] {
    let (unit, admissible) = form(p);
    let default = match p.default {
        Default::Required => "required".into(),
        Default::Absent => "absent".into(),
        Default::Number(x) => x.to_string(),
        Default::Choice(c) => c.to_owned(),
        Default::Flag(b) => b.to_string(),
    };
    [p.name.into(), p.symbol.into(), unit, admissible, default, p.meaning.into()]
}

/// Unit and admissible values.
fn form(p: &Parameter) -> (String, String) {
    let range = match p.range {
        Range::Any => "any".to_owned(),
        range => range.text(),
    };
    let unit = |d: Dimension| if d.is_none() { "–".into() } else { d.unit() };
    match p.form {
        Form::Number(d) => (unit(d), range),
        Form::Power { base, over, exponent } => {
            (format!("{}/({})^{exponent}", unit(base), unit(over)), range)
        }
        Form::OfAxis { along, about, list } => {
            let count = if list { "list, " } else { "" };
            (format!("{} or {}", unit(along), unit(about)), format!("{count}{range}"))
        }
        Form::Choice(all) => (String::new(), all.join(", ")),
        Form::Choices(all) => (String::new(), format!("some of {}", all.join(", "))),
        Form::Flag => (String::new(), "true, false".into()),
        Form::Numbers { dimension, count } => {
            let count = count.map_or("list".to_owned(), |n| format!("{n} numbers"));
            (unit(dimension), format!("{count}, {range}"))
        }
        Form::Matrix { size, dimension, symmetric } => {
            let symmetric = if symmetric { ", symmetric" } else { "" };
            (unit(dimension), format!("{size} × {size}{symmetric}"))
        }
        Form::Points => ("m".into(), "list of (x, y, z)".into()),
        Form::Node => (String::new(), "name of a node".into()),
        Form::Text => (String::new(), "text".into()),
        Form::File => (String::new(), "path of a text file".into()),
        Form::SparseMatrix => {
            (String::new(), "path of a `.mtx`, `.npz`, `.sti`, `.mas` or `.pch` file".into())
        }
        Form::Labels => (String::new(), "a text for each node".into()),
    }
}

/// A number of nodes in words.
#[must_use]
pub fn nodes(count: NodeCount) -> String {
    match (count.min, count.max) {
        (0, 0) => "no node".into(),
        (1, 1) => "1 node".into(),
        (1, 2) => "1 node (to the ground) or 2 nodes".into(),
        (a, b) if a == b => format!("{a} nodes"),
        (a, usize::MAX) => format!("{a} or more nodes"),
        (a, b) => format!("{a} to {b} nodes"),
    }
}
