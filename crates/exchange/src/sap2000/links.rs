//! Links: connectivity, axes, masses and weights.

use super::beams::set_name;
use super::context::Context;
use super::geometry::{
    Axes, is_along_global, line_axes, norm, point_axes, six, sub, to_global, to_local,
};
use super::joints::Masses;
use super::link_laws::{Property, property};
use super::supports;
use crate::draft::DOFS;
use crate::ron::Ron;
use std::collections::HashMap;

/// Share of mass and weight that each joint of a link has; the ground has that of a link with one joint.
const HALF: f64 = 0.5;

/// Nonlinear links by name, with the direction that an output shows.
pub struct Links {
    /// Elements of nonlinear links and their kinds.
    pub shown: Vec<(String, Ron)>,
    /// True where there is a nonlinear one.
    pub nonlinear: bool,
}

/// Reads links, their masses and weights, and writes them.
pub fn links(cx: &mut Context<'_>, masses: &mut Masses) -> Links {
    let db = cx.db;
    let assigned: HashMap<&str, _> =
        db.rows("LINK PROPERTY ASSIGNMENTS").map(|row| (row.need("Link"), row)).collect();
    let angles: HashMap<&str, f64> = (db.rows("LINK LOCAL AXES ASSIGNMENTS 1 - TYPICAL"))
        .map(|row| (row.need("Link"), row.or_zero("Angle")))
        .collect();
    let definitions: HashMap<&str, _> = (db.rows("LINK PROPERTY DEFINITIONS 01 - GENERAL"))
        .map(|row| (row.need("Link"), row))
        .collect();
    let mut known: HashMap<&str, Property> = HashMap::new();
    let mut out = Links { shown: Vec::new(), nonlinear: false };
    let mut weights: HashMap<&str, (f64, Vec<usize>)> = HashMap::new();
    for row in db.rows("CONNECTIVITY - LINK") {
        let name = row.need("Link");
        let Some(i) = cx.joint(row, "JointI") else { continue };
        let j = row.text("JointJ").map_or(Some(i), |_| cx.joint(row, "JointJ"));
        let (Some(j), Some(assigned)) = (j, assigned.get(name)) else {
            row.wrong("this link has no property", "LINK PROPERTY ASSIGNMENTS gives it one");
            continue;
        };
        let set = assigned.need("LinkProp");
        if assigned.number("PropMod").is_some_and(|m| m != 1.0) {
            cx.report.lose("LINK PROPERTY ASSIGNMENTS: PropMod", "a factor of a property", name);
        }
        let Some(definition) = definitions.get(set) else {
            let message = format!("there is no link property \"{set}\"");
            assigned.wrong_at("LinkProp", &message, "LINK PROPERTY DEFINITIONS 01 - GENERAL");
            continue;
        };
        if !known.contains_key(set) {
            let read = property(cx, *definition, set);
            known.insert(set, read);
        }
        let property = &known[set];
        let nodes = if i == j { vec![i] } else { vec![i, j] };
        let length = norm(sub(cx.at(j), cx.at(i)));
        let angle = angles.get(name).copied().unwrap_or(0.0);
        let axes =
            if length > 0.0 { line_axes(cx.at(i), cx.at(j), angle) } else { point_axes(angle) };
        let told = nodes.len() == 2 && length == 0.0 || angle != 0.0;
        write(cx, name, set, property, &nodes, &axes, told, &mut out);
        fixed(cx, name, property, &nodes, length, &axes);
        for node in &nodes {
            let to = masses.entry(*node).or_default();
            (0..3).for_each(|k| to[k] += HALF * property.mass);
            for k in 0..3 {
                // About the axes of the link; off its diagonal nothing is kept.
                to[3 + k] +=
                    HALF * (0..3).map(|a| axes[a][k].powi(2) * property.inertia[a]).sum::<f64>();
            }
            cx.watch(*node);
        }
        if property.inertia != [0.0; 3] && !is_along_global(&axes) {
            cx.report.lose(
                "LINK PROPERTY DEFINITIONS 01 - GENERAL: RotInert",
                "products of inertia of a link askew",
                name,
            );
        }
        if property.weight != 0.0 {
            weights.insert(name, (property.weight, nodes.clone()));
        }
        moved_ground(cx, name, property, &nodes, &axes);
    }
    own_weight(cx, &weights);
    out
}

