//! Laws that are wrong on purpose, each before the conformance kit and in a run by every solver. None runs to a wrong
//! number that is called converged, none runs for ever, and what ends a run names the link, what is wrong with it, and
//! when.
//!
//! The table of all that stands on a page of the guide; `TRILITH_UPDATE=1 cargo test --release -p trilith-validation --test
//! wrong_laws` writes it there.

mod law;
mod page;
mod torn;

use law::{Fault, Wrong};
use std::panic::{AssertUnwindSafe, catch_unwind};
use trilith::element::conformance::Kit;
use trilith::sweep::{Engine, Sweep};
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
    run_of(&model(fault), fault, solver)
}

fn run_of(text: &str, fault: Fault, solver: SolverKind) -> End {
    let mut kinds = trilith::registry();
    kinds.link::<Wrong>();
    let model = trilith::read_text(text, "wrong.ron", &kinds, &[]).expect("a model");
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

/// In a sweep laws are asked lane by lane, and less is watched there: where something is wrong the ordinary engine has the
/// last word.
#[test]
fn no_wrong_law_ends_a_sweep_with_a_wrong_number() {
    let ends = |fault: Fault| -> Vec<(Option<Engine>, End)> {
        let text = model(fault).replacen("(\n", "(\n parameters: { \"a\": 600 },\n", 1);
        let text = text.replacen("amplitude: 600", "amplitude: \"a\"", 1);
        let text = text.replacen("dt: 0.01,", &format!("dt: 0.01, substep_limit: {MOST},"), 1);
        let mut kinds = trilith::registry();
        kinds.link::<Wrong>();
        let sweep = Sweep::new(text, "wrong.ron", kinds).case("shake").threads(1);
        let points = ["600", "500", "400"].map(|a| vec![("a".to_owned(), a.to_owned())]);
        let ends = sweep.run(&points).into_iter().map(|outcome| match outcome {
            Ok(it) => {
                let peak = it.outputs.get("u").expect("an output");
                let number = peak.max.abs().max(peak.min.abs());
                let (good, text) = (it.status.is_good(), it.status.text());
                (Some(it.engine), End { good, text, number, tried: it.steps })
            }
            Err(e) => (None, End { good: false, text: e.to_string(), number: f64::NAN, tried: 0 }),
        });
        ends.collect()
    };
    let sound = ends(Fault::Nothing);
    for (engine, end) in &sound {
        assert_eq!((engine.as_ref(), &*end.text), (Some(&Engine::Lanes), "converged"));
    }
    let mut broken = Vec::new();
    for fault in Fault::ALL.iter().copied() {
        for ((engine, end), (_, sound)) in ends(fault).iter().zip(&sound) {
            let End { good, text, number, .. } = end;
            let off = (number / sound.number - 1.0).abs();
            if *good && off >= NUMBER || !good && !text.contains("\"w\"") {
                broken.push(format!("{fault:?}: {engine:?}: {text}, {off}"));
            }
        }
    }
    assert!(broken.is_empty(), "{}", broken.join("\n"));
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

/// Where steps are as long as the case says, and where no time goes on, no step is halved for energies that do not close.
#[test]
fn energies_that_do_not_close_are_told_in_steps_of_a_given_length_and_in_static_cases() {
    let fixed = |fault, solver| {
        let text = model(fault).replace("dt: 0.01,", "dt: 0.01, step: Fixed(substeps: 1),");
        run_of(&text, fault, solver).text
    };
    let [heat, stored] = ["hysteretic", "stored"].map(|energy| {
        Fault::ALL.iter().copied().filter(move |fault| {
            let what = fault.what();
            what.contains(energy) && !what.contains("NaN") && !what.contains("infinite")
        })
    });
    let viscous = [Fault::ViscousTwice, Fault::ViscousNone, Fault::ViscousNegative];
    let of_slip: Vec<Fault> = heat.chain(stored).collect();
    assert_eq!(of_slip.len(), 10, "{of_slip:?}");
    for solver in SOLVERS {
        let sound = fixed(Fault::Nothing, solver);
        assert!(!sound.contains("the law of"), "{}: {sound}", solver.name());
        for fault in of_slip.iter().copied().chain(viscous) {
            let text = fixed(fault, solver);
            let told = text.starts_with("the law of \"w\" ")
                && text.contains(" its work at t = ")
                && text.contains("however short the steps are");
            assert!(told, "{fault:?}, {}: {text}", solver.name());
        }
    }
    assert_eq!(press(Fault::Nothing), "converged");
    for fault in of_slip {
        let text = press(fault);
        let told = text.starts_with("the law of \"w\" ")
            && text.contains(" its work beyond ")
            && text.contains("case \"press\": in the last step it took ");
        assert!(told, "{fault:?}: {text}");
    }
}

#[test]
fn no_wrong_law_ends_with_a_wrong_number() {
    let sound = SOLVERS.map(|solver| run(Fault::Nothing, solver).number);
    assert!(sound.iter().all(|x| (x / sound[0] - 1.0).abs() < 1e-3), "{sound:?}");
    let mut broken = Vec::new();
    let mut table = page::Table::default();
    assert!(Fault::ALL.len() > 36);
    for fault in Fault::ALL.iter().copied() {
        let found = kit(fault);
        if found.is_some() != (fault != Fault::Nothing) {
            broken.push(format!("{fault:?}: the kit says {found:?}"));
        }
        let ends = SOLVERS.map(|solver| run(fault, solver));
        for ((solver, sound), end) in SOLVERS.into_iter().zip(sound).zip(&ends) {
            let End { good, text, number, tried } = end;
            let off = (number / sound - 1.0).abs();
            let when = ["t = ", "case \"shake\"", "element \"w\""];
            let told = text.contains("\"w\"") && when.iter().any(|when| text.contains(when));
            if *good && off >= NUMBER || !good && !told || *tried >= MOST {
                broken.push(format!("{fault:?}, {}: {text}, {off}, {tried}", solver.name()));
            }
        }
        table.row(fault, found.as_deref(), &ends);
    }
    assert!(broken.is_empty(), "{}", broken.join("\n"));
    table.compare();
}
