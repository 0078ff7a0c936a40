//! Friction under steady shaking, pulses, and at the edge of slip.

use super::set;
use super::sliding::Slider;
use crate::case::BOTH;
use crate::unit::{METRE, NEWTON, NUMBER, SECOND, SPEED, Unit};
use crate::{Case, Check, Curve, View};
use std::f64::consts::{FRAC_PI_2, PI, TAU};

const G: f64 = 9.80665;
const WATT: Unit = Unit::si("W");

/// A block on a moving base; the contact is so stiff that its play before slip is 2 nm.
const BLOCK: &str = r#"(
    title: "Sliding block",
    parameters: {
        "mu": 0.2, "a": "1.5 g", "frequency": "5 Hz", "cycles": 1, "duration": "0.6 s",
        "tolerance": 1e-5,
    },
    nodes: { "m": (0, 0, 0) },
    supports: { "m": (Uy, Rx, Ry, Rz) },
    elements: {
        "mass": Mass(node: "m", mass: "1 t"),
        "friction": NLink(node: "m", kn: "1e12 N/m", ks: "1e12 N/m", mu: "mu"),
    },
    functions: { "shaking": Sine(amplitude: "a", frequency: "frequency", cycles: "cycles") },
    cases: {
        "gravity": Static(loads: [Gravity]),
        "shaking": Dynamic(
            after: "gravity", duration: "duration", dt: "0.5 ms",
            step: Adaptive(tolerance: "tolerance"),
            base: [(direction: X, function: "shaking")],
        ),
    },
    outputs: { "u": Displacement(node: "m", dof: Ux), "v": Velocity(node: "m", dof: Ux) },
)"#;

const PULSE: &str = r#"(
    title: "Sliding block under a rectangular pulse",
    nodes: { "m": (0, 0, 0) },
    supports: { "m": (Uy, Rx, Ry, Rz) },
    elements: {
        "mass": Mass(node: "m", mass: "1 t"),
        "friction": NLink(node: "m", kn: "1e12 N/m", ks: "1e12 N/m", mu: 0.2),
    },
    functions: { "pulse": Step(amplitude: "0.5 g", end: "0.1 s") },
    cases: {
        "gravity": Static(loads: [Gravity]),
        "pulse": Dynamic(
            after: "gravity", duration: "0.4 s", dt: "0.5 ms",
            base: [(direction: X, function: "pulse")],
        ),
    },
    outputs: { "u": Displacement(node: "m", dof: Ux), "v": Velocity(node: "m", dof: Ux) },
)"#;

const TABLE: &str = r#"(
    title: "Block on a vibrating table",
    parameters: { "a": "15 m/s^2", "tolerance": 1e-4 },
    nodes: { "m": (0, 0, 0) },
    supports: { "m": (Uy, Rx, Ry, Rz) },
    elements: {
        "mass": Mass(node: "m", mass: "1 kg"),
        "friction": NLink(node: "m", kn: "1e9 N/m", ks: "1e9 N/m", mu: 0.1),
    },
    loads: { "press": [(node: "m", dof: Uz, force: "-10 N")] },
    functions: { "shaking": Sine(amplitude: "a", frequency: "1 Hz") },
    cases: {
        "press": Static(loads: ["press"]),
        "shaking": Dynamic(
            after: "press", duration: "12 s", dt: "1 ms", step: Adaptive(tolerance: "tolerance"),
            base: [(direction: X, function: "shaking")],
        ),
    },
    outputs: { "u": Displacement(node: "m", dof: Ux) },
)"#;

