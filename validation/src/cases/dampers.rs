//! Dashpots.

use super::set;
use crate::case::BOTH;
use crate::unit::{INCH, JOULE, METRE, NEWTON, NUMBER, SECOND, SPEED};
use crate::{Case, Check, Curve, View};
use std::f64::consts::{PI, TAU};

/// Dashpots of all exponents between the ground and a node that is moved to and fro.
const CYCLE: &str = r#"(
    title: "Dashpots through one cycle",
    nodes: { "p": (0, 0, 0), "m": (1, 0, 0) },
    supports: { "p": Fixed, "m": (Uy, Uz, Rx, Ry, Rz) },
    elements: {
        "a 0.1": Dashpot(node: "p", axis: U2, c: 1000, exponent: 0.1),
        "a 0.35": Dashpot(node: "p", axis: U2, c: 1000, exponent: 0.35),
        "a 0.5": Dashpot(node: "p", axis: U2, c: 1000, exponent: 0.5),
        "a 1": Dashpot(node: "p", axis: U2, c: 1000, exponent: 1),
        "a 1.5": Dashpot(node: "p", axis: U2, c: 1000, exponent: 1.5),
        "a 2": Dashpot(node: "p", axis: U2, c: 1000, exponent: 2),
        "mass": Mass(node: "m", mass: "1 kg"),
        "spring": Spring(node: "m", k2: "1 N/m"),
    },
    functions: { "motion": Sine(amplitude: "0.1 m", frequency: "2 Hz") },
    cases: {
        "cycle": Dynamic(
            duration: "0.5 s", dt: "0.5 ms", substep_limit: 10000000,
            supports: [(node: "p", dof: Ux, displacement: "motion")],
        ),
    },
    outputs: {
        "u": Displacement(node: "p", dof: Ux),
        "F 0.1": LinkForce(link: "a 0.1", axis: U2),
        "F 0.35": LinkForce(link: "a 0.35", axis: U2),
        "F 0.5": LinkForce(link: "a 0.5", axis: U2),
        "F 1": LinkForce(link: "a 1", axis: U2),
        "F 1.5": LinkForce(link: "a 1.5", axis: U2),
        "F 2": LinkForce(link: "a 2", axis: U2),
    },
)"#;

const STOP: &str = r#"(
    title: "Mass stopped by a dashpot",
    nodes: { "m": (0, 0, 0) },
    supports: { "m": (Uy, Uz, Rx, Ry, Rz) },
    elements: {
        "mass": Mass(node: "m", mass: "1000 kg"),
        "dashpot": Dashpot(node: "m", axis: U2, c: 2000, exponent: 0.5),
    },
    cases: {
        "stop": Dynamic(
            duration: "1.5 s", dt: "5 ms",
            initial: [(node: "m", dof: Ux, velocity: "1 m/s")],
        ),
    },
    outputs: { "u": Displacement(node: "m", dof: Ux), "v": Velocity(node: "m", dof: Ux) },
)"#;

const RESONANCE: &str = r#"(
    title: "Damper link at resonance",
    units: (length: "in", force: "kip", time: "s"),
    nodes: { "m": (0, 0, 0) },
    supports: { "m": (Uy, Uz, Rx, Ry, Rz) },
    elements: {
        "mass": Mass(node: "m", mass: 1),
        "spring": Spring(node: "m", k2: 100),
        "damper": Dashpot(node: "m", axis: U2, c: 1),
    },
    loads: { "push": [(node: "m", dof: Ux, force: 10)] },
    functions: { "sine": Sine(amplitude: 1, frequency: "10/(2*3.141592653589793)") },
    cases: {
        "shaking": Dynamic(
            duration: 15, dt: 0.01, step: Adaptive(tolerance: 1e-6),
            forces: [(load: "push", function: "sine")],
        ),
    },
    outputs: { "u": Displacement(node: "m", dof: Ux) },
)"#;

