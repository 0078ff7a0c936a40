//! Figures drawn with plotters.

use crate::figure::{Axis, Color, Figure, Series, Stroke};
use crate::thin::thinned;
use plotters::coord::Shift;
use plotters::prelude::*;
use plotters::style::Color as _;
use plotters::style::text_anchor::{HPos, Pos, VPos};
use trilith_model::visible;

const FONT: &str = "sans-serif";
const GRID: RGBColor = RGBColor(225, 225, 225);
const TEXT: RGBColor = RGBColor(60, 60, 60);
/// A line may leave its points by so many pixels.
const VISIBLE: f64 = 0.2;
/// Values that differ by less than this share are drawn as a constant.
const CONSTANT: f64 = 1e-3;
/// Room for the legend, px a line.
const LEGEND_LINE: i32 = 18;
/// Pixels a character of the legend takes, about.
const LEGEND_CHARACTER: i32 = 7;

/// Opacity of areas.
const OPACITY: f64 = 0.85;

/// Corners of a square mark, px.
const SQUARE: [(i32, i32); 2] = [(-3, -3), (3, 3)];
/// Where the legend starts, px.
const LEFT: i32 = 74;
/// Length of a line in the legend, px.
const LEGEND_SAMPLE: i32 = 24;

type Area<'a> = DrawingArea<SVGBackend<'a>, Shift>;
type Failure = DrawingAreaErrorKind<std::io::Error>;

pub(crate) fn svg(figure: &Figure) -> String {
    let mut out = String::new();
    {
        let area = SVGBackend::with_string(&mut out, figure.size).into_drawing_area();
        // Writing into a string does not fail; what can fail in plotters is a backend of files.
        let drawn = draw(figure, &area).and_then(|()| area.present().map_err(|e| e.to_string()));
        debug_assert!(drawn.is_ok(), "{drawn:?}");
    }
    let title = format!("<title>{}</title>", escaped(&figure.title));
    let svg =
        out.replacen("<svg ", "<svg role=\"img\" ", 1).replacen(">\n", &format!(">\n{title}\n"), 1);
    // XML has no place for control characters.
    visible(&svg).into_owned()
}

/// Several figures side by side in one SVG.
pub(crate) fn sheet(figures: &[Figure]) -> String {
    let width: u32 = figures.iter().map(|f| f.size.0).sum();
    let height = figures.iter().map(|f| f.size.1).max().unwrap_or(0);
    let mut out = format!(
        "<svg viewBox=\"0 0 {width} {height}\" width=\"{width}\" height=\"{height}\" \
         xmlns=\"http://www.w3.org/2000/svg\">\n<rect width=\"100%\" height=\"100%\" fill=\"white\"/>\n"
    );
    let mut x = 0;
    for figure in figures {
        out += &svg(figure).replacen("<svg ", &format!("<svg x=\"{x}\" "), 1);
        x += figure.size.0;
    }
    out + "</svg>\n"
}

fn escaped(text: &str) -> String {
    text.replace('&', "&amp;").replace('<', "&lt;").replace('>', "&gt;")
}

/// Position along an axis: the value, or its decade.
fn position(axis: &Axis, value: f64) -> f64 {
    if axis.log { value.log10() } else { value }
}

/// Largest magnitude that has a place on an axis: those of two such ends, and some room, are no overflow.
const FARTHEST: f64 = 1e300;

fn drawable(figure: &Figure, point: (f64, f64)) -> Option<(f64, f64)> {
    let at = (position(&figure.x, point.0), position(&figure.y, point.1));
    (at.0.abs() <= FARTHEST && at.1.abs() <= FARTHEST).then_some(at)
}

/// The ends of an axis, in positions.
fn ends(axis: &Axis, values: impl Iterator<Item = f64>) -> (f64, f64) {
    if let Some((a, b)) = axis.range.filter(|(a, b)| (b - a).is_normal()) {
        return (position(axis, a), position(axis, b));
    }
    let (low, high) =
        values.fold((f64::INFINITY, f64::NEG_INFINITY), |(a, b), v| (a.min(v), b.max(v)));
    if low > high {
        return (0.0, 1.0);
    }
    if axis.log {
        return (low.floor(), high.ceil().max(low.floor() + 1.0));
    }
    let size = low.abs().max(high.abs());
    let room = match high - low {
        // An axis needs a length that can be told from none.
        _ if !(0.1 * size).is_normal() => 0.5,
        // A constant: without digits that are only noise.
        span if span < CONSTANT * size => 0.1 * size,
        span => 0.05 * span,
    };
    (low - room, high + room)
}

