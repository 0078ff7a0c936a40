//! Figures as SVG.

mod data;
mod scale;
mod style;

pub(crate) use data::{drawing, nearest};

use crate::figure::{Color, Figure, Series};
use crate::thin::thinned;
use scale::{ends, position, ticks};
use std::fmt::Write;
use style::{Look, Shape, looks};
use trilith_model::visible;

const GRID: &str = "#e1e1e1";
const AXIS: &str = "#8c8c8c";
const TEXT: &str = "#3c3c3c";
/// A line may leave its points by so many pixels.
const VISIBLE: f64 = 0.2;
/// Height of a line of the legend, px.
const LEGEND_LINE: f64 = 18.0;
/// Length of a line in the legend, px.
const SAMPLE: f64 = 28.0;
/// Pixels a letter takes, about.
const LETTER: f64 = 6.6;
/// Pixels a digit beside an axis takes.
const DIGIT: f64 = 7.4;
/// Room for the values of peaks, share of the axis.
const PEAK: f64 = 0.06;
/// Opacity of areas.
const OPACITY: f64 = 0.85;
/// Room above and beneath the diagram, px, and on its right.
const EDGE: (f64, f64, f64) = (30.0, 42.0, 18.0);

pub(crate) fn svg(figure: &Figure) -> String {
    let (width, height) = figure.size;
    let mut out = format!(
        "<svg role=\"img\" width=\"{width}\" height=\"{height}\" viewBox=\"0 0 {width} {height}\" \
         xmlns=\"http://www.w3.org/2000/svg\" font-family=\"sans-serif\" font-size=\"12\" fill=\"{TEXT}\">\n\
         <title>{}</title>\n<rect width=\"{width}\" height=\"{height}\" fill=\"#ffffff\"/>\n",
        escaped(&figure.title)
    );
    Frame::new(figure).draw(&mut out);
    out += "</svg>\n";
    // XML has no place for control characters.
    visible(&out).into_owned()
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

/// A colour as the style sheet of pages knows it.
fn hex(c: Color) -> String {
    format!("#{:02x}{:02x}{:02x}", c.0, c.1, c.2)
}

/// The diagram in its picture.
struct Frame<'a> {
    figure: &'a Figure,
    looks: Vec<Look>,
    legend: Vec<Vec<usize>>,
    x: (f64, f64),
    y: (f64, f64),
    along_x: Vec<(f64, String)>,
    along_y: Vec<(f64, String)>,
    /// Left, top, width, height, px.
    place: [f64; 4],
}

impl<'a> Frame<'a> {
    fn new(figure: &'a Figure) -> Self {
        let legend = legend(figure);
        let (width, height) = (f64::from(figure.size.0), f64::from(figure.size.1));
        let peaks = || figure.peaks.iter().map(|(_, p)| p);
        let all = || figure.series.iter().flat_map(|s| &s.points).chain(peaks());
        let place = |p: &(f64, f64)| Some((position(&figure.x, p.0)?, position(&figure.y, p.1)?));
        let (mut x, mut y) = (
            ends(&figure.x, all().filter_map(place).map(|p| p.0)),
            ends(&figure.y, all().filter_map(place).map(|p| p.1)),
        );
        if !figure.peaks.is_empty() && figure.y.range.is_none() && !figure.y.log {
            // Values stand above what they mark.
            let room = PEAK * (y.1 - y.0);
            y = (y.0 - room, y.1 + room);
        }
        let (top, bottom, right) = EDGE;
        let h = (height - top - bottom - LEGEND_LINE * legend.len() as f64).max(40.0);
        let along_y = ticks(&figure.y, y, (h / 34.0) as usize);
        let longest = along_y.iter().map(|t| t.1.chars().count()).max().unwrap_or(1);
        let left = 30.0 + DIGIT * longest.max(2) as f64;
        let w = (width - left - right).max(60.0);
        if figure.equal {
            (x, y) = square(x, y, w, h);
        }
        let along_y = if figure.equal { ticks(&figure.y, y, (h / 34.0) as usize) } else { along_y };
        let along_x = ticks(&figure.x, x, (w / 70.0) as usize);
        Self {
            figure,
            looks: looks(figure),
            legend,
            x,
            y,
            along_x,
            along_y,
            place: [left, top, w, h],
        }
    }

    /// From positions to pixels.
    fn pixel(&self, (x, y): (f64, f64)) -> (f64, f64) {
        let [left, top, w, h] = self.place;
        (
            left + w * (x - self.x.0) / (self.x.1 - self.x.0),
            top + h - h * (y - self.y.0) / (self.y.1 - self.y.0),
        )
    }

    /// Pixels of a point; none where it has no place on the axes.
    fn at(&self, p: (f64, f64)) -> Option<(f64, f64)> {
        Some(self.pixel((position(&self.figure.x, p.0)?, position(&self.figure.y, p.1)?)))
    }

