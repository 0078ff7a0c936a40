//! A block that rocks on two stiff gaps at small displacements: let go, and shaken.

use super::set;
use crate::case::BOTH;
use crate::unit::{NUMBER, RADIAN, SECOND};
use crate::{Case, Check, Curve, View};

const G: f64 = 9.80665;

/// A block on two gaps, held horizontally at the middle of its base, let go from a rotation about its
/// right foot or shaken from rest.
const ROCKING: &str = r#"(
    title: "Block that rocks on two gaps",
    plane: XZ,
    parameters: {
        "mass": "1000 kg", "b": "0.5 m", "height": "1 m", "k": "1e10 N/m", "c": "5.8e6 N*s/m",
        "pull": 0, "theta": 0.02, "a": "0.8 g", "cycles": 1, "duration": "0.6 s",
    },
    nodes: { "base": (0, 0, 0), "cg": (0, 0, "height"), "left": ("-b", 0, 0), "right": ("b", 0, 0) },
    supports: { "base": Ux },
    properties: { "foot": NLink(kn: "k", damping: "c", pull: "pull") },
    elements: {
        "block": RigidBody(nodes: ("base", "cg", "left", "right")),
        "inertia": Mass(node: "cg", mass: "mass", inertia: (0, "mass*(4*b^2 + 4*height^2)/12", 0)),
        "foot left": NLink(node: "left", use: "foot"),
        "foot right": NLink(node: "right", use: "foot"),
    },
    functions: { "shaking": Sine(amplitude: "a", frequency: "5 Hz", cycles: "cycles") },
    cases: {
        "gravity": Static(loads: [Gravity]),
        "shaking": Dynamic(
            after: "gravity", duration: "duration", dt: "0.2 ms",
            base: [(direction: X, function: "shaking")],
        ),
        "free": Dynamic(
            duration: "duration", dt: "0.2 ms", constant: [Gravity],
            initial: [
                (node: "base", dof: Uz, displacement: "b*theta"),
                (node: "base", dof: Ry, displacement: "theta"),
            ],
        ),
    },
    outputs: { "theta": Displacement(node: "base", dof: Ry) },
)"#;

pub(super) fn cases() -> Vec<Case> {
    let mut all = rb3();
    all.extend(rb7());
    all.push(rb8_rigid());
    all.extend(rb8());
    all
}

/// The `n`-th (from 0) turning point of θ between passages of zero, or after the last of them.
pub(super) fn turning(r: &crate::Trace, n: usize, first_sign: f64) -> (f64, f64) {
    let passages = r.crossings("theta", 0.0);
    let from = if n == 0 { 0.0 } else { passages.get(n - 1).copied().unwrap_or(f64::NAN) };
    let to = passages.get(n).copied().unwrap_or(f64::INFINITY);
    let sign = if n.is_multiple_of(2) { first_sign } else { -first_sign };
    r.extreme("theta", sign, from, to)
}

/// Time from a turning point θ₀ to θ = 0 of θ̈ = −p² sin(α − θ), by its energy; θ = θ₀ (1 − s²) takes the
/// root out of the integrand.
pub(super) fn quarter(p: f64, alpha: f64, theta: f64) -> f64 {
    let n = 1000;
    let rate = |s: f64| {
        let at = theta * (1.0 - s * s);
        let gain = 4.0 * p * p * (alpha - 0.5 * (at + theta)).sin() * (0.5 * (theta - at)).sin();
        2.0 * theta * s / gain.sqrt()
    };
    (0..n).map(|i| rate((f64::from(i) + 0.5) / f64::from(n))).sum::<f64>() / f64::from(n)
}

