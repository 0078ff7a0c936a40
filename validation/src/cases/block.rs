//! The rigid block: how it leaves rest, and how it rocks.

use super::set;
use super::sliding::Slider;
use crate::case::BOTH;
use crate::unit::{METRE, NUMBER, RADIAN, SECOND};
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

/// A block on two gaps, held horizontally at the middle of its base.
const ROCKING: &str = r#"(
    title: "Block that rocks on two gaps",
    plane: XZ,
    parameters: {
        "mass": "1000 kg", "b": "0.5 m", "height": "1 m", "k": "1e10 N/m", "c": "5.8e6 N*s/m",
        "theta": 0.02,
    },
    nodes: { "base": (0, 0, 0), "cg": (0, 0, "height"), "left": ("-b", 0, 0), "right": ("b", 0, 0) },
    supports: { "base": Ux },
    properties: { "foot": NLink(kn: "k", damping: "c") },
    elements: {
        "block": RigidBody(nodes: ("base", "cg", "left", "right")),
        "inertia": Mass(node: "cg", mass: "mass", inertia: (0, "mass*(4*b^2 + 4*height^2)/12", 0)),
        "foot left": NLink(node: "left", use: "foot"),
        "foot right": NLink(node: "right", use: "foot"),
    },
    cases: {
        "rocking": Dynamic(
            duration: "0.5 s", dt: "0.2 ms", constant: [Gravity],
            initial: [
                (node: "base", dof: Uz, displacement: "b*theta"),
                (node: "base", dof: Ry, displacement: "theta"),
            ],
        ),
    },
    outputs: { "theta": Displacement(node: "base", dof: Ry) },
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
    let mut all = rb1();
    all.push(rb8());
    all
}

fn rb1() -> Vec<Case> {
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
                source: "Shenton 1996, J. Eng. Mech. 122(7), 690–693; height/width = 2",
                text: ONSET.into(),
                set: vec![set("a", a), set("mu", mu)],
                solvers: BOTH,
                view: View::histories([slide, Curve::new("rotation", RADIAN)]),
                checks: vec![Check::new(what, NUMBER, expected as f64, 0.0, measure).absolute()],
            }
        })
        .collect()
}

fn rb8() -> Case {
    // Rigid limit of stiff contacts close to critical damping: amplitude × 0.49 an impact,
    // quarter periods √(2 I_A θ/(m g b)), I_A = 4/3 m R².
    let quarter = |theta: f64| (2.0 * 4.0 / 3.0 * 1.25 * theta / (9.80665 * 0.5)).sqrt();
    // Parabolas from passage to passage.
    let curve = move |t: f64| {
        let (mut middle, mut size) = (0.0, 0.02_f64);
        while t > middle + quarter(size.abs()) {
            middle += quarter(size.abs()) + quarter(0.49 * size.abs());
            size *= -0.49;
        }
        size * (1.0 - ((t - middle) / quarter(size.abs())).powi(2))
    };
    let mut checks = Vec::new();
    let (mut t, mut theta, mut sign) = (0.0, 0.02, 1.0);
    for n in 0..3 {
        t += quarter(theta);
        let (from, to) = (t, t + 2.0 * quarter(theta * 0.49));
        theta *= 0.49;
        sign = -sign;
        checks.push(
            Check::new(format!("passage {}", n + 1), SECOND, t, 5e-3, move |r| {
                r.crossing("theta", 0.0, n)
            })
            .mark_time("theta", 0.0),
        );
        let peak =
            Check::new(format!("peak after passage {}", n + 1), RADIAN, sign * theta, 5e-3, {
                move |r| r.extreme("theta", sign, from, to).1
            });
        t += quarter(theta);
        checks.push(peak.mark("theta", t));
    }
    Case {
        id: "RB-8",
        title: "Block that rocks on two stiff gaps",
        source: "Housner 1963: [1 − 3/2 sin²α]² = 0.49 an impact; constant restoring moment",
        text: ROCKING.into(),
        set: Vec::new(),
        solvers: BOTH,
        view: View::histories([Curve::new("theta", RADIAN).against(curve)]),
        checks,
    }
}
