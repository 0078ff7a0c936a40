//! Records: columns of files, and accelerograms in any format.

use super::accelerogram::{processing, table_of};
use super::context::{Context, Fields};
use super::functions::{Made, what};
use super::tables::{after_end, file_name, unit};
use crate::Span;
use crate::diagnostic::names_help;
use crate::schema;
use crate::tree::{Entry, Kind, Node};
use std::path::Path;
use trilith_element::dimension::ACCELERATION;
use trilith_record::{Column, Columns, Component, Format, Problem, ReadError, ReadOptions};

/// A column as the file names it.
pub(super) fn column(
    c: &Context<'_>,
    node: Option<&Node>,
    name: &str,
    default: usize,
) -> Option<Column> {
    match node.map(|n| (&n.kind, n)) {
        None => Some(Column::Position(default)),
        Some((Kind::Text(header), _)) => Some(Column::Header(header.clone())),
        Some((_, node)) => c.count(node, name, 0).map(Column::Position),
    }
}

/// Reads columns; errors are told at `at` in the model.
pub(super) fn columns(c: &Context<'_>, path: &Path, skip: usize, at: &Span) -> Option<Columns> {
    Columns::read(path, skip).map_err(|e| report(c, &e, at)).ok()
}

/// The numbers of a column; errors are told at `at` in the model.
pub(super) fn numbers(
    c: &Context<'_>,
    columns: &Columns,
    column: &Column,
    at: &Span,
) -> Option<Vec<f64>> {
    columns.numbers(column).map_err(|e| report(c, &e, at)).ok()
}

/// Tells what is wrong with a file at a place of the model.
fn report(c: &Context<'_>, error: &ReadError, at: &Span) {
    let mut d = c.diagnostic("E0117", error.to_string(), at.clone());
    d.help = match &error.problem {
        Problem::Unreadable(_) => Some("the path counts from the folder of the model file".into()),
        Problem::UnknownColumn { name, all } => {
            Some(names_help(name, "columns", all.iter().map(String::as_str)))
        }
        Problem::NoUnit => Some("give `unit: \"…\"`, or state it in the file".into()),
        Problem::NoStep => Some("give `dt: …`, or a column of times".into()),
        Problem::Counts => Some("give `unit: \"…\"`: the acceleration of one count".into()),
        Problem::SeveralComponents(all) => {
            Some(format!("choose one by `component`: {}", list(all)))
        }
        Problem::UnknownComponent { name, all } => Some(match all.len() {
            0..=1 => format!("the only one is {}; leave `component` out", list(all)),
            _ => format!("there is no `{name}`; choose one of {}", list(all)),
        }),
        _ => error.help(),
    };
    c.report(d);
}

fn list(names: &[String]) -> String {
    let one = |(i, n): (usize, &String)| format!("{} `{n}`", i + 1);
    names.iter().enumerate().map(one).collect::<Vec<_>>().join(", ")
}

/// `Record(file: "x.at2", …)`: an accelerogram, processed.
pub(super) fn record(c: &Context<'_>, e: &Entry) -> Option<Made> {
    let fields = c.block(&e.value, &what(e), &schema::RECORD)?;
    let processing = processing(c, &fields, &what(e));
    let after_end = after_end(c, &fields);
    let start = fields.number(c, "start");
    let options = options(c, &fields);
    let component = match fields.get("component") {
        None => Some(None),
        Some(n) => component(c, n).map(Some),
    };
    let file = fields.required(c, "file")?;
    let path = c.file(&file_name(c, file)?, file);
    let (component, options) = (component?, options?);
    // The factor differs from run to run and comes last.
    let mut processing = processing?;
    let factor = processing.scale.take();
    let read = || {
        let all = trilith_record::read(&path, &options)?;
        trilith_record::select(all, component.as_ref(), &path)
    };
    let make = || match read() {
        Ok(record) => processing.apply(&record).map_err(|error| {
            let message = format!("{}: {error}", what(e));
            c.report(c.diagnostic("E0117", message, e.value.name_span()));
        }),
        Err(error) => {
            let key = match error.problem {
                Problem::UnknownComponent { .. } => "component",
                Problem::UnitConflict { .. } => "unit",
                Problem::StepConflict { .. } | Problem::BadStep(_) => "dt",
                _ => "file",
            };
            let at = fields.get(key).unwrap_or(file);
            report(c, &error, &at.span);
            Err(())
        }
    };
    let key = format!("{path:?} {options:?} {component:?} {processing:?}");
    let record = c.motions.records.get(key, make).ok()?;
    table_of(c, e, &record, factor, start?, after_end?)
}

fn options(c: &Context<'_>, fields: &Fields<'_>) -> Option<ReadOptions> {
    let format = match fields.get("format") {
        None => Some(None),
        Some(n) => c.choice(n, "format", &schema::FORMATS).map(|i| Some(Format::ALL[i])),
    };
    let unit = match fields.get("unit") {
        None => Some(None),
        Some(n) => unit(c, n).and_then(|q| c.in_dimension(n, q, ACCELERATION)).map(Some),
    };
    let dt = fields.number_if(c, "dt");
    Some(ReadOptions { format: format?, unit: unit?, dt: dt? })
}

/// A component by number, name, or `Parameter("name")` of a text parameter.
fn component(c: &Context<'_>, node: &Node) -> Option<Component> {
    match &node.kind {
        Kind::Text(name) => Some(Component::Name(name.clone())),
        Kind::List(Some(_), _) => file_name(c, node).map(Component::Name),
        _ => c.count(node, "component", 1).map(Component::Number),
    }
}
