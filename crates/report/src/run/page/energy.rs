//! Energies over time and at the end.

use super::{figure, value};
use crate::run::units::{number, percent, shown};
use crate::run::{RunData, figures};
use maud::{Markup, html};
use serde_json::Value;

/// Names, words and colours of the energies that can be seen, for the script.
fn kinds(data: &RunData) -> String {
    let all: Vec<[String; 3]> = figures::seen(data)
        .into_iter()
        .map(|(h, words, c)| {
            [h.name.clone(), words.to_owned(), format!("#{:02x}{:02x}{:02x}", c.0, c.1, c.2)]
        })
        .collect();
    serde_json::to_string(&all).unwrap_or_default()
}

pub(super) fn energy(summary: &Value, data: &RunData) -> Markup {
    let e = &summary["energy"];
    let input = value(&e["input"]);
    let largest =
        e.as_object().into_iter().flatten().fold(0.0_f64, |a, (k, x)| {
            if k == "error_relative" { a } else { a.max(value(x).abs()) }
        });
    let rows = [("input", "input")]
        .into_iter()
        .chain(figures::KINDS.iter().map(|(k, w, _)| (*k, *w)))
        .chain([("error", "unaccounted for")]);
    let rows: Vec<_> =
        rows.filter(|(k, _)| *k == "input" || value(&e[*k]).abs() > 1e-9 * largest).collect();
    let s = shown("J", largest);
    let (links, kinds) = (links(summary), kinds(data));
    // Of two kinds one may be nothing but rounding beside the other.
    let in_link = |x: f64, of: f64| if x.abs() < 1e-9 * of.abs() { 0.0 } else { x };
    let in_links = shown("J", links.first().map_or(0.0, |(_, h, v)| h + v));
    html! {
        div.figures.board {
            (figure("energy curves", &figures::energy_curves(data),
                "Friction and yielding is the energy of the links (NLlink), viscous that of their dashpots (Ndamp).", Some(&kinds)))
            (figure("energy stack", &figures::energy_stack(data),
                "Stored and dissipated energies on top of each other; together they are the input. Changes that are negative go downwards.", Some(&kinds)))
        }
        div.two {
            div { table {
                thead { tr { th { "at the end" } th { (s.unit) } th { "of input" } } }
                tbody { @for (k, words) in &rows { tr {
                    td { (words) } td.num { (number(value(&e[*k]) * s.factor)) }
                    td.num { @if input > 1e-9 * largest { (percent(value(&e[*k]) / input)) } @else { "–" } }
                } } }
            } }
            @if !links.is_empty() { div { table {
                thead { tr { th { "link" } th { "friction, yielding [" (in_links.unit) "]" } th { "viscous [" (in_links.unit) "]" } } }
                tbody { @for (name, h, v) in &links { tr { td { (name) } td.num { (number(in_link(*h, h + v) * in_links.factor)) } td.num { (number(in_link(*v, h + v) * in_links.factor)) } } } }
            } } }
        }
    }
}

/// The links that dissipate most.
fn links(summary: &Value) -> Vec<(String, f64, f64)> {
    const COUNT: usize = 12;
    let all = summary["link_energy"].as_object().into_iter().flatten();
    let mut all: Vec<_> = all
        .map(|(name, e)| (name.clone(), value(&e["hysteretic"]), value(&e["viscous"])))
        .filter(|(_, h, v)| h + v != 0.0)
        .collect();
    all.sort_by(|a, b| (b.1 + b.2).total_cmp(&(a.1 + a.2)));
    all.truncate(COUNT);
    all
}
