//! PEER NGA `.AT2`, and files that follow it.
//!
//! Four lines of header: the data base, event and station, quantity and unit, and `NPTS= n, DT= dt SEC`
//! (older: `n dt NPTS, DT`); then the values in rows. The Peknold version of El Centro 1940 says `n points at
//! equal spacing of dt sec` instead. Lines of stars around the data are passed over.

use super::number::words;
use super::text::Text;
use super::{ReadOptions, step, unit};
use crate::error::{Problem, ReadError};
use crate::{Direction, Record, acceleration_unit};

pub(super) fn read(text: &Text<'_>, options: &ReadOptions) -> Result<Vec<Record>, ReadError> {
    let (line, count, dt) = layout(text)?;
    let (unit_line, stated) = stated_unit(text, line)?;
    let unit = unit(text, unit_line, stated, options.unit)?;
    let dt = step(text, Some(line), Some(dt), options.dt)?;
    let mut first = line + 1;
    // Between the header and the numbers there may be lines of words.
    while text.lines.get(first).is_some_and(|l| !numeric(l)) && first < line + 6 {
        first += 1;
    }
    let over = |l: &str| l.trim_start().starts_with("***");
    let (values, after) = text.numbers(line, first, count, None, over)?;
    let rest = text.lines[after..].iter().take_while(|l| !over(l)).filter(|l| numeric(l));
    let more: usize = rest.map(|l| words(l).len()).sum();
    if more > 0 {
        let problem = Problem::TooMany { stated: count, found: count + more };
        return Err(text.fail(Some(line), problem));
    }
    let mut record = Record::new(values.into_iter().map(|a| a * unit).collect(), dt);
    describe(text, line, &mut record);
    Ok(vec![record])
}

/// A line of numbers, or of what stands in the place of one.
fn numeric(line: &str) -> bool {
    super::text::numeric(line)
        || words(line).first().is_some_and(|w| w.starts_with(['-', '+', '.']) && w.len() > 1)
}

/// The line with count and step, and both.
fn layout(text: &Text<'_>) -> Result<(usize, usize, f64), ReadError> {
    const HEAD: usize = 15;
    if let Some(line) = text.find(0, "npts").filter(|i| *i < HEAD) {
        let content = text.lines[line];
        let upper = content.to_ascii_uppercase();
        let named = upper
            .find("NPTS")
            .map(|i| i + 4)
            .filter(|i| upper[*i..].trim_start().starts_with(['=', ':']));
        let (count, dt) = match named {
            Some(at) => {
                let Some(dt) = upper[at..].find("DT") else {
                    return Err(text.fail(Some(line), Problem::NoStep));
                };
                (value(&content[at..]), value(&content[at + dt + 2..]))
            }
            // `4164    0.0100    NPTS, DT`
            None => {
                let all = words(content);
                let word = |i: usize| all.get(i).copied().unwrap_or_default();
                (word(0), word(1))
            }
        };
        let count = text.count(line, count.trim_end_matches('.'), "number of values")?;
        if dt.is_empty() || dt.to_ascii_uppercase().starts_with("SEC") {
            return Err(text.fail(Some(line), Problem::NoStep));
        }
        let letter = |c: char| c.is_ascii_alphabetic() && !matches!(c, 'e' | 'E' | 'd' | 'D');
        let digits = &dt[..dt.find(letter).unwrap_or(dt.len())];
        let dt = text.header(line, digits.trim_end_matches(['e', 'E', 'd', 'D']), "time step")?;
        return Ok((line, count, dt));
    }
    if let Some(line) = text.find(0, "points at equal spacing of").filter(|i| *i < HEAD) {
        let missing = || text.fail(Some(line), Problem::NoStep);
        let (count, rest) = text.first_number(line, text.lines[line])?.ok_or_else(missing)?;
        let (dt, _) = text.first_number(line, rest)?.ok_or_else(missing)?;
        if count < 0.0 || count.fract() != 0.0 {
            let problem = Problem::Header { text: count.to_string(), what: "number of values" };
            return Err(text.fail(Some(line), problem));
        }
        return Ok((line, count as usize, dt));
    }
    Err(text.fail(None, Problem::Missing("line `NPTS= …, DT= … SEC` in its header")))
}

/// What stands behind a key: `= 4164, …`. A comma with a digit behind it does not end it.
fn value(rest: &str) -> &str {
    let rest = rest.trim_start_matches([' ', '\t', '=', ':']);
    let ends = |(i, c): &(usize, char)| match *c {
        ' ' | '\t' => true,
        ',' => !rest[i + 1..].starts_with(|c: char| c.is_ascii_digit()),
        _ => false,
    };
    let end = rest.char_indices().find(ends).map_or(rest.len(), |(i, _)| i);
    &rest[..end]
}

/// The unit of the header, and the line that states it.
fn stated_unit(text: &Text<'_>, last: usize) -> Result<(Option<usize>, Option<f64>), ReadError> {
    for (i, line) in text.lines.iter().enumerate().take(last + 1) {
        let lower = line.to_lowercase();
        if lower.contains("velocity time") || lower.contains("displacement time") {
            let what = if lower.contains("velocity") { "velocities" } else { "displacements" };
            return Err(text.fail(Some(i), Problem::NotAcceleration(what.into())));
        }
        let found = ["units of", "units are", "unit:", "units:", "unit is"]
            .iter()
            .find_map(|key| lower.find(key).map(|at| at + key.len()));
        if let Some(at) = found {
            let word = line.get(at..).unwrap_or_default().trim_start();
            let word = word.split([' ', ',', ';']).next().unwrap_or_default().trim_end_matches('.');
            return match acceleration_unit(word) {
                Some(unit) => Ok((Some(i), Some(unit))),
                None if word.is_empty() => Ok((Some(i), None)),
                None => Err(text.fail(Some(i), Problem::UnknownUnit(word.into()))),
            };
        }
    }
    Ok((None, None))
}

/// Event, station and component of the second line: `IMPERIAL VALLEY 10/15/79, BONDS CORNER, 140`.
fn describe(text: &Text<'_>, header: usize, record: &mut Record) {
    let mut words = text.lines[..header].iter().filter(|l| !l.trim().is_empty()).take(2);
    let Some(line) = words.find(|l| l.matches(',').count() >= 2) else {
        record.event = text.lines.first().map(|l| l.trim().to_owned()).unwrap_or_default();
        return;
    };
    let parts: Vec<&str> = line.split(',').map(str::trim).collect();
    let last = parts[parts.len() - 1];
    // `164 (CDMG STATION 279)`
    let name = last.split('(').next().unwrap_or(last).trim();
    record.component = name.to_owned();
    record.direction = Direction::from_name(name);
    record.station = parts[parts.len() - 2].to_owned();
    record.event = parts[..parts.len() - 2].join(", ");
}
