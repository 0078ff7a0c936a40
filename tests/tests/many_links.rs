//! Many links on few modes: hundreds of links side by side do what one of each kind does that is as strong as they
//! are together.

use std::fmt::Write;
use trilith_model::SolverKind;
use trilith_solvers::{EndState, RunOptions};
use trilith_tests::{parse, trace, trace_with};

/// Masses in a row.
const MASSES: usize = 6;

/// A row of masses between springs; each is held by so many links of each kind, which are as strong together whatever their
/// number. What a link of the whole does is told of the first of each mass.
fn row(count: usize, step: &str) -> String {
    let mut elements = String::new();
    let mut outputs = String::new();
    let (share, mut before) = (1.0 / count as f64, "ground".to_owned());
    for m in 0..MASSES {
        let node = format!("m{m}");
        let strong = share * (1.0 + 0.3 * m as f64);
        writeln!(
            elements,
            r#""mass {m}": Mass(node: "{node}", mass: "{} t"),
            "spring {m}": Spring(nodes: ("{before}", "{node}"), k1: 4e6),"#,
            2 + m,
        )
        .unwrap();
        for i in 0..count {
            writeln!(
                elements,
                r#""steel {m} {i}": Wen(nodes: ("ground", "{node}"), axis: U1, k: {}, fy: {}, ratio: 0.1),
                "rubber {m} {i}": Wen(nodes: ("ground", "{node}"), axis: U1, k: {}, fy: {}, ratio: 0.3),
                "damper {m} {i}": Dashpot(nodes: ("ground", "{node}"), axis: U1, c: {}, exponent: 0.5),
                "stop {m} {i}": Gap(nodes: ("ground", "{node}"), axis: U1, k: {}, opening: 0.02),"#,
                3e6 * strong,
                9e3 * strong,
                1e6 * strong,
                4e3 * strong,
                8e3 * strong,
                2e7 * share,
            )
            .unwrap();
        }
        writeln!(
            outputs,
            r#""way {m}": Displacement(node: "{node}", dof: Ux),
            "steel {m}": LinkDeformation(link: "steel {m} 0", axis: U1),"#,
        )
        .unwrap();
        before = node;
    }
    let nodes: String =
        (0..MASSES).map(|m| format!(r#""m{m}": ({}, 0, 0), "#, 1.0 + m as f64)).collect();
    let free: String = (0..MASSES).map(|m| format!(r#""m{m}": (Uy, Uz, Rx, Ry, Rz), "#)).collect();
    format!(
        r#"(
            nodes: {{ "ground": (0, 0, 0), {nodes} }},
            supports: {{ "ground": Fixed, {free} }},
            elements: {{ {elements} }},
            damping: Modal(ratio: 0.01),
            functions: {{ "motion": Sine(amplitude: 30, frequency: 1.3, cycles: 3) }},
            cases: {{ "shaken": Dynamic(
                duration: "3 s", dt: "0.01 s", step: {step}, link_tolerance: 1e-9,
                base: [(direction: X, function: "motion")],
            ) }},
            outputs: {{ {outputs} }},
        )"#
    )
}

#[test]
fn hundreds_of_links_side_by_side_move_as_few_that_are_as_strong() {
    // With adaptive steps the rule of a step may be another one, which the tolerance bears.
    for (step, most) in [("Fixed(substeps: 2)", 1e-7), ("Adaptive(tolerance: 1e-4)", 1e-5)] {
        let [few, many] = [1, 12].map(|count| {
            let (model, system) = parse(&row(count, step), &[]);
            trace(&model, &system, SolverKind::Fna)
        });
        assert_eq!(few.0.history.len(), many.0.history.len());
        for i in 0..2 * MASSES {
            let (a, b) = (few.0.peak(i), many.0.peak(i));
            assert!(a > 0.005, "{step} {i}: nothing happens, {a}");
            assert!((a - b).abs() < most * a, "{step} {i}: {a} {b}");
            assert!(few.0.difference(&many.0, i) < most, "{step} {i}");
        }
        let [a, b] = [&few.1.energy, &many.1.energy];
        for (a, b) in [(a.input, b.input), (a.link_hysteretic, b.link_hysteretic)] {
            assert!((a - b).abs() < 10.0 * most * a.abs(), "{step}: {a} {b}");
        }
    }
}

#[test]
fn a_run_of_many_links_goes_on_from_a_checkpoint_to_the_same_bits() {
    let (model, system) = parse(&row(12, "Adaptive(tolerance: 1e-4)"), &[]);
    let (whole, end) = trace(&model, &system, SolverKind::Fna);
    let first = RunOptions { until: Some(1.1), ..RunOptions::default() };
    let (before, stopped) = trace_with(&model, &system, first);
    let written = serde_json::to_string(&stopped.end).unwrap();
    let read: EndState = serde_json::from_str(&written).unwrap();
    let (after, finished) =
        trace_with(&model, &system, RunOptions { from: Some(read), ..RunOptions::default() });
    let joined: Vec<_> = before.history.iter().chain(&after.history[1..]).collect();
    assert!(joined.iter().zip(&whole.history).all(|(a, b)| *a == b));
    assert_eq!(joined.len(), whole.history.len());
    assert_eq!((finished.end.state, finished.energy), (end.end.state, end.energy));
}
