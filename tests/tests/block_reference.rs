//! The rigid block of the seed paper against an event-driven reference, as a user would run it.
//!
//! `data/block_reference.json`: peaks, residuals and energies of an independent program that locates
//! every change of contact and steps exactly between them, with a tolerance for each quantity.

use serde_json::Value;
use trilith_model::SolverKind;
use trilith_solvers::{CaseResult, ContactMode, ContactSummary, RunOptions, Status, run};
use trilith_tests::{Trace, output, root, shipped};

fn cases() -> Vec<Value> {
    let text = std::fs::read_to_string(root().join("tests/data/block_reference.json")).unwrap();
    let data: Value = serde_json::from_str(&text).unwrap();
    data["cases"].as_array().unwrap().clone()
}

fn number(v: &Value) -> f64 {
    v.as_f64().unwrap_or_else(|| panic!("a number, not {v}"))
}

/// The shipped model of a case and its parameters.
fn model_of(case: &Value) -> (&'static str, Vec<(&'static str, String)>) {
    let mut set: Vec<(&'static str, String)> = [
        ("height", "height"),
        ("width", "width"),
        ("mass", "mass"),
        ("g", "g"),
        ("mu", "mu"),
        ("kn", "kn"),
        ("ks", "ks"),
        ("cv", "cv"),
        ("cr", "cth"),
        ("duration", "t_end"),
    ]
    .iter()
    .map(|(parameter, key)| (*parameter, number(&case[*key]).to_string()))
    .collect();
    set.push(("pull", if case["dash"] == "notens" { "0" } else { "1" }.to_owned()));
    let motion = &case["motion"];
    match motion["type"].as_str().unwrap() {
        "sine" => {
            let g = number(&case["g"]);
            for (parameter, value) in [
                ("ah", number(&motion["ax"]) / g),
                ("av", number(&motion["ay"]) / g),
                ("frequency", number(&motion["fx"])),
                ("cycles", number(&motion["nx"])),
                ("frequency_v", number(&motion["fy"])),
                ("cycles_v", number(&motion["ny"])),
            ] {
                set.push((parameter, value.to_string()));
            }
            ("rigid_block.ron", set)
        }
        "steps" => {
            set.extend([("lift", "1.5".to_owned()), ("hold", "1".to_owned())]);
            ("rigid_block_drop.ron", set)
        }
        _ => {
            set.push(("uplift0", number(&case["init"]["w0"]).to_string()));
            ("rigid_block_rocking.ron", set)
        }
    }
}

fn run_case(case: &Value, solver: SolverKind, dt: f64) -> (Trace, CaseResult, ContactSummary) {
    let (file, set) = model_of(case);
    let (model, system) = shipped(file, &set);
    assert_eq!(
        ["slide", "uplift_left", "uplift_right", "rotation"].map(|n| output(&model, n)),
        [0, 1, 2, 3]
    );
    let (mut trace, mut mode) = (Trace::default(), ContactMode::new(&model, &system));
    let options = RunOptions {
        case: model.cases.len() - 1,
        solver: Some(solver),
        dt: Some(dt),
        ..RunOptions::default()
    };
    let result = run(&model, &system, options, &mut [&mut trace, &mut mode]).unwrap();
    (trace, result, mode.summary().unwrap())
}

