//! Inerters: inertia without weight.

use crate::case::BOTH;
use crate::unit::{METRE, NUMBER, SPEED};
use crate::{Case, Check, Curve, View};

/// A mass on a spring with an inerter to the ground: let go, shaken at the base, and hung up.
const GROUNDED: &str = r#"(
    title: "Oscillator with an inerter to the ground",
    gravity: 10,
    parameters: { "mass": "2 kg", "inertance": "3 kg", "stiffness": "500 N/m" },
    nodes: { "x": (0, 0, 0), "z": (1, 0, 0) },
    supports: { "x": (Uy, Uz, Rx, Ry, Rz), "z": (Ux, Uy, Rx, Ry, Rz) },
    elements: {
        "mass x": Mass(node: "x", mass: "mass"),
        "spring x": Spring(node: "x", k2: "stiffness"),
        "inerter x": Inerter(node: "x", b: "inertance", axis: U2),
        "mass z": Mass(node: "z", mass: "mass"),
        "spring z": Spring(node: "z", k1: "stiffness"),
        "inerter z": Inerter(node: "z", b: "inertance"),
    },
    functions: { "sine": Sine(amplitude: "2 m/s^2", frequency: "7/(2*3.141592653589793)") },
    cases: {
        "hung up": Static(loads: [Gravity]),
        "released": Dynamic(
            duration: "2 s", dt: "1 ms",
            initial: [(node: "x", dof: Ux, displacement: "10 mm")],
        ),
        "shaken": Dynamic(
            duration: "2 s", dt: "1 ms", base: [(direction: X, function: "sine")],
        ),
        "dropped": Dynamic(duration: "2 s", dt: "1 ms", constant: [Gravity]),
    },
    outputs: {
        "x": Displacement(node: "x", dof: Ux),
        "z": Displacement(node: "z", dof: Uz),
    },
)"#;

/// Two free masses that nothing joins but an inerter; one is pushed.
const BETWEEN: &str = r#"(
    title: "Inerter between two free masses",
    nodes: { "a": (0, 0, 0), "b": (3, 4, 0) },
    supports: { "a": (Uz, Rx, Ry, Rz), "b": (Uz, Rx, Ry, Rz) },
    elements: {
        "mass a": Mass(node: "a", mass: "2 kg"),
        "mass b": Mass(node: "b", mass: "5 kg"),
        "inerter": Inerter(nodes: ("a", "b"), b: "3 kg"),
    },
    loads: { "push": [
        (node: "a", dof: Ux, force: "6 N"), (node: "a", dof: Uy, force: "8 N"),
    ] },
    functions: { "step": Constant(1) },
    cases: {
        "pushed": Dynamic(
            duration: "1 s", dt: "5 ms", forces: [(load: "push", function: "step")],
        ),
    },
    outputs: {
        "v a": Velocity(terms: [
            (node: "a", dof: Ux, factor: 0.6), (node: "a", dof: Uy, factor: 0.8),
        ]),
        "v b": Velocity(terms: [
            (node: "b", dof: Ux, factor: 0.6), (node: "b", dof: Uy, factor: 0.8),
        ]),
    },
)"#;

pub(super) fn cases() -> Vec<Case> {
    vec![grounded(), between()]
}

fn grounded() -> Case {
    let (m, b, k, g): (f64, f64, f64, f64) = (2.0, 3.0, 500.0, 10.0);
    let w = (k / (m + b)).sqrt();
    // (m + b) ẍ + k x = −m a sin ωt from rest.
    let (a, v) = (2.0, 7.0);
    let shaken =
        move |t: f64| -m * a / (m + b) / (w * w - v * v) * ((v * t).sin() - v / w * (w * t).sin());
    let released = move |t: f64| 0.01 * (w * t).cos();
    let dropped = move |t: f64| -m * g / k * (1.0 - (w * t).cos());
    let mut checks = vec![
        Check::new("deflection under weight", METRE, -m * g / k, 1e-9, |r| r.last("z"))
            .in_analysis("hung up"),
    ];
    for t in [0.5, 1.3, 2.0] {
        checks.push(Check::at("x", METRE, t, released(t), 1e-3).in_analysis("released"));
        checks.push(Check::at("x", METRE, t, shaken(t), 1e-3).in_analysis("shaken"));
        checks.push(Check::at("z", METRE, t, dropped(t), 1e-3).in_analysis("dropped"));
    }
    checks.push(
        Check::new(
            "crossings in 2 s",
            NUMBER,
            (2.0 * w / std::f64::consts::PI).round(),
            0.1,
            |r| r.crossings("x", 0.0).len() as f64,
        )
        .absolute()
        .in_analysis("released"),
    );
    Case {
        id: "IN-1",
        title: "Mass, spring and inerter to the ground",
        source: "(m + b) ẍ + k x = −m a(t); weight m g",
        text: GROUNDED.into(),
        set: Vec::new(),
        solvers: BOTH,
        checks,
        view: View::histories([
            Curve::new("x", METRE).against(released).in_analysis("released"),
            Curve::new("x", METRE).against(shaken).in_analysis("shaken"),
            Curve::new("z", METRE).against(dropped).in_analysis("dropped"),
        ]),
    }
}

fn between() -> Case {
    let (a, c, b, f): (f64, f64, f64, f64) = (2.0, 5.0, 3.0, 10.0);
    let all = a * c + b * (a + c);
    let (first, second) = (f * (c + b) / all, f * b / all);
    Case {
        id: "IN-2",
        title: "Inerter between two free masses",
        source: "m₁ a₁ + b (a₁ − a₂) = F, m₂ a₂ = b (a₁ − a₂)",
        text: BETWEEN.into(),
        set: Vec::new(),
        solvers: BOTH,
        checks: vec![
            Check::at("v a", SPEED, 1.0, first, 1e-6),
            Check::at("v b", SPEED, 1.0, second, 1e-6),
        ],
        view: View::histories([
            Curve::new("v a", SPEED).against(move |t| first * t),
            Curve::new("v b", SPEED).against(move |t| second * t),
        ]),
    }
}
