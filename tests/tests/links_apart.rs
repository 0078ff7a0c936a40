//! Links between nodes that lie apart: a rigid motion of both deforms nothing, along whatever axes, and the
//! shear acts where the file says.

use trilith_model::Model;
use trilith_system::System;
use trilith_tests::parse;

/// What a turn about the origin with the vector `w` deforms of each coordinate of the links.
fn deformed(model: &Model, system: &System, w: [f64; 3]) -> Vec<f64> {
    let moved = |full: &usize| {
        let x = model.nodes[full / 6].position;
        let u = [w[1] * x[2] - w[2] * x[1], w[2] * x[0] - w[0] * x[2], w[0] * x[1] - w[1] * x[0]];
        if full % 6 < 3 { u[full % 6] } else { w[full % 6 - 3] }
    };
    let u: Vec<f64> = system.reduction.free.iter().map(moved).collect();
    let row = |row: &Vec<(usize, f64)>| row.iter().map(|(i, c)| c * u[*i]).sum();
    system.links.rows.iter().map(row).collect()
}

fn free_of(elements: &str) -> (Model, System) {
    parse(
        &format!(
            r#"(
            nodes: {{ "a": (1, 2, 0.5), "b": (2.5, 1, 3), "c": (0, 0, 1), "d": (4, 1, 1) }},
            elements: {{
                "ma": Mass(node: "a", mass: 1, inertia: (1, 1, 1)), "mb": Mass(node: "b", mass: 1, inertia: (1, 1, 1)),
                {elements}
            }},
            cases: {{ "swing": Dynamic(duration: 1, dt: 0.01) }},
        )"#
        ),
        &[],
    )
}

#[test]
fn a_rigid_motion_of_both_nodes_deforms_no_link() {
    let axes = ["", "axis1: (1, 0, 0), ", "axis1: (0.3, -0.8, 0.2), axis2: (0, 0.1, 1), "];
    for axes in axes {
        for shear_at in ["", "shear_at: 0.4, "] {
            let (model, system) = free_of(&format!(
                r#""w": Wen(nodes: ("a", "b"), {axes}{shear_at}axis: U2, k: 1, fy: 1, ratio: 0.1),
                   "turn": Wen(nodes: ("a", "b"), {axes}axis: R3, k: 1, fy: 1, ratio: 0.1),
                   "pad": RubberIsolator(nodes: ("a", "b"), {axes}{shear_at}kv: 1, k2: 1, k3: 1, fy2: 1, fy3: 1, ratio2: 0.1, ratio3: 0.1),"#,
            ));
            for w in [[1.0, 0.0, 0.0], [0.2, -0.7, 0.4]] {
                for d in deformed(&model, &system, w) {
                    assert!(d.abs() < 1e-14, "{axes}{shear_at} {w:?}: {d}");
                }
            }
        }
    }
}

/// The rotations of these nodes are their bodies': no element and no link asks for them.
#[test]
fn a_link_turns_with_the_bodies_whose_nodes_it_joins() {
    let (model, system) = free_of(
        r#""one": RigidBody(nodes: ("a", "c")), "two": RigidBody(nodes: ("b", "d")),
           "up": Wen(nodes: ("c", "d"), axis1: (0, 0, 1), axis: U1, k: 1, fy: 1, ratio: 0.1),
           "level": Wen(nodes: ("c", "d"), axis1: (0, 0, 1), axis: U2, k: 1, fy: 1, ratio: 0.1),"#,
    );
    let w = [0.2, -0.7, 0.4];
    for d in deformed(&model, &system, w) {
        assert!(d.abs() < 1e-14, "{d}");
    }
    // A turn of the second body alone, about its own node b, moves the link at d.
    let b = model.nodes.iter().position(|n| n.name == "b").unwrap_or_default();
    let turn = |full: &usize| if *full == 6 * b + 4 { 1.0 } else { 0.0 };
    let u: Vec<f64> = system.reduction.free.iter().map(turn).collect();
    let along_z: f64 = system.links.rows[0].iter().map(|(i, c)| c * u[*i]).sum();
    // e_z · (e_y × (x_d − x_b)) = −(x_d − x_b)·e_x
    assert!((along_z + 1.5).abs() < 1e-14, "{along_z}");
}

#[test]
fn the_shear_acts_where_the_file_says() {
    let (_, system) = parse(
        r#"(
        nodes: { "g": (0, 0, 0), "m": (2, 0, 0) },
        supports: { "g": Fixed },
        elements: {
            "m": Mass(node: "m", mass: 1, inertia: (1, 1, 1)),
            "w": Wen(nodes: ("g", "m"), shear_at: 0.5, axis2: (0, 1, 0), axis: U2, k: 1, fy: 1, ratio: 0.1),
        },
        cases: { "swing": Dynamic(duration: 1, dt: 0.01) },
    )"#,
        &[],
    );
    // The link stands at 1.5 m: u_y − θ_z (2 − 1.5).
    let uy_and_turn: Vec<(usize, f64)> =
        system.links.rows[0].iter().map(|(i, c)| (system.reduction.free[*i] % 6, *c)).collect();
    assert_eq!(uy_and_turn, [(1, 1.0), (5, -0.5)]);
}
