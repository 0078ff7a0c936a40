//! Restitution of contacts: of a spring and a dashpot, without gravity and after a fall.

use super::set;
use crate::case::BOTH;
use crate::unit::{INCH, NUMBER, SPEED};
use crate::{Case, Check, Curve, View};

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

/// A mass that falls on a contact with a dashpot.
const DROP: &str = r#"(
    title: "Drop on a contact",
    units: (length: "in", force: "lbf", time: "s"),
    gravity: 386.4,
    parameters: { "omega": 200, "ratio": 0.4037128, "height": 149.7, "duration": 1.1, "pull": 1 },
    nodes: { "m": (0, 0, 0) },
    supports: { "m": (Ux, Uy, Rx, Ry, Rz) },
    elements: {
        "mass": Mass(node: "m", mass: 1),
        "contact": NLink(node: "m", kn: "omega^2", damping: "2*ratio*omega", pull: "pull"),
    },
    cases: {
        "drop": Dynamic(
            duration: "duration", dt: 0.0005, constant: [Gravity],
            initial: [(node: "m", dof: Uz, displacement: "height")],
        ),
    },
    outputs: {
        "z": Displacement(node: "m", dof: Uz),
        "v": Velocity(node: "m", dof: Uz),
        "contact": LinkForce(link: "contact", axis: U1, factor: -1),
    },
)"#;

/// Restitution of a spring and a dashpot that may pull.
pub(super) fn pulling(z: f64) -> f64 {
    (-std::f64::consts::PI * z / (1.0 - z * z).sqrt()).exp()
}

/// Restitution of a spring and a dashpot that never pull.
pub(super) fn pushing(z: f64) -> f64 {
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

/// Restitution as a function of the damping ratio.
pub(super) type Law = fn(f64) -> f64;

/// Speed over time of a unit impact of frequency `w` and damping `z` at time 0, 1 before.
pub(super) fn impact_speed(w: f64, z: f64, law: Law) -> impl Fn(f64) -> f64 + Copy {
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
    all
}

fn im1() -> Vec<Case> {
    // The three contacts and their restitutions.
    let balls = |id, title, pull: bool, z: [(f64, f64); 3]| {
        let check = |name: &'static str, what: &str, (z, e): (f64, f64)| {
            Check::new(format!("restitution, ζ = {z}{what}"), NUMBER, e, 1e-3, move |r| {
                r.last(name)
            })
            .mark(name, 0.1)
        };
        let shown = |name: &'static str, z: f64, start: f64| {
            let v = impact_speed(100.0, z, if pull { pulling } else { pushing });
            Curve::new(name, SPEED).against(move |t| -v(t - start)).over(0.0, 0.1)
        };
        Case {
            id,
            title,
            source: "Solution of m ẍ + c ẋ + k x = 0 until the contact opens",
            text: RESTITUTION.into(),
            set: vec![
                set("pull", u8::from(pull)),
                set("z1", z[0].0),
                set("z2", z[1].0),
                set("z3", z[2].0),
            ],
            solvers: BOTH,
            view: View::histories([
                shown("a", z[0].0, 0.02),
                shown("b", z[1].0, 0.03),
                shown("c", z[2].0, 0.04),
            ]),
            checks: vec![
                check("a", "", z[0]),
                check("b", "", z[1]),
                check("c", "", z[2]),
                check("d", ", Dashpot", z[1]),
            ],
        }
    };
    let case = |id, title, pull: bool, z: [f64; 3]| {
        let law: fn(f64) -> f64 = if pull { pulling } else { pushing };
        balls(id, title, pull, z.map(|z| (z, law(z))))
    };
    let inverse = balls;
    vec![
        case("IM-1a", "Restitution of a contact that may pull", true, [0.1, 0.5, 0.8]),
        case("IM-1b", "Restitution of a contact that never pulls", false, [0.1, 0.5, 0.8]),
        case("IM-1c", "Restitution, critical and beyond, never pulls", false, [0.3, 1.0, 1.5]),
        case("IM-1d", "Restitution of a contact that may pull", true, [0.05, 0.2, 0.3]),
        case("IM-1e", "Restitution of a contact that never pulls", false, [0.05, 0.2, 0.3]),
        inverse(
            "IM-1f",
            "Damping for a restitution, may pull",
            true,
            [(0.4037128, 0.25), (0.2154538, 0.5), (0.1128085, 0.7)],
        ),
        inverse(
            "IM-1g",
            "Damping for a restitution, never pulls",
            false,
            [(0.5973423, 0.25), (0.2552756, 0.5), (0.1222147, 0.7)],
        ),
        inverse(
            "IM-1h",
            "Damping for a high restitution, may pull",
            true,
            [(0.0335184, 0.9), (0.1128085, 0.7), (0.2154538, 0.5)],
        ),
        inverse(
            "IM-1i",
            "Damping for a high restitution, never pulls",
            false,
            [(0.0342652, 0.9), (0.1222147, 0.7), (0.2552756, 0.5)],
        ),
    ]
}

