//! Bodies in finite rotation go side by side as they go alone, to the end or until they overturn.

use trilith::RunOptions;
use trilith::solvers::Status;
use trilith::sweep::{Combination, Engine, Outcome, Sweep};

/// A block on two edges, in a plane.
const BLOCK: &str = r#"(
    plane: XZ, gravity: "9.81 m/s^2",
    parameters: { "ah": 0.35, "frequency": "1 Hz", "mu": 0.8, "duration": "3 s" },
    nodes: { "cg": (0, 0, 2) },
    elements: {
        "body": Mass(node: "cg", mass: "10 t", inertia: (0, "10 t * 17 m^2 / 12", 0)),
        "base": RockingBody(node: "cg", base: [(-0.5, 0, -2), (0.5, 0, -2)],
            kn: "4e10 N/m", ks: "1e10 N/m", mu: "mu", damping: "8e7 N*s/m"),
    },
    functions: { "sine": Sine(amplitude: "ah * 9.81 m/s^2", frequency: "frequency", cycles: 1) },
    cases: {
        "gravity": Static(loads: [Gravity]),
        "shake": Dynamic(after: "gravity", duration: "duration", dt: "2 ms",
            base: [(direction: X, function: "sine")]),
    },
    outputs: {
        "tilt": LinkHistory(link: "base", variable: "tilt"),
        "x": Displacement(node: "cg", dof: Ux), "z": Displacement(node: "cg", dof: Uz),
    },
)"#;

/// A cabinet on four feet, in space.
const CABINET: &str = r#"(
    gravity: "9.81 m/s^2",
    parameters: { "ah": 0.4, "frequency": "1 Hz", "mu": 0.4, "duration": "2 s" },
    nodes: { "cg": (0, 0, 0.95) },
    elements: {
        "body": Mass(node: "cg", mass: "800 kg", inertia: (400, 350, 130)),
        "base": RockingBody(node: "cg",
            base: [(-0.3, -0.5, -0.95), (0.3, -0.5, -0.95), (0.3, 0.5, -0.95), (-0.3, 0.5, -0.95)],
            kn: "2e8 N/m", ks: "2e8 N/m", mu: "mu", damping: "1.4e5 N*s/m", pull: true,
            inertia: (400, 350, 130)),
    },
    functions: {
        "x": Sine(amplitude: "ah * 9.81 m/s^2", frequency: "frequency", cycles: 1),
        "y": Sine(amplitude: "0.6 * ah * 9.81 m/s^2", frequency: "1.3 * frequency", cycles: 1.5),
    },
    cases: {
        "gravity": Static(loads: [Gravity]),
        "shake": Dynamic(after: "gravity", duration: "duration", dt: "5 ms",
            base: [(direction: X, function: "x"), (direction: Y, function: "y")]),
    },
    outputs: {
        "tilt": LinkHistory(link: "base", variable: "tilt"),
        "x": Displacement(node: "cg", dof: Ux), "y": Displacement(node: "cg", dof: Uy),
        "turn": Displacement(node: "cg", dof: Rz),
        "lean": LinkHistory(link: "base", variable: "lean1"),
        "clear": Sum(terms: [(output: "x", factor: -1), (output: "lean", factor: -0.95)], constant: 0.1),
        "way": Norm(terms: ["x", "y"]),
        "least": Smallest(terms: ["clear", (output: "x", factor: 2)]),
        "most": Largest(terms: ["clear", "way"]),
    },
)"#;

/// A cask on its rim, in space.
const CASK: &str = r#"(
    gravity: "9.81 m/s^2",
    parameters: { "ah": 0.4, "frequency": "1 Hz", "mu": 0.4, "duration": "3 s" },
    nodes: { "cg": (0, 0, 2) },
    elements: {
        "body": Mass(node: "cg", mass: "100 t", inertia: (158e3, 158e3, 50e3)),
        "base": RockingBody(node: "cg", rim_radius: 1, rim_depth: 2, kn: "1e10 N/m", ks: "1e10 N/m", mu: "mu",
            damping: "1.5e7 N*s/m", pull: true, inertia: (158e3, 158e3, 50e3)),
    },
    functions: {
        "x": Sine(amplitude: "ah * 9.81 m/s^2", frequency: "frequency", cycles: 2),
        "y": Sine(amplitude: "0.8 * ah * 9.81 m/s^2", frequency: "frequency", cycles: 2, start: 0.25),
    },
    cases: {
        "gravity": Static(loads: [Gravity]),
        "shake": Dynamic(after: "gravity", duration: "duration", dt: "5 ms",
            base: [(direction: X, function: "x"), (direction: Y, function: "y")]),
    },
    outputs: {
        "tilt": LinkHistory(link: "base", variable: "tilt"),
        "x": Displacement(node: "cg", dof: Ux), "y": Displacement(node: "cg", dof: Uy),
        "turn": Displacement(node: "cg", dof: Rz),
    },
)"#;

/// The same in a plane: on a rim it has three of its coordinates.
fn cask_in_a_plane() -> String {
    let text = CASK
        .replace("gravity: \"9.81", "plane: XZ, gravity: \"9.81")
        .replace(", (direction: Y, function: \"y\")", "")
        .replace(", \"y\": Displacement(node: \"cg\", dof: Uy)", "")
        .replace("        \"turn\": Displacement(node: \"cg\", dof: Rz),\n", "");
    let lines = text.lines().filter(|l| !l.contains("\"y\": Sine"));
    lines.collect::<Vec<_>>().join("\n")
}

