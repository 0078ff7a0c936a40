//! P-Δ: axial forces of a static case in the stiffness.

use crate::case::BOTH;
use crate::unit::{HERTZ, METRE};
use crate::{Case, Check, Curve, Solver, View};
use std::f64::consts::PI;
use std::fmt::Write as _;

const MODES: &[Solver] = &[Solver::Modes];

pub(super) fn cases() -> Vec<Case> {
    vec![string(), beam(), pendulum(), column()]
}

/// A straight member along X in `n` parts, held across at both ends and pulled at the far one.
fn member(title: &str, units: &str, properties: &str, length: f64, n: usize, pull: f64) -> String {
    let (mut nodes, mut elements) = (String::new(), String::new());
    for i in 0..=n {
        let x = length * i as f64 / n as f64;
        let _ = write!(nodes, "\"{i}\": ({x}, 0, 0), ");
        if i > 0 {
            let before = i - 1;
            let _ =
                write!(elements, "\"{i}\": Beam(nodes: (\"{before}\", \"{i}\"), use: \"part\"), ");
        }
    }
    format!(
        r#"(
    title: "{title}",
    units: {units},
    plane: XZ,
    nodes: {{ {nodes} }},
    supports: {{ "0": (Ux, Uz), "{n}": Uz }},
    properties: {{ "part": Beam({properties}, mass_matrix: Consistent) }},
    elements: {{ {elements} }},
    p_delta: "pull",
    loads: {{ "pull": [(node: "{n}", dof: Ux, force: {pull})] }},
    cases: {{
        "pull": Static(loads: ["pull"]),
        "modes": Dynamic(duration: 1, dt: 0.1, basis: Complete),
    }},
)"#
    )
}

fn frequencies(references: [f64; 3], tolerance: f64, published: bool) -> Vec<Check> {
    let one = |(i, f): (usize, f64)| {
        let check = Check::new(format!("f{}", i + 1), HERTZ, f, tolerance, move |r| r.omega(i));
        if published { check.published() } else { check }
    };
    references.into_iter().enumerate().map(one).collect()
}

fn string() -> Case {
    Case {
        id: "LM-7",
        title: "String under tension, 20 beams of hardly any bending stiffness",
        source: "CSI Software Verification 1-017; f = n/(2 L) √(T/ρA)",
        text: member(
            "String under tension",
            r#"(length: "in", force: "kip", time: "s")"#,
            "young: 30000, area: 0.00306796, i3: 1e-9, density: 7.324e-7",
            100.0,
            20,
            0.5,
        ),
        set: Vec::new(),
        solvers: MODES,
        view: View::default(),
        checks: frequencies([74.586, 149.172, 223.757], 1e-4, true),
    }
}

fn beam() -> Case {
    Case {
        id: "LM-8",
        title: "Beam under compression",
        source: "Timoshenko; f = π n²/(2 L²) √(EI/ρA) √(1 − P L²/(n² π² EI))",
        text: member(
            "Beam under compression",
            r#"(length: "in", force: "lbf", time: "s")"#,
            "young: 30e6, area: 4, i3: \"4/3\", density: 7.27973e-4",
            80.0,
            20,
            -40000.0,
        ),
        set: Vec::new(),
        solvers: MODES,
        view: View::default(),
        checks: frequencies([17.055, 105.32, 249.39], 1e-4, true),
    }
}

