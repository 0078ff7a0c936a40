//! CSMIP (California Strong Motion Instrumentation Program) volumes 1 and 2, all channels of a file.
//!
//! For each channel: lines of text (`Corrected accelerogram`, or `Uncorrected Accelerogram Data` in volume
//! 1), 100 integers in fields of five, 50 or 100 reals in fields of ten, then `12000 points of accel data
//! equally spaced at .005 sec, in cm/sec2. (8f10.6)`, or in volume 1 `13200 Accelerogram points at 200
//! pts/sec in units of g . Format: (8f9.6)`; volume 2 has velocity and displacement behind it;
//! `/&  ---  End of data for channel 1  ---`.

use super::text::{Text, last_digit, width};
use super::{ReadOptions, check_peak, step, unit};
use crate::error::{Problem, ReadError};
use crate::{Direction, Record, acceleration_unit};

pub(super) fn read(text: &Text<'_>, options: &ReadOptions) -> Result<Vec<Record>, ReadError> {
    let mut records = Vec::new();
    let mut start = 0;
    // The end of a file of old systems is a mark (Ctrl-Z).
    let blank = |l: &&str| l.chars().all(|c| c.is_whitespace() || c.is_control());
    while text.lines[start..].iter().any(|l| !blank(l)) {
        let end = text.find(start, "end of data for").filter(|i| text.lines[*i].starts_with("/&"));
        let Some(end) = end else {
            // The last line of the last channel is missing: so are values.
            let block = channel(text, start, text.lines.len(), options);
            let line = Some(text.lines.len() - 1);
            let problem = Problem::Missing("line `/&  ---  End of data for channel …`");
            return Err(block.err().unwrap_or_else(|| text.fail(line, problem)));
        };
        records.push(channel(text, start, end, options)?);
        start = end + 1;
    }
    if records.is_empty() {
        return Err(text.fail(None, Problem::Missing("channel")));
    }
    Ok(records)
}

fn channel(
    text: &Text<'_>,
    start: usize,
    end: usize,
    options: &ReadOptions,
) -> Result<Record, ReadError> {
    let lower = |i: usize| text.lines[i].to_lowercase();
    let is_data = |l: &str| {
        l.contains("points of accel data equally spaced") || l.contains("accelerogram points at")
    };
    let Some(data) = (start..end).find(|i| is_data(&lower(*i))) else {
        let pairs = (start..end).find(|i| lower(*i).contains("are sec and g"));
        return Err(match pairs {
            Some(i) => text.fail(Some(i), Problem::Pairs),
            None => text.fail(
                Some(start),
                Problem::Missing("line `… points of accel data equally spaced at … sec`"),
            ),
        });
    };
    let line = lower(data);
    let count = line.split_whitespace().next().unwrap_or_default();
    let count = text.count(data, count, "number of values")?;
    let spacing = match line.split_once(" at ") {
        Some((_, rest)) => text.first_number(data, rest)?,
        None => None,
    };
    let dt = spacing.map(|(x, rest)| {
        if rest.trim_start().starts_with("pts/sec") || rest.trim_start().starts_with("samples/sec")
        {
            1.0 / x
        } else {
            x
        }
    });
    let dt = step(text, Some(data), dt, options.dt)?;
    let unit = unit(text, Some(data), stated_unit(text, data, &line)?, options.unit)?;
    let ends = |l: &str| {
        let l = l.to_lowercase();
        l.starts_with("/&") || l.contains("points of")
    };
    // Some files of volume 2 leave the format out; the fields are ten wide.
    let width = width(&line).or(Some(10));
    let (values, after) = text.numbers(data, data + 1, count, width, ends)?;
    if let Some(next) = text.lines.get(after).filter(|l| after < end && !ends(l)) {
        let found = count + next.split_whitespace().count();
        return Err(text.fail(Some(data), Problem::TooMany { stated: count, found }));
    }
    let mut record = Record::new(values.into_iter().map(|a| a * unit).collect(), dt);
    if let Some(peak) = (start..data).find(|i| lower(*i).contains("peak acceleration")) {
        let content = lower(peak);
        let stated = content.split_once('=').map_or("", |(_, rest)| rest);
        if let Some((value, rest)) = text.first_number(peak, stated)? {
            let of = rest.split(" at").next().unwrap_or_default();
            let one = acceleration_unit(of).unwrap_or(unit);
            let digits = stated.split_whitespace().next().unwrap_or_default();
            let stated = value * one;
            check_peak(text, Some(peak), stated, one * last_digit(digits), &record.acceleration)?;
            record.stated_peak = Some(stated.abs());
        }
    }
    describe(text, start, data, &mut record);
    Ok(record)
}

/// `in cm/sec2.`, `(UNITS: CM/SEC/SEC)` or `in units of g .`.
fn stated_unit(text: &Text<'_>, at: usize, line: &str) -> Result<Option<f64>, ReadError> {
    let word = ["units of", "units:", "sec, in"]
        .iter()
        .find_map(|key| line.split_once(key))
        .map(|(_, rest)| rest.trim_start().split([' ', '(', ')', ',']).next().unwrap_or_default());
    match word.map(|w| w.trim_end_matches('.')).filter(|w| !w.is_empty()) {
        None => Ok(None),
        Some(word) => match acceleration_unit(word) {
            Some(unit) => Ok(Some(unit)),
            None => Err(text.fail(Some(at), Problem::UnknownUnit(word.into()))),
        },
    }
}

fn describe(text: &Text<'_>, start: usize, end: usize, record: &mut Record) {
    let mut station_next = false;
    for line in &text.lines[start..end] {
        let lower = line.to_lowercase();
        let trimmed = lower.trim_start();
        if station_next {
            // The name, and the owner far to the right.
            record.station = line.split("   ").next().unwrap_or_default().trim().to_owned();
            station_next = false;
        } else if trimmed.starts_with("station no") || trimmed.starts_with("station id") {
            station_next = true;
        } else if trimmed.starts_with("chan") && record.component.is_empty() {
            let name = line.split_once(':').map_or("", |(_, n)| n).trim();
            record.component = name.to_owned();
            record.direction = Direction::from_name(name);
        } else if record.event.is_empty()
            && (trimmed.starts_with("record of")
                || trimmed.starts_with("rcrd of")
                || trimmed.contains("earthquake"))
        {
            record.event = line.split("   ").next().unwrap_or_default().trim().to_owned();
        }
    }
}
