//! The extremes of the outputs.

use super::value;
use crate::run::RunData;
use crate::run::units::{number, shown};
use maud::{Markup, html};
use serde_json::Value;
use std::collections::BTreeMap;

/// Up to so many outputs, all are shown in the order of the model.
const WHOLE: usize = 60;
/// Of more, the largest of each unit, so many in all.
const LARGEST: usize = 40;
/// Rows that can be unfolded.
const FOLDED: usize = 2000;

/// Largest magnitude of an output; none where it was not recorded.
fn size(o: &Value) -> f64 {
    let all = ["max", "min", "final"].map(|k| value(&o[k]));
    all.iter().filter(|x| x.is_finite()).fold(0.0, |a: f64, x| a.max(x.abs()))
}

fn unit(o: &Value) -> &str {
    o["unit"].as_str().unwrap_or("")
}

/// Which outputs are shown at once, in the order of the model: of each unit the largest, the units by turns.
fn chosen(all: &[(&str, &Value)]) -> Vec<bool> {
    if all.len() <= WHOLE {
        return vec![true; all.len()];
    }
    let mut units: BTreeMap<&str, Vec<usize>> = BTreeMap::new();
    for (i, (_, o)) in all.iter().enumerate() {
        units.entry(unit(o)).or_default().push(i);
    }
    for of_unit in units.values_mut() {
        of_unit.sort_by(|a, b| size(all[*b].1).total_cmp(&size(all[*a].1)));
    }
    let longest = units.values().map(Vec::len).max().unwrap_or(0);
    let by_turns = (0..longest).flat_map(|k| units.values().filter_map(move |u| u.get(k)));
    let mut chosen = vec![false; all.len()];
    by_turns.take(LARGEST).for_each(|i| chosen[*i] = true);
    chosen
}

fn row(name: &str, o: &Value) -> Markup {
    let all = ["max", "min", "final"].map(|k| value(&o[k]));
    let size = size(o);
    let s = shown(unit(o), size);
    // Rounding beside the other values is nothing.
    let [max, min, last] =
        all.map(|x| number(if x.abs() < 1e-9 * size { 0.0 } else { x * s.factor }));
    let [at_max, at_min] = ["t_max", "t_min"].map(|k| number(value(&o[k])));
    html! { tr {
        td { (name) } td { (s.unit) } td.num { (max) } td.num { (at_max) } td.num { (min) } td.num { (at_min) } td.num { (last) }
    } }
}

fn table<'a>(rows: impl Iterator<Item = &'a (&'a str, &'a Value)>) -> Markup {
    html! { div.wide { table.peaks {
        thead { tr { th { "output" } th { "unit" } th { "max" } th { "at s" } th { "min" } th { "at s" } th { "final" } } }
        tbody { @for (name, o) in rows { (row(name, o)) } }
    } } }
}

pub(super) fn peaks(summary: &Value, data: &RunData) -> Markup {
    let outputs = &summary["outputs"];
    let all: Vec<(&str, &Value)> =
        data.outputs.iter().map(|name| (name.as_str(), &outputs[name])).collect();
    let chosen = chosen(&all);
    let some = |wanted: bool| {
        all.iter().zip(&chosen).filter(move |(_, c)| **c == wanted).map(|(row, _)| row)
    };
    let others = some(false).count();
    html! {
        p.note {
            "Over all substeps, not only at output times."
            @if others > 0 {
                " The " (all.len() - others) " largest of " (all.len()) " outputs, of each unit as many as of the others; all are in "
                code { "peaks.csv" } "."
            }
        }
        @if others > 0 {
            label.live { "Only outputs with " input type="search" data-filter="peaks"; " in their name" }
        }
        (table(some(true)))
        @if others > 0 {
            details {
                summary {
                    @if others <= FOLDED { "The other " (others) }
                    @else { "The next " (FOLDED) " of the other " (others) }
                }
                (table(some(false).take(FOLDED)))
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use serde_json::json;

    /// Forces of 1 N, 2 N … and, every fifth, displacements of 1 mm, 2 mm ….
    fn page(count: usize) -> String {
        let name = |i: usize| format!("out {i:03}");
        let output = |i: usize| {
            let (unit, scale) = if i.is_multiple_of(5) { ("m", 1e-3) } else { ("N", 1.0) };
            let x = -scale * (i + 1) as f64;
            json!({ "unit": unit, "max": 0.0, "t_max": 0.0, "min": x, "t_min": 1.0, "final": 0.0 })
        };
        let all: serde_json::Map<String, Value> =
            (0..count).map(|i| (name(i), output(i))).collect();
        let data = RunData { outputs: (0..count).map(name).collect(), ..RunData::default() };
        peaks(&json!({ "outputs": all }), &data).into_string()
    }

    #[test]
    fn a_few_outputs_are_all_shown() {
        let html = page(WHOLE);
        assert_eq!(html.matches("<tr><td>").count(), WHOLE);
        assert!(!html.contains("<details>") && !html.contains("data-filter"));
    }

    #[test]
    fn of_hundreds_the_largest_of_each_unit_are_shown_and_the_rest_is_folded() {
        let html = page(300);
        let (shown, folded) = html.split_once("<details>").unwrap();
        assert_eq!(shown.matches("<tr><td>").count(), LARGEST);
        assert_eq!(folded.matches("<tr><td>").count(), 300 - LARGEST);
        assert!(shown.contains("40 largest of 300 outputs") && shown.contains("peaks.csv"));
        // Half of them displacements: 295, 290 … 200; half forces, the smallest of them 300 - 25.
        for i in [299, 298, 295, 290, 200, 276] {
            assert!(shown.contains(&format!(">out {i:03}<")), "{i}");
        }
        for i in [195, 274, 0] {
            assert!(folded.contains(&format!(">out {i:03}<")), "{i}");
        }
        // In the order of the model.
        assert!(shown.find("out 200") < shown.find("out 299"));
    }

    #[test]
    fn thousands_are_limited_and_the_page_says_so() {
        let html = page(5000);
        assert_eq!(html.matches("<tr><td>").count(), LARGEST + FOLDED);
        assert!(html.contains("The next 2000 of the other 4960"));
    }
}
