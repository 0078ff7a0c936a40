//! The page of `trilith record`.

use super::text::{about, measures, name};
use super::{Arguments, Item, drawn, pair};
use crate::text::percent;
use trilith::record::measure::{displacement, fourier, husid, rotated, spectrum, velocity};
use trilith::record::synthetic::Target;
use trilith::record::{Record, STANDARD_GRAVITY};
use trilith::report::{Block, Figure, Page, Section};

pub(super) fn page(items: &[Item], args: &Arguments, target: Option<&Target>) -> String {
    let lines = items.iter().map(|item| {
        let notes = item.record.notes.join("; ");
        vec![about(item), notes]
    });
    let head = |cells: &[&str]| cells.iter().map(|c| (*c).to_owned()).collect::<Vec<_>>();
    let mut page = Page::new("Ground motion")
        .lead(Block::Table { head: head(&["record", "done with it"]), rows: lines.collect() });
    let all: Vec<_> = items.iter().map(|i| measures(&i.record)).collect();
    let mut columns = head(&["measure", "unit"]);
    columns.extend((0..items.len()).map(|i| name(items, i)));
    let rows = all.first().into_iter().flatten().enumerate().map(|(k, (what, _, unit))| {
        let mut cells = head(&[what, unit]);
        cells.extend(all.iter().map(|m| m[k].1.clone()));
        cells
    });
    page = page.section(
        Section::new("measures", "Intensity measures")
            .block(Block::Table { head: columns, rows: rows.collect() }),
    );
    page = page.section(spectra(items, args, target));
    if items.len() > 1 {
        page = page.lead(Block::Scales("one scale for all components".into()));
    }
    for (i, item) in items.iter().enumerate() {
        let title = format!("Component {}", name(items, i));
        page = page.section(histories(&format!("component-{i}"), &title, &item.record));
    }
    page.html()
}

fn spectra(items: &[Item], args: &Arguments, target: Option<&Target>) -> Section {
    let periods = drawn();
    let mut figures = Vec::new();
    for z in &args.damping {
        let title = format!("Pseudo-acceleration, {} damping", percent(*z));
        let mut f = Figure::new(title, "period [s]", "PSA [g]").log_x().sized(640, 400);
        for (i, item) in items.iter().enumerate() {
            let s = spectrum(&item.record.acceleration, item.record.dt, &periods, *z);
            f = f.line(name(items, i), curve(&periods, &s.psa(), STANDARD_GRAVITY));
        }
        if let Some(t) = target.filter(|t| t.damping == *z) {
            let (from, to) = (t.points[0].0, t.points[t.points.len() - 1].0);
            let inside = periods.iter().filter(|x| (from..=to).contains(*x));
            f = f.reference("target", inside.map(|x| (*x, t.at(*x) / STANDARD_GRAVITY)));
        }
        if let Some([x, y]) = pair(items) {
            let r = rotated(&x.acceleration, &y.acceleration, x.dt, &periods, *z);
            let of = |f: fn(&trilith::record::measure::Rotated) -> f64| -> Vec<f64> {
                r.iter().map(f).collect()
            };
            f = f.line("RotD50", curve(&periods, &of(|r| r.d50), STANDARD_GRAVITY));
            f = f.reference("RotD100", curve(&periods, &of(|r| r.d100), STANDARD_GRAVITY));
        }
        figures.push(f);
    }
    let z = args.damping[0];
    let mut sd = Figure::new(
        format!("Spectral displacement, {} damping", percent(z)),
        "period [s]",
        "SD [m]",
    )
    .sized(640, 400);
    let mut fourier_figure =
        Figure::new("Fourier amplitude", "frequency [Hz]", "|F| [m/s]").log_log().sized(640, 400);
    for (i, item) in items.iter().enumerate() {
        let r = &item.record;
        let s = spectrum(&r.acceleration, r.dt, &periods, z);
        let values: Vec<f64> = s.responses.iter().map(|x| x.sd).collect();
        sd = sd.line(name(items, i), curve(&periods, &values, 1.0));
        fourier_figure = fourier_figure.line(name(items, i), smooth(r));
    }
    figures.push(sd);
    figures.push(fourier_figure.caption("Means over bands of a twentieth of an octave."));
    Section::new("spectra", "Spectra").block(figures)
}

fn curve(x: &[f64], y: &[f64], unit: f64) -> Vec<(f64, f64)> {
    x.iter().zip(y).map(|(x, y)| (*x, y / unit)).collect()
}

/// Fourier amplitudes, root mean squares over narrow bands, so that the curve can be seen.
fn smooth(r: &Record) -> Vec<(f64, f64)> {
    let f = fourier(&r.acceleration, r.dt);
    let mut out = Vec::new();
    let mut at = i64::MIN;
    let (mut sum, mut count, mut logs) = (0.0_f64, 0.0_f64, 0.0_f64);
    let from = 0.5 / r.duration().max(r.dt);
    for (x, y) in f.frequency.iter().zip(&f.amplitude).filter(|(x, _)| **x > from) {
        let band = (20.0 * x.log2()).floor() as i64;
        if band != at && count > 0.0 {
            out.push(((logs / count).exp(), (sum / count).sqrt()));
            (sum, count, logs) = (0.0, 0.0, 0.0);
        }
        at = band;
        (sum, count, logs) = (sum + y * y, count + 1.0, logs + x.ln());
    }
    if count > 0.0 {
        out.push(((logs / count).exp(), (sum / count).sqrt()));
    }
    out
}

fn histories(id: &str, title: &str, r: &Record) -> Section {
    let over = |values: &[f64], unit: f64| -> Vec<(f64, f64)> {
        r.times().zip(values).map(|(t, y)| (t, y / unit)).collect()
    };
    let figure = |title: &str, label: &str, points: Vec<(f64, f64)>| {
        // Components beside each other.
        let figure = Figure::new(title, "time [s]", label).line("", points);
        figure.timed().scaled(label).peaks().sized(640, 280)
    };
    let a = &r.acceleration;
    let figures = vec![
        figure("Acceleration", "a [g]", over(a, STANDARD_GRAVITY)),
        figure("Velocity", "v [m/s]", over(&velocity(a, r.dt), 1.0)),
        figure("Displacement", "u [m]", over(&displacement(a, r.dt), 1.0)),
        {
            let mut husid =
                figure("Husid curve", "share of the Arias intensity", over(&husid(a, r.dt), 1.0));
            husid.peaks.clear();
            husid
        },
    ];
    Section::new(id, title).block(figures)
}
