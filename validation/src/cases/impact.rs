//! Impact and gaps.

use super::restitution::{Law, impact_speed, pulling, pushing};
use super::set;
use crate::case::BOTH;
use crate::unit::{INCH, METRE, NEWTON, NUMBER, SECOND, SPEED, Unit};
use crate::{Case, Check, Curve, View};
use std::f64::consts::PI;

const G: f64 = 9.80665;

/// A mass on a spring beside a stop.
const STOP: &str = r#"(
    title: "Mass at a stop",
    nodes: { "m": (0, 0, 0) },
    supports: { "m": (Uy, Uz, Rx, Ry, Rz) },
    elements: {
        "mass": Mass(node: "m", mass: "100 kg"),
        "spring": Spring(node: "m", k2: "1e4 N/m"),
        "stop": Gap(node: "m", axis1: (-1, 0, 0), axis2: (0, 0, 1), k: "1e6 N/m"),
    },
    cases: {
        "impact": Dynamic(
            duration: "0.4 s", dt: "0.1 ms",
            initial: [(node: "m", dof: Ux, velocity: "1 m/s")],
        ),
    },
    outputs: {
        "u": Displacement(node: "m", dof: Ux),
        "v": Velocity(node: "m", dof: Ux),
        "stop": LinkForce(link: "stop", axis: U1),
    },
)"#;

const BALL: &str = r#"(
    title: "Ball that falls on a spring",
    units: (length: "in", force: "lbf", time: "s"),
    gravity: 386,
    nodes: { "ball": (0, 0, 1) },
    supports: { "ball": (Ux, Uy, Rx, Ry, Rz) },
    elements: {
        "mass": Mass(node: "ball", mass: 0.5),
        "spring": Gap(node: "ball", k: 1973.92, opening: 1),
    },
    cases: { "fall": Dynamic(duration: 0.15, dt: 0.0005, constant: [Gravity]) },
    outputs: { "u": Displacement(node: "ball", dof: Uz, factor: -1) },
)"#;

/// A block that falls 72 in onto the pan of a scale and stays on it. The contact may pull: nothing
/// bounces.
const SCALE: &str = r#"(
    title: "Block that falls on a spring scale",
    units: (length: "in", force: "lbf", time: "s"),
    gravity: 386.4,
    nodes: { "pan": (0, 0, 0), "block": (0, 0, 72) },
    supports: { "pan": (Ux, Uy, Rx, Ry, Rz), "block": (Ux, Uy, Rx, Ry, Rz) },
    elements: {
        "pan": Mass(node: "pan", mass: "25/386.4"),
        "block": Mass(node: "block", mass: "50/386.4"),
        "spring": Spring(node: "pan", k1: 100),
        "contact": NLink(
            nodes: ("pan", "block"), kn: 1e7, opening: 72, damping: "4*(1e7*25*2/3/386.4)^0.5", pull: 1,
        ),
    },
    cases: {
        "fall": Dynamic(
            duration: 0.8, dt: 0.0005, constant: [Gravity],
            // in rest on its spring
            initial: [(node: "pan", dof: Uz, displacement: -0.25)],
        ),
    },
    outputs: { "pan": Displacement(node: "pan", dof: Uz, factor: -1) },
)"#;

const FORCED: &str = r#"(
    title: "Forced impact oscillator",
    nodes: { "m": (0, 0, 0) },
    supports: { "m": (Uy, Uz, Rx, Ry, Rz) },
    elements: {
        "mass": Mass(node: "m", mass: "156 kg"),
        "spring": Spring(node: "m", k2: "2e6 N/m"),
        "stop": Gap(
            node: "m", axis1: (-1, 0, 0), axis2: (0, 0, 1), k: "1e10 N/m", opening: "1 mm",
        ),
    },
    loads: { "push": [(node: "m", dof: Ux, force: "3000 N")] },
    functions: { "sine": Sine(amplitude: 1, frequency: "5 Hz") },
    cases: {
        "forced": Dynamic(
            duration: "0.7 s", dt: "0.1 ms", step: Adaptive(tolerance: 1e-7),
            forces: [(load: "push", function: "sine")],
        ),
    },
    outputs: { "u": Displacement(node: "m", dof: Ux) },
)"#;

