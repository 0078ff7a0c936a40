//! Elastic laws of several branches, made of gaps and hooks that are closed from the start: a gap and a
//! hook with the same interference cancel at rest, and each opens at its own end.

use crate::case::BOTH;
use crate::unit::{INCH, METRE, NEWTON, SECOND};
use crate::{Case, Check, Curve, View};
use std::fmt::Write as _;

/// 2e8 N/m up to 5e4 N, 1e8 N/m beyond: one of the two always acts, both of them in between.
const SOFTENING: &str = r#"(
    title: "Bilinear elastic link moved to and fro",
    nodes: { "p": (0, 0, 0), "m": (1, 0, 0) },
    supports: { "p": Fixed, "m": (Uy, Uz, Rx, Ry, Rz) },
    elements: {
        "gap": Gap(
            node: "p", axis1: (1, 0, 0), axis2: (0, 0, 1), k: "1e8 N/m", opening: "-0.25 mm",
        ),
        "hook": Hook(
            node: "p", axis1: (1, 0, 0), axis2: (0, 0, 1), k: "1e8 N/m", opening: "-0.25 mm",
        ),
        "mass": Mass(node: "m", mass: "1 kg"),
        "spring": Spring(node: "m", k2: "1 N/m"),
    },
    functions: { "motion": Sine(amplitude: "0.8 mm", frequency: "1 Hz") },
    cases: {
        "motion": Dynamic(
            duration: "1 s", dt: "1 ms", supports: [(node: "p", dof: Ux, displacement: "motion")],
        ),
    },
    outputs: {
        "u": Displacement(node: "p", dof: Ux),
        "gap": LinkForce(link: "gap", axis: U1),
        "hook": LinkForce(link: "hook", axis: U1),
    },
)"#;

/// A gap pressed by 150 lbf: 200 y up to 0.75 in and no further.
const YIELDING: &str = r#"(
    title: "Mass on a softening elastic link, struck",
    units: (length: "in", force: "lbf", time: "s"),
    nodes: { "m": (0, 0, 0) },
    supports: { "m": (Uy, Uz, Rx, Ry, Rz) },
    elements: {
        "mass": Mass(node: "m", mass: 0.5),
        "gap": Gap(node: "m", axis1: (1, 0, 0), axis2: (0, 0, 1), k: 200, opening: -0.75),
    },
    loads: { "preload": [(node: "m", dof: Ux, force: -150)] },
    cases: {
        "struck": Dynamic(
            duration: 0.15, dt: 0.0005, constant: ["preload"],
            initial: [(node: "m", dof: Ux, velocity: 20)],
        ),
    },
    outputs: { "u": Displacement(node: "m", dof: Ux) },
)"#;

/// 2 x + 4 x³ by chords over steps of 0.02: a spring, and a gap and a hook more at each of them.
fn hardening() -> String {
    let n = 50;
    let step = 1.0 / f64::from(n);
    let slope = |i: i32| {
        let f = |x: f64| 2.0 * x + 4.0 * x.powi(3);
        (f(f64::from(i + 1) * step) - f(f64::from(i) * step)) / step
    };
    let mut links = String::new();
    for i in 1..n {
        let (k, opening) = (slope(i) - slope(i - 1), f64::from(i) * step);
        for kind in ["Gap", "Hook"] {
            let _ = writeln!(
                links,
                "        \"{kind} {i}\": {kind}(node: \"m\", axis1: (1, 0, 0), axis2: (0, 0, 1), \
                 k: {k}, opening: {opening}),"
            );
        }
    }
    format!(
        r#"(
    title: "Mass on a hardening spring, let go",
    units: (length: "in", force: "lbf", time: "s"),
    nodes: {{ "m": (0, 0, 0) }},
    supports: {{ "m": (Uy, Uz, Rx, Ry, Rz) }},
    elements: {{
        "mass": Mass(node: "m", mass: 2.588e-3),
        "spring": Spring(node: "m", k2: {}),
{links}    }},
    cases: {{
        "free": Dynamic(
            duration: 0.16, dt: 0.001, initial: [(node: "m", dof: Ux, displacement: 1)],
        ),
    }},
    outputs: {{ "u": Displacement(node: "m", dof: Ux) }},
)"#,
        slope(0)
    )
}

