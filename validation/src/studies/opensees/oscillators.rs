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
    /// Steps in a millisecond.
    finer: usize,
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

pub(super) fn oscillators() -> [Oscillator; 4] {
    let led = json!(["element", "zeroLength", 1, 1, 2, "-mat", 1, "-dir", 1]);
    let spring = vec![material("Elastic", &[4e5, 3e3]), led.clone()];
    let mut inerter = spring.clone();
    inerter.push(json!(["element", "inerter", 2, 1, 2, "-dir", 1, "-inertance", 1500.0]));
    [
        Oscillator {
            name: "Elastic with eta, a mass on it",
            commands: spring,
            ours: r#""spring": Spring(node: "m", k2: 4e5, c2: 3e3)"#,
            finer: 1,
            agree: Agree::Equal,
        },
        Oscillator {
            name: "inerter beside it, a mass on both",
            commands: inerter,
            ours: r#""spring": Spring(node: "m", k2: 4e5, c2: 3e3), "inerter": Inerter(node: "m", axis: U2, b: 1500)"#,
            finer: 1,
            agree: Agree::Equal,
        },
        rebound(
            "ImpactMaterial and ImpactKelvin, a mass thrown back",
            r#""stop": ImpactKelvin(node: "m", axis1: (-1, 0, 0), opening: 0.5, k: 6.71e5, restitution: 0.7687061147858074, impact_mass: 1000)"#,
        ),
        rebound(
            "ImpactMaterial and ImpactHertz, a mass thrown back",
            r#""stop": ImpactHertz(node: "m", axis1: (-1, 0, 0), opening: 0.5, k: 3.19e6, restitution: 0.7687061147858074)"#,
        ),
    ]
}

/// The two lines of OpenSees, made for the speed at which the mass comes, beside a contact of the same restitution.
fn rebound(name: &'static str, ours: &'static str) -> Oscillator {
    // Ours are as long in contact. There paths are apart by a tenth of 5 cm at most, and the mass comes back over 1.2 m.
    // Of ½ 1000 kg (1.5 m/s)² = 0.88 · k2 (5 cm)² the lines lose 0.36 · k2 (5 cm)²: e² = 1 − 0.36/0.88.
    let k2 = 1125.0 / (0.88 * 0.0025);
    let numbers = [5.0 * k2, k2, -0.005, -0.5];
    Oscillator {
        name,
        commands: vec![
            material("ImpactMaterial", &numbers),
            json!(["element", "zeroLength", 1, 2, 1, "-mat", 1, "-dir", 1]),
        ],
        ours,
        finer: 20,
        agree: Agree::Near(
            0.004,
            "the path in contact differs, and the restitution at another speed",
        ),
    }
}

impl Oscillator {
    /// The task for OpenSees.
    pub fn task(&self) -> Value {
        json!({
            "what": "displacement", "commands": self.commands, "mass": MASS, "dt": DT / self.finer as f64,
            "every": self.finer,
            "p": (0..=STEPS * self.finer).map(|i| force(i as f64 / self.finer as f64)).collect::<Vec<_>>(),
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
        let trace = run_fixed(&text, HHT, self.finer)?;
        Ok((1..=STEPS).map(|i| vec![trace.at("u", i as f64 * DT)]).collect())
    }
}

/// Force at the end of a step, which may be one within.
fn force(step: f64) -> f64 {
    let line = FORCE.windows(2).find(|w| (w[0].0 as f64..=w[1].0 as f64).contains(&step));
    line.map_or(0.0, |w| {
        let ((i, p), (j, q)) = (w[0], w[1]);
        p + (q - p) * (step - i as f64) / (j - i) as f64
    })
}
