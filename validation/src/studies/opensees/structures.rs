//! Structures that move as a whole: elements, constraints, damping and analyses.

use super::pair::Agree;
use super::theirs::Values;
use crate::studies::runs::{HHT, Method, run_fixed};
use serde_json::{Value, json};
use std::f64::consts::PI;

/// A structure of a few nodes in both programs, and what moves it.
pub(super) struct Structure {
    /// What it is.
    pub name: &'static str,
    /// Nodes, the first having the tag 1 and the name "1".
    pub nodes: Vec<Node>,
    /// Nodes that Trilith has besides.
    pub own: Vec<Node>,
    /// Commands of OpenSees for its elements.
    pub theirs: Vec<Value>,
    /// Entries of `elements`.
    pub ours: String,
    /// Commands for what damps it, after the loads.
    pub damping: Vec<Value>,
    /// Other sections of the model: its damping, its P-Δ.
    pub more: &'static str,
    /// A force that has come to rest before it moves: node, direction, N.
    pub weight: Option<(usize, usize, f64)>,
    pub moved: Moved,
    /// Node and direction of displacements that are compared, each as share of its own largest.
    pub watched: Vec<(usize, usize)>,
    /// Of the method of Hilber, Hughes and Taylor as Trilith has it.
    pub alpha: f64,
    /// How well both must agree.
    pub agree: Agree,
}

/// What moves a structure, in time a Ricker wavelet.
pub(super) enum Moved {
    /// A force: node, components in N.
    Pushed(usize, [f64; 3]),
    /// Displacements of supports: node, direction, m.
    Led(Vec<(usize, usize, f64)>),
    /// The ground, along X and Y, m/s².
    Shaken([f64; 2]),
}

/// A point, what is fixed there, and its mass.
#[derive(Clone, Copy)]
pub(super) struct Node {
    pub at: [f64; 3],
    pub fixed: [bool; 6],
    pub mass: f64,
}

/// s.
const DURATION: f64 = 2.0;
/// Steps of both.
const STEPS: usize = 2000;
/// Displacements are compared at so many times; the steps are a multiple.
const KEPT: usize = 1000;
/// The wavelet: Hz, and s of its peak, so that it begins with nothing.
const FREQUENCY: f64 = 4.0;
const CENTER: f64 = 0.5;
const NAMES: [&str; 6] = ["Ux", "Uy", "Uz", "Rx", "Ry", "Rz"];
/// Square of the radius of gyration of masses, m².
const GYRATION: f64 = 0.09;

/// The wavelet, its rate and the rate of that.
fn wavelet(t: f64) -> [f64; 3] {
    let w = PI * FREQUENCY;
    let s = w * (t - CENTER);
    let e = (-s * s).exp();
    [
        (1.0 - 2.0 * s * s) * e,
        w * (4.0 * s.powi(3) - 6.0 * s) * e,
        w * w * (24.0 * s * s - 8.0 * s.powi(4) - 6.0) * e,
    ]
}

impl Node {
    pub fn free(at: [f64; 3], mass: f64) -> Self {
        Self { at, fixed: [false; 6], mass }
    }

    pub fn clamped(at: [f64; 3]) -> Self {
        Self { at, fixed: [true; 6], mass: 0.0 }
    }

    /// Free in these directions only.
    pub fn only(at: [f64; 3], mass: f64, free: &[usize]) -> Self {
        let mut fixed = [true; 6];
        free.iter().for_each(|i| fixed[i - 1] = false);
        Self { at, fixed, mass }
    }
}

impl Structure {
    /// Pushed askew at a node, and its motion compared in all directions there.
    pub fn new(name: &'static str, nodes: Vec<Node>, theirs: Vec<Value>, ours: &str) -> Self {
        Self {
            name,
            nodes,
            own: Vec::new(),
            theirs,
            ours: ours.to_owned(),
            damping: Vec::new(),
            more: "",
            weight: None,
            moved: Moved::Pushed(2, [3e4, 2e4, 1e4]),
            watched: (1..=6).map(|i| (2, i)).collect(),
            alpha: 0.0,
            agree: Agree::Same,
        }
    }

