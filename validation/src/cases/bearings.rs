//! Sliding bearings: friction pendulum, the one that rubs in tension too, and triple pendulum.

use super::set;
use super::sliding::coulomb;
use crate::case::BOTH;
use crate::unit::{JOULE, METRE, NEWTON, SECOND, Unit};
use crate::{Case, Check, Curve, View};
use std::f64::consts::TAU;

/// Newtons in a metre.
const STIFFNESS: Unit = Unit::si("N/m");

/// A bearing under 1 MN: let go, or led through one cycle of ±0.1 m.
const PENDULUM: &str = r#"(
    title: "Friction pendulum",
    parameters: { "mu_slow": 0.06, "mu_fast": 0.06, "delta_mu": 0, "u0": "0.25 m" },
    nodes: { "free": (0, 0, 0), "led": (10, 0, 0) },
    supports: { "free": (Uy, Rx, Ry, Rz), "led": (Ux, Uy, Rx, Ry, Rz) },
    properties: {
        // 1 MN on 0.02 m²: α p = 1
        "pendulum": FrictionPendulum(
            kn: "1e10 N/m", ks: "1e10 N/m", radius: "1.5 m", friction_model: VelocityPressure,
            mu_slow: "mu_slow", mu_fast: "mu_fast", rate: "20 s/m",
            area: "0.02 m^2", delta_mu: "delta_mu", pressure_rate: "2e-8",
        ),
        "mass": Mass(mass: "1e6/9.80665"),
    },
    elements: {
        "free": FrictionPendulum(node: "free", use: "pendulum"),
        "led": FrictionPendulum(node: "led", use: "pendulum"),
        "mass free": Mass(node: "free", use: "mass"),
        "mass led": Mass(node: "led", use: "mass"),
    },
    functions: { "cycle": Sine(amplitude: "0.1 m", frequency: "1 Hz") },
    cases: {
        "gravity": Static(loads: [Gravity]),
        "release": Dynamic(
            after: "gravity", duration: "5 s", dt: "5 ms",
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

/// A mass on a sphere without friction: a pendulum of any amplitude, here 36.87° (sine 0.6).
const SPHERE: &str = r#"(
    title: "Mass on a sphere",
    gravity: "386 in/s^2",
    // sag: the weight's share along the normal, 10 kg · 386 in/s² · 0.8², over kn
    parameters: { "r": "100 in", "kn": "1e7 N/m", "sag": "6.2748e-6 m" },
    nodes: { "mass": (0, 0, 0) },
    supports: { "mass": (Uy, Rx, Ry, Rz) },
    elements: {
        "mass": Mass(node: "mass", mass: "10 kg"),
        "surface": FrictionPendulum(
            node: "mass", kn: "kn", ks: "1e4 N/m", radius: "r", surface: Spherical, rise: true, mu: 0,
        ),
    },
    cases: {
        "swing": Dynamic(
            duration: "7 s", dt: "1 ms", constant: [Gravity],
            initial: [
                (node: "mass", dof: Ux, displacement: "0.6*r"),
                (node: "mass", dof: Uz, displacement: "0.2*r - sag"),
            ],
        ),
    },
    outputs: {
        "u": Displacement(node: "mass", dof: Ux),
        "rise": Displacement(node: "mass", dof: Uz),
    },
)"#;

/// Two masses on springs, one pressed against its bearing, one pulled off it.
const BOTH_WAYS: &str = r#"(
    title: "Friction in compression and in tension",
    parameters: { "k": "1e4 N/m", "u0": "0.1 m" },
    nodes: { "pressed": (0, 0, 0), "pulled": (1, 0, 0) },
    supports: { "pressed": (Uy, Rx, Ry, Rz), "pulled": (Uy, Rx, Ry, Rz) },
    properties: {
        "bearing": TensionCompressionFriction(
            kn: "1e8 N/m", kt: "2e7 N/m",
            ks: "1e8 N/m", mu: 0.05, mu_tension: 0.21,
        ),
        "mass": Mass(mass: "100 kg"),
        "spring": Spring(k2: "k"),
    },
    elements: {
        "bearing pressed": TensionCompressionFriction(node: "pressed", use: "bearing"),
        "bearing pulled": TensionCompressionFriction(node: "pulled", use: "bearing"),
        "mass pressed": Mass(node: "pressed", use: "mass"),
        "mass pulled": Mass(node: "pulled", use: "mass"),
        "spring pressed": Spring(node: "pressed", use: "spring"),
        "spring pulled": Spring(node: "pulled", use: "spring"),
    },
    loads: {
        "press": [(node: "pressed", dof: Uz, force: "-2 kN"), (node: "pulled", dof: Uz, force: "1 kN")],
    },
    cases: {
        "press": Static(loads: ["press"]),
        "free": Dynamic(
            after: "press", duration: "2 s", dt: "1 ms",
            initial: [
                (node: "pressed", dof: Ux, displacement: "u0"),
                (node: "pulled", dof: Ux, displacement: "u0"),
            ],
        ),
    },
    outputs: {
        "pressed": Displacement(node: "pressed", dof: Ux),
        "pulled": Displacement(node: "pulled", dof: Ux),
        "down": Displacement(node: "pressed", dof: Uz),
        "up": Displacement(node: "pulled", dof: Uz),
    },
)"#;

