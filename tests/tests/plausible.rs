//! What a run says about models that are hardly meant so, and that it says nothing of those that ship.

use trilith_model::{Model, SolverKind};
use trilith_solvers::{RunOptions, run};
use trilith_system::System;
use trilith_tests::{parse, root, shipped, shipped_text, trace};

/// What is said of the last case of a model.
fn said((model, system): &(Model, System), solver: SolverKind) -> Vec<String> {
    let (_, result) = trace(model, system, solver);
    result.warnings.into_iter().filter(|w| w.starts_with("check the model")).collect()
}

/// The one thing that is said has these parts.
fn says(of: &(Model, System), parts: &[&str]) {
    for solver in [SolverKind::Fna, SolverKind::Hht] {
        let all = said(of, solver);
        let [one] = &all[..] else { panic!("{}: {all:?}", solver.name()) };
        assert!(parts.iter().all(|p| one.contains(p)), "{}: {one}", solver.name());
    }
}

#[test]
fn a_body_that_stands_on_contacts_needs_a_weight() {
    let text = shipped_text("rigid_block.ron");
    let after = "after: \"gravity\",";
    assert!(text.contains(after));
    let short = [("duration", "0.5".to_owned())];
    let without = parse(&text.replace(after, ""), &short);
    says(&without, &["\"foot left\", \"foot right\"", "case \"pulse\"", "10000 kg", "no weight"]);
    for weight in [after, "constant: [Gravity],"] {
        let of = parse(&text.replace(after, weight), &short);
        assert!(said(&of, SolverKind::Fna).is_empty(), "{weight}");
    }
}

#[test]
fn a_contact_that_is_far_too_soft_is_told() {
    let set = [("duration", "0.5".to_owned()), ("kn", "500 N/m".to_owned())];
    let of = shipped("rigid_block.ron", &set);
    says(&of, &["\"foot ", "98.1 m", "size of the model (2 m; 5 %", "too soft"]);
    // In the static case as well: half the weight over the stiffness.
    let result = run(&of.0, &of.1, RunOptions::default(), &mut []).unwrap();
    assert!(result.warnings.iter().any(|w| w.contains("98.1 m")), "{:?}", result.warnings);
}

#[test]
fn a_contact_that_is_pressed_in_on_the_way_is_told() {
    // Under the weight it gives 4.9 % of the 2 m; the landing presses it in by far more.
    let set = [("kn", "5e5 N/m".to_owned()), ("cv", "1e4 N*s/m".to_owned())];
    says(&shipped("rigid_block_drop.ron", &set), &["\"foot ", "was pressed in"]);
}

/// Two masses and a rod of 1 m, pushed with 10 N: ½ · 5 m/s² · 1 s² and what the rod gives.
const PUSHED: &str = r#"(
    parameters: { "force": 10 },
    nodes: { "a": (0, 0, 0), "b": (1, 0, 0) },
    supports: { "a": (Uy, Uz, Rx, Ry, Rz), "b": (Uy, Uz, Rx, Ry, Rz) },
    elements: {
        "mass a": Mass(node: "a", mass: 1),
        "mass b": Mass(node: "b", mass: 1),
        "rod": Spring(nodes: ("a", "b"), k1: 1e4),
    },
    functions: { "on": Step(amplitude: 1, start: 0, end: 9) },
    loads: { "push": [(node: "a", dof: Ux, force: "force")] },
    cases: { "push": Dynamic(duration: 1, dt: 0.01, forces: [(load: "push", function: "on")]) },
    outputs: { "u": Displacement(node: "b", dof: Ux) },
)"#;

#[test]
fn what_ends_farther_away_than_the_model_is_large_is_told() {
    says(&parse(PUSHED, &[]), &["node \"a\" is 2.5 m away", "250 %", "(1 m)"]);
    assert!(said(&parse(PUSHED, &[("force", "3".into())]), SolverKind::Fna).is_empty());
}

#[test]
fn what_supports_carry_along_may_go_as_far_as_they() {
    let text = r#"(
        nodes: { "g": (0, 0, 0), "m": (1, 0, 0) },
        supports: { "g": Fixed, "m": (Uy, Uz, Rx, Ry, Rz) },
        elements: {
            "mass": Mass(node: "m", mass: 2),
            "spring": Spring(nodes: ("g", "m"), k1: 200),
        },
        functions: { "ramp": Points(points: [(0, 0), (1, 5), (2, 20)], interpolation: Cubic) },
        cases: { "move": Dynamic(duration: 1, dt: 0.01,
            supports: [(node: "g", dof: Ux, displacement: "ramp")]) },
        outputs: { "u": Displacement(node: "m", dof: Ux) },
    )"#;
    let of = parse(text, &[]);
    assert!(trace(&of.0, &of.1, SolverKind::Fna).0.max[0] > 4.0);
    assert!(said(&of, SolverKind::Fna).is_empty());
}

/// One mass at one node: no size tells what is far.
#[test]
fn what_leaves_the_world_is_told_where_a_model_has_no_size() {
    let text = r#"(
        parameters: { "a": 1e100 },
        nodes: { "m": (0, 0, 0) },
        supports: { "m": (Uy, Uz, Rx, Ry, Rz) },
        elements: {
            "mass": Mass(node: "m", mass: 2),
            "spring": Spring(node: "m", k1: 200),
            "gap": Gap(node: "m", k: 1e5, opening: 0.1),
        },
        functions: { "sine": Sine(amplitude: "a", frequency: 1.3) },
        cases: { "shake": Dynamic(duration: 1, dt: 0.01, base: [(direction: X, function: "sine")]) },
        outputs: { "u": Displacement(node: "m", dof: Ux) },
    )"#;
    says(&parse(text, &[]), &["at the end node \"m\" is", "m away from its place"]);
    // A mass that falls for a minute goes eighteen kilometres.
    assert!(said(&parse(text, &[("a", "1e3".into())]), SolverKind::Fna).is_empty());
}

#[test]
fn nothing_is_said_of_the_models_that_ship() {
    let mut seen = 0;
    for entry in std::fs::read_dir(root().join("models")).unwrap() {
        let file = entry.unwrap().file_name().into_string().unwrap();
        if !file.ends_with(".ron") {
            continue;
        }
        // The block that is dropped is still in the air before.
        let duration = if file == "rigid_block_drop.ron" { "5" } else { "3" };
        let of = shipped(&file, &[("duration", duration.into())]);
        let all = said(&of, SolverKind::Fna);
        assert!(all.is_empty(), "{file}: {all:?}");
        seen += 1;
    }
    assert!(seen > 8, "{seen}");
}
