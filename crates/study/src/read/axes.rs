//! Fixed values, points and axes.

use super::setting::Settings;
use crate::number::written;
use crate::{Axis, schema};
use trilith::element::Dimension;
use trilith::model::Span;
use trilith::model::file::{Context, Entry, Kind, Node};

/// Most values of one axis, samples and members of an ensemble: all are made before the first run.
pub(super) const MOST: usize = 1_000_000;

/// Entries of a map; what is none is reported.
pub(super) fn map<'n>(c: &Context<'_>, node: &'n Node, what: &str) -> Option<&'n [Entry]> {
    match &node.kind {
        Kind::Map(entries) => Some(entries),
        _ => c.wrong(node, &format!("a map `{{ \"name\": … }}` for `{what}`")),
    }
}

/// A value as `--set` takes it.
fn value(c: &Context<'_>, node: &Node) -> Option<String> {
    match &node.kind {
        Kind::Text(text) => Some(text.clone()),
        Kind::Number(x) if x.is_finite() => Some(format!("{x:?}")),
        Kind::Flag(b) => Some(if *b { "1" } else { "0" }.to_owned()),
        Kind::List(Some(name), items) if name == "Text" => match items.as_slice() {
            [Node { kind: Kind::Text(text), .. }] => Some(text.clone()),
            _ => c.wrong(node, "a text in quotes"),
        },
        _ => c.wrong(node, "a finite number, or a text in quotes,"),
    }
}

fn assignments(
    c: &Context<'_>,
    node: &Node,
    part: &'static str,
    settings: &mut Settings,
) -> Vec<(String, String)> {
    let mut all = Vec::new();
    for e in map(c, node, part).unwrap_or_default() {
        if let Some(value) = value(c, &e.value) {
            settings.add(part, (&e.key, &e.key_span), &value, &e.value.span);
            all.push((e.key.clone(), value));
        }
    }
    all
}

/// `set: { "height": "4 m" }`.
pub(super) fn fixed(
    c: &Context<'_>,
    node: Option<&Node>,
    settings: &mut Settings,
) -> Vec<(String, String)> {
    node.map_or_else(Vec::new, |n| assignments(c, n, "set", settings))
}

/// `points: [ { "mu": 0.4, "ah": 0.2 }, … ]`.
pub(super) fn points(
    c: &Context<'_>,
    node: Option<&Node>,
    settings: &mut Settings,
) -> Vec<Vec<(String, String)>> {
    let Some(node) = node else { return Vec::new() };
    let Kind::List(None, items) = &node.kind else {
        c.wrong::<()>(node, "a list of points `[{ \"name\": value }, …]`");
        return Vec::new();
    };
    if items.is_empty() {
        c.report(c.diagnostic("E0104", "`points` is empty", node.span.clone()));
    }
    let rows: Vec<Vec<(String, String)>> =
        items.iter().map(|n| assignments(c, n, "points", settings)).collect();
    let names = |row: &[(String, String)]| {
        let mut names: Vec<String> = row.iter().map(|(n, _)| n.clone()).collect();
        names.sort();
        names
    };
    for (row, item) in rows.iter().zip(items).skip(1) {
        if names(row) != names(&rows[0]) {
            let message = "this point does not set the same parameters as the first";
            c.report(
                c.diagnostic("E0112", message, item.span.clone())
                    .related(items[0].span.clone(), "the first"),
            );
        }
    }
    rows
}

