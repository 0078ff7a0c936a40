//! The zoo: one link of every kind of the registry in one model, under FNA and under HHT.
//!
//! Every link stands between the ground and masses of its own, held by springs; the masses hang on a common
//! frame, so that all of them feel each other. Sizes come from the card: the link is exercised alone, and
//! springs, masses and loads are made from its forces, and adjusted in some rough runs, so that the shaken
//! model deforms it about as far. A new kind is taken up by its registration.

use std::f64::consts::TAU;
use std::fmt::Write;
use trilith::exercise::Specimen;
use trilith_element::{Category, Coordinates, Dof};
use trilith_model::{Model, SolverKind};
use trilith_solvers::Status;
use trilith_tests::{Trace, output, parse, registry, trace};

/// Seed of the sizes.
const SEED: u64 = 2026;
/// Peak of the base acceleration in each direction, m/s².
const SHAKING: f64 = 3.0;
/// Share of the coupling to the frame in the spring of a mass.
const COUPLING: f64 = 0.05;
/// Floors of the frame and height of a storey, m.
const FLOORS: usize = 3;
const STOREY: f64 = 3.0;
/// Young's modulus of the frame, N/m².
const YOUNG: f64 = 2.1e11;
/// Outputs may differ by this share of their peak.
const AGREEMENT: f64 = 0.01;
/// How far a link may be deformed beside its exercise, at least and at most.
const EXERCISED: (f64, f64) = (0.3, 3.0);
/// Rough runs to that end, and their tolerance and that of the last one.
const ROUGH_RUNS: usize = 12;
const TOLERANCE: [f64; 2] = [1e-4, 1e-6];

/// Marsaglia's xorshift64*.
struct Random(u64);

impl Random {
    /// About 1: 0.8 … 1.25.
    fn factor(&mut self) -> f64 {
        self.0 ^= self.0 >> 12;
        self.0 ^= self.0 << 25;
        self.0 ^= self.0 >> 27;
        let bits = self.0.wrapping_mul(0x2545_F491_4F6C_DD1D) >> 11;
        0.8 * (1.25_f64 / 0.8).powf(bits as f64 / (1u64 << 53) as f64)
    }
}

/// A coordinate of a link as a DOF of one of its masses.
struct Place {
    node: String,
    dof: Dof,
    /// Stiffness of the spring to the ground, N/m or N·m/rad.
    spring: f64,
    /// kg or kg·m².
    mass: f64,
    /// Force of the static case and amplitude of the moment that turns it, N or N·m.
    constant: f64,
    turn: f64,
    /// Amplitude of the exercise, m or rad; 0: it is not watched.
    amplitude: f64,
    /// Mean of the exercise, m or rad.
    mean: f64,
}

/// A link with its masses.
struct Animal {
    kind: &'static str,
    link: String,
    entry: String,
    /// Nodes at rest, then the DOFs that move, by coordinate.
    ground: Vec<String>,
    places: Vec<Place>,
}