    fn inside(&self, (x, y): (f64, f64)) -> bool {
        let [left, top, w, h] = self.place;
        x >= left - 0.01 && x <= left + w + 0.01 && y >= top - 0.01 && y <= top + h + 0.01
    }

    fn draw(&self, out: &mut String) {
        let (figure, [left, top, w, h]) = (self.figure, self.place);
        let mut grid = String::new();
        for (x, text) in &self.along_x {
            let x = self.pixel((*x, 0.0)).0;
            let _ = write!(grid, "M{x:.1} {top:.1}v{h:.1}");
            let _ = writeln!(
                out,
                "<text x=\"{x:.1}\" y=\"{:.1}\" text-anchor=\"middle\">{text}</text>",
                top + h + 16.0
            );
        }
        for (y, text) in &self.along_y {
            let y = self.pixel((0.0, *y)).1;
            let _ = write!(grid, "M{left:.1} {y:.1}h{w:.1}");
            let _ = writeln!(
                out,
                "<text x=\"{:.1}\" y=\"{:.1}\" text-anchor=\"end\">{text}</text>",
                left - 6.0,
                y + 4.0
            );
        }
        let _ = writeln!(out, "<path d=\"{grid}\" fill=\"none\" stroke=\"{GRID}\"/>");
        let (middle, label) = (left + 0.5 * w, |text: &str| escaped(text));
        let _ = writeln!(
            out,
            "<text x=\"{middle:.1}\" y=\"{:.1}\" text-anchor=\"middle\" font-size=\"13\">{}</text>\n\
             <text transform=\"translate(14 {:.1}) rotate(-90)\" text-anchor=\"middle\" font-size=\"13\"{}>{}</text>\n\
             <text x=\"{:.1}\" y=\"19\" text-anchor=\"middle\" font-size=\"15\" font-weight=\"bold\"{}>{}</text>",
            top + h + 34.0,
            label(&figure.x.label),
            top + 0.5 * h,
            fitted(&figure.y.label, LETTER * 1.08, f64::from(figure.size.1) - 8.0),
            label(&figure.y.label),
            0.5 * f64::from(figure.size.0),
            fitted(&figure.title, LETTER * 1.3, f64::from(figure.size.0) - 8.0),
            label(&figure.title),
        );
        for (series, look) in figure.series.iter().zip(&self.looks) {
            self.series(out, series, *look);
        }
        for (_, (x, y)) in &figure.peaks {
            self.peak(out, (*x, *y));
        }
        let _ = writeln!(
            out,
            "<path d=\"M{left:.1} {top:.1}v{h:.1}h{w:.1}\" fill=\"none\" stroke=\"{AXIS}\"/>"
        );
        self.names(out);
    }

    fn series(&self, out: &mut String, series: &Series, look: Look) {
        let color = hex(series.color);
        match look {
            Look::Line(dash, width) => {
                let mut d = String::new();
                for part in self.parts(series) {
                    path(&mut d, &thinned(&part, VISIBLE));
                }
                let dash = dashed(dash);
                let _ = writeln!(
                    out,
                    "<path d=\"{d}\" fill=\"none\" stroke=\"{color}\" stroke-width=\"{width}\" \
                     stroke-linejoin=\"round\"{dash}/>"
                );
            }
            Look::Marks(shape, filled) => {
                let points = series.points.iter().filter_map(|p| self.at(*p));
                marks(out, (shape, filled), &color, points.filter(|p| self.inside(*p)));
            }
            Look::Area => {
                let points: Vec<_> = series.points.iter().filter_map(|p| self.at(*p)).collect();
                let mut d = String::new();
                path(&mut d, &points);
                let _ = writeln!(
                    out,
                    "<path d=\"{d}Z\" fill=\"{color}\" fill-opacity=\"{OPACITY}\" stroke=\"#ffffff\" \
                     stroke-width=\"0.7\"/>"
                );
            }
        }
    }

    /// The pieces of a line between points that have no place or lie outside, px.
    fn parts(&self, series: &Series) -> Vec<Vec<(f64, f64)>> {
        let mut all = vec![Vec::new()];
        for point in &series.points {
            match self.at(*point).filter(|p| self.inside(*p)) {
                Some(at) => all.last_mut().expect("one at least").push(at),
                None => all.push(Vec::new()),
            }
        }
        all.retain(|p| p.len() > 1);
        all
    }