/// Oscillators beside each other: from rest, let go, struck or pushed.
const OSCILLATOR: &str = r#"(
    title: "Oscillator with a viscous damper",
    units: (length: "in", force: "lbf", time: "s"),
    parameters: {
        "mass": 1, "k": 1, "c": 0, "u0": 0, "v0": 0, "push": 0, "frequency": 1, "duration": 1,
    },
    nodes: { "spring damper": (0, 0, 0), "link damper": (10, 0, 0) },
    supports: {
        "spring damper": (Uy, Uz, Rx, Ry, Rz),
        "link damper": (Uy, Uz, Rx, Ry, Rz),
    },
    properties: { "mass": Mass(mass: "mass") },
    elements: {
        "mass 1": Mass(node: "spring damper", use: "mass"),
        "mass 2": Mass(node: "link damper", use: "mass"),
        "spring 1": Spring(node: "spring damper", k2: "k", c2: "c"),
        "spring 2": Spring(node: "link damper", k2: "k"),
        "damper": Dashpot(node: "link damper", axis: U2, c: "c + 1e-12"),
    },
    loads: {
        "push": [
            (node: "spring damper", dof: Ux, force: "push"),
            (node: "link damper", dof: Ux, force: "push"),
        ],
    },
    functions: {
        "step": Constant(1),
        "sine": Sine(amplitude: 1, frequency: "frequency"),
    },
    cases: {
        "step": Dynamic(
            duration: "duration", dt: "duration/400", step: Adaptive(tolerance: 1e-6),
            forces: [(load: "push", function: "step")],
            initial: [
                (node: "spring damper", dof: Ux, displacement: "u0", velocity: "v0"),
                (node: "link damper", dof: Ux, displacement: "u0", velocity: "v0"),
            ],
        ),
        "sine": Dynamic(
            duration: "duration", dt: "duration/400", step: Adaptive(tolerance: 1e-6),
            forces: [(load: "push", function: "sine")],
        ),
    },
    outputs: {
        "spring": Displacement(node: "spring damper", dof: Ux),
        "link": Displacement(node: "link damper", dof: Ux),
    },
)"#;

pub(super) fn cases() -> Vec<Case> {
    let mut all = vec![dp3(), dp4(), dp6()];
    all.extend(dp8());
    all
}

fn dp3() -> Case {
    // λ(α) = 4·2^α Γ(1 + α/2)²/Γ(2 + α).
    let lambda = [
        ("a 0.1", 0.1, 3.882_445),
        ("a 0.35", 0.35, 3.627_472),
        ("a 0.5", 0.5, 3.496_077),
        ("a 1", 1.0, PI),
        ("a 1.5", 1.5, 2.875_537),
        ("a 2", 2.0, 8.0 / 3.0),
    ];
    let checks = lambda.map(|(name, a, l)| {
        let energy = l * 1000.0 * 0.1_f64.powf(1.0 + a) * (2.0 * TAU).powf(a);
        // λ is known to 7 digits; 0.1 % as for the other dashpots.
        Check::new(format!("energy of a cycle, exponent {a}"), JOULE, energy, 1e-3, move |r| {
            r.heat(name)
        })
    });
    let loops = [("F 0.1", 0.1), ("F 0.35", 0.35), ("F 0.5", 0.5), ("F 1", 1.0)];
    let loops = loops.into_iter().chain([("F 1.5", 1.5), ("F 2", 2.0)]).map(|(output, a)| {
        let point = |i: u32| {
            let (s, c) = (TAU * f64::from(i) / 360.0).sin_cos();
            let v = 0.1 * 2.0 * TAU * c;
            (0.1 * s, 1000.0 * v.abs().powf(a) * v.signum())
        };
        let reference = (0..=360).map(point).collect();
        View::Path { x: ("u", METRE), y: (output, NEWTON), reference }
    });
    Case {
        id: "DP-3",
        title: "Energy of a cycle of power-law dashpots",
        source: "Power-law dashpot led through u = X sin ωt: E = λ C X^(1+α) ω^α",
        text: CYCLE.into(),
        set: Vec::new(),
        solvers: BOTH,
        view: View::Several(loops.collect()),
        checks: checks.into(),
    }
}

