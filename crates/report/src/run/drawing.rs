//! The model as a still picture.

use super::data::{Family, LineKind, Picture, RunData};
use super::units::short;
use crate::Drawing;
use std::fmt::Write;

/// Size of the picture, px, and the margin.
const SIZE: (f64, f64) = (1120.0, 460.0);
const MARGIN: f64 = 46.0;
/// More names than this are not written.
const NAMES: usize = 60;
/// Of more lines than this the picture is coarser, and they are thinner; the script does the same.
const DENSE: usize = 800;
/// Nor are more nodes marked.
const DOTS: usize = 300;
/// Azimuth and elevation from which models in space are seen, rad.
const VIEW: (f64, f64) = (0.52, 0.35);

/// From points in space to the sheet: right and up, unit vectors.
fn axes(picture: &Picture) -> [[f64; 3]; 2] {
    match picture.plane.as_deref() {
        Some("XZ") => [[1.0, 0.0, 0.0], [0.0, 0.0, 1.0]],
        Some("YZ") => [[0.0, 1.0, 0.0], [0.0, 0.0, 1.0]],
        Some("XY") => [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0]],
        _ => {
            let ((sa, ca), (se, ce)) = (VIEW.0.sin_cos(), VIEW.1.sin_cos());
            [[ca, -sa, 0.0], [sa * se, ca * se, ce]]
        }
    }
}

fn dot(a: [f64; 3], b: [f64; 3]) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

/// The frame with the largest displacement, and the factor that makes it visible.
pub(crate) fn largest(data: &RunData) -> Option<(usize, f64)> {
    let n = data.picture.points.len();
    let size = |frame: usize| {
        let moved = (0..n).map(|p| data.frames.at(frame, n, p));
        moved.map(|u| dot(u, u)).fold(0.0, f64::max).sqrt()
    };
    let sizes: Vec<f64> = (0..data.frames.t.len()).map(size).collect();
    let (frame, most) =
        sizes.iter().enumerate().fold((0, 0.0), |a, (i, s)| if *s > a.1 { (i, *s) } else { a });
    (most > 0.0).then(|| (frame, scale(&data.picture, most)))
}

/// The displacements of all points in a frame, m, times a factor.
pub(crate) fn displaced(data: &RunData, frame: usize, factor: f64) -> Vec<[f64; 3]> {
    let n = data.picture.points.len();
    (0..n).map(|p| data.frames.at(frame, n, p).map(|u| u * factor)).collect()
}

/// The model where it has moved most, with itself at rest in grey; at rest where it does not move.
pub(crate) fn still(data: &RunData) -> Drawing {
    let (moved, title) = match largest(data) {
        None => (Vec::new(), "The model".to_owned()),
        Some((frame, factor)) => {
            let times = if factor == 1.0 {
                String::new()
            } else {
                format!(", {} times as much", short(factor, 3))
            };
            let title = format!("The model at {} s{times}", short(data.frames.t[frame], 5));
            (displaced(data, frame, factor), title)
        }
    };
    let (w, h) = SIZE;
    let sized = format!("<svg width=\"{w}\" height=\"{h}\" ");
    let paper = format!("</title>\n<rect width=\"{w}\" height=\"{h}\" fill=\"#ffffff\"/>\n");
    let svg = svg(data, &moved, &title, false);
    let svg = svg.replacen("<svg ", &sized, 1).replacen("</title>\n", &paper, 1);
    Drawing::new(svg, (w as u32, h as u32))
}

/// 1 where motion can be seen as it is; else 2, 5, 10 … so that it is about 8 % of the model.
pub(crate) fn scale(picture: &Picture, most: f64) -> f64 {
    let share = most / extent(picture).max(1e-12);
    if share > 0.02 {
        return 1.0;
    }
    let wanted = 0.08 / share;
    let decade = 10f64.powf(wanted.log10().floor());
    [5.0, 2.0, 1.0].iter().map(|k| k * decade).find(|k| *k <= wanted).unwrap_or(decade)
}

/// A mode shape as displacements that can be seen, m.
pub(crate) fn mode(data: &RunData, mode: usize, points: usize) -> Vec<[f64; 3]> {
    let Some(mode) = data.modes.get(mode) else { return Vec::new() };
    let u: Vec<f64> = mode.u.values().collect();
    let at = |p: usize| [0, 1, 2].map(|i| u.get(3 * p + i).copied().unwrap_or(0.0));
    let most = (0..points).map(|p| dot(at(p), at(p))).fold(0.0, f64::max).sqrt();
    let scale = if most > 0.0 { 0.12 * extent(&data.picture) / most } else { 0.0 };
    (0..points).map(|p| at(p).map(|x| x * scale)).collect()
}

