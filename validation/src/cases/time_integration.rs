//! Integration in time.

use super::set;
use crate::case::BOTH;
use crate::unit::{METRE, NUMBER, SPEED, Unit};
use crate::{Case, Check, Curve, Solver, Trace, View};
use std::f64::consts::{PI, TAU};

const CHOPRA: &str = r#"(
    title: "Oscillator under a half sine",
    parameters: { "substeps": 1 },
    nodes: { "m": (0, 0, 0) },
    supports: { "m": (Uy, Uz, Rx, Ry, Rz) },
    elements: {
        "mass": Mass(node: "m", mass: 0.2533),
        "spring": Spring(node: "m", k2: 10, c2: "2*0.05*(0.2533*10)^0.5"),
    },
    loads: { "push": [(node: "m", dof: Ux, force: 10)] },
    functions: { "sine": HalfSine(amplitude: 1, duration: 0.6) },
    cases: {
        "push": Dynamic(
            duration: 1, dt: 0.1, step: Fixed(substeps: "substeps"),
            forces: [(load: "push", function: "sine")],
        ),
    },
    outputs: { "u": Displacement(node: "m", dof: Ux), "v": Velocity(node: "m", dof: Ux) },
)"#;

/// A half sine of 0.6 s at every tenth of a second.
const SAMPLED: &str = r#"Points(
    points: [(0, 0), (0.1, 0.5), (0.2, "3^0.5/2"), (0.3, 1), (0.4, "3^0.5/2"), (0.5, 0.5), (0.6, 0)], after_end: Zero,
)"#;

/// Undamped oscillator of period 1 s in steps of a tenth.
const FREE: &str = r#"(
    title: "Undamped oscillator",
    parameters: { "alpha": 0, "dt": 0.1 },
    nodes: { "m": (0, 0, 0) },
    supports: { "m": (Uy, Uz, Rx, Ry, Rz) },
    elements: {
        "mass": Mass(node: "m", mass: 1),
        "spring": Spring(node: "m", k2: "(2*3.141592653589793)^2"),
    },
    cases: {
        "free": Dynamic(
            duration: "60*dt", dt: "dt", step: Fixed(substeps: 1), alpha: "alpha",
            energy_limit: 0.99,
            initial: [(node: "m", dof: Ux, displacement: 1)],
        ),
    },
    outputs: { "u": Displacement(node: "m", dof: Ux) },
)"#;

const RAMP: &str = r#"(
    title: "Ramp load",
    units: (length: "in", force: "kip", time: "s"),
    parameters: { "rise": 3.141592653589793 },
    nodes: { "m": (0, 0, 0) },
    supports: { "m": (Uy, Uz, Rx, Ry, Rz) },
    elements: { "mass": Mass(node: "m", mass: 1), "spring": Spring(node: "m", k2: 4) },
    loads: { "push": [(node: "m", dof: Ux, force: 4)] },
    functions: { "ramp": Ramp(amplitude: 1, rise: "rise") },
    cases: {
        "ramp": Dynamic(
            duration: 4, dt: 0.01, step: Adaptive(tolerance: 1e-6),
            forces: [(load: "push", function: "ramp")],
        ),
    },
    outputs: { "u": Displacement(node: "m", dof: Ux) },
)"#;

const STIFF_SOFT: &str = r#"(
    title: "Stiff and soft springs behind a moving support",
    nodes: { "1": (0, 0, 0), "2": (1, 0, 0), "3": (2, 0, 0) },
    supports: { "1": Fixed, "2": (Uy, Uz, Rx, Ry, Rz), "3": (Uy, Uz, Rx, Ry, Rz) },
    elements: {
        "stiff": Spring(nodes: ("1", "2"), k1: 1e7),
        "soft": Spring(nodes: ("2", "3"), k1: 1),
        "mass 2": Mass(node: "2", mass: 1),
        "mass 3": Mass(node: "3", mass: 1),
    },
    functions: { "motion": Sine(amplitude: 1, frequency: "1.2/(2*3.141592653589793)") },
    cases: {
        "motion": Dynamic(
            duration: 10, dt: 0.01, step: Fixed(substeps: 1),
            supports: [(node: "1", dof: Ux, displacement: "motion")],
        ),
    },
    outputs: { "u3": Displacement(node: "3", dof: Ux), "v3": Velocity(node: "3", dof: Ux) },
)"#;