impl Animal {
    fn new(kind: &'static str, number: usize, random: &mut Random) -> Self {
        let specimen = Specimen::new(&registry(), kind, &[]).unwrap_or_else(|e| panic!("{e}"));
        let motion = specimen.motion().unwrap_or_else(|e| panic!("{e}"));
        let record = specimen.exercise(&motion).unwrap_or_else(|e| panic!("{kind}: {e}"));
        let prefix = format!("{number} ");
        let nodes: Vec<_> = specimen.nodes().iter().map(|n| format!("{prefix}{n}")).collect();
        let last = nodes.last().cloned().expect("an example names its nodes");
        let places: Vec<(String, Dof)> = match specimen.law.coordinates() {
            // Deformations are those of the last node; a first one stands on the ground beside it.
            Coordinates::Local(axes) => {
                axes.iter().map(|a| (last.clone(), Dof::ALL[a.index()])).collect()
            }
            Coordinates::Nodal { .. } => {
                nodes.iter().flat_map(|n| Dof::ALL.map(|dof| (n.clone(), dof))).collect()
            }
        };
        let ground = nodes.into_iter().filter(|n| places.iter().all(|(p, _)| p != n)).collect();
        // Where the ramp to the mean ends.
        let ramp = record.time.iter().position(|t| *t >= motion.period()).unwrap_or(0);
        let force = |i: usize| {
            let [_, (low, high)] = record.extremes(i);
            low.abs().max(high.abs())
        };
        let watched = |i: &usize| motion.strokes[*i].amplitude != 0.0 && force(*i) > 0.0;
        // For coordinates without motion of their own: force and amplitude of one that moves.
        let (size, reach) = (0..places.len())
            .find(watched)
            .map_or((1e3, 1e-2), |i| (force(i), motion.strokes[i].amplitude.abs()));
        let places = places.into_iter().enumerate().map(|(i, (node, dof))| {
            let (amplitude, mean) = (motion.strokes[i].amplitude.abs(), motion.strokes[i].mean);
            let (mut spring, mut mass, mut turn): (f64, f64, f64) = if watched(&i) {
                // As stiff as the link at its amplitude; the shaking of the mass bends both that far.
                // Springs of different coordinates differ, lest an unsymmetric law make equal
                // oscillators flutter.
                let spring = (1 + 2 * (0..i).filter(watched).count()) as f64 * force(i) / amplitude;
                let mass = if dof.is_rotation() {
                    2.0 * spring / (3.0 * TAU).powi(2)
                } else {
                    2.0 * force(i) / SHAKING
                };
                (spring, mass, if dof.is_rotation() { 2.0 * force(i) } else { 0.0 })
            } else if mean != 0.0 && force(i) > 0.0 {
                // Held at its mean by the static load, which the shaking changes by some tenths.
                let spring = 0.05 * force(i) / mean.abs();
                let mass =
                    if dof.is_rotation() { spring / TAU.powi(2) } else { 0.3 * force(i) / SHAKING };
                (spring, mass, 0.0)
            } else {
                (
                    size / reach,
                    if dof.is_rotation() {
                        size / reach / (9.0 * TAU).powi(2)
                    } else {
                        0.2 * size / SHAKING
                    },
                    0.0,
                )
            };
            spring *= random.factor();
            mass *= random.factor();
            turn *= random.factor();
            let held = if mean == 0.0 { 0.0 } else { record.force[i][ramp] + spring * mean };
            let amplitude = if watched(&i) { amplitude } else { 0.0 };
            Place { node, dof, spring, mass, constant: held, turn, amplitude, mean }
        });
        let places = places.collect();
        let link = format!("{prefix}{}", specimen.line.split('"').nth(1).unwrap_or_default());
        Self { kind, link, entry: specimen.placed(&prefix), ground, places }
    }

    /// Its masses.
    fn nodes(&self) -> Vec<&str> {
        let mut all: Vec<&str> = self.places.iter().map(|p| p.node.as_str()).collect();
        all.dedup();
        all
    }

    /// A value for each DOF of a mass, 0 where the link does not move it.
    fn six(&self, node: &str, value: fn(&Place) -> f64) -> [f64; 6] {
        Dof::ALL.map(|dof| {
            self.places.iter().find(|p| p.node == node && p.dof == dof).map_or(0.0, value)
        })
    }
}

