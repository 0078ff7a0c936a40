//! Loads of frames, as forces of their nodes that do the same.

use super::context::Context;
use super::database::Entry;
use super::frames::{Frame, Frames};
use super::geometry::{GLOBAL, Vector, cross, norm, to_local};
use super::piece::{Loads, Piece};
use std::collections::HashMap;

const SPREAD: &str = "FRAME LOADS - DISTRIBUTED";
const POINT: &str = "FRAME LOADS - POINT";
const WARMTH: &str = "FRAME LOADS - TEMPERATURE";
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

fn put<'a>(cx: &mut Context<'a>, pattern: &'a str, piece: &Piece, loads: &Loads) {
    let ends = piece.at_nodes(loads);
    for (node, f) in piece.nodes.into_iter().zip(ends) {
        cx.add(pattern, node, f);
    }
}

fn each<'a>(cx: &mut Context<'a>, row: Entry<'a>, frame: &Frame, act: impl Fn(&Piece, &mut Loads)) {
    let pattern = row.need("LoadPat");
    for piece in &frame.pieces {
        let mut loads = Loads::default();
        act(piece, &mut loads);
        put(cx, pattern, piece, &loads);
    }
}

/// Reads all loads of frames, and the weight of frames in patterns with a multiplier for it.
pub fn loads<'a>(cx: &mut Context<'a>, frames: &Frames<'a>) {
    let db = cx.db;
    let mut count = 0;
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
        each(cx, row, frame, |p, l| p.spread(l, ends, sizes.map(|x| of.map(|d| d * x))));
        count += 1;
    }
    for row in db.rows(POINT) {
        let Some(frame) = frames.get(row.need("Frame")) else { continue };
        let Some(of) = direction(cx, row, frame) else { continue };
        let s = distance(row, frame, "");
        let key = if row.text("Type") == Some("Moment") { "Moment" } else { "Force" };
        let size = row.or_zero(key);
        let Some(at) = frame.pieces.iter().position(|p| s <= p.start + p.length) else { continue };
        let (piece, mut loads) = (&frame.pieces[at], Loads::default());
        piece.point(&mut loads, s - piece.start, of.map(|d| d * size));
        put(cx, row.need("LoadPat"), piece, &loads);
        count += 1;
    }
    count += warm(cx, frames);
    for row in db.rows(OWN) {
        let Some(frame) = frames.get(row.need("Frame")) else { continue };
        let axes = cx.system(row, GLOBAL);
        let own = ["MultiplierX", "MultiplierY", "MultiplierZ"].map(|key| row.or_zero(key));
        weight(cx, row.need("LoadPat"), frame, super::geometry::to_global(&axes, own));
        count += 1;
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
            count += frames.len();
        }
    }
    if count > 0 {
        let what = "loads between the joints of frames act as the joint forces that move the joints alike; \
                    forces inside frames (ElementForce) lack the part of a frame held at both ends";
        for _ in 0..count {
            cx.report.otherwise("FRAME LOADS", what, "");
        }
    }
}

/// The weight of a frame times a vector.
fn weight<'a>(cx: &mut Context<'a>, pattern: &'a str, frame: &Frame, times: Vector) {
    for piece in &frame.pieces {
        let [a, b, c] = to_local(&piece.axes, times).map(|x| x * piece.section.weight);
        let f = [a, b, c, 0.0, 0.0, 0.0];
        let mut loads = Loads::default();
        piece.spread(&mut loads, [piece.start, piece.start + piece.length], [f, f]);
        put(cx, pattern, piece, &loads);
    }
}

/// Reads warmth, straight between joints where it follows a pattern of theirs.
fn warm<'a>(cx: &mut Context<'a>, frames: &Frames<'a>) -> usize {
    let mut values: HashMap<(&str, usize), f64> = HashMap::new();
    for row in cx.db.rows("JOINT PATTERN ASSIGNMENTS") {
        if let Some(node) = cx.joint(row, "Joint") {
            values.insert((row.need("Pattern"), node), row.need_number("Value"));
        }
    }
    let mut count = 0;
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
        each(cx, row, frame, |piece, loads| {
            let value = |s: f64| {
                let mut v = [0.0; 3];
                v[at] = ends[0] + (ends[1] - ends[0]) * s / frame.length;
                v
            };
            piece.warmth(loads, [value(piece.start), value(piece.start + piece.length)]);
        });
        count += 1;
    }
    count
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
