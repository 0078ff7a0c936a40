//! Impact and gaps.

use super::set;
use crate::case::BOTH;
use crate::unit::{INCH, METRE, NEWTON, NUMBER, SECOND, SPEED, Unit};
use crate::{Case, Check, Curve, View};
use std::f64::consts::PI;

const G: f64 = 9.80665;

/// Unit masses that fly at 1 m/s against contacts of 10 kN/m, without gravity.
const RESTITUTION: &str = r#"(
    title: "Restitution of a contact",
    parameters: { "pull": 0, "z1": 0.1, "z2": 0.5, "z3": 0.8 },
    nodes: { "a": (0, 0, 0), "b": (1, 0, 0), "c": (2, 0, 0), "d": (3, 0, 0) },
    supports: {
        "a": (Ux, Uy, Rx, Ry, Rz), "b": (Ux, Uy, Rx, Ry, Rz),
        "c": (Ux, Uy, Rx, Ry, Rz), "d": (Ux, Uy, Rx, Ry, Rz),
    },
    properties: { "ball": Mass(mass: "1 kg") },
    elements: {
        "ball a": Mass(node: "a", use: "ball"),
        "ball b": Mass(node: "b", use: "ball"),
        "ball c": Mass(node: "c", use: "ball"),
        "ball d": Mass(node: "d", use: "ball"),
        "contact a": NLink(node: "a", kn: 1e4, damping: "2*z1*100", pull: "pull"),
        "contact b": NLink(node: "b", kn: 1e4, damping: "2*z2*100", pull: "pull"),
        "contact c": NLink(node: "c", kn: 1e4, damping: "2*z3*100", pull: "pull"),
        // the same as b, as a dashpot with a spring
        "contact d": Dashpot(
            node: "d", c: "2*z2*100", when: InContact, stiffness: 1e4, pull: "pull",
        ),
    },
    cases: {
        "impact": Dynamic(
            duration: "0.2 s", dt: "0.2 ms", step: Adaptive(tolerance: 1e-5),
            initial: [
                (node: "a", dof: Uz, displacement: "2 cm", velocity: "-1 m/s"),
                (node: "b", dof: Uz, displacement: "3 cm", velocity: "-1 m/s"),
                (node: "c", dof: Uz, displacement: "4 cm", velocity: "-1 m/s"),
                (node: "d", dof: Uz, displacement: "3 cm", velocity: "-1 m/s"),
            ],
        ),
    },
    outputs: {
        "a": Velocity(node: "a", dof: Uz),
        "b": Velocity(node: "b", dof: Uz),
        "c": Velocity(node: "c", dof: Uz),
        "d": Velocity(node: "d", dof: Uz),
    },
)"#;

/// A mass that falls on a contact with a dashpot that may pull.
const DROP: &str = r#"(
    title: "Drop on a contact",
    units: (length: "in", force: "lbf", time: "s"),
    gravity: 386.4,
    parameters: { "omega": 200, "ratio": 0.4037128, "height": 149.7, "duration": 1.1 },
    nodes: { "m": (0, 0, 0) },
    supports: { "m": (Ux, Uy, Rx, Ry, Rz) },
    elements: {
        "mass": Mass(node: "m", mass: 1),
        "contact": NLink(node: "m", kn: "omega^2", damping: "2*ratio*omega", pull: 1),
    },
    cases: {
        "drop": Dynamic(
            duration: "duration", dt: 0.0005, constant: [Gravity],
            initial: [(node: "m", dof: Uz, displacement: "height")],
        ),
    },
    outputs: { "z": Displacement(node: "m", dof: Uz), "v": Velocity(node: "m", dof: Uz) },
)"#;

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

/// Restitution as a function of the damping ratio.
type Law = fn(f64) -> f64;

/// Restitution of a spring and a dashpot that may pull.
fn pulling(z: f64) -> f64 {
    (-PI * z / (1.0 - z * z).sqrt()).exp()
}

/// Restitution of a spring and a dashpot that never pull.
fn pushing(z: f64) -> f64 {
    if z < 1.0 {
        let s = (1.0 - z * z).sqrt();
        return (-(z / s) * (2.0 * z * s).atan2(2.0 * z * z - 1.0)).exp();
    }
    if z == 1.0 {
        return (-2.0_f64).exp();
    }
    let q = (z * z - 1.0).sqrt();
    (-(z / q) * ((z + q) / (z - q)).ln()).exp()
}

/// Speed over time of a unit impact of frequency `w` and damping `z` at time 0, 1 before.
fn rebound(w: f64, z: f64, law: Law) -> impl Fn(f64) -> f64 + Copy {
    // All restitutions are exp(−ζ ω t) at the end t of the contact.
    let end = -law(z).ln() / (z * w);
    let q = (z * z - 1.0).abs().sqrt();
    move |t| {
        if t <= 0.0 {
            return 1.0;
        }
        if t > end {
            return -law(z);
        }
        let (even, odd) = match q * w * t {
            _ if q == 0.0 => (1.0, w * t),
            x if z < 1.0 => (x.cos(), x.sin() / q),
            x => (x.cosh(), x.sinh() / q),
        };
        (-z * w * t).exp() * (even - z * odd)
    }
}

