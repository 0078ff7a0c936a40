//! A section of the page for each figure.

use super::{fragile, hazard, modes, overturning, spread};
use crate::{Drawing, Row, Study};
use trilith::report::{Block, Figure, Section};

impl Drawing {
    /// What it is called: its head on the page, and part of the name of its file.
    pub(crate) fn title(&self) -> &'static str {
        match self {
            Self::ModeChart { .. } => "Mode chart",
            Self::Ida { .. } => "Incremental dynamic analysis",
            Self::Fragility { .. } => "Fragility",
            Self::Overturning { .. } => "Overturning spectrum",
            Self::Hazard { .. } => "Hazard",
            Self::Spread { .. } => "Points with several runs",
            Self::Points { .. } => "Runs",
        }
    }
}

/// What is drawn for the figure with this number, and the rows of a table beside it.
fn drawn(study: &Study, runs: &[Row<'_>], number: usize) -> (Vec<Figure>, Vec<Vec<String>>) {
    let figure = match &study.figures[number] {
        Drawing::ModeChart { x, y, slenderness } => {
            settable(study, modes::draw(study, runs, (x, y), *slenderness), x, y)
        }
        Drawing::Ida { demand, intensity } => fragile::ida(study, runs, demand, intensity),
        Drawing::Fragility { intensity, event, confidence, by } => {
            let by = by.as_deref();
            let (figure, rows) = fragile::fragility(study, runs, intensity, event, *confidence, by);
            return (vec![figure], rows);
        }
        Drawing::Overturning { frequency, amplitude, half_sine } => {
            let figure = overturning::draw(study, runs, (frequency, amplitude), *half_sine);
            settable(study, figure, frequency, amplitude)
        }
        Drawing::Hazard { demand, intensity, rates } => {
            return (hazard::draw(study, runs, (demand, intensity), rates), Vec::new());
        }
        Drawing::Spread { x, y } => return (spread::spread(study, runs, x, y), Vec::new()),
        Drawing::Points { x, y, by } => {
            settable(study, spread::points(study, runs, (x, y), by.as_deref()), x, y)
        }
    };
    (vec![figure], Vec::new())
}

/// The figure, saying so where both of its axes are parameters that runs set.
fn settable(study: &Study, figure: Figure, x: &str, y: &str) -> Figure {
    let of = |name: &str| {
        let i = study.varied.iter().position(|n| n == name)?;
        // What is computed from several runs, or a text, is not set.
        let unit = study.kinds[i].map(|d| if d.is_none() { String::new() } else { d.unit() })?;
        Some((name.to_owned(), unit))
    };
    match (of(x), of(y)) {
        (Some(x), Some(y)) => figure.setting(x, y),
        _ => figure,
    }
}

/// The figures that a study asks for, each with a name for a file: `figure_1_mode_chart`.
#[must_use]
pub fn figures(study: &Study, runs: &[Row<'_>]) -> Vec<(String, Figure)> {
    let mut all = Vec::new();
    for (i, drawing) in study.figures.iter().enumerate() {
        let title = drawing.title().to_lowercase().replace(' ', "_");
        let name = format!("figure_{}_{title}", i + 1);
        let drawn = drawn(study, runs, i).0;
        let lone = drawn.len() == 1;
        for (k, figure) in drawn.into_iter().enumerate() {
            let name = if lone { name.clone() } else { format!("{name}_{}", k + 1) };
            all.push((name, figure));
        }
    }
    all
}

/// The section of the figure with this number.
pub(crate) fn section(study: &Study, runs: &[Row<'_>], number: usize) -> Section {
    let drawing = &study.figures[number];
    let (figures, rows) = drawn(study, runs, number);
    let title = match drawing {
        Drawing::Fragility { event, .. } => format!("{}: {}", drawing.title(), study.words(event)),
        _ => drawing.title().to_owned(),
    };
    let section = Section::new(format!("figure-{}", number + 1), title).block(figures);
    let Drawing::Fragility { intensity, by, .. } = drawing else { return section };
    let unit = match study.unit(intensity).as_str() {
        "" | "1" => String::new(),
        unit => format!(" [{unit}]"),
    };
    let median = format!("median{unit}");
    let head = [
        "event",
        "of",
        median.as_str(),
        "error of ln(median)",
        "dispersion",
        "error of dispersion",
        "observations",
        "motions",
    ];
    let series = if study.plan.chain.is_some() {
        "Each series of rising intensity is one observation: its capacity lies between two intensities."
    } else {
        "Each run is one observation."
    };
    // Curves of one kind need no name.
    let (mut head, mut rows) = (head.map(str::to_owned).to_vec(), rows);
    if by.is_none() {
        head.remove(1);
        rows.iter_mut().for_each(|row| drop(row.remove(1)));
    }
    section.block(Block::Table { head, rows }).block(Block::note(format!(
        "Lognormal curve of greatest likelihood (Baker 2015). {series} The band is pointwise: from the scatter \
         between motions where motions have several observations (Liang and Zeger 1986), from the observed \
         information otherwise."
    )))
}