/// Complete elliptic integral of the first kind of a parameter, by the arithmetic-geometric mean.
fn elliptic(parameter: f64) -> f64 {
    let (mut a, mut b) = (1.0, (1.0 - parameter).sqrt());
    for _ in 0..20 {
        (a, b) = (0.5 * (a + b), f64::sqrt(a * b));
    }
    std::f64::consts::FRAC_PI_2 / a
}

pub(super) fn cases() -> Vec<Case> {
    vec![lk4(), lk5(), lk7()]
}

fn lk4() -> Case {
    // Exact law: the tolerance is that of linear laws elsewhere.
    let at = |u: f64, branch: usize, what: &str, force: f64| {
        Check::new(format!("force at {u} m, {what}"), NEWTON, force, 1e-4, move |r| {
            let t = r.crossing("u", u, branch);
            r.at("gap", t) + r.at("hook", t)
        })
        .published()
    };
    let top = Check::new("force at 0.0008 m", NEWTON, 1.05e5, 1e-4, |r| {
        let (t, _) = r.extreme("u", 1.0, 0.0, 0.5);
        r.at("gap", t) + r.at("hook", t)
    });
    Case {
        id: "LK-4",
        title: "Bilinear elastic link",
        source: "Code_Aster SSND103",
        text: SOFTENING.into(),
        set: Vec::new(),
        solvers: BOTH,
        checks: vec![at(2e-4, 0, "loading", 4e4), top.published(), at(2e-4, 1, "unloading", 4e4)],
        view: View::histories([Curve::new("gap", NEWTON), Curve::new("hook", NEWTON)]),
    }
}

fn lk5() -> Case {
    // 20 in/s on a mass of 0.5: y = sin 20t up to 0.75, then slowed by 300 in/s².
    let t1 = 0.75_f64.asin() / 20.0;
    let v1 = 20.0 * (20.0 * t1).cos();
    let p = 3e-3;
    Case {
        id: "LK-5",
        title: "Mass on a softening elastic link, struck",
        source: "ANSYS VM79; Thomson",
        text: YIELDING.into(),
        set: Vec::new(),
        solvers: BOTH,
        checks: vec![
            Check::new("largest u", INCH, 1.0417, p, |r| r.max("u", 0.0, 0.15)).published(),
            Check::new("time of largest u", SECOND, t1 + v1 / 300.0, p, |r| {
                r.extreme("u", 1.0, 0.0, 0.15).0
            }),
        ],
        view: View::histories([Curve::new("u", INCH).against(move |t| {
            let s = t - t1;
            let back = 2.0 * v1 / 300.0;
            if s < 0.0 {
                (20.0 * t).sin()
            } else if s < back {
                0.75 + v1 * s - 150.0 * s * s
            } else {
                0.75 * (20.0 * (s - back)).cos() - v1 / 20.0 * (20.0 * (s - back)).sin()
            }
        })]),
    }
}

fn lk7() -> Case {
    let (k1, k3, m): (f64, f64, f64) = (2.0, 4.0, 2.588e-3);
    let period = 4.0 * elliptic(0.5 * k3 / (k1 + k3)) / ((k1 + k3) / m).sqrt();
    Case {
        id: "LK-7",
        title: "Hardening spring in 50 chords, let go",
        source: "Timoshenko (data of ANSYS VM156): T = 4 K(m)/√((k₁ + k₃A²)/m)",
        text: hardening(),
        set: Vec::new(),
        solvers: BOTH,
        checks: vec![
            Check::new("period", SECOND, period, 1e-3, |r| {
                2.0 * (r.crossing("u", 0.0, 1) - r.crossing("u", 0.0, 0))
            }),
            Check::new("amplitude after a period", METRE, 0.0254, 1e-3, |r| r.max("u", 0.1, 0.16)),
        ],
        view: View::histories([Curve::new("u", INCH)]),
    }
}
