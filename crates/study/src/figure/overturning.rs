//! Overturning spectra.

use crate::{Row, Study};
use trilith::report::{Color, Figure, Stroke};
use trilith::theory;

pub(super) fn draw(
    study: &Study,
    runs: &[Row<'_>],
    (frequency, amplitude): (&str, &str),
    half_sine: bool,
) -> Figure {
    let number = |r: Row<'_>, name| r.number(&study.varied, &study.columns, name);
    let points = |fallen: bool| {
        let these = runs.iter().copied().enumerate();
        these
            .filter(move |(_, r)| r.good() && r.overturned() == fallen)
            .filter_map(|(row, r)| Some(((number(r, frequency)?, number(r, amplitude)?), row)))
            .unzip::<_, _, Vec<_>, Vec<_>>()
    };
    let ((stands, standing), (falls, falling)) = (points(false), points(true));
    let all = || stands.iter().chain(&falls);
    let right = 1.03 * all().fold(0.0f64, |a, p| a.max(p.0));
    let top = 1.03 * all().fold(0.0f64, |a, p| a.max(p.1));
    let mut figure = Figure::new("Overturning spectrum", "ω/p", "amplitude / (g tan α)")
        .sized(640, 480)
        .colored("stands", Stroke::Squares, Color::CONTEXT, stands.clone())
        .standing_for(standing)
        .colored("overturns", Stroke::Squares, Color::PALETTE[1], falls.clone())
        .standing_for(falling);
    if half_sine {
        let curve = (1..=200).map(|i| right * f64::from(i) / 200.0);
        let curve = curve.map(|x| (x, theory::half_sine_overturning(x))).filter(|p| p.1 <= top);
        figure = figure.reference("slender block, closed form", curve);
    }
    figure
        .colored("begins to rock", Stroke::Line, Color::INK, [(0.0, 1.0), (right, 1.0)])
        .ranges((0.0, right), (0.0, top))
}
