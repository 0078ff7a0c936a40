//! Frames: connectivity, meshing, releases, offsets.

use super::beams::write;
use super::context::Context;
use super::database::Entry;
use super::geometry::{along, is_along_global, line_axes, norm, sub};
use super::joints;
use super::piece::Piece;
use super::placement::{cuts, inserted, on_joint};
use super::section::{Section, Sections};
use crate::ron::Ron;
use std::collections::{BTreeMap, HashMap};

/// Parts of every stretch of a section that varies.
const PARTS: usize = 16;

/// A frame and the pieces it is made of.
pub struct Frame {
    pub length: f64,
    pub pieces: Vec<Piece>,
}

/// Frames by name.
pub type Frames<'a> = BTreeMap<&'a str, Frame>;

/// Rows of a table by a name.
fn by<'a>(cx: &Context<'a>, table: &str, key: &'static str) -> HashMap<&'a str, Entry<'a>> {
    cx.db.rows(table).map(|row| (row.need(key), row)).collect()
}

/// What the tables say of frames.
struct Tables<'a> {
    assigned: HashMap<&'a str, Entry<'a>>,
    modifiers: HashMap<&'a str, Entry<'a>>,
    angles: HashMap<&'a str, Entry<'a>>,
    mesh: HashMap<&'a str, Entry<'a>>,
    insertion: HashMap<&'a str, Entry<'a>>,
    offsets: HashMap<&'a str, Entry<'a>>,
    releases: HashMap<&'a str, Entry<'a>>,
    fixity: HashMap<&'a str, Entry<'a>>,
    added: HashMap<&'a str, f64>,
}

/// Reads frames into pieces; their beams are written with them.
pub fn frames<'a>(cx: &mut Context<'a>, sections: &Sections<'a>) -> Frames<'a> {
    let tables = Tables {
        assigned: by(cx, "FRAME SECTION ASSIGNMENTS", "Frame"),
        modifiers: by(cx, "FRAME PROPERTY MODIFIERS", "Frame"),
        angles: by(cx, "FRAME LOCAL AXES ASSIGNMENTS 1 - TYPICAL", "Frame"),
        mesh: by(cx, "FRAME AUTO MESH ASSIGNMENTS", "Frame"),
        insertion: by(cx, "FRAME INSERTION POINT ASSIGNMENTS", "Frame"),
        offsets: by(cx, "FRAME OFFSET ALONG LENGTH ASSIGNMENTS", "Frame"),
        releases: by(cx, "FRAME RELEASE ASSIGNMENTS 1 - GENERAL", "Frame"),
        fixity: by(cx, "FRAME RELEASE ASSIGNMENTS 2 - PARTIAL FIXITY", "Frame"),
        added: (cx.db.rows("FRAME ADDED MASS ASSIGNMENTS"))
            .map(|row| (row.need("Frame"), row.need_number("MassPerLen")))
            .collect(),
    };
    let joints = cx.draft.nodes.len();
    let mut out = Frames::new();
    for row in cx.db.rows("CONNECTIVITY - FRAME") {
        let name = row.need("Frame");
        let (Some(i), Some(j)) = (cx.joint(row, "JointI"), cx.joint(row, "JointJ")) else {
            continue;
        };
        if row.yes("IsCurved") {
            cx.report.lose("CONNECTIVITY - FRAME", "a curved frame is taken straight", name);
        }
        if let Some(frame) = frame(cx, &tables, sections, row, name, [i, j], joints)
            && out.insert(name, frame).is_some()
        {
            let message = format!("there are two frames \"{name}\"");
            row.wrong(&message, "every frame has a name of its own");
        }
    }
    joints::hold_new_nodes(cx, joints);
    out
}

