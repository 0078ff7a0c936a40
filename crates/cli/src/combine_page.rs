//! Combinations as a table of comma-separated values, and as a page.

use crate::combine::{formula, rows};
use trilith::Model;
use trilith::combine::{Combinations, CombinedOutput};
use trilith::record::cell;
use trilith::report::{Block, Figure, Page, Section, Shown};

/// Half the width of the ends of a range.
const END: f64 = 0.3;

/// Every output of all cases and combinations, in SI: a line each.
pub(crate) fn table(found: &Combinations) -> String {
    let mut file = csv::Writer::from_writer(Vec::new());
    let mut line = |cells: [&str; 8]| {
        // Nothing can go wrong in memory.
        let _ = file.write_record(cells.map(|text| cell(text).into_owned()));
    };
    line(["what", "name", "output", "unit", "max", "max from", "min", "min from"]);
    for (what, name, outputs) in parts(found) {
        for o in outputs {
            let from = |term: &Option<String>| term.clone().unwrap_or_default();
            let [max, min] = [o.max, o.min].map(|x| format!("{x:?}"));
            let [max_from, min_from] = [&o.max_from, &o.min_from].map(from);
            line([what, name, &o.output, &o.unit, &max, &max_from, &min, &min_from]);
        }
    }
    String::from_utf8(file.into_inner().unwrap_or_default()).unwrap_or_default()
}

/// Cases, then combinations: what it is, its name, and its outputs.
fn parts(found: &Combinations) -> impl Iterator<Item = (&'static str, &str, &[CombinedOutput])> {
    let cases = found.cases.iter().map(|c| ("case", &*c.name, &*c.outputs));
    let sums = found.combinations.iter().map(|c| ("combination", &*c.name, &*c.outputs));
    cases.chain(sums)
}

/// One self-contained page.
pub(crate) fn page(model: &Model, found: &Combinations) -> String {
    let title = if model.title.is_empty() { "Combinations" } else { &model.title };
    let cases = found.cases.iter().map(|c| format!("\"{}\" ({})", c.name, c.solver));
    let cases: Vec<String> = cases.collect();
    let mut page = Page::new(title).lead(Block::text(format!(
        "Combinations of the extremes of {} cases: {}. Values in SI.",
        cases.len(),
        cases.join(", ")
    )));
    // What is asked first comes first: envelopes stand behind what they are of.
    for (i, one) in found.combinations.iter().enumerate().rev() {
        let mut own = rows(one).0;
        let head = own.remove(0);
        let mut section = Section::new(format!("c{i}"), one.name.clone())
            .block(Block::text(formula(one)))
            .block(Block::Table { head, rows: own });
        if let Some(text) = one.warning() {
            section = section.block(Block::note(format!("Warning: {text}.")));
        }
        page = page.section(section);
    }
    let count = found.cases.first().map_or(0, |c| c.outputs.len());
    let figures: Vec<Figure> = (0..count).map(|i| figure(found, i)).collect();
    let note = "From the smallest to the largest value in each case and each combination; names beneath a figure switch them.";
    let ranges = Section::new("ranges", "Ranges").block(Block::note(note)).block(figures);
    page.section(ranges).html()
}

/// Ranges of an output, side by side.
fn figure(found: &Combinations, i: usize) -> Figure {
    let all = || parts(found).filter_map(move |(_, name, outputs)| Some((name, outputs.get(i)?)));
    let (name, unit) = all().next().map_or(("", ""), |(_, o)| (&*o.output, &*o.unit));
    let size = all().map(|(_, o)| o.max.abs().max(o.min.abs())).fold(0.0, f64::max);
    let shown = Shown::fitting(unit, size);
    let figure = Figure::new(name, "case or combination", shown.labelled(name)).sized(620, 340);
    all().enumerate().fold(figure, |figure, (at, (name, o))| {
        let (x, [low, high]) = (at as f64 + 1.0, [o.min, o.max].map(|y| shown.factor * y));
        let ends = [(-END, low), (END, low), (0.0, low), (0.0, high), (-END, high), (END, high)];
        figure.line(name, ends.map(|(dx, y)| (x + dx, y)))
    })
}