fn dp4() -> Case {
    // v = (√v₀ − C t/2m)²
    let v = |t: f64| (1.0 - t).max(0.0).powi(2);
    let u = |t: f64| (1.0 - (1.0 - t).max(0.0).powi(3)) / 3.0;
    Case {
        id: "DP-4",
        title: "Mass stopped by a square-root dashpot",
        source: "m v̇ = −C √v, integrated",
        text: STOP.into(),
        set: Vec::new(),
        solvers: BOTH,
        view: View::histories([
            Curve::new("u", METRE).against(u),
            Curve::new("v", SPEED).against(v),
        ]),
        checks: vec![
            Check::new("distance", METRE, u(1.5), 1e-3, |r| r.last("u")).mark("u", 1.5),
            Check::at("v", SPEED, 0.5, v(0.5), 1e-3),
            Check::new("time to v₀/10⁴", SECOND, 0.99, 1e-3, |r| r.crossing("v", 1e-4, 0))
                .mark_time("v", 1e-4),
        ],
    }
}

/// An oscillator from rest under a sine at resonance.
fn resonance(w: f64, z: f64, ust: f64) -> impl Fn(f64) -> f64 + Copy {
    let s = (1.0 - z * z).sqrt();
    move |t: f64| {
        let wd = w * s;
        let free = (-z * w * t).exp() * ((wd * t).cos() + z / s * (wd * t).sin());
        ust / (2.0 * z) * (free - (w * t).cos())
    }
}

fn dp6() -> Case {
    // No series stiffness here, so 0.1 % instead of the 1 % that allows for it.
    let u = resonance(10.0, 0.05, 0.1);
    let shown = |from: f64, to: f64| Curve::new("u", INCH).against(u).over(from, to);
    let mut checks: Vec<Check> = [0.5, 1.0, 2.0, 5.0, 10.0]
        .into_iter()
        .map(|t| Check::at("u", INCH, t, u(t), 1e-3))
        .collect();
    // The transient has decayed to e^(−7): 0.1 % of the amplitude.
    let peak = 1.0 - (-0.5_f64 * 14.9).exp();
    checks.push(Check::new("amplitude near 15 s", INCH, peak, 1e-3, |r| r.max("u", 14.6, 15.0)));
    Case {
        id: "DP-6",
        title: "Damper link at resonance",
        source: "CSI Software Verification 6-005; Chopra",
        text: RESONANCE.into(),
        set: Vec::new(),
        solvers: BOTH,
        view: View::histories([shown(0.0, 5.0), shown(10.0, 15.0)]),
        checks,
    }
}

/// A quantity of both oscillators.
fn twice(
    quantity: &str,
    unit: crate::Unit,
    reference: f64,
    tolerance: f64,
    measure: impl Fn(&crate::Trace, &str) -> f64 + Send + Sync + Clone + 'static,
) -> [Check; 2] {
    ["spring", "link"].map(|name| {
        let measure = measure.clone();
        Check::new(format!("{quantity}, damper as {name}"), unit, reference, tolerance, move |r| {
            measure(r, name)
        })
        .published()
        .in_analysis("step")
    })
}

/// An oscillator let go, struck or pushed by a constant force.
fn oscillator(m: f64, k: f64, c: f64, [u0, v0, push]: [f64; 3]) -> impl Fn(f64) -> f64 + Copy {
    let (w, z, rest) = ((k / m).sqrt(), c / (2.0 * (k * m).sqrt()), push / k);
    let q = (z * z - 1.0).abs().sqrt() * w;
    let (a, b) = (u0 - rest, v0 + z * w * (u0 - rest));
    move |t: f64| {
        let (even, odd) = match q * t {
            x if q < 1e-6 * w => (1.0, t * (1.0 - x * x / 6.0)),
            x if z < 1.0 => (x.cos(), x.sin() / q),
            x => (x.cosh(), x.sinh() / q),
        };
        rest + (-z * w * t).exp() * (a * even + b * odd)
    }
}

/// Both oscillators against a curve.
fn both(analysis: &'static str, u: impl Fn(f64) -> f64 + Copy + Send + Sync + 'static) -> View {
    let shown = |name| Curve::new(name, INCH).against(u).in_analysis(analysis);
    View::histories(["spring", "link"].map(shown))
}

