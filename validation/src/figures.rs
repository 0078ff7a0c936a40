//! The figures of a case: its curves under every solver over the reference.

use crate::case::{Curve, View};
use crate::{Case, Mark, Row, Solver, Trace, Unit};
use trilith_report::{Figure, Stroke};

/// A run of a case: solver, analysis, what it showed.
type Seen = (Solver, Option<&'static str>, Trace);

/// Points of a reference curve.
const POINTS: usize = 600;

pub(crate) fn of_case(case: &Case, rows: &[Row], seen: &[Seen]) -> Vec<Figure> {
    of_view(case, &case.view, rows, seen)
}

fn of_view(case: &Case, view: &View, rows: &[Row], seen: &[Seen]) -> Vec<Figure> {
    match view {
        View::Errors => vec![errors(case.id, rows)],
        View::Histories(curves) => curves.iter().map(|c| history(case, c, seen)).collect(),
        View::Path { x, y, reference } => vec![path(case, *x, *y, reference, seen)],
        View::Several(views) => views.iter().flat_map(|v| of_view(case, v, rows, seen)).collect(),
    }
}

/// An axis label.
fn label(name: &str, unit: Unit) -> String {
    if unit.name.is_empty() { name.to_owned() } else { format!("{name} [{}]", unit.name) }
}

fn history(case: &Case, curve: &Curve, seen: &[Seen]) -> Figure {
    let mut figure = Figure::new(
        format!("{}: {}", case.id, curve.output),
        "time [s]",
        label(curve.output, curve.unit),
    );
    let within = |t: f64| curve.span.is_none_or(|(a, b)| t >= a && t <= b);
    let (mut first, mut last) = (f64::INFINITY, f64::NEG_INFINITY);
    for (solver, _, trace) in seen.iter().filter(|(_, name, _)| *name == curve.analysis) {
        let points = trace.history(curve.output);
        let shown: Vec<_> = points
            .into_iter()
            .filter(|(t, _)| within(*t))
            .map(|(t, v)| (t, v / curve.unit.si))
            .collect();
        if let (Some(a), Some(b)) = (shown.first(), shown.last()) {
            (first, last) = (first.min(a.0), last.max(b.0));
        }
        figure = figure.line(solver.name().to_uppercase(), shown);
    }
    if let Some(f) = &curve.reference
        && last > first
    {
        let times = (0..=POINTS).map(|i| first + (last - first) * i as f64 / POINTS as f64);
        figure = figure.reference("reference", times.map(|t| (t, f(t))));
    }
    let marks: Vec<_> = case
        .checks
        .iter()
        .filter(|c| c.analysis == curve.analysis)
        .filter_map(|c| {
            let reference = c.reference * c.unit.si;
            let (output, t, value) = match c.mark? {
                Mark::Value(output, t) => (output, t, reference),
                Mark::Time(output, level) => (output, reference, level),
            };
            let here = output == curve.output && within(t);
            here.then_some((t, value / curve.unit.si))
        })
        .collect();
    if !marks.is_empty() {
        figure = figure.marks("reference values", marks);
    }
    figure
}

fn path(
    case: &Case,
    x: (&'static str, Unit),
    y: (&'static str, Unit),
    reference: &[(f64, f64)],
    seen: &[Seen],
) -> Figure {
    let mut figure =
        Figure::new(format!("{}: {} over {}", case.id, y.0, x.0), label(x.0, x.1), label(y.0, y.1));
    for (solver, _, trace) in seen.iter().filter(|(_, name, _)| name.is_none()) {
        let (xs, ys) = (trace.history(x.0), trace.history(y.0));
        let points = xs.iter().zip(&ys).map(|(a, b)| (a.1 / x.1.si, b.1 / y.1.si));
        figure = figure.line(solver.name().to_uppercase(), points);
    }
    figure.reference("reference", reference.iter().copied())
}

/// Every quantity's error as share of its tolerance.
fn errors(id: &str, rows: &[Row]) -> Figure {
    let mut quantities: Vec<&str> = Vec::new();
    let mut solvers: Vec<&str> = Vec::new();
    for row in rows {
        if !quantities.contains(&row.quantity.as_str()) {
            quantities.push(&row.quantity);
        }
        if !solvers.contains(&row.solver.as_str()) {
            solvers.push(&row.solver);
        }
    }
    let mut figure = Figure::new(
        format!("{id}: errors"),
        "quantity, as numbered in the table",
        "error / tolerance",
    );
    let count = quantities.len() as f64;
    let shown = 1.0_f64.max(rows.iter().map(share).filter(|s| s.is_finite()).fold(0.0, f64::max));
    figure = figure.whole_x().ranges((0.0, count + 1.0), (-1.1 * shown, 1.1 * shown));
    for (solver, stroke) in solvers.iter().zip([Stroke::Rings, Stroke::Crosses, Stroke::Squares]) {
        let points = rows.iter().filter(|r| r.solver == *solver).filter_map(|r| {
            let i = quantities.iter().position(|q| *q == r.quantity)?;
            Some((i as f64 + 1.0, share(r) * r.error?.signum()))
        });
        figure = figure.series(solver.to_uppercase(), stroke, points);
    }
    let bound = |y: f64| [(0.0, y), (count + 1.0, y)];
    figure.reference("tolerance", bound(1.0)).reference("", bound(-1.0))
}

/// Magnitude of the error as share of the tolerance; 0 where an exact value is met.
fn share(row: &Row) -> f64 {
    match row.error {
        Some(0.0) => 0.0,
        Some(e) => e.abs() / row.tolerance,
        None => f64::NAN,
    }
}