const COLLISION: &str = r#"(
    title: "Collision of two masses",
    parameters: { "pull": 0, "ratio": 0.2, "k": "1e4 N/m" },
    nodes: { "a": (0, 0, 0), "b": (1, 0, 0) },
    supports: { "a": (Uy, Uz, Rx, Ry, Rz), "b": (Uy, Uz, Rx, Ry, Rz) },
    elements: {
        "ball a": Mass(node: "a", mass: "1 kg"),
        "ball b": Mass(node: "b", mass: "2 kg"),
        "contact": NLink(
            nodes: ("a", "b"), kn: "k", opening: "1 cm", pull: "pull",
            damping: "2*ratio*(k*2 kg/3)^0.5",
        ),
    },
    cases: {
        "collision": Dynamic(
            duration: "0.1 s", dt: "0.2 ms", step: Adaptive(tolerance: 1e-5),
            initial: [(node: "a", dof: Ux, velocity: "1 m/s")],
        ),
    },
    outputs: { "a": Velocity(node: "a", dof: Ux), "b": Velocity(node: "b", dof: Ux) },
)"#;

const VERTICAL: &str = r#"(
    title: "Block under vertical shaking",
    parameters: { "a": "1.5 g" },
    nodes: { "m": (0, 0, 0) },
    supports: { "m": (Ux, Uy, Rx, Ry, Rz) },
    elements: {
        "mass": Mass(node: "m", mass: "1 t"),
        // a ground that gives a micrometre under the weight
        "ground": NLink(node: "m", kn: "1e10 N/m", damping: "2.5e6 N*s/m"),
    },
    functions: { "shaking": Sine(amplitude: "a", frequency: "5 Hz") },
    cases: {
        "gravity": Static(loads: [Gravity]),
        "shaking": Dynamic(
            after: "gravity", duration: "0.26 s", dt: "0.5 ms",
            base: [(direction: Z, function: "shaking")],
        ),
    },
    outputs: {
        "z": Displacement(node: "m", dof: Uz),
        "v": Velocity(node: "m", dof: Uz),
        "n": LinkForce(link: "ground", axis: U1, factor: -1),
    },
)"#;

pub(super) fn cases() -> Vec<Case> {
    let mut all = vec![im3(), im4(), im6(), im7()];
    all.extend(im12());
    all.extend(im13());
    all
}

fn im3() -> Case {
    let p = 1e-3;
    // Half a sine against the stop, half a sine on the spring alone.
    let stiff = (1.01e6_f64 / 100.0).sqrt();
    let phase = move |t: f64| {
        let (contact, cycle) = (PI / stiff, PI / stiff + PI / 10.0);
        let in_cycle = t - (t / cycle).floor() * cycle;
        if in_cycle < contact { (1.0, stiff, in_cycle) } else { (-1.0, 10.0, in_cycle - contact) }
    };
    let u = move |t: f64| {
        let (sign, w, t) = phase(t);
        sign * (w * t).sin() / w
    };
    let v = move |t: f64| {
        let (sign, w, t) = phase(t);
        sign * (w * t).cos()
    };
    Case {
        id: "IM-3",
        title: "Mass that leaves its rest position against a stop",
        source: "Code_Aster SDND101",
        text: STOP.into(),
        set: Vec::new(),
        solvers: BOTH,
        view: View::histories([
            Curve::new("u", METRE).against(u),
            Curve::new("v", SPEED).against(v),
            Curve::new("stop", NEWTON).against(move |t| -1e6 * u(t).max(0.0)).over(0.0, 0.05),
        ]),
        checks: vec![
            Check::new("largest u", METRE, 9.95037e-3, p, |r| r.max("u", 0.0, 0.1))
                .published()
                .mark("u", PI / stiff / 2.0),
            Check::new("largest stop force", NEWTON, 9950.37, p, |r| -r.min("stop", 0.0, 0.1))
                .published(),
            Check::new("end of contact", SECOND, 0.031_260_0, p, |r| r.crossing("u", 0.0, 0))
                .published()
                .mark_time("u", 0.0),
            Check::new("second impact", SECOND, 0.345_419_3, p, |r| r.crossing("u", 0.0, 1))
                .published()
                .mark_time("u", 0.0),
            Check::new("speed at second impact", SPEED, 1.0, p, |r| {
                r.at("v", r.crossing("u", 0.0, 1))
            })
            .mark("v", 0.345_419_3),
        ],
    }
}