/// A number on an axis, as short as the distance of the ticks allows.
fn tick(axis: &Axis, at: f64, span: f64) -> String {
    if axis.whole {
        let whole = (at - at.round()).abs() < 1e-6;
        return if whole { format!("{at:.0}") } else { String::new() };
    }
    if axis.log {
        return match at.round() as i32 {
            n @ -2..=3 => format!("{}", 10f64.powi(n)),
            n => format!("1e{n}"),
        };
    }
    if at.abs() < 1e-9 * span {
        return "0".into();
    }
    let decade = (span / 10.0).abs().log10().floor() as i32;
    if (-5..5).contains(&decade) {
        return format!("{at:.*}", (-decade).max(0) as usize);
    }
    // One power of a thousand for the whole axis, so that its numbers can be compared.
    let power = 3 * (span.abs().log10() / 3.0).floor() as i32;
    let digits = (power - decade).clamp(0, 17) as usize; // a double has no more
    format!("{:.digits$}e{power}", at / 10f64.powi(power))
}

fn color(c: Color) -> RGBColor {
    RGBColor(c.0, c.1, c.2)
}

fn draw(figure: &Figure, area: &Area<'_>) -> Result<(), String> {
    let fail = |e: Failure| e.to_string();
    area.fill(&WHITE).map_err(fail)?;
    let rows = legend_rows(figure);
    let legend = LEGEND_LINE * rows.len() as i32;
    let (area, bottom) = area.split_vertically(figure.size.1 as i32 - legend);
    let all = || figure.series.iter().flat_map(|s| &s.points).filter_map(|p| drawable(figure, *p));
    let (x0, x1) = ends(&figure.x, all().map(|p| p.0));
    let (y0, y1) = ends(&figure.y, all().map(|p| p.1));
    let mut chart = ChartBuilder::on(&area)
        .caption(&figure.title, (FONT, 15).into_font().style(FontStyle::Bold).color(&TEXT))
        .margin(8)
        .margin_right(16)
        .x_label_area_size(40)
        .y_label_area_size(66)
        .build_cartesian_2d(x0..x1, y0..y1)
        .map_err(fail)?;
    let decades = |axis: &Axis, span: f64, other: usize| match axis {
        a if a.log => (span.round() as usize + 1).min(12),
        // Plotters counts the ends.
        a if a.whole => (span.floor() as usize + 1).clamp(2, other.max(2)),
        _ => other,
    };
    chart
        .configure_mesh()
        .bold_line_style(GRID)
        .light_line_style(TRANSPARENT)
        .axis_style(TEXT)
        .x_desc(figure.x.label.as_str())
        .y_desc(figure.y.label.as_str())
        .x_labels(decades(&figure.x, x1 - x0, 10))
        .y_labels(decades(&figure.y, y1 - y0, 9))
        .x_label_formatter(&|v| tick(&figure.x, *v, x1 - x0))
        .y_label_formatter(&|v| tick(&figure.y, *v, y1 - y0))
        .axis_desc_style((FONT, 13).into_font().color(&TEXT))
        .label_style((FONT, 12).into_font().color(&TEXT))
        .draw()
        .map_err(fail)?;
    // Pixels a unit, so that lines are thinned as the eye sees them.
    let (w, h) = area.dim_in_pixel();
    let (px, py) = (f64::from(w) / (x1 - x0), f64::from(h) / (y1 - y0));
    for (i, series) in figure.series.iter().enumerate() {
        let style = color(series.color);
        let thick = thickness(figure, i);
        let inside = |p: &(f64, f64)| p.0 >= x0 && p.0 <= x1 && p.1 >= y0 && p.1 <= y1;
        let points = || series.points.iter().filter_map(|p| drawable(figure, *p)).filter(inside);
        match series.stroke {
            Stroke::Line | Stroke::Dashes => {
                for part in parts(figure, series, inside) {
                    let pixels: Vec<_> = part.iter().map(|p| (p.0 * px, p.1 * py)).collect();
                    let kept = thinned(&pixels, VISIBLE);
                    let line = kept.iter().map(|p| (p.0 / px, p.1 / py));
                    let style = style.stroke_width(thick);
                    if series.stroke == Stroke::Line {
                        chart.draw_series(LineSeries::new(line, style)).map_err(fail)?;
                    } else {
                        chart
                            .draw_series(DashedLineSeries::new(line, 6, 4, style))
                            .map_err(fail)?;
                    }
                }
            }
            Stroke::Rings => {
                let style = style.stroke_width(2);
                chart.draw_series(points().map(|p| Circle::new(p, 4, style))).map_err(fail)?;
            }
            Stroke::Crosses => {
                let style = style.stroke_width(2);
                chart.draw_series(points().map(|p| Cross::new(p, 4, style))).map_err(fail)?;
            }
            Stroke::Area => {
                let corners: Vec<_> = points().collect();
                let area = Polygon::new(corners, style.mix(OPACITY).filled());
                chart.draw_series(std::iter::once(area)).map_err(fail)?;
            }
            Stroke::Squares => {
                let square = || Rectangle::new(SQUARE, style.filled());
                let marks = points().map(|p| EmptyElement::at(p) + square());
                chart.draw_series(marks).map_err(fail)?;
            }
        }
    }
    draw_legend(&rows, &bottom).map_err(fail)
}

