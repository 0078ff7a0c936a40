//! Mode charts: the first figure of every paper on free-standing blocks.

use crate::{Row, Study};
use trilith::report::{Color, Figure, Stroke};
use trilith::theory;

const MODES: [(&str, Color); 5] = [
    ("rest", Color::CONTEXT),
    ("slide", Color::PALETTE[0]),
    ("rock", Color::PALETTE[1]),
    ("slide-rock", Color::PALETTE[2]),
    ("flight", Color::PALETTE[3]),
];

/// Share of friction and acceleration within which a point counts as on a border.
const BAND: f64 = 0.02;

pub(super) fn draw(
    study: &Study,
    runs: &[Row<'_>],
    (x, y): (&str, &str),
    slenderness: f64,
) -> Figure {
    let place = |r: Row<'_>| {
        let number = |name| r.number(&study.varied, &study.columns, name);
        Some((number(x)?, number(y)?))
    };
    let title = format!("Mode in which the block leaves rest, H/B = {slenderness}");
    let mut figure =
        Figure::new(title, "friction coefficient μ", "peak acceleration A [g]").sized(640, 560);
    let (mut right, mut top) = (0.0f64, 0.0f64);
    let (mut judged, mut differ, mut crosses) = (0, 0, Vec::new());
    let mut points = MODES.map(|_| Vec::new());
    let mut rows = MODES.map(|_| Vec::new());
    for (row, r) in runs.iter().copied().enumerate() {
        let (Some((mu, a)), Some(mode)) = (place(r), r.initial_mode()) else { continue };
        (right, top) = (right.max(mu), top.max(a));
        if let Some(i) = MODES.iter().position(|m| m.0 == mode) {
            points[i].push((mu, a));
            rows[i].push(row);
        }
        let same = mode == theory::initial_mode(a, mu, slenderness);
        let sides = [1.0 - BAND, 1.0, 1.0 + BAND];
        let here = theory::initial_mode(a, mu, slenderness);
        let border = sides.iter().any(|f| {
            sides.iter().any(|g| theory::initial_mode(a * f, mu * g, slenderness) != here)
        });
        judged += usize::from(!border);
        differ += usize::from(!border && !same);
        if !same {
            crosses.push((mu, a));
        }
    }
    for (((name, color), points), rows) in MODES.into_iter().zip(points).zip(rows) {
        if !points.is_empty() {
            figure = figure.colored(name, Stroke::Squares, color, points).standing_for(rows);
        }
    }
    let (right, top) = (1.02 * right, 1.02 * top);
    let corner = 1.0 / slenderness;
    let curve = (0..=200).map(|i| corner + (top - corner).max(0.0) * f64::from(i) / 200.0);
    let curve = curve.map(|a| (theory::friction_to_rock(a, slenderness), a));
    figure = figure
        .reference("closed form", [(0.0, 0.0), (corner, corner), (right, corner)])
        .reference("", [(corner, corner), (corner, top)])
        .reference("", curve.filter(|(mu, _)| *mu <= right));
    if !crosses.is_empty() {
        figure = figure.colored("differs from it", Stroke::Crosses, Color::INK, crosses);
    }
    figure.ranges((0.0, right), (0.0, top)).caption(format!(
        "Rest up to A = min(μ, B/H); slide for μ < B/H; between slide and rock, slide-rock up to the friction \
         that holds a rocking block (Shenton 1996). Of {judged} points more than {:.0} % off a border {differ} \
         differ.",
        100.0 * BAND
    ))
}
