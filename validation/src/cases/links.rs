//! Links at rest and isolators. A chain of static analyses ends in a short dynamic one without any
//! load that varies: it must stay where the static solution is, so both solvers confirm it.

use super::set;
use super::sliding::coulomb;
use crate::case::BOTH;
use crate::unit::{INCH, JOULE, KIP, METRE, NEWTON, POUND_FORCE, SECOND};
use crate::{Case, Check, Curve, View};
use std::f64::consts::TAU;

/// A bar that shortens by cooling until a hook at its end holds it; the strain is a force.
const HOOK: &str = r#"(
    title: "Hook and a bar that cools",
    units: (length: "in", force: "kip", time: "s"),
    parameters: { "e": 29000, "a": 10, "strain": 6.5e-4 },
    nodes: { "wall": (0, 0, 0), "end": (100, 0, 0) },
    supports: { "wall": Fixed, "end": (Uy, Uz, Rx, Ry, Rz) },
    elements: {
        "bar": Truss(nodes: ("wall", "end"), young: "e", area: "a"),
        "mass": Mass(node: "end", mass: 0.01),
        "hook": Hook(node: "end", axis1: (-1, 0, 0), axis2: (0, 0, 1), k: 5000, opening: 0.04),
    },
    loads: { "cooling": [(node: "end", dof: Ux, force: "-e*a*strain")] },
    cases: {
        "cooling": Static(loads: ["cooling"]),
        "rest": Dynamic(after: "cooling", duration: 0.1, dt: 0.001),
    },
    outputs: {
        "u": Displacement(node: "end", dof: Ux, factor: -1),
        "hook": LinkForce(link: "hook", axis: U1),
    },
)"#;

const GAP: &str = r#"(
    title: "Gap closed by a bar that is heated",
    units: (length: "in", force: "lbf", time: "s"),
    parameters: { "e": 10.5e6, "strain": 1.25e-3 },
    nodes: { "wall": (0, 0, 0), "end": (3, 0, 0) },
    supports: { "wall": Fixed, "end": (Uy, Uz, Rx, Ry, Rz) },
    elements: {
        "bar": Truss(nodes: ("wall", "end"), young: "e", area: 1),
        "mass": Mass(node: "end", mass: 0.01),
        // ten thousand times as stiff as the bar
        "stop": Gap(node: "end", axis1: (-1, 0, 0), axis2: (0, 0, 1), k: "1e4*e/3", opening: 0.002),
    },
    loads: { "heating": [(node: "end", dof: Ux, force: "e*strain")] },
    cases: {
        "heating": Static(loads: ["heating"]),
        // The tolerance counts energy, of which the stiff stop holds a ten-thousandth of the bar's: at 1e-4
        // FNA lets its force flutter by 0.4 %.
        "rest": Dynamic(
            after: "heating", duration: 0.01, dt: 0.0001, step: Adaptive(tolerance: 1e-5),
        ),
    },
    outputs: { "stop": LinkForce(link: "stop", axis: U1) },
)"#;

/// Hinged square with two diagonals, of which one may be a cable or a strut.
const FRAME: &str = r#"(
    title: "Braced square",
    units: (length: "in", force: "kip", time: "s"),
    plane: XZ,
    nodes: { "a": (0, 0, 0), "b": (120, 0, 0), "c": (0, 0, 120), "d": (120, 0, 120) },
    supports: { "a": Fixed, "b": Fixed, "c": Ry, "d": Ry },
    properties: { "bar": Truss(young: 30000, area: 8) },
    elements: {
        "left": Truss(nodes: ("a", "c"), use: "bar"),
        "right": Truss(nodes: ("b", "d"), use: "bar"),
        "top": Truss(nodes: ("c", "d"), use: "bar"),
        "rising": @RISING@,
        "falling": @FALLING@,
        "mass c": Mass(node: "c", mass: 0.1),
        "mass d": Mass(node: "d", mass: 0.1),
    },
    loads: { "push": [(node: "c", dof: Ux, force: 100)] },
    cases: {
        "push": Static(loads: ["push"]),
        "rest": Dynamic(after: "push", duration: 0.1, dt: 0.001),
    },
    outputs: {
        "u": Displacement(node: "c", dof: Ux),
        "left": ElementForce(element: "left", end: 0, dof: Uz),
        @MORE@
    },
)"#;

