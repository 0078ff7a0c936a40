//! Cases so long that the size of their results is told before they are made.

use crate::diagnostics;
use trilith::Model;
use trilith::model::{Analysis, Case, MOST_OUTPUT_STEPS, output_steps};
use trilith::results::ENERGIES;

/// Output steps from which on a case is long.
const LONG: f64 = 1e6;
/// Bytes of a number in memory and in `histories.npz`.
const BINARY: f64 = 8.0;
/// Bytes of a number in `histories.csv`, about.
const TEXT: f64 = 20.0;

/// A warning about the histories of a long case at an output step `dt` (s; none: its own). Of more steps than there may
/// be, an error tells.
pub(crate) fn warning(model: &Model, case: &Case, dt: Option<f64>) -> Option<String> {
    let Analysis::Dynamic(analysis) = &case.analysis else { return None };
    let steps = output_steps(analysis.duration, dt.unwrap_or(analysis.dt));
    if !(LONG..=MOST_OUTPUT_STEPS as f64).contains(&steps) {
        return None;
    }
    let numbers = steps * (1 + model.outputs.len() + ENERGIES.len()) as f64;
    let message = format!(
        "case \"{}\" has {steps} output steps: a run keeps about {} of histories in memory and writes about {}; a longer `dt` keeps fewer, `--no-files` none",
        case.name,
        size(BINARY * numbers),
        size((BINARY + TEXT) * numbers),
    );
    Some(diagnostics::warning(&message))
}

fn size(bytes: f64) -> String {
    if bytes < 1e9 { format!("{:.0} MB", bytes / 1e6) } else { format!("{:.1} GB", bytes / 1e9) }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn warned(duration: &str, dt: Option<f64>) -> Option<String> {
        let text = format!(
            r#"(
            nodes: {{ "a": (0, 0, 0) }},
            elements: {{ "m": Mass(node: "a", mass: 1) }},
            cases: {{ "c": Dynamic(duration: {duration}, dt: 0.01) }},
            outputs: {{ "x": Displacement(node: "a", dof: Ux) }},
        )"#
        );
        let model = trilith::read_text(&text, "m.ron", &trilith::registry(), &[]).unwrap();
        warning(&model, &model.cases[0], dt)
    }

    #[test]
    fn the_size_of_long_histories_is_told() {
        assert_eq!(warned("9999", None), None);
        let text = warned("10000", None).unwrap();
        // Twelve numbers a step: time, output, ten energies.
        for part in ["1000000 output steps", "about 96 MB", "about 336 MB"] {
            assert!(text.contains(part), "{part} in {text}");
        }
        assert!(warned("10000", Some(0.001)).unwrap().contains("10000000 output steps"));
        assert_eq!(warned("10000", Some(1.0)), None);
        // Beyond what a run makes at all.
        assert_eq!(warned("10000", Some(1e-5)), None);
    }
}
