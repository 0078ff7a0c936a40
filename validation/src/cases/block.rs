//! The rigid block: how it leaves rest.

use super::set;
use super::sliding::Slider;
use crate::case::BOTH;
use crate::unit::{METRE, NUMBER, RADIAN};
use crate::{Case, Check, Curve, View};
use std::f64::consts::PI;

/// A block on two feet under one half sine.
const ONSET: &str = r#"(
    title: "Rigid block under a half sine",
    plane: XZ,
    parameters: {
        "width": "2 m", "height": "4 m", "mass": "10 t",
        "mu": 0.6, "kn": "2e11 N/m", "cv": "2.5e7 N*s/m", "a": 1.5,
    },
    nodes: {
        "cg": (0, 0, "height/2"), "left": ("-width/2", 0, 0), "right": ("width/2", 0, 0),
    },
    properties: { "foot": NLink(kn: "kn", ks: "kn", mu: "mu", damping: "cv", pull: 1) },
    elements: {
        "block": RigidBody(nodes: ("cg", "left", "right")),
        "inertia": Mass(node: "cg", mass: "mass", inertia: (0, "mass*(height^2 + width^2)/12", 0)),
        "foot left": NLink(node: "left", use: "foot"),
        "foot right": NLink(node: "right", use: "foot"),
    },
    functions: { "pulse": HalfSine(amplitude: "a*9.80665 m/s^2", duration: "0.1 s") },
    cases: {
        "gravity": Static(loads: [Gravity]),
        "pulse": Dynamic(
            after: "gravity", duration: "0.3 s", dt: "1 ms",
            base: [(direction: X, function: "pulse")],
        ),
    },
    outputs: {
        "slide": Displacement(node: "left", dof: Ux),
        "rotation": Displacement(node: "cg", dof: Ry),
    },
)"#;

const MODES: [&str; 4] = ["rest", "slide", "rock", "slide-rock"];

/// The response mode at acceleration A, friction μ and slenderness γ.
fn shenton(a: f64, mu: f64, slender: f64) -> usize {
    let critical = (a * (4.0 + slender * slender) + 3.0 * slender)
        / (1.0 + 4.0 * slender * slender + 3.0 * a * slender);
    if a <= mu.min(1.0 / slender) {
        0
    } else if mu <= 1.0 / slender {
        1
    } else if mu >= critical {
        2
    } else {
        3
    }
}

pub(super) fn cases() -> Vec<Case> {
    // Both sides of every border: the four of the reference problem and eight around them.
    let points = [
        ("RB-1a", 0.2, 0.4),
        ("RB-1b", 1.5, 0.2),
        ("RB-1c", 1.5, 0.6),
        ("RB-1d", 0.8, 0.8),
        ("RB-1e", 0.45, 0.8),
        ("RB-1f", 0.55, 0.8),
        ("RB-1g", 0.35, 0.4),
        ("RB-1h", 0.45, 0.4),
        ("RB-1i", 1.5, 0.45),
        ("RB-1j", 1.5, 0.55),
        ("RB-1k", 1.5, 0.66),
        ("RB-1l", 1.5, 0.73),
    ];
    points
        .into_iter()
        .map(|(id, a, mu)| {
            let expected = shenton(a, mu, 2.0);
            let what = format!("mode at A = {a}, μ = {mu} ({}: {expected})", MODES[expected]);
            let measure = |r: &crate::Trace| {
                let mode = r.contact.as_ref().map(|c| c.initial_mode);
                let found = MODES.iter().position(|m| Some(*m) == mode);
                found.map_or(f64::NAN, |i| i as f64)
            };
            let slide = Curve::new("slide", METRE);
            // A block that rests or only slides is a mass with friction.
            let slide = if expected < 2 {
                let g = 9.80665;
                let slider = Slider::new(a * g, PI / 0.1, 0.1, mu * g, 0.3);
                slide.against(move |t| slider.at(t))
            } else {
                slide
            };
            Case {
                id,
                title: "How a block leaves rest",
                source: "Shenton 1996, J. Eng. Mech. 122(7); height/width = 2",
                text: ONSET.into(),
                set: vec![set("a", a), set("mu", mu)],
                solvers: BOTH,
                view: View::histories([slide, Curve::new("rotation", RADIAN)]),
                checks: vec![Check::new(what, NUMBER, expected as f64, 0.0, measure).absolute()],
            }
        })
        .collect()
}