fn write(
    cx: &mut Context<'_>,
    name: &str,
    set: &str,
    property: &Property,
    nodes: &[usize],
    axes: &Axes,
    told: bool,
    out: &mut Links,
) {
    let names: Vec<Ron> = nodes.iter().map(|n| Ron::text(cx.name(*n))).collect();
    let mut place = match <[Ron; 1]>::try_from(names) {
        Ok([node]) => Ron::block("").with("node", node),
        Err(names) => Ron::block("").with("nodes", Ron::Tuple(names)),
    };
    if told {
        place = place.with("axis1", Ron::vector(&axes[0])).with("axis2", Ron::vector(&axes[1]));
    }
    let single = property.parts.len() == 1;
    for (words, block) in &property.parts {
        let with = |front: &str| if single { front.to_owned() } else { format!("{front} {words}") };
        let element = with(&format!("link {name}"));
        let set = set_name(cx, &with(set), block);
        cx.draft.shared(element.clone(), &set, block, place.clone());
        if block.name() != "Spring" {
            out.shown.push((element, block.clone()));
        }
    }
    if property.parts.is_empty() && !property.fixed.contains(&true) {
        cx.report.otherwise(
            "CONNECTIVITY - LINK",
            "a link without stiffness leaves its mass alone",
            name,
        );
    }
    out.nonlinear |= property.nonlinear;
}

/// Fixed directions of a link: supports, or joints that move alike.
fn fixed(
    cx: &mut Context<'_>,
    name: &str,
    property: &Property,
    nodes: &[usize],
    length: f64,
    axes: &Axes,
) {
    if !property.fixed.contains(&true) {
        return;
    }
    let whole = property.fixed.iter().all(|f| *f);
    if let ([i, j], true) = (nodes, whole) {
        let pair = Ron::Tuple(vec![Ron::text(cx.name(*i)), Ron::text(cx.name(*j))]);
        cx.draft
            .elements
            .push((format!("link {name} fixed"), Ron::block("RigidLink").with("nodes", pair)));
        return;
    }
    if !is_along_global(axes) || length > 0.0 && nodes.len() == 2 {
        cx.report.lose(
            "LINK PROPERTY DEFINITIONS: Fixed",
            "some fixed directions of a link with length or askew",
            name,
        );
        return;
    }
    let mut dofs = [false; 6];
    for d in (0..6).filter(|d| property.fixed[*d]) {
        let axis = axes[d % 3];
        let global = (0..3).find(|g| axis[*g].abs() > 0.5).unwrap_or(d % 3);
        dofs[global + if d < 3 { 0 } else { 3 }] = true;
    }
    if let [node] = nodes {
        let held = cx.draft.supports.entry(*node).or_default();
        (0..6).filter(|d| dofs[*d]).for_each(|d| held[d] = true);
        return;
    }
    let pair = Ron::Tuple(nodes.iter().map(|n| Ron::text(cx.name(*n))).collect());
    let tied: Vec<&str> = (0..6).filter(|d| dofs[*d] && cx.active[*d]).map(|d| DOFS[d]).collect();
    if !tied.is_empty() {
        let equal = Ron::block("EqualDof").with("nodes", pair).with("dofs", Ron::words(&tied));
        cx.draft.elements.push((format!("link {name} fixed"), equal));
    }
}

/// What a grounded linear link does where its ground moves.
fn moved_ground(
    cx: &mut Context<'_>,
    name: &str,
    property: &Property,
    nodes: &[usize],
    axes: &Axes,
) {
    let moves = nodes.iter().any(|n| cx.ground.values().any(|all| all.contains_key(n)));
    if !moves {
        return;
    }
    if let ([node], false) = (nodes, property.nonlinear) {
        let k = property.linear;
        supports::grounded(cx, *node, |u| {
            let mut f = six(axes, u, to_local);
            f.iter_mut().zip(k).for_each(|(x, k)| *x *= k);
            six(axes, f, to_global)
        });
    } else {
        cx.report.lose(
            "JOINT LOADS - GROUND DISPLACEMENT",
            "a moved support that a link hangs on",
            name,
        );
    }
}

/// Weights of links in patterns with a multiplier for them, half at each joint.
fn own_weight(cx: &mut Context<'_>, weights: &HashMap<&str, (f64, Vec<usize>)>) {
    let db = cx.db;
    let mut names: Vec<_> = weights.keys().copied().collect();
    names.sort_unstable();
    for row in db.rows("LOAD PATTERN DEFINITIONS") {
        let times = row.or_zero("SelfWtMult");
        for name in names.iter().filter(|_| times != 0.0) {
            let (weight, nodes) = &weights[name];
            for node in nodes {
                let f = -times * HALF * weight;
                cx.add(row.need("LoadPat"), *node, [0.0, 0.0, f, 0.0, 0.0, 0.0]);
            }
        }
    }
    for row in db.rows("LINK LOADS - GRAVITY") {
        let Some((weight, nodes)) = weights.get(row.need("Link")) else { continue };
        let axes = cx.system(row, super::geometry::GLOBAL);
        let own = ["MultiplierX", "MultiplierY", "MultiplierZ"].map(|key| row.or_zero(key));
        let [x, y, z] = to_global(&axes, own).map(|m| m * HALF * weight);
        for node in nodes {
            cx.add(row.need("LoadPat"), *node, [x, y, z, 0.0, 0.0, 0.0]);
        }
    }
}
