//! A section of the page for each figure.

use super::{fragile, hazard, modes, overturning, spread};
use crate::{Drawing, Record, Study};
use trilith::report::{Block, Section};

/// The section of the figure with this number.
pub(crate) fn section(study: &Study, records: &[Record], number: usize) -> Section {
    let id = format!("figure-{}", number + 1);
    let section = |title: &str| Section::new(id.clone(), title);
    match &study.figures[number] {
        Drawing::ModeChart { x, y, slenderness } => {
            section("Mode chart").block(modes::draw(study, records, (x, y), *slenderness))
        }
        Drawing::Ida { demand, intensity } => section("Incremental dynamic analysis")
            .block(fragile::ida(study, records, demand, intensity)),
        Drawing::Fragility { intensity, event, confidence, by } => {
            let by = by.as_deref();
            let (figure, rows) =
                fragile::fragility(study, records, intensity, event, *confidence, by);
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
                "Each series of rising intensity is one observation: its capacity lies between two \
                 intensities."
            } else {
                "Each run is one observation."
            };
            // Curves of one kind need no name.
            let mut head = head.map(str::to_owned).to_vec();
            let mut rows = rows;
            if by.is_none() {
                head.remove(1);
                rows.iter_mut().for_each(|row| drop(row.remove(1)));
            }
            section(&format!("Fragility: {}", study.words(event)))
                .block(figure)
                .block(Block::Table { head, rows })
                .block(Block::note(format!(
                    "Lognormal curve of greatest likelihood (Baker 2015). {series} The band is pointwise: from \
                     the scatter between motions where motions have several observations (Liang and Zeger 1986), \
                     from the observed information otherwise."
                )))
        }
        Drawing::Overturning { frequency, amplitude, half_sine } => {
            let figure = overturning::draw(study, records, (frequency, amplitude), *half_sine);
            section("Overturning spectrum").block(figure)
        }
        Drawing::Hazard { demand, intensity, rates } => {
            section("Hazard").block(hazard::draw(study, records, (demand, intensity), rates))
        }
        Drawing::Spread { x, y } => {
            section("Points with several runs").block(spread::spread(study, records, x, y))
        }
        Drawing::Points { x, y, by } => {
            section("Runs").block(spread::points(study, records, (x, y), by.as_deref()))
        }
    }
}
