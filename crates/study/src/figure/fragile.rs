//! Incremental dynamic analyses and fragility curves.

use crate::fragility::Capacity;
use crate::{Cell, Condition, Fragility, Place, Row, Study};
use std::collections::HashMap;
use trilith::report::{Color, Figure, Stroke};

/// Most curves in a figure.
const CURVES: usize = 6;

/// The runs of one motion and one structure with rising intensity.
fn series<'a>(study: &Study, runs: &'a [Row<'a>], intensity: &str) -> Vec<Vec<(f64, Row<'a>)>> {
    let axes = &study.plan.axes;
    let along = study.plan.chain.or_else(|| axes.iter().position(|a| a.name == intensity));
    let along = along.or_else(|| (0..axes.len()).max_by_key(|i| axes[*i].values.len()));
    let mut index: HashMap<Place, usize> = HashMap::new();
    let mut all: Vec<Vec<(f64, Row<'_>)>> = Vec::new();
    for r in runs.iter().copied() {
        let Some(im) = r.number(&study.varied, &study.columns, intensity) else { continue };
        let mut place = study.plan.place(r.run());
        if let Some(axis) = along {
            place.axes[axis] = 0;
        }
        let i = *index.entry(place).or_insert_with(|| {
            all.push(Vec::new());
            all.len() - 1
        });
        all[i].push((im, r));
    }
    all.iter_mut().for_each(|s| s.sort_by(|a, b| a.0.total_cmp(&b.0)));
    all
}

pub(super) fn ida(study: &Study, runs: &[Row<'_>], demand: &str, intensity: &str) -> Figure {
    let all = series(study, runs, intensity);
    let value = |r: Row<'_>| r.number(&study.varied, &study.columns, demand);
    let mut curves: Vec<Vec<(f64, f64)>> = Vec::new();
    let mut right = 0.0f64;
    // Beyond the demand where a series was stopped nothing is known of it.
    let mut known = f64::INFINITY;
    for s in &all {
        let mut curve = vec![(0.0, 0.0)];
        for (im, r) in s.iter().filter(|(_, r)| r.good()) {
            match value(*r).filter(|_| !r.overturned()) {
                Some(x) => {
                    right = right.max(x);
                    curve.push((x, *im));
                }
                None => {
                    curve.push((f64::INFINITY, *im));
                    break;
                }
            }
        }
        let stopped = |r: Row<'_>| study.stop.as_ref().is_some_and(|c| c.holds(&study.columns, r));
        if let Some(end) = curve.last().filter(|p| p.0.is_finite())
            && s.last().is_some_and(|(_, r)| stopped(*r))
        {
            known = known.min(end.0);
        }
        curves.push(curve);
    }
    right *= 1.1;
    let gap = (f64::NAN, f64::NAN);
    let drawn = curves.iter().flat_map(|c| {
        let mut line: Vec<(f64, f64)> = Vec::new();
        for (x, im) in c {
            if x.is_finite() {
                line.push((*x, *im));
            } else {
                // The flat line of an overturning body.
                line.push((line.last().map_or(0.0, |p| p.0), *im));
                line.push((right, *im));
            }
        }
        line.push(gap);
        line
    });
    let top = curves.iter().flatten().fold(0.0f64, |a, p| a.max(p.1));
    let one = |(row, r): (usize, Row<'_>)| {
        let im = r.number(&study.varied, &study.columns, intensity)?;
        Some(((value(r).filter(|_| r.good() && !r.overturned())?, im), row))
    };
    let (points, rows): (Vec<_>, Vec<_>) = runs.iter().copied().enumerate().filter_map(one).unzip();
    let mut figure =
        Figure::new("Incremental dynamic analysis", study.label(demand), study.label(intensity))
            .colored("single motions", Stroke::Line, Color::CONTEXT, drawn)
            .colored("runs", Stroke::Rings, Color::CONTEXT, points)
            .standing_for(rows)
            .ranges((0.0, right), (0.0, 1.03 * top));
    for (name, p) in [("median", 0.5), ("16 %", 0.16), ("84 %", 0.84)] {
        let at = |k: usize| {
            let x = right * k as f64 / 200.0;
            let mut reached: Vec<f64> = curves.iter().map(|c| first(c, x)).collect();
            reached.sort_by(f64::total_cmp);
            (x, crate::statistics::quantile(&reached, p))
        };
        figure = figure.line(name, (1..=200).map(at).filter(|q| q.1.is_finite() && q.0 <= known));
    }
    figure.caption(format!(
        "{} series; fractiles are those of the intensity at which a demand is first reached. Flat lines: overturned.",
        curves.len()
    ))
}

/// Intensity at which a curve first reaches a demand; ∞ where it does not.
fn first(curve: &[(f64, f64)], demand: f64) -> f64 {
    let pairs = curve.windows(2).find(|w| w[1].0 >= demand);
    match pairs {
        None => f64::INFINITY,
        Some([_, b]) if b.0 == f64::INFINITY => b.1,
        Some([a, b]) => a.1 + (b.1 - a.1) * (demand - a.0) / (b.0 - a.0),
        Some(_) => f64::INFINITY,
    }
}

pub(super) fn fragility(
    study: &Study,
    runs: &[Row<'_>],
    intensity: &str,
    event: &Condition,
    confidence: f64,
    by: Option<&str>,
) -> (Figure, Vec<Vec<String>>) {
    let what = study.words(event);
    let axis = format!("probability of: {what}");
    let mut figure = Figure::new(format!("Fragility: {what}"), study.label(intensity), axis);
    let mut rows = Vec::new();
    let all = series(study, runs, intensity);
    let groups = match by {
        None => vec![(String::new(), all)],
        Some(by) => split(study, all, by),
    };
    let mut right = 0.0f64;
    for (k, (name, group)) in groups.into_iter().take(CURVES).enumerate() {
        let color = Color::PALETTE[k % Color::PALETTE.len()];
        let label = |text: &str| if name.is_empty() { text.to_owned() } else { name.clone() };
        let good = group.iter().flatten().filter(|(_, r)| r.good());
        let outcomes: Vec<(f64, bool)> =
            good.map(|(im, r)| (*im, event.holds(&study.columns, *r))).collect();
        let from = outcomes.iter().map(|o| o.0).filter(|x| *x > 0.0).fold(f64::MAX, f64::min);
        let to = outcomes.iter().fold(0.0f64, |a, o| a.max(o.0));
        right = right.max(to);
        let motions = motions(study, &group);
        let (points, capacities) = if study.plan.chain.is_some() {
            let one = |(s, m): (&Vec<_>, &usize)| Some((capacity(study, s, event)?, *m));
            let capacities: Vec<_> = group.iter().zip(&motions).filter_map(one).collect();
            let highs = capacities.iter().map(|(c, _)| c.high);
            let mut reached: Vec<f64> = highs.filter(|x| x.is_finite()).collect();
            reached.sort_by(f64::total_cmp);
            let n = capacities.len() as f64;
            let share = |(i, x): (usize, &f64)| (*x, (i + 1) as f64 / n);
            let mut steps: Vec<(f64, f64)> = reached.iter().enumerate().map(share).collect();
            // At each intensity the share of all series that have come to it.
            steps.reverse();
            steps.dedup_by_key(|p| p.0);
            steps.reverse();
            (steps, capacities)
        } else {
            let all =
                group.iter().zip(&motions).flat_map(|(s, m)| s.iter().map(|(im, r)| (*im, *r, *m)));
            let one = |(im, r, m): (f64, Row<'_>, usize)| {
                (Capacity::of_outcome(im, event.holds(&study.columns, r)), m)
            };
            (shares(&outcomes), all.filter(|(_, r, _)| r.good()).map(one).collect())
        };
        let fit = Fragility::fit_motions(&capacities);
        figure = figure.colored(label("share of runs"), Stroke::Rings, color, points);
        match fit {
            Ok(fit) => {
                let ims: Vec<f64> = (0..=150)
                    .map(|i| {
                        (0.5 * from).max(0.02 * to) + (1.1 * to - 0.5 * from) * f64::from(i) / 150.0
                    })
                    .collect();
                let band = |of: fn(crate::Band) -> f64| {
                    ims.iter().map(move |im| (*im, of(fit.at(*im, confidence)))).collect::<Vec<_>>()
                };
                let text = if name.is_empty() { "lognormal fit" } else { "" };
                let bounds = if k == 0 {
                    format!("{:.0} % band", 100.0 * confidence)
                } else {
                    String::new()
                };
                figure = figure
                    .colored(text, Stroke::Line, color, band(|b| b.probability))
                    .colored(bounds, Stroke::Dashes, color, band(|b| b.low))
                    .colored("", Stroke::Dashes, color, band(|b| b.high));
                let [median, dispersion] = fit.standard_errors();
                rows.push(vec![
                    what.clone(),
                    name,
                    format!("{:.4}", fit.median),
                    format!("{:.3}", median),
                    format!("{:.3}", fit.dispersion),
                    format!("{:.3}", dispersion),
                    fit.runs.to_string(),
                    fit.motions.map_or("each its own".to_owned(), |n| n.to_string()),
                ]);
            }
            Err(e) => {
                let none = || "–".to_owned();
                let mut row = vec![what.clone(), name, none(), none(), none(), none()];
                row.extend([e.to_string(), none()]);
                rows.push(row);
            }
        }
    }
    (figure.ranges((0.0, 1.1 * right), (0.0, 1.0)), rows)
}

/// A number for each series, the same for those of one motion: where texts tell points apart those are the
/// records, otherwise everything but the members of an ensemble does.
fn motions(study: &Study, series: &[Vec<(f64, Row<'_>)>]) -> Vec<usize> {
    let axes = &study.plan.axes;
    let texts: Vec<usize> = (0..axes.len()).filter(|i| study.is_text(&axes[*i].name)).collect();
    let text_rows = study.plan.rows.first().is_some_and(|r| r.iter().any(|p| study.is_text(&p.0)));
    let mut known: HashMap<(usize, usize, Vec<usize>), usize> = HashMap::new();
    let mut number = |place: Place| {
        let records = texts.iter().map(|i| place.axes[*i]).collect();
        let key = if !texts.is_empty() || text_rows {
            (if text_rows { place.row } else { 0 }, 0, records)
        } else {
            let mut all = place.axes;
            if let Some(axis) = study.plan.chain {
                all[axis] = 0;
            }
            (place.row, place.sample, all)
        };
        let next = known.len();
        *known.entry(key).or_insert(next)
    };
    series.iter().map(|s| s.first().map_or(0, |(_, r)| number(study.plan.place(r.run())))).collect()
}

/// Between which intensities a series shows the event first.
fn capacity(study: &Study, series: &[(f64, Row<'_>)], event: &Condition) -> Option<Capacity> {
    let mut low = 0.0;
    let mut any = false;
    for (im, r) in series.iter().filter(|(_, r)| r.good()) {
        any = true;
        if event.holds(&study.columns, *r) {
            return Some(Capacity { low, high: *im });
        }
        low = *im;
    }
    any.then_some(Capacity { low, high: f64::INFINITY })
}

/// Share of the runs with the event at each intensity.
fn shares(outcomes: &[(f64, bool)]) -> Vec<(f64, f64)> {
    let mut sorted = outcomes.to_vec();
    sorted.sort_by(|a, b| a.0.total_cmp(&b.0));
    let same = |a: &(f64, bool), b: &(f64, bool)| (a.0 - b.0).abs() <= 1e-9 * a.0.abs();
    let share = |part: &[(f64, bool)]| {
        let hits = part.iter().filter(|p| p.1).count();
        (part[0].0, hits as f64 / part.len() as f64)
    };
    sorted.chunk_by(same).map(share).collect()
}

type Series<'a> = Vec<Vec<(f64, Row<'a>)>>;

/// Series by the value of a parameter or a column.
fn split<'a>(study: &Study, all: Series<'a>, by: &str) -> Vec<(String, Series<'a>)> {
    let mut groups: Vec<(String, Series<'a>)> = Vec::new();
    for s in all {
        let Some((_, first)) = s.first() else { continue };
        let name = value_text(study, *first, by);
        match groups.iter_mut().find(|g| g.0 == name) {
            Some(group) => group.1.push(s),
            None => groups.push((name, vec![s])),
        }
    }
    groups
}

/// `mu = 0.4`, or the text itself.
pub(super) fn value_text(study: &Study, r: Row<'_>, name: &str) -> String {
    let i = study.varied.iter().position(|n| n == name);
    if let Some(Cell::Text(text)) = i.and_then(|i| r.parameter(i)) {
        return text.clone();
    }
    match r.number(&study.varied, &study.columns, name) {
        Some(x) => {
            let unit = study.unit(name);
            let x = (x * 1e6).round() / 1e6;
            format!("{name} = {x} {unit}").trim_end().to_owned()
        }
        None => format!("{name} unknown"),
    }
}
