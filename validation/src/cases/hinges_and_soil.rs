//! Laws with memories of their own, led through cycles: strength that wears out, a hinge of three forces, soil that keeps a gap.

use crate::case::BOTH;
use crate::unit::{JOULE, METRE, NEWTON, Unit};
use crate::{Case, Check, Curve, View};

/// Largest deformation of the spring and of the pile, m.
const A: f64 = 0.05;

const WORN: &str = r#"(
    title: "Spring whose strength wears out, moved to and fro",
    nodes: { "p": (0, 0, 0), "m": (1, 0, 0) },
    supports: { "p": Fixed, "m": (Uy, Uz, Rx, Ry, Rz) },
    elements: {
        "spring": IbarraMedinaKrawinkler(
            node: "p", axis: U2, k: 6e7, fy: 3e5, capping: 1.1, plastic: 0.08, post_capping: 0.3, lambda_s: 0.5,
        ),
        "mass": Mass(node: "m", mass: 1),
        "beside": Spring(node: "m", k2: 1),
    },
    functions: { "motion": Sine(amplitude: 0.05, frequency: 0.25) },
    cases: {
        "motion": Dynamic(
            duration: 5, dt: 0.01, supports: [(node: "p", dof: Ux, displacement: "motion")],
        ),
    },
    outputs: { "u": Displacement(node: "p", dof: Ux), "force": LinkForce(link: "spring", axis: U2) },
)"#;

const BENT: &str = r#"(
    title: "Hinge under axial force, bent",
    nodes: { "p": (0, 0, 0) },
    supports: { "p": (Ux, Uy, Rx, Ry, Rz) },
    elements: {
        "hinge": PMMHinge(
            node: "p", axial: 2e9, bending2: 4e7, bending3: 1.2e8, py: 4e6, mp2: 2.5e5, mp3: 6e5,
            exponent_p: 1.5, exponent_m3: 1.2,
        ),
        "mass": Mass(node: "p", mass: 1000),
        "damping": Spring(node: "p", c1: 2e6),
    },
    loads: { "press": [(node: "p", dof: Uz, force: -2e6)] },
    functions: { "turn": Sine(amplitude: 0.04, frequency: 0.0625) },
    cases: {
        "press": Static(loads: ["press"]),
        "turn": Dynamic(
            after: "press", duration: 4, dt: 0.01, supports: [(node: "p", dof: Ry, displacement: "turn")],
        ),
    },
    outputs: {
        "P": LinkForce(link: "hinge", axis: U1),
        "M": LinkForce(link: "hinge", axis: R3),
        "u": Displacement(node: "p", dof: Uz),
    },
)"#;

const GAPPED: &str = r#"(
    title: "Pile in soil that keeps a gap, moved to and fro",
    nodes: { "p": (0, 0, 0), "m": (1, 0, 0) },
    supports: { "p": Fixed, "m": (Uy, Uz, Rx, Ry, Rz) },
    elements: {
        "soil": SoilSpring(node: "p", k: 2e7, pu: 1.5e5, backbone: Sand, drag: 1e4),
        "mass": Mass(node: "m", mass: 1),
        "beside": Spring(node: "m", k2: 1),
    },
    functions: { "motion": Sine(amplitude: 0.05, frequency: 0.25) },
    cases: {
        "motion": Dynamic(
            duration: 5, dt: 0.01, supports: [(node: "p", dof: Ux, displacement: "motion")],
        ),
    },
    outputs: { "u": Displacement(node: "p", dof: Ux), "force": LinkForce(link: "soil", axis: U2) },
)"#;

pub(super) fn cases() -> Vec<Case> {
    vec![lk14(), lk15(), lk16()]
}

/// A force at a time.
fn force(what: &str, output: &'static str, unit: Unit, t: f64, value: f64) -> Check {
    Check::new(format!("{what}, t = {t} s"), unit, value, 1e-6, move |r| r.at(output, t))
        .mark(output, t)
}

