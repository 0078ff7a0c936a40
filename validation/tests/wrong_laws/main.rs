//! Laws that are wrong on purpose, each before the conformance kit and in a run by every solver. None runs to a wrong
//! number that is called converged, none runs for ever, and what ends a run names the link, what is wrong with it, and
//! when.
//!
//! `cargo test --release -p trilith-validation --test wrong_laws -- --nocapture` prints the table.

mod law;
mod torn;

use law::{Fault, Wrong};
use std::panic::{AssertUnwindSafe, catch_unwind};
use trilith::element::conformance::Kit;
use trilith::{Analysis, Register, RunOptions, SolverKind};

const SOLVERS: [SolverKind; 3] = [SolverKind::Fna, SolverKind::Hht, SolverKind::FullNewton];

/// Substeps that a run takes at most: the sound law takes a few thousand.
const MOST: usize = 50_000;

/// Share of the largest displacement by which a wrong law may change it and still be called converged.
const NUMBER: f64 = 1e-2;

fn model(fault: Fault) -> String {
    format!(
        r#"(
            nodes: {{ "m": (0, 0, 0) }},
            supports: {{ "m": (Ux, Uy, Rx, Ry, Rz) }},
            elements: {{
                "mass": Mass(node: "m", mass: 100),
                "good": Wrong(node: "m", fault: Nothing),
                "w": Wrong(node: "m", fault: {fault:?}),
            }},
            loads: {{ "push": [(node: "m", dof: Uz, force: 1)] }},
            functions: {{ "sine": Sine(amplitude: 600, frequency: 1.5) }},
            cases: {{
                "press": Static(loads: ["push"]),
                "shake": Dynamic(
                    duration: 1.5, dt: 0.01, forces: [(load: "push", function: "sine")],
                ),
            }},
            outputs: {{ "u": Displacement(node: "m", dof: Uz) }},
        )"#
    )
}

/// How a static case ended, under a push beyond what the law holds.
fn press(fault: Fault) -> String {
    let mut kinds = trilith::registry();
    kinds.link::<Wrong>();
    let text = model(fault).replace("force: 1)", "force: 700)").replace(
        "\"mass\": Mass(node: \"m\", mass: 100),",
        "\"mass\": Mass(node: \"m\", mass: 100), \"frame\": Spring(node: \"m\", k1: 1e4),",
    );
    let model = trilith::read_text(&text, "wrong.ron", &kinds, &[]).expect("a model");
    match trilith::run(&model, "press") {
        Ok(run) => run.result.status.text(),
        Err(e) => e.to_string(),
    }
}

#[test]
fn where_no_time_goes_on_the_name_is_told_as_well() {
    assert_eq!(press(Fault::Nothing), "converged");
    for (fault, what) in [
        (Fault::ForceNan, "force of U1 is NaN"),
        (Fault::StoredNan, "stored energy is NaN"),
        (Fault::HistoryNan, "history `slip`, if it was written, is NaN"),
        (Fault::PanicOfSlip, "panicked"),
    ] {
        let text = press(fault);
        assert!(text.starts_with("the law of \"w\" "), "{fault:?}: {text}");
        assert!(text.contains(what) && text.contains("case \"press\""), "{fault:?}: {text}");
    }
}

/// How a run ended.
struct End {
    good: bool,
    text: String,
    /// Largest displacement, m.
    number: f64,
    tried: usize,
}

fn run(fault: Fault, solver: SolverKind) -> End {
    let mut kinds = trilith::registry();
    kinds.link::<Wrong>();
    let text = model(fault);
    let model = trilith::read_text(&text, "wrong.ron", &kinds, &[]).expect("a model");
    let none = |text: String| End { good: false, text, number: f64::NAN, tried: 0 };
    let analysis = match Analysis::new(&model) {
        Ok(analysis) => analysis,
        Err(e) => return none(e.to_string()),
    };
    let options = RunOptions {
        case: model.case("shake").expect("a case"),
        solver: Some(solver),
        substeps: Some(MOST),
        // The march that measures them runs beside the other: what a law remembers would be mixed as threads take turns.
        step_errors: !fault.remembers(),
        ..RunOptions::default()
    };
    match analysis.run(options) {
        Ok(run) => {
            let peak = run.peak("u").expect("an output");
            End {
                good: run.result.status.is_good(),
                text: run.result.status.text(),
                number: peak.max.abs().max(peak.min.abs()),
                tried: run.result.work.substeps + run.result.work.rejected,
            }
        }
        Err(e) => none(e.to_string()),
    }
}

/// What the kit says; none where it finds nothing.
fn kit(fault: Fault) -> Option<String> {
    let law = Wrong::new(fault);
    let kit = Kit::new(&[0.03], 1.5);
    match catch_unwind(AssertUnwindSafe(|| kit.check(&law))) {
        Ok(found) => found.err().map(|e| e.to_string()),
        Err(_) => Some("panicked".into()),
    }
}

#[test]
fn no_wrong_law_ends_with_a_wrong_number() {
    let sound = SOLVERS.map(|solver| run(Fault::Nothing, solver).number);
    assert!(sound.iter().all(|x| (x / sound[0] - 1.0).abs() < 1e-3), "{sound:?}");
    let mut broken = Vec::new();
    assert!(Fault::ALL.len() > 36);
    for fault in Fault::ALL.iter().copied() {
        println!("\n{fault:?}: {}", fault.what());
        let found = kit(fault);
        println!("    {:<12} {}", "kit", found.as_deref().unwrap_or("conforms"));
        if found.is_some() != (fault != Fault::Nothing) {
            broken.push(format!("{fault:?}: the kit says {found:?}"));
        }
        for (solver, sound) in SOLVERS.into_iter().zip(sound) {
            let End { good, text, number, tried } = run(fault, solver);
            let off = (number / sound - 1.0).abs();
            let number =
                if good { format!(", off by {:.2} %", 100.0 * off) } else { String::new() };
            println!("    {:<12} {text}{number} ({tried} substeps)", solver.name());
            let when = ["t = ", "case \"shake\"", "element \"w\""];
            let told = text.contains("\"w\"") && when.iter().any(|when| text.contains(when));
            if good && off >= NUMBER || !good && !told || tried >= MOST {
                broken.push(format!("{fault:?}, {}: {text}{number}, {tried}", solver.name()));
            }
        }
    }
    assert!(broken.is_empty(), "{}", broken.join("\n"));
}
