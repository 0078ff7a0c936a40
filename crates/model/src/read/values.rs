//! Parameters of one member, read as its card says.

use super::context::Context;
use super::files;
use super::members::Made;
use super::names::Names;
use crate::tree::{Entry, Node};
use trilith_element::dimension::{LENGTH, NONE};
use trilith_element::{Card, Default, Dimension, Form, Parameter, Range, Value, Values};

/// The fields of a member: its own, then those of the set it uses.
pub(super) struct Given<'n> {
    pub own: &'n [Entry],
    pub shared: &'n [Entry],
    /// What the section and the material of either give.
    pub made: [Made; 2],
}

/// Where a parameter has its value from.
enum Source<'n> {
    Field(&'n Node),
    Made(f64),
}

/// A parameter that says what another one, of a material or a section, would say as well.
const INSTEAD: [(&str, &str); 3] = [
    ("poisson", "shear_modulus"),
    ("shear_area_2", "shear_coefficient"),
    ("shear_area_3", "shear_coefficient"),
];

impl<'n> Given<'n> {
    pub fn get(&self, key: &str) -> Option<&'n Node> {
        self.own.iter().chain(self.shared).find(|e| e.key == key).map(|e| &e.value)
    }

    /// The value of a parameter: a field comes before a section or a material, and both of the element before those of
    /// the set that it uses.
    fn source(&self, key: &str) -> Option<Source<'n>> {
        let other = INSTEAD.iter().find(|(name, _)| *name == key).map(|(_, other)| *other);
        for (fields, made) in [(self.own, &self.made[0]), (self.shared, &self.made[1])] {
            let field = |key: &str| fields.iter().find(|e| e.key == key);
            if let Some(e) = field(key) {
                return Some(Source::Field(&e.value));
            }
            let given = other.is_some_and(|other| self.get(other).is_some());
            if let Some((_, x)) = made.numbers.iter().find(|(name, _)| *name == key && !given) {
                return Some(Source::Made(*x));
            }
        }
        None
    }
}

/// All parameters of the card with defaults filled in, in the order of the card.
pub(super) fn values(
    c: &Context<'_>,
    card: &Card,
    given: &Given<'_>,
    what: &str,
    at: &crate::Span,
    nodes: &Names<'_>,
) -> Option<Values> {
    let mut read: Vec<Option<Value>> = vec![None; card.parameters.len()];
    let mut good = true;
    // The dimension of some depends on another parameter: those come last.
    let depends = |p: &Parameter| matches!(p.form, Form::Power { .. } | Form::OfAxis { .. });
    for last in [false, true] {
        for (i, p) in card.parameters.iter().enumerate().filter(|(_, p)| depends(p) == last) {
            match given.source(p.name) {
                Some(Source::Made(x)) => read[i] = Some(Value::Number(x)),
                Some(Source::Field(node)) => {
                    let p = p.of(settled(card, p, &read));
                    read[i] = value(c, node, &p, nodes);
                    good &= read[i].is_some();
                }
                None => match default(p) {
                    Ok(value) => read[i] = value,
                    Err(()) => {
                        report_missing(c, card, p, what, at);
                        good = false;
                    }
                },
            }
        }
    }
    let pairs = card.parameters.iter().zip(read);
    let pairs = pairs.filter_map(|(p, v)| v.map(|v| (p.name.to_owned(), v)));
    good.then(|| Values(pairs.collect()))
}

fn report_missing(c: &Context<'_>, card: &Card, p: &Parameter, what: &str, at: &crate::Span) {
    let unit = match dimension_of(p.form) {
        Some(d) if !d.is_none() => format!(", in {d}"),
        _ => String::new(),
    };
    let message = format!("{what} has no `{}`, which {} needs", p.name, card.kind);
    let d = c.diagnostic("E0104", message, at.clone()).label(format!("`{}` is missing", p.name));
    c.report(d.help(format!("add `{}: …`: {}{unit}", p.name, p.meaning)));
}

