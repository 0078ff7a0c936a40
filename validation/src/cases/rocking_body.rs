//! A rigid body in finite rotation: rocking from large tilts along X and Y, rolling on its rim, and in the air.

use super::block_rocking::{quarter, turning};
use super::set;
use crate::case::BOTH;
use crate::unit::{NUMBER, RADIAN, SECOND};
use crate::{Case, Check, Curve, View};
use std::f64::consts::TAU;

const G: f64 = 9.81;

/// A block let go from a tilt. `TURN` stands for the direction in plan: base points and start turn with it.
const FREE: &str = r#"(
    title: "Rigid block let go from a large tilt",
    gravity: "9.81 m/s^2",
    parameters: {
        "width": "0.5 m", "height": "2 m", "depth": "0.4 m", "mass": "1 t", "mu": 20, "duration": "3 s",
        "kn": "5e6*mass*9.81 m/s^2*height/width^2", "ks": "30*kn", "cn": "2.8*sqrt(kn*mass)",
        "alpha": "atan(width/height)", "tilt": "alpha/2", "radius": "sqrt(width^2 + height^2)/2",
        "x": "width/2 - radius*sin(alpha - tilt)",
        "z": "radius*cos(alpha - tilt) - height/2 - mass*9.81 m/s^2/(2*kn)",
        "jx": "mass*(height^2 + depth^2)/12", "jy": "mass*(height^2 + width^2)/12",
        "jz": "mass*(width^2 + depth^2)/12",
    },
    nodes: { "cg": (0, 0, "height/2") },
    elements: {
        @BODY@
    },
    cases: {
        "free": Dynamic(
            duration: "duration", dt: "1 ms", constant: [Gravity],
            initial: [
                @START@
                (node: "cg", dof: Uz, displacement: "z"),
            ],
        ),
    },
    outputs: { @OUTPUT@ },
)"#;