fn dp8() -> Vec<Case> {
    // Printed numbers have four to five digits: 0.1 %.
    let p = 1e-3;
    let at = |check: [Check; 2], t: f64| -> Vec<Check> {
        let [spring, link] = check;
        vec![spring.mark("spring", t), link.mark("link", t)]
    };
    let case = |id, title, source, set, checks: Vec<Check>, view| Case {
        id,
        title,
        source,
        text: OSCILLATOR.into(),
        set,
        solvers: BOTH,
        view,
        checks,
    };
    let (m, k): (f64, f64) = (10.0 / 386.0, 30.0);
    let critical = 2.0 * (m * k).sqrt();
    let mut all = Vec::new();
    for (id, title, ratio, u) in [
        ("DP-8a", "Release, damping ratio 2", 2.0, 0.4742),
        ("DP-8b", "Release, damping ratio 1", 1.0, 0.18998),
        ("DP-8c", "Release, damping ratio 0.2", 0.2, -0.52108),
        ("DP-8j", "Release, undamped", 0.0, -0.99688),
    ] {
        all.push(case(
            id,
            title,
            "ANSYS VM71; Thomson",
            vec![
                set("mass", m),
                set("k", k),
                set("c", ratio * critical),
                set("u0", 1),
                set("duration", 0.12),
            ],
            at(twice("u(0.09)", INCH, u, p, |r, n| r.at(n, 0.09)), 0.09),
            both("step", oscillator(m, k, ratio * critical, [1.0, 0.0, 0.0])),
        ));
    }
    let mut checks: Vec<Check> =
        twice("ratio of peaks", NUMBER, 1.5350, p, |r, n| r.max(n, 0.1, 0.3) / r.max(n, 0.3, 0.5))
            .into();
    checks.extend(twice("damped period", SECOND, 0.18507, p, |r, n| {
        r.extreme(n, 1.0, 0.3, 0.5).0 - r.extreme(n, 1.0, 0.1, 0.3).0
    }));
    all.push(case(
        "DP-8d",
        "Logarithmic decrement",
        "ANSYS VM72; Thomson",
        vec![set("mass", m), set("k", k), set("c", 0.12), set("u0", 1), set("duration", 0.5)],
        checks,
        both("step", oscillator(m, k, 0.12, [1.0, 0.0, 0.0])),
    ));
    let mut struck: Vec<Case> = Vec::new();
    for (id, title, c, u) in
        [("DP-8e", "Impulse, undamped", 0.0, 0.90930), ("DP-8f", "Impulse, damped", 14.0, 0.34180)]
    {
        struck.push(case(
            id,
            title,
            "ANSYS VM74; Thomson",
            vec![
                set("mass", 0.5),
                set("k", 200),
                set("c", c),
                set("v0", 20),
                set("duration", 0.12),
            ],
            at(twice("u(0.1)", INCH, u, p, |r, n| r.at(n, 0.1)), 0.1),
            both("step", oscillator(0.5, 200.0, c, [0.0, 20.0, 0.0])),
        ));
    }
    // The undamped one reaches its peak within a thousandth of u(0.08).
    struck[0].checks.extend(twice("u(0.08)", INCH, 0.99957, p, |r, n| r.at(n, 0.08)));
    all.extend(struck);
    let first = all.len();
    for (id, title, c, u) in [
        ("DP-8g", "Step load, undamped", 0.0, 1.6536),
        ("DP-8h", "Step load, damped", 10.0, 1.1531),
    ] {
        all.push(case(
            id,
            title,
            "ANSYS VM75; Thomson",
            vec![
                set("mass", 0.5),
                set("k", 200),
                set("c", c),
                set("push", 200),
                set("duration", 0.25),
            ],
            at(twice("u(0.2)", INCH, u, p, |r, n| r.at(n, 0.2)), 0.2),
            both("step", oscillator(0.5, 200.0, c, [0.0, 0.0, 200.0])),
        ));
    }
    all[first].checks.extend(twice("largest u", INCH, 2.0, p, |r, n| r.max(n, 0.0, 0.25)));
    let steady = twice("amplitude", INCH, 10.0 / 120.0, p, |r, n| r.peak(n, 2.6, 3.0));
    all.push(case(
        "DP-8i",
        "Steady vibration at resonance",
        "ANSYS VM86; Thomson",
        vec![
            set("mass", 0.5),
            set("k", 200),
            set("c", 6),
            set("push", 10),
            set("frequency", 20.0 / TAU),
            set("duration", 3),
        ],
        steady.into_iter().map(|c| c.in_analysis("sine")).collect(),
        both("sine", resonance(20.0, 0.3, 0.05)),
    ));
    all
}