/// A triple pendulum under 1 MN: led slowly through its regimes to the rims, or let go in regime III.
const TRIPLE: &str = r#"(
    title: "Triple friction pendulum",
    parameters: { "u0": "0.3 m", "end": "0.85 m" },
    nodes: { "free": (0, 0, 0), "led": (10, 0, 0) },
    supports: { "free": (Uy, Rx, Ry, Rz), "led": (Ux, Uy, Rx, Ry, Rz) },
    properties: {
        "bearing": TriplePendulum(
            kn: "1e10 N/m", ks: "1e10 N/m",
            radii: ("2.2 m", "0.40 m", "0.35 m", "2.5 m"),
            heights: ("0.1 m", "0.05 m", "0.05 m", "0.1 m"),
            capacities: ("0.35 m", "0.06 m", "0.07 m", "0.40 m"), stop_stiffness: "1e10 N/m",
            mu: (0.05, 0.02, 0.03, 0.09),
        ),
        "mass": Mass(mass: "1e6/9.80665"),
    },
    elements: {
        "free": TriplePendulum(node: "free", use: "bearing"),
        "led": TriplePendulum(node: "led", use: "bearing"),
        "mass free": Mass(node: "free", use: "mass"),
        "mass led": Mass(node: "led", use: "mass"),
    },
    functions: { "slow": Sine(amplitude: "end", frequency: "0.025 Hz") },
    cases: {
        "gravity": Static(loads: [Gravity]),
        "release": Dynamic(
            after: "gravity", duration: "3 s", dt: "2 ms",
            initial: [(node: "free", dof: Ux, displacement: "u0")],
        ),
        "regimes": Dynamic(
            after: "gravity", duration: "10 s", dt: "2 ms",
            supports: [(node: "led", dof: Ux, displacement: "slow")],
        ),
    },
    outputs: {
        "u": Displacement(node: "free", dof: Ux),
        "led": Displacement(node: "led", dof: Ux),
        "force": LinkForce(link: "led", axis: U2),
    },
)"#;

pub(super) fn cases() -> Vec<Case> {
    let mut all = pendulum();
    all.extend([sphere(), both_ways(), triple()]);
    all
}

