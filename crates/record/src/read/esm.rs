//! ESM and ITACA ASCII (Engineering Strong Motion database, Italian accelerometric archive; header
//! `DYNA 1.x`).
//!
//! `KEY: value` lines (`SAMPLING_INTERVAL_S`, `NDATA`, `STREAM`, `UNITS`, `PGA_CM/S^2`, `DATA_TYPE`), the last
//! of them `USER5`, then one value a line.

use super::text::{Text, last_digit};
use super::{ReadOptions, check_peak, step, unit};
use crate::error::{Problem, ReadError, quoted};
use crate::{Direction, Record, acceleration_unit};

pub(super) fn read(text: &Text<'_>, options: &ReadOptions) -> Result<Vec<Record>, ReadError> {
    let head = text.lines.iter().take_while(|l| key(l).is_some() || l.trim().is_empty()).count();
    let field = |name: &str| {
        (0..head)
            .filter_map(|i| key(text.lines[i]).map(|(k, v)| (i, k, v)))
            .find(|(_, k, _)| k.eq_ignore_ascii_case(name))
            .map(|(i, _, v)| (i, v))
            .filter(|(_, v)| !v.is_empty())
    };
    if let Some((i, kind)) =
        field("DATA_TYPE").filter(|(_, k)| !k.eq_ignore_ascii_case("ACCELERATION"))
    {
        return Err(text.fail(Some(i), Problem::NotAcceleration(quoted(&kind.to_lowercase()))));
    }
    let (count_line, count) = match field("NDATA") {
        Some((i, n)) => (i, text.count(i, n, "number of values")?),
        None => return Err(text.fail(None, Problem::Missing("line `NDATA`"))),
    };
    let (step_line, stated) = match field("SAMPLING_INTERVAL_S") {
        Some((i, s)) => (Some(i), Some(text.header(i, s, "sampling interval in s")?)),
        None => (None, None),
    };
    let dt = step(text, step_line, stated, options.dt)?;
    let (unit_line, stated) = match field("UNITS") {
        Some((i, u)) => match acceleration_unit(u) {
            Some(unit) => (Some(i), Some(unit)),
            None => return Err(text.fail(Some(i), Problem::UnknownUnit(u.into()))),
        },
        None => (None, None),
    };
    let unit = unit(text, unit_line, stated, options.unit)?;
    let (values, after) = text.numbers(count_line, head, count, None, |_| false)?;
    let more = text.lines[after..].iter().filter(|l| !l.trim().is_empty()).count();
    if more > 0 {
        let problem = Problem::TooMany { stated: count, found: count + more };
        return Err(text.fail(Some(after), problem));
    }
    let mut record = Record::new(values.into_iter().map(|a| a * unit).collect(), dt);
    if let Some((line, peak)) = field("PGA_CM/S^2") {
        let stated = 0.01 * text.header(line, peak, "peak in cm/s²")?;
        check_peak(text, Some(line), stated, 0.01 * last_digit(peak), &record.acceleration)?;
        record.stated_peak = Some(stated.abs());
    }
    let value = |name: &str| field(name).map_or(String::new(), |(_, v)| v.to_owned());
    record.component = value("STREAM");
    record.direction = Direction::from_name(&record.component);
    record.station = [value("NETWORK"), value("STATION_CODE")].join(".");
    let (event, date) = (value("EVENT_NAME"), value("EVENT_DATE_YYYYMMDD"));
    record.event = if event.is_empty() { date } else { format!("{event} {date}") };
    Ok(vec![record])
}

/// `KEY: value`.
fn key(line: &str) -> Option<(&str, &str)> {
    let (k, v) = line.split_once(':')?;
    k.starts_with(|c: char| c.is_ascii_alphabetic()).then(|| (k.trim(), v.trim()))
}
