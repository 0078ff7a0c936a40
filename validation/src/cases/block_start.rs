//! How a rigid block gets going: accelerations under a base acceleration that sets in at once.

use super::set;
use crate::case::BOTH;
use crate::unit::{NUMBER, Unit};
use crate::{Case, Check, Curve, Trace, View};

const G: f64 = 9.80665;
const WIDTH: f64 = 2.0;
const SLENDER: f64 = 2.0;
const RADIAN_RATE: Unit = Unit::si("rad/s");
const SPEED: Unit = crate::unit::SPEED;

/// The feet are so stiff that they have settled, after the jump of the acceleration, within 3 ms.
const JUMP: &str = r#"(
    title: "Rigid block under a sudden base acceleration",
    plane: XZ,
    parameters: {
        "width": "2 m", "height": "4 m", "mass": "10 t",
        "mu": 0.6, "kn": "2e11 N/m", "cv": "4e7 N*s/m", "a": 1.5,
    },
    nodes: {
        "cg": (0, 0, "height/2"), "left": ("-width/2", 0, 0), "right": ("width/2", 0, 0),
    },
    properties: { "foot": NLink(kn: "kn", ks: "kn", mu: "mu", damping: "cv") },
    elements: {
        "block": RigidBody(nodes: ("cg", "left", "right")),
        "inertia": Mass(node: "cg", mass: "mass", inertia: (0, "mass*(height^2 + width^2)/12", 0)),
        "foot left": NLink(node: "left", use: "foot"),
        "foot right": NLink(node: "right", use: "foot"),
    },
    functions: { "pulse": Step(amplitude: "a*9.80665 m/s^2") },
    cases: {
        "gravity": Static(loads: [Gravity]),
        "pulse": Dynamic(
            after: "gravity", duration: "20 ms", dt: "0.1 ms", step: Adaptive(tolerance: 1e-6),
            base: [(direction: X, function: "pulse")],
        ),
    },
    outputs: {
        // a base acceleration along +X pushes the block back and lifts its right foot
        "slip rate": Velocity(node: "left", dof: Ux, factor: -1),
        "turn rate": Velocity(node: "cg", dof: Ry, factor: -1),
        "left": LinkForce(link: "foot left", axis: U1, factor: -1),
        "right": LinkForce(link: "foot right", axis: U1, factor: -1),
    },
)"#;

/// Mean rate of an output between two times after the feet have settled.
fn rate(r: &Trace, output: &str) -> f64 {
    let (from, to) = (0.005, 0.02);
    (r.at(output, to) - r.at(output, from)) / (to - from)
}

/// Mean contact force of both feet over the weight, by the momentum of the centre: over the same time.
fn normal(r: &Trace) -> f64 {
    let n = 300;
    let force = |i: usize| {
        let t = 0.005 + 0.015 * (i as f64 + 0.5) / n as f64;
        r.at("left", t) + r.at("right", t)
    };
    (0..n).map(force).sum::<f64>() / (n as f64 * 10e3 * G)
}

pub(super) fn cases() -> Vec<Case> {
    let s2 = SLENDER * SLENDER;
    let turn = |a: f64, mu: f64| {
        let n = (1.0 + s2) / (4.0 + s2 - 3.0 * mu * SLENDER);
        let slide_rock = 6.0 * n * G * (mu * SLENDER - 1.0) / (WIDTH * (1.0 + s2));
        let rock = 3.0 * G / (2.0 * WIDTH) * (a * SLENDER - 1.0) / (1.0 + s2);
        (n, slide_rock, rock)
    };
    let p = 1e-2;
    let of_slip =
        |x: f64| Check::new("slip acceleration", Unit::si("m/s²"), x, p, |r| rate(r, "slip rate"));
    let of_turn = |x: f64| {
        Check::new("angular acceleration", Unit::si("rad/s²"), x, p, |r| rate(r, "turn rate"))
    };
    let of_normal = |x: f64| Check::new("contact force / weight", NUMBER, x, p, normal);
    let none = |quantity: &str, output: &'static str, unit: &'static str| {
        // What does not start stays below 1 % of g.
        Check::new(quantity, Unit::si(unit), 0.0, 0.01 * G, move |r| rate(r, output)).absolute()
    };
    let case = |id, title, a: f64, mu: f64, slip: f64, turn: f64, checks| Case {
        id,
        title,
        source: "Shenton 1996, J. Eng. Mech. 122(7): accelerations at the start; height/width = 2",
        text: JUMP.into(),
        set: vec![set("a", a), set("mu", mu)],
        solvers: BOTH,
        checks,
        view: View::histories([
            Curve::new("slip rate", SPEED).against(move |t| slip * t),
            Curve::new("turn rate", RADIAN_RATE).against(move |t| turn * t),
        ]),
    };
    let (a, mu) = (1.5, 0.2);
    let slide = (a - mu) * G;
    let mut all = vec![case(
        "RB-1m",
        "A block starts to slide",
        a,
        mu,
        slide,
        0.0,
        vec![of_slip(slide), none("angular acceleration", "turn rate", "rad/s²"), of_normal(1.0)],
    )];
    for (id, a, mu) in [("RB-1n", 1.5, 0.6), ("RB-1o", 3.0, 0.75)] {
        let (n, theta, _) = turn(a, mu);
        let slip = a * G - mu * n * G - theta * WIDTH * SLENDER / 2.0;
        all.push(case(
            id,
            "A block starts to slide and rock",
            a,
            mu,
            slip,
            theta,
            vec![of_slip(slip), of_turn(theta), of_normal(n)],
        ));
    }
    for (id, a, mu) in [("RB-1p", 0.8, 0.8), ("RB-1q", 1.5, 0.8)] {
        let (.., theta) = turn(a, mu);
        all.push(case(
            id,
            "A block starts to rock",
            a,
            mu,
            0.0,
            theta,
            vec![none("slip acceleration", "slip rate", "m/s²"), of_turn(theta)],
        ));
    }
    all
}
