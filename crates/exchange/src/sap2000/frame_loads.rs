//! Loads of frames: along their beams, in local axes; as forces of their nodes that do the same where a beam is partly fixed
//! to springs or warmth across it varies.

use super::context::Context;
use super::database::Entry;
use super::frames::{Frame, Frames};
use super::geometry::{GLOBAL, Vector, cross, norm, to_local};
use super::joints::LOCAL;
use super::piece::{Loads, Piece};
use crate::ron::Ron;
use std::collections::HashMap;

/// Share of the largest component of a load below which one is rounding.
const ROUNDING: f64 = 1e-12;

const SPREAD: &str = "FRAME LOADS - DISTRIBUTED";
const POINT: &str = "FRAME LOADS - POINT";
pub const WARMTH: &str = "FRAME LOADS - TEMPERATURE";
const OWN: &str = "FRAME LOADS - GRAVITY";

/// Direction of a load in local axes of a frame: force (or moment) of size 1, shortened where it is per projected length.
fn direction<'a>(cx: &mut Context<'a>, row: Entry<'a>, frame: &Frame) -> Option<[f64; 6]> {
    let axes = frame.pieces.first()?.axes;
    let dir = row.need("Dir");
    let (name, projected) = match dir.strip_suffix(" Proj") {
        Some(name) => (name, true),
        None => (dir, false),
    };
    let of = cx.system(row, axes);
    let global: Vector = match name {
        "Gravity" => [0.0, 0.0, -1.0],
        "X" | "1" => of[0],
        "Y" | "2" => of[1],
        "Z" | "3" => of[2],
        _ => {
            row.wrong_at("Dir", "a load in an unknown direction", "1, 2, 3, X, Y, Z or Gravity");
            return None;
        }
    };
    let size = if projected { norm(cross(global, axes[0])) } else { 1.0 };
    let [a, b, c] = to_local(&axes, global).map(|x| x * size);
    Some(if row.text("Type") == Some("Moment") {
        [0.0, 0.0, 0.0, a, b, c]
    } else {
        [a, b, c, 0.0, 0.0, 0.0]
    })
}

/// A distance along a frame, by share or by length.
fn distance(row: Entry<'_>, frame: &Frame, end: &str) -> f64 {
    let s = match row.text("DistType") {
        Some("AbsDist") => row.need_number(&format!("AbsDist{end}")),
        _ => row.need_number(&format!("RelDist{end}")) * frame.length,
    };
    if !(s >= 0.0 && s <= frame.length * (1.0 + 1e-6)) {
        row.wrong("a load that is not on its frame", "distances run from 0 to the length");
    }
    s.clamp(0.0, frame.length)
}

/// Puts a load on a piece; `along` are its parts along the beam, none where they cannot be said.
fn put<'a>(
    cx: &mut Context<'a>,
    pattern: &'a str,
    piece: &Piece,
    loads: &Loads,
    along: Option<Vec<Ron>>,
) {
    let ends = piece.at_nodes(loads);
    let springs = piece.fixity.iter().flatten().any(|k| *k != 0.0);
    match along.filter(|_| !springs) {
        Some(blocks) => {
            cx.patterns.entry(pattern).or_default();
            cx.draft.along.entry(pattern.into()).or_default().extend(blocks);
            for (node, f) in piece.nodes.into_iter().zip(ends) {
                let to = cx.spread.entry(pattern).or_default().entry(node).or_default();
                to.iter_mut().zip(f).for_each(|(a, b)| *a += b);
            }
        }
        None => {
            let what = "loads of a frame partly fixed to springs, or of warmth across it that varies, act as the joint \
                        forces that move the joints alike";
            cx.report.otherwise("FRAME LOADS", what, &piece.name);
            for (node, f) in piece.nodes.into_iter().zip(ends) {
                cx.add(pattern, node, f);
            }
        }
    }
}

/// Components in local axes that are more than rounding.
fn components(ends: [[f64; 6]; 2]) -> impl Iterator<Item = usize> {
    let size = ends.iter().flatten().fold(0.0, |a: f64, b| a.max(b.abs()));
    (0..6).filter(move |i| ends.iter().any(|f| f[*i].abs() > ROUNDING * size))
}

/// How the size of a load is named.
const fn sized(component: usize) -> &'static str {
    if component < 3 { "force" } else { "moment" }
}