/// Housner's block at rotations so small that the small displacements of the model are exact.
fn rb3() -> Vec<Case> {
    let one = |id, title, b: f64| {
        let alpha = b.atan();
        let p = (0.75 * G / b.hypot(1.0)).sqrt();
        let eta = 1.0 - 1.5 * alpha.sin().powi(2);
        let start = 1e-3 * alpha;
        let mut checks = Vec::new();
        let (mut t, mut theta) = (0.0, start);
        for n in 0..4 {
            t += quarter(p, alpha, theta);
            checks.push(Check::new(format!("passage {}", n + 1), SECOND, t, 1e-3, move |r| {
                r.crossing("theta", 0.0, n)
            }));
            // cos(α − θ₊) = cos α + η² (cos(α − θ) − cos α), written without differences of cosines
            let drop = 2.0 * (alpha - 0.5 * theta).sin() * (0.5 * theta).sin();
            let cosine = alpha.cos() + eta * eta * drop;
            theta = alpha - cosine.acos();
            checks.push(Check::new(
                format!("peak after passage {} / θ₀", n + 1),
                NUMBER,
                theta / start,
                1e-3,
                move |r| turning(r, n + 1, 1.0).1.abs() / r.at("theta", 0.0),
            ));
            t += quarter(p, alpha, theta);
        }
        Case {
            id,
            title,
            source: "Housner 1963: θ̈ = −p² sin(α sgn θ − θ), η = 1 − 3/2 sin²α, released from 0.001 α",
            text: ROCKING.into(),
            // The feet give less than a millionth of the uplift.
            set: vec![
                set("b", b),
                set("theta", start),
                set("k", 1e14),
                set("c", 5.8e8),
                set("duration", 1.05 * t),
            ],
            solvers: BOTH,
            checks: checks.into_iter().map(|c| c.in_analysis("free")).collect(),
            view: View::histories([Curve::new("theta", RADIAN).in_analysis("free")]),
        }
    };
    vec![
        one("RB-3a", "Small free rocking, height/width = 4", 0.25),
        one("RB-3b", "Small free rocking, height/width = 2", 0.5),
    ]
}

fn rb7() -> Vec<Case> {
    let case = |id, title, cycles: f64, peaks: Vec<(f64, f64)>, impacts: Vec<f64>| {
        let mut checks = Vec::new();
        for (n, (t, theta)) in peaks.into_iter().enumerate() {
            let what = format!("peak {}", n + 1);
            checks.push(
                Check::new(what.clone(), RADIAN, theta, 1e-2, move |r| turning(r, n, -1.0).1)
                    .mark("theta", t),
            );
            checks.push(Check::new(format!("time of {what}"), SECOND, t, 1e-2, move |r| {
                turning(r, n, -1.0).0
            }));
        }
        for (n, t) in impacts.into_iter().enumerate() {
            checks.push(Check::new(format!("impact {}", n + 1), SECOND, t, 1e-2, move |r| {
                r.crossing("theta", 0.0, n)
            }));
        }
        Case {
            id,
            title,
            source: "θ̈ = −(3g/4R²)(b sgn θ + h A(t)), η = 0.7 an impact, integrated",
            text: ROCKING.into(),
            set: vec![set("cycles", cycles)],
            solvers: BOTH,
            checks: checks.into_iter().map(|c| c.in_analysis("shaking").other_code()).collect(),
            view: View::histories([Curve::new("theta", RADIAN).in_analysis("shaking")]),
        }
    };
    vec![
        case(
            "RB-7a",
            "Block that rocks under one sine, 0.8 g, 5 Hz",
            1.0,
            vec![
                (0.10979, -0.003_283_5),
                (0.25524, 0.014_556),
                (0.42435, -0.007_132_7),
                (0.54273, 0.003_495_1),
            ],
            vec![0.14361, 0.35472, 0.49399],
        ),
        case(
            "RB-7b",
            "Block that rocks under a half sine, 0.8 g, 5 Hz",
            0.5,
            vec![(0.11218, -0.003_314_9), (0.19288, 0.001_624_3)],
            Vec::new(),
        ),
    ]
}