pub(super) fn cases() -> Vec<Case> {
    let mut all = vec![ti1_rule(), ti1_exact()];
    all.extend(ti2());
    all.extend([ti3()]);
    all.extend(ti5());
    all
}

fn steps(name: &'static str, what: &str, values: [f64; 10]) -> Vec<Check> {
    let one = |(i, x): (usize, f64)| {
        let t = 0.1 * (i + 1) as f64;
        Check::new(format!("{what}({t:.1})"), METRE, x, 2e-4, move |r| r.at(name, t))
            .absolute()
            .mark(name, t)
    };
    values.into_iter().enumerate().map(one).collect()
}

fn ti1_rule() -> Case {
    let u = [0.0437, 0.2326, 0.6121, 1.0825, 1.4310, 1.4231, 0.9622, 0.1908, -0.6044, -1.1442];
    let v = [0.8733, 2.9057, 4.6833, 4.7261, 2.2421, -2.3996, -6.8184, -8.6096, -7.2935, -3.5028];
    let mut checks = steps("u", "u", u);
    checks.extend(steps("v", "v", v));
    Case {
        id: "TI-1a",
        title: "Average acceleration in steps of 0.1 s",
        source: "Chopra, Dynamics of Structures, ex. 5.3",
        // The force of the book, straight between its samples: a half sine itself cuts the steps.
        text: CHOPRA.replace("HalfSine(amplitude: 1, duration: 0.6)", SAMPLED),
        set: Vec::new(),
        solvers: &[Solver::Hht],
        view: View::histories([Curve::new("u", METRE), Curve::new("v", SPEED)]),
        checks: checks.into_iter().map(Check::published).collect(),
    }
}

fn ti1_exact() -> Case {
    // Two sines, the second from the end of the half sine on.
    let (m, k, p, z): (f64, f64, f64, f64) = (0.2533, 10.0, PI / 0.6, 0.05);
    let w = (k / m).sqrt();
    let sine = move |t: f64| {
        if t < 0.0 {
            return 0.0;
        }
        let (r, wd) = (p / w, w * (1.0 - z * z).sqrt());
        let d = (1.0 - r * r).powi(2) + (2.0 * z * r).powi(2);
        let (s, c) = ((1.0 - r * r) / d, -2.0 * z * r / d);
        let free = -c * (wd * t).cos() - (p * s + z * w * c) / wd * (wd * t).sin();
        s * (p * t).sin() + c * (p * t).cos() + (-z * w * t).exp() * free
    };
    let exact = move |t: f64| sine(t) + sine(t - 0.6);
    let u =
        [0.0328, 0.23317, 0.64874, 1.16049, 1.52415, 1.48135, 0.92451, 0.05931, -0.77516, -1.27183];
    Case {
        id: "TI-1b",
        title: "Half sine, fine steps",
        source: "Solution of the differential equation; data of Chopra, ex. 5.3",
        text: CHOPRA.into(),
        set: vec![set("substeps", 100)],
        solvers: BOTH,
        view: View::histories([Curve::new("u", METRE).against(exact)]),
        checks: steps("u", "u", u),
    }
}

/// Size and angle of the roots of u₊ − 2A u + ρ² u₋ = 0, which samples far from the start obey.
fn roots(r: &Trace, dt: f64) -> (f64, f64) {
    let u: Vec<f64> = (40..44).map(|i| r.at("u", f64::from(i) * dt)).collect();
    // [u₁ −u₀; u₂ −u₁] (2A, ρ²) = (u₂, u₃)
    let det = -u[1] * u[1] + u[0] * u[2];
    let two_a = (-u[1] * u[2] + u[0] * u[3]) / det;
    let rho2 = (u[1] * u[3] - u[2] * u[2]) / det;
    let rho = rho2.sqrt();
    (rho, (0.5 * two_a / rho).acos())
}

