//! Overturning spectra.

use crate::{Record, Study};
use trilith::report::{Color, Figure, Stroke};
use trilith::theory;

pub(super) fn draw(
    study: &Study,
    records: &[Record],
    (frequency, amplitude): (&str, &str),
    half_sine: bool,
) -> Figure {
    let number = |r: &Record, name| r.number(&study.varied, &study.columns, name);
    let points = |fallen: bool| {
        let these = records.iter().filter(move |r| r.good && r.overturned == fallen);
        these
            .filter_map(|r| Some((number(r, frequency)?, number(r, amplitude)?)))
            .collect::<Vec<_>>()
    };
    let (stands, falls) = (points(false), points(true));
    let all = || stands.iter().chain(&falls);
    let right = 1.03 * all().fold(0.0f64, |a, p| a.max(p.0));
    let top = 1.03 * all().fold(0.0f64, |a, p| a.max(p.1));
    let mut figure = Figure::new("Overturning spectrum", "ω/p", "amplitude / (g tan α)")
        .sized(640, 480)
        .colored("stands", Stroke::Squares, Color(205, 205, 205), stands.clone())
        .colored("overturns", Stroke::Squares, Color::PALETTE[1], falls.clone());
    if half_sine {
        let curve = (1..=200).map(|i| right * f64::from(i) / 200.0);
        let curve = curve.map(|x| (x, theory::half_sine_overturning(x))).filter(|p| p.1 <= top);
        figure = figure.reference("slender block, closed form", curve);
    }
    figure
        .colored("begins to rock", Stroke::Line, Color(120, 120, 120), [(0.0, 1.0), (right, 1.0)])
        .ranges((0.0, right), (0.0, top))
}
