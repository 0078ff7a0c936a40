//! Which models have a response mode: bodies that stand on contacts or fall onto them, not stops.

use trilith_solvers::{ContactMode, ContactSummary, RunOptions, run};
use trilith_tests::{parse, shipped};

fn mode(of: (trilith_model::Model, trilith_system::System)) -> Option<ContactSummary> {
    let (model, system) = of;
    let mut mode = ContactMode::new(&system);
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

#[test]
fn what_falls_is_told_from_what_stands_on_its_own_feet() {
    let (_, system) = shipped("pounding_frames.ron", &[]);
    assert!(system.on_falling_parts().iter().all(|falls| !falls));
    let (_, system) = shipped("rigid_block.ron", &[]);
    assert!(system.on_falling_parts().iter().all(|falls| *falls));
    let (_, system) = parse(&block(0.05, 2e5), &[]);
    assert_eq!(system.on_falling_parts(), [false, false]);
}