const DEN_HARTOG: &str = r#"(
    title: "Steady vibration with friction",
    parameters: { "ratio": 0.8, "friction": 0.5, "tolerance": 1e-4 },
    nodes: { "m": (0, 0, 0) },
    supports: { "m": (Uy, Rx, Ry, Rz) },
    elements: {
        "mass": Mass(node: "m", mass: "1 kg"),
        "spring": Spring(node: "m", k2: "1e4 N/m"),
        "friction": NLink(node: "m", kn: "1e10 N/m", ks: "1e10 N/m", mu: "friction"),
    },
    loads: {
        "press": [(node: "m", dof: Uz, force: "-100 N")],
        "shake": [(node: "m", dof: Ux, force: "100 N")],
    },
    functions: { "shaking": Cosine(amplitude: 1, frequency: "ratio*100/(2*3.141592653589793)") },
    cases: {
        "press": Static(loads: ["press"]),
        "shaking": Dynamic(
            after: "press", duration: "120*2*3.141592653589793/(100*ratio)", dt: "1 ms",
            step: Adaptive(tolerance: "tolerance"),
            forces: [(load: "shake", function: "shaking")],
        ),
    },
    outputs: { "u": Displacement(node: "m", dof: Ux) },
)"#;

/// A node on a rough slope, pressed down and held horizontally by a spring: the spring gives way until
/// all friction acts up the slope. Only the static state counts: without damping a contact that slips
/// at its limit trembles.
const INCLINE: &str = r#"(
    title: "Body at the edge of slip on a slope",
    parameters: { "angle": 0.3490658503988659 },
    nodes: { "n": (0, 0, 0) },
    supports: { "n": (Uy, Rx, Ry, Rz) },
    elements: {
        "mass": Mass(node: "n", mass: 1),
        "holder": Spring(node: "n", k2: 1e8),
        "slope": NLink(
            node: "n", axis1: ("-sin(angle)", 0, "cos(angle)"), axis2: ("cos(angle)", 0, "sin(angle)"),
            kn: 1e9, ks: 1e9, mu: 0.3,
        ),
    },
    loads: { "press": [(node: "n", dof: Uz, force: -100)] },
    cases: {
        "press": Static(loads: ["press"], steps: 10),
        "rest": Dynamic(after: "press", duration: 0.01, dt: 0.01),
    },
    outputs: {
        "holder": Displacement(node: "n", dof: Ux, factor: "-1e8 N/m"),
        "normal": LinkForce(link: "slope", axis: U1, factor: -1),
        "friction": LinkForce(link: "slope", axis: U2, factor: -1),
    },
)"#;

pub(super) fn cases() -> Vec<Case> {
    let mut all = sl4();
    all.extend(sl5());
    all.push(sl6());
    all.extend(sl8());
    all.push(sl11());
    all
}

/// Mean of N |v| between two times.
fn power(r: &crate::Trace, from: f64, to: f64) -> f64 {
    (r.friction_heat(to) - r.friction_heat(from)) / (to - from) / 0.1
}

/// Stick and slip of a block on a table, by the mean of N |v| from 4 s to 12 s.
fn sl4() -> Vec<Case> {
    let case = |id, title, a: f64, tolerance: f64, checks| Case {
        id,
        title,
        source: "Code_Aster SDND104; slip by Westermo, Udwadia",
        text: TABLE.into(),
        set: vec![set("a", a), set("tolerance", tolerance)],
        solvers: BOTH,
        checks,
        view: View::histories([{
            let slider = Slider::new(a, TAU, f64::INFINITY, 1.0, 4.0);
            Curve::new("u", METRE).against(move |t| slider.at(t)).over(0.0, 4.0)
        }]),
    };
    let mean = |reference: f64, tolerance: f64| {
        Check::new("mean of N |v|", WATT, reference, tolerance, |r| power(r, 4.0, 12.0)).published()
    };
    let mut slip = vec![mean(15.2671, 1e-3)];
    let cycles =
        [17.935, 16.687, 16.012, 15.632, 15.414, 15.289, 15.216, 15.174, 15.149, 15.135, 15.126];
    for (i, x) in cycles.into_iter().enumerate() {
        let n = (i + 2) as f64;
        let check =
            Check::new(format!("mean in cycle {n}"), WATT, x, 1e-3, move |r| power(r, n - 1.0, n));
        slip.push(check.other_code());
    }
    vec![
        case(
            "SL-4",
            "Block on a vibrating table, stick-slip",
            1.5,
            1e-4,
            vec![
                mean(0.409062, 1e-3),
                // a = 1.5, μ g = 1: slip from asin(1/1.5)/ω to the next root of the relative velocity.
                Check::new("slip per half cycle", METRE, 0.020_453_12, 1e-3, |r| {
                    (r.at("u", 10.6) - r.at("u", 10.1)).abs()
                }),
            ],
        ),
        case("SL-4b", "Block on a vibrating table, slip all the time", 15.0, 1e-4, slip),
        case(
            "SL-4c",
            "Block on a vibrating table, just beyond sticking",
            1.01,
            1e-3,
            vec![mean(2.26164e-4, 1e-2)],
        ),
        case(
            "SL-4d",
            "Block on a vibrating table, sticking",
            0.99,
            1e-4,
            vec![mean(0.0, 0.0).absolute()],
        ),
    ]
}