/// A node pressed against a rough spring contact and pushed along it, step by step.
const CONTACT: &str = r#"(
    title: "Contact with friction, sticking and slip back",
    nodes: { "n": (0, 0, 0) },
    supports: { "n": (Uz, Rx, Ry, Rz) },
    elements: {
        "spring": Spring(node: "n", k2: 1, k3: 1),
        "mass": Mass(node: "n", mass: 1),
        "contact": NLink(
            node: "n", axis1: (1, 0, 0), axis2: (0, 1, 0), kn: 1, ks: 0.5, mu: 0.5, opening: 0.5,
        ),
    },
    loads: {
        "press": [(node: "n", dof: Ux, force: -1)],
        "push": [(node: "n", dof: Uy, force: 1)],
    },
    cases: {
        "half": Static(loads: [(load: "press", factor: 0.5)]),
        "t = 0.5": Dynamic(after: "half", duration: 1, dt: 0.1),
        "full": Static(after: "half", loads: [(load: "press", factor: 0.5)]),
        "t = 1": Dynamic(after: "full", duration: 1, dt: 0.1),
        "stick": Static(after: "full", loads: [(load: "push", factor: 0.2)]),
        "t = 1.05": Dynamic(after: "stick", duration: 1, dt: 0.1),
        "slip": Static(after: "stick", loads: [(load: "push", factor: 1.8)]),
        "t = 1.5": Dynamic(after: "slip", duration: 1, dt: 0.1),
        "back": Static(after: "slip", loads: [(load: "push", factor: -0.2)]),
        "t = 1.55": Dynamic(after: "back", duration: 1, dt: 0.1),
        "off": Static(after: "back", loads: [(load: "push", factor: -1.8)]),
        "t = 2": Dynamic(after: "off", duration: 1, dt: 0.1),
    },
    outputs: {
        "ux": Displacement(node: "n", dof: Ux),
        "uy": Displacement(node: "n", dof: Uy),
    },
)"#;

/// A friction pendulum under 1 MN: let go, or led through one cycle of ±0.1 m.
const PENDULUM: &str = r#"(
    title: "Friction pendulum",
    parameters: { "mu_slow": 0.06, "mu_fast": 0.06, "u0": "0.25 m", "dt": "5 ms" },
    nodes: { "free": (0, 0, 0), "led": (10, 0, 0) },
    supports: { "free": (Uy, Rx, Ry, Rz), "led": (Ux, Uy, Rx, Ry, Rz) },
    properties: {
        "pendulum": NLink(
            kn: "1e10 N/m", ks: "1e10 N/m", radius: "1.5 m",
            mu_slow: "mu_slow", mu_fast: "mu_fast", rate: "20 s/m",
        ),
        "mass": Mass(mass: "1e6/9.80665"),
    },
    elements: {
        "free": NLink(node: "free", use: "pendulum"),
        "led": NLink(node: "led", use: "pendulum"),
        "mass free": Mass(node: "free", use: "mass"),
        "mass led": Mass(node: "led", use: "mass"),
    },
    functions: { "cycle": Sine(amplitude: "0.1 m", frequency: "1 Hz") },
    cases: {
        "gravity": Static(loads: [Gravity]),
        "release": Dynamic(
            after: "gravity", duration: "5 s", dt: "dt",
            initial: [(node: "free", dof: Ux, displacement: "u0")],
        ),
        "cycle": Dynamic(
            after: "gravity", duration: "1 s", dt: "1 ms",
            supports: [(node: "led", dof: Ux, displacement: "cycle")],
        ),
    },
    outputs: {
        "u": Displacement(node: "free", dof: Ux),
        "led": Displacement(node: "led", dof: Ux),
        "force": LinkForce(link: "led", axis: U2),
    },
)"#;

/// The pendulum without friction starts in its dynamic analysis: a static one has nothing to hold it.
const SMOOTH: &str = r#"(
    title: "Pendulum without friction",
    nodes: { "free": (0, 0, 0) },
    supports: { "free": (Uy, Rx, Ry, Rz) },
    elements: {
        "pendulum": NLink(node: "free", kn: "1e10 N/m", radius: "1.5 m"),
        "mass": Mass(node: "free", mass: "1e6/9.80665"),
    },
    cases: {
        "release": Dynamic(
            duration: "5 s", dt: "5 ms", constant: [Gravity],
            initial: [
                (node: "free", dof: Ux, displacement: "0.25 m"),
                (node: "free", dof: Uz, displacement: "-1e6/1e10"),
            ],
        ),
    },
    outputs: { "u": Displacement(node: "free", dof: Ux) },
)"#;