/// Rocking along X: rotation about Y.
fn along_x() -> String {
    FREE.replace(
        "@BODY@",
        r#""mass": Mass(node: "cg", mass: "mass", inertia: ("jx", "jy", "jz")),
        "base": RockingBody(
            node: "cg", kn: "kn", ks: "ks", mu: "mu", damping: "cn", inertia: ("jx", "jy", "jz"),
            base: [
                ("-width/2", "-depth/2", "-height/2"), ("width/2", "-depth/2", "-height/2"),
                ("-width/2", "depth/2", "-height/2"), ("width/2", "depth/2", "-height/2"),
            ],
        ),"#,
    )
    .replace(
        "@START@",
        r#"(node: "cg", dof: Ux, displacement: "x"), (node: "cg", dof: Ry, displacement: "tilt"),"#,
    )
    .replace("@OUTPUT@", r#""theta": Displacement(node: "cg", dof: Ry)"#)
}

/// The same along Y: rotation about −X.
fn along_y() -> String {
    FREE.replace(
        "@BODY@",
        r#""mass": Mass(node: "cg", mass: "mass", inertia: ("jy", "jx", "jz")),
        "base": RockingBody(
            node: "cg", kn: "kn", ks: "ks", mu: "mu", damping: "cn", inertia: ("jy", "jx", "jz"),
            base: [
                ("-depth/2", "-width/2", "-height/2"), ("-depth/2", "width/2", "-height/2"),
                ("depth/2", "-width/2", "-height/2"), ("depth/2", "width/2", "-height/2"),
            ],
        ),"#,
    )
    .replace(
        "@START@",
        r#"(node: "cg", dof: Uy, displacement: "x"), (node: "cg", dof: Rx, displacement: "-tilt"),"#,
    )
    .replace("@OUTPUT@", r#""theta": Displacement(node: "cg", dof: Rx, factor: -1)"#)
}

pub(super) fn cases() -> Vec<Case> {
    vec![
        free(
            "RB-3c",
            "Rocking from half the overturning angle, H/B = 4",
            along_x(),
            (0.5, 30.0),
            3,
        ),
        free("RB-3d", "Rocking from half the overturning angle, H/B = 2", along_x(), (1.0, 1e3), 2),
        free(
            "RB-3e",
            "Rocking along Y from half the overturning angle, H/B = 4",
            along_y(),
            (0.5, 30.0),
            1,
        ),
        shaken(),
        wobble(),
        rolling(),
    ]
}

/// Housner's block from α/2: passages of zero and the peaks between them.
fn free(
    id: &'static str,
    title: &'static str,
    text: String,
    (width, shear): (f64, f64),
    swings: usize,
) -> Case {
    let alpha = (width / 2.0).atan();
    let p = (0.75 * G / (0.5 * width).hypot(1.0)).sqrt();
    let eta = 1.0 - 1.5 * alpha.sin().powi(2);
    let start = 0.5 * alpha;
    let mut checks = Vec::new();
    let (mut t, mut theta) = (0.0, start);
    for n in 0..swings {
        t += quarter(p, alpha, theta);
        checks.push(Check::new(format!("passage {}", n + 1), SECOND, t, 1e-3, move |r| {
            r.crossing("theta", 0.0, n)
        }));
        let cosine = alpha.cos() + eta * eta * ((alpha - theta).cos() - alpha.cos());
        theta = alpha - cosine.acos();
        checks.push(Check::new(
            format!("peak after passage {} / α", n + 1),
            NUMBER,
            theta / alpha,
            1e-3,
            move |r| turning(r, n + 1, 1.0).1.abs() / alpha,
        ));
        t += quarter(p, alpha, theta);
    }
    Case {
        id,
        title,
        source: "Housner 1963: θ̈ = −p² sin(α sgn θ − θ), η = 1 − 3/2 sin²α",
        text,
        // The struck corner must not give way sideways; for the stocky block that takes stiffer shear.
        set: vec![set("width", width), set("duration", 1.05 * t), set("ks", format!("{shear}*kn"))],
        solvers: BOTH,
        checks,
        view: View::histories([Curve::new("theta", RADIAN)]),
    }
}

/// The shipped model under the fourth pulse of the seed: (time, peak) of the rigid block in finite rotation.
fn shaken() -> Case {
    let peaks =
        [(0.10950, -0.0033024), (0.25667, 0.0147948), (0.42957, -0.0071941), (0.54829, 0.0035118)];
    let mut checks = Vec::new();
    for (n, (t, peak)) in peaks.into_iter().enumerate() {
        let sign = -1.0;
        checks.push(
            Check::new(format!("time of peak {}", n + 1), SECOND, t, 1e-2, move |r| {
                rotation(r, n, sign).0
            })
            .other_code(),
        );
        checks.push(
            Check::new(format!("peak {}", n + 1), RADIAN, peak, 1e-2, move |r| {
                -rotation(r, n, sign).1
            })
            .other_code(),
        );
    }
    Case {
        id: "RB-7c",
        title: "Block of 1 m × 2 m under one sine of 0.8 g and 5 Hz, no sliding, in finite rotation",
        source: "Rigid block, η = 0.7, integrated (independent code)",
        text: include_str!("../../../models/rocking_body.ron").into(),
        set: vec![
            set("width", "1 m"),
            set("height", "2 m"),
            set("g", "9.80665 m/s^2"),
            set("mu", 20),
            set("ah", 0.8),
            set("frequency", "5 Hz"),
            set("duration", "0.6 s"),
            set("kn", "1e6*mass*g*height/width^2"),
        ],
        solvers: BOTH,
        checks,
        view: View::histories([Curve::new("rotation", RADIAN)]),
    }
}

/// The n-th turning point of the rotation about +Y between impacts; `sign` of the first.
fn rotation(r: &crate::Trace, n: usize, sign: f64) -> (f64, f64) {
    // The output is positive about −Y.
    let passages: Vec<f64> =
        r.crossings("rotation", 0.0).into_iter().filter(|t| *t > 0.05).collect();
    let from = if n == 0 { 0.0 } else { passages.get(n - 1).copied().unwrap_or(f64::NAN) };
    let to = passages.get(n).copied().unwrap_or(f64::INFINITY);
    let sign = if n.is_multiple_of(2) { -sign } else { sign };
    r.extreme("rotation", sign, from, to)
}

/// A body in the air without gravity that spins about its axis and wobbles.
const WOBBLE: &str = r#"(
    title: "Body that wobbles in the air",
    gravity: 0,
    nodes: { "cg": (0, 0, "1 m") },
    elements: {
        "mass": Mass(node: "cg", mass: "1 t", inertia: (400, 400, 150)),
        "base": RockingBody(
            node: "cg", kn: "1e6 N/m", inertia: (400, 400, 150),
            base: [("-0.5 m", 0, "-1 m"), ("0.5 m", 0, "-1 m"), (0, "0.5 m", "-1 m")],
        ),
    },
    cases: {
        "free": Dynamic(
            duration: "2 s", dt: "5 ms", step: Adaptive(tolerance: 1e-6),
            initial: [
                (node: "cg", dof: Uz, displacement: "3 m"),
                (node: "cg", dof: Rx, velocity: "0.3 rad/s"),
                (node: "cg", dof: Rz, velocity: "5 rad/s"),
            ],
        ),
    },
    outputs: {
        "x": Displacement(node: "cg", dof: Rx),
        "y": Displacement(node: "cg", dof: Ry),
        "tilt": LinkHistory(link: "base", variable: "tilt"),
    },
)"#;

/// Ω₁ = A cos λt, Ω₂ = A sin λt with λ = (J₃ − J₁)/J₁ Ω₃; the axis goes round the constant angular momentum.
fn wobble() -> Case {
    let (a, lambda, j1, j3): (f64, f64, f64, f64) =
        (0.3, (150.0 - 400.0) / 400.0 * 5.0, 400.0, 150.0);
    let x = move |t: f64| a / lambda * (lambda * t).sin();
    let y = move |t: f64| a / lambda * (1.0 - (lambda * t).cos());
    // The axis is at the angle γ from the momentum and turns about it by L t/J₁; it starts upright.
    let (l1, l3) = (j1 * a, j3 * 5.0);
    let gamma = l1.atan2(l3);
    let rate = l1.hypot(l3) / j1;
    let tilt = move |t: f64| {
        let cosine = gamma.cos().powi(2) + gamma.sin().powi(2) * (rate * t).cos();
        cosine.clamp(-1.0, 1.0).acos()
    };
    Case {
        id: "RB-W",
        title: "Body that spins and wobbles in the air: gyroscopic moment and attitude",
        source: "Euler's equations of a symmetric body",
        text: WOBBLE.into(),
        set: Vec::new(),
        solvers: BOTH,
        checks: vec![
            Check::at("x", RADIAN, 1.0, x(1.0), 1e-3),
            Check::at("x", RADIAN, 2.0, x(2.0), 1e-3),
            Check::at("y", RADIAN, 1.0, y(1.0), 1e-3),
            Check::at("tilt", RADIAN, 1.0, tilt(1.0), 1e-3),
            Check::at("tilt", RADIAN, 1.7, tilt(1.7), 1e-3),
        ],
        view: View::histories([
            Curve::new("x", RADIAN).against(x),
            Curve::new("y", RADIAN).against(y),
            Curve::new("tilt", RADIAN).against(tilt),
        ]),
    }
}

/// A cask let go tilted, with a spin that makes it roll on its rim. The start follows from the tilt, the
/// precession and the spin about its axis as a body that rolls has them.
const ROLLING: &str = r#"(
    title: "Cask that rolls on its rim",
    gravity: "9.81 m/s^2",
    parameters: {
        "rho": "1 m", "height": "2 m", "mass": "10 t", "jt": "15833.333333333334 kg*m^2", "ja": "5000 kg*m^2",
        "kn": "1e11 N/m", "ks": "1e11 N/m", "tilt": 0.3, "precession": 1, "spin": 1,
        "across": "precession*sin(tilt)",
        // speed of the centre of gravity along Y
        "vy": "across*height - spin*rho",
    },
    nodes: { "cg": (0, 0, "height") },
    elements: {
        "mass": Mass(node: "cg", mass: "mass", inertia: ("jt", "jt", "ja")),
        "base": RockingBody(
            node: "cg", rim_radius: "rho", rim_depth: "height", kn: "kn", ks: "ks", mu: 0.2,
            damping: "1e6 N*s/m", pull: true, inertia: ("jt", "jt", "ja"),
        ),
    },
    cases: {
        "roll": Dynamic(
            duration: "3 s", dt: "2 ms", constant: [Gravity],
            initial: [
                (node: "cg", dof: Ux, displacement: "rho*(1 - cos(tilt)) + height*sin(tilt)"),
                (node: "cg", dof: Uz, displacement: "rho*sin(tilt) + height*cos(tilt) - height"),
                (node: "cg", dof: Ry, displacement: "tilt"),
                (node: "cg", dof: Uy, velocity: "vy * 1 /s"),
                (node: "cg", dof: Rx, velocity: "-across * 1 /s"),
                (node: "cg", dof: Rz, velocity: "spin * 1 /s"),
            ],
        ),
    },
    outputs: {
        "tilt": LinkHistory(link: "base", variable: "tilt"),
        "x": Displacement(node: "cg", dof: Ux),
        "y": Displacement(node: "cg", dof: Uy),
    },
)"#;

