//! Energies over time and at the end.

use super::{figure, value};
use crate::run::units::{number, percent, shown};
use crate::run::{RunData, figures};
use maud::{Markup, html};
use serde_json::Value;
use trilith_solvers::{EnergyTotals, StartEnergy};

/// The energies of a summary; one that is missing is none, as before there were those at the start.
fn totals(summary: &Value) -> EnergyTotals {
    let e = &summary["energy"];
    let of = |from: &Value, key: &str| from.get(key).map_or(0.0, value);
    let start = &e["start"];
    EnergyTotals {
        start: StartEnergy {
            kinetic: of(start, "kinetic"),
            strain: of(start, "strain"),
            link_stored: of(start, "link_stored"),
        },
        input: of(e, "input"),
        kinetic: of(e, "kinetic"),
        strain: of(e, "strain"),
        potential: of(e, "potential"),
        modal_damping: of(e, "modal_damping"),
        link_stored: of(e, "link_stored"),
        link_hysteretic: of(e, "link_hysteretic"),
        link_viscous: of(e, "link_viscous"),
        algorithmic: of(e, "algorithmic"),
        error: of(e, "error"),
        error_relative: of(e, "error_relative"),
    }
}

/// What was there and was put in, and what became of it.
fn balance(summary: &Value) -> Markup {
    let balance = totals(summary).balance();
    let whole = balance.whole();
    let s = shown("J", balance.largest());
    let all = balance.sources.iter().chain(&balance.uses);
    let rows: Vec<_> = all
        .map(|(words, e)| (*words, if balance.is_rounding(*e) { 0.0 } else { *e }))
        .filter(|(words, e)| *words == "input" || *e != 0.0)
        .collect();
    html! { table {
        thead { tr { th { "at the end" } th { (s.unit) } th { "of start + input" } } }
        tbody { @for (words, e) in &rows { tr {
            td { (words) } td.num { (number(e * s.factor)) }
            td.num { @if let Some(whole) = whole { (percent(e / whole)) } @else { "–" } }
        } } }
    } }
}

pub(super) fn energy(summary: &Value, data: &RunData, still: bool) -> Markup {
    let links = links(summary);
    // Of two kinds one may be nothing but rounding beside the other.
    let in_link = |x: f64, of: f64| if x.abs() < 1e-9 * of.abs() { 0.0 } else { x };
    let in_links = shown("J", links.first().map_or(0.0, |(_, h, v)| h + v));
    html! {
        div.figures.board {
            (figure(figures::energy_curves(data),
                "Friction and yielding is the energy of the links (NLlink), viscous that of their dashpots (Ndamp).", still))
            (figure(figures::energy_stack(data),
                "Stored and dissipated energies on top of each other; together they are what was there at the start and the input. What is negative goes downwards, such as a potential that was released.", still))
        }
        div.two {
            div { (balance(summary)) }
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

#[cfg(test)]
mod tests {
    use super::*;
    use serde_json::json;

    #[test]
    fn the_table_of_a_displaced_start_shows_what_was_there() {
        let energy = json!({
            "start": { "kinetic": 0.0, "strain": 75.0, "link_stored": 0.0 },
            "input": 5.0, "kinetic": 60.0, "strain": 4.0, "modal_damping": 16.0, "error": 0.0,
        });
        let html = balance(&json!({ "energy": energy })).into_string();
        for part in [
            "<td>at the start: strain</td><td class=\"num\">75.00</td><td class=\"num\">93.75 %</td>",
            "<td>input</td><td class=\"num\">5.000</td><td class=\"num\">6.25 %</td>",
            "<td>kinetic</td><td class=\"num\">60.00</td><td class=\"num\">75.00 %</td>",
            "of start + input",
        ] {
            assert!(html.contains(part), "{part} in\n{html}");
        }
        assert!(!html.contains("potential"), "{html}");
    }

    #[test]
    fn a_summary_without_energies_has_a_table_all_the_same() {
        let html = balance(&json!({})).into_string();
        assert!(html.contains("<td>input</td>") && html.contains("–"), "{html}");
    }
}
