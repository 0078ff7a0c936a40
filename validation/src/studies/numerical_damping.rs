//! What the HHT rule damps by itself, over all step sizes.

use super::runs::{HHT, largest, run, solution};
use crate::case::{Kind, Tolerance};
use crate::{Findings, Study};
use std::f64::consts::TAU;
use trilith_report::{Color, Figure, Stroke};

pub(super) const STUDIES: [Study; 1] = [Study {
    id: "ND-1",
    title: "Numerical damping of HHT",
    source: "Hilber, Hughes, Taylor 1977: spectral radius of the amplification matrix",
    work: radius,
}];

const ALPHAS: [f64; 3] = [0.0, -0.1, -0.3];
/// Steps over the period.
const STEPS: [f64; 9] = [0.02, 0.05, 0.1, 0.2, 0.3, 0.5, 1.0, 2.0, 5.0];

/// Undamped, period 1 s.
const OSCILLATOR: &str = r#"(
    parameters: { "dt": 0.1 },
    nodes: { "m": (0, 0, 0) },
    supports: { "m": (Uy, Uz, Rx, Ry, Rz) },
    elements: {
        "mass": Mass(node: "m", mass: 1),
        "spring": Spring(node: "m", k2: "(2*3.141592653589793)^2"),
    },
    cases: { "free": Dynamic(
        duration: "60*dt", dt: "dt", step: Fixed(substeps: 1),
        initial: [(node: "m", dof: Ux, displacement: 1)],
    ) },
    outputs: { "u": Displacement(node: "m", dof: Ux) },
)"#;

type Matrix = [[f64; 3]; 3];

/// (u, h u̇, h² ü) after a step h of ü + ω² u = 0 over that before, Ω = ω h.
fn amplification(alpha: f64, omega: f64) -> Matrix {
    let (gamma, beta) = (0.5 - alpha, 0.25 * (1.0 - alpha) * (1.0 - alpha));
    let w2 = omega * omega;
    let d = 1.0 + (1.0 + alpha) * beta * w2;
    // ü₁ + ω² ((1 + α) u₁ − α u₀) = 0
    let a = [-w2 / d, -w2 * (1.0 + alpha) / d, -w2 * (1.0 + alpha) * (0.5 - beta) / d];
    let u = [1.0 + beta * a[0], 1.0 + beta * a[1], 0.5 - beta + beta * a[2]];
    let v = [gamma * a[0], 1.0 + gamma * a[1], 1.0 - gamma + gamma * a[2]];
    [u, v, a]
}

/// Spectral radius as ‖Aⁿ‖^(1/n), n = 2³⁰.
fn spectral_radius(mut a: Matrix) -> f64 {
    let (mut log, mut n) = (0.0, 1.0);
    for _ in 0..30 {
        let size = a.iter().flatten().fold(0.0, |m: f64, x| m.max(x.abs()));
        log += size.ln() / n;
        n *= 2.0;
        let b = a.map(|row| row.map(|x| x / size));
        for (i, row) in a.iter_mut().enumerate() {
            for (j, x) in row.iter_mut().enumerate() {
                *x = (0..3).map(|k| b[i][k] * b[k][j]).sum();
            }
        }
    }
    log.exp()
}

/// Size of the root pair of u₊ − 2A u + ρ² u₋ = 0, which the run obeys once the third root has died.
fn measured(alpha: f64, dt: f64) -> Result<f64, String> {
    let r = run(OSCILLATOR, &[("dt", &dt)], HHT, |model| {
        solution(model, |s| (s.alpha, s.energy_limit) = (alpha, 1e9));
    })?;
    let u: Vec<f64> = (50..54).map(|i| r.at("u", f64::from(i) * dt)).collect();
    Ok(((u[1] * u[3] - u[2] * u[2]) / (u[0] * u[2] - u[1] * u[1])).sqrt())
}

fn radius(found: &mut Findings) -> Result<(), String> {
    found.text(
        "Marks: from runs of an undamped oscillator; lines: from the matrix of the rule. With α = 0 nothing is \
         damped at any step; with α < 0 what the step does not resolve is, and the motion proper hardly.",
    );
    let mut figure = Figure::new("HHT", "step / period", "spectral radius")
        .log_x()
        .ranges((0.01, 10.0), (0.4, 1.05));
    for (alpha, color) in ALPHAS.into_iter().zip(Color::PALETTE) {
        let exact = |x: f64| spectral_radius(amplification(alpha, TAU * x));
        let curve = (0..=120).map(|i| 10f64.powf(f64::from(i) / 40.0 - 2.0)).map(|x| (x, exact(x)));
        let mut points = Vec::new();
        for dt in STEPS {
            points.push((dt, measured(alpha, dt)?));
        }
        let worst = largest(points.iter().map(|(x, y)| (y - exact(*x)).abs()));
        let what = format!("α = {alpha}: largest error of the spectral radius");
        found.check(what, "", (1e-5, Kind::ClosedForm), Tolerance::AtMost, "hht", worst);
        figure = figure.colored(format!("α = {alpha}"), Stroke::Line, color, curve).colored(
            "",
            Stroke::Rings,
            color,
            points,
        );
    }
    found.figure(figure);
    Ok(())
}