pub(super) fn cases() -> Vec<Case> {
    let mut all = vec![lk2(), lk3(), sl10()];
    all.extend(lk11());
    all.extend(lk12());
    all
}

fn lk2() -> Case {
    let force = (0.065 - 0.04) / (1.0 / 2900.0 + 1.0 / 5000.0);
    Case {
        id: "LK-2",
        title: "Hook with thermal contraction",
        source: "CSI Software Verification 6-004, by hand",
        text: HOOK.into(),
        set: Vec::new(),
        solvers: BOTH,
        view: View::histories([Curve::new("hook", KIP).against(move |_| force)]),
        checks: vec![
            Check::new("hook force", KIP, force, 1e-4, |r| r.at("hook", 0.0)),
            Check::new("hook force after 0.1 s", KIP, force, 1e-4, |r| r.last("hook")),
            Check::new("shortening", INCH, 0.04918, 1e-4, |r| r.at("u", 0.0)).published(),
        ],
    }
}

fn lk3() -> Case {
    Case {
        id: "LK-3",
        title: "Gap closed by heating",
        source: "ANSYS VM27",
        text: GAP.into(),
        set: Vec::new(),
        solvers: BOTH,
        view: View::histories([Curve::new("stop", POUND_FORCE).against(|_| -6125.0)]),
        checks: vec![
            Check::new("stop force", POUND_FORCE, -6125.0, 1e-3, |r| r.at("stop", 0.0)).published(),
            Check::new("stop force after 10 ms", POUND_FORCE, -6125.0, 1e-3, |r| r.last("stop"))
                .published(),
            Check::new("largest stop force in 10 ms", POUND_FORCE, 6125.0, 1e-3, |r| {
                r.peak("stop", 0.0, 1.0)
            })
            .published(),
        ],
    }
}

fn sl10() -> Case {
    let at = |analysis, output: &'static str, reference: f64| {
        Check::new(format!("{output} at {analysis}"), METRE, reference, 1e-5, move |r| {
            r.last(output)
        })
        .published()
        .in_analysis(analysis)
    };
    Case {
        id: "SL-10",
        title: "Static contact with friction, sticking and slip back",
        source: "Code_Aster SSND116",
        text: CONTACT.into(),
        set: Vec::new(),
        solvers: BOTH,
        view: crate::View::default(),
        checks: vec![
            at("t = 0.5", "ux", -0.5),
            at("t = 1", "ux", -0.75),
            at("t = 1.05", "uy", 2.0 / 15.0),
            at("t = 1.5", "uy", 1.875),
            at("t = 1.55", "uy", 1.741_666_7),
            at("t = 2", "uy", 0.125),
        ],
    }
}

fn lk11() -> Vec<Case> {
    let case = |id, title, set, checks, view| Case {
        id,
        title,
        source: "Friction pendulum: F = (W/R) u + μ W sgn(v)",
        text: PENDULUM.into(),
        set,
        solvers: BOTH,
        view,
        checks,
    };
    let cycle = |slow: f64| {
        let point = |i: u32| {
            let (s, c) = (TAU * f64::from(i) / 720.0).sin_cos();
            let v = 0.1 * TAU * c;
            let mu = 0.06 - (0.06 - slow) * (-20.0 * v.abs()).exp();
            (0.1 * s, 1e6 * (0.1 * s / 1.5 + mu * v.signum()))
        };
        let reference = (0..=720).map(point).collect();
        View::Path { x: ("led", METRE), y: ("force", NEWTON), reference }
    };
    let w = (9.80665_f64 / 1.5).sqrt();
    let release = Curve::new("u", METRE).against(coulomb(0.25, 0.09, w)).in_analysis("release");
    let p = 5e-3;
    let loop_area = Check::new("energy of a cycle", JOULE, 24_000.0, p, |r| r.heat("led"));
    let graded = Check::new("energy of a cycle", JOULE, 23_922.377, p, |r| r.heat("led"));
    vec![
        case(
            "LK-11a",
            "Friction pendulum let go, and through a cycle",
            Vec::new(),
            vec![
                Check::new("turning point", METRE, -0.07, p, |r| r.min("u", 0.0, 5.0))
                    .in_analysis("release")
                    .mark("u", 0.5 * TAU / w),
                Check::new("u at rest", METRE, -0.07, p, |r| r.last("u"))
                    .in_analysis("release")
                    .mark("u", 5.0),
                loop_area.in_analysis("cycle"),
            ],
            View::Several(vec![View::histories([release]), cycle(0.06)]),
        ),
        case(
            "LK-11b",
            "Friction that depends on speed through a cycle",
            vec![set("mu_slow", 0.03)],
            vec![graded.in_analysis("cycle")],
            cycle(0.03),
        ),
        Case {
            id: "LK-11c",
            title: "Period of the pendulum without friction",
            source: "T = 2π √(R/g)",
            text: SMOOTH.into(),
            set: Vec::new(),
            solvers: BOTH,
            view: View::histories([Curve::new("u", METRE).against(move |t| 0.25 * (w * t).cos())]),
            checks: vec![Check::new("period", SECOND, TAU * (1.5_f64 / 9.80665).sqrt(), p, |r| {
                2.0 * (r.crossing("u", 0.0, 1) - r.crossing("u", 0.0, 0))
            })],
        },
    ]
}

