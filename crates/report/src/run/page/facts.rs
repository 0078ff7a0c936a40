//! What the run came to, and what the reader should know of it.

use super::rounding::is_rounding;
use super::{text, value};
use crate::run::RunData;
use crate::run::units::{number, percent, shown};
use maud::{Markup, html};
use serde_json::Value;

/// A value beside the largest of its like.
fn measured(x: f64, unit: &str, largest: f64) -> String {
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
        measured(value(&c[key]), "m", all.into_iter().fold(0.0, f64::max))
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
            @for (words, what) in structure(summary) { (fact(words, what)) }
            (fact("energy unaccounted for", percent(value(&summary["energy"]["error_relative"]))))
        }
    }
}

/// What a structure did as a whole: base shear, drift, its bearings and stops, as words and values.
fn structure(summary: &Value) -> Vec<(&'static str, String)> {
    let there = |key: &str| summary.get(key).filter(|v| v.is_object());
    let mut all = Vec::new();
    if let Some(shear) = there("base_shear") {
        let max = [0, 1].map(|axis| value(&shear["max"][axis]));
        let largest = max[0].max(max[1]);
        let words = ["largest base shear X", "largest base shear Y"];
        let moved = words.into_iter().zip(max).filter(|(_, v)| !is_rounding(*v, "N", largest));
        all.extend(moved.map(|(words, v)| (words, measured(v, "N", largest))));
    }
    if let Some(drift) = there("drift") {
        let max = value(&drift["max"]);
        let share = percent(value(&drift["ratio"]));
        let of = text(&drift["output"]);
        all.push((
            "largest drift",
            format!("{} ({share} of the height), {of}", measured(max, "m", max)),
        ));
    }
    if let Some(bearings) = there("bearings") {
        let keys = ["max_travel", "residual_travel", "max_uplift"];
        let [travel, end, uplift] = keys.map(|key| value(&bearings[key]));
        let largest = travel.max(uplift);
        all.push(("largest travel of bearings", measured(travel, "m", largest)));
        all.push(("travel at the end", measured(end, "m", largest)));
        if uplift > 0.0 {
            all.push(("uplift of bearings", measured(uplift, "m", largest)));
        }
    }
    if let Some(stops) = there("stops") {
        let force = value(&stops["largest_force"]);
        all.push(("hits of stops", stops["hits"].to_string()));
        if force > 0.0 {
            all.push(("largest force of a stop", measured(force, "N", force)));
        }
    }
    all
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
