//! Friction.

use super::set;
use crate::case::BOTH;
use crate::unit::{INCH, METRE};
use crate::{Case, Check};
use std::f64::consts::{PI, TAU};

/// A mass on a spring and a friction contact, let go from a distance.
const FREE: &str = r#"(
    title: "Free vibration with friction",
    parameters: {
        "mass": "1 kg", "k": "1e4 N/m", "mu": 0.1, "normal": "10 N", "ks": "1e8 N/m", "u0": "0.85 mm",
        "duration": "0.2 s", "dt": "0.1 ms",
    },
    nodes: { "m": (0, 0, 0) },
    supports: { "m": (Uy, Rx, Ry, Rz) },
    elements: {
        "mass": Mass(node: "m", mass: "mass"),
        "spring": Spring(node: "m", k2: "k"),
        "friction": NLink(node: "m", kn: "ks", ks: "ks", mu: "mu"),
    },
    loads: { "press": [(node: "m", dof: Uz, force: "-normal")] },
    cases: {
        "press": Static(loads: ["press"]),
        "free": Dynamic(
            after: "press", duration: "duration", dt: "dt",
            initial: [(node: "m", dof: Ux, displacement: "u0")],
        ),
    },
    outputs: { "u": Displacement(node: "m", dof: Ux) },
)"#;

pub(super) fn cases() -> Vec<Case> {
    vec![sl1(), sl2(), without_friction()]
}

fn sl1() -> Case {
    let turn = |n: u32| {
        let size = 8.5e-4 - 2.0 * f64::from(n) * 1e-4;
        let t = f64::from(n) * PI / 100.0;
        let reference = if n.is_multiple_of(2) { size } else { -size };
        let tolerance = if n == 4 { 1e-2 } else { 1e-3 };
        Check::new(format!("u at turning point {n}"), METRE, reference, tolerance, move |r| {
            r.at("u", t)
        })
        .published()
    };
    let mut checks: Vec<Check> = (1..=4).map(turn).collect();
    checks.push(Check::new("u at rest", METRE, 5e-5, 1e-2, |r| r.last("u")));
    Case {
        id: "SL-1",
        title: "Free vibration with Coulomb friction",
        source: "Code_Aster SDND100",
        text: FREE.into(),
        set: Vec::new(),
        solvers: BOTH,
        view: crate::View::default(),
        checks,
    }
}

fn sl2() -> Case {
    let at = |t: f64, reference: f64| {
        Check::new(format!("u({t})"), INCH, reference, 2e-3, move |r| r.at("u", t)).published()
    };
    Case {
        id: "SL-2",
        title: "Free vibration with Coulomb friction, US units",
        source: "ANSYS VM73; Tse, Morse, Hinkle, p. 175",
        text: FREE.into(),
        set: vec![
            set("mass", "(10/386)*(1 lbf*s^2/in)"),
            set("k", "30 lbf/in"),
            set("mu", 0.1875),
            set("normal", "10 lbf"),
            set("ks", "1e6 lbf/in"),
            set("u0", "-1 in"),
        ],
        solvers: BOTH,
        view: crate::View::default(),
        checks: vec![at(0.09, 0.87208), at(0.102, 0.83132), at(0.183, -0.74874)],
    }
}

/// Property (e) of the FNA list: no damping is no damping.
fn without_friction() -> Case {
    Case {
        id: "FN-2e",
        title: "Free vibration without friction keeps its amplitude",
        source: "u = u₀ cos ωt; the tolerance is that of an exact rule",
        text: FREE.into(),
        set: vec![
            set("mu", 0),
            set("duration", 100.0 * TAU / 100.0),
            set("dt", TAU / 100.0 / 40.0),
        ],
        solvers: &[crate::Solver::Fna],
        view: crate::View::default(),
        checks: vec![Check::new("u after 100 periods", METRE, 8.5e-4, 1e-10, |r| r.last("u"))],
    }
}
