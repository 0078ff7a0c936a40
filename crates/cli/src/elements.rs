//! `trilith elements`: the catalogue.

use crate::text::{names_help, row, table};
use crate::{Answer, Failure};
use trilith::Registry;
use trilith::element::{Card, Category, Default, Form, NodeCount, Parameter, Range};

const CATEGORIES: [(Category, &str); 3] = [
    (Category::Linear, "linear elements: add to M, C, K"),
    (Category::Constraint, "constraints: eliminate directions"),
    (Category::Link, "links: nonlinear laws"),
];

pub(crate) fn elements(registry: &Registry, name: Option<&str>) -> Result<Answer, Failure> {
    let Some(name) = name else { return Ok(list(registry).into()) };
    match registry.card(name) {
        Some(card) => Ok(full(card).into()),
        None => {
            let help = names_help(name, "kinds", registry.cards().map(|c| c.kind));
            Err(Failure::input(&format!("there is no kind `{name}`"), Some(&help)))
        }
    }
}

fn list(registry: &Registry) -> String {
    let mut out = String::new();
    for (category, title) in CATEGORIES {
        let rows: Vec<_> = registry
            .cards()
            .filter(|c| c.category == category)
            .map(|c| row([c.kind, &nodes(c.nodes), c.summary]))
            .collect();
        if !rows.is_empty() {
            out += &format!("{title}\n{}\n", table(&rows, &[0, 1, 2]));
        }
    }
    out + "`trilith elements NAME` shows a kind in full.\n"
}

fn full(card: &Card) -> String {
    let category = match card.category {
        Category::Linear => "linear element",
        Category::Constraint => "constraint",
        Category::Link => "link",
    };
    let mut out = format!("{} ({category}, {})\n{}\n", card.kind, nodes(card.nodes), card.summary);
    if !card.parameters.is_empty() {
        let mut rows = vec![row(["name", "symbol", "unit", "range", "default", "meaning"])];
        rows.extend(card.parameters.iter().map(parameter));
        out += &format!("\nparameters\n{}", table(&rows, &[0, 1, 2, 3, 4, 5]));
    }
    if card.category == Category::Link {
        out += "\nEvery link also takes `axis1`, `axis2`, `shear_at` and `effective_stiffness`.\n";
    }
    let indented = |text: &str| text.lines().map(|l| format!("  {l}\n")).collect::<String>();
    for (title, text) in [("law", card.law), ("source", card.source), ("example", card.example)] {
        if !text.is_empty() {
            out += &format!("\n{title}\n{}", indented(text));
        }
    }
    out
}

fn parameter(p: &Parameter) -> Vec<String> {
    let (unit, admissible) = form(p);
    let default = match p.default {
        Default::Required => "required".into(),
        Default::Absent => "absent".into(),
        Default::Number(x) => x.to_string(),
        Default::Choice(c) => c.to_owned(),
        Default::Flag(b) => b.to_string(),
    };
    row([p.name, p.symbol, &unit, &admissible, &default, p.meaning])
}

/// Unit and admissible values.
fn form(p: &Parameter) -> (String, String) {
    let range = match p.range {
        Range::Any => "any".to_owned(),
        range => range.text(),
    };
    let unit = |d: trilith::element::Dimension| if d.is_none() { "–".into() } else { d.unit() };
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
    }
}

fn nodes(count: NodeCount) -> String {
    match (count.min, count.max) {
        (1, 1) => "1 node".into(),
        (1, 2) => "1 node (to the ground) or 2 nodes".into(),
        (a, b) if a == b => format!("{a} nodes"),
        (a, usize::MAX) => format!("{a} or more nodes"),
        (a, b) => format!("{a} to {b} nodes"),
    }
}
