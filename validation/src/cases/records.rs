//! Earthquakes: cases under the El Centro record of 1940.
//!
//! The record is not part of the project, as nobody has given leave to hand it on. It is read from the
//! folder that `TRILITH_RECORDS` names, or from `../shared/records` beside the project; without it the
//! cases are listed as not run.

use super::isolated::{MD1, md1};
use crate::case::BOTH;
use crate::unit::{INCH, JOULE, METRE, NEWTON, NUMBER, SECOND, Unit};
use crate::{Case, Check, Curve, Item, Outcome, View};
use std::fmt::Write as _;
use std::path::PathBuf;

const FILE: &str = "elcentro_1940_ns.at2";
/// 1559 values, in g, at 0.02 s.
const LENGTH: usize = 1559;

fn folder() -> PathBuf {
    let beside = concat!(env!("CARGO_MANIFEST_DIR"), "/../../shared/records");
    std::env::var_os("TRILITH_RECORDS").map_or_else(|| beside.into(), PathBuf::from)
}

/// The record as points `(time, acceleration in g)` of a table, or why there is none.
fn points() -> Result<String, String> {
    let path = folder().join(FILE);
    let text = std::fs::read_to_string(&path).map_err(|_| {
        format!("record {FILE} not available; TRILITH_RECORDS names the folder it is in")
    })?;
    // Lines of text stand before and after the numbers.
    let numbers = |line: &str| -> Option<Vec<f64>> {
        line.split_whitespace().map(|x| x.parse().ok()).collect()
    };
    let values: Vec<f64> = text
        .lines()
        .skip_while(|l| numbers(l).is_none_or(|n| n.len() < 8))
        .map_while(numbers)
        .flatten()
        .collect();
    let peak = values.iter().fold(0.0_f64, |a, b| a.max(b.abs()));
    if values.len() != LENGTH || (peak - 0.31882).abs() > 1e-9 {
        return Err(format!("{FILE} is another record: {} values, peak {peak} g", values.len()));
    }
    let mut out = String::new();
    for (i, a) in values.iter().enumerate() {
        let _ = write!(out, "({:.2}, {a}), ", 0.02 * i as f64);
    }
    Ok(out)
}

/// Oscillators: name, period, damping ratio, peak displacement (in), peak absolute acceleration (g).
const OSCILLATORS: [(&str, f64, f64, f64, f64); 7] = [
    ("T 0.5 s, 2 %", 0.5, 0.02, 2.6902, 1.1004),
    ("T 1 s, 2 %", 1.0, 0.02, 5.9738, 0.6110),
    ("T 2 s, 2 %", 2.0, 0.02, 7.4745, 0.1910),
    ("T 2 s, 0 %", 2.0, 0.0, 9.9234, 0.2535),
    ("T 2 s, 5 %", 2.0, 0.05, 5.3796, 0.1382),
    ("T 0.5 s, 5 %", 0.5, 0.05, 2.2484, 0.9241),
    ("T 1 s, 5 %", 1.0, 0.05, 4.4543, 0.4583),
];

fn oscillators(points: &str) -> String {
    let [mut nodes, mut supports, mut elements, mut outputs] = [const { String::new() }; 4];
    for (i, (name, period, ratio, ..)) in OSCILLATORS.into_iter().enumerate() {
        let w = std::f64::consts::TAU / period;
        let _ = writeln!(nodes, "        \"{name}\": (0, {i}, 0),");
        let _ = writeln!(supports, "        \"{name}\": (Uy, Uz, Rx, Ry, Rz),");
        let _ = writeln!(
            elements,
            "        \"mass {name}\": Mass(node: \"{name}\", mass: 1),\n        \"spring {name}\": \
             Spring(node: \"{name}\", k2: {}, c2: {}),",
            w * w,
            2.0 * ratio * w
        );
        let _ = writeln!(
            outputs,
            "        \"u, {name}\": Displacement(node: \"{name}\", dof: Ux),\n        \"a, {name}\": \
             Acceleration(node: \"{name}\", dof: Ux, absolute: true),"
        );
    }
    format!(
        r#"(
    title: "Oscillators under El Centro",
    units: (length: "in", force: "lbf", time: "s"),
    nodes: {{
{nodes}    }},
    supports: {{
{supports}    }},
    elements: {{
{elements}    }},
    functions: {{
        "record": Points(points: [{points}], after_end: Zero),
        "El Centro": Scaled(function: "record", factor: 386.4),
    }},
    cases: {{
        "El Centro": Dynamic(
            duration: 31.2, dt: 0.005, step: Adaptive(tolerance: 1e-6),
            base: [(direction: X, function: "El Centro")],
        ),
    }},
    outputs: {{
{outputs}    }},
)"#
    )
}

/// An oscillator of 0.7 s with a damper of the power 0.35: none, alone, or behind a spring.
fn damped(points: &str, damper: &str, axis: Option<&str>) -> String {
    let output = axis.map_or(String::new(), |axis| {
        format!(", \"damper\": LinkForce(link: \"damper\", axis: {axis})")
    });
    format!(
        r#"(
    title: "Oscillator with a nonlinear damper under El Centro",
    nodes: {{ "m": (0, 0, 0), "end": (1, 0, 0), "wall": (2, 0, 0) }},
    supports: {{ "m": (Uy, Uz, Rx, Ry, Rz), "end": (Uy, Uz, Rx, Ry, Rz), "wall": Fixed }},
    parameters: {{ "mass": "100 t" }},
    elements: {{
        "mass": Mass(node: "m", mass: "mass"),
        "spring": Spring(node: "m", k2: "mass*(2*3.141592653589793/(0.7 s))^2"),
{damper}    }},
    functions: {{
        "record": Points(points: [{points}], after_end: Zero),
        "El Centro": Scaled(function: "record", factor: "1 g"),
    }},
    cases: {{
        "El Centro": Dynamic(
            duration: "35 s", dt: "5 ms", base: [(direction: X, function: "El Centro")],
        ),
    }},
    outputs: {{ "u": Displacement(node: "m", dof: Ux){output} }},
)"#
    )
}

