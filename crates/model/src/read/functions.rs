//! Time functions.

use super::context::{Context, Fields};
use super::names::Names;
use super::record::{Record, column};
use crate::tree::{Entry, Kind, Node};
use crate::{AfterEnd, Function, Harmonic, Interpolation, Span, Table, TableError, TimeFunction};
use std::sync::Arc;
use trilith_element::dimension::{FREQUENCY, NONE, TIME};
use trilith_element::{Dimension, Range};

const KINDS: [&str; 10] = [
    "Constant", "Step", "Ramp", "Sine", "Cosine", "HalfSine", "Ricker", "Table", "Points", "Scaled",
];
const HARMONIC: &[&str] = &["amplitude", "frequency", "cycles", "start", "phase"];

/// A function and the dimension of its values; no dimension for plain numbers.
type Made = (TimeFunction, Option<Dimension>);

pub(super) fn functions(
    c: &Context<'_>,
    entries: &[Entry],
    names: &Names<'_>,
) -> Vec<Option<Function>> {
    let mut made: Vec<Option<Made>> = Vec::new();
    let mut scaled: Vec<(usize, usize, f64, Option<Dimension>)> = Vec::new();
    for (i, e) in entries.iter().enumerate() {
        let kind = c.choice(&e.value, "function", &KINDS);
        if kind == Some(9) {
            scaled.extend(reference(c, e, names).map(|(of, factor, d)| (i, of, factor, d)));
            made.push(None);
        } else {
            made.push(kind.and_then(|k| function(c, e, KINDS[k])));
        }
    }
    // A scaled function may stand before the one it scales.
    loop {
        let before = scaled.len();
        scaled.retain(|(i, of, factor, dimension)| match made[*of].clone() {
            None => true,
            Some((f, d)) => {
                let d = match (d, *dimension) {
                    (None, None) => None,
                    (a, b) => Some(a.unwrap_or(NONE) * b.unwrap_or(NONE)),
                };
                made[*i] = Some((f.scaled(*factor), d));
                false
            }
        });
        if scaled.len() == before {
            break;
        }
    }
    for (i, ..) in scaled.iter().filter(|(i, ..)| runs_in_circle(*i, &scaled)) {
        let message = format!("function `{}` scales itself in the end", entries[*i].key);
        c.report(c.diagnostic("E0113", message, entries[*i].key_span.clone()));
    }
    let named = entries.iter().zip(made);
    named
        .map(|(e, m)| {
            m.map(|(function, dimension)| Function { name: e.key.clone(), function, dimension })
        })
        .collect()
}

fn runs_in_circle(start: usize, scaled: &[(usize, usize, f64, Option<Dimension>)]) -> bool {
    let mut at = start;
    for _ in 0..=scaled.len() {
        match scaled.iter().find(|(i, ..)| *i == at) {
            Some((_, of, ..)) => at = *of,
            None => return false,
        }
        if at == start {
            return true;
        }
    }
    false
}

fn reference(
    c: &Context<'_>,
    e: &Entry,
    names: &Names<'_>,
) -> Option<(usize, f64, Option<Dimension>)> {
    let fields = c.fields(&e.value, &what(e), &["function", "factor"])?;
    let of = fields.required(c, "function").and_then(|n| names.refer(c, n));
    let factor = fields.required(c, "factor").and_then(|n| c.quantity(n));
    let factor = factor?;
    Some((of?, factor.value, factor.measured.then_some(factor.dimension)))
}

fn what(e: &Entry) -> String {
    format!("function `{}`", e.key)
}

