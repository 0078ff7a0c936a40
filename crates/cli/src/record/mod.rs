//! `trilith record`: ground motion records, and synthetic motions.

mod arguments;
mod page;
mod text;

pub(crate) use arguments::Arguments;

use crate::{Answer, Failure, place};
use std::path::Path;
use trilith::record::measure::{periods, spectrum};
use trilith::record::synthetic::{Compatible, Fit, KanaiTajimi, Target};
use trilith::record::{Columns, Problem, ReadError, Record, cell};
use trilith::results::Writer;

/// A component, and the file it comes from.
struct Item {
    file: String,
    record: Record,
}

pub(crate) fn record(args: &Arguments) -> Result<Answer, Failure> {
    let mut items = Vec::new();
    for file in &args.files {
        items.extend(read(file, args)?);
    }
    let mut target = None;
    let mut fit = None;
    if let Some(seed) = args.synthetic {
        let (item, wanted, found) = synthetic(seed, args)?;
        items.push(item);
        (target, fit) = (wanted, found);
    }
    let processing = args.processing()?;
    for item in &mut items {
        item.record = processing.apply(&item.record).map_err(|e| {
            Failure::input(&format!("{}, {}: {e}", item.file, item.record.component), None)
        })?;
    }
    let mut text = text::text(&items, args, fit)?;
    if let Some(dir) = &args.out {
        let files = files(&items, args, target.as_ref())?;
        let writer = Writer {
            name: "record",
            own: &[],
            writes: files.iter().map(|(name, _)| name.clone()).collect(),
            inputs: args.files.iter().chain(&args.spectrum).cloned().collect(),
        };
        for path in place::write(place::open(dir, writer)?, &files)? {
            text += &format!("{path}\n");
        }
    }
    Ok(text.into())
}

fn refuse(error: &ReadError) -> Failure {
    let help = match &error.problem {
        Problem::NoUnit => Some("give `--unit g`, or state it in the file: `# unit: g`".to_owned()),
        Problem::NoStep => Some("give `--dt \"5 ms\"`, or a column of times".to_owned()),
        Problem::Counts => Some("give `--unit`: the acceleration of one count".to_owned()),
        _ => error.help(),
    };
    Failure::input(&error.to_string(), help.as_deref())
}

/// The pseudo-accelerations of a component, m/s².
fn psa(item: &Item, periods: &[f64], damping: f64) -> Result<Vec<f64>, Failure> {
    let r = &item.record;
    let all = spectrum(&r.acceleration, r.dt, periods, damping).psa();
    finite(item, periods, &all)?;
    Ok(all)
}

/// Holds the ordinates of a spectrum to be finite.
fn finite(item: &Item, periods: &[f64], all: &[f64]) -> Result<(), Failure> {
    let Some((t, _)) = periods.iter().zip(all).find(|(_, a)| !a.is_finite()) else {
        return Ok(());
    };
    let message = format!(
        "{}, {}: the pseudo-acceleration at a period of {t:?} s is not finite",
        item.file, item.record.component
    );
    Err(Failure::input(&message, Some("look at the values, their unit and the time step")))
}

fn read(file: &Path, args: &Arguments) -> Result<Vec<Item>, Failure> {
    let mut all = trilith::record::read(file, &args.reading()).map_err(|e| refuse(&e))?;
    if args.component.is_some() {
        let one = trilith::record::select(all, args.component.as_ref(), file);
        all = vec![one.map_err(|e| refuse(&e))?];
    }
    let name = file.file_name().unwrap_or(file.as_os_str()).to_string_lossy().into_owned();
    Ok(all.into_iter().map(|record| Item { file: name.clone(), record }).collect())
}