fn dimension_of(form: Form) -> Option<Dimension> {
    match form {
        Form::Number(d)
        | Form::Numbers { dimension: d, .. }
        | Form::Matrix { dimension: d, .. }
        | Form::OfAxis { along: d, .. } => Some(d),
        _ => None,
    }
}

/// What holds where nothing is given; an error for a parameter that must be given.
pub(super) fn default(p: &Parameter) -> Result<Option<Value>, ()> {
    Ok(match (p.default, p.form) {
        (Default::Required, _) => return Err(()),
        (Default::Absent, _) => None,
        (Default::Number(x), Form::Numbers { count: Some(n), .. }) => {
            Some(Value::List(vec![Value::Number(x); n]))
        }
        (Default::Number(x), _) => Some(Value::Number(x)),
        (Default::Choice(name), Form::Choices(_)) => {
            Some(Value::List(vec![Value::Text(name.to_owned())]))
        }
        (Default::Choice(name), _) => Some(Value::Text(name.to_owned())),
        (Default::Flag(b), _) => Some(Value::Flag(b)),
    })
}

/// The form of a parameter once those are read that its dimension depends on.
fn settled(card: &Card, p: &Parameter, read: &[Option<Value>]) -> Form {
    let other = |name: &str| {
        card.parameters.iter().position(|q| q.name == name).and_then(|i| read[i].as_ref())
    };
    match p.form {
        Form::Power { base, over, exponent } => Form::Number(match other(exponent) {
            Some(Value::Number(x)) => base / over.powf(*x),
            _ => base / over,
        }),
        Form::OfAxis { along, about, list } => {
            let turns = matches!(other("axis"), Some(Value::Text(axis)) if axis.starts_with('R'));
            let form = Form::Number(if turns { about } else { along });
            if list { form.list() } else { form }
        }
        form => form,
    }
}

fn value(c: &Context<'_>, node: &Node, p: &Parameter, nodes: &Names<'_>) -> Option<Value> {
    match p.form {
        Form::Number(dimension) => c.ranged(node, p.name, dimension, p.range).map(Value::Number),
        // Settled before.
        Form::Power { .. } | Form::OfAxis { .. } => None,
        Form::Choice(names) => {
            c.choice(node, p.name, names).map(|i| Value::Text(names[i].to_owned()))
        }
        Form::Choices(names) => choices(c, node, p.name, names),
        Form::Flag => c.flag(node, p.name).map(Value::Flag),
        Form::Numbers { dimension, count } => numbers(c, node, p, dimension, count),
        Form::Matrix { size, dimension, symmetric } => {
            matrix(c, node, p, size, dimension, symmetric)
        }
        Form::Points => points(c, node, p),
        Form::Node => nodes.refer(c, node).map(|i| Value::Text(nodes.name(i).to_owned())),
        Form::Text => files::text(c, node, p.name).map(Value::Text),
        Form::File => files::file(c, node).map(Value::File),
        Form::SparseMatrix => files::matrix(c, node).map(Value::Matrix),
        Form::Labels => labels(c, node, p.name),
    }
}

fn labels(c: &Context<'_>, node: &Node, name: &str) -> Option<Value> {
    if !node.is_list() {
        return c.wrong(node, &format!("a list of texts for `{name}`"));
    }
    let read: Vec<_> = node.items().into_iter().map(|n| c.text(n, name).map(Value::Text)).collect();
    read.into_iter().collect::<Option<Vec<_>>>().map(Value::List)
}

fn choices(c: &Context<'_>, node: &Node, name: &str, names: &[&str]) -> Option<Value> {
    let mut found: Vec<usize> = Vec::new();
    let mut good = true;
    for item in node.items() {
        match c.choice(item, name, names) {
            Some(i) if found.contains(&i) => {
                let message = format!("`{}` is given twice in `{name}`", names[i]);
                c.report(c.diagnostic("E0102", message, item.span.clone()));
                good = false;
            }
            Some(i) => found.push(i),
            None => good = false,
        }
    }
    let texts = found.into_iter().map(|i| Value::Text(names[i].to_owned()));
    good.then(|| Value::List(texts.collect()))
}

