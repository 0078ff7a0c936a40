//! Functions given by tables: CSV records and lists of points.

use super::context::{Context, Fields, PARAMETER};
use super::functions::{Made, what};
use super::record::{column, columns, numbers};
use crate::schema;
use crate::tree::{Entry, Kind, Node};
use crate::{AfterEnd, Interpolation, Span, Table, TableError, TimeFunction};
use std::sync::Arc;
use trilith_element::Dimension;
use trilith_element::dimension::{NONE, TIME};

fn style(c: &Context<'_>, fields: &Fields<'_>) -> Option<(Interpolation, AfterEnd)> {
    let interpolation = fields.named(c, "interpolation", "interpolation");
    let after = after_end(c, fields);
    Some((interpolation?, after?))
}

/// What holds after the end.
pub(super) fn after_end(c: &Context<'_>, fields: &Fields<'_>) -> Option<AfterEnd> {
    fields.named(c, "after_end", "end of a table")
}

pub(super) fn table(c: &Context<'_>, e: &Entry) -> Option<Made> {
    let fields = c.block(&e.value, &what(e), &schema::TABLE)?;
    let style = style(c, &fields);
    let scale = fields.get("scale").map_or(Some(None), |n| c.quantity(n).map(Some));
    let unit = fields.get("unit").map_or(Some(None), |n| unit(c, n).map(Some));
    let skip = fields.count(c, "skip");
    let (times, values) =
        (column(c, fields.get("time"), "time", 0), column(c, fields.get("value"), "value", 1));
    let file = fields.required(c, "file")?;
    let path = file_name(c, file)?;
    let at = &file.span;
    let (path, skip, times, values) = (c.file(&path, file), skip?, times?, values?);
    let read = || {
        let all = columns(c, &path, skip, at)?;
        let times = numbers(c, &all, &times, &place(&fields, "time", at));
        let values = numbers(c, &all, &values, &place(&fields, "value", at));
        times.zip(values)
    };
    let key = format!("{path:?} {skip} {times:?} {values:?}");
    let found = c.motions.columns.get(key, || read().ok_or(())).ok()?;
    let (times, mut values) = (&found.0, found.1.clone());
    let mut dimension: Option<Dimension> = None;
    for q in [unit?, scale?].into_iter().flatten() {
        values.iter_mut().for_each(|v| *v *= q.value);
        if q.measured {
            dimension = Some(dimension.unwrap_or(NONE) * q.dimension);
        }
    }
    let seconds = c.units_at(&e.value).scale(TIME);
    let times = times.iter().map(|t| t * seconds).collect();
    let (interpolation, after_end) = style?;
    match Table::new(times, values, interpolation, after_end) {
        Ok(table) => Some((TimeFunction::Table(Arc::new(table)), dimension)),
        Err(error) => {
            let row = match error {
                TableError::Order { index, .. } | TableError::NotFinite(index) => index,
                _ => 0,
            };
            let message = format!("{}: {error}", columns(c, &path, skip, at)?.place(row));
            c.report(c.diagnostic("E0117", message, at.clone()));
            None
        }
    }
}

fn place(fields: &Fields<'_>, key: &str, otherwise: &Span) -> Span {
    fields.get(key).map_or(otherwise.clone(), |n| n.span.clone())
}

/// A unit such as `"g"` or `"cm/s^2"`.
pub(super) fn unit(c: &Context<'_>, node: &Node) -> Option<crate::expression::Quantity> {
    let text = c.text(node, "unit")?;
    // Behind a number a name is a unit, whatever parameters are called.
    let one = Node { span: node.span.clone(), kind: Kind::Text(format!("1 {text}")) };
    c.quantity(&one)
}

/// `"file.csv"`, or `Parameter("name")` of a text parameter.
pub(super) fn file_name(c: &Context<'_>, node: &Node) -> Option<String> {
    match &node.kind {
        Kind::Text(name) => Some(name.clone()),
        Kind::List(Some(kind), _) if kind == PARAMETER => {
            let name = c.text_parameter(node)?;
            c.parameters().text(name).map(str::to_owned)
        }
        _ => c.wrong(node, "a file name in quotes or `Parameter(\"name\")`"),
    }
}

pub(super) fn points(c: &Context<'_>, e: &Entry) -> Option<Made> {
    let fields = c.block(&e.value, &what(e), &schema::POINTS)?;
    let style = style(c, &fields);
    let list = fields.required(c, "points")?;
    let mut times = Vec::new();
    let mut read = Vec::new();
    for item in list.items() {
        let pair = item.items();
        if !item.is_list() || pair.len() != 2 {
            return c.wrong(item, "a pair `(time, value)`");
        }
        let (t, q) = (c.number(pair[0], TIME), c.quantity(pair[1]));
        times.push(t);
        read.push(q.map(|q| (pair[1], q)));
    }
    let times: Vec<f64> = times.into_iter().collect::<Option<_>>()?;
    let read: Vec<_> = read.into_iter().collect::<Option<_>>()?;
    let dimension = read.iter().find(|(_, q)| q.measured).map(|(_, q)| q.dimension);
    let values: Vec<_> = read
        .into_iter()
        .map(|(n, q)| dimension.map_or(Some(q.value), |d| c.in_dimension(n, q, d)))
        .collect();
    let values: Vec<f64> = values.into_iter().collect::<Option<_>>()?;
    let (interpolation, after_end) = style?;
    match Table::new(times, values, interpolation, after_end) {
        Ok(table) => Some((TimeFunction::Table(Arc::new(table)), dimension)),
        Err(error) => {
            c.report(c.diagnostic("E0117", error.to_string(), list.span.clone()));
            None
        }
    }
}
