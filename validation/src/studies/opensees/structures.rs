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
    nodes: Vec<Node>,
    /// Nodes that Trilith has besides.
    own: Vec<Node>,
    /// Commands of OpenSees for its elements.
    theirs: Vec<Value>,
    /// Entries of `elements`.
    ours: String,
    /// Commands for what damps it, after the loads.
    damping: Vec<Value>,
    /// Other sections of the model: its damping, its P-Δ.
    more: &'static str,
    /// A force that has come to rest before it moves: node, direction, N.
    weight: Option<(usize, usize, f64)>,
    moved: Moved,
    /// Node and direction of displacements that are compared, each as share of its own largest.
    watched: Vec<(usize, usize)>,
    /// Of the method of Hilber, Hughes and Taylor as Trilith has it.
    alpha: f64,
    /// How well both must agree.
    pub agree: Agree,
}

/// What moves a structure, in time a Ricker wavelet.
enum Moved {
    /// A force: node, components in N.
    Pushed(usize, [f64; 3]),
    /// Displacements of supports: node, direction, m.
    Led(Vec<(usize, usize, f64)>),
    /// The ground, along X and Y, m/s².
    Shaken([f64; 2]),
}
use Moved::{Led, Pushed, Shaken};

/// A point, what is fixed there, and its mass.
#[derive(Clone, Copy)]
struct Node {
    at: [f64; 3],
    fixed: [bool; 6],
    mass: f64,
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
/// Radius of gyration of masses, m².
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
    fn free(at: [f64; 3], mass: f64) -> Self {
        Self { at, fixed: [false; 6], mass }
    }

    fn clamped(at: [f64; 3]) -> Self {
        Self { at, fixed: [true; 6], mass: 0.0 }
    }

    /// Free in these directions only.
    fn only(at: [f64; 3], mass: f64, free: &[usize]) -> Self {
        let mut fixed = [true; 6];
        free.iter().for_each(|i| fixed[i - 1] = false);
        Self { at, fixed, mass }
    }
}