fn function(c: &Context<'_>, e: &Entry, kind: &str) -> Option<Made> {
    let node = &e.value;
    let open = |allowed: &[&str]| c.fields(node, &what(e), allowed);
    match kind {
        "Constant" => {
            // `Constant(3)` as well as `Constant(value: 3)`.
            let value = match &node.kind {
                Kind::List(_, items) if items.len() == 1 => &items[0],
                _ => open(&["value"])?.required(c, "value")?,
            };
            let q = c.quantity(value)?;
            Some((TimeFunction::Constant(q.value), q.measured.then_some(q.dimension)))
        }
        "Step" => {
            let fields = open(&["amplitude", "start", "end"])?;
            let (amplitude, dimension) = amplitude(c, &fields)?;
            let start = time(c, &fields, "start")?;
            let end = match fields.get("end") {
                Some(n) => Some((c.number(n, TIME)?, n)),
                None => None,
            };
            if let Some((end, n)) = end.filter(|(end, _)| *end <= start) {
                let message = format!("`end` = {end} s: must be after the start at {start} s");
                c.report(c.diagnostic("E0112", message, n.span.clone()));
                return None;
            }
            let end = end.map(|(end, _)| end);
            Some((TimeFunction::Step { amplitude, start, end }, dimension))
        }
        "Ramp" => {
            let fields = open(&["amplitude", "start", "rise"])?;
            let (a, start) = (amplitude(c, &fields), time(c, &fields, "start"));
            let rise = positive(c, &fields, "rise", TIME);
            let (amplitude, dimension) = a?;
            Some((TimeFunction::Ramp { amplitude, start: start?, rise: rise? }, dimension))
        }
        "Sine" | "Cosine" => {
            let (harmonic, dimension) = harmonic(c, &open(HARMONIC)?)?;
            let f = if kind == "Sine" { TimeFunction::Sine } else { TimeFunction::Cosine };
            Some((f(harmonic), dimension))
        }
        "HalfSine" => {
            let fields = open(&["amplitude", "duration", "start"])?;
            let (a, start) = (amplitude(c, &fields), time(c, &fields, "start"));
            let duration = positive(c, &fields, "duration", TIME);
            let (amplitude, dimension) = a?;
            Some((
                TimeFunction::HalfSine { amplitude, duration: duration?, start: start? },
                dimension,
            ))
        }
        "Ricker" => {
            let fields = open(&["amplitude", "frequency", "center"])?;
            let (a, center) = (amplitude(c, &fields), time(c, &fields, "center"));
            let frequency = positive(c, &fields, "frequency", FREQUENCY);
            let (amplitude, dimension) = a?;
            Some((
                TimeFunction::Ricker { amplitude, frequency: frequency?, center: center? },
                dimension,
            ))
        }
        "Table" => table(c, e),
        _ => points(c, e),
    }
}

fn amplitude(c: &Context<'_>, fields: &Fields<'_>) -> Option<(f64, Option<Dimension>)> {
    let q = c.quantity(fields.required(c, "amplitude")?)?;
    Some((q.value, q.measured.then_some(q.dimension)))
}

fn time(c: &Context<'_>, fields: &Fields<'_>, key: &str) -> Option<f64> {
    fields.get(key).map_or(Some(0.0), |n| c.number(n, TIME))
}

fn positive(c: &Context<'_>, fields: &Fields<'_>, key: &str, d: Dimension) -> Option<f64> {
    c.ranged(fields.required(c, key)?, key, d, Range::Positive)
}

fn harmonic(c: &Context<'_>, fields: &Fields<'_>) -> Option<(Harmonic, Option<Dimension>)> {
    let (a, start) = (amplitude(c, fields), time(c, fields, "start"));
    let frequency = positive(c, fields, "frequency", FREQUENCY);
    let cycles = match fields.get("cycles") {
        Some(n) => c.ranged(n, "cycles", NONE, Range::Positive).map(Some),
        None => Some(None),
    };
    let phase = fields.get("phase").map_or(Some(0.0), |n| c.number(n, NONE));
    let (amplitude, dimension) = a?;
    let (frequency, cycles, start, phase) = (frequency?, cycles?, start?, phase?);
    Some((Harmonic { amplitude, frequency, cycles, start, phase }, dimension))
}

