//! Outputs: motion of the joints of interest, forces and deformations of links, forces of frames on supports.

use super::context::Context;
use super::frames::Frames;
use super::links::Links;
use super::supports::free;
use crate::draft::DOFS;
use crate::ron::Ron;

/// Most nodes and frames that outputs are written for.
const MOST: usize = 200;

/// Writes outputs.
pub fn outputs(cx: &mut Context<'_>, frames: &Frames<'_>, links: &Links) {
    generalized(cx);
    let mut nodes = std::mem::take(&mut cx.watched);
    if nodes.is_empty() {
        nodes = (0..cx.joints.len()).collect();
    }
    nodes.sort_unstable();
    for node in nodes.into_iter().take(MOST) {
        for dof in free(cx, node) {
            let name = cx.name(node).to_owned();
            let block = Ron::block("Displacement").with("node", Ron::text(&name));
            push(cx, format!("{name} {dof}"), block.with("dof", Ron::word(dof)));
        }
    }
    for (element, block) in links.shown.iter().take(MOST) {
        for axis in axes(block) {
            for (kind, what) in [("LinkForce", "force"), ("LinkDeformation", "deformation")] {
                let output = Ron::block(kind).with("link", Ron::text(element));
                let output = output.with("axis", Ron::word(axis));
                let told = element.strip_suffix(axis).map_or(element.as_str(), str::trim_end);
                push(cx, format!("{told} {axis} {what}"), output);
            }
        }
    }
    supports(cx, frames);
}

fn push(cx: &mut Context<'_>, name: String, block: Ron) {
    if !cx.draft.outputs.iter().any(|(n, _)| *n == name) {
        cx.draft.outputs.push((name, block));
    }
}

/// Local axes that a link has forces along.
fn axes(block: &Ron) -> Vec<&'static str> {
    const ALL: [&str; 6] = ["U1", "U2", "U3", "R1", "R2", "R3"];
    let field = |name: &str| match block {
        Ron::Block(_, fields) => fields.iter().find(|(n, _)| n == name).map(|(_, v)| v),
        _ => None,
    };
    match block.name() {
        "RubberIsolator" | "FrictionPendulum" | "TensionCompressionFriction" | "TriplePendulum" => {
            vec!["U1", "U2", "U3"]
        }
        "LinearLink" => vec![],
        _ => match field("axis") {
            Some(Ron::Word(word)) => ALL.iter().filter(|a| *a == word).copied().collect(),
            _ => vec!["U1"],
        },
    }
}

/// Generalized displacements: sums over joints.
fn generalized(cx: &mut Context<'_>) {
    let mut all: Vec<(&str, Vec<Ron>)> = Vec::new();
    for row in cx.db.rows("GENERALIZED DISPLACEMENT DEFINITIONS 1 - TRANSLATIONAL") {
        let name = row.need("GenDispl");
        let factors = ["U1SF", "U2SF", "U3SF", "R1SF", "R2SF", "R3SF"].map(|key| row.or_zero(key));
        let Some(node) = cx.joint(row, "Joint") else { continue };
        cx.watch(node);
        if !all.iter().any(|(n, _)| *n == name) {
            all.push((name, Vec::new()));
        }
        let terms = &mut all.iter_mut().find(|(n, _)| *n == name).expect("it was put there").1;
        for (i, factor) in factors.into_iter().enumerate().filter(|(_, f)| *f != 0.0) {
            let mut term = Ron::block("").with("node", Ron::text(cx.name(node)));
            term = term.with("dof", Ron::word(DOFS[i]));
            // A rotation comes to a displacement by a length.
            term = match (i >= 3, factor == 1.0) {
                (true, _) => {
                    term.with("factor", Ron::Text(format!("{factor} {}", cx.draft.units.0)))
                }
                (false, true) => term,
                (false, false) => term.with("factor", factor),
            };
            terms.push(term);
        }
    }
    for (name, terms) in all {
        if !terms.is_empty() {
            push(cx, name.into(), Ron::block("Displacement").with("terms", Ron::List(terms)));
        }
    }
}

/// Forces of frames on the joints that something holds.
fn supports(cx: &mut Context<'_>, frames: &Frames<'_>) {
    let mut count = 0;
    for piece in frames.values().flat_map(|f| &f.pieces) {
        for (end, node) in piece.nodes.into_iter().enumerate() {
            let held = cx.draft.supports.get(&node).copied().unwrap_or_default();
            let dofs: Vec<usize> = (0..6).filter(|d| held[*d] && cx.active[*d]).collect();
            if dofs.is_empty() || count == MOST {
                continue;
            }
            count += 1;
            let fixity = piece.fixity[end].iter().any(|k| *k != 0.0);
            for d in dofs.into_iter().filter(|_| !fixity) {
                let block = Ron::block("ElementForce")
                    .with("element", Ron::text(&piece.name))
                    .with("end", end as f64)
                    .with("dof", Ron::word(DOFS[d]));
                let name = format!("{} at {} {}", piece.name, cx.name(node), DOFS[d]);
                push(cx, name, block);
            }
        }
    }
}