fn numbers(
    c: &Context<'_>,
    node: &Node,
    p: &Parameter,
    dimension: Dimension,
    count: Option<usize>,
) -> Option<Value> {
    let items = node.items();
    if !node.is_list() {
        return c.wrong(node, &format!("a list of numbers for `{}`", p.name));
    }
    if let Some(n) = count.filter(|n| *n != items.len()) {
        let message = format!("`{}` has {} numbers: must have {n}", p.name, items.len());
        c.report(c.diagnostic("E0105", message, node.span.clone()));
        return None;
    }
    let read: Vec<_> = items.iter().map(|n| c.ranged(n, p.name, dimension, p.range)).collect();
    let read: Option<Vec<f64>> = read.into_iter().collect();
    read.map(|all| Value::List(all.into_iter().map(Value::Number).collect()))
}

fn points(c: &Context<'_>, node: &Node, p: &Parameter) -> Option<Value> {
    let items = node.items();
    if !node.is_list() || items.iter().any(|n| !n.is_list()) {
        return c
            .wrong(node, &format!("a list of positions for `{}`, such as [(1, 0, 0)]", p.name));
    }
    let point = |n: &Node| {
        let point = numbers(c, n, p, LENGTH, Some(3))?;
        let near: Vec<_> = n.items().into_iter().map(|item| c.lever(item, p.name)).collect();
        near.iter().all(Option::is_some).then_some(point)
    };
    let read: Vec<_> = items.into_iter().map(point).collect();
    read.into_iter().collect::<Option<Vec<_>>>().map(Value::List)
}

fn matrix(
    c: &Context<'_>,
    node: &Node,
    p: &Parameter,
    size: usize,
    dimension: Dimension,
    symmetric: bool,
) -> Option<Value> {
    let rows = node.items();
    let square = node.is_list()
        && rows.len() == size
        && rows.iter().all(|r| r.is_list() && r.items().len() == size);
    if !square {
        let message = format!("`{}` must be a list of {size} rows of {size} numbers", p.name);
        c.report(c.diagnostic("E0105", message, node.span.clone()));
        return None;
    }
    // Rotational rows and columns each add a length: N/m, N, N·m.
    let length = |i: usize| if i % 6 >= 3 { LENGTH } else { NONE };
    let mut all = vec![vec![0.0; size]; size];
    let mut good = true;
    for (i, row) in rows.iter().enumerate() {
        for (j, item) in row.items().into_iter().enumerate() {
            match c.ranged(item, p.name, dimension * length(i) * length(j), Range::Any) {
                Some(x) => all[i][j] = x,
                None => good = false,
            }
        }
    }
    if !symmetric {
        return good.then(|| rows_of(all));
    }
    let scale = all.iter().flatten().fold(0.0_f64, |a, x| a.max(x.abs()));
    for i in 0..size {
        for j in 0..i {
            if good && (all[i][j] - all[j][i]).abs() > 1e-12 * scale {
                let message = format!(
                    "`{}` is not symmetric: row {} column {} is {}, row {} column {} is {}",
                    p.name,
                    i + 1,
                    j + 1,
                    all[i][j],
                    j + 1,
                    i + 1,
                    all[j][i]
                );
                c.report(c.diagnostic("E0112", message, rows[i].items()[j].span.clone()));
                return None;
            }
        }
    }
    good.then(|| rows_of(all))
}

fn rows_of(all: Vec<Vec<f64>>) -> Value {
    let row = |r: Vec<f64>| Value::List(r.into_iter().map(Value::Number).collect());
    Value::List(all.into_iter().map(row).collect())
}
