//! What acts by itself on a mass: elements of Trilith that are no links.

use super::pair::{Agree, material};
use crate::studies::runs::{HHT, run_fixed};
use serde_json::{Value, json};

/// A mass on an element, under a force that rises and falls.
pub(super) struct Oscillator {
    /// What it is.
    pub name: &'static str,
    /// Commands that make element 1 of OpenSees between the nodes 1 and 2.
    pub commands: Vec<Value>,
    /// Entries of `elements` at the node `m`.
    ours: &'static str,
    /// How well both must agree.
    pub agree: Agree,
}

/// kg.
const MASS: f64 = 1000.0;
/// Step of both, s.
const DT: f64 = 1e-3;
/// Steps.
const STEPS: usize = 2000;
/// The force: time in steps and N, straight between.
const FORCE: [(usize, f64); 4] = [(0, 0.0), (100, 2e4), (250, -1e4), (300, 0.0)];

pub(super) fn oscillators() -> [Oscillator; 2] {
    let led = json!(["element", "zeroLength", 1, 1, 2, "-mat", 1, "-dir", 1]);
    let spring = vec![material("Elastic", &[4e5, 3e3]), led.clone()];
    let mut inerter = spring.clone();
    inerter.push(json!(["element", "inerter", 2, 1, 2, "-dir", 1, "-inertance", 1500.0]));
    [
        Oscillator {
            name: "Elastic with eta, a mass on it",
            commands: spring,
            ours: r#""spring": Spring(node: "m", k2: 4e5, c2: 3e3)"#,
            agree: Agree::Equal,
        },
        Oscillator {
            name: "inerter beside it, a mass on both",
            commands: inerter,
            ours: r#""spring": Spring(node: "m", k2: 4e5, c2: 3e3), "inerter": Inerter(node: "m", axis: U2, b: 1500)"#,
            agree: Agree::Equal,
        },
    ]
}

impl Oscillator {
    /// The task for OpenSees.
    pub fn task(&self) -> Value {
        json!({
            "what": "displacement", "commands": self.commands, "mass": MASS, "dt": DT, "every": 1,
            "p": (0..=STEPS).map(force).collect::<Vec<_>>(),
        })
    }

    /// Displacements, a list for each step.
    pub fn displacements(&self) -> Result<Vec<Vec<f64>>, String> {
        let points: Vec<String> =
            FORCE.iter().map(|(i, p)| format!("({}, {p})", *i as f64 * DT)).collect();
        let text = format!(
            r#"(
    nodes: {{ "m": (0, 0, 0) }},
    supports: {{ "m": (Uy, Uz, Rx, Ry, Rz) }},
    elements: {{ "mass": Mass(node: "m", mass: {MASS}), {} }},
    loads: {{ "push": [(node: "m", dof: Ux, force: 1)] }},
    functions: {{ "push": Points(points: [{}], after_end: Zero) }},
    cases: {{ "pushed": Dynamic(
        duration: {}, dt: {DT}, forces: [(load: "push", function: "push")],
    ) }},
    outputs: {{ "u": Displacement(node: "m", dof: Ux) }},
)"#,
            self.ours,
            points.join(", "),
            STEPS as f64 * DT,
        );
        let trace = run_fixed(&text, HHT, 1)?;
        Ok((1..=STEPS).map(|i| vec![trace.at("u", i as f64 * DT)]).collect())
    }
}

/// Force at the end of a step.
fn force(step: usize) -> f64 {
    let line = FORCE.windows(2).find(|w| (w[0].0..=w[1].0).contains(&step));
    line.map_or(0.0, |w| {
        let ((i, p), (j, q)) = (w[0], w[1]);
        p + (q - p) * (step - i) as f64 / (j - i) as f64
    })
}
