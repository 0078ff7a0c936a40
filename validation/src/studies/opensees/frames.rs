//! Frames: members and their ends, damping, constraints, and what moves them.

use super::structures::Moved::{Led, Pushed, Shaken};
use super::structures::{Node, Structure};
use serde_json::{Value, json};

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
pub(super) fn member(
    tag: u8,
    nodes: [u8; 2],
    upright: bool,
    offsets: Option<[f64; 6]>,
) -> Vec<Value> {
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
pub(super) fn beam(name: &str, [i, j]: [&str; 2], own: &str) -> String {
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

pub(super) fn structures() -> Vec<Structure> {
    let mut all = frames();
    all.extend(damped());
    all.extend(constrained());
    all
}
