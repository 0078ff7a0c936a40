//! A figure on a page: the still drawing, and the same as data for the script that takes its place.

use crate::Figure;
use crate::draw::drawing;
use maud::{Markup, PreEscaped, html};
use serde::Serialize;
use serde_json::Value;
use std::collections::BTreeMap;
use trilith_model::visible;

/// The script of all pages, in the order in which its parts build on each other.
pub(crate) const BEFORE: [&str; 4] = [
    include_str!("base.js"),
    include_str!("axes.js"),
    include_str!("chart.js"),
    include_str!("handle.js"),
];
/// What starts it, behind the scripts of a single page.
pub(crate) const START: &str = include_str!("start.js");

/// A cursor that asks for runs, for pages that compute.
pub(crate) const ASK: &str = include_str!("ask.js");

/// Points of all lines of a page up to which every one is told.
const WHOLE: usize = 60_000;
/// Of more, lines may leave their points by so many pixels of the still figure; of many more by the second.
const FINE: [f64; 2] = [0.03, 0.1];

/// One script in strict mode that leaves nothing behind in the page.
pub(crate) fn script(parts: &[&str]) -> Markup {
    let text: Vec<&str> = BEFORE.iter().chain(parts).copied().chain([START]).collect();
    let text = text.join("\n");
    html! { script { (PreEscaped(format!("(() => {{\n\"use strict\";\n{text}}})();\n"))) } }
}

/// How closely the script is told the lines of a page with so many points.
pub(crate) fn fine(points: usize) -> f64 {
    match points {
        0..=WHOLE => 0.0,
        n if n <= 8 * WHOLE => FINE[0],
        _ => FINE[1],
    }
}

/// Points of a figure.
pub(crate) fn size(figure: &Figure) -> usize {
    figure.series.iter().map(|s| s.points.len()).sum()
}

/// Ends of the vertical axes that still figures share, by the names of their scales.
#[derive(Debug, Default)]
pub(crate) struct Scales(BTreeMap<String, (f64, f64)>);

impl Scales {
    pub(crate) fn of<'a>(figures: impl Iterator<Item = &'a Figure>) -> Self {
        let mut all: BTreeMap<String, (f64, f64)> = BTreeMap::new();
        for figure in figures.filter(|f| !f.scale.is_empty() && !f.y.log && f.y.range.is_none()) {
            let ends =
                all.entry(figure.scale.clone()).or_insert((f64::INFINITY, f64::NEG_INFINITY));
            let points = figure.series.iter().flat_map(|s| &s.points).map(|p| p.1);
            points.filter(|y| y.is_finite()).for_each(|y| *ends = (ends.0.min(y), ends.1.max(y)));
        }
        Self(all)
    }

    /// The still figure, in its scale.
    fn svg(&self, figure: &Figure) -> String {
        match self.0.get(&figure.scale).filter(|e| e.0 < e.1) {
            None => figure.svg(),
            Some((low, high)) => {
                let room = 0.08 * (high - low);
                let mut figure = figure.clone();
                figure.y.range = Some((low - room, high + room));
                figure.svg()
            }
        }
    }
}

/// The figure, still and as data.
pub(crate) fn figure(figure: &Figure, fine: f64, scales: &Scales) -> Markup {
    html! {
        figure {
            (PreEscaped(scales.svg(figure)))
            (json("drawing", None, &drawing(figure, fine)))
            @if !figure.caption.is_empty() { figcaption { (figure.caption) } }
        }
    }
}

/// The figure as data alone.
pub(crate) fn alive(figure: &Figure, fine: f64) -> Markup {
    html! {
        figure {
            (json("drawing", None, &drawing(figure, fine)))
            @if !figure.caption.is_empty() { figcaption { (figure.caption) } }
        }
    }
}

/// Data in an element that they cannot end; control characters of their texts have to be written out before.
pub(crate) fn json(class: &str, id: Option<&str>, value: &impl Serialize) -> Markup {
    // Numbers, texts and lists: nothing that JSON does not have.
    let text = serde_json::to_string(value).unwrap_or_default();
    let text = text.replace('<', "\\u003c");
    html! { script type="application/json" class=[(!class.is_empty()).then_some(class)] id=[id] { (PreEscaped(text)) } }
}

/// The same with the control characters of its texts and names written out.
pub(crate) fn legible(value: Value) -> Value {
    match value {
        Value::String(text) => Value::String(visible(&text).into_owned()),
        Value::Array(items) => Value::Array(items.into_iter().map(legible).collect()),
        Value::Object(entries) => {
            let entry =
                |(key, value): (String, Value)| (visible(&key).into_owned(), legible(value));
            Value::Object(entries.into_iter().map(entry).collect())
        }
        other => other,
    }
}