const TI4: (&str, &str, &str) = (
    "TI-4",
    "Oscillators under El Centro 1940 NS",
    "Chopra, fig. 6.4.2 (record and oscillators); exact solution of the linear record",
);
const EQ: &str = "Record GM-1; integrated by Runge-Kutta with a step of 5 µs";
const EQS: [(&str, &str); 4] = [
    ("EQ-A0", "Oscillator with a damper of the power 0.35 under El Centro"),
    ("EQ-A1", "The same damper behind a spring under El Centro"),
    ("EQ-A1b", "The same as one Maxwell damper under El Centro"),
    ("EQ-A2", "The oscillator without a damper under El Centro"),
];

fn ti4(points: &str) -> Case {
    let mut checks = Vec::new();
    let mut curves = Vec::new();
    for (i, (name, _, _, u, a)) in OSCILLATORS.into_iter().enumerate() {
        // The references have five digits, and four for the accelerations.
        let output = format!("u, {name}");
        checks.push(Check::new(format!("largest |u|, {name}"), INCH, u, 5e-3, move |r| {
            r.peak(&output, 0.0, 31.2)
        }));
        let output = format!("a, {name}");
        let g = 386.4 * 0.0254;
        checks.push(Check::new(format!("largest |a|/g, {name}"), NUMBER, a, 5e-3, move |r| {
            r.peak(&output, 0.0, 31.2) / g
        }));
        if i == 0 {
            curves.push(Curve::new("u, T 0.5 s, 2 %", INCH));
        }
    }
    Case {
        id: TI4.0,
        title: TI4.1,
        source: TI4.2,
        text: oscillators(points),
        set: Vec::new(),
        solvers: BOTH,
        checks: checks.into_iter().map(Check::other_code).collect(),
        view: View::histories(curves),
    }
}

fn eq(points: &str) -> Vec<Case> {
    let plain = "        \"damper\": Dashpot(node: \"m\", axis: U2, c: 2e5, exponent: 0.35),\n        \
                 \"tie\": EqualDof(nodes: (\"m\", \"end\"), dofs: Ux),\n";
    let behind = "        \"damper\": Dashpot(nodes: (\"end\", \"wall\"), c: 2e5, exponent: 0.35),\n        \
                  \"brace\": Spring(nodes: (\"m\", \"end\"), k1: \"2e7 N/m\"),\n";
    let maxwell = "        \"damper\": MaxwellDamper(node: \"m\", axis: U2, k: 2e7, c: 2e5, exponent: 0.35),\n        \
                   \"tie\": EqualDof(nodes: (\"m\", \"end\"), dofs: Ux),\n";
    let none = "        \"tie\": EqualDof(nodes: (\"m\", \"end\"), dofs: Ux),\n";
    let p = 5e-3;
    let peak = |u: f64| Check::new("largest |u|", METRE, u, p, |r| r.peak("u", 0.0, 35.0));
    let time = |t: f64| {
        Check::new("time of largest |u|", SECOND, t, p, |r| {
            let (a, b) = (r.extreme("u", 1.0, 0.0, 35.0), r.extreme("u", -1.0, 0.0, 35.0));
            if a.1.abs() > b.1.abs() { a.0 } else { b.0 }
        })
    };
    let force = |f: f64| {
        Check::new("largest force of the damper", NEWTON, f, p, |r| r.peak("damper", 0.0, 35.0))
    };
    let energy = |e: f64| Check::new("energy of the damper", JOULE, e, p, |r| r.heat("damper"));
    let all = [
        (
            plain,
            Some("U2"),
            vec![peak(0.031_284_8), time(2.1712), force(136_658.0), energy(44_456.5)],
        ),
        (
            behind,
            Some("U1"),
            vec![peak(0.039_928_8), time(2.1632), force(145_264.0), energy(63_330.9)],
        ),
        (
            maxwell,
            Some("U2"),
            vec![peak(0.039_928_8), time(2.1632), force(145_264.0), energy(63_330.9)],
        ),
        (none, None, vec![peak(0.153_495_5), time(9.2203)]),
    ];
    all.into_iter()
        .zip(EQS)
        .map(|((damper, axis, checks), (id, title))| Case {
            id,
            title,
            source: EQ,
            text: damped(points, damper, axis),
            set: Vec::new(),
            solvers: BOTH,
            checks: checks.into_iter().map(Check::other_code).collect(),
            view: View::histories([Curve::new("u", MILLIMETRE)]),
        })
        .collect()
}

const MILLIMETRE: Unit = Unit { name: "mm", si: 1e-3 };

/// The cases, or what is missing.
pub(super) fn items() -> Vec<Item> {
    match points() {
        Ok(points) => {
            let all = std::iter::once(ti4(&points)).chain(eq(&points)).chain([md1(&points)]);
            all.map(|c| Item::Case(Box::new(c))).collect()
        }
        Err(reason) => {
            let eq = EQS.map(|(id, title)| (id, title, EQ));
            let all = std::iter::once(TI4).chain(eq).chain([MD1]);
            all.map(|(id, title, source)| {
                Item::Missing(Outcome::unavailable(id, title, source, &reason))
            })
            .collect()
        }
    }
}
