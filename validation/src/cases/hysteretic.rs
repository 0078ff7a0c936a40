//! Links of one axis with a law of their own: Wen's, elastic and plastic curves through points.

use crate::case::BOTH;
use crate::unit::{INCH, KIP, METRE, NEWTON, SECOND, Unit};
use crate::{Case, Check, Curve, Solver, View};

/// Three exponents under the same motion; the mass only gives the solver something to move.
const WEN: &str = r#"(
    title: "Wen's spring moved to and fro",
    units: (length: "in", force: "kip", time: "s"),
    nodes: { "p": (0, 0, 0), "m": (10, 0, 0) },
    supports: { "p": Fixed, "m": (Uy, Uz, Rx, Ry, Rz) },
    properties: { "wen": Wen(axis: U2, k: 100, fy: 50, ratio: 0.1) },
    elements: {
        "n = 1": Wen(node: "p", use: "wen", exponent: 1),
        "n = 2": Wen(node: "p", use: "wen", exponent: 2),
        "n = 20": Wen(node: "p", use: "wen", exponent: 20),
        "mass": Mass(node: "m", mass: 1),
        "spring": Spring(node: "m", k2: 1),
    },
    functions: { "motion": Sine(amplitude: 10, frequency: 0.025) },
    cases: {
        "motion": Dynamic(
            duration: 30, dt: 0.002, supports: [(node: "p", dof: Ux, displacement: "motion")],
        ),
    },
    outputs: {
        "u": Displacement(node: "p", dof: Ux),
        "force, n = 1": LinkForce(link: "n = 1", axis: U2),
        "force, n = 2": LinkForce(link: "n = 2", axis: U2),
        "force, n = 20": LinkForce(link: "n = 20", axis: U2),
    },
)"#;

/// The curve of LK-4 in one link.
const SOFTENING: &str = r#"(
    title: "Elastic link through points moved to and fro",
    nodes: { "p": (0, 0, 0), "m": (1, 0, 0) },
    supports: { "p": Fixed, "m": (Uy, Uz, Rx, Ry, Rz) },
    elements: {
        "link": MultilinearElastic(
            node: "p", axis: U2, deformation: ["-1 mm", "-0.25 mm", "0 m", "0.25 mm", "1 mm"],
            force: ["-125 kN", "-50 kN", "0 N", "50 kN", "125 kN"],
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
        "force": LinkForce(link: "link", axis: U2),
    },
)"#;

/// The mass of LK-5 on one link.
const STRUCK: &str = r#"(
    title: "Mass on an elastic link through points, struck",
    units: (length: "in", force: "lbf", time: "s"),
    nodes: { "m": (0, 0, 0) },
    supports: { "m": (Uy, Uz, Rx, Ry, Rz) },
    elements: {
        "mass": Mass(node: "m", mass: 0.5),
        "link": MultilinearElastic(
            node: "m", axis: U2, deformation: [-2, -0.75, 0, 0.75, 2], force: [-150, -150, 0, 150, 150],
        ),
    },
    cases: {
        "struck": Dynamic(
            duration: 0.2, dt: 0.0005, initial: [(node: "m", dof: Ux, velocity: 20)],
        ),
    },
    outputs: { "u": Displacement(node: "m", dof: Ux) },
)"#;

/// The oscillator of Chopra's example 5.5, elastoplastic.
/// The force is that of the book, straight between the samples of a half sine: a half sine itself cuts the steps.
const YIELDING: &str = r#"(
    title: "Elastoplastic oscillator under a half sine",
    nodes: { "m": (0, 0, 0) },
    supports: { "m": (Uy, Uz, Rx, Ry, Rz) },
    elements: {
        "mass": Mass(node: "m", mass: 0.2533),
        "damping": Spring(node: "m", c2: "2*0.05*(0.2533*10)^0.5"),
        "spring": MultilinearPlastic(
            node: "m", axis: U2, deformation: [-2, -0.75, 0, 0.75, 2], force: [-7.5, -7.5, 0, 7.5, 7.5],
        ),
    },
    loads: { "push": [(node: "m", dof: Ux, force: 10)] },
    functions: { "sine": Points(
        points: [(0, 0), (0.1, 0.5), (0.2, "3^0.5/2"), (0.3, 1), (0.4, "3^0.5/2"), (0.5, 0.5), (0.6, 0)], after_end: Zero,
    ) },
    cases: {
        "push": Dynamic(
            duration: 1, dt: 0.1, step: Fixed(substeps: 1), alpha: 0, energy_limit: 0.99,
            forces: [(load: "push", function: "sine")],
        ),
    },
    outputs: { "u": Displacement(node: "m", dof: Ux) },
)"#;

pub(super) fn cases() -> Vec<Case> {
    vec![lk1(), lk4(), lk5(), lk9()]
}

/// z after loading by x from rest, and after unloading from ±1 and loading by x on the other side, by the
/// closed forms of n = 1 and 2; the force of the whole.
fn wen(d: f64, turned: bool, z: fn(f64) -> f64) -> f64 {
    let z = if turned {
        let left = (10.0 - d) * 2.0;
        if left < 1.0 { 1.0 - left } else { -z(left - 1.0) }
    } else {
        z(2.0 * d)
    };
    10.0 * d + 45.0 * z
}

