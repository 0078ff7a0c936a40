//! Stops are hit and bearings travel: neither is the rocking of a body.

use trilith_model::Model;
use trilith_solvers::{BearingSummary, ContactMode, ContactSummary, RunOptions, StopSummary, run};
use trilith_system::System;
use trilith_tests::{parse, shipped};

/// What all contacts of the last case did.
fn contacts(
    (model, system): (Model, System),
) -> (Option<ContactSummary>, Option<StopSummary>, Option<BearingSummary>) {
    let mut seen = ContactMode::new(&model, &system);
    let options = RunOptions { case: model.cases.len() - 1, ..RunOptions::default() };
    run(&model, &system, options, &mut [&mut seen]).unwrap();
    (seen.summary(), seen.stops(), seen.bearings())
}

#[test]
fn an_isolated_building_travels_on_its_bearings() {
    let (mode, stops, bearings) = contacts(shipped("isolated_frame.ron", &[]));
    assert_eq!((mode, stops), (None, None));
    let bearings = bearings.unwrap();
    assert_eq!(bearings.bearings, 6);
    assert!((0.4..0.6).contains(&bearings.max_travel), "{bearings:?}");
    assert!(bearings.residual_travel < 0.05, "{bearings:?}");
    let farthest = bearings.farthest.as_deref().unwrap();
    assert!(farthest.starts_with("isolator "), "{farthest}");
}

#[test]
fn stops_between_frames_count_their_hits() {
    let (mode, stops, bearings) = contacts(shipped("pounding_frames.ron", &[]));
    assert_eq!((mode, bearings), (None, None));
    let stops = stops.unwrap();
    assert_eq!((stops.stops, stops.hardest.as_deref()), (3, Some("gap 3")), "{stops:?}");
    assert!(stops.hits >= 2, "{stops:?}");
    // As large as the output of its force.
    assert!((stops.largest_force / 457e3 - 1.0).abs() < 0.01, "{stops:?}");
}

/// A block that rests on two feet beside a wall, 0.1 m away, and hits it with a speed of its own.
fn beside_a_wall(speed: f64) -> (Model, System) {
    let text = format!(
        r#"(
        plane: XZ,
        nodes: {{ "cg": (0, 0, 1), "left": (-2, 0, 0), "right": (2, 0, 0) }},
        properties: {{ "foot": NLink(kn: 1e8, ks: 1e8, mu: 0.05, damping: 2e5) }},
        elements: {{
            "block": RigidBody(nodes: ("cg", "left", "right")),
            "inertia": Mass(node: "cg", mass: 4e3, inertia: (0, 4e3, 0)),
            "foot left": NLink(node: "left", use: "foot"),
            "foot right": NLink(node: "right", use: "foot"),
            "wall": Gap(node: "cg", axis: U2, k: 1e6, opening: 0.1),
        }},
        cases: {{
            "gravity": Static(loads: [Gravity]),
            "move": Dynamic(
                after: "gravity", duration: "0.5 s", dt: "1 ms",
                initial: [(node: "cg", dof: Ux, velocity: {speed:?})],
            ),
        }},
    )"#
    );
    parse(&text, &[])
}

#[test]
fn a_body_does_not_rock_because_a_stop_beside_it_is_open() {
    let (mode, stops, bearings) = contacts(beside_a_wall(0.0));
    let mode = mode.unwrap();
    assert_eq!((mode.initial_mode, mode.mode), ("rest", "rest"), "{mode:?}");
    assert!(mode.max_uplift < 1e-9, "{mode:?}");
    let stops = stops.unwrap();
    assert_eq!((stops.stops, stops.hits, stops.largest_force), (1, 0, 0.0));
    assert_eq!((stops.hardest, bearings), (None, None));
}

#[test]
fn a_body_that_slides_into_a_stop_hits_it_once() {
    let (mode, stops, _) = contacts(beside_a_wall(-1.0));
    assert!(["slide", "slide-rock"].contains(&mode.unwrap().mode));
    let stops = stops.unwrap();
    assert_eq!((stops.hits, stops.hardest.as_deref()), (1, Some("wall")));
    // No more than v √(k m) without friction.
    assert!(stops.largest_force > 2e4 && stops.largest_force < 6.4e4, "{stops:?}");
}