/// The model as text.
fn model(animals: &[Animal], tolerance: f64) -> String {
    let mut parts: [String; 5] = Default::default();
    let [nodes, supports, elements, outputs, loads] = &mut parts;
    let mut patterns = [String::new(), String::new()];
    let put = |to: &mut String, text: String| writeln!(to, "        {text},").expect("a string");
    let coupled: f64 = animals
        .iter()
        .flat_map(|a| &a.places)
        .filter(|p| !p.dof.is_rotation())
        .map(|p| COUPLING * p.spring)
        .sum();
    // A cantilever whose tip is as stiff as all couplings together.
    let height = STOREY * FLOORS as f64;
    let inertia = coupled * height.powi(3) / (3.0 * YOUNG);
    let area = 10.0 * coupled * height / YOUNG;
    put(nodes, "\"frame 0\": (0, 0, 0)".into());
    put(supports, "\"frame 0\": Fixed".into());
    for floor in 1..=FLOORS {
        put(nodes, format!("\"frame {floor}\": (0, 0, {:e})", STOREY * floor as f64));
        let beam = format!(
            "\"column {floor}\": Beam(nodes: (\"frame {}\", \"frame {floor}\"), young: {YOUNG:e}, \
             area: {area:e}, i2: {inertia:e}, i3: {inertia:e}, torsion: {inertia:e}, shear_modulus: {:e})",
            floor - 1,
            0.4 * YOUNG
        );
        put(elements, beam);
        let mass = coupled / (2.0 * TAU).powi(2);
        put(
            elements,
            format!(
                "\"floor {floor}\": Mass(node: \"frame {floor}\", mass: {mass:e}, inertia: ({mass:e}, {mass:e}, {mass:e}))"
            ),
        );
    }
    for (i, a) in animals.iter().enumerate() {
        let turn = TAU * i as f64 / animals.len() as f64;
        let floor = 1 + i % FLOORS;
        // Bodies stand as far apart as in an exercise.
        let at = |along: usize| {
            format!(
                "({:e}, {:e}, {:e})",
                2.0 * turn.cos() + along as f64,
                2.0 * turn.sin(),
                STOREY * floor as f64
            )
        };
        put(elements, a.entry.clone());
        for node in &a.ground {
            put(nodes, format!("\"{node}\": {}", at(0)));
            put(supports, format!("\"{node}\": Fixed"));
        }
        for (along, node) in a.nodes().into_iter().enumerate() {
            put(nodes, format!("\"{node}\": {}", at(along)));
            let m = a.six(node, |p| p.mass);
            let fixed: Vec<_> =
                Dof::ALL.iter().filter(|d| m[d.index()] == 0.0).map(|d| d.name()).collect();
            if !fixed.is_empty() {
                put(supports, format!("\"{node}\": ({})", fixed.join(", ")));
            }
            put(
                elements,
                format!(
                    "\"mass {node}\": Mass(node: \"{node}\", masses: ({:e}, {:e}, {:e}), inertia: ({:e}, {:e}, {:e}))",
                    m[0], m[1], m[2], m[3], m[4], m[5]
                ),
            );
            let k = a.six(node, |p| p.spring);
            let spring = |share: f64| {
                let names = ["k1", "k2", "k3", "r1", "r2", "r3"].iter().zip(k);
                let some: Vec<_> = names
                    .filter(|(_, k)| *k > 0.0)
                    .map(|(n, k)| format!("{n}: {:e}", share * k))
                    .collect();
                format!("axis1: (1, 0, 0), axis2: (0, 1, 0), {}", some.join(", "))
            };
            put(elements, format!("\"spring {node}\": Spring(node: \"{node}\", {})", spring(1.0)));
            put(
                elements,
                format!(
                    "\"arm {node}\": Spring(nodes: (\"frame {floor}\", \"{node}\"), {})",
                    spring(COUPLING)
                ),
            );
        }
        for (c, p) in a.places.iter().enumerate() {
            let what = if p.dof.is_rotation() { "moment" } else { "force" };
            for (pattern, value) in patterns.iter_mut().zip([p.constant, p.turn]) {
                if value != 0.0 {
                    put(
                        pattern,
                        format!(
                            "    (node: \"{}\", dof: {}, {what}: {value:e})",
                            p.node,
                            p.dof.name()
                        ),
                    );
                }
            }
            if p.amplitude > 0.0 {
                for (what, quantity) in [("d", "LinkDeformation"), ("f", "LinkForce")] {
                    put(
                        outputs,
                        format!(
                            "\"{} {c} {what}\": {quantity}(link: \"{}\", coordinate: {c})",
                            a.kind, a.link
                        ),
                    );
                }
            }
        }
    }
    put(outputs, "\"roof x\": Displacement(node: \"frame 3\", dof: Ux)".into());
    put(outputs, "\"roof y\": Displacement(node: \"frame 3\", dof: Uy)".into());
    // Base motion does not turn masses about themselves; a moment does.
    let (mut rest, mut forces) = (String::new(), String::new());
    for (name, pattern) in ["mean", "turn"].iter().zip(&patterns) {
        if !pattern.is_empty() {
            put(loads, format!("\"{name}\": [\n{pattern}        ]"));
            match *name {
                "mean" => rest = "\"mean\"".into(),
                _ => forces = "forces: [(load: \"turn\", function: \"turn\")],".into(),
            }
        }
    }
    let [nodes, supports, elements, outputs, loads] = parts;
    format!(
        "(
    title: \"One link of every kind\",
    nodes: {{\n{nodes}    }},
    supports: {{\n{supports}    }},
    elements: {{\n{elements}    }},
    damping: Modal(ratio: \"5 %\"),
    loads: {{\n{loads}    }},
    functions: {{
        \"x\": Sine(amplitude: \"{SHAKING} m/s^2\", frequency: \"0.9 Hz\", cycles: 3),
        \"y\": Sine(amplitude: \"{SHAKING} m/s^2\", frequency: \"1.1 Hz\", cycles: 3),
        \"z\": Sine(amplitude: \"{SHAKING} m/s^2\", frequency: \"1.3 Hz\", cycles: 3),
        \"turn\": Sine(amplitude: 1, frequency: \"1 Hz\", cycles: 3),
    }},
    cases: {{
        \"rest\": Static(loads: [{rest}]),
        \"shake\": Dynamic(
            after: \"rest\", duration: \"4 s\", dt: \"2 ms\", step: Adaptive(tolerance: {tolerance:e}),
            basis: Complete, {forces}
            base: [(direction: X, function: \"x\"), (direction: Y, function: \"y\"), (direction: Z, function: \"z\")],
        ),
    }},
    outputs: {{\n{outputs}    }},
)
"
    )
}

/// How far a coordinate moved beside its exercise.
fn share(animal: &Animal, c: usize, model: &Model, t: &Trace) -> f64 {
    let i = output(model, &format!("{} {c} d", animal.kind));
    0.5 * (t.max[i] - t.min[i]) / animal.places[c].amplitude
}

/// Changes what shakes a coordinate that moved much too far or too little; true where there was one.
fn adjust(animals: &mut [Animal], model: &Model, t: &Trace, power: f64) -> bool {
    let mut changed = false;
    for animal in animals {
        for c in 0..animal.places.len() {
            if animal.places[c].amplitude == 0.0 {
                continue;
            }
            let share = share(animal, c, model, t);
            if (0.5..2.0).contains(&share) {
                continue;
            }
            let factor = share.clamp(0.1, 10.0).powf(power);
            let place = &mut animal.places[c];
            // Spring and load only grow: what was set apart stays apart.
            if factor > 1.0 {
                place.constant += (factor - 1.0) * place.spring * place.mean;
                place.spring *= factor;
            } else if place.dof.is_rotation() {
                place.turn /= factor;
            } else {
                place.mass /= factor;
            }
            changed = true;
        }
    }
    changed
}

#[test]
fn every_kind_of_link_in_one_model_moves_alike_under_fna_and_hht() {
    let mut random = Random(SEED);
    let kinds: Vec<_> =
        registry().cards().filter(|c| c.category == Category::Link).map(|c| c.kind).collect();
    let mut animals: Vec<_> =
        kinds.iter().enumerate().map(|(i, kind)| Animal::new(kind, i, &mut random)).collect();
    for run in 0..ROUGH_RUNS {
        let (model, system) = parse(&model(&animals, TOLERANCE[0]), &[]);
        let (t, _) = trace(&model, &system, SolverKind::Hht);
        // Ever more gently: a link that lets go can jump between little and much.
        if !adjust(&mut animals, &model, &t, 0.7 * 0.8_f64.powi(run as i32)) {
            break;
        }
    }
    let text = model(&animals, TOLERANCE[1]);
    if let Ok(path) = std::env::var("TRILITH_ZOO") {
        std::fs::write(path, &text).expect("the file named by TRILITH_ZOO");
    }
    let (model, system) = parse(&text, &[]);
    assert_eq!(system.links.links.len(), kinds.len());
    let solvers = [SolverKind::Fna, SolverKind::Hht];
    let [(a, ra), (b, rb)] = solvers.map(|s| trace(&model, &system, s));
    let mut wrong = Vec::new();
    for (result, solver) in [(&ra, "fna"), (&rb, "hht")] {
        let error = result.energy.error_relative;
        eprintln!("{solver}: energy error {error:.1e}, {:?}", result.work);
        if result.status != Status::Converged || error >= 1e-3 {
            wrong.push(format!("{solver}: {}, energy error {error:.2e}", result.status.text()));
        }
    }
    for (i, output) in model.outputs.iter().enumerate() {
        let scale = a.peak(i).max(b.peak(i));
        let far = (a.max[i] - b.max[i]).abs().max((a.min[i] - b.min[i]).abs()) / scale;
        eprintln!("{}: peak {scale:.4e}, differs by {:.3} %", output.name, 100.0 * far);
        if far.is_nan() || far > AGREEMENT {
            wrong.push(format!("{}: peaks differ by {:.2} %", output.name, 100.0 * far));
        }
    }
    for (animal, c) in animals.iter().flat_map(|a| (0..a.places.len()).map(move |c| (a, c))) {
        if animal.places[c].amplitude == 0.0 {
            continue;
        }
        let share = share(animal, c, &model, &a);
        eprintln!("{} {c}: moved by {share:.2} of its exercise", animal.kind);
        if !(EXERCISED.0..EXERCISED.1).contains(&share) {
            wrong.push(format!("{} {c}: moved by {share:.2} of its exercise", animal.kind));
        }
    }
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
}