    /// The task for OpenSees.
    pub fn task(&self) -> Value {
        let mut commands = Vec::new();
        for (i, node) in self.nodes.iter().enumerate() {
            let tag = i + 1;
            let [x, y, z] = node.at;
            commands.push(json!(["node", tag, x, y, z]));
            let [a, b, c, d, e, f] = node.fixed.map(u8::from);
            if node.fixed != [false; 6] {
                commands.push(json!(["fix", tag, a, b, c, d, e, f]));
            }
            let (m, j) = (node.mass, GYRATION * node.mass);
            if m > 0.0 {
                commands.push(json!(["mass", tag, m, m, m, j, j, j]));
            }
        }
        commands.extend(self.theirs.iter().cloned());
        let weight: Vec<Value> =
            self.weight.iter().map(|(node, i, force)| loaded(*node, *i, *force)).collect();
        let mut motion = self.moved.commands();
        motion.extend(self.damping.iter().cloned());
        let rule = match self.alpha {
            0.0 => json!(["Newmark", 0.5, 0.25]),
            alpha => json!(["HHT", 1.0 + alpha]),
        };
        let dt = DURATION / STEPS as f64;
        let waves: Vec<Vec<f64>> = self.moved.waves();
        json!({
            "what": "structure", "commands": commands, "weight": weight, "waves": waves, "motion": motion,
            "rule": rule, "dt": dt, "steps": STEPS, "every": STEPS / KEPT, "watched": self.watched,
        })
    }

    /// Displacements, a list for each time that is kept.
    pub fn displacements(&self) -> Values {
        let method = Method { alpha: self.alpha, ..HHT };
        let trace = run_fixed(&self.text(), method, STEPS / KEPT)?;
        let at = |i: usize| {
            let t = DURATION * i as f64 / KEPT as f64;
            self.watched.iter().map(|w| trace.at(&output(*w), t)).collect()
        };
        Ok((1..=KEPT).map(at).collect())
    }

