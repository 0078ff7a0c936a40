//! Floor spectra.

use super::context::Context;
use super::motion::{nodal_dimension, unit};
use super::names::Names;
use crate::schema;
use crate::tree::{Entry, Kind, Node};
use crate::{FloorSpectrum, NodalTerm, Output, Quantity};
use trilith_element::dimension::{FREQUENCY, NONE, TIME};
use trilith_element::{Dimension, Range};

/// Frequencies where none are given, Hz, and their number.
const FREQUENCIES: (f64, f64, usize) = (0.2, 50.0, 100);

/// The spectra, each on an output with the absolute acceleration of its node; one that the model has no output
/// for is added to `outputs`.
pub(super) fn spectra(
    c: &Context<'_>,
    entries: &[Entry],
    nodes: &Names<'_>,
    outputs: &mut Vec<Option<Output>>,
) -> Vec<Option<FloorSpectrum>> {
    entries.iter().map(|e| one(c, e, nodes, outputs)).collect()
}

fn one(
    c: &Context<'_>,
    e: &Entry,
    nodes: &Names<'_>,
    outputs: &mut Vec<Option<Output>>,
) -> Option<FloorSpectrum> {
    let what = format!("spectrum `{}`", e.key);
    let fields = c.block(&e.value, &what, schema::SPECTRA.blocks[0])?;
    let node = fields.required(c, "node").and_then(|n| nodes.refer(c, n));
    let dof = fields.required(c, "dof").and_then(|n| c.dof(n).map(|d| (d, n)));
    let damping = match fields.get("damping") {
        None => Some(vec![0.05]),
        Some(n) => list(c, n, "damping", NONE, Range::Within(0.0, 0.9)),
    };
    let periods = match (fields.get("periods"), fields.get("frequencies")) {
        (Some(_), Some(n)) => {
            let message = format!("{what} has `periods` and `frequencies`");
            c.report(c.diagnostic("E0102", message, n.span.clone()).help("keep one of the two"));
            None
        }
        (Some(n), None) => series(c, n, "periods", TIME),
        (None, Some(n)) => {
            series(c, n, "frequencies", FREQUENCY).map(|f| f.iter().map(|f| 1.0 / f).collect())
        }
        (None, None) => {
            let (from, to, n) = FREQUENCIES;
            Some(trilith_record::measure::periods(1.0 / to, 1.0 / from, n))
        }
    };
    let (dof, dof_node) = dof?;
    if dof.is_rotation() {
        let message = format!("{what} is of a rotation");
        let d = c.diagnostic("E0106", message, dof_node.span.clone());
        c.report(d.help("a floor spectrum is of Ux, Uy or Uz"));
        return None;
    }
    let quantity = Quantity::Acceleration {
        terms: vec![NodalTerm { node: node?, dof, factor: 1.0 }],
        absolute: true,
    };
    let found = outputs.iter().position(|o| o.as_ref().is_some_and(|o| o.quantity == quantity));
    let output = found.unwrap_or_else(|| {
        let plain = format!("{} acceleration", e.key);
        let taken = |n: &str| outputs.iter().flatten().any(|o| o.name == n);
        let (mut name, mut i) = (plain.clone(), 2);
        while taken(&name) {
            (name, i) = (format!("{plain} {i}"), i + 1);
        }
        let unit = unit(nodal_dimension(2, false), false);
        outputs.push(Some(Output { name, unit, quantity, hidden: false }));
        outputs.len() - 1
    });
    Some(FloorSpectrum { name: e.key.clone(), output, damping: damping?, periods: periods? })
}

/// One number or a list of numbers.
fn list(
    c: &Context<'_>,
    node: &Node,
    name: &str,
    dimension: Dimension,
    range: Range,
) -> Option<Vec<f64>> {
    let items = node.items();
    if items.is_empty() {
        c.report(c.diagnostic("E0104", format!("`{name}` is empty"), node.span.clone()));
        return None;
    }
    let read: Vec<_> = items.into_iter().map(|n| c.ranged(n, name, dimension, range)).collect();
    read.into_iter().collect()
}

/// A list of numbers, or `(from: …, to: …, count: …)` in even steps of the logarithm.
fn series(c: &Context<'_>, node: &Node, name: &str, dimension: Dimension) -> Option<Vec<f64>> {
    if !matches!(&node.kind, Kind::Fields(None, entries) if !entries.is_empty()) {
        return list(c, node, name, dimension, Range::Positive);
    }
    let fields = c.block(node, &format!("`{name}`"), schema::SERIES.blocks[0])?;
    // Times or frequencies, as the field wants that holds them.
    let end = |key: &str| {
        fields.required(c, key).and_then(|n| c.ranged(n, key, dimension, Range::Positive))
    };
    let (from, to) = (end("from"), end("to"));
    let count = fields.count(c, "count");
    let (from, to, count) = (from?, to?, count?);
    if to <= from || count > 10_000 {
        let message = format!("`{name}`: `to` must be above `from`, and `count` at most 10000");
        c.report(c.diagnostic("E0112", message, node.span.clone()));
        return None;
    }
    Some(trilith_record::measure::periods(from, to, count))
}