fn frame<'a>(
    cx: &mut Context<'a>,
    tables: &Tables<'a>,
    sections: &Sections<'a>,
    row: Entry<'a>,
    name: &'a str,
    ends: [usize; 2],
    joints: usize,
) -> Option<Frame> {
    let Some(assigned) = tables.assigned.get(name) else {
        cx.report.lose("CONNECTIVITY - FRAME", "a frame without a section is not written", name);
        return None;
    };
    let section = assigned.need("AnalSect");
    if !sections.has(section) {
        if section == "None" {
            cx.report.lose(
                "FRAME SECTION ASSIGNMENTS",
                "a frame without a section is not written",
                name,
            );
        } else {
            let message = format!("there is no section \"{section}\"");
            assigned.wrong_at("AnalSect", &message, "they stand in FRAME SECTION PROPERTIES 01");
        }
        return None;
    }
    let material = assigned.text("MatProp").filter(|m| *m != "Default");
    assigned.text("NPSectType");
    assigned.number("NPSectLen");
    assigned.number("NPSectRD");
    let angle = tables.angles.get(name).map_or(0.0, |row| row.or_zero("Angle"));
    let positions = ends.map(|n| cx.at(n));
    if norm(sub(positions[1], positions[0])) == 0.0 {
        row.wrong("both joints of this frame are at the same place", "");
        return None;
    }
    let size = match sections.varies(section) {
        true => [0.0; 2],
        false => sections.get(cx, section, material).map_or([0.0; 2], |s| s.size),
    };
    let (nodes, at) = inserted(cx, tables.insertion.get(name).copied(), name, ends, angle, size);
    let axes = line_axes(at[0], at[1], angle);
    let length = norm(sub(at[1], at[0]));
    if !(length > 0.0 && length.is_finite()) {
        row.wrong("this frame has no length, or one beyond all bounds", "");
        return None;
    }
    let mut cuts = cuts(cx, tables.mesh.get(name).copied(), name, at, joints)?;
    let stretches = sections.stretches(cx, section, length);
    if let Some(stretches) = &stretches {
        let what =
            "a section that varies is cut into sixteen parts each stretch, and its mass with them";
        cx.report.otherwise("FRAME SECTION PROPERTIES 05 - NONPRISMATIC", what, name);
        for ([from, to], ..) in stretches {
            cuts.extend((0..PARTS).map(|k| from + (to - from) * k as f64 / PARTS as f64));
        }
        cuts.sort_by(f64::total_cmp);
        cuts.dedup_by(|a, b| *a - *b < 1e-9 * length);
    }
    let at_middle = |cx: &mut Context<'a>, s: f64| match &stretches {
        None => sections.get(cx, section, material),
        Some(all) => {
            let ([from, to], [a, b], powers) =
                all.iter().find(|(ends, ..)| s <= ends[1]).or(all.last())?;
            Some(Section::between(a, b, (s - from) / (to - from), *powers))
        }
    };
    let mut points = vec![nodes[0]];
    for (k, s) in cuts.iter().enumerate().skip(1) {
        let here = along(at[0], *s, axes[0]);
        let joint = on_joint(cx, joints, here, length);
        let last = k + 1 == cuts.len();
        points.push(match joint.filter(|_| nodes == ends) {
            _ if last => nodes[1],
            Some(joint) => joint,
            None => cx.new_node(&format!("{name}.{k}"), here),
        });
    }
    let count = cuts.len() - 1;
    let mut pieces = Vec::new();
    for k in 0..count {
        let (from, to) = (cuts[k], cuts[k + 1]);
        let mut part = at_middle(cx, (from + to) / 2.0)?;
        if let Some(row) = tables.modifiers.get(name) {
            part.modify(*row);
        }
        part.mass += tables.added.get(name).copied().unwrap_or(0.0);
        if part.area <= 0.0 || part.young <= 0.0 {
            cx.report.lose(
                "FRAME SECTION ASSIGNMENTS",
                "a frame without area is not written",
                name,
            );
            return None;
        }
        let name =
            if count == 1 { format!("frame {name}") } else { format!("frame {name}/{}", k + 1) };
        let nodes = [points[k], points[k + 1]];
        pieces.push(Piece {
            name,
            at: [along(at[0], from, axes[0]), along(at[0], to, axes[0])],
            nodes,
            axes,
            section: part,
            start: from,
            length: to - from,
            rigid: [0.0; 2],
            released: [[false; 6]; 2],
            fixity: [[0.0; 6]; 2],
        });
    }
    ended(cx, tables, name, &mut pieces)?;
    for piece in &mut pieces {
        write(cx, piece, section, angle);
    }
    Some(Frame { length, pieces })
}

