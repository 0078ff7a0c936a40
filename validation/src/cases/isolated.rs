//! A building on a Wen isolator under the El Centro record.

use crate::case::BOTH;
use crate::unit::{JOULE, METRE, NEWTON, Unit};
use crate::{Case, Check, Curve, View};

/// Id, title, source.
pub(super) const MD1: (&str, &str, &str) = (
    "MD-1",
    "Three storeys with dampers on a Wen isolator under El Centro",
    "Record GM-1; integrated by Runge-Kutta with a step of 5 µs",
);

fn text(points: &str) -> String {
    format!(
        r#"(
    title: "Isolated building of three storeys under El Centro",
    nodes: {{ "slab": (0, 0, 0), "first": (1, 0, 0), "second": (2, 0, 0), "third": (3, 0, 0) }},
    supports: {{
        "slab": (Uy, Uz, Rx, Ry, Rz), "first": (Uy, Uz, Rx, Ry, Rz),
        "second": (Uy, Uz, Rx, Ry, Rz), "third": (Uy, Uz, Rx, Ry, Rz),
    }},
    properties: {{
        "floor": Mass(mass: "100 t"),
        "damper": Dashpot(c: 4e5, exponent: 0.5),
    }},
    elements: {{
        "mass 1": Mass(node: "slab", use: "floor"),
        "mass 2": Mass(node: "first", use: "floor"),
        "mass 3": Mass(node: "second", use: "floor"),
        "mass 4": Mass(node: "third", use: "floor"),
        "isolator": Wen(node: "slab", axis: U2, k: "80 MN/m", fy: "120 kN", ratio: 0.08),
        "storey 2": Spring(nodes: ("slab", "first"), k1: "180 MN/m"),
        "storey 3": Spring(nodes: ("first", "second"), k1: "150 MN/m"),
        "storey 4": Spring(nodes: ("second", "third"), k1: "120 MN/m"),
        "damper 2": Dashpot(nodes: ("slab", "first"), use: "damper"),
        "damper 3": Dashpot(nodes: ("first", "second"), use: "damper"),
        "damper 4": Dashpot(nodes: ("second", "third"), use: "damper"),
    }},
    functions: {{
        "record": Points(points: [{points}], after_end: Zero),
        "El Centro": Scaled(function: "record", factor: "1 g"),
    }},
    cases: {{
        "El Centro": Dynamic(
            duration: "20 s", dt: "5 ms", base: [(direction: X, function: "El Centro")],
        ),
    }},
    outputs: {{
        "u 1": Displacement(node: "slab", dof: Ux),
        "u 2": Displacement(node: "first", dof: Ux),
        "u 3": Displacement(node: "second", dof: Ux),
        "u 4": Displacement(node: "third", dof: Ux),
        "drift 2": LinkDeformation(link: "damper 2", axis: U1),
        "drift 3": LinkDeformation(link: "damper 3", axis: U1),
        "drift 4": LinkDeformation(link: "damper 4", axis: U1),
        "isolator": LinkForce(link: "isolator", axis: U2),
        "force 2": LinkForce(link: "damper 2", axis: U1),
        "force 3": LinkForce(link: "damper 3", axis: U1),
        "force 4": LinkForce(link: "damper 4", axis: U1),
    }},
)"#
    )
}

const MILLIMETRE: Unit = Unit { name: "mm", si: 1e-3 };

/// The case with the points of the record.
pub(super) fn md1(points: &str) -> Case {
    let p = 5e-3;
    let peak = |output: &'static str, unit, x: f64| {
        Check::new(format!("largest |{output}|"), unit, x, p, move |r| r.peak(output, 0.0, 20.0))
    };
    let heat = |link: &'static str, x: f64| {
        Check::new(format!("energy of {link}"), JOULE, x, p, move |r| r.heat(link))
    };
    let checks = vec![
        peak("u 1", METRE, 0.078_573),
        peak("u 2", METRE, 0.081_076),
        peak("u 3", METRE, 0.083_064),
        peak("u 4", METRE, 0.084_267),
        peak("drift 2", METRE, 0.002_517),
        peak("drift 3", METRE, 0.002_006),
        peak("drift 4", METRE, 0.001_222),
        peak("isolator", NEWTON, 613_265.0),
        peak("force 2", NEWTON, 61_428.0),
        peak("force 3", NEWTON, 56_777.0),
        peak("force 4", NEWTON, 45_771.0),
        heat("damper 2", 2794.0),
        heat("damper 3", 2239.4),
        heat("damper 4", 1051.5),
        Check::new("work on the isolator", JOULE, 129_246.0, p, |r| r.absorbed("isolator")),
    ];
    Case {
        id: MD1.0,
        title: MD1.1,
        source: MD1.2,
        text: text(points),
        set: Vec::new(),
        solvers: BOTH,
        checks: checks.into_iter().map(Check::other_code).collect(),
        view: View::histories([Curve::new("u 1", MILLIMETRE), Curve::new("isolator", NEWTON)]),
    }
}
