//! K-NET and KiK-net ASCII (National Research Institute for Earth Science and Disaster Resilience).
//!
//! Seventeen lines of header (`Station Code`, `Sampling Freq(Hz)`, `Duration Time(s)`, `Dir.`, `Scale
//! Factor      2000(gal)/8388608`, `Max. Acc. (gal)`), then counts in rows of eight. Acceleration in gal =
//! counts · scale. The counts carry an offset; it is taken away as the mean of the record, as for the peak of
//! the header. KiK-net gives the direction as a number: 1–3 in the borehole, 4–6 at the surface (N–S, E–W,
//! up).

use super::number::number;
use super::text::{Text, last_digit};
use super::{ReadOptions, check_peak, step, unit};
use crate::error::{Problem, ReadError};
use crate::{Direction, MOST_SAMPLES, Record};

pub(super) fn read(text: &Text<'_>, options: &ReadOptions) -> Result<Vec<Record>, ReadError> {
    let field = |key: &str| {
        let lines = text.lines.iter().enumerate().take(17);
        lines
            .filter_map(|(i, l)| l.get(..key.len()).map(|head| (i, l, head)))
            .find(|(_, _, head)| head.eq_ignore_ascii_case(key))
            .map(|(i, l, _)| (i, l[key.len()..].trim_start_matches("(Hz)").trim()))
    };
    let need = |key: &str, name: &'static str| {
        field(key).ok_or_else(|| text.fail(None, Problem::Missing(name)))
    };
    let (rate_line, rate) = need("Sampling Freq", "line `Sampling Freq(Hz)`")?;
    let rate = rate.trim_end_matches(|c: char| c.is_ascii_alphabetic());
    let rate = text.header(rate_line, rate, "sampling frequency in Hz")?;
    let (scale_line, scale) = need("Scale Factor", "line `Scale Factor`")?;
    let scale = factor(scale).ok_or_else(|| {
        let problem =
            Problem::Header { text: scale.to_owned(), what: "scale such as `2000(gal)/8388608`" };
        text.fail(Some(scale_line), problem)
    })?;
    let per_count = unit(text, Some(scale_line), Some(0.01 * scale), options.unit)?;
    let dt = step(text, Some(rate_line), Some(1.0 / rate), options.dt)?;
    let Some(memo) = text.find(0, "memo").filter(|i| *i < 20) else {
        return Err(text.fail(None, Problem::Missing("line `Memo.` before the data")));
    };
    let mut counts = Vec::new();
    for (i, line) in text.lines.iter().enumerate().skip(memo + 1) {
        for word in line.split_whitespace() {
            counts.push(number(word).map_err(|problem| text.fail_at(i, word, problem))?);
        }
        if counts.len() > MOST_SAMPLES {
            return Err(text.fail(Some(i), Problem::TooLong));
        }
    }
    // The duration is given in whole seconds; a record may hold a part of a second more.
    let (line, duration) = need("Duration Time(s)", "line `Duration Time(s)`")?;
    let stated = (text.header(line, duration, "duration in s")? * rate).round() as usize;
    if counts.len() < stated {
        let problem = Problem::Truncated { stated, found: counts.len() };
        return Err(text.fail(Some(text.lines.len() - 1), problem));
    }
    if counts.len() >= stated + rate.max(1.0) as usize {
        let problem = Problem::TooMany { stated, found: counts.len() };
        return Err(text.fail(Some(line), problem));
    }
    let mean = counts.iter().sum::<f64>() / counts.len().max(1) as f64;
    let acceleration = counts.iter().map(|c| (c - mean) * per_count).collect();
    let mut record = Record::new(acceleration, dt);
    if let Some((line, peak)) = field("Max. Acc. (gal)") {
        let stated = 0.01 * text.header(line, peak, "peak in gal")?;
        check_peak(text, Some(line), stated, 0.01 * last_digit(peak), &record.acceleration)?;
        record.stated_peak = Some(stated);
    }
    let name = field("Dir.").map_or("", |(_, d)| d);
    (record.component, record.direction) = match name {
        "1" => ("N-S borehole".into(), Direction::Azimuth(0.0)),
        "2" => ("E-W borehole".into(), Direction::Azimuth(90.0)),
        "3" => ("U-D borehole".into(), Direction::Vertical),
        "4" => ("N-S".into(), Direction::Azimuth(0.0)),
        "5" => ("E-W".into(), Direction::Azimuth(90.0)),
        "6" => ("U-D".into(), Direction::Vertical),
        _ => (name.to_owned(), Direction::from_name(name)),
    };
    record.station = field("Station Code").map_or(String::new(), |(_, s)| s.to_owned());
    let origin = field("Origin Time").map_or("", |(_, s)| s);
    let magnitude = field("Mag.").map_or("", |(_, s)| s);
    record.event = format!("{origin}, M {magnitude}");
    record.notes.push(format!("offset of {mean:.1} counts taken away"));
    Ok(vec![record])
}

/// `2000(gal)/8388608` in gal per count.
fn factor(text: &str) -> Option<f64> {
    let (gal, counts) = text.split_once('/')?;
    let gal = number(gal.to_lowercase().trim_end_matches("(gal)").trim()).ok()?;
    let counts = number(counts.trim()).ok()?;
    Some(gal / counts).filter(|x| x.is_finite() && *x > 0.0)
}
