//! The degrading spring of Bouc and Wen against an integration of its equation.

use crate::case::BOTH;
use crate::unit::{JOULE, NEWTON, Unit};
use crate::{Case, Check, View};
use std::f64::consts::TAU;

/// Parameters that the model and the reference share: k, d_y, α, n, β, γ, δ_A, δ_ν, δ_η.
const K: f64 = 4e7;
const DY: f64 = 0.005;
const ALPHA: f64 = 0.05;
const SHAPE: [f64; 6] = [1.5, 0.8, 0.2, 0.001, 0.02, 0.08];

/// The mass only gives the solver something to move.
const MOVED: &str = r#"(
    title: "Degrading spring moved to and fro",
    nodes: { "p": (0, 0, 0), "m": (1, 0, 0) },
    supports: { "p": Fixed, "m": (Uy, Uz, Rx, Ry, Rz) },
    elements: {
        "wall": BoucWen(
            node: "p", axis: U2, k: "40 MN/m", dy: "5 mm", alpha: 0.05, n: 1.5, beta: 0.8, gamma: 0.2,
            delta_a: 0.001, delta_nu: 0.02, delta_eta: 0.08,
        ),
        "mass": Mass(node: "m", mass: "1 kg"),
        "spring": Spring(node: "m", k2: "1 N/m"),
    },
    functions: { "motion": Sine(amplitude: "30 mm", frequency: "0.5 Hz") },
    cases: {
        "motion": Dynamic(
            duration: "8 s", dt: "2 ms", supports: [(node: "p", dof: Ux, displacement: "motion")],
        ),
    },
    outputs: {
        "u": Displacement(node: "p", dof: Ux),
        "force": LinkForce(link: "wall", axis: U2),
    },
)"#;

/// Deformation, force and work of the spring over time: Runge-Kutta's method of order 4.
fn integrated(duration: f64, steps: u32) -> Vec<[f64; 4]> {
    let [n, beta, gamma, delta_a, delta_nu, delta_eta] = SHAPE;
    let h = duration / f64::from(steps);
    let d = |t: f64| 0.03 * (0.5 * TAU * t).sin();
    let rate = |t: f64, [z, e]: [f64; 2]| {
        let u = 0.03 * 0.5 * TAU * (0.5 * TAU * t).cos() / DY;
        let (a, nu, eta) = (1.0 - delta_a * e, 1.0 + delta_nu * e, 1.0 + delta_eta * e);
        let pull = beta * u.abs() * z.abs().powf(n - 1.0) * z + gamma * u * z.abs().powf(n);
        [(a * u - nu * pull) / eta, z * u]
    };
    let mut y = [0.0; 2];
    let mut all = vec![[0.0; 4]];
    for i in 0..steps {
        let t = h * f64::from(i);
        let add = |k: [f64; 2], h: f64| [y[0] + h * k[0], y[1] + h * k[1]];
        let a = rate(t, y);
        let b = rate(t + 0.5 * h, add(a, 0.5 * h));
        let c = rate(t + 0.5 * h, add(b, 0.5 * h));
        let e = rate(t + h, add(c, h));
        y = [0, 1].map(|j| y[j] + h * (a[j] + 2.0 * (b[j] + c[j]) + e[j]) / 6.0);
        let d = d(t + h);
        let force = ALPHA * K * d + (1.0 - ALPHA) * K * DY * y[0];
        let work = 0.5 * ALPHA * K * d * d + (1.0 - ALPHA) * K * DY * DY * y[1];
        all.push([t + h, d, force, work]);
    }
    all
}

pub(super) fn cases() -> Vec<Case> {
    let run = integrated(8.0, 160_000);
    let at = |t: f64| run[(t / 8.0 * 160_000.0).round() as usize];
    let mut checks: Vec<Check> = [0.1, 0.5, 0.8, 1.1, 1.5, 2.2, 3.5, 4.5, 5.3, 6.5, 7.5, 7.9]
        .into_iter()
        .map(|t| Check::at("force", NEWTON, t, at(t)[2], 1e-3).other_code())
        .collect();
    let work = Check::new("work of four cycles", JOULE, at(8.0)[3], 1e-3, |r| {
        let (u, f) = (r.history("u"), r.history("force"));
        (1..u.len()).map(|i| 0.5 * (f[i - 1].1 + f[i].1) * (u[i].1 - u[i - 1].1)).sum()
    });
    checks.push(work.other_code());
    let reference = run.iter().step_by(100).map(|r| (1e3 * r[1], 1e-3 * r[2])).collect();
    vec![Case {
        id: "LK-20",
        title: "Degrading spring of Bouc and Wen, four cycles",
        source: "Equation of Baber & Wen 1981, integrated by Runge-Kutta with a step of 50 µs",
        text: MOVED.into(),
        set: Vec::new(),
        solvers: BOTH,
        checks,
        view: View::Path {
            x: ("u", Unit { name: "mm", si: 1e-3 }),
            y: ("force", Unit { name: "kN", si: 1e3 }),
            reference,
        },
    }]
}