/// Longest side of the box around a picture, m.
pub(crate) fn extent(picture: &Picture) -> f64 {
    let side = |i: usize| {
        let all = picture.points.iter().map(|p| p[i]);
        let (low, high) =
            all.fold((f64::INFINITY, f64::NEG_INFINITY), |(a, b), x| (a.min(x), b.max(x)));
        if high > low { high - low } else { 0.0 }
    };
    (0..3).map(side).fold(0.0, f64::max).max(1e-9)
}

/// The model at rest, or moved, with itself at rest in grey beneath; with the names of its nodes if wanted.
pub(crate) fn svg(data: &RunData, moved: &[[f64; 3]], title: &str, names: bool) -> String {
    picture(data, moved, title, names, true)
}

/// The shape of a mode. Beneath that of a large model its rest would only be a grey block.
pub(crate) fn mode_svg(data: &RunData, moved: &[[f64; 3]], title: &str) -> String {
    picture(data, moved, title, false, data.picture.lines.len() <= DENSE)
}

fn picture(data: &RunData, moved: &[[f64; 3]], title: &str, names: bool, ghost: bool) -> String {
    let picture = &data.picture;
    let [right, up] = axes(picture);
    let flat = |p: [f64; 3]| (dot(p, right), dot(p, up));
    let now: Vec<(f64, f64)> = picture
        .points
        .iter()
        .enumerate()
        .map(|(i, p)| {
            let u = moved.get(i).copied().unwrap_or_default();
            flat([p[0] + u[0], p[1] + u[1], p[2] + u[2]])
        })
        .collect();
    let rest: Vec<(f64, f64)> = picture.points.iter().map(|p| flat(*p)).collect();
    let all = || now.iter().chain(&rest);
    let fold = |of: fn(&(f64, f64)) -> f64| {
        all().map(of).fold((f64::INFINITY, f64::NEG_INFINITY), |(a, b), x| (a.min(x), b.max(x)))
    };
    let ((x0, x1), (y0, y1)) = (fold(|p| p.0), fold(|p| p.1));
    let (w, h) = ((x1 - x0).max(1e-9), (y1 - y0).max(1e-9));
    let k = ((SIZE.0 - 2.0 * MARGIN) / w).min((SIZE.1 - 2.0 * MARGIN) / h);
    let (mx, my) = (0.5 * (x0 + x1), 0.5 * (y0 + y1));
    let px = |p: (f64, f64)| (SIZE.0 / 2.0 + k * (p.0 - mx), SIZE.1 / 2.0 - k * (p.1 - my));
    let mut out = format!(
        "<svg role=\"img\" viewBox=\"0 0 {} {}\" xmlns=\"http://www.w3.org/2000/svg\" \
         font-family=\"sans-serif\" font-size=\"12\">\n<title>{}</title>\n",
        SIZE.0,
        SIZE.1,
        escaped(title)
    );
    if let (Some(z), Some(_)) = (picture.ground, &picture.plane) {
        let (_, y) = px(flat([0.0, 0.0, z]));
        let _ = writeln!(
            out,
            "<path d=\"M0 {y:.1}H{}\" stroke=\"#777\"/><rect y=\"{y:.1}\" width=\"{}\" height=\"6\" fill=\"#ddd\"/>",
            SIZE.0, SIZE.0
        );
    }
    if !moved.is_empty() && ghost {
        shape(&mut out, picture, &rest, &px, true);
    }
    shape(&mut out, picture, &now, &px, false);
    marks(&mut out, picture, &now, &px, names);
    out + "</svg>\n"
}

type Place<'a> = &'a dyn Fn((f64, f64)) -> (f64, f64);

/// Faces and lines.
fn shape(out: &mut String, picture: &Picture, at: &[(f64, f64)], px: Place<'_>, ghost: bool) {
    for face in &picture.faces {
        let corners: Vec<String> = face
            .corners
            .iter()
            .filter_map(|c| at.get(*c))
            .map(|p| px(*p))
            .map(|(x, y)| format!("{x:.1},{y:.1}"))
            .collect();
        let style = match ghost {
            true => "fill=\"none\" stroke=\"#bbb\"",
            false => {
                "fill=\"#0072b2\" fill-opacity=\".12\" stroke=\"#0072b2\" stroke-width=\"1.5\""
            }
        };
        let _ = writeln!(out, "<polygon points=\"{}\" {style}/>", corners.join(" "));
    }
    let dense = picture.lines.len() > DENSE;
    // One path for all lines of a sort: a large frame has thousands.
    for what in [LineKind::Member, LineKind::Tie, LineKind::Edge] {
        let mut d = String::new();
        for line in picture.lines.iter().filter(|l| l.what == what) {
            let [Some(from), Some(to)] = line.ends.map(|end| at.get(end)) else { continue };
            let ((x1, y1), (x2, y2)) = (px(*from), px(*to));
            if dense {
                let [x1, y1, x2, y2] = [x1, y1, x2, y2].map(|x| x.round() as i64);
                let _ = write!(d, "M{x1} {y1}l{} {}", x2 - x1, y2 - y1);
            } else {
                let _ = write!(d, "M{x1:.1} {y1:.1}L{x2:.1} {y2:.1}");
            }
        }
        let style = match (ghost, what) {
            (true, _) => "stroke=\"#ccc\"",
            (_, LineKind::Member) if dense => "stroke=\"#0072b2\" stroke-width=\"0.6\"",
            (_, LineKind::Member) => "stroke=\"#0072b2\" stroke-width=\"2\"",
            (_, LineKind::Tie) => "stroke=\"#999\" stroke-dasharray=\"3 3\"",
            (_, LineKind::Edge) => "stroke=\"#0072b2\"",
        };
        if !d.is_empty() {
            let _ = writeln!(out, "<path d=\"{d}\" fill=\"none\" {style}/>");
        }
    }
}