/// `axes: { "mu": Range(from: 0.1, to: 0.9, count: 9), "record": ["a.csv", "b.csv"] }`.
pub(super) fn axes(c: &Context<'_>, node: Option<&Node>, settings: &mut Settings) -> Vec<Axis> {
    let Some(entries) = node.and_then(|n| map(c, n, "axes")) else { return Vec::new() };
    if let (Some(node), []) = (node, entries) {
        c.report(c.diagnostic("E0104", "`axes` names no parameter", node.span.clone()));
    }
    let mut all = Vec::new();
    for e in entries {
        let values = along(c, e).unwrap_or_default();
        if e.value.is_list() && e.value.items().is_empty() {
            let message = format!("the axis `{}` has no values", e.key);
            c.report(c.diagnostic("E0104", message, e.value.span.clone()).label("empty"));
        }
        // A range stands at one place: its ends speak for it.
        let ends = if e.value.is_list() { values.len() } else { 1 };
        for (value, span) in values.iter().take(ends).chain(values.last()) {
            settings.add("axes", (&e.key, &e.key_span), value, span);
        }
        let values = values.into_iter().map(|(v, _)| v).collect();
        all.push(Axis { name: e.key.clone(), values });
    }
    all
}

fn along(c: &Context<'_>, e: &Entry) -> Option<Vec<(String, Span)>> {
    let node = &e.value;
    if node.is_list() {
        let items = node.items().into_iter();
        let all: Vec<_> = items.map(|n| Some((value(c, n)?, n.span.clone()))).collect();
        return all.into_iter().collect();
    }
    let help = "`[…]`, `Range(from: …, to: …, count: …)` or `Log(from: …, to: …, count: …)`";
    if node.name().is_none() {
        return c.wrong(node, help);
    }
    let kind = c.one_of(node, "axis", &schema::AXES)?;
    let log = kind.name == schema::LOG.name;
    let what = format!("the axis `{}`", e.key);
    let fields = c.block(node, &what, kind)?;
    let (from, to) = (fields.required(c, "from"), fields.required(c, "to"));
    let (from_node, to_node) = (from?, to?);
    let (from, to) = (c.quantity(from_node), c.quantity(to_node));
    let (from, to) = (from?, to?);
    if from.measured != to.measured || !from.dimension.matches(to.dimension) {
        let message = format!("`from` is in {}, `to` is in {}", from.dimension, to.dimension);
        c.report(c.diagnostic("E0111", message, to_node.span.clone()));
        return None;
    }
    let none = trilith::element::dimension::NONE;
    let dimension: Dimension = if from.measured { from.dimension } else { none };
    let count = match (fields.get("count"), fields.get("step")) {
        (Some(_), None) => fields.count(c, "count")?,
        (None, Some(n)) => {
            let step = c.in_dimension(n, c.quantity(n)?, dimension)?;
            let steps = (to.value - from.value) / step;
            let whole = steps.round();
            if !(whole >= 0.0 && (steps - whole).abs() < 1e-6 && whole < MOST as f64) {
                let message =
                    format!("no whole number of steps leads from `from` to `to`: {steps}");
                c.report(c.diagnostic("E0112", message, n.span.clone()));
                return None;
            }
            whole as usize + 1
        }
        (Some(_), Some(n)) => {
            let message = format!("{what} has `count` and `step`");
            c.report(c.diagnostic("E0102", message, n.span.clone()).help("keep one of the two"));
            return None;
        }
        (None, None) => {
            fields.required(c, "count");
            return None;
        }
    };
    let wrong = if count > MOST {
        Some(format!("{what} has {count} values: at most {MOST}"))
    } else if log && (from.value <= 0.0 || to.value <= 0.0) {
        Some("the ends of a logarithmic axis must be above 0".to_owned())
    } else if count == 1 && from.value != to.value {
        Some("one value cannot be both `from` and `to`".to_owned())
    } else {
        None
    };
    if let Some(message) = wrong {
        c.report(c.diagnostic("E0112", message, node.span.clone()));
        return None;
    }
    let last = count.saturating_sub(1).max(1) as f64;
    let at = |i: usize| {
        let x = i as f64;
        if i == 0 {
            from.value
        } else if i + 1 == count {
            to.value
        } else if log {
            from.value * (to.value / from.value).powf(x / last)
        } else {
            let between = (from.value * (last - x) + to.value * x) / last;
            // 1.55, not 1.5499999999999998.
            format!("{between:.13e}").parse().unwrap_or(between)
        }
    };
    Some((0..count).map(|i| (written(at(i), dimension), node.span.clone())).collect())
}
