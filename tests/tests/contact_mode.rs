//! Which models have a response mode: bodies that stand on contacts or fall onto them, not stops.

use trilith_solvers::{ContactMode, ContactSummary, RunOptions, run};
use trilith_tests::{parse, shipped};

fn mode(of: (trilith_model::Model, trilith_system::System)) -> Option<ContactSummary> {
    let (model, system) = of;
    let mut mode = ContactMode::new(&model, &system);
    let options = RunOptions { case: model.cases.len() - 1, ..RunOptions::default() };
    run(&model, &system, options, &mut [&mut mode]).unwrap();
    mode.summary()
}

/// A block over two contacts, on springs of `hold` N/m (0: free), with a gap below.
fn block(opening: f64, hold: f64) -> String {
    let held = match hold {
        0.0 => String::new(),
        k => format!("\"springs\": Spring(node: \"cg\", k1: {k:?}),"),
    };
    format!(
        r#"(
        plane: XZ,
        nodes: {{ "cg": (0, 0, 1), "left": (-0.5, 0, 0), "right": (0.5, 0, 0) }},
        properties: {{ "foot": NLink(kn: 1e8, ks: 1e8, mu: 0.4, damping: 2e4, opening: {opening:?}) }},
        elements: {{
            "block": RigidBody(nodes: ("cg", "left", "right")),
            "inertia": Mass(node: "cg", mass: 4e3, inertia: (0, 1667, 0)),
            {held}
            "foot left": NLink(node: "left", use: "foot"),
            "foot right": NLink(node: "right", use: "foot"),
        }},
        cases: {{ "fall": Dynamic(duration: "0.3 s", dt: "1 ms", constant: [Gravity]) }},
    )"#
    )
}

#[test]
fn frames_with_stops_between_them_have_none() {
    assert_eq!(mode(shipped("pounding_frames.ron", &[])), None);
}

#[test]
fn a_body_that_falls_onto_its_contacts_flies_first() {
    let summary = mode(parse(&block(0.05, 0.0), &[])).unwrap();
    assert_eq!((summary.initial_mode, summary.mode), ("flight", "flight"));
    assert!((summary.max_uplift - 0.05).abs() < 1e-12, "{summary:?}");
}

#[test]
fn a_body_on_springs_above_stops_has_none_even_where_it_hits_them() {
    // It would hang 0.2 m lower: the stops take it.
    assert_eq!(mode(parse(&block(0.05, 2e5), &[])), None);
    // Without a gap the contacts carry it from the start of its motion.
    assert!(mode(parse(&block(-1e-4, 2e5), &[])).is_some());
}

/// A mass on a bearing that is a link, with an arm beside a stop that it does not touch.
#[test]
fn a_mass_on_a_bearing_beside_a_stop_has_none() {
    let text = r#"(
        gravity: 9.81,
        nodes: { "top": (0, 0, 0), "wing": (1, 0, 1) },
        elements: {
            "mass": Mass(node: "top", mass: 1e4, inertia: (1e3, 1e3, 1e3)),
            "tip": Mass(node: "wing", mass: 1e2, inertia: (10, 10, 10)),
            "arm": Spring(nodes: ("top", "wing"), k1: 1e9, k2: 1e8, k3: 1e8, r1: 1e8, r2: 1e8, r3: 1e8),
            "bearing": LinearLink(node: "top", stiffness: (
                (1e8, 0, 0, 0, 0, 0), (0, 1e6, 0, 0, 0, 0), (0, 0, 1e6, 0, 0, 0),
                (0, 0, 0, 1e9, 0, 0), (0, 0, 0, 0, 1e9, 0), (0, 0, 0, 0, 0, 1e9),
            )),
            "stop": Gap(node: "wing", axis: U2, k: 1e8, opening: 0.1),
        },
        cases: { "push": Dynamic(duration: "0.3 s", dt: "1 ms", constant: [Gravity]) },
    )"#;
    let (model, system) = parse(text, &[]);
    assert_eq!(system.on_falling_parts(&model, |_| false), [true, true]);
    assert_eq!(mode((model, system)), None);
}

#[test]
fn what_falls_is_told_from_what_stands_on_its_own_feet() {
    let falling = |of: (trilith_model::Model, trilith_system::System)| {
        of.1.on_falling_parts(&of.0, |_| false)
    };
    assert!(falling(shipped("pounding_frames.ron", &[])).iter().all(|falls| !falls));
    assert!(falling(shipped("rigid_block.ron", &[])).iter().all(|falls| *falls));
    assert_eq!(falling(parse(&block(0.05, 2e5), &[])), [false, false]);
}
