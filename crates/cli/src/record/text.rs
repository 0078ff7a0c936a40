//! What `trilith record` prints.

use super::{Arguments, Item, pair, psa};
use crate::Failure;
use crate::text::{percent, row, significant, table};
use trilith::model::visible_line;
use trilith::record::measure::{
    arias, cav, displacement, peak, rotated, significant_duration, velocity,
};
use trilith::record::synthetic::Fit;
use trilith::record::{Record, STANDARD_GRAVITY};

fn digits(x: f64) -> String {
    significant(x, 4)
}

/// Name, value and unit of the measures of a record.
pub(super) fn measures(r: &Record) -> Vec<(&'static str, String, &'static str)> {
    let a = &r.acceleration;
    let span = |from, to| {
        let [t0, t1] = significant_duration(a, r.dt, from, to);
        digits(t1 - t0)
    };
    vec![
        ("time step", digits(r.dt), "s"),
        ("samples", a.len().to_string(), ""),
        ("duration", digits(r.duration()), "s"),
        ("PGA", digits(peak(a) / STANDARD_GRAVITY), "g"),
        ("PGV", digits(peak(&velocity(a, r.dt))), "m/s"),
        ("PGD", digits(peak(&displacement(a, r.dt))), "m"),
        ("Arias intensity", digits(arias(a, r.dt)), "m/s"),
        ("D5-75", span(0.05, 0.75), "s"),
        ("D5-95", span(0.05, 0.95), "s"),
        ("CAV", digits(cav(a, r.dt)), "m/s"),
    ]
}

/// What a record is, in a line.
pub(super) fn about(item: &Item) -> String {
    let r = &item.record;
    let format = r.format.map_or("made here", trilith::record::Format::name);
    let parts = [item.file.as_str(), &r.component, &r.station, &r.event, format];
    let parts: Vec<&str> = parts.into_iter().filter(|p| !p.is_empty()).collect();
    parts.join(" · ")
}

/// A short name of each component.
pub(super) fn name(items: &[Item], i: usize) -> String {
    let item = &items[i];
    let same = items.iter().filter(|j| j.record.component == item.record.component).count() > 1;
    match (same, item.record.component.is_empty()) {
        (true, false) => format!("{} {}", item.file, item.record.component),
        (_, true) => item.file.clone(),
        _ => item.record.component.clone(),
    }
}

pub(super) fn text(items: &[Item], args: &Arguments, fit: Option<Fit>) -> Result<String, Failure> {
    let mut out = String::new();
    for item in items {
        out += &format!("{}\n", visible_line(&about(item)));
        for note in &item.record.notes {
            out += &format!("  {}\n", visible_line(note));
        }
    }
    if let Some(fit) = fit {
        out += &format!(
            "  response over target: off by {} in the mean, {} at worst\n",
            percent(fit.mean),
            percent(fit.worst)
        );
    }
    let all: Vec<_> = items.iter().map(|i| measures(&i.record)).collect();
    let mut rows = vec![row(["", ""])];
    rows[0].extend((0..items.len()).map(|i| name(items, i)));
    for (k, (what, _, unit)) in all.first().into_iter().flatten().enumerate() {
        let mut cells = row([what, unit]);
        cells.extend(all.iter().map(|m| m[k].1.clone()));
        rows.push(cells);
    }
    out += &format!("\n{}", table(&rows, &[0, 1]));
    for z in &args.damping {
        out += &format!("\npseudo-acceleration [g] at {} damping\n", percent(*z));
        let mut head = row(["period [s]"]);
        head.extend((0..items.len()).map(|i| name(items, i)));
        let mut columns: Vec<Vec<f64>> =
            items.iter().map(|i| psa(i, &args.periods, *z)).collect::<Result<_, _>>()?;
        if let Some([x, y]) = pair(items) {
            let r = rotated(&x.acceleration, &y.acceleration, x.dt, &args.periods, *z);
            head.extend(row(["RotD50", "RotD100", "geom. mean"]));
            columns.push(r.iter().map(|r| r.d50).collect());
            columns.push(r.iter().map(|r| r.d100).collect());
            columns.push(r.iter().map(|r| r.geometric_mean).collect());
        }
        let mut rows = vec![head];
        for (k, period) in args.periods.iter().enumerate() {
            let mut cells = row([&digits(*period)]);
            cells.extend(columns.iter().map(|c| digits(c[k] / STANDARD_GRAVITY)));
            rows.push(cells);
        }
        out += &table(&rows, &[]);
    }
    Ok(out)
}