fn style(c: &Context<'_>, fields: &Fields<'_>) -> Option<(Interpolation, AfterEnd)> {
    let interpolation = fields
        .get("interpolation")
        .map_or(Some(0), |n| c.choice(n, "interpolation", &["Linear", "Cubic"]));
    let after = fields
        .get("after_end")
        .map_or(Some(0), |n| c.choice(n, "end of a table", &["Error", "Zero", "Hold"]));
    Some((
        [Interpolation::Linear, Interpolation::Cubic][interpolation?],
        [AfterEnd::Error, AfterEnd::Zero, AfterEnd::Hold][after?],
    ))
}

fn table(c: &Context<'_>, e: &Entry) -> Option<Made> {
    let allowed = ["file", "time", "value", "unit", "scale", "skip", "interpolation", "after_end"];
    let fields = c.fields(&e.value, &what(e), &allowed)?;
    let style = style(c, &fields);
    let scale = fields.get("scale").map_or(Some(None), |n| c.quantity(n).map(Some));
    let unit = fields.get("unit").map_or(Some(None), |n| unit(c, n).map(Some));
    let skip = fields.get("skip").map_or(Some(0), |n| c.count(n, "skip", 0));
    let (times, values) =
        (column(c, fields.get("time"), "time", 0), column(c, fields.get("value"), "value", 1));
    let file = fields.required(c, "file")?;
    let path = file_name(c, file)?;
    let at = &file.span;
    let record = Record::read(c, &c.folder.join(path), skip?, at)?;
    let times = record.numbers(c, &times?, &place(&fields, "time", at))?;
    let mut values = record.numbers(c, &values?, &place(&fields, "value", at))?;
    let mut dimension: Option<Dimension> = None;
    for q in [unit?, scale?].into_iter().flatten() {
        values.iter_mut().for_each(|v| *v *= q.value);
        if q.measured {
            dimension = Some(dimension.unwrap_or(NONE) * q.dimension);
        }
    }
    let seconds = c.units.scale(TIME);
    let times = times.into_iter().map(|t| t * seconds).collect();
    let (interpolation, after_end) = style?;
    match Table::new(times, values, interpolation, after_end) {
        Ok(table) => Some((TimeFunction::Table(Arc::new(table)), dimension)),
        Err(error) => {
            let row = match error {
                TableError::Order { index, .. } | TableError::NotFinite(index) => index,
                _ => 0,
            };
            let message = format!("{}: {error}", record.place(row));
            c.report(c.diagnostic("E0117", message, at.clone()));
            None
        }
    }
}

fn place(fields: &Fields<'_>, key: &str, otherwise: &Span) -> Span {
    fields.get(key).map_or(otherwise.clone(), |n| n.span.clone())
}

/// A unit such as `"g"` or `"cm/s^2"`.
fn unit(c: &Context<'_>, node: &Node) -> Option<crate::expression::Quantity> {
    let text = c.text(node, "unit")?;
    // Behind a number a name is a unit, whatever parameters are called.
    let one = Node { span: node.span.clone(), kind: Kind::Text(format!("1 {text}")) };
    c.quantity(&one)
}

/// `"file.csv"`, or `Parameter("name")` of a text parameter.
fn file_name(c: &Context<'_>, node: &Node) -> Option<String> {
    match &node.kind {
        Kind::Text(name) => Some(name.clone()),
        Kind::List(Some(kind), items) if kind == "Parameter" && items.len() == 1 => {
            let name = c.text(&items[0], "Parameter")?;
            if let Some(text) = c.parameters().text(&name) {
                return Some(text.to_owned());
            }
            let message = format!("there is no text parameter `{name}`");
            let help = crate::diagnostic::names_help(
                &name,
                "text parameters",
                c.parameters().text_names(),
            );
            c.report(c.diagnostic("E0110", message, items[0].span.clone()).help(help));
            None
        }
        _ => c.wrong(node, "a file name in quotes or `Parameter(\"name\")`"),
    }
}

fn points(c: &Context<'_>, e: &Entry) -> Option<Made> {
    let fields = c.fields(&e.value, &what(e), &["points", "interpolation", "after_end"])?;
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
