//! Figures of a run, still: for paper and for readers without scripts.

use super::data::{
    Ground, History, Loop, MemberCurve, Numbers, Orbit, Profile, RunData, SpectrumChart,
};
use super::drawing;
use super::units::{labelled, short};
use crate::{Color, Drawing, Figure, Stroke};

/// (name in the data, name for readers, colour), in the order in which they are stacked.
pub(crate) const KINDS: [(&str, &str, Color); 8] = [
    ("kinetic", "kinetic", Color(86, 180, 233)),
    ("strain", "strain", Color(0, 114, 178)),
    ("potential", "potential", Color(150, 150, 150)),
    ("link_stored", "stored in links", Color(0, 158, 115)),
    ("modal_damping", "structural damping", Color(102, 90, 160)),
    ("link_hysteretic", "friction and yielding", Color(213, 94, 0)),
    ("link_viscous", "viscous in links", Color(204, 121, 167)),
    ("algorithmic", "time rule", Color(230, 159, 0)),
];
/// What was there at the start and the input, in the data: the sum of all kinds, up to the error.
pub(crate) const SUPPLY: &str = "supply";

/// Kinds smaller than this share of the largest energy are left out of figures.
const SHARE: f64 = 1e-4;

/// An energy by its name in the data.
pub(crate) fn energy<'a>(data: &'a RunData, name: &str) -> Option<&'a History> {
    data.energies.iter().find(|h| h.name == name)
}

fn largest(h: &History) -> f64 {
    h.y.values().fold(0.0, |a: f64, y| a.max(y.abs()))
}

/// The kinds of energy that can be seen.
pub(crate) fn seen(data: &RunData) -> Vec<(&History, &'static str, Color)> {
    let most = data.energies.iter().map(largest).fold(0.0, f64::max);
    KINDS
        .iter()
        .filter_map(|(name, words, color)| Some((energy(data, name)?, *words, *color)))
        .filter(|(h, _, _)| largest(h) > SHARE * most)
        .collect()
}

/// An output over time.
pub(crate) fn history(h: &History) -> Figure {
    let label = labelled(&h.name, &h.shown);
    Figure::new(h.name.clone(), "time [s]", label)
        .line("", h.points())
        .timed()
        .peaks()
        .sized(440, 240)
}

/// An acceleration of the base.
pub(crate) fn ground(g: &Ground) -> Figure {
    history(&g.history).scaled("ground")
}

/// Response spectra.
pub(crate) fn spectra(chart: &SpectrumChart) -> Figure {
    let label = format!("{} [{}]", chart.quantity, chart.shown.unit);
    let figure = Figure::new(chart.title.clone(), "period [s]", label).log_x();
    let lone = chart.curves.len() == 1;
    let curves = chart.curves.iter();
    curves
        .fold(figure, |f, c| {
            let y = c.y.values().map(|y| y * chart.shown.factor);
            let name = if lone { "" } else { c.name.as_str() };
            f.series(name, Stroke::Line, c.period.values().zip(y))
        })
        .sized(480, 300)
}

/// A path in plan.
pub(crate) fn orbit(o: &Orbit) -> Figure {
    let factor = o.shown.factor;
    let points = o.x.values().zip(o.y.values()).map(move |(x, y)| (x * factor, y * factor));
    let [x, y] = &o.names;
    Figure::new(format!("{x} and {y}"), labelled(x, &o.shown), labelled(y, &o.shown))
        .line("", points)
        .at_times(o.t.values())
        .equal()
        .sized(360, 340)
}