fn ti2() -> Vec<Case> {
    let case = |id, title, solvers, alpha: f64, dt: f64, [rho, damping, period]: [f64; 3]| {
        // Numbers are printed to six decimals.
        let p = 1e-5;
        let w = TAU * dt;
        Case {
            id,
            title,
            source: "Hilber, Hughes, Taylor: roots of the amplification matrix",
            text: FREE.into(),
            set: vec![set("alpha", alpha), set("dt", dt)],
            solvers,
            view: crate::View::default(),
            checks: vec![
                Check::new("spectral radius", NUMBER, rho, p, move |r| roots(r, dt).0).absolute(),
                Check::new("algorithmic damping", NUMBER, damping, p, move |r| {
                    let (size, angle) = roots(r, dt);
                    -size.ln() / angle
                })
                .absolute(),
                Check::new("period error", NUMBER, period, p, move |r| w / roots(r, dt).1 - 1.0)
                    .absolute(),
            ],
        }
    };
    let hht: &[Solver] = &[Solver::Hht];
    vec![
        case("TI-2a", "HHT, α = 0", hht, 0.0, 0.1, [1.0, 0.0, 0.032_075]),
        case("TI-2b", "HHT, α = −0.05", hht, -0.05, 0.1, [0.999_282, 0.001_184, 0.036_111]),
        case("TI-2c", "HHT, α = −0.1", hht, -0.1, 0.1, [0.998_728, 0.002_106, 0.039_506]),
        case("TI-2d", "HHT, α = −0.3", hht, -0.3, 0.1, [0.997_750, 0.003_752, 0.046_567]),
        case(
            "TI-2e",
            "HHT, α = −0.1, long steps",
            hht,
            -0.1,
            0.2,
            [0.987_832, 0.011_13, 0.142_425],
        ),
        case("TI-2f", "FNA has neither error", &[Solver::Fna], 0.0, 0.1, [1.0, 0.0, 0.0]),
    ]
}

fn ti3() -> Case {
    let d = 1.0 - 1.44;
    let u = move |t: f64| ((1.2 * t).sin() - 1.2 * t.sin()) / d;
    let v = move |t: f64| (1.2 * (1.2 * t).cos() - 1.2 * t.cos()) / d;
    let mut checks = Vec::new();
    for t in [1.0_f64, 2.0, 5.0, 10.0] {
        // The stiff mode starts with 3.8e-4 m and leaves the soft mass alone to 1e-6; the step of
        // 0.01 s costs average acceleration 2e-4.
        checks.push(
            Check::new(format!("u₃({t})"), METRE, u(t), 5e-4, move |r| r.at("u3", t))
                .absolute()
                .mark("u3", t),
        );
        checks.push(
            Check::new(format!("v₃({t})"), METRE, v(t), 5e-4, move |r| r.at("v3", t))
                .absolute()
                .mark("v3", t),
        );
    }
    Case {
        id: "TI-3",
        title: "Stiff and soft springs behind a moving support",
        source: "Model of Bathe, Noh 2012; closed form without the stiff mode",
        text: STIFF_SOFT.into(),
        set: Vec::new(),
        solvers: BOTH,
        view: View::histories([
            Curve::new("u3", METRE).against(u),
            Curve::new("v3", SPEED).against(v),
        ]),
        checks,
    }
}

fn ti5() -> Vec<Case> {
    // Of the static displacement, 1 in.
    let share = Unit { si: 0.0254, ..NUMBER };
    let case = |id, rise: f64, times: Vec<f64>| {
        let u = move |t: f64| {
            if t <= rise {
                t / rise - (2.0 * t).sin() / (2.0 * rise)
            } else {
                1.0 - ((2.0 * t).sin() - (2.0 * (t - rise)).sin()) / (2.0 * rise)
            }
        };
        Case {
            id,
            title: "Ramp load",
            source: "CSI Software Verification 6-001; Chopra, Dynamics of Structures, §4.5",
            text: RAMP.into(),
            set: vec![set("rise", rise)],
            solvers: BOTH,
            view: View::histories([Curve::new("u", share).against(u)]),
            checks: times
                .into_iter()
                .map(|t| {
                    // 1e-4 of the static displacement.
                    Check::new(format!("u({t:.4}) k/p₀"), share, u(t), 1e-4, move |r| {
                        r.at("u", t)
                    })
                    .absolute()
                    .mark("u", t)
                })
                .collect(),
        }
    };
    vec![
        case("TI-5a", PI, vec![1.0, PI / 2.0, PI, 3.5]),
        case("TI-5b", PI / 2.0, vec![PI / 4.0, 1.0, 0.75 * PI, PI]),
    ]
}
