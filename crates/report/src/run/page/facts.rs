//! What the run came to, and what the reader should know of it.

use super::rounding::is_rounding;
use super::{text, value};
use crate::page::words;
use crate::run::units::{percent, short, shown};
use crate::run::{Answer, RunData};
use maud::{Markup, html};
use serde_json::Value;

/// A value and its error in the unit that suits the value, beside the largest of its unit.
fn measured(a: &Answer, largest: f64) -> (String, String) {
    if !a.text.is_empty() {
        return (a.text.clone(), String::new());
    }
    if is_rounding(a.value.abs(), &a.unit, largest) {
        let unit = shown(&a.unit, 0.0).unit;
        return (format!("0 {unit}").trim_end().to_owned(), String::new());
    }
    let degrees = 180.0 / std::f64::consts::PI;
    let s = match a.unit.as_str() {
        // Of tilts one thinks in degrees.
        "rad" => crate::run::Shown { unit: "°".into(), factor: degrees },
        "m/s^2" | "m/s²" => {
            crate::run::Shown { unit: "g".into(), factor: 1.0 / trilith_model::STANDARD_GRAVITY }
        }
        "1" => crate::run::Shown { unit: "%".into(), factor: 100.0 },
        unit => shown(unit, a.value.abs()),
    };
    let error = a.error.map_or(String::new(), |e| format!("± {}", short(e * s.factor, 2)));
    (format!("{} {}", short(a.value * s.factor, 4), s.unit), error)
}

fn card(a: &Answer, largest: f64) -> Markup {
    let (value, error) = measured(a, largest);
    let at = a.t.filter(|_| !value.starts_with("0 ")).map(|t| format!("at {} s", short(t, 4)));
    let notes: Vec<&str> = [a.note.as_str(), at.as_deref().unwrap_or("")]
        .into_iter()
        .filter(|n| !n.is_empty())
        .collect();
    html! {
        div.fact {
            span { (a.words) }
            b { (value) @if !error.is_empty() { " " small title="how far it may be off: certificate of the run" { (error) } } }
            @if !notes.is_empty() { span { (notes.join(", ")) } }
        }
    }
}

/// The head of the page: what was asked, then how the run went.
pub(super) fn facts(summary: &Value, data: &RunData) -> Markup {
    let status = text(&summary["status"]);
    let good = ["converged", "overturned"].contains(&status.as_str());
    let class = if good { "fact good" } else { "fact bad" };
    let largest = |unit: &str| {
        let same = data.answers.iter().filter(|a| a.unit == unit);
        same.fold(0.0_f64, |m, a| m.max(a.value.abs()))
    };
    let fact = |words: &str, what: String| html! { div.fact { span { (words) } b { (what) } } };
    html! {
        @if !data.answers.is_empty() {
            div.facts.answers { @for a in &data.answers { (card(a, largest(&a.unit))) } }
        }
        div.facts {
            div class=(class) { span { "status" } b { (status) } }
            (fact("case", text(&summary["case"])))
            (fact("solver", text(&summary["solver"])))
            (fact("energy unaccounted for", percent(value(&summary["energy"]["error_relative"]))))
            @if let Some((worst, of)) = certificate(summary) {
                div.fact {
                    span { "certificate: largest error of an output" }
                    b { (short(100.0 * worst, 2)) " %" } span { "of its range, " (of) }
                }
            }
        }
    }
}

/// The largest error of an output as a share of its range, and its name; none where nothing is certified.
fn certificate(summary: &Value) -> Option<(f64, String)> {
    let outputs = super::rounding::Outputs::of(summary);
    let all = summary["outputs"].as_object()?.iter();
    let share = |(name, o): (&String, &Value)| {
        let error = value(&o["error"]["reduction"]) + value(&o["error"]["step"]);
        let range = value(&o["max"]) - value(&o["min"]);
        let there = range > 0.0 && !outputs.is_rounding(name);
        Some((error / range, name.clone())).filter(|(e, _)| there && e.is_finite())
    };
    all.filter_map(share).max_by(|a, b| a.0.total_cmp(&b.0))
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
            div.warnings role="note" { b { "What to know" } ul { @for w in &all { li { (words(w)) } } } }
        }
        @for note in &data.notes { p.note { (words(note)) } }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_answer_has_its_error_in_its_unit_and_noise_is_zero() {
        let a = Answer {
            words: "largest drift".into(),
            value: 0.0123,
            unit: "m".into(),
            error: Some(1.3e-4),
            ..Answer::default()
        };
        assert_eq!(measured(&a, 0.0123), ("12.3 mm".into(), "± 0.13".into()));
        let tilt =
            Answer { value: 0.1, unit: "rad".into(), error: Some(1e-3), ..Answer::default() };
        assert_eq!(measured(&tilt, 0.1), ("5.73 °".into(), "± 0.057".into()));
        let noise =
            Answer { value: 3e-15, unit: "m".into(), error: Some(1e-9), ..Answer::default() };
        assert_eq!(measured(&noise, 0.2), ("0 m".into(), String::new()));
        let words = Answer { text: "slide-rock".into(), ..Answer::default() };
        assert_eq!(measured(&words, 0.0).0, "slide-rock");
    }
}