pub(super) fn cases() -> Vec<Case> {
    let mut all = im1();
    all.extend(im2());
    all.extend([im3(), im4(), im7()]);
    all.extend(im12());
    all.extend(im13());
    all
}

fn im1() -> Vec<Case> {
    let case = |id, title, pull: bool, z: [f64; 3]| {
        let law: Law = if pull { pulling } else { pushing };
        let check = |name: &'static str, what: &str, z: f64| {
            Check::new(format!("restitution, ζ = {z}{what}"), NUMBER, law(z), 1e-3, move |r| {
                r.last(name)
            })
            .mark(name, 0.1)
        };
        let shown = |name: &'static str, z: f64, start: f64| {
            let v = rebound(100.0, z, law);
            Curve::new(name, SPEED).against(move |t| -v(t - start)).over(0.0, 0.1)
        };
        Case {
            id,
            title,
            source: "Solution of m ẍ + c ẋ + k x = 0 until the contact opens",
            text: RESTITUTION.into(),
            set: vec![
                set("pull", u8::from(pull)),
                set("z1", z[0]),
                set("z2", z[1]),
                set("z3", z[2]),
            ],
            solvers: BOTH,
            view: View::histories([
                shown("a", z[0], 0.02),
                shown("b", z[1], 0.03),
                shown("c", z[2], 0.04),
                shown("d", z[1], 0.03),
            ]),
            checks: vec![
                check("a", "", z[0]),
                check("b", "", z[1]),
                check("c", "", z[2]),
                check("d", ", Dashpot", z[1]),
            ],
        }
    };
    vec![
        case("IM-1a", "Restitution of a contact that may pull", true, [0.1, 0.5, 0.8]),
        case("IM-1b", "Restitution of a contact that never pulls", false, [0.1, 0.5, 0.8]),
        case("IM-1c", "Restitution, critical and beyond, never pulls", false, [0.3, 1.0, 1.5]),
    ]
}

fn im2() -> Vec<Case> {
    // Damped oscillation about the static deflection until the contact opens: a root, found by bisection.
    // The restitution, and height and speed until the next impact.
    let drop = |w: f64| {
        let (z, g, h): (f64, f64, f64) = (0.403_712_8, 386.4, 149.7);
        let (v0, wd, xs) = ((2.0 * g * h).sqrt(), w * (1.0 - z * z).sqrt(), g / (w * w));
        let b = (v0 - z * w * xs) / wd;
        let x = move |t: f64| xs + (-z * w * t).exp() * (-xs * (wd * t).cos() + b * (wd * t).sin());
        let (mut low, mut high) = (1.0 / wd, 4.0 / wd);
        for _ in 0..80 {
            let middle = 0.5 * (low + high);
            if x(middle) > 0.0 { low = middle } else { high = middle }
        }
        let rate = move |t: f64| {
            let (s, c) = (wd * t).sin_cos();
            (-z * w * t).exp() * ((z * w * xs + wd * b) * c + (wd * xs - z * w * b) * s)
        };
        let (start, end) = (v0 / g, v0 / g + low);
        let e = -rate(low) / v0;
        let height = move |t: f64| match t {
            t if t < start => h - g * t * t / 2.0,
            t if t < end => -x(t - start),
            t if t < end + 2.0 * e * start => (t - end) * (e * v0 - g * (t - end) / 2.0),
            _ => f64::NAN,
        };
        let speed = move |t: f64| match t {
            t if t < start => -g * t,
            t if t < end => -rate(t - start),
            t if t < end + 2.0 * e * start => e * v0 - g * (t - end),
            _ => f64::NAN,
        };
        let near = (start - 0.3 * low, end + 0.3 * low);
        let curves = [
            Curve::new("z", INCH).against(height),
            Curve::new("z", INCH).against(height).over(near.0, near.1),
            Curve::new("v", Unit { name: "in/s", ..INCH }).against(speed).over(near.0, near.1),
        ];
        (e, View::histories(curves))
    };
    [("IM-2a", 50.0), ("IM-2b", 200.0), ("IM-2c", 1000.0)]
        .into_iter()
        .map(|(id, w)| {
            let (e, view) = drop(w);
            Case {
                id,
                title: "Drop from 149.7 in on a contact that may pull",
                source: "m ẍ + c ẋ + k x = m g until the contact opens",
                text: DROP.into(),
                set: vec![set("omega", w), set("duration", 1.2)],
                solvers: BOTH,
                view,
                checks: vec![Check::new(
                    format!("rebound / height, ω = {w}"),
                    NUMBER,
                    e * e,
                    5e-3,
                    |r| r.max("z", 0.95, 1.2) / r.at("z", 0.0),
                )],
            }
        })
        .collect()
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
        source: "Code_Aster V5.01.101 (SDND101)",
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
        source: "ANSYS VM65; Thomson, Vibration Theory, p. 110",
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
        source: "Code_Aster V5.01.121 (SDND121)",
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
    let approach = |law| rebound((1e4_f64 * 3.0 / 2.0).sqrt(), 0.2, law);
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
