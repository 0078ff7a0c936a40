//! Names that figures and conditions may refer to.

use crate::Column;
use trilith::element::Dimension;
use trilith::model::file::{Context, Kind, Node, closest, names_help};

/// Columns and varied parameters.
pub(super) struct Names<'a> {
    varied: &'a [String],
    kinds: &'a [Option<Dimension>],
    columns: &'a [Column],
    /// True where runs are combinations of cases, of which nothing but extremes is known.
    pub is_combined: bool,
}

impl<'a> Names<'a> {
    pub fn new(
        varied: &'a [String],
        kinds: &'a [Option<Dimension>],
        columns: &'a [Column],
        is_combined: bool,
    ) -> Self {
        Self { varied, kinds, columns, is_combined }
    }

    /// A column and its dimension.
    pub fn column(&self, c: &Context<'_>, node: &Node) -> Option<(String, Dimension)> {
        let name = text(c, node, "the name of a column in quotes")?;
        if let Some(column) = self.columns.iter().find(|k| k.name == name) {
            return Some((name, column.dimension));
        }
        let all: Vec<&str> = self.columns.iter().map(|k| k.name.as_str()).collect();
        unknown(c, node, "column", "columns", &name, &all);
        None
    }

    /// A column or a varied parameter that is a number, and its dimension.
    pub fn number(&self, c: &Context<'_>, node: &Node) -> Option<(String, Dimension)> {
        let name = text(c, node, "the name of a column or of a varied parameter in quotes")?;
        let parameter = self.varied.iter().position(|n| *n == name);
        if let Some(dimension) = parameter.and_then(|i| self.kinds[i]) {
            return Some((name, dimension));
        }
        if let Some(column) = self.columns.iter().find(|k| k.name == name) {
            return Some((name, column.dimension));
        }
        self.missing(c, node, &name);
        None
    }

    /// A column or a varied parameter of any kind.
    pub fn any(&self, c: &Context<'_>, node: &Node) -> Option<String> {
        let name = text(c, node, "the name of a column or of a varied parameter in quotes")?;
        if self.varied.contains(&name) || self.columns.iter().any(|k| k.name == name) {
            return Some(name);
        }
        self.missing(c, node, &name);
        None
    }

    fn missing(&self, c: &Context<'_>, node: &Node, name: &str) {
        let columns = self.columns.iter().map(|k| k.name.as_str());
        let all: Vec<&str> = self.varied.iter().map(String::as_str).chain(columns).collect();
        let what = "column or varied parameter";
        unknown(c, node, what, "columns and varied parameters", name, &all);
    }
}

fn text(c: &Context<'_>, node: &Node, wanted: &str) -> Option<String> {
    match &node.kind {
        Kind::Text(name) => Some(name.clone()),
        _ => c.wrong(node, wanted),
    }
}

/// Reports a name that there is not.
pub(super) fn unknown(
    c: &Context<'_>,
    node: &Node,
    one: &str,
    many: &str,
    name: &str,
    all: &[&str],
) {
    let message = format!("there is no {one} `{name}`");
    let mut d = c.diagnostic("E0106", message, node.span.clone());
    if c.suggests() {
        d = d.help(names_help(name, many, all.iter().copied()));
        if let Some(near) = closest(name, all.iter().copied()) {
            d = d.suggestion(node.span.clone(), format!("\"{near}\""));
        }
    }
    c.report(d);
}
