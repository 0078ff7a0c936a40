//! Ensembles: medians and bands; and plain points.

use super::fragile::value_text;
use crate::{Row, Study};
use trilith::report::{Color, Figure, Stroke};

/// Most colours of points.
const COLORS: usize = 6;

pub(super) fn spread(study: &Study, runs: &[Row<'_>], x: &str, y: &str) -> Vec<Figure> {
    let groups = study.groups(runs);
    let column = study.columns.iter().position(|c| c.name == y);
    let text = study.is_text(x);
    let at = |i: usize, r: Row<'_>| {
        if text { Some((i + 1) as f64) } else { r.number(&study.varied, &study.columns, x) }
    };
    let (mut low, mut median, mut high) = (Vec::new(), Vec::new(), Vec::new());
    let (mut nominal, mut flagged, mut singles) = (Vec::new(), Vec::new(), Vec::new());
    let counted = study.counted(runs);
    let mut shares = vec![Vec::new(); counted.len()];
    let mut rows = Vec::new();
    for (i, group) in groups.iter().enumerate() {
        let Some(first) = group.runs.first().copied() else { continue };
        let Some(place) = at(i, first) else { continue };
        let value = |r: Row<'_>| r.number(&study.varied, &study.columns, y);
        for r in group.runs.iter().copied() {
            // Records stand in the order of their runs.
            let row = runs.binary_search_by_key(&r.run(), |x| x.run());
            if let (Some(v), Ok(row)) = (value(r), row) {
                singles.push((place, v));
                rows.push(row);
            }
        }
        if study.plan.place(first.run()).member == 0
            && let Some(v) = value(first)
        {
            nominal.push((place, v));
        }
        if let Some(s) = column.and_then(|k| study.spread(group, k)) {
            low.push((place, s.low));
            median.push((place, s.median));
            high.push((place, s.high));
            if study.sensitivity(group).is_some_and(|s| s.sensitive > 0) {
                flagged.push((place, s.median));
            }
        }
        for (list, (_, condition)) in shares.iter_mut().zip(&counted) {
            if let Some(share) = study.share(group, condition) {
                list.push((place, share));
            }
        }
    }
    let sort = |points: &mut Vec<(f64, f64)>| points.sort_by(|a, b| a.0.total_cmp(&b.0));
    [&mut low, &mut median, &mut high].into_iter().for_each(sort);
    let (title, label) = (format!("{} of the points", y.replace('_', " ")), study.label(x));
    let mut figure = Figure::new(title, label.clone(), study.label(y))
        .colored("runs", Stroke::Rings, Color::CONTEXT, singles)
        .standing_for(rows)
        .line("median", median)
        .colored("16 % and 84 %", Stroke::Dashes, Color::PALETTE[0], low)
        .colored("", Stroke::Dashes, Color::PALETTE[0], high);
    if study.plan.ensemble.is_some() {
        figure = figure.marks("nominal case", nominal);
    }
    if !flagged.is_empty() {
        figure = figure.colored("sensitive", Stroke::Crosses, Color::PALETTE[1], flagged);
    }
    // A body that fell has turned by whatever the end of the run left it: its frame would hide all others.
    let fell = runs.iter().any(|r| r.overturned());
    let standing = |r: &Row<'_>| !r.overturned();
    let places = || groups.iter().enumerate().filter_map(|(i, g)| at(i, *g.runs.first()?));
    let (mut left, mut right) = (f64::INFINITY, f64::NEG_INFINITY);
    places().for_each(|x| (left, right) = (left.min(x), right.max(x)));
    let values = || {
        let of = |r: Row<'_>| r.number(&study.varied, &study.columns, y);
        runs.iter().copied().filter(standing).filter_map(of)
    };
    let (low, high) = (values().fold(0.0f64, f64::min), values().fold(f64::NEG_INFINITY, f64::max));
    if fell && high > low && right > left {
        let edge = 0.03 * (right - left);
        figure = figure
            .ranges((left - edge, right + edge), (1.05 * low, 1.05 * high))
            .caption("Runs that overturned are above the frame where they left it.");
    }
    let mut figures = vec![if text { figure.whole_x() } else { figure }];
    if !counted.is_empty() {
        let mut share = Figure::new("How often", label, "share of runs, and 90 % interval");
        for (k, ((name, _), mut list)) in counted.iter().zip(shares).enumerate() {
            let color = Color::PALETTE[k % Color::PALETTE.len()];
            list.sort_by(|a, b| a.0.total_cmp(&b.0));
            let ends =
                list.iter().flat_map(|(x, s)| [(*x, s[1]), (*x, s[2]), (f64::NAN, f64::NAN)]);
            let ends: Vec<_> = ends.collect();
            share = share.colored("", Stroke::Line, color, ends).colored(
                name,
                Stroke::Squares,
                color,
                list.iter().map(|(x, s)| (*x, s[0])),
            );
        }
        share.y.range = Some((0.0, 1.0));
        figures.push(share);
    }
    figures
}

/// A point, and the row of its run.
type Point = ((f64, f64), usize);

pub(super) fn points(
    study: &Study,
    runs: &[Row<'_>],
    (x, y): (&str, &str),
    by: Option<&str>,
) -> Figure {
    let title = format!("{} over {}", y.replace('_', " "), x.replace('_', " "));
    let mut figure = Figure::new(title, study.label(x), study.label(y));
    let mut groups: Vec<(String, Vec<Point>)> = Vec::new();
    for (row, r) in runs.iter().copied().enumerate() {
        let number = |name| r.number(&study.varied, &study.columns, name);
        let (Some(a), Some(b)) = (number(x), number(y)) else { continue };
        let name = by.map_or_else(String::new, |by| value_text(study, r, by));
        let last = COLORS - 1;
        match groups.iter().position(|g| g.0 == name) {
            Some(i) => groups[i].1.push(((a, b), row)),
            None if groups.len() < COLORS => groups.push((name, vec![((a, b), row)])),
            None => {
                groups[last].0 = "others".to_owned();
                groups[last].1.push(((a, b), row));
            }
        }
    }
    for (name, points) in groups {
        let (points, rows): (Vec<_>, Vec<_>) = points.into_iter().unzip();
        figure = figure.series(name, Stroke::Rings, points).standing_for(rows);
    }
    figure
}
