//! Springs and dashpots in a row, under imposed motion.

use crate::case::BOTH;
use crate::unit::NEWTON;
use crate::{Case, Check, Curve, View};
use std::f64::consts::{PI, TAU};

/// K₁ in series with K₂ beside (K₃ in series with a dashpot). A displacement that is linear between
/// samples has no acceleration, so K₁ u(t) acts as a force on node "a", which K₁ and K₂ hold: the same
/// equations. Node "b" weighs next to nothing: behind the dashpot it follows within a nanosecond.
fn zener() -> String {
    let points: String = (0..=250)
        .map(|i| {
            let t = 0.004 * f64::from(i);
            format!("({t:.3}, {:.17}), ", 0.1 * (10.0 * PI * t).sin())
        })
        .collect();
    format!(
        r#"(
    title: "Generalised Zener model under imposed motion",
    nodes: {{ "a": (0, 0, 0), "b": (1, 0, 0), "wall": (2, 0, 0) }},
    supports: {{ "a": (Uy, Uz, Rx, Ry, Rz), "b": (Uy, Uz, Rx, Ry, Rz), "wall": Fixed }},
    elements: {{
        "K1 + K2": Spring(nodes: ("a", "wall"), k1: "130 N/m"),
        "K3": Spring(nodes: ("a", "b"), k1: "60 N/m"),
        "dust": Mass(node: "b", mass: "1e-7 kg"),
        "dashpot": Dashpot(nodes: ("b", "wall"), c: 1.7, exponent: 0.8),
    }},
    loads: {{ "K1": [(node: "a", dof: Ux, force: "120 N")] }},
    functions: {{ "motion": Points(points: [{points}]) }},
    cases: {{
        "motion": Dynamic(
            duration: "1 s", dt: "1 ms", step: Adaptive(tolerance: 1e-6),
            forces: [(load: "K1", function: "motion")],
        ),
    }},
    outputs: {{
        "force": Displacement(terms: [
            (node: "a", dof: Ux, factor: "70 N/m"), (node: "b", dof: Ux, factor: "-60 N/m"),
        ]),
    }},
)"#
    )
}

/// Maxwell elements that are moved at three frequencies.
const MAXWELL: &str = r#"(
    title: "Maxwell elements under harmonic motion",
    parameters: { "k": "100 N/m", "c": "5 N*s/m" },
    nodes: {
        "p1": (0, 0, 0), "p2": (0, 1, 0), "p3": (0, 2, 0),
        "a1": (1, 0, 0), "a2": (1, 1, 0), "a3": (1, 2, 0),
    },
    supports: {
        "p1": Fixed, "p2": Fixed, "p3": Fixed,
        "a1": (Uy, Uz, Rx, Ry, Rz), "a2": (Uy, Uz, Rx, Ry, Rz), "a3": (Uy, Uz, Rx, Ry, Rz),
    },
    properties: {
        "spring": Spring(k1: "k"),
        "dashpot": Dashpot(axis: U2, c: "c"),
        "dust": Mass(mass: "1e-7 kg"),
    },
    elements: {
        "spring 1": Spring(nodes: ("p1", "a1"), use: "spring"),
        "spring 2": Spring(nodes: ("p2", "a2"), use: "spring"),
        "spring 3": Spring(nodes: ("p3", "a3"), use: "spring"),
        "dashpot 1": Dashpot(node: "a1", use: "dashpot"),
        "dashpot 2": Dashpot(node: "a2", use: "dashpot"),
        "dashpot 3": Dashpot(node: "a3", use: "dashpot"),
        "dust 1": Mass(node: "a1", use: "dust"),
        "dust 2": Mass(node: "a2", use: "dust"),
        "dust 3": Mass(node: "a3", use: "dust"),
    },
    functions: {
        "slow": Sine(amplitude: "1 m", frequency: "5/(2*3.141592653589793)"),
        "middle": Sine(amplitude: "1 m", frequency: "20/(2*3.141592653589793)"),
        "fast": Sine(amplitude: "1 m", frequency: "50/(2*3.141592653589793)"),
    },
    cases: {
        "motion": Dynamic(
            duration: "2.6 s", dt: "1 ms", step: Adaptive(tolerance: 1e-6),
            supports: [
                (node: "p1", dof: Ux, displacement: "slow"),
                (node: "p2", dof: Ux, displacement: "middle"),
                (node: "p3", dof: Ux, displacement: "fast"),
            ],
        ),
    },
    outputs: {
        "slow": Displacement(terms: [
            (node: "p1", dof: Ux, factor: "k"), (node: "a1", dof: Ux, factor: "-k"),
        ]),
        "middle": Displacement(terms: [
            (node: "p2", dof: Ux, factor: "k"), (node: "a2", dof: Ux, factor: "-k"),
        ]),
        "fast": Displacement(terms: [
            (node: "p3", dof: Ux, factor: "k"), (node: "a3", dof: Ux, factor: "-k"),
        ]),
    },
)"#;

pub(super) fn cases() -> Vec<Case> {
    vec![dp1(), dp5()]
}

fn dp1() -> Case {
    let values = [
        (0.02, 2.187_710_58),
        (0.04, 2.829_191_92),
        (0.06, 2.035_749_59),
        (0.08, 0.240_240_90),
        (0.10, -1.851_221_55),
        (0.132, -3.445_042_94),
        (0.2, 1.745_702_94),
        (0.232, 3.409_095_13),
        (0.316, -2.962_435_65),
        (1.0, 1.750_844_98),
    ];
    Case {
        id: "DP-1",
        title: "Generalised Zener model, motion linear between samples at 4 ms",
        source: "Code_Aster SSND101",
        text: zener(),
        set: Vec::new(),
        solvers: BOTH,
        checks: values.map(|(t, f)| Check::at("force", NEWTON, t, f, 1e-4).published()).into(),
        view: View::histories([Curve::new("force", NEWTON)]),
    }
}

fn dp5() -> Case {
    let (k, tau): (f64, f64) = (100.0, 5.0 / 100.0);
    let mut checks = Vec::new();
    let mut curves = Vec::new();
    for (output, w) in [("slow", 5.0), ("middle", 20.0), ("fast", 50.0)] {
        let x = (w * tau) * (w * tau);
        let (storage, loss) = (k * x / (1.0 + x), k * w * tau / (1.0 + x));
        // From rest: F = K' (sin ωt − …): the transient e^(−t/τ) has gone by e^(−25) here.
        let cycles = (1.25 * w / TAU).ceil();
        let whole = cycles * TAU / w;
        // As for the other dashpots: 0.1 %.
        checks.push(Check::new(
            format!("storage modulus, ω = {w}"),
            NEWTON,
            storage,
            1e-3,
            move |r| r.at(output, whole + 0.25 * TAU / w),
        ));
        checks.push(Check::new(format!("loss modulus, ω = {w}"), NEWTON, loss, 1e-3, move |r| {
            r.at(output, whole)
        }));
        curves.push(
            Curve::new(output, NEWTON).against(move |t| {
                storage * (w * t).sin() + loss * ((w * t).cos() - (-t / tau).exp())
            }),
        );
    }
    Case {
        id: "DP-5",
        title: "Maxwell elements under harmonic motion",
        source: "K' = K (ωτ)²/(1 + (ωτ)²), K'' = K ωτ/(1 + (ωτ)²), τ = C/K",
        text: MAXWELL.into(),
        set: Vec::new(),
        solvers: BOTH,
        checks,
        view: View::histories(curves),
    }
}
