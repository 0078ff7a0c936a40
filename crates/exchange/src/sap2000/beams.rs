//! Beams of the pieces of frames.

use super::context::Context;
use super::joints::{LOCAL, STIFFNESSES};
use super::piece::Piece;
use crate::draft::DOFS;
use crate::ron::Ron;

/// Writes the beam of a piece.
pub fn write(cx: &mut Context<'_>, piece: &mut Piece, section: &str, angle: f64) {
    let mut names = piece.nodes.map(|n| cx.name(n).to_owned());
    for end in 0..2 {
        if piece.fixity[end].iter().any(|k| *k != 0.0) {
            names[end] = partly_fixed(cx, piece, end);
        }
    }
    let mut place = Ron::block("").with("nodes", Ron::Tuple(names.map(Ron::Text).to_vec()));
    if angle != 0.0 {
        place = place.with("axis2", Ron::vector(&piece.axes[1]));
    }
    for (end, key) in ["release_i", "release_j"].into_iter().enumerate() {
        let gone: Vec<&str> = (0..6)
            .filter(|d| piece.released[end][*d] && piece.fixity[end][*d] == 0.0)
            .map(|d| LOCAL[d])
            .collect();
        if !gone.is_empty() {
            place = place.with(key, Ron::words(&gone));
        }
    }
    for (end, key) in ["offset_i", "offset_j"].into_iter().enumerate() {
        if piece.rigid[end] != 0.0 {
            place = place.with(key, piece.rigid[end]);
        }
    }
    if piece.rigid != [0.0; 2] {
        place = place.with("offsets_stiffen", Ron::word("Bending"));
    }
    let warm = cx.db.rows(super::frame_loads::WARMTH).next().is_some();
    let expansion = Some(piece.section.expansion).filter(|a| warm && *a != 0.0);
    let beam = piece.section.beam().maybe("expansion", expansion);
    let set = set_name(cx, section, &beam);
    cx.draft.shared(piece.name.clone(), &set, &beam, place);
}

/// A name for a set of properties: that of the section, with a number where there is another of that name.
pub fn set_name(cx: &Context<'_>, name: &str, properties: &Ron) -> String {
    let same = |(n, p): &&(String, Ron)| {
        p == properties && (n == name || n.strip_prefix(name).is_some_and(|r| r.starts_with(" ")))
    };
    if let Some((n, _)) = cx.draft.properties.iter().find(same) {
        return n.clone();
    }
    let taken = |n: &str| cx.draft.properties.iter().any(|(m, _)| m == n);
    let mut tries = std::iter::once(name.to_owned()).chain((2..).map(|k| format!("{name} {k}")));
    tries.find(|n| !taken(n)).unwrap_or_default()
}

/// A node at the end of a piece that springs hold to the joint where it is partly fixed, and that moves with it elsewhere.
fn partly_fixed(cx: &mut Context<'_>, piece: &Piece, end: usize) -> String {
    let joint = piece.nodes[end];
    let inner = cx.new_node(&format!("{}.fixity {}", cx.name(joint), piece.name), piece.at[end]);
    let (joint, name) = (cx.name(joint).to_owned(), cx.name(inner).to_owned());
    let pair = |a: &str, b: &str| Ron::Tuple(vec![Ron::text(a), Ron::text(b)]);
    let mut spring = Ron::block("Spring").with("nodes", pair(&joint, &name));
    let mut tied = [true; 6];
    for d in 0..6 {
        if piece.released[end][d] && piece.fixity[end][d] > 0.0 {
            spring = spring.with(STIFFNESSES[d], piece.fixity[end][d]);
            // Local direction d runs along this global one.
            let axis = piece.axes[d % 3];
            let global = (0..3).find(|g| axis[*g].abs() > 0.5).unwrap_or(d % 3);
            tied[global + if d < 3 { 0 } else { 3 }] = false;
        }
    }
    let spring = spring
        .with("axis1", Ron::vector(&piece.axes[0]))
        .with("axis2", Ron::vector(&piece.axes[1]));
    let tied: Vec<&str> = (0..6).filter(|d| tied[*d]).map(|d| DOFS[d]).collect();
    let equal =
        Ron::block("EqualDof").with("nodes", pair(&joint, &name)).with("dofs", Ron::words(&tied));
    cx.draft.elements.push((format!("fixity {name}"), spring));
    cx.draft.elements.push((format!("tied {name}"), equal));
    name
}