/// The last time at which the block still slides.
fn stop(r: &crate::Trace) -> f64 {
    // Below 0.1 mm/s it comes to rest within 50 µs; its elastic play is slower still.
    let found = r.history("v").into_iter().rev().find(|(_, v)| v.abs() > 1e-4);
    found.map_or(f64::NAN, |(t, _)| t)
}

fn sl5() -> Vec<Case> {
    let p = 2e-3;
    let (mu, a, w) = (0.2 * G, 1.5 * G, 10.0 * PI);
    // Steady slip range 2 (A/ω²) √(1 − (π μ g/2A)²).
    let range = 2.0 * a / (w * w) * (1.0 - (FRAC_PI_2 * mu / a).powi(2)).sqrt();
    let case = |id, title, source, cycles: f64, duration: f64, end: f64, checks| Case {
        id,
        title,
        source,
        text: BLOCK.into(),
        set: vec![set("cycles", cycles), set("duration", duration)],
        solvers: BOTH,
        checks,
        view: View::histories([{
            let slider = Slider::new(a, w, cycles * TAU / w, mu, end);
            Curve::new("u", METRE).over(0.0, end).against(move |t| slider.at(t))
        }]),
    };
    let integrated = "Slip under 1.5 g, 5 Hz with μ = 0.2, piece by piece";
    let mut continuing = vec![
        Check::new("slip range", METRE, range, p, |r| r.max("u", 3.6, 3.8) - r.min("u", 3.6, 3.8)),
        Check::new("first reversal", SECOND, 0.160_874_7, p, |r| r.extreme("u", -1.0, 0.0, 0.25).0),
        Check::new("u at first reversal", METRE, -0.064_654_2, p, |r| r.min("u", 0.0, 0.25)),
        Check::new("largest |u| in ten cycles", METRE, 0.151_743_8, p, |r| r.peak("u", 0.0, 2.0)),
    ];
    for (n, u) in [
        (1, -0.05825),
        (2, -0.090_982),
        (3, -0.109_764),
        (4, -0.120_595),
        (5, -0.126_849),
        (10, -0.134_849),
    ] {
        let t = 0.2 * f64::from(n);
        let check = Check::new(format!("u after cycle {n}"), METRE, u, p, move |r| r.at("u", t));
        continuing.push(check.mark("u", t));
    }
    vec![
        case(
            "SL-5",
            "Block sliding under 1.5 g, 5 Hz that goes on",
            "Westermo, Udwadia: slip-slip motion",
            20.0,
            4.0,
            2.0,
            continuing,
        ),
        case(
            "SL-5b",
            "Block sliding under one sine of 1.5 g, 5 Hz",
            integrated,
            1.0,
            0.6,
            0.6,
            vec![
                Check::new("residual slip", METRE, -0.044_217_3, p, |r| r.last("u")),
                Check::new("end of slip", SECOND, 0.319_62, p, stop),
            ],
        ),
        case(
            "SL-5c",
            "Block sliding under a half sine of 1.5 g, 5 Hz",
            integrated,
            0.5,
            0.6,
            0.6,
            vec![
                Check::new("residual slip", METRE, -0.178_730_2, p, |r| r.last("u")),
                Check::new("end of slip", SECOND, 0.479_590_1, p, stop),
            ],
        ),
    ]
}

