//! COSMOS strong motion data format, version 1.x (volumes 0 to 3), any number of channels in a file.
//!
//! For each channel: lines of text (the first says how many), a line that says how many integer header
//! values follow in which format, the values, the same for the real header, comment lines, a line such as
//! `7000 acceleration pts, approx 70 secs, units=cm/sec2(04),Format=(8F10.5)`, the data, and
//! `End-of-data for …`.
//!
//! Used: integer header 2 (physical parameter: 1 acceleration), 3 (unit code: 2 g, 4 cm/s², 50 counts) and
//! 54 (azimuth: 400, 401 up, down), real header 34 (time step, s) and 64 (peak). Unknown values are −999.

use super::text::{Text, fields, numeric, width};
use super::{ReadOptions, check_peak, step, unit};
use crate::error::{Problem, ReadError};
use crate::{Direction, Record, STANDARD_GRAVITY, acceleration_unit};

const UNKNOWN: f64 = -999.0;

pub(super) fn read(text: &Text<'_>, options: &ReadOptions) -> Result<Vec<Record>, ReadError> {
    let mut records = Vec::new();
    let mut at = 0;
    while let Some(integers) = text.find(at, "integer-header values follow") {
        let (record, after) = channel(text, at, integers, options)?;
        records.push(record);
        at = after;
    }
    if records.is_empty() {
        let problem = Problem::Missing("line `… Integer-header values follow …`");
        return Err(text.fail(None, problem));
    }
    Ok(records)
}

fn channel(
    text: &Text<'_>,
    start: usize,
    integers: usize,
    options: &ReadOptions,
) -> Result<(Record, usize), ReadError> {
    let (integer, after) = header(text, integers)?;
    let Some(reals) = text.find(after, "real-header values follow") else {
        let problem = Problem::Missing("line `… Real-header values follow …`");
        return Err(text.fail(Some(after), problem));
    };
    let (real, after) = header(text, reals)?;
    let data = (after..text.lines.len()).find(|i| is_data(text.lines[*i]));
    let Some(data) = data else {
        let problem = Problem::Missing("line `… acceleration pts, …, units=…, Format=(…)`");
        return Err(text.fail(Some(after.min(text.lines.len()) - 1), problem));
    };
    let line = text.lines[data];
    let lower = line.to_lowercase();
    if !lower.contains("accel") {
        let what = if lower.contains("vel") { "velocities" } else { "displacements" };
        return Err(text.fail(Some(data), Problem::NotAcceleration(what.into())));
    }
    let count = text.count(data, line.split_whitespace().next().unwrap_or_default(), "count")?;
    let known = |values: &[f64], n: usize| values.get(n - 1).copied().filter(|x| *x != UNKNOWN);
    // `…, dt=.01 sec` of some files.
    let spacing = match lower.split_once("dt=") {
        Some((_, rest)) => text.first_number(data, rest)?.map(|(x, _)| x),
        None => None,
    };
    let dt = step(text, Some(data), known(&real, 34).or(spacing), options.dt)?;
    let stated = match known(&integer, 3).map(|x| x as i64) {
        Some(2) => Some(STANDARD_GRAVITY),
        Some(4) => Some(0.01),
        Some(50) if options.unit.is_none() => return Err(text.fail(Some(data), Problem::Counts)),
        _ => lower
            .split_once("units=")
            .and_then(|(_, u)| acceleration_unit(u.split(['(', ',']).next().unwrap_or_default())),
    };
    let unit = unit(text, Some(data), stated, options.unit)?;
    let ends = |l: &str| l.to_lowercase().starts_with("end-of-data");
    let (values, after) = text.numbers(data, data + 1, count, width(line), ends)?;
    let end = text.lines[after..].iter().position(|l| !l.trim().is_empty()).map(|i| after + i);
    let end = match end {
        Some(i) if ends(text.lines[i].trim_start()) => i + 1,
        _ => after,
    };
    let mut record = Record::new(values.into_iter().map(|a| a * unit).collect(), dt);
    if let Some(peak) = known(&real, 64).filter(|p| *p != 0.0) {
        // In the unit of the data, with six digits.
        check_peak(text, Some(reals), peak * unit, 1e-6 * unit, &record.acceleration)?;
        record.stated_peak = Some((peak * unit).abs());
    }
    describe(text, start, integers, &mut record);
    record.direction = match known(&integer, 54) {
        Some(400.0 | 401.0) => Direction::Vertical,
        Some(azimuth) if (0.0..=360.0).contains(&azimuth) => Direction::Azimuth(azimuth),
        _ => Direction::from_name(&record.component),
    };
    Ok((record, end))
}

fn is_data(line: &str) -> bool {
    let lower = line.to_lowercase();
    lower.contains("pts")
        && lower.contains("format")
        && line.split_whitespace().next().is_some_and(|w| w.parse::<usize>().is_ok())
}

/// Values behind a line that says how many, and the line behind them.
fn header(text: &Text<'_>, line: usize) -> Result<(Vec<f64>, usize), ReadError> {
    let content = text.lines[line];
    let count = content.split_whitespace().next().unwrap_or_default();
    let count = text.count(line, count, "number of header values")?;
    let width = width(content).unwrap_or(10);
    let mut values = Vec::new();
    let mut at = line + 1;
    while values.len() < count {
        let Some(row) = text.lines.get(at) else {
            let problem = Problem::Truncated { stated: count, found: values.len() };
            return Err(text.fail(Some(at - 1), problem));
        };
        for cell in fields(row, width) {
            values.push(if cell.is_empty() {
                UNKNOWN
            } else {
                text.header(at, cell, "number of the header")?
            });
        }
        at += 1;
    }
    let more = text.lines[at..].iter().take_while(|l| numeric(l) && !is_statement(l));
    let found = values.len() + more.map(|l| fields(l, width).len()).sum::<usize>();
    if found > count {
        return Err(text.fail(Some(line), Problem::TooMany { stated: count, found }));
    }
    Ok((values, at))
}

/// A line that begins with a number and says what follows: `100 Real-header values follow …`.
fn is_statement(line: &str) -> bool {
    line.contains(|c: char| c.is_ascii_alphabetic() && !"eEdD".contains(c))
}

/// Station, event and component of the lines of text.
fn describe(text: &Text<'_>, start: usize, end: usize, record: &mut Record) {
    for line in &text.lines[start..end] {
        let lower = line.to_lowercase();
        if lower.starts_with("statn no") {
            let name = line.split_once("Code:").map_or(*line, |(_, n)| n);
            record.station = name.split_whitespace().collect::<Vec<_>>().join(" ");
        } else if lower.starts_with("sta ch") {
            // `Sta Chan  1: 340 deg (Rcrdr Chan  1) Location: …`
            let head = line.split(['(', 'L']).next().unwrap_or_default();
            let name = head.rsplit_once(':').map_or("", |(_, n)| n);
            record.component = name.split_whitespace().collect::<Vec<_>>().join(" ");
        } else if lower.starts_with("record of") && record.event.is_empty() {
            record.event = line[9..].split_whitespace().collect::<Vec<_>>().join(" ");
        }
    }
    if record.event.is_empty() {
        let first = text.find(start, "(format v").filter(|i| *i < end).unwrap_or(start);
        let line = text.lines.get(first + 1).copied().unwrap_or_default();
        record.event = line.split_whitespace().collect::<Vec<_>>().join(" ");
    }
}