/// Everything of a case that is beyond its tolerance.
fn misses(case: &Value, solver: SolverKind, dt: f64) -> Vec<String> {
    let (trace, result, _) = run_case(case, solver, dt);
    let (reference, tolerance) = (&case["reference"], &case["tolerance"]);
    let mut found = Vec::new();
    let label = format!("{} {} dt {dt}", case["name"], solver.name());
    if result.status != Status::Converged {
        found.push(format!("{label}: {}", result.status.text()));
    }
    let mut compare = |what: &str, value: f64, key: &str, tol: &str, scale: &str| {
        let (expected, allowed) =
            (number(&reference[key]), number(&tolerance[tol]) * number(&tolerance[scale]));
        if (value - expected).abs() > allowed {
            found.push(format!(
                "{label}: {what} {value:.6e}, reference {expected:.6e} ± {allowed:.1e}"
            ));
        }
    };
    compare("largest slide", trace.max[0], "slide_max", "slide", "scale_slide");
    compare("smallest slide", trace.min[0], "slide_min", "slide", "scale_slide");
    compare("residual slide", trace.last[0], "residual", "residual", "scale_slide");
    compare("uplift left", trace.max[1], "up_l", "uplift", "scale_uplift");
    compare("uplift right", trace.max[2], "up_r", "uplift", "scale_uplift");
    let e = &case["energy"];
    let input = number(&e["input"]).abs().max(number(&e["gravity"]).abs());
    let dashpots = number(&e["dash_v"]) + number(&e["dash_th"]);
    let ours = &result.energy;
    for (what, value, expected) in [
        ("input", ours.input, number(&e["input"])),
        ("friction", ours.link_hysteretic, number(&e["friction"])),
        ("dashpots", ours.link_viscous + ours.modal_damping, dashpots),
        ("kinetic energy", ours.kinetic, number(&e["kinetic"])),
    ] {
        if (value - expected).abs() > 0.02 * input {
            found.push(format!("{label}: {what} {value:.6e} J, reference {expected:.6e} J"));
        }
    }
    found
}

const BOTH: [SolverKind; 2] = [SolverKind::Fna, SolverKind::Hht];

fn assert_none(misses: &[String]) {
    assert!(misses.is_empty(), "{}", misses.join("\n"));
}

#[test]
fn every_case_agrees_with_the_reference_under_both_solvers() {
    let cases = cases();
    assert_eq!(cases.len(), 22);
    let misses: Vec<String> =
        cases.iter().flat_map(|c| BOTH.map(|s| misses(c, s, 1e-3))).flatten().collect();
    assert_none(&misses);
}

#[test]
fn the_output_step_does_not_decide_the_answer() {
    let cases = cases();
    let mut found = Vec::new();
    for case in &cases {
        for solver in BOTH {
            for dt in [2e-4, 5e-3, 1e-2] {
                found.extend(misses(case, solver, dt));
            }
        }
    }
    assert_none(&found);
}

#[test]
fn an_output_step_of_ten_microseconds_changes_nothing() {
    let chosen = ["h3_half", "h4_full", "rock_2.34"];
    let mut found = Vec::new();
    for case in cases().iter().filter(|c| chosen.iter().any(|n| c["name"] == *n)) {
        for solver in BOTH {
            found.extend(misses(case, solver, 1e-5));
        }
    }
    assert_none(&found);
}

/// The seed's table: case 1 at rest, 2 slides, 3 slides and rocks, 4 rocks.
#[test]
fn the_four_horizontal_cases_leave_rest_in_the_anticipated_mode() {
    let expected = [("h1", "rest"), ("h2", "slide"), ("h3", "slide-rock"), ("h4", "rock")];
    for case in cases().iter().filter(|c| c["name"].as_str().unwrap().starts_with('h')) {
        let name = case["name"].as_str().unwrap();
        let mode = expected.iter().find(|(n, _)| name.starts_with(n)).unwrap().1;
        for solver in BOTH {
            for dt in [1e-3, 1e-2] {
                let (_, _, contact) = run_case(case, solver, dt);
                assert_eq!(contact.initial_mode, mode, "{name} {} dt {dt}", solver.name());
            }
        }
    }
}

/// 0.9 g vertically never opens the contact, 1.5 g throws the block into the air.
#[test]
fn vertical_pulses_lift_the_block_only_above_one_g() {
    for case in cases().iter().filter(|c| c["name"].as_str().unwrap().starts_with('v')) {
        let name = case["name"].as_str().unwrap();
        let (trace, _, contact) = run_case(case, SolverKind::Fna, 1e-3);
        let (flies, mode) =
            if name.starts_with("v1.5") { (true, "flight") } else { (false, "rest") };
        assert_eq!(contact.mode, mode, "{name}");
        assert_eq!(trace.max[1] > 0.0, flies, "{name}");
        // The link equations are solved to 1e-9 of the largest force: about 1e-12 m of pre-slip here.
        assert!(trace.peak(0) < 1e-10, "{name} slides {}", trace.peak(0));
    }
}