/// Extremes over the height.
pub(crate) fn profile(p: &Profile) -> Figure {
    let title = match p.quantity.as_str() {
        "drift" => "Storey drift",
        "acceleration" => "Floor acceleration",
        _ => "Displacement",
    };
    let what = if p.quantity == "drift" { "drift over height" } else { p.quantity.as_str() };
    let figure = Figure::new(title, labelled(what, &p.shown), "height [m]").sized(360, 340);
    let several =
        |direction: &str| p.curves.iter().filter(|c| c.direction == direction).count() > 1;
    let figure = p.curves.iter().fold(figure, |f, c| {
        let name = match several(&c.direction) {
            true => {
                format!("{} at {}, {}", c.direction, short(c.place[0], 4), short(c.place[1], 4))
            }
            false => c.direction.clone(),
        };
        let steps = c.from.iter().zip(&c.to).zip(&c.value);
        let mut points: Vec<(f64, f64)> = Vec::new();
        for ((from, to), value) in steps {
            let x = value * p.shown.factor;
            points.push((x, *from));
            if to > from {
                points.push((x, *to));
            }
        }
        f.line(name, points)
    });
    // What is compared begins at nothing.
    let most =
        p.curves.iter().flat_map(|c| &c.value).fold(0.0, |a: f64, v| a.max(*v)) * p.shown.factor;
    let heights = || p.curves.iter().flat_map(|c| c.from.iter().chain(&c.to)).copied();
    let (low, high) =
        heights().fold((f64::INFINITY, f64::NEG_INFINITY), |(a, b), z| (a.min(z), b.max(z)));
    let room = 0.04 * (high - low);
    figure.ranges((0.0, 1.06 * most), (low - room, high + room))
}

/// A force along a member.
pub(crate) fn member(m: &MemberCurve) -> Figure {
    let along = |y: &Numbers| {
        let points: Vec<(f64, f64)> =
            m.at.values().zip(y.values().map(|y| y * m.shown.factor)).collect();
        points
    };
    Figure::new(m.member.clone(), "from the first node [m]", labelled(&m.force, &m.shown))
        .line("largest", along(&m.max))
        .line("smallest", along(&m.min))
        .sized(320, 250)
}

/// A hysteresis loop.
pub(crate) fn link_loop(l: &Loop) -> Figure {
    let [x, y] = ["deformation", "force"];
    let title = format!("{} {}", l.link, l.coordinate);
    Figure::new(title, format!("{x} [{}]", l.shown[0].unit), format!("{y} [{}]", l.shown[1].unit))
        .line("", l.points())
        .at_times(l.t.values())
        .sized(320, 270)
}

/// The drawings that a name stands for: an output, `energy`, `ground`, `spectra`, `model`, or a link with a loop for
/// each coordinate. Each with a name of its own for a file.
#[must_use]
pub fn named_figures(data: &RunData, name: &str) -> Vec<(String, Drawing)> {
    let figures = figures(data, name);
    if figures.is_empty() && name == MODEL && !data.picture.points.is_empty() {
        return vec![(MODEL.to_owned(), drawing::still(data))];
    }
    figures.iter().map(|(name, figure)| (name.clone(), Drawing::from(figure))).collect()
}

fn figures(data: &RunData, name: &str) -> Vec<(String, Figure)> {
    let clean = |text: &str| -> String {
        text.chars()
            .map(|c| if c.is_alphanumeric() || "_-.".contains(c) { c } else { '_' })
            .collect()
    };
    let large = |figure: Figure| figure.sized(720, 380);
    if let Some(h) = data.histories.iter().find(|h| h.name == name) {
        return vec![(clean(name), large(history(h)))];
    }
    if name == ENERGY && !data.energies.is_empty() {
        return vec![(clean(name), large(energy_curves(data)))];
    }
    let numbered = |i: usize, all: usize| match all {
        1 => clean(name),
        _ => clean(&format!("{name}_{}", i + 1)),
    };
    if name == GROUND {
        let motions = data.ground.iter().map(|g| history(&g.history));
        let all: Vec<Figure> = motions.chain(data.ground_spectra.iter().map(spectra)).collect();
        let count = all.len();
        return all.into_iter().enumerate().map(|(i, f)| (numbered(i, count), large(f))).collect();
    }
    if name == SPECTRA {
        let all = data.floor_spectra.iter().map(spectra).enumerate();
        return all.map(|(i, f)| (numbered(i, data.floor_spectra.len()), large(f))).collect();
    }
    let loops = data.loops.iter().filter(|l| l.link == name);
    loops
        .map(|l| (clean(&format!("{name}_{}", l.coordinate)), link_loop(l).sized(560, 460)))
        .collect()
}