/// A load per length between two distances from the start of a frame, straight between its ends.
fn spread<'a>(
    cx: &mut Context<'a>,
    pattern: &'a str,
    piece: &Piece,
    [from, to]: [f64; 2],
    ends: [[f64; 6]; 2],
) {
    let end = piece.start + piece.length;
    let (a, b) = (from.max(piece.start), to.min(end));
    let mut loads = Loads::default();
    piece.spread(&mut loads, [from, to], ends);
    if b - a <= 1e-9 * piece.length {
        return;
    }
    let at = |s: f64, i: usize| {
        let share = (s - from) / (to - from);
        ends[0][i] + share * (ends[1][i] - ends[0][i])
    };
    let place = |s: f64| (s - piece.start).clamp(0.0, piece.length);
    let whole = a == piece.start && b == end;
    let blocks = components(ends).map(|i| {
        let block = |kind: &str| {
            Ron::block(kind)
                .with("element", Ron::text(&piece.name))
                .with("axis", Ron::word(LOCAL[i]))
        };
        if whole && ends[0][i] == ends[1][i] {
            return block("Uniform").with(sized(i), ends[0][i]);
        }
        if i > 2 && ends[0][i] == ends[1][i] {
            return block("Uniform")
                .with(sized(i), ends[0][i])
                .with("from", place(a))
                .with("to", place(b));
        }
        let points = [a, b].map(|s| Ron::vector(&[place(s), at(s, i)])).to_vec();
        block("Trapezoid").with("points", Ron::List(points))
    });
    let blocks = blocks.collect();
    put(cx, pattern, piece, &loads, Some(blocks));
}

/// Reads all loads of frames, and the weight of frames in patterns with a multiplier for it.
pub fn loads<'a>(cx: &mut Context<'a>, frames: &Frames<'a>) {
    let db = cx.db;
    for row in db.rows(SPREAD) {
        let Some(frame) = frames.get(row.need("Frame")) else { continue };
        let Some(of) = direction(cx, row, frame) else { continue };
        let ends = [distance(row, frame, "A"), distance(row, frame, "B")];
        let keys = if row.text("Type") == Some("Moment") {
            ["MOverLA", "MOverLB"]
        } else {
            ["FOverLA", "FOverLB"]
        };
        let sizes = keys.map(|key| row.or_zero(key));
        let sizes = sizes.map(|x| of.map(|d| d * x));
        for piece in frame.pieces.iter().filter(|_| ends[1] > ends[0]) {
            spread(cx, row.need("LoadPat"), piece, ends, sizes);
        }
    }
    for row in db.rows(POINT) {
        let Some(frame) = frames.get(row.need("Frame")) else { continue };
        let Some(of) = direction(cx, row, frame) else { continue };
        let s = distance(row, frame, "");
        let key = if row.text("Type") == Some("Moment") { "Moment" } else { "Force" };
        let size = row.or_zero(key);
        let Some(at) = frame.pieces.iter().position(|p| s <= p.start + p.length) else { continue };
        let (piece, mut loads) = (&frame.pieces[at], Loads::default());
        let at = (s - piece.start).clamp(0.0, piece.length);
        let f = of.map(|d| d * size);
        piece.point(&mut loads, at, f);
        let blocks = components([f, f]).map(|i| {
            Ron::block("Point")
                .with("element", Ron::text(&piece.name))
                .with("at", at)
                .with("axis", Ron::word(LOCAL[i]))
                .with(sized(i), f[i])
        });
        let blocks = blocks.collect();
        put(cx, row.need("LoadPat"), piece, &loads, Some(blocks));
    }
    warm(cx, frames);
    for row in db.rows(OWN) {
        let Some(frame) = frames.get(row.need("Frame")) else { continue };
        let axes = cx.system(row, GLOBAL);
        let own = ["MultiplierX", "MultiplierY", "MultiplierZ"].map(|key| row.or_zero(key));
        weight(cx, row.need("LoadPat"), frame, super::geometry::to_global(&axes, own));
    }
    for row in db.rows("LOAD PATTERN DEFINITIONS") {
        let (pattern, times) = (row.need("LoadPat"), row.or_zero("SelfWtMult"));
        cx.patterns.entry(pattern).or_default();
        if row.text("AutoLoad").is_some_and(|auto| auto != "None") {
            cx.report.lose(
                "LOAD PATTERN DEFINITIONS: AutoLoad",
                "loads that it makes by a code",
                pattern,
            );
        }
        if times != 0.0 {
            frames.values().for_each(|frame| weight(cx, pattern, frame, [0.0, 0.0, -times]));
        }
    }
    if cx.draft.along.values().any(|all| !all.is_empty()) {
        let what = "loads along frames act along their beams: MemberForce counts them, ElementForce is that of the \
                    deformation";
        cx.report.otherwise("FRAME LOADS", what, "");
    }
}