fn lk14() -> Case {
    let (k, fy, all) = (6e7, 3e5, 0.5 * 3e5);
    let uy = fy / k;
    let slope = 0.1 * fy / 0.08;
    // On the backbone where a share of the strength is left.
    let at = |left: f64, x: f64| left * (fy + slope * (x - left * fy / k));
    let back = |f: f64| 0.5 * f * f / k;
    let first = at(1.0, A);
    let one = 0.5 * fy * uy + 0.5 * (fy + first) * (A - uy) - back(first);
    // The other side, straight to where it would have yielded.
    let left = 1.0 - one / (all - one);
    let (aim, second) = (at(left, uy), at(left, A));
    let zero = A - first / k;
    let two = 0.5 * aim * (uy + zero) + 0.5 * (aim + second) * (A - uy) - back(second);
    // Back, straight to the largest deformation.
    let third = at(1.0 - two / (all - one - two), A);
    let zero = -A + second / k;
    let heat = one + two + 0.5 * third * (A - zero) - back(third);
    Case {
        id: "LK-14",
        title: "Spring whose strength wears out with the energy spent",
        source: "Ibarra, Medina & Krawinkler 2005, by hand",
        text: WORN.into(),
        set: Vec::new(),
        solvers: BOTH,
        checks: vec![
            force("first peak", "force", NEWTON, 1.0, first),
            force("second peak", "force", NEWTON, 3.0, -second),
            force("third peak", "force", NEWTON, 5.0, third),
            Check::new("heat", JOULE, heat, 1e-6, |r| r.heat("spring")),
        ],
        view: View::histories([Curve::new("force", NEWTON)]),
    }
}

fn lk15() -> Case {
    let (p, a, c) = (0.5_f64, 1.5_f64, 1.2_f64);
    let (py, mp) = (4e6, 6e5);
    // The load stays, so that all of the flow is at one point of the surface.
    let m = (1.0 - p.powf(a)).powf(1.0 / c);
    let turned = 0.04 - m * mp / 1.2e8;
    let normal = (a * p.powf(a - 1.0) / py) / (c * m.powf(c - 1.0) / mp);
    let u = -p * py / 2e9 - normal * turned;
    Case {
        id: "LK-15",
        title: "Hinge of axial force and moments bent under its load",
        source: "interaction surface and normality, by hand",
        text: BENT.into(),
        set: Vec::new(),
        solvers: BOTH,
        checks: vec![
            Check::new("moment", NEWTON, m * mp, 1e-3, |r| r.last("M").abs()),
            Check::new("axial force", NEWTON, -p * py, 1e-3, |r| r.last("P")),
            Check::new("shortening", METRE, u, 1e-3, |r| r.last("u")),
        ],
        view: View::histories([Curve::new("M", NEWTON), Curve::new("u", METRE)]),
    }
}

fn lk16() -> Case {
    let (k, pu, pd) = (2e7, 1.5e5, 1e4);
    let top = pu * (k * A / pu).tanh();
    let dent = pu * pu / k * (k * A / pu).cosh().ln() - 0.5 * top * top / k;
    let slip = 5.0 * (A - pd / k);
    Case {
        id: "LK-16",
        title: "Soil that keeps a gap, with drag",
        source: "API RP 2GEO for sand, by hand",
        text: GAPPED.into(),
        set: Vec::new(),
        solvers: BOTH,
        checks: vec![
            force("first peak", "force", NEWTON, 1.0, top + pd),
            force("in the gap", "force", NEWTON, 2.0, -pd),
            force("second peak", "force", NEWTON, 3.0, -top - pd),
            force("in the gap, back", "force", NEWTON, 4.0, pd),
            force("third peak", "force", NEWTON, 5.0, top + pd),
            Check::new("heat", JOULE, 2.0 * dent + pd * slip, 1e-6, |r| r.heat("soil")),
        ],
        view: View::histories([Curve::new("force", NEWTON)]),
    }
}
