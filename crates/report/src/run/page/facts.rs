//! What the run came to, and what the reader should know of it.

use super::rounding::is_rounding;
use super::{text, value};
use crate::run::RunData;
use crate::run::units::{number, percent, shown};
use maud::{Markup, html};
use serde_json::Value;

/// A length beside the largest of its like.
fn measured(x: f64, largest: f64) -> String {
    let unit = "m";
    if is_rounding(x.abs(), unit, largest) {
        return format!("0 {unit}");
    }
    let s = shown(unit, x.abs());
    format!("{} {}", number(x * s.factor), s.unit)
}

pub(super) fn facts(summary: &Value) -> Markup {
    let status = text(&summary["status"]);
    let good = ["converged", "overturned"].contains(&status.as_str());
    let class = if good { "fact good" } else { "fact bad" };
    let contact = summary.get("contact").filter(|c| c.is_object());
    let length = |c: &Value, key: &str| {
        let all = ["max_uplift", "max_slip", "residual_slip"].map(|k| value(&c[k]).abs());
        measured(value(&c[key]), all.into_iter().fold(0.0, f64::max))
    };
    let fact = |words: &str, what: String| html! { div.fact { span { (words) } b { (what) } } };
    html! {
        div.facts {
            div class=(class) { span { "status" } b { (status) } }
            (fact("case", text(&summary["case"])))
            (fact("solver", text(&summary["solver"])))
            @if let Some(c) = contact {
                (fact("leaves rest by", text(&c["initial_mode"])))
                (fact("response mode", text(&c["mode"])))
                (fact("largest uplift", length(c, "max_uplift")))
                (fact("largest slip", length(c, "max_slip")))
                (fact("slip at the end", length(c, "residual_slip")))
            }
            (fact("energy unaccounted for", percent(value(&summary["energy"]["error_relative"]))))
        }
    }
}

pub(super) fn warnings(summary: &Value, data: &RunData) -> Markup {
    let mut all: Vec<String> = Vec::new();
    if summary["status"].as_str() != Some("converged") {
        all.extend(summary["message"].as_str().map(str::to_owned));
    }
    let warned = summary["warnings"].as_array().into_iter().flatten();
    all.extend(warned.filter_map(Value::as_str).map(str::to_owned));
    html! {
        @if !all.is_empty() {
            div.warnings role="note" { b { "What to know" } ul { @for w in &all { li { (w) } } } }
        }
        @for note in &data.notes { p.note { (note) } }
    }
}