/// The weight of a frame times a vector.
fn weight<'a>(cx: &mut Context<'a>, pattern: &'a str, frame: &Frame, times: Vector) {
    for piece in &frame.pieces {
        let [a, b, c] = to_local(&piece.axes, times).map(|x| x * piece.section.weight);
        let f = [a, b, c, 0.0, 0.0, 0.0];
        if f != [0.0; 6] {
            spread(cx, pattern, piece, [piece.start, piece.start + piece.length], [f, f]);
        }
    }
}

/// Reads warmth, straight between joints where it follows a pattern of theirs.
fn warm<'a>(cx: &mut Context<'a>, frames: &Frames<'a>) {
    let mut values: HashMap<(&str, usize), f64> = HashMap::new();
    for row in cx.db.rows("JOINT PATTERN ASSIGNMENTS") {
        if let Some(node) = cx.joint(row, "Joint") {
            values.insert((row.need("Pattern"), node), row.need_number("Value"));
        }
    }
    for row in cx.db.rows(WARMTH) {
        let Some(frame) = frames.get(row.need("Frame")) else { continue };
        let at = match row.text("Type") {
            Some("Gradient2") => 1,
            Some("Gradient3") => 2,
            _ => 0,
        };
        let size = row.or_zero(["Temp", "TempGrad2", "TempGrad3"][at]);
        let pattern = row.text("JtPattern").filter(|p| *p != "None");
        let (first, last) = (frame.pieces.first(), frame.pieces.last());
        let (Some(first), Some(last)) = (first, last) else { continue };
        let ends = [first.nodes[0], last.nodes[1]].map(|node| match pattern {
            None => size,
            Some(p) => size * values.get(&(p, node)).copied().unwrap_or(0.0),
        });
        let value = |s: f64| {
            let mut v = [0.0; 3];
            v[at] = ends[0] + (ends[1] - ends[0]) * s / frame.length;
            v
        };
        for piece in &frame.pieces {
            let both = [value(piece.start), value(piece.start + piece.length)];
            let mut loads = Loads::default();
            piece.warmth(&mut loads, both);
            // The mean counts for what is warm as a whole.
            let mean = (both[0][at] + both[1][at]) / 2.0;
            let said = (at == 0 || both[0] == both[1]).then(|| {
                let key = ["rise", "gradient_2", "gradient_3"][at];
                vec![
                    Ron::block("Temperature")
                        .with("element", Ron::text(&piece.name))
                        .with(key, mean),
                ]
            });
            put(
                cx,
                row.need("LoadPat"),
                piece,
                &loads,
                said.filter(|_| piece.section.expansion != 0.0),
            );
        }
    }
}

/// Forces that displacements of the ground put on the frames, with the other sign.
pub fn ground(cx: &mut Context<'_>, frames: &Frames<'_>) {
    let patterns: Vec<_> = cx.ground.iter().map(|(p, all)| (*p, all.clone())).collect();
    for (pattern, moved) in patterns {
        let moved: HashMap<usize, [f64; 6]> = (moved.into_iter())
            .map(|(node, u)| {
                let held = cx.draft.supports.get(&node).copied().unwrap_or_default();
                (node, std::array::from_fn(|i| if held[i] { u[i] } else { 0.0 }))
            })
            .collect();
        for piece in frames.values().flat_map(|f| &f.pieces) {
            if !piece.nodes.iter().any(|n| moved.contains_key(n)) {
                continue;
            }
            let u = piece.nodes.map(|n| moved.get(&n).copied().unwrap_or_default());
            let forces = piece.forces(&u);
            for (node, f) in piece.nodes.into_iter().zip(forces) {
                cx.add(pattern, node, f.map(|x| -x));
            }
        }
    }
}
