//! Bodies that pass through each other are told, and bodies that only touch are not.

use trilith_model::SolverKind;
use trilith_solvers::{RunOptions, run, warnings};
use trilith_tests::{Trace, parse, shipped_text, trace};

/// Two casks on a pad; the first slides towards the second. `more`: elements beside.
fn casks(clear: f64, velocity: f64, more: &str) -> String {
    format!(
        r#"(
        gravity: 9.81,
        nodes: {{ "1": (0, 0, 3), "2": ({}, 0, 3) }},
        properties: {{
            "rim": RockingBody(rim_radius: 1.7, rim_depth: 3, kn: 4e10, ks: 4e10, damping: 4e7, mu: 0.01, pull: true,
                inertia: (5e5, 5e5, 2e5)),
        }},
        elements: {{
            "mass 1": Mass(node: "1", mass: 1.6e5, inertia: (5e5, 5e5, 2e5)),
            "mass 2": Mass(node: "2", mass: 1.6e5, inertia: (5e5, 5e5, 2e5)),
            "base 1": RockingBody(node: "1", use: "rim"),
            "base 2": RockingBody(node: "2", use: "rim"),
            {more}
        }},
        cases: {{
            "gravity": Static(loads: [Gravity]),
            "slide": Dynamic(after: "gravity", duration: 0.2, dt: 0.005,
                initial: [(node: "1", dof: Ux, velocity: {velocity})]),
        }},
        outputs: {{ "x": Displacement(node: "1", dof: Ux) }},
    )"#,
        3.4 + clear
    )
}

const CONTACT: &str =
    r#""between": BodyContact(nodes: ("1", "2"), radii: (1.7, 1.7), heights: [-3, 3], kn: 1e9),"#;

/// What is said of bodies in each other, of the last case.
fn said(text: &str) -> Vec<String> {
    let (model, system) = parse(text, &[]);
    let (_, result) = trace(&model, &system, SolverKind::Fna);
    result.warnings.into_iter().filter(|w| w.contains("deep in each other")).collect()
}

#[test]
fn bodies_that_pass_through_each_other_are_told() {
    let all = said(&casks(0.03, 1.0, ""));
    let [one] = &all[..] else { panic!("{all:?}") };
    // 1 m/s for 0.2 s over 0.03 m, less a little friction.
    for part in ["check the model", "\"base 1\" and \"base 2\"", "0.16", "at t = 0.2 s"] {
        assert!(one.contains(part), "{one}");
    }
}

#[test]
fn bodies_that_touch_or_stay_apart_are_not_told() {
    for text in [
        casks(0.03, 0.1, ""),
        casks(0.0, 0.0, ""),
        // 1 % of the width of a cask is taken for the play of a contact …
        casks(0.0, 0.1, ""),
        // … and whatever a contact between them is pressed in, here by some five centimetres.
        casks(0.03, 5.0, CONTACT),
    ] {
        assert!(said(&text).is_empty(), "{:?}\n{text}", said(&text));
    }
    let soft = casks(0.03, 5.0, CONTACT);
    let (model, system) = parse(&soft, &[]);
    let (found, _) = trace(&model, &system, SolverKind::Fna);
    assert!(found.max[0] > 0.03 + 0.034, "{}", found.max[0]);
}

#[test]
fn bodies_that_are_in_each_other_from_the_start_are_told_before_a_run_as_well() {
    let text = casks(-0.5, 0.0, "");
    let (model, system) = parse(&text, &[]);
    let before = warnings(&model).unwrap();
    assert!(before.len() == 1 && before[0].contains("where the model places them"), "{before:?}");
    let all = said(&text);
    // Half a metre, less what the corners of an outline leave of a circle.
    let deep = |text: &str| text.contains("0.498 m deep") || text.contains("0.5 m deep");
    assert!(all.len() == 1 && deep(&all[0]), "{all:?}");
    // The static case by itself.
    let mut watch = Trace::default();
    let result = run(&model, &system, RunOptions::default(), &mut [&mut watch]).unwrap();
    assert!(deep(&result.warnings[0]), "{:?}", result.warnings);
    assert!(warnings(&parse(&casks(0.0, 0.0, ""), &[]).0).unwrap().is_empty());
}

#[test]
fn a_row_of_casks_without_contacts_between_them_is_told_and_with_them_it_is_not() {
    let text = shipped_text("cask_row.ron");
    let cut = |text: &str, names: &[&str]| -> String {
        let kept = |line: &&str| !names.iter().any(|n| line.trim_start().starts_with(n));
        text.lines().filter(kept).collect::<Vec<_>>().join("\n")
    };
    let alone = cut(&text, &["\"between ", "\"gap ", "\"push ", "\"apart\""]);
    let short = [("duration", "6 s".to_owned()), ("spread", "0.5".to_owned())];
    for (text, wanted) in [(&alone, true), (&text, false)] {
        let (model, system) = parse(text, &short);
        let (_, result) = trace(&model, &system, SolverKind::Fna);
        let told: Vec<_> =
            result.warnings.iter().filter(|w| w.contains("deep in each other")).collect();
        assert_eq!(!told.is_empty(), wanted, "{told:?}");
    }
}
