//! Where the beams of a frame lie: insertion points, and cuts of the automatic mesh.

use super::context::Context;
use super::database::Entry;
use super::geometry::{Vector, along, cross, dot, line_axes, norm, sub, to_global, unit};
use crate::ron::Ron;

/// Most pieces of a frame.
const MOST: f64 = 10_000.0;

/// Distances along a frame at which it is cut, ends included.
pub fn cuts(
    cx: &mut Context<'_>,
    row: Option<Entry<'_>>,
    name: &str,
    at: [Vector; 2],
    joints: usize,
) -> Option<Vec<f64>> {
    let length = norm(sub(at[1], at[0]));
    let mut cuts = vec![0.0, length];
    let Some(row) = row.filter(|row| row.yes("AutoMesh")) else { return Some(cuts) };
    if row.yes("AtJoints") {
        let one = unit(sub(at[1], at[0]));
        for (_, p) in &cx.draft.nodes[..joints] {
            let away = sub(*p, at[0]);
            let s = dot(away, one);
            if norm(cross(away, one)) < 1e-6 * length
                && s > 1e-6 * length
                && s < (1.0 - 1e-6) * length
            {
                cuts.push(s);
            }
        }
        cuts.sort_by(f64::total_cmp);
        cuts.dedup_by(|a, b| *a - *b < 1e-6 * length);
    }
    if row.yes("AtFrames") {
        let what = "frames that cross without a joint are not joined";
        cx.report.lose("FRAME AUTO MESH ASSIGNMENTS: AtFrames", what, name);
    }
    let longest = row.or_zero("MaxLength");
    let parts =
        row.or_zero("NumSegments").max(if longest > 0.0 { (length / longest).ceil() } else { 1.0 });
    if parts.is_nan() || parts >= MOST {
        row.wrong(&format!("{parts} pieces of a frame"), "at most 10000");
        return None;
    }
    if parts > 1.0 {
        let whole = cuts.clone();
        for w in whole.windows(2) {
            let own = (parts * (w[1] - w[0]) / length - 1e-9).ceil().max(1.0);
            cuts.extend((1..own as usize).map(|k| w[0] + (w[1] - w[0]) * k as f64 / own));
        }
        cuts.sort_by(f64::total_cmp);
    }
    Some(cuts)
}

pub fn on_joint(cx: &Context<'_>, joints: usize, at: Vector, length: f64) -> Option<usize> {
    cx.draft.nodes[..joints].iter().position(|(_, p)| norm(sub(*p, at)) < 1e-6 * length)
}

/// The nodes and positions of the ends of the beam: the joints, or nodes off them that follow them.
pub fn inserted(
    cx: &mut Context<'_>,
    row: Option<Entry<'_>>,
    name: &str,
    ends: [usize; 2],
    angle: f64,
    [height, width]: [f64; 2],
) -> ([usize; 2], [Vector; 2]) {
    let at = ends.map(|n| cx.at(n));
    let Some(row) = row else { return (ends, at) };
    let axes = line_axes(at[0], at[1], angle);
    let keys =
        [["JtOffsetXI", "JtOffsetYI", "JtOffsetZI"], ["JtOffsetXJ", "JtOffsetYJ", "JtOffsetZJ"]];
    let own = keys.map(|keys| keys.map(|key| row.or_zero(key)));
    let system = row.text("CoordSys").unwrap_or("GLOBAL");
    let offsets = own.map(|o| match (system, cx.systems.get(system)) {
        ("Local", _) => to_global(&axes, o),
        (_, Some((_, axes))) => to_global(axes, o),
        _ => o,
    });
    let cardinal = row.text("CardinalPt").unwrap_or("10");
    let number: usize =
        cardinal.split_whitespace().next().and_then(|n| n.parse().ok()).unwrap_or(10);
    if row.yes("Mirror2") || row.yes("Mirror3") {
        cx.report.lose("FRAME INSERTION POINT ASSIGNMENTS", "a mirrored section", name);
    }
    // From the point to the centroid, of a section that is the same either way: 3 points left.
    let [up, left] = match number {
        1..=9 => [1.0 - ((number - 1) / 3) as f64, ((number - 1) % 3) as f64 - 1.0],
        _ => [0.0; 2],
    };
    let shift = along(along([0.0; 3], up * height / 2.0, axes[1]), left * width / 2.0, axes[2]);
    let moved = offsets.map(|o| along(o, 1.0, shift));
    let transform = row.yes("Transform");
    if moved.iter().flatten().all(|x| *x == 0.0) {
        return (ends, at);
    }
    if !transform {
        // The stiffness is that of a frame from joint to joint.
        let what = "an insertion point that is not to transform the stiffness moves nothing";
        cx.report.otherwise("FRAME INSERTION POINT ASSIGNMENTS", what, name);
        return (ends, at);
    }
    let mut nodes = ends;
    let mut places = at;
    for (k, side) in ["i", "j"].into_iter().enumerate() {
        if moved[k].iter().all(|x| *x == 0.0) {
            continue;
        }
        places[k] = along(at[k], 1.0, moved[k]);
        nodes[k] = cx.new_node(&format!("{name}.{side}"), places[k]);
        let pair = vec![Ron::text(cx.name(ends[k])), Ron::text(cx.name(nodes[k]))];
        let link = Ron::block("RigidLink").with("nodes", Ron::Tuple(pair));
        cx.draft.elements.push((format!("offset {name}.{side}"), link));
    }
    (nodes, places)
}
