//! Columns, conditions and events.

use super::axes::map;
use super::names::{Names, unknown};
use crate::column::Known;
use crate::{Column, Condition, Measure, schema};
use trilith::element::Dimension;
use trilith::element::dimension::{LENGTH, MOMENT, NONE, TIME};
use trilith::model::Model;
use trilith::model::file::{Context, Entry, Kind, NoNames, Node, evaluate, expression_diagnostic};
use trilith::results::ENERGIES;

/// Columns that every table has.
const TAKEN: [&str; 8] =
    ["run", "sample", "member", "initial_mode", "mode", "overturned", "status", "message"];
/// The columns that a study asks for, or the peaks of all outputs.
pub(super) fn columns(c: &Context<'_>, node: Option<&Node>, model: &Model) -> Vec<Column> {
    let Some(node) = node else {
        let peak = |(i, o): (usize, &trilith::model::Output)| Column {
            name: format!("peak_{}", o.name),
            unit: o.unit.clone(),
            dimension: dimension(&o.unit),
            measure: Measure::Peak(i),
        };
        return model.shown().map(peak).collect();
    };
    let mut all: Vec<Column> = Vec::new();
    for e in map(c, node, "columns").unwrap_or_default() {
        let parameter = model.parameters.iter().any(|p| p.name == e.key);
        if parameter || TAKEN.contains(&e.key.as_str()) {
            let message = if parameter {
                format!("the model has a parameter `{}`: a column needs another name", e.key)
            } else {
                format!("every table has a column `{}`", e.key)
            };
            c.report(c.diagnostic("E0105", message, e.key_span.clone()));
        }
        let found = match &e.value.kind {
            Kind::Text(text) => expression(c, e, text, model, &all),
            _ => measure(c, e, model),
        };
        if let Some((measure, unit, dimension)) = found {
            all.push(Column { name: e.key.clone(), unit, dimension, measure });
        }
    }
    all
}

/// Columns of combinations: extremes, and what follows from them.
pub(super) fn check_combined(
    c: &Context<'_>,
    node: Option<&Node>,
    columns: &[Column],
    model: &Model,
) {
    let entries = node.and_then(|node| map(c, node, "columns")).unwrap_or_default();
    for column in columns {
        let Some(entry) = entries.iter().find(|e| e.key == column.name) else { continue };
        let message = match &column.measure {
            Measure::Peak(i) | Measure::Max(i) | Measure::Min(i) if model.outputs[*i].hidden => {
                format!(
                    "output \"{}\" is hidden: combinations leave it out",
                    model.outputs[*i].name
                )
            }
            Measure::Peak(_) | Measure::Max(_) | Measure::Min(_) | Measure::Expression(_) => {
                continue;
            }
            _ => format!("column `{}` is known of one case, and of no combination", column.name),
        };
        let help =
            "`Peak`, `Max` and `Min` of outputs that are shown are known, and expressions in them";
        c.report(c.diagnostic("E0112", message, entry.value.span.clone()).help(help));
    }
}

/// Dimension of a unit of an output.
fn dimension(unit: &str) -> Dimension {
    evaluate(&format!("1 {unit}"), &mut NoNames).map_or(NONE, |q| q.dimension)
}

type Found = (Measure, String, Dimension);

fn measure(c: &Context<'_>, e: &Entry, model: &Model) -> Option<Found> {
    let node = &e.value;
    if node.name().is_none() {
        return c.wrong(node, "a measure such as `Peak(\"slide\")`, or an expression in quotes,");
    }
    let kind = c.choice(node, "measure", &schema::MEASURES.names())?;
    let what = format!("column `{}`", e.key);
    let only = || match &node.kind {
        Kind::List(_, items) if items.len() == 1 => Some(&items[0]),
        _ => c.wrong(node, &format!("`{}`", schema::MEASURES.blocks[kind].example)),
    };
    let metres = |measure| Some((measure, "m".to_owned(), LENGTH));
    match kind {
        0..=5 => {
            let (i, unit) = output(c, only()?, model)?;
            let dimension = dimension(&unit);
            Some(match kind {
                0 => (Measure::Peak(i), unit, dimension),
                1 => (Measure::Max(i), unit, dimension),
                2 => (Measure::Min(i), unit, dimension),
                3 => (Measure::TimeOfPeak(i), "s".to_owned(), TIME),
                4 => (Measure::Final(i), unit, dimension),
                _ => (Measure::Rms(i), unit, dimension),
            })
        }
        6 => {
            let fields = c.block(node, &what, &schema::DURATION)?;
            let found = fields.required(c, "output").and_then(|n| output(c, n, model));
            let above = fields.required(c, "above");
            let ((i, unit), above) = (found?, above?);
            let above = c.number(above, dimension(&unit))?;
            Some((Measure::Duration(i, above), "s".to_owned(), TIME))
        }
        7 => {
            let node = only()?;
            let i = c.choice(node, "energy", &ENERGIES)?;
            Some((Measure::Energy(i), "J".to_owned(), MOMENT))
        }
        8 => Some((Measure::EnergyError, String::new(), NONE)),
        9 => metres(Measure::Uplift),
        10 => metres(Measure::Slip),
        _ => metres(Measure::ResidualSlip),
    }
}