fn im4() -> Case {
    let p = 1e-3;
    // Free fall, then a sine about the static deflection; symmetric about the largest travel.
    let (g, w) = (386.0_f64, (1973.92_f64 / 0.5).sqrt());
    let (touch, speed, rest) = ((2.0 / g).sqrt(), (2.0 * g).sqrt(), g / (w * w));
    let bottom = touch + (PI - (speed / (w * rest)).atan()) / w;
    let u = move |t: f64| {
        let t = if t > bottom { 2.0 * bottom - t } else { t };
        let (s, c) = (w * (t - touch)).sin_cos();
        if t < touch { g * t * t / 2.0 } else { 1.0 + rest * (1.0 - c) + speed / w * s }
    };
    Case {
        id: "IM-4",
        title: "Ball that falls on a spring",
        source: "ANSYS VM65; Thomson",
        text: BALL.into(),
        set: Vec::new(),
        solvers: BOTH,
        view: View::histories([Curve::new("u", INCH).against(u)]),
        checks: vec![
            Check::new("time of contact", SECOND, 0.071_981_6, p, |r| r.crossing("u", 0.0254, 0))
                .mark_time("u", 0.0254),
            Check::new("largest travel", INCH, 1.550_665_5, p, |r| r.max("u", 0.0, 0.15))
                .mark("u", 0.100_444_9),
            Check::new("time of largest travel", SECOND, 0.100_444_9, p, |r| {
                r.extreme("u", 1.0, 0.0, 0.15).0
            }),
        ],
    }
}

fn im6() -> Case {
    // Plastic impact, then W (h + d) = k (d² − d₀²)/2 for both on the spring.
    let (g, k): (f64, f64) = (386.4, 100.0);
    let v = (2.0 * g * 72.0).sqrt() * 50.0 / 75.0;
    let below = (v * v * 75.0 / g / k + 0.5 * 0.5).sqrt();
    let fall = (2.0 * 72.0 / g).sqrt();
    let w = (k * g / 75.0).sqrt();
    let p = 1e-2;
    Case {
        id: "IM-6",
        title: "Plastic impact on a spring scale",
        source: "ANSYS VM83; Beer, Johnston 14.6",
        text: SCALE.into(),
        set: Vec::new(),
        solvers: BOTH,
        checks: vec![
            Check::new("largest travel of the pan", INCH, 7.7, p, |r| r.max("pan", 0.0, 0.8))
                .published(),
            Check::new("largest travel, by hand", INCH, 7.69622, p, |r| r.max("pan", 0.0, 0.8))
                .published(),
            Check::new("largest travel, closed form", INCH, 0.75 + below, p, |r| {
                r.max("pan", 0.0, 0.8)
            }),
        ],
        view: View::histories([Curve::new("pan", INCH).over(0.55, 0.72).against(move |t| {
            let (sin, cos) = (w * (t - fall)).sin_cos();
            if t < fall { 0.25 } else { 0.75 - 0.5 * cos + v / w * sin }
        })]),
    }
}

fn im7() -> Case {
    let times = [
        0.024867876,
        0.025260518,
        0.046328519,
        0.046722721,
        0.066252240,
        0.066645834,
        0.208191408,
        0.208581391,
        0.236839728,
        0.237232929,
        0.259783891,
        0.260177191,
        0.286713479,
        0.287104524,
        0.427422810,
        0.427815655,
        0.449609878,
        0.450003717,
        0.471718478,
        0.472111368,
        0.612466923,
        0.612857920,
        0.639551999,
        0.639945276,
    ];
    let check = |(i, t): (usize, f64)| {
        let what = if i % 2 == 0 { "closes" } else { "opens" };
        let tolerance = if i < 6 { 1e-6 } else { 1e-5 };
        Check::new(format!("gap {what}, contact {}", i / 2 + 1), SECOND, t, tolerance, move |r| {
            r.crossing("u", 1e-3, i)
        })
        .absolute()
        .published()
        .mark_time("u", 1e-3)
    };
    Case {
        id: "IM-7",
        title: "Forced impact oscillator with a stiff stop",
        source: "Code_Aster SDND121",
        text: FORCED.into(),
        set: Vec::new(),
        solvers: BOTH,
        view: View::histories([Curve::new("u", METRE), Curve::new("u", METRE).over(0.02, 0.07)]),
        checks: times.into_iter().enumerate().map(check).collect(),
    }
}