fn lk12() -> Vec<Case> {
    let bar = |nodes: &str| format!("Truss(nodes: {nodes}, use: \"bar\")");
    let (rising, falling) = ("(\"a\", \"d\")", "(\"b\", \"c\")");
    let stiffness = "\"30000*8/(120*2^0.5)\"";
    let text = |r: String, f: String, more: &str| {
        FRAME.replace("@RISING@", &r).replace("@FALLING@", &f).replace("@MORE@", more)
    };
    let p = 1e-4;
    let u = |x: f64| Check::new("u", INCH, x, p, |r| r.at("u", 0.0));
    let case = |id, title, source, text, checks| Case {
        id,
        title,
        source,
        text,
        set: Vec::new(),
        solvers: BOTH,
        view: crate::View::default(),
        checks,
    };
    let more = r#""horizontal": ElementForce(element: "rising", end: 0, dof: Ux),
        "vertical": ElementForce(element: "rising", end: 0, dof: Uz),"#;
    let hook = format!("Hook(nodes: {rising}, k: {stiffness})");
    let strut = format!("Gap(nodes: {falling}, k: {stiffness})");
    vec![
        case(
            "LK-12a",
            "Braced square, linear",
            "CSI Software Verification 1-012",
            text(bar(rising), bar(falling), more),
            vec![
                u(0.10677).published(),
                Check::new("left reaction, horizontal", KIP, -44.224, p, |r| {
                    r.at("horizontal", 0.0)
                })
                .published(),
                Check::new("left reaction, vertical", KIP, -100.0, p, |r| {
                    r.at("vertical", 0.0) + r.at("left", 0.0)
                })
                .published(),
            ],
        ),
        // Pushed to the right, the diagonal that rises to the right is in tension.
        case(
            "LK-12b",
            "Braced square, the diagonal in compression slack",
            "CSI Software Verification 1-012, by hand",
            text(
                hook,
                format!("Hook(nodes: {falling}, k: {stiffness})"),
                r#""diagonal": LinkForce(link: "rising", axis: U1),
                "slack": LinkForce(link: "falling", axis: U1),"#,
            ),
            vec![
                u(0.241_421),
                Check::new("tension", KIP, 100.0 * 2.0_f64.sqrt(), p, |r| r.at("diagonal", 0.0)),
                Check::new("slack diagonal", KIP, 0.0, 1e-9, |r| r.at("slack", 0.0)).absolute(),
                Check::new("u after 0.1 s", INCH, 0.241_421, p, |r| r.last("u")),
            ],
        ),
        case(
            "LK-12c",
            "Braced square, the diagonal in tension slack",
            "CSI Software Verification 1-012, by hand",
            text(
                format!("Gap(nodes: {rising}, k: {stiffness})"),
                strut,
                r#""diagonal": LinkForce(link: "falling", axis: U1),"#,
            ),
            vec![
                u(0.191_421),
                Check::new("compression", KIP, -100.0 * 2.0_f64.sqrt(), p, |r| {
                    r.at("diagonal", 0.0)
                }),
            ],
        ),
    ]
}
