//! Time functions.

use super::context::{Context, Fields};
use super::elements::allowed;
use super::names::Names;
use super::record::record;
use super::synthetic::{synthetic, too_much};
use super::tables::{points, table};
use crate::registry::Reader;
use crate::schema::{self, Block};
use crate::tree::{Entry, Kind};
use crate::{Custom, Function, Harmonic, TimeFunction};
use std::sync::Arc;
use trilith_element::dimension::NONE;
use trilith_element::{Card, Dimension, ReadFunction};

/// A function and the dimension of its values; no dimension for plain numbers.
pub(super) type Made = (TimeFunction, Option<Dimension>);

pub(super) fn functions(
    c: &Context<'_>,
    entries: &[Entry],
    names: &Names<'_>,
) -> Vec<Option<Function>> {
    if too_much(c, entries) {
        return entries.iter().map(|_| None).collect();
    }
    let mut made: Vec<Option<Made>> = Vec::new();
    let mut scaled: Vec<(usize, usize, f64, Option<Dimension>)> = Vec::new();
    for (i, e) in entries.iter().enumerate() {
        let offered = e.value.name().and_then(|name| c.registry.find(name));
        if let Some((card, Reader::Function(read))) = offered {
            made.push(custom(c, e, card, read));
            continue;
        }
        let kind = built_in(c, e);
        if kind.is_some_and(|k| k.name == schema::SCALED.name) {
            scaled.extend(reference(c, e, names).map(|(of, factor, d)| (i, of, factor, d)));
            made.push(None);
        } else {
            made.push(kind.and_then(|k| function(c, e, k)));
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
    let fields = c.block(&e.value, &what(e), &schema::SCALED)?;
    let of = fields.required(c, "function").and_then(|n| names.refer(c, n));
    let factor = fields.required(c, "factor").and_then(|n| c.quantity(n));
    let factor = factor?;
    Some((of?, factor.value, factor.measured.then_some(factor.dimension)))
}

pub(super) fn what(e: &Entry) -> String {
    format!("function `{}`", e.key)
}

/// The block that a value names; a name that there is not is answered with those of other crates as well.
fn built_in(c: &Context<'_>, e: &Entry) -> Option<&'static Block> {
    let mut names = schema::FUNCTIONS.names();
    names.extend(c.registry.functions().map(|card| card.kind));
    // Those of other crates have been looked for, as names.
    c.choice(&e.value, "function", &names).and_then(|i| schema::FUNCTIONS.blocks.get(i).copied())
}

/// A function that another crate offers.
fn custom(c: &Context<'_>, e: &Entry, card: &'static Card, read: &ReadFunction) -> Option<Made> {
    let what = what(e);
    let fields = c.fields(&e.value, &what, &allowed(card, &[schema::AMPLITUDE.name]))?;
    let at = e.value.name_span();
    let size = amplitude(c, &fields);
    let made = super::custom::made(c, &fields, (&what, &at), card, read);
    let ((amplitude, dimension), (values, waveform)) = (size?, made?);
    let waveform = Arc::from(waveform);
    let custom = Custom { amplitude, card, values, waveform };
    if let Some(fault) = custom.fault() {
        let message = format!("{what}: {} is no function of time: {fault}", card.kind);
        c.report(c.diagnostic("E0114", message, at));
        return None;
    }
    Some((TimeFunction::Custom(custom), dimension))
}

fn function(c: &Context<'_>, e: &Entry, kind: &'static Block) -> Option<Made> {
    let node = &e.value;
    let open = || c.block(node, &what(e), kind);
    match kind.name {
        "Constant" => {
            // `Constant(3)` as well as `Constant(value: 3)`.
            let value = match &node.kind {
                Kind::List(_, items) if items.len() == 1 => &items[0],
                _ => open()?.required(c, "value")?,
            };
            let q = c.quantity(value)?;
            Some((TimeFunction::Constant(q.value), q.measured.then_some(q.dimension)))
        }
        "Step" => {
            let fields = open()?;
            let (amplitude, dimension) = amplitude(c, &fields)?;
            let start = fields.number(c, "start")?;
            let end = fields.number_if(c, "end")?;
            if let (Some(end), Some(n)) = (end.filter(|end| *end <= start), fields.get("end")) {
                let message = format!("`end` = {end} s: must be after the start at {start} s");
                c.report(c.diagnostic("E0112", message, n.span.clone()));
                return None;
            }
            Some((TimeFunction::Step { amplitude, start, end }, dimension))
        }
        "Ramp" => {
            let fields = open()?;
            let (a, start) = (amplitude(c, &fields), fields.number(c, "start"));
            let rise = fields.number(c, "rise");
            let (amplitude, dimension) = a?;
            Some((TimeFunction::Ramp { amplitude, start: start?, rise: rise? }, dimension))
        }
        "Sine" | "Cosine" => {
            let (harmonic, dimension) = harmonic(c, &open()?)?;
            let f = if kind.name == "Sine" { TimeFunction::Sine } else { TimeFunction::Cosine };
            Some((f(harmonic), dimension))
        }
        "HalfSine" => {
            let fields = open()?;
            let (a, start) = (amplitude(c, &fields), fields.number(c, "start"));
            let duration = fields.number(c, "duration");
            let (amplitude, dimension) = a?;
            Some((
                TimeFunction::HalfSine { amplitude, duration: duration?, start: start? },
                dimension,
            ))
        }
        "Ricker" => {
            let fields = open()?;
            let (a, center) = (amplitude(c, &fields), fields.number(c, "center"));
            let frequency = fields.number(c, "frequency");
            let (amplitude, dimension) = a?;
            Some((
                TimeFunction::Ricker { amplitude, frequency: frequency?, center: center? },
                dimension,
            ))
        }
        "Table" => table(c, e),
        "Record" => record(c, e),
        "Synthetic" => synthetic(c, e),
        _ => points(c, e),
    }
}

fn amplitude(c: &Context<'_>, fields: &Fields<'_>) -> Option<(f64, Option<Dimension>)> {
    let q = c.quantity(fields.required(c, "amplitude")?)?;
    Some((q.value, q.measured.then_some(q.dimension)))
}

fn harmonic(c: &Context<'_>, fields: &Fields<'_>) -> Option<(Harmonic, Option<Dimension>)> {
    let (a, start) = (amplitude(c, fields), fields.number(c, "start"));
    let frequency = fields.number(c, "frequency");
    let cycles = fields.number_if(c, "cycles");
    let phase = fields.number(c, "phase");
    let (amplitude, dimension) = a?;
    let (frequency, cycles, start, phase) = (frequency?, cycles?, start?, phase?);
    Some((Harmonic { amplitude, frequency, cycles, start, phase }, dimension))
}