fn set(values: &[(&str, &str)]) -> Combination {
    values.iter().map(|(n, v)| ((*n).to_owned(), (*v).to_owned())).collect()
}

fn sweep(text: &str) -> Sweep {
    Sweep::new(text, "model.ron", trilith::registry()).case("shake")
}

fn outcomes(sweep: &Sweep, combinations: &[Combination]) -> Vec<Outcome> {
    sweep.run(combinations).into_iter().map(|o| o.expect("an outcome")).collect()
}

fn ordinary(text: &str, values: &Combination) -> trilith::Run {
    let model =
        trilith::read_text(text, "model.ron", &trilith::registry(), values).expect("a model");
    let case = model.case("shake").expect("a case");
    let analysis = trilith::Analysis::new(&model).expect("a structure");
    analysis.run(RunOptions { case, ..RunOptions::default() }).expect("a run")
}

/// At rest, sliding, rocking, turning about the vertical and falling.
fn combinations() -> Vec<Combination> {
    let mut all = Vec::new();
    for ah in ["0.2", "0.3", "0.4", "0.5", "0.7"] {
        for mu in ["0.3", "0.8"] {
            all.push(set(&[("ah", ah), ("mu", mu)]));
        }
    }
    all
}

#[test]
fn bodies_move_and_fall_as_on_the_ordinary_engine() {
    let mut fell = 0;
    // In space, what is nothing beside the motion grows from what steps leave: the cabinet's way across its fall.
    let plane = cask_in_a_plane();
    for (text, least) in [(BLOCK, 1e-7), (CABINET, 1e-4), (CASK, 1e-4), (&plane, 1e-7)] {
        let text = &text.replace(r#"ms","#, r#"ms", link_tolerance: 1e-12,"#);
        let all = combinations();
        for (lane, values) in outcomes(&sweep(text), &all).iter().zip(&all) {
            assert_eq!(lane.engine, Engine::Lanes, "{values:?}");
            let run = ordinary(text, values);
            assert_eq!(lane.status, run.result.status, "{values:?}");
            fell += usize::from(matches!(lane.status, Status::Overturned { .. }));
            for (name, peak) in &lane.outputs.0 {
                let own = run.peak(name).expect("one");
                // What steps of the tolerance leave.
                let most = 1e-2 * own.magnitude() + least;
                for (a, b) in [(peak.max, own.max), (peak.min, own.min), (peak.last, own.last)] {
                    assert!((a - b).abs() <= most, "{name} of {values:?}: {peak:?} {own:?}");
                }
            }
            let (a, b) = (lane.contact.as_ref().expect("feet"), run.contact.expect("feet"));
            assert_eq!(
                (a.initial_mode, a.mode, a.overturned),
                (b.initial_mode, b.mode, b.overturned),
                "{values:?}"
            );
            assert!(
                (a.max_uplift - b.max_uplift).abs() < 1e-2 * b.max_uplift + least,
                "{values:?}"
            );
            assert!(lane.energy.error_relative < 1e-2, "{:?}", lane.energy);
        }
    }
    assert!(fell >= 4, "{fell}");
}

/// Feet a hundred times stiffer, which hold in long steps by average acceleration, stick in a small part of a step
/// where they turn, and far from home have forces that are mostly rounding.
#[test]
fn stiff_feet_take_no_more_steps_and_looks_than_on_the_ordinary_engine() {
    let stiff = BLOCK
        .replace("4e10 N/m", "1.6e12 N/m")
        .replace("1e10 N/m", "4e12 N/m")
        .replace("8e7 N*s/m", "5e8 N*s/m");
    assert_ne!(stiff, BLOCK);
    let all = ["0.3", "0.5", "0.7"].map(|ah| set(&[("ah", ah), ("mu", "20"), ("duration", "2 s")]));
    for (lane, values) in outcomes(&sweep(&stiff), &all).iter().zip(&all) {
        assert_eq!(lane.engine, Engine::Lanes, "{values:?}");
        let run = ordinary(&stiff, values);
        let work = &run.result.work;
        assert_eq!(lane.status, run.result.status, "{values:?}");
        assert!(
            lane.steps < work.substeps + work.substeps / 4,
            "{values:?} {} {work:?}",
            lane.steps
        );
        assert!(lane.iterations < 2 * work.iterations, "{values:?} {} {work:?}", lane.iterations);
        // Newton's method goes to and fro over no step.
        assert!(work.iterations < 8 * work.substeps, "{values:?} {work:?}");
        let (a, b) = (lane.outputs.get("tilt").expect("one"), run.peak("tilt").expect("one"));
        assert!((a.max - b.max).abs() <= 1e-2 * b.max, "{values:?}: {a:?} {b:?}");
    }
}

#[test]
fn a_body_does_not_depend_on_its_neighbours() {
    for text in [BLOCK, CABINET, CASK] {
        let all = combinations();
        let lanes = format!("{:?}", outcomes(&sweep(text).threads(1), &all));
        let alone = format!("{:?}", outcomes(&sweep(text).threads(1).width(1), &all));
        let threes = format!("{:?}", outcomes(&sweep(text).threads(2).width(3), &all));
        assert!(lanes == alone && lanes == threes);
    }
}

#[test]
fn with_fixed_steps_a_body_goes_alone() {
    let found = outcomes(&sweep(BLOCK).fixed_steps(1), &[set(&[("ah", "0.2")])]);
    let Engine::Ordinary(reason) = &found[0].engine else { panic!("{:?}", found[0].engine) };
    assert!(reason.contains("overturn"), "{reason}");
}