fn output(c: &Context<'_>, node: &Node, model: &Model) -> Option<(usize, String)> {
    let Kind::Text(name) = &node.kind else {
        return c.wrong(node, "the name of an output in quotes");
    };
    let names: Vec<&str> = model.outputs.iter().map(|o| o.name.as_str()).collect();
    let found = names.iter().position(|n| n == name);
    if found.is_none() {
        unknown(c, node, "output", "outputs of the model", name, &names);
    }
    found.map(|i| (i, model.outputs[i].unit.clone()))
}

/// An expression in parameters and earlier columns, tried with numbers that make no round sums.
fn expression(
    c: &Context<'_>,
    e: &Entry,
    text: &str,
    model: &Model,
    before: &[Column],
) -> Option<Found> {
    let mut scope = Known::of(model);
    for (i, column) in before.iter().enumerate() {
        scope.add(&column.name, 0.731_058_5 + 0.017_3 * i as f64, column.dimension);
    }
    let measure = Measure::Expression(text.to_owned());
    match evaluate(text, &mut scope) {
        Ok(q) => {
            let unit = if q.dimension.is_none() { String::new() } else { q.dimension.unit() };
            Some((measure, unit, q.dimension))
        }
        // Numbers that do not fit may fit in a run; a row where they do not has no value.
        Err(Some(error)) if error.code == "E0112" => Some((measure, String::new(), NONE)),
        Err(Some(error)) => {
            c.report(expression_diagnostic(error, c.source(), &e.value, text));
            None
        }
        Err(None) => None,
    }
}

/// `events: { "slides 10 cm": Above("slide", "10 cm") }`.
pub(super) fn events(
    c: &Context<'_>,
    node: &Node,
    names: &Names<'_>,
) -> Option<Vec<(String, Condition)>> {
    let entries = map(c, node, "events")?.iter();
    let all: Vec<_> =
        entries.map(|e| Some((e.key.clone(), condition(c, &e.value, names)?))).collect();
    all.into_iter().collect()
}

/// A condition on a run.
pub(super) fn condition(c: &Context<'_>, node: &Node, names: &Names<'_>) -> Option<Condition> {
    if node.name().is_none() {
        return c.wrong(node, "a condition such as `Overturned` or `Above(\"slide\", \"10 cm\")`");
    }
    let kind = c.choice(node, "condition", &schema::CONDITIONS.names())?;
    let items: &[Node] = match &node.kind {
        Kind::List(_, items) => items,
        _ => &[],
    };
    if names.is_combined && matches!(kind, 1 | 5) {
        let message = "of a combination nobody knows how bodies respond: its cases do".to_owned();
        c.report(c.diagnostic("E0112", message, node.span.clone()));
        return None;
    }
    match (kind, items) {
        (0, []) => Some(Condition::All),
        (1, []) => Some(Condition::Overturned),
        (2, []) => Some(Condition::Failed),
        (3 | 4, [name, limit]) => {
            let (name, dimension) = names.column(c, name)?;
            let limit = c.number(limit, dimension)?;
            Some(if kind == 3 {
                Condition::Above(name, limit)
            } else {
                Condition::Below(name, limit)
            })
        }
        (5, [mode]) => {
            let i = c.choice(mode, "response mode", &schema::MODES)?;
            Some(Condition::Mode(schema::MODES[i].to_owned()))
        }
        (6, [_, ..]) => {
            let all: Vec<_> = items.iter().map(|n| condition(c, n, names)).collect();
            all.into_iter().collect::<Option<_>>().map(Condition::Any)
        }
        _ => c.wrong(node, &format!("`{}`", schema::CONDITIONS.blocks[kind].example)),
    }
}
