//! Figures that a study asks for.

use super::names::Names;
use crate::column::Known;
use crate::{Drawing, schema};
use trilith::element::dimension::FREQUENCY;
use trilith::model::Model;
use trilith::model::file::{Context, Fields, Kind, Node, evaluate, expression_diagnostic};

pub(super) fn figures(
    c: &Context<'_>,
    node: &Node,
    names: &Names<'_>,
    model: &Model,
) -> Option<Vec<Drawing>> {
    if !node.is_list() {
        return c.wrong(node, "a list of figures `[ModeChart(…), …]`");
    }
    let all: Vec<_> = node.items().into_iter().map(|n| figure(c, n, names, model)).collect();
    all.into_iter().collect()
}

fn figure(c: &Context<'_>, node: &Node, names: &Names<'_>, model: &Model) -> Option<Drawing> {
    if node.name().is_none() {
        return c.wrong(node, &format!("a figure ({})", schema::FIGURES.names().join(", ")));
    }
    let kind = c.choice(node, "figure", &schema::FIGURES.names())?;
    let block = schema::FIGURES.blocks[kind];
    if names.is_combined && matches!(kind, 0 | 3) {
        let message = format!(
            "`{}` shows how bodies respond, which of a combination nobody knows",
            block.name
        );
        c.report(c.diagnostic("E0112", message, node.span.clone()));
        return None;
    }
    let fields = c.block(node, block.name, block)?;
    let number =
        |key: &str| fields.required(c, key).and_then(|n| names.number(c, n)).map(|(name, _)| name);
    let by = || fields.get("by").map_or(Some(None), |n| names.any(c, n).map(Some));
    match kind {
        0 => {
            let (x, y) = (number("mu"), number("acceleration"));
            let slenderness = fields.required(c, "slenderness").and_then(|n| pure(c, n, model));
            Some(Drawing::ModeChart { x: x?, y: y?, slenderness: slenderness? })
        }
        1 => {
            let (demand, intensity) = (number("demand"), number("intensity"));
            Some(Drawing::Ida { demand: demand?, intensity: intensity? })
        }
        2 => {
            let intensity = number("intensity");
            let event =
                fields.required(c, "event").and_then(|n| super::columns::condition(c, n, names));
            let confidence = fields.number(c, "confidence");
            let by = by();
            Some(Drawing::Fragility {
                intensity: intensity?,
                event: event?,
                confidence: confidence?,
                by: by?,
            })
        }
        3 => {
            let (frequency, amplitude) = (number("frequency"), number("amplitude"));
            let half_sine = fields.flag(c, "half_sine");
            Some(Drawing::Overturning {
                frequency: frequency?,
                amplitude: amplitude?,
                half_sine: half_sine?,
            })
        }
        4 => {
            let demand = number("demand");
            let rates = rates(c, &fields, names);
            let intensity = number("intensity");
            Some(Drawing::Hazard { demand: demand?, intensity: intensity?, rates: rates? })
        }
        5 => {
            let x = fields.required(c, "x").and_then(|n| names.any(c, n));
            let y = number("y");
            Some(Drawing::Spread { x: x?, y: y? })
        }
        _ => {
            let (x, y) = (number("x"), number("y"));
            let by = by();
            Some(Drawing::Points { x: x?, y: y?, by: by? })
        }
    }
}

/// A pure number above 0: an expression in the parameters of the model.
fn pure(c: &Context<'_>, node: &Node, model: &Model) -> Option<f64> {
    let q = match &node.kind {
        Kind::Text(text) => match evaluate(text, &mut Known::of(model)) {
            Ok(q) => q,
            Err(error) => {
                if let Some(e) = error {
                    c.report(expression_diagnostic(e, c.source(), node, text));
                }
                return None;
            }
        },
        _ => c.quantity(node)?,
    };
    if q.dimension.is_none() && q.value > 0.0 {
        return Some(q.value);
    }
    let message = format!("this is {} {}: must be a pure number above 0", q.value, q.dimension);
    c.report(c.diagnostic("E0112", message, node.span.clone()));
    None
}

/// `rates: [("0.1 g", "1e-2 1/s")]`: rates in 1/year as bare numbers.
fn rates(c: &Context<'_>, fields: &Fields<'_>, names: &Names<'_>) -> Option<Vec<(f64, f64)>> {
    const YEAR: f64 = 365.25 * 86_400.0;
    let Some(node) = fields.get("rates") else { return Some(Vec::new()) };
    let (_, dimension) = fields.get("intensity").and_then(|n| names.number(c, n))?;
    let mut all: Vec<(f64, f64)> = Vec::new();
    for item in node.items() {
        let pair = item.items();
        let [intensity, rate] = pair.as_slice() else {
            return c.wrong(item, "a pair (intensity, annual rate)");
        };
        let intensity = c.number(intensity, dimension)?;
        let q = c.quantity(rate)?;
        let value = if q.measured { c.in_dimension(rate, q, FREQUENCY)? * YEAR } else { q.value };
        let falls = all.last().is_none_or(|(i, r)| *i < intensity && *r > value);
        if !(falls && intensity > 0.0 && value > 0.0) {
            let message = "intensities must rise from above 0, and their rates fall";
            c.report(c.diagnostic("E0112", message, item.span.clone()));
            return None;
        }
        all.push((intensity, value));
    }
    if all.len() == 1 {
        c.report(c.diagnostic("E0112", "a hazard curve has two points or more", node.span.clone()));
        return None;
    }
    Some(all)
}