fn lk1() -> Case {
    // d in inches, how often it was there before, and forces in kips for n = 1, 2 and 20.
    let values = [
        (0.25, 0, [20.20612, 23.29527, 25.0]),
        (0.5, 0, [33.44543, 39.27174, 48.51015]),
        (1.0, 0, [48.90991, 53.38124, 55.0]),
        (2.0, 0, [64.17580, 64.96982, 65.0]),
        (9.75, 1, [120.0; 3]),
        (9.5, 1, [95.0; 3]),
        (9.0, 1, [61.55457, 55.72826, 46.48985]),
        (8.0, 1, [37.24042, 35.22254, 35.0]),
        (0.0, 0, [-45.0; 3]),
    ];
    let outputs = ["force, n = 1", "force, n = 2", "force, n = 20"];
    let mut checks = Vec::new();
    for (i, output) in outputs.into_iter().enumerate() {
        let mut all = vec![
            Check::new(format!("{output} at 10 in"), KIP, 145.0, 1e-4, move |r| r.at(output, 10.0)),
            Check::new(format!("{output} at -10 in"), KIP, -145.0, 1e-4, move |r| {
                r.at(output, 30.0)
            }),
        ];
        all.extend(values.map(|(d, n, forces)| {
            let turn = if n == 0 && d > 0.0 { "" } else { " after 10 in" };
            Check::new(format!("{output} at {d} in{turn}"), KIP, forces[i], 1e-4, move |r| {
                r.at(output, r.crossing("u", 0.0254 * d, n))
            })
        }));
        checks.extend(all.into_iter().map(|c| if i == 0 { c.published() } else { c }));
    }
    let curve = |output, z: fn(f64) -> f64| {
        Curve::new(output, KIP)
            .against(move |t| wen(10.0 * (std::f64::consts::TAU * 0.025 * t).sin(), t > 10.0, z))
    };
    Case {
        id: "LK-1",
        title: "Wen's spring, loading and reversal, exponents 1, 2 and 20",
        source: "CSI Software Verification 6-008; closed forms of z",
        text: WEN.into(),
        set: Vec::new(),
        solvers: BOTH,
        checks,
        view: View::histories([
            curve(outputs[0], |x| 1.0 - (-x).exp()),
            curve(outputs[1], f64::tanh),
            Curve::new(outputs[2], KIP),
        ]),
    }
}

fn lk4() -> Case {
    let at = |u: f64, branch: usize, what: &str, force: f64| {
        Check::new(format!("force at {u} m, {what}"), NEWTON, force, 1e-4, move |r| {
            r.at("force", r.crossing("u", u, branch))
        })
        .published()
    };
    let top = Check::new("force at 0.0008 m", NEWTON, 1.05e5, 1e-4, |r| r.max("force", 0.0, 0.5));
    let force = |u: f64| if u.abs() < 2.5e-4 { 2e8 * u } else { 1e8 * u + 2.5e4 * u.signum() };
    let reference = (-80..=80).map(|i| 1e-5 * f64::from(i)).map(|u| (1e3 * u, force(u))).collect();
    Case {
        id: "LK-4b",
        title: "Bilinear elastic link through points",
        source: "Code_Aster SSND103",
        text: SOFTENING.into(),
        set: Vec::new(),
        solvers: BOTH,
        checks: vec![at(2e-4, 0, "loading", 4e4), top.published(), at(2e-4, 1, "unloading", 4e4)],
        view: View::Path {
            x: ("u", Unit { name: "mm", si: 1e-3 }),
            y: ("force", NEWTON),
            reference,
        },
    }
}

fn lk5() -> Case {
    // 20 in/s on a mass of 0.5: y = sin 20t up to 0.75, then slowed by 300 in/s², and the same downwards.
    let t1 = 0.75_f64.asin() / 20.0;
    let v1 = 20.0 * (20.0 * t1).cos();
    let p = 3e-3;
    Case {
        id: "LK-5b",
        title: "Mass on an elastic link through points, struck",
        source: "ANSYS VM79; Thomson",
        text: STRUCK.into(),
        set: Vec::new(),
        solvers: BOTH,
        checks: vec![
            Check::new("largest u", INCH, 1.0417, p, |r| r.max("u", 0.0, 0.2)).published(),
            Check::new("time of largest u", SECOND, t1 + v1 / 300.0, p, |r| {
                r.extreme("u", 1.0, 0.0, 0.2).0
            }),
            Check::new("first return", SECOND, 2.0 * (t1 + v1 / 300.0), p, |r| {
                r.crossings("u", 0.0).into_iter().find(|t| *t > 0.05).unwrap_or(f64::NAN)
            }),
        ],
        view: View::histories([Curve::new("u", INCH).against(move |t| {
            let s = t - t1;
            let back = 2.0 * v1 / 300.0;
            if s < 0.0 {
                (20.0 * t).sin()
            } else if s < back {
                0.75 + v1 * s - 150.0 * s * s
            } else if s < back + t1 {
                0.75 * (20.0 * (s - back)).cos() - v1 / 20.0 * (20.0 * (s - back)).sin()
            } else {
                f64::NAN
            }
        })]),
    }
}

fn lk9() -> Case {
    let u = [0.0437, 0.2326, 0.6121, 1.1144, 1.6215, 1.9892, 2.0952, 1.9241, 1.5603, 1.1416];
    let step = |(i, x): (usize, f64)| {
        let t = 0.1 * (i + 1) as f64;
        Check::new(format!("u({t:.1})"), METRE, x, 2e-4, move |r| r.at("u", t))
            .absolute()
            .mark("u", t)
            .published()
    };
    Case {
        id: "LK-9",
        title: "Elastoplastic oscillator, average acceleration in steps of 0.1 s",
        source: "Chopra, Dynamics of Structures, ex. 5.5",
        text: YIELDING.into(),
        set: Vec::new(),
        solvers: &[Solver::Hht],
        checks: u.into_iter().enumerate().map(step).collect(),
        view: View::histories([Curve::new("u", METRE)]),
    }
}