    fn text(&self) -> String {
        let (mut nodes, mut supports, mut masses) = (String::new(), String::new(), String::new());
        for (i, node) in self.nodes.iter().chain(&self.own).enumerate() {
            let name = i + 1;
            let [x, y, z] = node.at;
            nodes += &format!(r#""{name}": ({x}, {y}, {z}), "#);
            let fixed: Vec<&str> =
                NAMES.iter().zip(node.fixed).filter(|(_, fixed)| *fixed).map(|(n, _)| *n).collect();
            if !fixed.is_empty() {
                supports += &format!(r#""{name}": ({}), "#, fixed.join(", "));
            }
            let (m, j) = (node.mass, GYRATION * node.mass);
            if m > 0.0 {
                masses += &format!(
                    r#""mass {name}": Mass(node: "{name}", mass: {m}, inertia: ({j}, {j}, {j})), "#
                );
            }
        }
        let outputs: String = self
            .watched
            .iter()
            .map(|(node, i)| {
                let (name, dof) = (output((*node, *i)), NAMES[i - 1]);
                format!(r#""{name}": Displacement(node: "{node}", dof: {dof}), "#)
            })
            .collect();
        let (amplitude, push, moved) = self.moved.sections();
        let (mut weight, mut case, mut after) = (String::new(), "", "");
        if let Some((node, i, force)) = self.weight {
            let dof = NAMES[i - 1];
            weight = format!(r#""weight": [(node: "{node}", dof: {dof}, force: {force})],"#);
            case = r#""weight": Static(loads: ["weight"]),"#;
            after = r#"after: "weight","#;
        }
        let (ours, more) = (&self.ours, self.more);
        format!(
            r#"(
    nodes: {{ {nodes} }},
    supports: {{ {supports} }},
    elements: {{ {masses} {ours} }},
    {more}
    loads: {{ {weight} {push} }},
    functions: {{ "wave": Ricker(amplitude: "{amplitude}", frequency: {FREQUENCY}, center: {CENTER}) }},
    cases: {{ {case} "moved": Dynamic({after} duration: {DURATION}, dt: {}, {moved}) }},
    outputs: {{ {outputs} }},
)"#,
            DURATION / KEPT as f64,
        )
    }
}

/// A force at a node of OpenSees in one direction.
fn loaded(node: usize, direction: usize, force: f64) -> Value {
    let mut forces = [0.0; 6];
    forces[direction - 1] = force;
    let [a, b, c, d, e, f] = forces;
    json!(["load", node, a, b, c, d, e, f])
}

/// Name of the output of a direction of a node.
fn output((node, direction): (usize, usize)) -> String {
    format!("{node} {}", NAMES[direction - 1])
}

impl Moved {
    /// Values of the time series of OpenSees, with tags from 1.
    fn waves(&self) -> Vec<Vec<f64>> {
        let wave = |i: usize, scale: f64| -> Vec<f64> {
            (0..=STEPS).map(|s| scale * wavelet(DURATION * s as f64 / STEPS as f64)[i]).collect()
        };
        match self {
            Self::Led(all) => {
                all.iter().flat_map(|(_, _, a)| (0..3).map(|i| wave(i, *a))).collect()
            }
            Self::Pushed(..) | Self::Shaken(_) => vec![wave(0, 1.0)],
        }
    }

    fn commands(&self) -> Vec<Value> {
        match self {
            Self::Pushed(node, [x, y, z]) => {
                vec![
                    json!(["pattern", "Plain", 1, 1]),
                    json!(["load", node, x, y, z, 0.0, 0.0, 0.0]),
                ]
            }
            Self::Led(all) => {
                let mut commands = vec![json!(["pattern", "MultipleSupport", 1])];
                for (i, (node, direction, _)) in all.iter().enumerate() {
                    let (tag, d) = (i + 1, 3 * i + 1);
                    let (v, a) = (d + 1, d + 2);
                    commands.push(json!([
                        "groundMotion",
                        tag,
                        "Plain",
                        "-disp",
                        d,
                        "-vel",
                        v,
                        "-accel",
                        a
                    ]));
                    commands.push(json!(["imposedMotion", node, direction, tag]));
                }
                commands
            }
            Self::Shaken(along) => {
                let one = |(i, a): (usize, &f64)| {
                    json!(["pattern", "UniformExcitation", i + 1, i + 1, "-accel", 1, "-fact", a])
                };
                along.iter().enumerate().map(one).collect()
            }
        }
    }

    /// Amplitude of the wavelet, an entry of `loads`, and what the case says.
    fn sections(&self) -> (&'static str, String, String) {
        match self {
            Self::Pushed(node, forces) => {
                let one = |(dof, force): (&&str, &f64)| {
                    format!(r#"(node: "{node}", dof: {dof}, force: {force})"#)
                };
                let all: Vec<_> = NAMES.iter().zip(forces).map(one).collect();
                let push = format!(r#""push": [{}]"#, all.join(", "));
                ("1", push, r#"forces: [(load: "push", function: "wave")]"#.into())
            }
            Self::Led(all) => {
                let one = |(node, i, factor): &(usize, usize, f64)| {
                    let dof = NAMES[i - 1];
                    format!(
                        r#"(node: "{node}", dof: {dof}, displacement: "wave", factor: {factor})"#
                    )
                };
                let all: Vec<_> = all.iter().map(one).collect();
                ("1 m", String::new(), format!("supports: [{}]", all.join(", ")))
            }
            Self::Shaken([x, y]) => {
                let base = format!(
                    r#"base: [(direction: X, function: "wave", factor: {x}), (direction: Y, function: "wave", factor: {y})]"#
                );
                ("1 m/s^2", String::new(), base)
            }
        }
    }
}