fn rb8_rigid() -> Case {
    // Rigid limit of stiff contacts close to critical damping: amplitude × 0.49 an impact,
    // quarter periods √(2 I_A θ/(m g b)), I_A = 4/3 m R².
    let quarter = |theta: f64| (2.0 * 4.0 / 3.0 * 1.25 * theta / (G * 0.5)).sqrt();
    let mut checks = Vec::new();
    let (mut t, mut theta, mut sign) = (0.0, 0.02, 1.0);
    // Parabolas: time of the peak, peak, quarter period.
    let mut arcs = vec![(0.0, theta, quarter(theta))];
    for n in 0..3 {
        t += quarter(theta);
        let (from, to) = (t, t + 2.0 * quarter(theta * 0.49));
        theta *= 0.49;
        sign = -sign;
        checks.push(Check::new(format!("passage {}", n + 1), SECOND, t, 5e-3, move |r| {
            r.crossing("theta", 0.0, n)
        }));
        checks.push(Check::new(
            format!("peak after passage {}", n + 1),
            RADIAN,
            sign * theta,
            5e-3,
            move |r| r.extreme("theta", sign, from, to).1,
        ));
        t += quarter(theta);
        arcs.push((t, sign * theta, quarter(theta)));
    }
    Case {
        id: "RB-8",
        title: "Block that rocks on two stiff gaps",
        source: "Housner 1963: [1 − 3/2 sin²α]² = 0.49 an impact; constant restoring moment",
        text: ROCKING.into(),
        set: vec![set("duration", "0.5 s")],
        solvers: BOTH,
        view: View::histories([Curve::new("theta", RADIAN).in_analysis("free").against(
            move |t| {
                let arc = arcs.iter().find(|(top, _, quarter)| t <= top + quarter);
                arc.map_or(f64::NAN, |(top, peak, quarter)| {
                    peak * (1.0 - ((t - top) / quarter).powi(2))
                })
            },
        )]),
        checks: checks.into_iter().map(|c| c.in_analysis("free")).collect(),
    }
}

/// The same with contacts of finite stiffness, which may pull or not.
fn rb8() -> Vec<Case> {
    let case = |id, title, k: f64, c: f64, pull: u8, rows: Vec<(f64, f64)>| {
        let mut checks = Vec::new();
        for (n, (t, theta)) in rows.into_iter().enumerate() {
            checks.push(Check::new(format!("passage {}", n + 1), SECOND, t, 5e-3, move |r| {
                r.crossing("theta", 0.0, n)
            }));
            let what = format!("peak after passage {}", n + 1);
            checks.push(Check::new(what, RADIAN, theta, 5e-3, move |r| turning(r, n + 1, 1.0).1));
        }
        Case {
            id,
            title,
            source: "m z̈ = Fᵣ + Fₗ − m g, I θ̈ = (Fₗ − Fᵣ) b, integrated",
            text: ROCKING.into(),
            set: vec![set("k", k), set("c", c), set("pull", pull)],
            solvers: BOTH,
            checks: checks.into_iter().map(|c| c.in_analysis("free").other_code()).collect(),
            view: View::histories([Curve::new("theta", RADIAN).in_analysis("free")]),
        }
    };
    vec![
        case(
            "RB-8b",
            "Block on two soft gaps that never pull",
            5e7,
            4e5,
            0,
            vec![
                (0.116_766, -0.009_665_48),
                (0.278_908, 0.004_577_89),
                (0.390_531, -0.002_086_39),
                (0.465_984, 0.000_868_70),
            ],
        ),
        case(
            "RB-8c",
            "Block on two soft gaps that may pull",
            5e7,
            4e5,
            1,
            vec![(0.116_766, -0.007_180_10), (0.256_365, 0.002_087_24), (0.331_476, -0.000_424_76)],
        ),
        case(
            "RB-8d",
            "Block on two gaps of middling stiffness that never pull",
            1e9,
            1.8e6,
            0,
            vec![
                (0.116_610, -0.009_793_19),
                (0.279_798, 0.004_790_63),
                (0.393_934, -0.002_339_39),
                (0.473_693, 0.001_138_29),
            ],
        ),
    ]
}