impl Structure {
    /// Pushed askew at a node, and its motion compared in all directions there.
    fn new(name: &'static str, nodes: Vec<Node>, theirs: Vec<Value>, ours: &str) -> Self {
        Self {
            name,
            nodes,
            own: Vec::new(),
            theirs,
            ours: ours.to_owned(),
            damping: Vec::new(),
            more: "",
            weight: None,
            moved: Pushed(2, [3e4, 2e4, 1e4]),
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

/// Columns of a portal and the beam on them, of nodes 1 to 4.
fn portal() -> Vec<Node> {
    vec![
        Node::clamped([0.0; 3]),
        Node::free([0.0, 0.0, 3.0], 2000.0),
        Node::free([4.0, 0.0, 3.0], 3000.0),
        Node::clamped([4.0, 0.0, 0.0]),
    ]
}

/// An elastic member of OpenSees along Z or X, with local axes as Trilith chooses them.
fn member(tag: u8, nodes: [u8; 2], upright: bool, offsets: Option<[f64; 6]>) -> Vec<Value> {
    let [i, j] = nodes;
    let across = if upright { [0.0, 1.0, 0.0] } else { [0.0, -1.0, 0.0] };
    let mut axes = vec![json!("geomTransf"), json!("Linear"), json!(tag)];
    axes.extend(across.map(|x| json!(x)));
    if let Some(offsets) = offsets {
        axes.push(json!("-jntOffset"));
        axes.extend(offsets.map(|x| json!(x)));
    }
    let beam = json!(["elasticBeamColumn", tag, i, j, 0.01, 200e9, 80e9, 2e-4, 5e-5, 1e-4, tag]);
    let mut element = vec![json!("element")];
    element.extend(beam.as_array().into_iter().flatten().cloned());
    vec![axes.into(), element.into()]
}

/// The same in Trilith, with what it has of its own.
fn beam(name: &str, [i, j]: [&str; 2], own: &str) -> String {
    format!(
        r#""{name}": Beam(nodes: ("{i}", "{j}"), young: 200e9, shear_modulus: 80e9, area: 0.01, i2: 5e-5, i3: 1e-4, torsion: 2e-4, {own}), "#
    )
}

/// Both columns and the beam, which takes these options as well.
fn members(options: &[Value]) -> Vec<Value> {
    let mut all = member(1, [1, 2], true, None);
    all.extend(member(2, [4, 3], true, None));
    all.extend(member(3, [2, 3], false, None));
    if let Some(Value::Array(last)) = all.last_mut() {
        last.extend(options.iter().cloned());
    }
    all
}

fn beams(own: &str) -> String {
    [beam("a", ["1", "2"], ""), beam("b", ["4", "3"], ""), beam("c", ["2", "3"], own)].concat()
}

fn frames() -> Vec<Structure> {
    let frame = |name, options: &[Value], own: &str| {
        Structure::new(name, portal(), members(options), &beams(own))
    };
    let one = [json!("-releasez"), json!(1)];
    let more = [json!("-releasez"), json!(3), json!("-releasey"), json!(2)];
    let mut with_shear = members(&[]);
    for command in &mut with_shear {
        let Value::Array(words) = command else { continue };
        if words[1] == "elasticBeamColumn" {
            let head = [json!("element"), json!("ElasticTimoshenkoBeam")];
            let nodes = words[2..5].to_vec();
            let numbers = [200e9, 80e9, 0.01, 2e-4, 5e-5, 1e-4, 6e-3, 4e-3].map(|x| json!(x));
            let axes = words[words.len() - 1].clone();
            *words = [&head[..], &nodes, &numbers, &[axes]].concat();
        }
    }
    let own = "shear_area_2: 6e-3, shear_area_3: 4e-3";
    let shear =
        [beam("a", ["1", "2"], own), beam("b", ["4", "3"], own), beam("c", ["2", "3"], own)];
    // Rigid lengths along the columns, of other sizes at both ends.
    let along = Some([0.0, 0.0, 0.2, 0.0, 0.0, -0.35]);
    let mut offset = member(1, [1, 2], true, along);
    offset.extend(member(2, [4, 3], true, along));
    offset.extend(member(3, [2, 3], false, Some([0.15, 0.0, 0.0, -0.3, 0.0, 0.0])));
    let rigid = "offset_i: 0.2, offset_j: 0.35";
    let columns = [beam("a", ["1", "2"], rigid), beam("b", ["4", "3"], rigid)].concat();
    let offset_beams = columns + &beam("c", ["2", "3"], "offset_i: 0.15, offset_j: 0.3");
    // A beam above the nodes of its columns.
    let mut across = member(1, [1, 2], true, None);
    across.extend(member(2, [4, 3], true, None));
    across.extend(member(3, [2, 3], false, Some([0.1, 0.2, 0.3, -0.1, 0.2, 0.3])));
    let arms = r#""e": RigidLink(nodes: ("2", "5")), "f": RigidLink(nodes: ("3", "6")), "#;
    let above = [beam("a", ["1", "2"], ""), beam("b", ["4", "3"], "")].concat();
    let above = above + &beam("c", ["5", "6"], "") + arms;
    let above = Structure {
        own: [[0.1, 0.2, 3.3], [3.9, 0.2, 3.3]].map(|at| Node::free(at, 0.0)).into(),
        ..Structure::new("-jntOffset across", portal(), across, &above)
    };
    let hht = Structure { alpha: -0.1, ..frame("HHT 0.9, a portal", &[], "") };
    let shaken = frame("UniformExcitation, a portal", &[], "");
    vec![
        frame("elasticBeamColumn, a portal", &[], ""),
        Structure::new("ElasticTimoshenkoBeam, a portal", portal(), with_shear, &shear.concat()),
        frame("-releasez 1", &one, "release_i: (R3)"),
        frame("-releasez 3 -releasey 2", &more, "release_i: (R3), release_j: (R2, R3)"),
        Structure::new("-jntOffset along the axis", portal(), offset, &offset_beams),
        above,
        hht,
        Structure { moved: Shaken([2.0, -1.5]), ..shaken },
        Structure {
            moved: Led(vec![(1, 1, 0.01), (4, 1, -0.006), (4, 3, 0.004), (1, 2, 0.002)]),
            ..frame("MultipleSupport, a portal", &[], "")
        },
    ]
}

/// Damping of structures.
fn damped() -> Vec<Structure> {
    let frame = |name| Structure::new(name, portal(), members(&[]), &beams(""));
    let rayleigh = r#"damping: Rayleigh(mass: 0.8, stiffness: 1e-3),"#;
    let c = json!(["rayleigh", 0.8, 0.0, 1e-3, 0.0]);
    let modes = vec![json!(["eigen", "-fullGenLapack", 12]), json!(["modalDamping", 0.04])];
    let moved = vec![(1, 1, 0.01), (4, 1, -0.006), (4, 3, 0.004), (1, 2, 0.002)];
    // Three bars that hold a mass.
    let feet = [[2.0, 0.0, 0.0], [-1.0, 1.5, 0.0], [-1.0, -1.5, 0.0]];
    let tripod = || -> Vec<Node> {
        let mut nodes =
            vec![Node::clamped([0.0; 3]), Node::only([0.0, 0.0, 2.0], 2000.0, &[1, 2, 3])];
        nodes.extend(feet.map(Node::clamped));
        nodes
    };
    let bars = |option: u8| -> Vec<Value> {
        let mut all = vec![json!(["uniaxialMaterial", "Elastic", 1, 2e8])];
        for foot in 3..6_u8 {
            all.push(json!(["element", "truss", foot, foot, 2, 0.01, 1, "-doRayleigh", option]));
        }
        all
    };
    let trusses: String = (3..6)
        .map(|foot| format!(r#""{foot}": Truss(nodes: ("{foot}", "2"), young: 2e8, area: 0.01), "#))
        .collect();
    let links: String = feet
        .iter()
        .enumerate()
        .map(|(i, foot)| {
            let length = foot.iter().zip([0.0, 0.0, 2.0]).map(|(a, b)| (a - b) * (a - b)).sum::<f64>().sqrt();
            let (name, k) = (i + 3, 2e6 / length);
            let nothing = ["[0, 0, 0, 0, 0, 0]"; 5].join(", ");
            format!(
                r#""{name}": LinearLink(nodes: ("{name}", "2"), stiffness: [[{k}, 0, 0, 0, 0, 0], {nothing}]), "#
            )
        })
        .collect();
    let watched = || (1..=3).map(|i| (2, i)).collect();
    let truss = |name, option, ours: &str| Structure {
        damping: vec![c.clone()],
        more: rayleigh,
        watched: watched(),
        ..Structure::new(name, tripod(), bars(option), ours)
    };
    vec![
        Structure {
            damping: vec![c.clone()],
            more: rayleigh,
            ..frame("rayleigh with betaKinit, a portal")
        },
        // The share of the mass acts on absolute velocities there, on those against the supports here.
        Structure {
            damping: vec![json!(["rayleigh", 0.0, 0.0, 1e-3, 0.0])],
            more: "damping: Rayleigh(stiffness: 1e-3),",
            moved: Led(moved),
            ..frame("rayleigh with betaKinit alone, MultipleSupport")
        },
        Structure {
            damping: modes,
            more: "damping: Modal(ratio: 0.04),",
            ..frame("modalDamping, a portal")
        },
        truss("truss -doRayleigh 1, three bars", 1, &trusses),
        truss("truss -doRayleigh 0 and LinearLink, three bars", 0, &links),
    ]
}

/// Nodes that follow others.
fn constrained() -> Vec<Structure> {
    let post = || {
        vec![
            Node::clamped([0.0; 3]),
            Node::free([0.0, 0.0, 3.0], 2000.0),
            Node::free([0.8, 0.5, 3.4], 1500.0),
        ]
    };
    let one = |last: Value| {
        let mut all = member(1, [1, 2], true, None);
        all.push(last);
        all
    };
    let column = beam("a", ["1", "2"], "");
    let arm = column.clone() + r#""arm": RigidLink(nodes: ("2", "3"))"#;
    // Translations only: a post of its own holds the second node against turning.
    let mut hinged = post();
    hinged.push(Node::clamped([0.8, 0.5, 0.4]));
    let mut theirs = one(json!(["rigidLink", "bar", 2, 3]));
    theirs.extend(member(2, [4, 3], true, None));
    let bar = column.clone()
        + &beam("b", ["4", "3"], "")
        + r#""bar": EqualDof(nodes: ("2", "3"), dofs: (Ux, Uy, Uz))"#;
    let watched = || (2..=3).flat_map(|n| (1..=6).map(move |i| (n, i))).collect();
    // Nothing turns about the posts.
    let bar = Structure {
        watched: (2..=3).flat_map(|n| (1..=5).map(move |i| (n, i))).collect(),
        ..Structure::new("rigidLink bar", hinged, theirs, &bar)
    };
    // A floor on four columns, led by a node that nothing else holds.
    let corners = [[-2.0, -1.0], [2.0, -1.0], [2.0, 1.5], [-2.0, 1.5]];
    let mut floor = vec![Node::clamped([0.0; 3]), Node::only([0.3, 0.2, 3.0], 4000.0, &[1, 2, 6])];
    floor.extend(corners.map(|[x, y]| Node::free([x, y, 3.0], 500.0)));
    floor.extend(corners.map(|[x, y]| Node::clamped([x, y, 0.0])));
    let mut theirs: Vec<Value> = (3..7).flat_map(|i| member(i, [i + 4, i], true, None)).collect();
    theirs.push(json!(["rigidDiaphragm", 3, 2, 3, 4, 5, 6]));
    let mut ours: String = (3..7)
        .map(|i: u8| beam(&format!("{i}"), [&format!("{}", i + 4), &format!("{i}")], ""))
        .collect();
    ours += r#""floor": Diaphragm(nodes: ("2", "3", "4", "5", "6"))"#;
    let mut of_floor: Vec<_> = [1, 2, 6].map(|i| (2, i)).into();
    of_floor.extend((1..=6).map(|i| (4, i)));
    let diaphragm = Structure {
        watched: of_floor,
        moved: Pushed(4, [3e4, 2e4, 1e4]),
        ..Structure::new("rigidDiaphragm, four columns", floor, theirs, &ours)
    };
    let mut equal = member(1, [1, 2], true, None);
    equal.extend(member(2, [4, 3], true, None));
    equal.push(json!(["equalDOF", 2, 3, 1, 2]));
    let two = [beam("a", ["1", "2"], ""), beam("b", ["4", "3"], "")].concat()
        + r#""tie": EqualDof(nodes: ("2", "3"), dofs: (Ux, Uy))"#;
    vec![
        Structure {
            watched: watched(),
            ..Structure::new(
                "rigidLink beam",
                post(),
                one(json!(["rigidLink", "beam", 2, 3])),
                &arm,
            )
        },
        bar,
        diaphragm,
        Structure {
            watched: vec![(2, 1), (2, 2), (2, 3), (2, 4), (2, 5), (3, 1), (3, 2), (3, 4), (3, 5)],
            ..Structure::new("equalDOF", portal(), equal, &two)
        },
    ]
}

/// Stiffness of a long link along and about its axes, N/m and N·m.
const LONG: [f64; 6] = [5e7, 2e6, 3e6, 4e5, 6e5, 8e5];
/// Its length, m.
const LENGTH: f64 = 0.8;

/// A long link in both programs, with these options each.
fn long(options: &[Value], own: &str) -> (Vec<Value>, String) {
    let material = |(i, k)| json!(["uniaxialMaterial", "Elastic", i, k]);
    let mut theirs: Vec<Value> = (1..=6).zip(LONG).map(material).collect();
    let mut element = vec![json!("element"), json!("twoNodeLink"), json!(1), json!(1), json!(2)];
    for option in ["-mat", "-dir"] {
        element.push(json!(option));
        element.extend((1..=6).map(|i| json!(i)));
    }
    element.push(json!("-orient"));
    element.extend([0.0, 0.0, 1.0, 1.0, 0.0, 0.0].map(|x| json!(x)));
    element.extend(options.iter().cloned());
    theirs.push(element.into());
    let row = |(i, k): (usize, &f64)| {
        let mut row = [0.0; 6];
        row[i] = *k;
        format!("{row:?}")
    };
    let rows: Vec<String> = LONG.iter().enumerate().map(row).collect();
    let ours = format!(
        r#""link": LinearLink(nodes: ("1", "2"), axis1: (0, 0, 1), axis2: (1, 0, 0), {own} stiffness: [{}])"#,
        rows.join(", ")
    );
    (theirs, ours)
}

/// An option of a long link, with numbers.
fn option(name: &str, numbers: &[f64]) -> Vec<Value> {
    [json!(name)].into_iter().chain(numbers.iter().map(|x| json!(x))).collect()
}

/// Links with a length of their own: where their shear acts, and the axial force.
fn leaning() -> Vec<Structure> {
    let top = [0.0, 0.0, LENGTH];
    let mut all = Vec::new();
    // Nothing turns about the axis, nor about the others where the shear has no arm.
    for (name, options, own, turns) in [
        ("twoNodeLink, shear in the middle", vec![], "shear_at: 0.4,", true),
        ("-shearDist 0.25", option("-shearDist", &[0.25, 0.25]), "shear_at: 0.6,", true),
        ("-shearDist 1", option("-shearDist", &[1.0, 1.0]), "", false),
    ] {
        let (theirs, ours) = long(&options, own);
        let nodes = vec![Node::clamped([0.0; 3]), Node::free(top, 2000.0)];
        let watched = (1..=if turns { 5 } else { 3 }).map(|i| (2, i)).collect();
        all.push(Structure { watched, ..Structure::new(name, nodes, theirs, &ours) });
    }
    // Small motions: the axial force of the weight stays as it is, and links do not shorten.
    let weight = Some((2, 3, -3e5));
    let (theirs, ours) = long(&option("-pDelta", &[0.0; 4]), "p_delta_at: (0, 0), shear_at: 0.4,");
    let nodes = vec![Node::clamped([0.0; 3]), Node::only(top, 2000.0, &[1, 2, 3])];
    all.push(Structure {
        weight,
        moved: Pushed(2, [30.0, 20.0, 0.0]),
        watched: vec![(2, 1), (2, 2)],
        agree: Agree::Equal,
        ..Structure::new("-pDelta 0 0, a couple of shears", nodes, theirs, &ours)
    });
    // An end that turns and is led sideways, where the shear has no arm and the push of an end that tilts
    // moves nothing.
    let shares = option("-pDelta", &[0.4, 0.6, 0.4, 0.6]);
    for (name, end, arm, own) in [
        ("-pDelta 0.4 0.6, the first end turns", 1, [0.0; 2], "shear_at: 0.8,"),
        ("-pDelta 0.4 0.6, the second end turns", 2, [1.0; 2], ""),
    ] {
        let options = [shares.clone(), option("-shearDist", &arm)].concat();
        let (theirs, ours) = long(&options, &format!("p_delta_at: (0.4, 0.6), {own}"));
        let nodes = if end == 1 {
            vec![Node::only([0.0; 3], 2000.0, &[4, 5]), Node::only(top, 2000.0, &[3])]
        } else {
            vec![Node::clamped([0.0; 3]), Node::only(top, 2000.0, &[3, 4, 5])]
        };
        all.push(Structure {
            weight,
            moved: Led(vec![(end, 1, 1e-4), (end, 2, -6e-5)]),
            watched: vec![(end, 4), (end, 5)],
            agree: Agree::Equal,
            ..Structure::new(name, nodes, theirs, &ours)
        });
    }
    all.push(column());
    all
}

/// Parts of a column.
const PARTS: u8 = 16;

/// A slender column of some parts under nearly half of what it can carry.
fn column() -> Structure {
    let height = 6.0;
    let mut nodes = vec![Node::clamped([0.0; 3])];
    let (mut theirs, mut ours) = (Vec::new(), String::new());
    for part in 1..=PARTS {
        nodes.push(Node::free([0.0, 0.0, height * f64::from(part) / f64::from(PARTS)], 100.0));
        let mut one = member(part, [part, part + 1], true, None);
        if let Some(Value::Array(axes)) = one.first_mut() {
            axes[1] = json!("PDelta");
        }
        theirs.extend(one);
        let [i, j] = [part, part + 1].map(|n| n.to_string());
        ours += &beam(&i, [&i, &j], "");
    }
    let top = usize::from(PARTS) + 1;
    // Half as many parts are apart by 0.031, and the error of a chord is of second order.
    let why = "P acts on the chord of each part there, on its bent axis as well here";
    Structure {
        weight: Some((top, 3, -3e5)),
        moved: Pushed(top, [300.0, 200.0, 0.0]),
        more: r#"p_delta: "weight","#,
        watched: vec![(top, 1), (top, 2)],
        agree: Agree::Near(0.008, why),
        ..Structure::new("geomTransf PDelta, a column", nodes, theirs, &ours)
    }
}

/// A spring that yields and one that does not, one behind the other, under a mass.
fn series() -> Structure {
    let theirs = vec![
        json!(["uniaxialMaterial", "Steel01", 2, 2e4, 4e6, 0.05]),
        json!(["uniaxialMaterial", "Elastic", 3, 2e6]),
        json!(["uniaxialMaterial", "Series", 1, 2, 3]),
        json!(["element", "zeroLength", 1, 1, 2, "-mat", 1, "-dir", 1]),
    ];
    let ours = r#"
        "yields": MultilinearPlastic(nodes: ("1", "3"), axis: U1, axis1: (1, 0, 0), rule: Kinematic,
            deformation: [-1.005, -0.005, 0, 0.005, 1.005], force: [-2.2e5, -2e4, 0, 2e4, 2.2e5]),
        "does not": LinearLink(nodes: ("3", "2"), axis1: (1, 0, 0), stiffness: [
            [2e6, 0, 0, 0, 0, 0], [0, 0, 0, 0, 0, 0], [0, 0, 0, 0, 0, 0],
            [0, 0, 0, 0, 0, 0], [0, 0, 0, 0, 0, 0], [0, 0, 0, 0, 0, 0]]),
    "#;
    let nodes = vec![Node::clamped([0.0; 3]), Node::only([0.0; 3], 2000.0, &[1])];
    Structure {
        own: vec![Node::only([0.0; 3], 0.0, &[1])],
        watched: vec![(2, 1)],
        agree: Agree::Equal,
        ..Structure::new("Series of two, a mass on them", nodes, theirs, ours)
    }
}

pub(super) fn structures() -> Vec<Structure> {
    let mut all = frames();
    all.extend(damped());
    all.extend(constrained());
    all.extend(leaning());
    all.push(series());
    all
}