/// Links, supports, nodes and names.
fn marks(out: &mut String, picture: &Picture, at: &[(f64, f64)], px: Place<'_>, names: bool) {
    for link in picture.links.iter().filter(|l| !l.body) {
        let ends: Vec<(f64, f64)> =
            link.ends.iter().filter_map(|e| at.get(*e)).map(|p| px(*p)).collect();
        let n = ends.len().max(1) as f64;
        let (x, y) =
            (ends.iter().map(|p| p.0).sum::<f64>() / n, ends.iter().map(|p| p.1).sum::<f64>() / n);
        for pair in ends.windows(2) {
            let _ = writeln!(
                out,
                "<path d=\"M{:.1} {:.1}L{:.1} {:.1}\" stroke=\"#d55e00\" stroke-dasharray=\"5 2\"/>",
                pair[0].0, pair[0].1, pair[1].0, pair[1].1
            );
        }
        out.push_str(&symbol(link.family, x, y));
    }
    let write = names && picture.nodes.len() <= NAMES;
    let mut taken: Vec<[f64; 4]> = Vec::new();
    for node in &picture.nodes {
        let Some((x, y)) = at.get(node.at).map(|p| px(*p)) else { continue };
        if !node.fixed.is_empty() {
            let _ = writeln!(
                out,
                "<path d=\"M{x:.1} {y:.1}l-6 10h12z\" fill=\"none\" stroke=\"#333\"/>"
            );
        }
        if picture.nodes.len() > DOTS {
            continue;
        }
        let _ = writeln!(out, "<circle cx=\"{x:.1}\" cy=\"{y:.1}\" r=\"2\" fill=\"#333\"/>");
        let free = write.then(|| place(&mut taken, &node.name, x, y)).flatten();
        if let Some((x, y)) = free {
            let name = escaped(&node.name);
            let _ = writeln!(out, "<text x=\"{x:.1}\" y=\"{y:.1}\" fill=\"#333\">{name}</text>");
        }
    }
}

/// Where a name beside a point covers no other: right or left, above or below; none: nowhere.
fn place(taken: &mut Vec<[f64; 4]>, name: &str, x: f64, y: f64) -> Option<(f64, f64)> {
    let (w, h) = (7.0 * name.chars().count() as f64, 12.0);
    let corners = [(5.0, -5.0), (-5.0 - w, -5.0), (5.0, 15.0), (-5.0 - w, 15.0)];
    let boxed = |(dx, dy): (f64, f64)| [x + dx, y + dy - h, x + dx + w, y + dy];
    let apart =
        |a: &[f64; 4], b: &[f64; 4]| a[2] < b[0] || b[2] < a[0] || a[3] < b[1] || b[3] < a[1];
    let free = corners.into_iter().map(boxed).find(|b| taken.iter().all(|t| apart(t, b)))?;
    taken.push(free);
    Some((free[0], free[3]))
}

/// The symbol of a family of links; the script draws the same.
pub(crate) fn symbol(family: Family, x: f64, y: f64) -> String {
    let d = match family {
        // Two surfaces that touch.
        Family::Contact => "M-7 -2H7M-7 2H7",
        // A pot with its piston.
        Family::Dashpot => "M-6 -5H4V5H-6M-1 -4V4M-1 0H7",
        // A zigzag.
        Family::Spring => "M-8 0L-5 -5L-1 5L3 -5L6 5L8 0",
        // A loop.
        Family::Hysteretic => "M-7 5L-3 -5H7L3 5Z",
    };
    format!(
        "<path transform=\"translate({x:.1} {y:.1})\" d=\"{d}\" fill=\"#fff\" fill-opacity=\".7\" stroke=\"#d55e00\" stroke-width=\"1.6\"/>\n"
    )
}

fn escaped(text: &str) -> String {
    text.replace('&', "&amp;").replace('<', "&lt;").replace('>', "&gt;")
}
