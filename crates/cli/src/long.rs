//! Cases so long that the size of their results is told before they are made, or that no memory has room for them.

use crate::{Failure, diagnostics};
use trilith::Model;
use trilith::model::{Analysis, Case, MOST_OUTPUT_STEPS, output_steps};
use trilith::results::ENERGIES;

/// Output steps from which on a case is long.
const LONG: f64 = 1e6;
/// Bytes of a number in memory and in `histories.npz`.
const BINARY: f64 = 8.0;
/// Bytes of a number in `histories.csv`, about.
const TEXT: f64 = 20.0;

/// Output steps of a case at an output step `dt` (s; none: its own), and the numbers that a run keeps of them.
fn numbers(model: &Model, case: &Case, dt: Option<f64>) -> Option<[f64; 2]> {
    let Analysis::Dynamic(analysis) = &case.analysis else { return None };
    let steps = output_steps(analysis.duration, dt.unwrap_or(analysis.dt));
    Some([steps, steps * (1 + model.shown().count() + ENERGIES.len()) as f64])
}

/// A warning about the histories of a long case at an output step `dt` (s; none: its own). Of more steps than there may
/// be, an error tells.
pub(crate) fn warning(model: &Model, case: &Case, dt: Option<f64>) -> Option<String> {
    let [steps, numbers] = numbers(model, case, dt)?;
    if !(LONG..=MOST_OUTPUT_STEPS as f64).contains(&steps) {
        return None;
    }
    let message = format!(
        "case \"{}\" has {steps} output steps: a run keeps about {} of histories in memory and writes about {}; a longer `dt` keeps fewer, `--no-files` none",
        case.name,
        size(BINARY * numbers),
        size((BINARY + TEXT) * numbers),
    );
    Some(diagnostics::warning(&message))
}

/// Refuses a run whose histories would not find room in the memory that is free: it would be ended from outside, and
/// nothing be left of it. `from`, `until`: where it goes on and where it stops, s; none: at its start, at its end.
pub(crate) fn refuse(
    model: &Model,
    case: &Case,
    dt: Option<f64>,
    [from, until]: [Option<f64>; 2],
) -> Result<(), Failure> {
    let Analysis::Dynamic(analysis) = &case.analysis else { return Ok(()) };
    let (Some([steps, numbers]), Some(free)) = (numbers(model, case, dt), free_memory()) else {
        return Ok(());
    };
    let time = until.unwrap_or(analysis.duration) - from.unwrap_or(0.0);
    let share = (time / analysis.duration).clamp(0.0, 1.0);
    fits(&case.name, share * steps, BINARY * share * numbers, free)
}

fn fits(case: &str, steps: f64, bytes: f64, free: f64) -> Result<(), Failure> {
    if steps > MOST_OUTPUT_STEPS as f64 || bytes <= free {
        return Ok(());
    }
    let message = format!(
        "case \"{case}\" has {steps} output steps, whose histories take {} of memory; {} are free",
        size(bytes),
        size(free)
    );
    let help = "a longer `dt` or fewer outputs take less, `--no-files` takes none";
    Err(Failure::input(&message, Some(help)))
}

/// Memory that may be had without swapping, bytes, where the system says so.
fn free_memory() -> Option<f64> {
    available(&std::fs::read_to_string("/proc/meminfo").ok()?)
}

/// What `/proc/meminfo` says of it.
fn available(text: &str) -> Option<f64> {
    let line = text.lines().find_map(|line| line.strip_prefix("MemAvailable:"))?;
    let kibibytes: f64 = line.trim().strip_suffix("kB")?.trim().parse().ok()?;
    Some(1024.0 * kibibytes)
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

    #[test]
    fn what_no_memory_has_room_for_is_refused() {
        let free = available("MemTotal:  32 kB\nMemAvailable:    2000000 kB\n").unwrap();
        assert_eq!(free, 2.048e9);
        assert!(fits("c", 2e7, 2e9, free).is_ok());
        let told = fits("c", 4.9e7, 121e9, free).unwrap_err().text;
        for part in ["49000000 output steps", "121.0 GB of memory; 2.0 GB are free", "`dt`"] {
            assert!(told.contains(part), "{part} in {told}");
        }
        assert_eq!(available("MemTotal: 1 kB"), None);
    }
}
