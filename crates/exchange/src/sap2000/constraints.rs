//! Constraints of joints.

use super::context::Context;
use super::database::Entry;
use super::geometry::{norm, sub};
use crate::draft::DOFS;
use crate::ron::Ron;
use std::collections::BTreeMap;

const GLOBAL: [&str; 6] = ["UX", "UY", "UZ", "RX", "RY", "RZ"];

/// Reads constraints and writes them.
pub fn constraints(cx: &mut Context<'_>) {
    let mut joints: BTreeMap<&str, Vec<usize>> = BTreeMap::new();
    for row in cx.db.rows("JOINT CONSTRAINT ASSIGNMENTS") {
        if let Some(node) = cx.joint(row, "Joint") {
            joints.entry(row.need("Constraint")).or_default().push(node);
        }
    }
    let db = cx.db;
    for kind in ["BODY", "DIAPHRAGM", "EQUAL", "LOCAL", "ROD", "WELD"] {
        for row in db.rows(&format!("CONSTRAINT DEFINITIONS - {kind}")) {
            let name = row.need("Name");
            let Some(nodes) = joints.get(name).filter(|nodes| nodes.len() > 1) else { continue };
            if row.text("CoordSys").is_some_and(|s| s != "GLOBAL") {
                cx.report.lose(
                    "CONSTRAINT DEFINITIONS: CoordSys",
                    "axes other than the global",
                    name,
                );
                continue;
            }
            one(cx, kind, name, row, nodes);
        }
    }
}

fn one<'a>(cx: &mut Context<'a>, kind: &str, name: &str, row: Entry<'a>, nodes: &[usize]) {
    let lost = |cx: &mut Context<'a>, what: &str| {
        cx.report.lose(&format!("CONSTRAINT DEFINITIONS - {kind}"), what, name);
    };
    match kind {
        "BODY" | "WELD" => {
            let tied = GLOBAL.map(|key| row.yes(key));
            let tolerance = row.or_zero("Tolerance");
            // In a plane its three directions are all there are.
            let whole = (0..6).all(|i| tied[i] || !cx.active[i]);
            if !whole {
                return lost(cx, "a body that is not rigid in all directions");
            }
            if kind == "BODY" {
                write(cx, name, &Ron::block("RigidBody"), nodes);
                return;
            }
            let groups = gathered(nodes, |a, b| norm(sub(cx.at(a), cx.at(b))) <= tolerance);
            for (k, group) in groups.iter().filter(|g| g.len() > 1).enumerate() {
                write(cx, &format!("{name} {}", k + 1), &Ron::block("RigidBody"), group);
            }
        }
        "EQUAL" | "LOCAL" => {
            let keys = if kind == "EQUAL" { GLOBAL } else { super::joints::LOCAL };
            let tied = keys.map(|key| row.yes(key));
            if kind == "LOCAL" && nodes.iter().any(|n| cx.axes.contains_key(n)) {
                return lost(cx, "joints with axes of their own");
            }
            let dofs: Vec<&str> =
                (0..6).filter(|i| tied[*i] && cx.active[*i]).map(|i| DOFS[i]).collect();
            if !dofs.is_empty() {
                write(cx, name, &Ron::block("EqualDof").with("dofs", Ron::words(&dofs)), nodes);
            }
        }
        _ => {
            let axis = row.text("Axis").unwrap_or("Auto");
            let Some(at) = ["X", "Y", "Z"].iter().position(|a| *a == axis) else {
                return lost(cx, "an axis that the program finds (Auto)");
            };
            if kind == "ROD" {
                write(
                    cx,
                    name,
                    &Ron::block("EqualDof").with("dofs", Ron::words(&[DOFS[at]])),
                    nodes,
                );
                return;
            }
            let block = Ron::block("Diaphragm");
            let block = if axis == "Z" { block } else { block.with("normal", Ron::word(axis)) };
            if row.yes("MultiLevel") {
                let levels = gathered(nodes, |a, b| (cx.at(a)[at] - cx.at(b)[at]).abs() < 1e-6);
                for (k, level) in levels.iter().filter(|g| g.len() > 1).enumerate() {
                    write(cx, &format!("{name} {}", k + 1), &block, level);
                }
            } else {
                write(cx, name, &block, nodes);
            }
        }
    }
}

/// Nodes in groups of those that go with the first of each.
fn gathered(nodes: &[usize], with: impl Fn(usize, usize) -> bool) -> Vec<Vec<usize>> {
    let mut groups: Vec<Vec<usize>> = Vec::new();
    for node in nodes {
        match groups.iter_mut().find(|g| with(g[0], *node)) {
            Some(group) => group.push(*node),
            None => groups.push(vec![*node]),
        }
    }
    groups
}

fn write(cx: &mut Context<'_>, name: &str, block: &Ron, nodes: &[usize]) {
    let names = Ron::Tuple(nodes.iter().map(|n| Ron::text(cx.name(*n))).collect());
    let Ron::Block(kind, fields) = block.clone() else { return };
    let mut all = vec![("nodes".to_owned(), names)];
    all.extend(fields);
    cx.draft.elements.push((format!("constraint {name}"), Ron::Block(kind, all)));
}