/// A mass on a rigid bar that a rotational spring holds up, pushed by a step.
const PENDULUM: &str = r#"(
    title: "Mass on a bar on a rotational spring",
    plane: XZ,
    gravity: "10 m/s^2",
    parameters: { "mass": "1 t", "height": "4 m", "k": "100 kN*m" },
    nodes: { "base": (0, 0, 0), "top": (0, 0, "height") },
    supports: { "base": (Ux, Uz) },
    elements: {
        "spring": Spring(node: "base", r3: "k"),
        // A million times as stiff as the spring.
        "bar": Beam(nodes: ("base", "top"), young: "1e11 Pa", area: "1 m^2", i3: "4 m^4"),
        "mass": Mass(node: "top", mass: "mass"),
    },
    p_delta: "gravity",
    loads: { "push": [(node: "top", dof: Ux, force: "100 N")] },
    functions: { "step": Constant(1) },
    cases: {
        "gravity": Static(loads: [Gravity]),
        "pushed": Dynamic(
            after: "gravity", duration: "4 s", dt: "10 ms",
            forces: [(load: "push", function: "step")], step: Adaptive(tolerance: 1e-6),
        ),
    },
    outputs: { "u": Displacement(node: "top", dof: Ux) },
)"#;

fn pendulum() -> Case {
    let (m, h, k, force) = (1000.0, 4.0, 1e5, 100.0);
    let stiffness: f64 = (k - m * 10.0 * h) / (h * h);
    let omega = (stiffness / m).sqrt();
    let u = move |t: f64| force / stiffness * (1.0 - (omega * t).cos());
    let peak = PI / omega;
    let mut checks: Vec<_> =
        [0.5 * peak, peak, 1.4].into_iter().map(|t| Check::at("u", METRE, t, u(t), 1e-3)).collect();
    checks.push(Check::new("greatest u", METRE, u(peak), 1e-3, move |r| {
        r.extreme("u", 1.0, 0.0, 4.0).1
    }));
    Case {
        id: "PD-1",
        title: "Weight on a bar on a rotational spring, pushed by a step",
        source: "ω² = (k − m g h)/(m h²)",
        text: PENDULUM.into(),
        set: Vec::new(),
        solvers: BOTH,
        view: View::histories([Curve::new("u", METRE).against(u)]),
        checks,
    }
}

/// A clamped column under its load at the top and a force across, in one part and at rest.
const COLUMN: &str = r#"(
    title: "Column under axial load and a force across",
    plane: XZ,
    parameters: { "ei": "8 MN*m^2", "height": "5 m", "axial": "600 kN", "across": "10 kN" },
    nodes: { "0": (0, 0, 0), "1": (0, 0, "height/4"), "2": (0, 0, "height/2"), "3": (0, 0, "3*height/4"), "4": (0, 0, "height") },
    supports: { "0": Fixed },
    properties: { "part": Beam(young: "200 GPa", area: "1 m^2", i2: "ei/200e9 Pa", i3: "ei/200e9 Pa") },
    elements: {
        "a": Beam(nodes: ("0", "1"), use: "part"), "b": Beam(nodes: ("1", "2"), use: "part"),
        "c": Beam(nodes: ("2", "3"), use: "part"), "d": Beam(nodes: ("3", "4"), use: "part"),
        "mass": Mass(node: "4", mass: "1 t"),
    },
    p_delta: "axial",
    loads: {
        "axial": [(node: "4", dof: Uz, force: "-axial")],
        "across": [(node: "4", dof: Ux, force: "across")],
    },
    cases: {
        "axial": Static(loads: ["axial"]),
        "across": Static(after: "axial", loads: ["across"]),
        "rest": Dynamic(after: "across", duration: "0.5 s", dt: "10 ms", basis: Complete),
    },
    outputs: { "u": Displacement(node: "4", dof: Ux) },
)"#;

fn column() -> Case {
    let (ei, l, p, across): (f64, f64, f64, f64) = (8e6, 5.0, 6e5, 1e4);
    let k = (p / ei).sqrt();
    let u = across / (p * k) * ((k * l).tan() - k * l);
    Case {
        id: "PD-2",
        title: "Clamped column under an axial load and a force across the top",
        source: "Timoshenko & Gere: u = H (tan kL − kL)/(P k), k² = P/EI",
        text: COLUMN.into(),
        set: Vec::new(),
        solvers: BOTH,
        view: View::histories([Curve::new("u", METRE).against(move |_| u)]),
        checks: vec![Check::at("u", METRE, 0.5, u, 1e-3)],
    }
}