/// Offsets along the length, releases and partial fixity of the outer ends.
fn ended(
    cx: &mut Context<'_>,
    tables: &Tables<'_>,
    name: &str,
    pieces: &mut [Piece],
) -> Option<()> {
    let last = pieces.len() - 1;
    if let Some(row) = tables.offsets.get(name) {
        row.text("Type");
        let factor = row.or_zero("RigidFactor");
        pieces[0].rigid[0] = factor * row.or_zero("LengthI");
        pieces[last].rigid[1] = factor * row.or_zero("LengthJ");
        let short = [0, last].into_iter().any(|k| {
            let [i, j] = pieces[k].rigid;
            i < 0.0 || j < 0.0 || i + j >= pieces[k].length
        });
        if short {
            row.wrong("the rigid lengths leave nothing of this frame, or are below zero", "");
            return None;
        }
    }
    let keys = [["PI", "V2I", "V3I", "TI", "M2I", "M3I"], ["PJ", "V2J", "V3J", "TJ", "M2J", "M3J"]];
    for (end, at) in [(0, 0), (1, last)] {
        if let Some(row) = tables.releases.get(name) {
            pieces[at].released[end] = keys[end].map(|key| row.yes(key));
        }
        if let Some(row) = tables.fixity.get(name) {
            let fixity = keys[end].map(|key| row.or_zero(key));
            let piece = &mut pieces[at];
            if fixity.iter().all(|k| *k == 0.0) {
                continue;
            }
            if piece.rigid[end] != 0.0 || !is_along_global(&piece.axes) {
                let what = "partial fixity of a frame that is askew or has a rigid end: released";
                cx.report.lose("FRAME RELEASE ASSIGNMENTS 2 - PARTIAL FIXITY", what, name);
                continue;
            }
            piece.fixity[end] = fixity;
        }
    }
    Some(())
}

/// Springs along frames, gathered at the ends of their pieces.
pub fn springs(cx: &mut Context<'_>, frames: &Frames<'_>) {
    const TABLE: &str = "FRAME SPRING ASSIGNMENTS";
    for row in cx.db.rows(TABLE) {
        let name = row.need("Frame");
        let Some(frame) = frames.get(name) else { continue };
        let dir =
            row.text("Dir").and_then(|d| d.parse::<usize>().ok()).filter(|d| (1..=3).contains(d));
        let plain = row.text("Type") == Some("Simple")
            && row.text("SimpleType").is_none_or(|t| t == "Tension and Compression")
            && row.text("Dir1Type").is_none_or(|t| t == "Object Axes");
        let (Some(dir), true) = (dir, plain) else {
            cx.report.lose(TABLE, "springs other than simple ones along local axes", name);
            continue;
        };
        let k = row.need_number("Stiffness");
        cx.report.otherwise(TABLE, "springs along a frame stand at the ends of its pieces", name);
        for piece in &frame.pieces {
            for (end, side) in ["i", "j"].into_iter().enumerate() {
                let block = Ron::block("Spring")
                    .with("node", Ron::text(cx.name(piece.nodes[end])))
                    .with("k1", k * piece.length / 2.0)
                    .with("axis1", Ron::vector(&piece.axes[dir - 1]))
                    .with("axis2", Ron::vector(&piece.axes[dir % 3]));
                cx.draft.elements.push((format!("{} bed {dir}{side}", piece.name), block));
            }
        }
    }
}

/// Largest stiffness of the frames against a length and against a turn, for supports that are to be rigid.
pub fn stiffest(frames: &Frames<'_>) -> [f64; 2] {
    let pieces = || frames.values().flat_map(|f| &f.pieces);
    let largest = |value: &dyn Fn(&Piece) -> f64| pieces().map(value).fold(0.0, f64::max);
    let direct = largest(&|p| p.section.young * p.section.area / p.length);
    let turn =
        largest(&|p| p.section.young * p.section.moments[0].max(p.section.moments[1]) / p.length);
    [direct, turn].map(|k| if k > 0.0 { k } else { 1.0 })
}

/// Puts the masses of frames at the ends of their pieces, and takes them out of the beams.
pub fn lumped(cx: &mut Context<'_>, frames: &Frames<'_>, masses: &mut joints::Masses) {
    for piece in frames.values().flat_map(|f| &f.pieces) {
        for node in piece.nodes {
            let to = masses.entry(node).or_default();
            (0..3).for_each(|k| to[k] += piece.section.mass * piece.length / 2.0);
        }
    }
    masses_out(cx);
}

/// Masses that frames have; taken out of their beams where the mass source leaves elements out.
pub fn masses_out(cx: &mut Context<'_>) {
    for (_, set) in &mut cx.draft.properties {
        if let Ron::Block(kind, fields) = set
            && kind == "Beam"
        {
            fields.retain(|(name, _)| name != "distributed_mass");
        }
    }
}