/// The name of the figure of energies.
pub const ENERGY: &str = "energy";
/// The name of the figures of the ground motion: its accelerations and their spectra.
pub const GROUND: &str = "ground";
/// The name of the drawing of the model where it has moved most.
pub const MODEL: &str = "model";
/// The name of the figures of floor spectra.
pub const SPECTRA: &str = "spectra";

/// The energies as curves, as in plots of input, link, damper, kinetic and potential energy and error.
pub(crate) fn energy_curves(data: &RunData) -> Figure {
    let unit = data.energies.first().map_or("J", |h| h.shown.unit.as_str());
    let mut figure = Figure::new("Energies over time", "time [s]", format!("energy [{unit}]"))
        .timed()
        .sized(480, 380);
    if let Some(input) = energy(data, "input") {
        figure = figure.colored("input", Stroke::Line, Color::INK, input.points());
    }
    for (h, words, color) in seen(data) {
        figure = figure.colored(words, Stroke::Line, color, h.points());
    }
    if let Some(error) = energy(data, "error") {
        figure =
            figure.colored("unaccounted for", Stroke::Dashes, Color(170, 0, 60), error.points());
    }
    figure
}

/// The energies stacked, negative ones downwards, and what was there at the start and the input as a line over them.
pub(crate) fn energy_stack(data: &RunData) -> Figure {
    let unit = data.energies.first().map_or("J", |h| h.shown.unit.as_str());
    let title = "Where the energy is";
    let mut figure =
        Figure::new(title, "time [s]", format!("energy [{unit}]")).timed().sized(480, 380);
    let times = common(data);
    let (mut up, mut down) = (vec![0.0; times.len()], vec![0.0; times.len()]);
    for (h, words, color) in seen(data) {
        let y = at(h, &times);
        let (low, high): (Vec<f64>, Vec<f64>) = y
            .iter()
            .enumerate()
            .map(|(i, y)| {
                let base = if *y >= 0.0 { &mut up[i] } else { &mut down[i] };
                let from = *base;
                *base += y;
                (from, *base)
            })
            .unzip();
        let there = times.iter().copied().zip(high);
        let back = times.iter().copied().zip(low).rev();
        figure = figure.colored(words, Stroke::Area, color, there.chain(back));
    }
    // Folders of earlier runs have no sum.
    let supply = energy(data, SUPPLY).map(|h| ("start + input", h));
    if let Some((words, h)) = supply.or_else(|| Some(("input", energy(data, "input")?))) {
        figure = figure.colored(words, Stroke::Line, Color::INK, h.points());
    }
    figure
}

/// Evenly spaced times at which energies are stacked.
fn common(data: &RunData) -> Vec<f64> {
    const COUNT: usize = 600;
    let end = data.energies.first().and_then(|h| h.t.values().last()).unwrap_or(0.0);
    (0..=COUNT).map(|i| end * i as f64 / COUNT as f64).collect()
}

/// Values at rising times, linear between points, in the unit shown.
fn at(h: &History, times: &[f64]) -> Vec<f64> {
    let points: Vec<(f64, f64)> = h.points().collect();
    let mut i = 0;
    times
        .iter()
        .map(|t| {
            while i + 2 < points.len() && points[i + 1].0 < *t {
                i += 1;
            }
            let (Some(a), Some(b)) = (points.get(i), points.get(i + 1)) else { return 0.0 };
            let share = if b.0 > a.0 { ((t - a.0) / (b.0 - a.0)).clamp(0.0, 1.0) } else { 0.0 };
            a.1 + share * (b.1 - a.1)
        })
        .collect()
}
