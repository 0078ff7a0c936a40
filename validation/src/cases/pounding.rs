//! Pounding of two bodies: impact elements with a coefficient of restitution.

use crate::case::BOTH;
use crate::unit::SPEED;
use crate::{Case, Check, Curve, View};
use std::fmt::Write as _;

/// Name of the pair, and the element without its nodes and opening.
const PAIRS: [(&str, &str); 6] = [
    ("Kelvin", "ImpactKelvin(k: \"100 MN/m\", restitution: \"e\""),
    ("Kelvin, pulling", "ImpactKelvin(k: \"100 MN/m\", restitution: \"e\", pull: true"),
    ("Kelvin, approach", "ImpactKelvin(k: \"100 MN/m\", restitution: \"e\", damps: Approach"),
    ("Hertz", "ImpactHertz(k: 2e9, restitution: \"e\""),
    ("Hertz, n = 2", "ImpactHertz(k: 5e10, exponent: 2, restitution: \"e\""),
    ("Jankowski", "ImpactHertz(k: 2e9, model: Jankowski, restitution: \"e\""),
];

/// 30 t at 1 m/s against 10 t at rest, once for each element.
fn text() -> String {
    let [mut nodes, mut supports, mut elements, mut initial, mut outputs] =
        [const { String::new() }; 5];
    for (i, (name, element)) in PAIRS.into_iter().enumerate() {
        let (a, b) = (format!("{name} a"), format!("{name} b"));
        let _ = writeln!(nodes, "        \"{a}\": (0, {i}, 0), \"{b}\": (1, {i}, 0),");
        let free = "(Uy, Uz, Rx, Ry, Rz)";
        let _ = writeln!(supports, "        \"{a}\": {free}, \"{b}\": {free},");
        let _ = writeln!(elements, "        \"mass {a}\": Mass(node: \"{a}\", mass: \"30 t\"),");
        let _ = writeln!(elements, "        \"mass {b}\": Mass(node: \"{b}\", mass: \"10 t\"),");
        let _ = writeln!(
            elements,
            "        \"{name}\": {element}, nodes: (\"{a}\", \"{b}\"), opening: \"10 mm\"),"
        );
        let _ = writeln!(initial, "                (node: \"{a}\", dof: Ux, velocity: \"1 m/s\"),");
        for n in [&a, &b] {
            let _ = writeln!(outputs, "        \"{n}\": Velocity(node: \"{n}\", dof: Ux),");
        }
    }
    format!(
        r#"(
    title: "Pounding of two bodies",
    parameters: {{ "e": 0.65 }},
    nodes: {{
{nodes}    }},
    supports: {{
{supports}    }},
    elements: {{
{elements}    }},
    cases: {{
        "impact": Dynamic(
            duration: "0.1 s", dt: "0.1 ms", step: Adaptive(tolerance: 1e-5),
            initial: [
{initial}            ],
        ),
    }},
    outputs: {{
{outputs}    }},
)"#
    )
}

pub(super) fn cases() -> Vec<Case> {
    [("PO-1", 0.65), ("PO-2", 0.3)]
        .map(|(id, e)| {
            let (m1, m2) = (30.0, 10.0);
            let [v1, v2] = [(m1 - m2 * e) / (m1 + m2), m1 * (1.0 + e) / (m1 + m2)];
            let names = [
                ["Kelvin a", "Kelvin b"],
                ["Kelvin, pulling a", "Kelvin, pulling b"],
                ["Kelvin, approach a", "Kelvin, approach b"],
                ["Hertz a", "Hertz b"],
                ["Hertz, n = 2 a", "Hertz, n = 2 b"],
                ["Jankowski a", "Jankowski b"],
            ];
            let check = |name: &'static str, v: f64| {
                Check::new(format!("speed after, {name}"), SPEED, v, 2e-3, move |r| r.last(name))
                    .mark(name, 0.1)
            };
            Case {
                id,
                title: "Two bodies that pound",
                source: "Momentum and restitution: v₁ = (m₁ − m₂ e)/(m₁ + m₂) v, v₂ = m₁ (1 + e)/(m₁ + m₂) v",
                text: text(),
                set: vec![super::set("e", e)],
                solvers: BOTH,
                checks: names.iter().flat_map(|[a, b]| [check(a, v1), check(b, v2)]).collect(),
                view: View::histories(names.iter().flatten().map(|n| Curve::new(n, SPEED))),
            }
        })
        .into()
}