fn sl6() -> Case {
    let (a, mu, tp) = (0.5, 0.2, 0.1);
    Case {
        id: "SL-6",
        title: "Sliding block under a rectangular pulse",
        source: "Newmark",
        text: PULSE.into(),
        set: Vec::new(),
        solvers: BOTH,
        view: View::histories([
            Curve::new("v", SPEED).against(move |t| {
                let v = G * (t.min(tp) * a - t * mu);
                -v.max(0.0)
            }),
            Curve::new("u", METRE),
        ]),
        checks: vec![
            Check::new("largest speed", SPEED, (a - mu) * G * tp, 1e-3, |r| r.peak("v", 0.0, 0.4)),
            Check::new("slip", METRE, G * tp * tp * (a - mu) * a / (2.0 * mu), 1e-3, |r| {
                r.last("u").abs()
            }),
            Check::new("end of slip", SECOND, tp * a / mu, 1e-3, |r| r.crossing("v", 0.0, 0)),
        ],
    }
}

fn sl8() -> Vec<Case> {
    let case = |id, r: f64, f: f64, tolerance: f64| {
        let v = 1.0 / (1.0 - r * r);
        let u = (PI / r).sin() / (r * (1.0 + (PI / r).cos()));
        let amplitude = (v * v - f * f * u * u).sqrt();
        let end = 120.0 * TAU / (100.0 * r);
        // Half a cycle from a turning point on, in units of P/k and of 1/ω₀; the load leads by `lead`.
        let lead = (-f * u / v).asin();
        let half = move |t: f64| v * (r * t + lead).cos() + f * (1.0 - t.cos() - r * u * t.sin());
        let steady = move |t: f64| {
            let phase = (100.0 * r * t - lead).rem_euclid(TAU);
            0.01 * if phase < PI { half(phase / r) } else { -half((phase - PI) / r) }
        };
        Case {
            id,
            title: "Steady vibration with Coulomb friction, motion without stops",
            source: "Den Hartog",
            text: DEN_HARTOG.into(),
            set: vec![set("ratio", r), set("friction", f), set("tolerance", tolerance)],
            solvers: BOTH,
            checks: vec![Check::new(
                format!("amplitude k/P, ω/ωₙ = {r}, F/P = {f}"),
                NUMBER,
                amplitude,
                5e-3,
                move |t| t.peak("u", end * 0.98, end) * 1e4 / 100.0,
            )],
            view: View::histories([Curve::new("u", METRE).against(steady).over(0.97 * end, end)]),
        }
    };
    vec![
        case("SL-8", 0.8, 0.5, 1e-4),
        case("SL-8b", 0.8, 0.7, 1e-4),
        case("SL-8c", 1.25, 0.5, 1e-4),
        case("SL-8d", 2.0, 0.3, 1e-6),
    ]
}

fn sl11() -> Case {
    let at = |what: &str, output: &'static str, reference: f64| {
        Check::new(what, NEWTON, reference, 1e-4, move |r| r.at(output, 0.0)).published()
    };
    Case {
        id: "SL-11",
        title: "Body at the edge of slip on a slope of 20°",
        source: "ANSYS VM29; Beer, Johnston",
        text: INCLINE.into(),
        set: Vec::new(),
        solvers: BOTH,
        checks: vec![
            at("holding force", "holder", 5.76728),
            at("normal force", "normal", 95.942),
            at("friction", "friction", 28.783),
        ],
        view: View::Errors,
    }
}