fn pendulum() -> Vec<Case> {
    let case = |id, title, set, checks, view| Case {
        id,
        title,
        source: "Friction pendulum: F = (W/R) u + μ(v, p) W sgn(v)",
        text: PENDULUM.into(),
        set,
        solvers: BOTH,
        view,
        checks,
    };
    let law = |slow: f64, fast: f64| {
        move |v: f64| (fast - (fast - slow) * (-20.0 * v.abs()).exp()) * v.signum()
    };
    let cycle = |slow: f64, fast: f64| {
        let mu = law(slow, fast);
        let point = |i: u32| {
            let (s, c) = (TAU * f64::from(i) / 720.0).sin_cos();
            (0.1 * s, 1e6 * (0.1 * s / 1.5 + mu(0.1 * TAU * c)))
        };
        let reference = (0..=720).map(point).collect();
        View::Path { x: ("led", METRE), y: ("force", NEWTON), reference }
    };
    // ∮ μ(v) W du by Simpson's rule over a quarter.
    let energy = |slow: f64, fast: f64| {
        let (mu, n) = (law(slow, fast), 1000);
        let power = |i: usize| {
            let phase = 0.25 * TAU * i as f64 / n as f64;
            let v = 0.1 * TAU * phase.cos();
            1e6 * mu(v) * v
        };
        let weight = |i| {
            if i == 0 || i == n {
                1.0
            } else if i % 2 == 1 {
                4.0
            } else {
                2.0
            }
        };
        let sum: f64 = (0..=n).map(|i| weight(i) * power(i)).sum();
        4.0 * sum * 0.25 / (3.0 * n as f64)
    };
    let w = (9.80665_f64 / 1.5).sqrt();
    let release = Curve::new("u", METRE).against(coulomb(0.25, 0.09, w)).in_analysis("release");
    let p = 5e-3;
    let heat = |x: f64| {
        Check::new("energy of a cycle", JOULE, x, p, |r| r.heat("led")).in_analysis("cycle")
    };
    let under_pressure = 0.12 - 0.07 * 1.0_f64.tanh();
    vec![
        case(
            "FP-1a",
            "Friction pendulum bearing let go, and through a cycle",
            Vec::new(),
            vec![
                Check::new("turning point", METRE, -0.07, p, |r| r.min("u", 0.0, 5.0))
                    .in_analysis("release")
                    .mark("u", 0.5 * TAU / w),
                Check::new("u at rest", METRE, -0.07, p, |r| r.last("u"))
                    .in_analysis("release")
                    .mark("u", 5.0),
                heat(24_000.0),
            ],
            View::Several(vec![View::histories([release]), cycle(0.06, 0.06)]),
        ),
        case(
            "FP-1b",
            "Friction pendulum bearing with friction that depends on speed",
            vec![set("mu_slow", 0.03)],
            vec![heat(23_922.377)],
            cycle(0.03, 0.06),
        ),
        case(
            "FP-1c",
            "Friction pendulum bearing with friction that depends on speed and pressure",
            vec![set("mu_slow", 0.02), set("mu_fast", 0.12), set("delta_mu", 0.07)],
            vec![heat(energy(0.02, under_pressure))],
            cycle(0.02, under_pressure),
        ),
    ]
}

fn sphere() -> Case {
    let period = 3.282_844;
    Case {
        id: "FP-2",
        title: "Pendulum of large amplitude on a spherical bearing that rises",
        source: "ANSYS VM91 (Thomson); T = 4 √(L/g) K(sin²(θ₀/2))",
        text: SPHERE.into(),
        set: Vec::new(),
        solvers: BOTH,
        view: View::histories([Curve::new("u", METRE)]),
        checks: vec![
            Check::new("period", SECOND, period, 1e-3, |r| {
                2.0 * (r.crossing("u", 0.0, 1) - r.crossing("u", 0.0, 0))
            })
            .published(),
            Check::new("u after a period", METRE, 0.6 * 2.54, 2e-3, move |r| r.at("u", period)),
            Check::new("rise at the far end", METRE, 0.2 * 2.54, 2e-3, move |r| {
                r.max("rise", 0.4 * period, 0.6 * period)
            }),
        ],
    }
}

fn both_ways() -> Case {
    let w = 10.0;
    // Friction over stiffness: 100 N and 210 N on 10 kN/m.
    let (pressed, pulled) = (coulomb(0.1, 0.01, w), coulomb(0.1, 0.021, w));
    let (half, p) = (0.5 * TAU / w, 5e-3);
    let mut checks = vec![
        Check::new("down", METRE, -2e-5, 1e-4, |r| r.at("down", 0.0)),
        Check::new("up", METRE, 5e-5, 1e-4, |r| r.at("up", 0.0)),
        Check::at("pressed", METRE, half, pressed(half), p),
        Check::at("pressed", METRE, 2.0 * half, pressed(2.0 * half), p),
        Check::at("pulled", METRE, half, pulled(half), p),
        Check::at("pulled", METRE, 2.0 * half, pulled(2.0 * half), p),
    ];
    checks.push(Check::new("heat, pressed", JOULE, 50.0, p, |r| r.heat("bearing pressed")));
    checks.push(Check::new("heat, pulled", JOULE, 48.72, p, |r| r.heat("bearing pulled")));
    Case {
        id: "TC-1",
        title: "Free vibration with friction in compression and in tension",
        source: "Coulomb friction: each half cycle loses 2 μN/k",
        text: BOTH_WAYS.into(),
        set: Vec::new(),
        solvers: BOTH,
        view: View::histories([
            Curve::new("pressed", METRE).against(pressed),
            Curve::new("pulled", METRE).against(pulled),
        ]),
        checks,
    }
}

