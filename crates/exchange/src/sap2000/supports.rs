//! What holds joints: restraints, springs, and displacements of the ground.

use super::context::Context;
use super::geometry::{Axes, is_along_global, six, to_global, to_local};
use super::joints::{LOCAL, STIFFNESSES};
use crate::draft::DOFS;
use crate::ron::Ron;

/// Stiffness of what stands for an inclined support, as a multiple of the largest of the frames.
const RIGID: f64 = 1e6;

/// Reads restraints. Inclined ones become springs, stiffer by [`RIGID`] than the frames are: along and about an axis.
pub fn restraints(cx: &mut Context<'_>, stiffest: [f64; 2]) {
    for row in cx.db.rows("JOINT RESTRAINT ASSIGNMENTS") {
        let held = LOCAL.map(|key| row.yes(key));
        let Some(node) = cx.joint(row, "Joint") else { continue };
        let axes = cx.axes_of(node);
        for (half, stiff) in [(0, stiffest[0]), (3, stiffest[1])] {
            let part = &held[half..half + 3];
            let whole = part.iter().all(|h| *h == part[0]);
            if whole || is_along_global(&axes) {
                for (axis, _) in axes.iter().zip(part).filter(|(_, h)| **h) {
                    // Along a global direction where the whole is not held.
                    for (i, x) in axis.iter().enumerate() {
                        if whole || x.abs() > 0.5 {
                            cx.draft.supports.entry(node).or_default()[half + i] = true;
                        }
                    }
                }
                continue;
            }
            let what =
                "an inclined restraint stands as a spring, a million times as stiff as the frames";
            cx.report.otherwise(
                "JOINT RESTRAINT ASSIGNMENTS",
                what,
                &cx.draft.nodes[node].0.clone(),
            );
            let mut stiffnesses = [0.0; 6];
            (0..3).filter(|i| part[*i]).for_each(|i| stiffnesses[half + i] = RIGID * stiff);
            let name = format!("support {}{}", cx.name(node), if half == 0 { "" } else { " turn" });
            spring(cx, name, node, stiffnesses, &axes);
        }
    }
}

/// A spring to the ground in the axes of a joint.
fn spring(cx: &mut Context<'_>, name: String, node: usize, stiffnesses: [f64; 6], axes: &Axes) {
    let mut block = Ron::block("Spring").with("node", Ron::text(cx.name(node)));
    for (key, k) in STIFFNESSES.iter().zip(stiffnesses).filter(|(_, k)| *k != 0.0) {
        block = block.with(key, k);
    }
    let block = block.with("axis1", Ron::vector(&axes[0])).with("axis2", Ron::vector(&axes[1]));
    cx.draft.elements.push((name, block));
}

/// Reads springs of joints; what a displacement of the ground puts into them goes into its pattern.
pub fn springs(cx: &mut Context<'_>) {
    let db = cx.db;
    for row in db.rows("JOINT SPRING ASSIGNMENTS 1 - UNCOUPLED") {
        let stiffnesses = LOCAL.map(|key| row.or_zero(key));
        let Some(node) = cx.joint(row, "Joint") else { continue };
        let axes = cx.axes_of(node);
        let axes = cx.system(row, axes);
        if stiffnesses.iter().any(|k| *k < 0.0) {
            row.wrong("the stiffness of a spring is below zero", "");
        } else if stiffnesses.iter().any(|k| *k > 0.0) {
            let name = format!("spring {}", cx.name(node));
            spring(cx, name, node, stiffnesses, &axes);
            grounded(cx, node, |u| {
                let own = six(&axes, u, to_local);
                let mut f = own;
                f.iter_mut().zip(stiffnesses).for_each(|(x, k)| *x *= k);
                six(&axes, f, to_global)
            });
        }
    }
    for row in db.rows("JOINT SPRING ASSIGNMENTS 2 - COUPLED") {
        let Some(node) = cx.joint(row, "Joint") else { continue };
        let axes = cx.axes_of(node);
        let axes = cx.system(row, axes);
        let entry = |i: usize, j: usize| {
            let key = if i == j { LOCAL[i].into() } else { format!("{}{}", LOCAL[i], LOCAL[j]) };
            row.or_zero(&key)
        };
        let rows: Vec<Ron> = (0..6)
            .map(|i| Ron::vector(&(0..6).map(|j| entry(i.min(j), i.max(j))).collect::<Vec<_>>()))
            .map(|row| if let Ron::Tuple(all) = row { Ron::List(all) } else { row })
            .collect();
        let block = Ron::block("Spring")
            .with("node", Ron::text(cx.name(node)))
            .with("stiffness", Ron::List(rows))
            .with("axis1", Ron::vector(&axes[0]))
            .with("axis2", Ron::vector(&axes[1]));
        let name = format!("spring {}", cx.name(node));
        cx.draft.elements.push((name, block));
    }
}

/// Adds to the patterns what springs do whose ground moves.
pub fn grounded(cx: &mut Context<'_>, node: usize, force: impl Fn([f64; 6]) -> [f64; 6]) {
    let moved: Vec<_> =
        cx.ground.iter().filter_map(|(p, all)| all.get(&node).map(|u| (*p, *u))).collect();
    for (pattern, u) in moved {
        cx.add(pattern, node, force(u));
    }
}

/// Says what becomes of displacements of the ground.
pub fn report_ground(cx: &mut Context<'_>) {
    let moved: Vec<usize> = cx.ground.values().flat_map(|all| all.keys().copied()).collect();
    for node in moved {
        let name = cx.name(node).to_owned();
        let what = "displacements of supports act as the forces that they put into frames and springs; \
                    the support itself reads 0";
        cx.report.otherwise("JOINT LOADS - GROUND DISPLACEMENT", what, &name);
    }
}

/// Directions of a node that nothing holds.
pub fn free(cx: &Context<'_>, node: usize) -> Vec<&'static str> {
    let in_plane = match cx.draft.plane {
        Some("XZ") => [true, false, true, false, true, false],
        Some("YZ") => [false, true, true, true, false, false],
        Some(_) => [true, true, false, false, false, true],
        None => [true; 6],
    };
    let held = cx.draft.supports.get(&node).copied().unwrap_or_default();
    (0..6).filter(|i| in_plane[*i] && cx.active[*i] && !held[*i]).map(|i| DOFS[i]).collect()
}