/// Width of a line, px; see [`Figure::even`].
fn thickness(figure: &Figure, at: usize) -> u32 {
    let named = |s: &Series| s.stroke == Stroke::Line && !s.name.is_empty();
    let lines = || figure.series.iter().enumerate().filter(|(_, s)| named(s));
    let lower = lines().next().is_some_and(|(i, _)| i == at) && lines().count() == 2;
    if lower && !figure.even { 5 } else { 2 }
}

/// The pieces of a line between points that cannot be drawn or lie outside.
fn parts(
    figure: &Figure,
    series: &Series,
    inside: impl Fn(&(f64, f64)) -> bool,
) -> Vec<Vec<(f64, f64)>> {
    let mut all = vec![Vec::new()];
    for point in &series.points {
        match drawable(figure, *point).filter(&inside) {
            Some(at) => all.last_mut().expect("one at least").push(at),
            None => all.push(Vec::new()),
        }
    }
    all.retain(|p| p.len() > 1);
    all
}

/// The series with a name in rows that fit the width.
fn legend_rows(figure: &Figure) -> Vec<Vec<(&Series, u32)>> {
    let mut rows: Vec<Vec<(&Series, u32)>> = Vec::new();
    let mut left = 0;
    for (i, series) in figure.series.iter().enumerate().filter(|(_, s)| !s.name.is_empty()) {
        let (width, thick) = (width(series), thickness(figure, i));
        match rows.last_mut() {
            Some(row) if width <= left => {
                row.push((series, thick));
                left -= width;
            }
            _ => {
                rows.push(vec![(series, thick)]);
                left = figure.size.0 as i32 - LEFT - width;
            }
        }
    }
    rows
}

/// Pixels that the legend of a series takes.
fn width(series: &Series) -> i32 {
    LEGEND_SAMPLE + 20 + LEGEND_CHARACTER * series.name.chars().count() as i32
}

fn draw_legend(rows: &[Vec<(&Series, u32)>], area: &Area<'_>) -> Result<(), Failure> {
    let font = (FONT, 13).into_font().color(&TEXT).pos(Pos::new(HPos::Left, VPos::Center));
    for (i, row) in rows.iter().enumerate() {
        let (mut x, y) = (LEFT, LEGEND_LINE * i as i32 + LEGEND_LINE / 2 - 2);
        for &(series, thick) in row {
            let style = color(series.color);
            let (end, middle) = (x + LEGEND_SAMPLE, (x + LEGEND_SAMPLE / 2, y));
            match series.stroke {
                Stroke::Line => {
                    area.draw(&PathElement::new([(x, y), (end, y)], style.stroke_width(thick)))?;
                }
                Stroke::Dashes => {
                    for start in [x, x + LEGEND_SAMPLE - 10] {
                        let dash = [(start, y), (start + 10, y)];
                        area.draw(&PathElement::new(dash, style.stroke_width(2)))?;
                    }
                }
                Stroke::Rings => area.draw(&Circle::new(middle, 4, style.stroke_width(2)))?,
                Stroke::Crosses => area.draw(&Cross::new(middle, 4, style.stroke_width(2)))?,
                Stroke::Area => {
                    let box_ = [(x + 4, y - 6), (end - 4, y + 6)];
                    area.draw(&Rectangle::new(box_, style.mix(OPACITY).filled()))?;
                }
                Stroke::Squares => {
                    let square = EmptyElement::at(middle) + Rectangle::new(SQUARE, style.filled());
                    area.draw(&square)?;
                }
            }
            area.draw(&Text::new(series.name.clone(), (end + 6, y), font.clone()))?;
            x += width(series);
        }
    }
    Ok(())
}
