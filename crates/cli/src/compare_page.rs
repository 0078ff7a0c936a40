//! A comparison as a page: the histories over each other.

use crate::compare::{answer, differences};
use crate::report::work;
use crate::text::{number, row};
use trilith::Model;
use trilith::compare::Compared;
use trilith::model::Output;
use trilith::report::{Block, Figure, Page, Section, Shown};

/// One self-contained page.
pub(crate) fn page(model: &Model, case: &str, all: &[Compared]) -> String {
    let title = if model.title.is_empty() { "Comparison" } else { &model.title };
    let mut page = Page::new(title).lead(Block::text(format!(
        "Case \"{case}\" in {} ways; differences are from the first.",
        all.len()
    )));
    for c in &all[1..] {
        page = page.lead(Block::text(answer(&all[0], c)));
    }
    for finding in all.iter().filter_map(|c| Some((&c.variant, c.finding.as_ref()?))) {
        page = page.lead(Block::text(format!(
            "{}: likely cause of its difference: {}.",
            finding.0, finding.1
        )));
    }
    let mut table = vec![row(["variant", "status", "CPU set-up [s]", "CPU march [s]", "work"])];
    for c in all {
        let s = &c.outcome.summary;
        let [setup, march] = [s.work.setup_cpu_s, s.work.march_cpu_s].map(number);
        table.push(row([&c.variant.to_string(), s.status, &setup, &march, &work(&s.work)]));
    }
    page = page.section(Section::new("work", "Work and time").block(block(table)));
    let mut apart = Section::new("differences", "Differences");
    for c in &all[1..] {
        apart = apart.block(Block::text(format!("{} beside {}", c.variant, all[0].variant)));
        apart = apart.block(block(differences(c)));
    }
    page = page.section(apart);
    let scale = Block::Scales("one scale for all outputs of a unit".into());
    let (over, apart) = figures(model, all);
    page.section(Section::new("histories", "Histories").block(over))
        .section(Section::new("over-time", "Differences over time").block(scale).block(apart))
        .html()
}

/// The histories over each other, and what they differ from the first by.
fn figures(model: &Model, all: &[Compared]) -> (Vec<Figure>, Vec<Figure>) {
    let size = |i: usize| {
        let values = all.iter().flat_map(|c| &c.outcome.histories[i]);
        values.filter(|y| y.is_finite()).fold(0.0_f64, |a, y| a.max(y.abs()))
    };
    let outputs = || model.outputs.iter().enumerate();
    let largest = |unit: &str| {
        outputs().filter(|(_, o)| o.unit == unit).map(|(i, _)| size(i)).fold(0.0, f64::max)
    };
    // Nothing but rounding beside its like is a line at zero.
    let noise = |i: usize, unit: &str| size(i) < 1e-9 * largest(unit);
    let of = |c: &Compared, i: usize, unit: &str, factor: f64| -> Vec<(f64, f64)> {
        let factor = if noise(i, unit) { 0.0 } else { factor };
        let o = &c.outcome;
        o.time.iter().copied().zip(o.histories[i].iter().map(|y| factor * y)).collect()
    };
    let less = |c: &Compared, i: usize, unit: &str| -> Vec<(f64, f64)> {
        let first = of(&all[0], i, unit, 1.0);
        of(c, i, unit, 1.0).into_iter().map(|(t, y)| (t, y - at(&first, t))).collect()
    };
    let figure =
        |name: &str, label: String| Figure::new(name, "time [s]", label).sized(620, 340).timed();
    let over = |(i, o): (usize, &Output)| {
        let shown = Shown::fitting(&o.unit, size(i));
        let empty = figure(&o.name, shown.labelled(&o.name));
        all.iter()
            .fold(empty, |f, c| f.line(c.variant.to_string(), of(c, i, &o.unit, shown.factor)))
            .peaks()
    };
    // Differences of one unit have one scale.
    let apart_by = |unit: &str| {
        let these = outputs().filter(|(_, o)| o.unit == unit);
        let all = these
            .flat_map(|(i, _)| all[1..].iter().flat_map(|c| less(c, i, unit)).collect::<Vec<_>>());
        all.map(|p| p.1).filter(|y| y.is_finite()).fold(0.0_f64, |a, y| a.max(y.abs()))
    };
    let apart = |(i, o): (usize, &Output)| {
        let shown = Shown::fitting(&o.unit, apart_by(&o.unit));
        let label = shown.labelled(&format!("less {}", all[0].variant));
        let one = |f: Figure, c: &Compared| {
            let points = less(c, i, &o.unit).into_iter().map(|(t, y)| (t, shown.factor * y));
            f.line(c.variant.to_string(), points)
        };
        all[1..].iter().fold(figure(&o.name, label), one).scaled(o.unit.clone())
    };
    (outputs().map(over).collect(), outputs().map(apart).collect())
}

/// Value at a time, linear between points at rising times; not a number outside.
fn at(points: &[(f64, f64)], t: f64) -> f64 {
    let i = points.partition_point(|p| p.0 < t);
    match (points.get(i.wrapping_sub(1)), points.get(i)) {
        (_, Some(b)) if b.0 == t => b.1,
        (Some(a), Some(b)) => a.1 + (b.1 - a.1) * (t - a.0) / (b.0 - a.0),
        _ => f64::NAN,
    }
}

/// Rows, the first of which is the head.
fn block(mut rows: Vec<Vec<String>>) -> Block {
    let head = rows.remove(0);
    Block::Table { head, rows }
}

#[cfg(test)]
mod tests {
    use super::at;

    #[test]
    fn values_are_linear_between_points_and_none_outside() {
        let line = [(0.0, 1.0), (1.0, 3.0), (1.5, 3.0)];
        for (t, y) in [(0.0, 1.0), (0.25, 1.5), (1.0, 3.0), (1.5, 3.0)] {
            assert_eq!(at(&line, t), y);
        }
        assert!(at(&line, -0.1).is_nan() && at(&line, 1.6).is_nan());
    }
}
