//! How series look, so that they can be told apart by any eye and in grey: colour, dashes, shape of marks.

use crate::figure::{Color, Figure, Series, Stroke};

/// Dashes of the lines of one figure, in order: px drawn and left out.
const DASHES: [&str; 6] = ["", "8 3", "2 2.5", "12 3 2 3", "5 2", "14 3 2 2 2 3"];
/// Dashes of references and bounds.
const REFERENCE: &str = "6 4";

/// A mark about the origin, 7 px wide or so.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Shape {
    Circle,
    Square,
    Triangle,
    Diamond,
    Wedge,
    Cross,
}

impl Shape {
    /// Outlines as relative SVG paths, by their names for the script, which has the same.
    pub(crate) const ALL: [(Self, &'static str, &'static str); 6] = [
        (Self::Circle, "circle", "m-3.6 0a3.6 3.6 0 1 0 7.2 0a3.6 3.6 0 1 0 -7.2 0z"),
        (Self::Square, "square", "m-3 -3h6v6h-6z"),
        (Self::Triangle, "triangle", "m0 -4.2l3.9 7h-7.8z"),
        (Self::Diamond, "diamond", "m0 -4.4l4.4 4.4l-4.4 4.4l-4.4 -4.4z"),
        (Self::Wedge, "wedge", "m0 4.2l3.9 -7h-7.8z"),
        (Self::Cross, "cross", "m-3.5 -3.5l7 7m-7 0l7 -7"),
    ];

    pub(crate) fn name(self) -> &'static str {
        Self::ALL.iter().find(|s| s.0 == self).map_or("", |s| s.1)
    }

    pub(crate) fn path(self) -> &'static str {
        Self::ALL.iter().find(|s| s.0 == self).map_or("", |s| s.2)
    }
}

/// How a series is drawn.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Look {
    /// A line: dashes and width, px.
    Line(&'static str, f64),
    /// Marks: shape, filled.
    Marks(Shape, bool),
    /// A filled polygon.
    Area,
}

/// The looks of all series of a figure. Colours come back after some names: what has the colour of an earlier one then has
/// other dashes, or another mark, as long as there are any.
pub(crate) fn looks(figure: &Figure) -> Vec<Look> {
    const OPEN: [Shape; 5] =
        [Shape::Circle, Shape::Triangle, Shape::Diamond, Shape::Square, Shape::Wedge];
    const FILLED: [Shape; 5] =
        [Shape::Square, Shape::Triangle, Shape::Diamond, Shape::Circle, Shape::Wedge];
    let (mut lines, mut rings, mut squares) = (Kind::default(), Kind::default(), Kind::default());
    let looks = figure.series.iter().map(|s| match s.stroke {
        // Curves behind the others.
        Stroke::Line if s.color == Color::CONTEXT => Look::Line("", 1.0),
        Stroke::Line if s.color == Color::INK => Look::Line("", 1.8),
        Stroke::Line => Look::Line(DASHES[lines.next(s, DASHES.len())], 1.8),
        Stroke::Dashes => Look::Line(REFERENCE, 1.5),
        Stroke::Rings => Look::Marks(OPEN[rings.next(s, OPEN.len())], false),
        Stroke::Squares => Look::Marks(FILLED[squares.next(s, FILLED.len())], true),
        Stroke::Crosses => Look::Marks(Shape::Cross, false),
        Stroke::Area => Look::Area,
    });
    looks.collect()
}

/// Series of a figure that are drawn in one way, so far.
#[derive(Default)]
struct Kind {
    names: usize,
    taken: Vec<(Color, usize)>,
}

impl Kind {
    /// Which of so many variants the next one has: each name the next variant, or the first behind it that its colour does
    /// not have yet. What has no name goes with what has one.
    fn next(&mut self, series: &Series, variants: usize) -> usize {
        let mut all = (0..variants).map(|k| (self.names + k) % variants);
        let variant = all.find(|v| !self.taken.contains(&(series.color, *v)));
        let variant = variant.unwrap_or(self.names % variants);
        if !series.name.is_empty() {
            self.names += 1;
            self.taken.push((series.color, variant));
        }
        variant
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn series_of_one_figure_differ_without_their_colours() {
        let empty = || std::iter::empty();
        let mut figure = Figure::new("f", "x", "y");
        for i in 0..5 {
            figure = figure
                .line(format!("l{i}"), empty())
                .series(format!("r{i}"), Stroke::Rings, empty())
                .series(format!("s{i}"), Stroke::Squares, empty());
        }
        let looks = looks(&figure);
        for (i, a) in looks.iter().enumerate() {
            assert!(looks[..i].iter().all(|b| a != b), "{a:?} twice");
        }
    }

    /// Six colours and six dashes come back together: a seventh line would be the first one again.
    #[test]
    fn many_names_differ_in_colour_or_look() {
        let empty = || std::iter::empty();
        let mut figure = Figure::new("f", "x", "y");
        for i in 0..30 {
            figure = figure.line(format!("l{i}"), empty());
        }
        for i in 0..30 {
            figure = figure.series(format!("r{i}"), Stroke::Rings, empty());
        }
        let looks = looks(&figure);
        let seen: Vec<_> = figure.series.iter().map(|s| s.color).zip(&looks).collect();
        for (i, a) in seen.iter().enumerate() {
            assert!(seen[..i].iter().all(|b| a != b), "series {i}: {a:?} twice");
        }
    }

    #[test]
    fn the_script_has_the_same_marks() {
        let script = crate::chart::BEFORE.concat();
        for (_, name, path) in Shape::ALL {
            assert!(script.contains(&format!("{name}: \"{path}\"")), "{name}");
        }
    }

    #[test]
    fn a_line_in_pieces_without_a_name_looks_like_the_next_one_with_it() {
        let figure = Figure::new("f", "x", "y").line("", [(0.0, 0.0)]).line("named", [(0.0, 0.0)]);
        assert_eq!(looks(&figure)[0], looks(&figure)[1]);
    }
}