/// Force where a displacement is first reached.
fn force_at(r: &crate::Trace, u: f64) -> f64 {
    let (led, force) = (r.history("led"), r.history("force"));
    let Some(i) = led.windows(2).position(|w| w[0].1 < u && u <= w[1].1) else {
        return f64::NAN;
    };
    let share = (u - led[i].1) / (led[i + 1].1 - led[i].1);
    force[i].1 + share * (force[i + 1].1 - force[i].1)
}

/// Broken line through points.
fn line(points: &[(f64, f64)], u: f64) -> f64 {
    let i = points.windows(2).position(|p| u <= p[1].0).unwrap_or(points.len() - 2);
    let ((a, f), (b, g)) = (points[i], points[i + 1]);
    f + (g - f) * (u - a) / (b - a)
}

fn triple() -> Case {
    // Per unit of weight: friction, effective radii, capacities of surfaces 1 to 4.
    let (mu, r, d) = ([0.05, 0.02, 0.03, 0.09], [2.1, 0.35, 0.30, 2.4], [0.35, 0.06, 0.07, 0.40]);
    let mut points = vec![(0.0, mu[1]), ((mu[2] - mu[1]) * r[1], mu[2])];
    let ends = [
        (mu[0], r[1] + r[2]),
        (mu[3], r[0] + r[2]),
        (d[0] / r[0] + mu[0], r[0] + r[3]),
        (d[3] / r[3] + mu[3], r[1] + r[3]),
        // Surface 2 meets its rim: it had moved (μ₁ − μ₂) R₂ before 1 slid.
        (d[0] / r[0] + mu[0] + (d[1] - (mu[0] - mu[1]) * r[1]) / r[1], r[1] + r[2]),
    ];
    for (to, sliding) in ends {
        let (u, f) = points[points.len() - 1];
        points.push((u + (to - f) * sliding, to));
    }
    // Let go, the curve from the reversal is that of loading, twice as large; it turns where the work
    // of the force is zero again.
    let u0 = 0.3;
    let (top, mut u, mut work) = (line(&points, u0), u0, 0.0);
    let step = 1e-5;
    while work >= 0.0 {
        u -= step;
        work += step * (top - 2.0 * line(&points, 0.5 * (u0 - u - 0.5 * step)));
    }
    let names = ["II", "III", "IV", "V"];
    let mut checks: Vec<_> = names
        .iter()
        .zip(&points[2..])
        .map(|(name, &(u, f))| {
            let quantity = format!("force where regime {name} begins");
            Check::new(quantity, NEWTON, 1e6 * f, 2e-3, move |r| force_at(r, u))
                .in_analysis("regimes")
        })
        .collect();
    for (i, name) in ["I", "II", "III", "IV", "V"].iter().enumerate() {
        let (a, b) = (points[i + 1].0, points[i + 2].0);
        let (near, far) = (a + 0.2 * (b - a), a + 0.8 * (b - a));
        let k = 1e6 * (line(&points, far) - line(&points, near)) / (far - near);
        checks.push(
            Check::new(format!("stiffness in regime {name}"), STIFFNESS, k, 2e-3, move |r| {
                (force_at(r, far) - force_at(r, near)) / (far - near)
            })
            .in_analysis("regimes"),
        );
    }
    checks.push(
        Check::new("turning point after release", METRE, u, 5e-3, |r| r.min("u", 0.0, 3.0))
            .in_analysis("release"),
    );
    let reference = points.iter().map(|(u, f)| (*u, 1e6 * f)).collect();
    Case {
        id: "TP-1",
        title: "Triple friction pendulum through its five regimes, and let go",
        source: "Fenz & Constantinou 2008, regimes I to V",
        text: TRIPLE.into(),
        set: Vec::new(),
        solvers: BOTH,
        view: View::Several(vec![
            View::histories([Curve::new("u", METRE).in_analysis("release")]),
            View::Path { x: ("led", METRE), y: ("force", NEWTON), reference },
        ]),
        checks,
    }
}
