//! What is nothing but rounding, and should not look like a result.

use super::value;
use serde_json::Value;
use std::collections::BTreeMap;

/// Beside values of the same unit that are so much larger.
const SHARE: f64 = 1e-9;
/// Of lengths and angles also by themselves, m and rad: far less than an atom.
const ALONE: f64 = 1e-12;

/// True for a magnitude that is nothing beside the largest of its unit.
pub(super) fn is_rounding(size: f64, unit: &str, largest: f64) -> bool {
    size < SHARE * largest || (["m", "rad"].contains(&unit) && size < ALONE)
}

/// Largest magnitude of an output; 0 where it was not recorded.
pub(super) fn size(o: &Value) -> f64 {
    let all = ["max", "min", "final"].map(|k| value(&o[k]));
    all.iter().filter(|x| x.is_finite()).fold(0.0, |a: f64, x| a.max(x.abs()))
}

/// SI unit of an output.
pub(super) fn unit(o: &Value) -> &str {
    o["unit"].as_str().unwrap_or("")
}

/// The outputs of a summary, each beside the largest of its unit.
pub(super) struct Outputs<'a> {
    all: &'a Value,
    largest: BTreeMap<&'a str, f64>,
}

impl<'a> Outputs<'a> {
    pub fn of(summary: &'a Value) -> Self {
        let all = &summary["outputs"];
        let mut largest: BTreeMap<&str, f64> = BTreeMap::new();
        for (_, o) in all.as_object().into_iter().flatten() {
            let of_unit = largest.entry(unit(o)).or_insert(0.0);
            *of_unit = of_unit.max(size(o));
        }
        Self { all, largest }
    }

    /// True for an output that moved by nothing but rounding; false for one that did not move at all.
    pub fn is_rounding(&self, name: &str) -> bool {
        let o = &self.all[name];
        let largest = self.largest.get(unit(o)).copied().unwrap_or(0.0);
        size(o) > 0.0 && is_rounding(size(o), unit(o), largest)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use serde_json::json;

    #[test]
    fn what_is_tiny_beside_its_like_or_less_than_an_atom_is_rounding() {
        let output = |unit: &str, x: f64| json!({ "unit": unit, "max": x, "min": 0, "final": 0 });
        let summary = json!({ "outputs": {
            "drop": output("m", 3.7), "slide": output("m", -4e-15), "wave": output("m", 1e-6),
            "turn": output("rad", 7e-15), "still": output("m", 0.0),
            "push": output("N", 1e-6), "shove": output("N", 1e6), "lone": output("kg", 1e-20),
        } });
        let outputs = Outputs::of(&summary);
        let found: Vec<&str> = ["drop", "slide", "wave", "turn", "still", "push", "shove", "lone"]
            .into_iter()
            .filter(|name| outputs.is_rounding(name))
            .collect();
        assert_eq!(found, ["slide", "turn", "push"]);
    }
}
