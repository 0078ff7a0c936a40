//! Joints: coordinates, axes, restraints, springs, masses.

use super::context::Context;
use super::geometry::{GLOBAL, Vector, along, is_along_global, joint_axes, six, to_global};
use crate::ron::Ron;
use std::collections::BTreeMap;

/// Local directions of a joint.
pub const LOCAL: [&str; 6] = ["U1", "U2", "U3", "R1", "R2", "R3"];
/// Parameters of a spring, along and about its axes.
pub const STIFFNESSES: [&str; 6] = ["k1", "k2", "k3", "r1", "r2", "r3"];

/// Reads joints and the directions that all of them have.
pub fn joints(cx: &mut Context<'_>) {
    systems(cx);
    let db = cx.db;
    for row in db.rows("JOINT COORDINATES") {
        let name = row.need("Joint");
        let (origin, axes) = match cx.systems.get(row.text("CoordSys").unwrap_or("GLOBAL")) {
            Some(system) => *system,
            None => {
                row.wrong_at(
                    "CoordSys",
                    "there is no such coordinate system",
                    "COORDINATE SYSTEMS",
                );
                continue;
            }
        };
        let own: Vector = match row.text("CoordType").unwrap_or("Cartesian") {
            "Cartesian" => ["XorR", "Y", "Z"].map(|key| row.need_number(key)),
            "Cylindrical" => {
                let (r, t) = (row.need_number("XorR"), row.need_number("T").to_radians());
                [r * t.cos(), r * t.sin(), row.need_number("Z")]
            }
            _ => {
                row.wrong_at(
                    "CoordType",
                    "coordinates of an unknown kind",
                    "Cartesian or Cylindrical",
                );
                continue;
            }
        };
        if cx.joints.insert(name, cx.draft.nodes.len()).is_some() {
            row.wrong(
                &format!("there are two joints \"{name}\""),
                "every joint has a name of its own",
            );
        }
        cx.taken.insert(name.into());
        cx.draft.nodes.push((name.into(), along(to_global(&axes, own), 1.0, origin)));
    }
    for row in db.rows("JOINT LOCAL AXES ASSIGNMENTS 1 - TYPICAL") {
        let axes = joint_axes(row.or_zero("AngleA"), row.or_zero("AngleB"), row.or_zero("AngleC"));
        if let Some(node) = cx.joint(row, "Joint") {
            if row.yes("AdvanceAxes") {
                cx.report.lose(
                    "JOINT LOCAL AXES",
                    "advanced local axes",
                    cx.draft.nodes[node].0.as_str(),
                );
            }
            if axes != GLOBAL {
                cx.axes.insert(node, axes);
            }
        }
    }
    active(cx);
}

fn systems(cx: &mut Context<'_>) {
    for row in cx.db.rows("COORDINATE SYSTEMS") {
        let origin = ["X", "Y", "Z"].map(|key| row.or_zero(key));
        let [a, b, c] = ["AboutZ", "AboutY", "AboutX"].map(|key| row.or_zero(key));
        row.text("Type");
        cx.systems.insert(row.need("Name"), (origin, joint_axes(a, b, c)));
    }
}

/// Directions that the whole model has: a plane where they make one, else supports of every joint.
fn active(cx: &mut Context<'_>) {
    let Some(row) = cx.db.rows("ACTIVE DEGREES OF FREEDOM").next() else { return };
    cx.active = ["UX", "UY", "UZ", "RX", "RY", "RZ"].map(|key| row.yes(key));
    let [x, y, z, rx, ry, rz] = cx.active;
    cx.draft.plane = match cx.active {
        [_, false, _, false, _, false] if x && z => Some("XZ"),
        [false, _, _, _, false, false] if y && z => Some("YZ"),
        [_, _, false, false, false, _] if x && y => Some("XY"),
        _ => None,
    };
    let held = match cx.draft.plane {
        None => cx.active.map(|on| !on),
        Some("XZ") => [false, false, false, false, !ry, false],
        Some("YZ") => [false, false, false, !rx, false, false],
        Some(_) => [false, false, false, false, false, !rz],
    };
    if held.contains(&true) {
        for node in 0..cx.draft.nodes.len() {
            cx.draft.supports.insert(node, held);
        }
    }
}

/// Nodes that are made later have the same directions.
pub fn hold_new_nodes(cx: &mut Context<'_>, from: usize) {
    if cx.draft.plane.is_none() && cx.active.contains(&false) {
        for node in from..cx.draft.nodes.len() {
            cx.draft.supports.insert(node, cx.active.map(|on| !on));
        }
    }
}

/// Adds masses in X, Y, Z to a node.
pub type Masses = BTreeMap<usize, [f64; 6]>;

/// Reads added masses of joints, in the axes of the joint.
pub fn added_masses(cx: &mut Context<'_>, masses: &mut Masses) {
    for row in cx.db.rows("JOINT ADDED MASS ASSIGNMENTS") {
        let own = ["Mass1", "Mass2", "Mass3", "MMI1", "MMI2", "MMI3"].map(|key| row.or_zero(key));
        let Some(node) = cx.joint(row, "Joint") else { continue };
        if own.iter().any(|m| *m < 0.0) {
            row.wrong("a mass below zero", "masses are at least 0");
        }
        let axes = cx.axes_of(node);
        let axes = cx.system(row, axes);
        let same = |i: usize| own[i] == own[i + 1] && own[i] == own[i + 2];
        let mut global = own;
        if !(is_along_global(&axes) || same(0) && same(3)) {
            let what =
                "masses in turned axes that differ along them: the axes are taken for X, Y, Z";
            cx.report.lose("JOINT ADDED MASS ASSIGNMENTS", what, &cx.draft.nodes[node].0.clone());
        } else if axes != GLOBAL {
            global = six(&axes, own, to_global).map(f64::abs);
        }
        let to = masses.entry(node).or_default();
        to.iter_mut().zip(global).for_each(|(a, b)| *a += b);
    }
}

/// Writes the masses of nodes.
pub fn write_masses(cx: &mut Context<'_>, masses: &Masses) {
    for (node, m) in masses {
        if m.iter().all(|x| *x == 0.0) {
            continue;
        }
        let mut block = Ron::block("Mass").with("node", Ron::text(cx.name(*node)));
        block = if m[0] == m[1] && m[0] == m[2] {
            block.with("mass", m[0])
        } else {
            block.with("masses", Ron::vector(&m[..3]))
        };
        if m[3..].iter().any(|x| *x != 0.0) {
            block = block.with("inertia", Ron::vector(&m[3..]));
        }
        let name = format!("mass {}", cx.name(*node));
        cx.draft.elements.push((name, block));
    }
}

/// Reads forces and displacements of joints.
pub fn loads(cx: &mut Context<'_>) {
    let db = cx.db;
    for (table, keys) in [
        ("JOINT LOADS - FORCE", ["F1", "F2", "F3", "M1", "M2", "M3"]),
        ("JOINT LOADS - GROUND DISPLACEMENT", LOCAL),
    ] {
        for row in db.rows(table) {
            let own = keys.map(|key| row.or_zero(key));
            let pattern = row.need("LoadPat");
            let Some(node) = cx.joint(row, "Joint") else { continue };
            let axes = cx.axes_of(node);
            let axes = cx.system(row, axes);
            let global = six(&axes, own, to_global);
            cx.watch(node);
            if table == "JOINT LOADS - FORCE" {
                cx.add(pattern, node, global);
            } else {
                let to = cx.ground.entry(pattern).or_default().entry(node).or_default();
                to.iter_mut().zip(global).for_each(|(a, b)| *a += b);
            }
        }
    }
}