fn synthetic(seed: u64, args: &Arguments) -> Result<(Item, Option<Target>, Option<Fit>), Failure> {
    let plain = KanaiTajimi::default();
    let start = KanaiTajimi {
        seed,
        peak: args.peak.unwrap_or(plain.peak),
        duration: args.duration.unwrap_or(plain.duration),
        dt: args.dt.unwrap_or(plain.dt),
        frequency: args.ground_frequency.unwrap_or(plain.frequency),
        damping: args.ground_damping.unwrap_or(plain.damping),
        ..plain
    };
    let fail = |e: trilith::record::synthetic::SyntheticError| Failure::input(&e.to_string(), None);
    let (mut record, target, fit) = match &args.spectrum {
        None => (start.make().map_err(fail)?, None, None),
        Some(path) => {
            let target = Target { points: points(path, args)?, damping: args.damping[0] };
            let (record, fit) =
                Compatible { target: target.clone(), start }.make().map_err(fail)?;
            (record, Some(target), Some(fit))
        }
    };
    record.notes.push("made by trilith record --synthetic".into());
    Ok((Item { file: format!("synthetic_{seed}"), record }, target, fit))
}

/// A target spectrum: columns of period (s) and pseudo-acceleration.
fn points(path: &Path, args: &Arguments) -> Result<Vec<(f64, f64)>, Failure> {
    use trilith::record::Column::Position;
    let columns = Columns::read(path, 0).map_err(|e| refuse(&e))?;
    let periods = columns.numbers(&Position(0)).map_err(|e| refuse(&e))?;
    let values = columns.numbers(&Position(1)).map_err(|e| refuse(&e))?;
    let unit = columns.unit(1).or(args.unit).ok_or_else(|| {
        let message = format!("{}: the unit of the spectrum is stated nowhere", path.display());
        Failure::input(&message, Some("give `--unit g`, or a header `period [s],sa [g]`"))
    })?;
    Ok(periods.into_iter().zip(values.into_iter().map(|a| a * unit)).collect())
}

/// The periods of drawn spectra, s.
fn drawn() -> Vec<f64> {
    periods(0.02, 10.0, 150)
}

/// The two horizontal components, where there are just two with the same step.
fn pair(items: &[Item]) -> Option<[&Record; 2]> {
    let horizontal: Vec<&Record> =
        items.iter().map(|i| &i.record).filter(|r| r.is_horizontal()).collect();
    match horizontal.as_slice() {
        [a, b] if (a.dt - b.dt).abs() < 1e-9 * a.dt => Some([a, b]),
        _ => None,
    }
}

/// What goes into the folder: names and contents.
fn files(
    items: &[Item],
    args: &Arguments,
    target: Option<&Target>,
) -> Result<Vec<(String, String)>, Failure> {
    // First, since it finds what is not finite.
    let table = spectra(items, args)?;
    let mut files = vec![
        ("record.html".to_owned(), page::page(items, args, target)),
        ("spectra.csv".to_owned(), table),
    ];
    let mut taken: Vec<String> = Vec::new();
    for item in items {
        let stem = Path::new(&item.file).file_stem().unwrap_or_default().to_string_lossy();
        let of = |i: &Item| Path::new(&i.file).file_stem().map(std::ffi::OsStr::to_owned);
        let several = items.iter().filter(|i| of(i) == of(item)).count() > 1;
        let part = if several { format!("_{}", item.record.component) } else { String::new() };
        let plain: String = format!("{stem}{part}")
            .chars()
            .map(|c| if c.is_alphanumeric() || "-_.".contains(c) { c } else { '_' })
            .collect();
        let mut name = plain.clone();
        while taken.contains(&name) {
            name.push('_');
        }
        taken.push(name.clone());
        files.push((format!("{name}.csv"), item.record.to_csv()));
    }
    Ok(files)
}

/// Spectra as lines of a table.
fn spectra(items: &[Item], args: &Arguments) -> Result<String, Failure> {
    let mut out =
        String::from("file,component,damping,period [s],sd [m],psv [m/s],psa [m/s^2],sa [m/s^2]\n");
    let quoted = |s: &str| format!("\"{}\"", cell(s).replace('"', "'"));
    for item in items {
        let Item { file, record: r } = item;
        for z in &args.damping {
            let s = spectrum(&r.acceleration, r.dt, &drawn(), *z);
            finite(item, &s.periods, &s.psa())?;
            for (t, x) in s.periods.iter().zip(&s.responses) {
                out += &format!(
                    "{},{},{z:?},{t:?},{:?},{:?},{:?},{:?}\n",
                    quoted(file),
                    quoted(&r.component),
                    x.sd,
                    x.psv,
                    x.psa,
                    x.sa
                );
            }
        }
    }
    Ok(out)
}
