//! The extremes of the outputs.

use super::rounding::{Outputs, size, unit};
use super::value;
use crate::run::RunData;
use crate::run::choice::{FIRST, chosen};
use crate::run::units::{number, short, shown};
use maud::{Markup, html};
use serde_json::Value;

/// Rows that can be unfolded.
const FOLDED: usize = 2000;

fn row(name: &str, o: &Value, nothing: bool) -> Markup {
    let all = ["max", "min", "final"].map(|k| value(&o[k]));
    let size = size(o);
    let s = shown(unit(o), size);
    // Rounding beside the other values is nothing.
    let [max, min, last] =
        all.map(|x| number(if x.abs() < 1e-9 * size { 0.0 } else { x * s.factor }));
    let [at_max, at_min] = ["t_max", "t_min"].map(|k| number(value(&o[k])));
    let [reduction, step] = ["reduction", "step"].map(|k| value(&o["error"][k]) * s.factor);
    let (off, parts) = if (reduction + step).is_finite() {
        (
            two_digits(reduction + step),
            format!("reduction {}, steps {}", two_digits(reduction), two_digits(step)),
        )
    } else {
        (String::new(), String::new())
    };
    if nothing {
        return html! { tr {
            td { (name) } td {} td.num { "≈ 0" } td.num { "–" } td.num { "≈ 0" } td.num { "–" } td.num { "≈ 0" } td {}
        } };
    }
    html! { tr {
        td { (name) } td { (s.unit) } td.num { (max) } td.num { (at_max) } td.num { (min) } td.num { (at_min) } td.num { (last) } td.num title=(parts) { (off) }
    } }
}

/// An error needs no more digits than these.
fn two_digits(x: f64) -> String {
    short(x, 2)
}

fn table<'a>(
    outputs: &Outputs<'_>,
    rows: impl Iterator<Item = &'a (&'a str, &'a Value)>,
) -> Markup {
    html! { div.wide { table.peaks {
        thead { tr { th { "output" } th { "unit" } th { "max" } th { "at s" } th { "min" } th { "at s" } th { "final" } th title="estimated error: reduction and steps" { "±" } } }
        tbody { @for (name, o) in rows { (row(name, o, outputs.is_rounding(name))) } }
    } } }
}

pub(super) fn peaks(summary: &Value, data: &RunData) -> Markup {
    let (outputs, beside) = (&summary["outputs"], Outputs::of(summary));
    let all: Vec<(&str, &Value)> =
        data.outputs.iter().map(|name| (name.as_str(), &outputs[name])).collect();
    let sizes: Vec<(&str, f64)> = all.iter().map(|(_, o)| (unit(o), size(o))).collect();
    let chosen = chosen(&sizes);
    let some = |wanted: bool| {
        all.iter().zip(&chosen).filter(move |(_, c)| **c == wanted).map(|(row, _)| row)
    };
    let others = some(false).count();
    html! {
        p.note {
            "Over all substeps, not only at output times."
            @if others > 0 {
                " Of " (all.len()) " outputs the first " (FIRST) " and the " (all.len() - others - FIRST)
                " largest are shown, of each unit as many as of the others; all are in "
                code { "peaks.csv" } "."
            }
        }
        @if others > 0 {
            label.live { "Only outputs with " input type="search" data-filter="peaks"; " in their name" }
        }
        (table(&beside, some(true)))
        @if others > 0 {
            details {
                summary {
                    @if others <= FOLDED { "The other " (others) }
                    @else { "The next " (FOLDED) " of the other " (others) }
                }
                (table(&beside, some(false).take(FOLDED)))
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::run::choice::{SHOWN, WHOLE};
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
        assert_eq!(shown.matches("<tr><td>").count(), SHOWN);
        assert_eq!(folded.matches("<tr><td>").count(), 300 - SHOWN);
        assert!(
            shown.contains("Of 300 outputs the first 8 and the 32 largest")
                && shown.contains("peaks.csv")
        );
        // Half of the largest are displacements: 295, 290 … 220; half forces: 299, 298 … 281.
        for i in [0, 7, 299, 298, 295, 290, 220, 281] {
            assert!(shown.contains(&format!(">out {i:03}<")), "{i}");
        }
        for i in [8, 215, 279] {
            assert!(folded.contains(&format!(">out {i:03}<")), "{i}");
        }
        // In the order of the model.
        assert!(shown.find("out 220") < shown.find("out 299"));
    }

    #[test]
    fn thousands_are_limited_and_the_page_says_so() {
        let html = page(5000);
        assert_eq!(html.matches("<tr><td>").count(), SHOWN + FOLDED);
        assert!(html.contains("The next 2000 of the other 4960"));
    }
}