fn im12() -> Vec<Case> {
    let laws = [
        ("IM-12a", "Collision of two masses, contact may pull", 1_u8, pulling as Law),
        ("IM-12b", "Collision of two masses, contact never pulls", 0, pushing),
    ];
    // The difference of the speeds is that of one impact of the reduced mass.
    let approach = |law| impact_speed((1e4_f64 * 3.0 / 2.0).sqrt(), 0.2, law);
    laws.map(|(id, title, pull, law)| (id, title, pull, law(0.2), approach(law)))
        .into_iter()
        .map(|(id, title, pull, e, v)| Case {
            id,
            title,
            source: "Conservation of momentum and restitution for the reduced mass",
            text: COLLISION.into(),
            set: vec![set("pull", pull)],
            solvers: BOTH,
            view: View::histories([
                Curve::new("a", SPEED).against(move |t| (1.0 + 2.0 * v(t - 0.01)) / 3.0),
                Curve::new("b", SPEED).against(move |t| (1.0 - v(t - 0.01)) / 3.0),
            ]),
            // 0.1 % of the speed of approach, as for the restitution.
            checks: vec![
                Check::new("v₁ after", SPEED, (1.0 - 2.0 * e) / 3.0, 1e-3, |r| r.last("a"))
                    .absolute()
                    .mark("a", 0.1),
                Check::new("v₂ after", SPEED, (1.0 + e) / 3.0, 1e-3, |r| r.last("b"))
                    .absolute()
                    .mark("b", 0.1),
            ],
        })
        .collect()
}

fn im13() -> Vec<Case> {
    let p = 5e-3;
    let source = "Free flight from where 1 + a sin ωt = 0";
    let share = Unit { si: 1000.0 * G, ..NUMBER };
    let (w, off) = (10.0 * PI, 0.123_227_953);
    // Height of the flight, and its rate.
    let z = move |t: f64| {
        let tau = t - off;
        let base = ((w * t).sin() - (w * off).sin()) / w - tau * (w * off).cos();
        if tau < 0.0 { 0.0 } else { G * (1.5 * base / w - tau * tau / 2.0) }
    };
    let v = move |t: f64| {
        let base = ((w * t).cos() - (w * off).cos()) / w;
        if t < off { 0.0 } else { G * (1.5 * base - (t - off)) }
    };
    let impact = 0.236_744_157;
    let flying = move |t: f64, x: f64| if t < impact { x } else { f64::NAN };
    vec![
        Case {
            id: "IM-13a",
            title: "Block that lifts off under 1.5 g, 5 Hz vertical",
            source,
            text: VERTICAL.into(),
            set: Vec::new(),
            solvers: BOTH,
            view: View::histories([
                Curve::new("z", METRE).against(move |t| flying(t, z(t))),
                Curve::new("v", SPEED).against(move |t| flying(t, v(t))),
                Curve::new("n", share)
                    .against(move |t| if t < off { 1.0 + 1.5 * (w * t).sin() } else { 0.0 })
                    .over(0.0, 0.23),
            ]),
            checks: vec![
                Check::new("lift-off", SECOND, off, p, |r| r.crossing("z", 0.0, 0))
                    .mark_time("z", 0.0),
                Check::new("largest gap", METRE, 8.02306e-3, p, |r| r.max("z", 0.1, 0.25))
                    .mark("z", 0.205_778_077),
                Check::new("time of largest gap", SECOND, 0.205_778_077, p, |r| {
                    r.extreme("z", 1.0, 0.1, 0.25).0
                }),
                Check::new("impact", SECOND, impact, p, |r| r.crossing("z", 0.0, 1))
                    .mark_time("z", 0.0),
                Check::new("speed of impact", SPEED, -0.574_808, p, |r| {
                    r.at("v", r.crossing("z", 0.0, 1) - 1e-5)
                })
                .mark("v", impact),
            ],
        },
        Case {
            id: "IM-13b",
            title: "Block that stays down under 0.9 g, 5 Hz vertical",
            source,
            text: VERTICAL.into(),
            set: vec![set("a", "0.9 g")],
            solvers: BOTH,
            view: View::histories([
                Curve::new("n", share).against(move |t| 1.0 + 0.9 * (w * t).sin())
            ]),
            checks: vec![
                Check::new("largest contact force / weight", share, 1.9, p, |r| {
                    r.max("n", 0.0, 0.2)
                })
                .mark("n", 0.05),
                Check::new("smallest contact force / weight", share, 0.1, p, |r| {
                    r.min("n", 0.0, 0.2)
                })
                .mark("n", 0.15),
                Check::new("largest gap", METRE, 0.0, 0.0, |r| r.max("z", 0.0, 0.26).max(0.0))
                    .absolute(),
            ],
        },
    ]
}