    /// A peak: a small wedge that points at it, and its value.
    fn peak(&self, out: &mut String, p: (f64, f64)) {
        let Some((x, y)) = self.at(p).filter(|at| self.inside(*at)) else { return };
        let up = p.1 >= 0.0;
        let (tip, text) = if up { (-5.0, y - 10.0) } else { (5.0, y + 19.0) };
        let [left, top, w, h] = self.place;
        // Inside the frame: beneath a peak that touches it.
        let text = if text < top + 10.0 {
            y + 17.0
        } else if text > top + h - 3.0 {
            y - 8.0
        } else {
            text
        };
        let anchor = if x > left + 0.75 * w {
            "end"
        } else if x < left + 0.25 * w {
            "start"
        } else {
            "middle"
        };
        let _ = writeln!(
            out,
            "<path d=\"M{x:.1} {y:.1}l-4 {tip}h8Z\" fill=\"#1e1e1e\"/>\
             <text x=\"{x:.1}\" y=\"{text:.1}\" text-anchor=\"{anchor}\" font-size=\"11\" paint-order=\"stroke\" \
             stroke=\"#ffffff\" stroke-width=\"3\">{}</text>",
            crate::run::short(p.1, 4)
        );
    }

    fn names(&self, out: &mut String) {
        let bottom = f64::from(self.figure.size.1) - LEGEND_LINE * self.legend.len() as f64 - 3.0;
        for (row, members) in self.legend.iter().enumerate() {
            let (mut x, y) = (START, bottom + LEGEND_LINE * (row as f64 + 0.5));
            for i in members {
                let series = &self.figure.series[*i];
                sample(out, series, self.looks[*i], (x, y));
                let name = escaped(&series.name);
                let _ = writeln!(
                    out,
                    "<text x=\"{:.1}\" y=\"{:.1}\">{name}</text>",
                    x + SAMPLE + 6.0,
                    y + 4.0
                );
                x += width(series);
            }
        }
    }
}

/// Where the legend starts, px.
const START: f64 = 46.0;

/// Squeezes a text that is longer than its room.
fn fitted(text: &str, letter: f64, room: f64) -> String {
    let long = letter * text.chars().count() as f64 > room;
    if long {
        format!(" textLength=\"{room:.0}\" lengthAdjust=\"spacingAndGlyphs\"")
    } else {
        String::new()
    }
}

/// Ends at which a unit is as long on both axes.
fn square(x: (f64, f64), y: (f64, f64), w: f64, h: f64) -> ((f64, f64), (f64, f64)) {
    let unit = ((x.1 - x.0) / w).max((y.1 - y.0) / h);
    let about = |e: (f64, f64), px: f64| {
        let middle = 0.5 * (e.0 + e.1);
        (middle - 0.5 * unit * px, middle + 0.5 * unit * px)
    };
    (about(x, w), about(y, h))
}

fn path(d: &mut String, points: &[(f64, f64)]) {
    for (i, (x, y)) in points.iter().enumerate() {
        let _ = write!(d, "{}{x:.1} {y:.1}", if i == 0 { 'M' } else { 'L' });
    }
}

fn dashed(dash: &str) -> String {
    if dash.is_empty() { String::new() } else { format!(" stroke-dasharray=\"{dash}\"") }
}

/// Marks of one series as one path.
fn marks(out: &mut String, look: (Shape, bool), color: &str, at: impl Iterator<Item = (f64, f64)>) {
    let mut d = String::new();
    for (x, y) in at {
        let _ = write!(d, "M{x:.1} {y:.1}{}", look.0.path());
    }
    let ink = match look.1 {
        true => format!("fill=\"{color}\""),
        false => format!("fill=\"none\" stroke=\"{color}\" stroke-width=\"1.7\""),
    };
    let _ = writeln!(out, "<path d=\"{d}\" {ink}/>");
}

fn sample(out: &mut String, series: &Series, look: Look, (x, y): (f64, f64)) {
    let color = hex(series.color);
    match look {
        Look::Line(dash, width) => {
            let _ = writeln!(
                out,
                "<path d=\"M{x:.1} {y:.1}h{SAMPLE}\" fill=\"none\" stroke=\"{color}\" stroke-width=\"{width}\"{}/>",
                dashed(dash)
            );
        }
        Look::Marks(shape, filled) => {
            marks(out, (shape, filled), &color, std::iter::once((x + 0.5 * SAMPLE, y)));
        }
        Look::Area => {
            let _ = writeln!(
                out,
                "<path d=\"M{:.1} {:.1}h20v12h-20Z\" fill=\"{color}\" fill-opacity=\"{OPACITY}\"/>",
                x + 4.0,
                y - 6.0
            );
        }
    }
}

/// The series with a name in rows that fit the width, by index.
fn legend(figure: &Figure) -> Vec<Vec<usize>> {
    let mut rows: Vec<Vec<usize>> = Vec::new();
    let mut left = 0.0;
    for (i, series) in figure.series.iter().enumerate().filter(|(_, s)| !s.name.is_empty()) {
        let width = width(series);
        match rows.last_mut() {
            Some(row) if width <= left => {
                row.push(i);
                left -= width;
            }
            _ => {
                rows.push(vec![i]);
                left = f64::from(figure.size.0) - START - width;
            }
        }
    }
    rows
}

/// Pixels that the legend of a series takes.
fn width(series: &Series) -> f64 {
    SAMPLE + 20.0 + LETTER * series.name.chars().count() as f64
}