/// Tilt and its rate, and angular velocity up the disc and along the axis, of a body that rolls on its rim
/// without slip: Euler's equations about the centre of gravity in axes that go with the contact, the
/// contact force eliminated; by Runge and Kutta. The pressed arc, of half angle (3 N/(2 κ ρ sin θ))^⅓ with
/// κ = kₙ/2π, carries a pressure like a parabola and resists turning about the vertical by 3/8 μ N ρ ψ.
fn rolls(until: f64) -> f64 {
    let (m, rho, h, jt, ja, g) = (1e4, 1.0, 2.0, 15833.333333333334, 5000.0, 9.81);
    let (mu, per_angle) = (0.2, 1e11 / TAU);
    let cross = |a: [f64; 3], b: [f64; 3]| {
        [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
    };
    let r = [0.0, rho, h];
    let rate = |y: [f64; 4]| {
        let (sin, cos) = y[0].sin_cos();
        let spin = [y[1], y[2], y[3]];
        let axes = [y[1], y[2], y[2] / sin * cos];
        let momentum = [jt * y[1], jt * y[2], ja * y[3]];
        let pull = cross(axes, cross(spin, r));
        let pull = [m * pull[0], m * (pull[1] + g * sin), m * (pull[2] + g * cos)];
        let (turn, lever) = (cross(axes, momentum), cross(r, pull));
        // (J − m r× r×) ω̇ = b: the first equation stands alone.
        let (a22, a33, a23) = (jt + m * h * h, ja + m * rho * rho, -m * rho * h);
        let det = a22 * a33 - a23 * a23;
        let mut pivot = 0.0;
        let mut change = [0.0; 3];
        // The normal force depends a little on what the pivoting moment does.
        for _ in 0..4 {
            let b = [0, 1, 2].map(|i: usize| -(turn[i] + lever[i]) + pivot * [0.0, sin, cos][i]);
            change = [
                b[0] / (jt + m * (rho * rho + h * h)),
                (b[1] * a33 - b[2] * a23) / det,
                (b[2] * a22 - b[1] * a23) / det,
            ];
            let forward = cross(change, r);
            let normal = m * (forward[1] * sin + forward[2] * cos) + pull[1] * sin + pull[2] * cos;
            let half = (1.5 * normal / (per_angle * rho * sin)).cbrt();
            pivot = -mu * normal * rho * 0.375 * half * (y[2] * sin + y[3] * cos).signum();
        }
        [y[1], change[0], change[1], change[2]]
    };
    let n = 4000;
    let dt = until / f64::from(n);
    let mut y = [0.3, 0.0, 0.3_f64.sin(), 1.0];
    let at = |y: [f64; 4], k: [f64; 4], s: f64| [0, 1, 2, 3].map(|i: usize| y[i] + s * k[i]);
    for _ in 0..n {
        let k1 = rate(y);
        let k2 = rate(at(y, k1, 0.5 * dt));
        let k3 = rate(at(y, k2, 0.5 * dt));
        let k4 = rate(at(y, k3, dt));
        y = [0, 1, 2, 3].map(|i: usize| y[i] + dt / 6.0 * (k1[i] + 2.0 * (k2[i] + k3[i]) + k4[i]));
    }
    y[0]
}

fn rolling() -> Case {
    let times = [0.5, 1.0, 1.5, 2.0, 2.5, 3.0];
    Case {
        id: "RB-R",
        title: "Cask that rolls on its rim: tilt",
        source: "Rolling without slip, with pivoting friction of the pressed arc: Euler's equations, integrated beside",
        text: ROLLING.into(),
        set: Vec::new(),
        solvers: BOTH,
        checks: times
            .into_iter()
            .map(|t| Check::at("tilt", RADIAN, t, rolls(t), 1e-2).other_code())
            .collect(),
        view: View::histories([Curve::new("tilt", RADIAN)]),
    }
}