/// Rebound over height of a fall from `h`: damped oscillation about the static deflection until the
/// contact opens, found by bisection, then free flight.
fn rebound(w: f64, z: f64, pull: bool) -> f64 {
    let (g, h): (f64, f64) = (386.4, 149.7);
    let (v0, wd, xs) = ((2.0 * g * h).sqrt(), w * (1.0 - z * z).sqrt(), g / (w * w));
    let b = (v0 - z * w * xs) / wd;
    let state = |t: f64| {
        let (e, (s, c)) = ((-z * w * t).exp(), (wd * t).sin_cos());
        let x = xs + e * (-xs * c + b * s);
        (x, e * ((z * w * xs + wd * b) * c + (wd * xs - z * w * b) * s))
    };
    // A contact that may pull opens at no penetration, another one at no force.
    let closed = |t: f64| {
        let (x, v) = state(t);
        if pull { x > 0.0 } else { w * w * x + 2.0 * z * w * v > 0.0 }
    };
    let (mut low, mut high) = (1.0 / wd, 4.0 / wd);
    for _ in 0..80 {
        let middle = 0.5 * (low + high);
        if closed(middle) { low = middle } else { high = middle }
    }
    let (x, v) = state(low);
    (0.5 * v * v / g - x) / h
}

/// Speed where the contact lets go over the speed of impact.
fn restitution(r: &crate::Trace) -> f64 {
    let mut force = r.history("contact").into_iter();
    let hit = force.find(|(_, f)| *f != 0.0);
    let free = force.find(|(_, f)| *f == 0.0);
    match (hit, free) {
        (Some(_), Some((t, _))) => r.at("v", t) / (2.0_f64 * 386.4 * 149.7).sqrt() / 0.0254,
        _ => f64::NAN,
    }
}

fn im2() -> Vec<Case> {
    [
        ("IM-2a", 50.0, true, 0.226_024),
        ("IM-2b", 200.0, true, 0.244_205),
        ("IM-2c", 1000.0, true, 0.248_851),
        ("IM-2d", 50.0, false, 0.242_129),
        ("IM-2e", 200.0, false, 0.248_241),
        ("IM-2f", 1000.0, false, 0.249_658),
    ]
    .into_iter()
    .map(|(id, w, pull, e)| {
        let z = if pull { 0.403_712_8 } else { 0.597_342_3 };
        let (title, how) = if pull {
            ("Drop from 149.7 in on a contact that may pull", "may pull")
        } else {
            ("Drop from 149.7 in on a contact that never pulls", "never pulls")
        };
        Case {
            id,
            title,
            source: "m ẍ + c ẋ + k x = m g until the contact opens",
            text: DROP.into(),
            set: vec![
                set("omega", w),
                set("ratio", z),
                set("pull", u8::from(pull)),
                set("duration", 1.2),
            ],
            solvers: BOTH,
            checks: vec![
                Check::new(
                    format!("rebound / height, ω = {w}, {how}"),
                    NUMBER,
                    rebound(w, z, pull),
                    5e-3,
                    |r| r.max("z", 0.95, 1.2) / r.at("z", 0.0),
                ),
                Check::new("speed after / before", NUMBER, e, 5e-3, restitution).other_code(),
            ],
            view: View::histories([Curve::new("z", INCH).against(|t| {
                let z = 149.7 - 0.5 * 386.4 * t * t;
                if z > 0.0 { z } else { f64::NAN }
            })]),
        }
    })
    .collect()
}
