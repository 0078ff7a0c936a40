//! Reading the file of a record.

mod at2;
mod cells;
mod columns;
mod cosmos;
mod csmip;
mod esm;
mod knet;
mod number;
mod text;

pub use columns::{Column, Columns};

use crate::error::{Problem, ReadError};
use crate::finite::{LONGEST_STEP, MOST_SAMPLES, SHORTEST_STEP, history};
use crate::{Format, NotFinite, Record};
use std::path::Path;
use text::Text;

/// What the user says about a file.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct ReadOptions {
    /// The format; `None`: found from the content.
    pub format: Option<Format>,
    /// One unit of the values in m/s², where the file does not state it.
    pub unit: Option<f64>,
    /// The time step in s, where the file does not state it.
    pub dt: Option<f64>,
}

/// Which component of a file.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Component {
    /// By its number, from 1.
    Number(usize),
    /// By its name, or a part of it that no other has; case does not count.
    Name(String),
}

/// Reads all components of a file.
///
/// # Errors
/// [`ReadError`] with the line: a file that cannot be read, is empty, packed or binary; a format that is
/// not known; a header without count, step or unit; counts that differ from the header; numbers that are
/// none, or have a comma within; uneven steps; a peak that the data do not have; more than [`MOST_SAMPLES`]
/// samples; values whose integrals are not finite.
pub fn read(path: impl AsRef<Path>, options: &ReadOptions) -> Result<Vec<Record>, ReadError> {
    let path = path.as_ref();
    let file = path.display().to_string();
    match crate::file::read(path) {
        Ok(bytes) => parse(&bytes, path, options),
        Err(e) => Err(of_file(file, Problem::Unreadable(e.to_string()))),
    }
}

/// Reads all components from the content of a file. The path names it in errors, and its ending helps where
/// the content leaves the format open.
///
/// # Errors
/// As [`read`], but for the reading of the file.
pub fn parse(
    bytes: &[u8],
    path: impl AsRef<Path>,
    options: &ReadOptions,
) -> Result<Vec<Record>, ReadError> {
    let path = path.as_ref();
    let file = path.display().to_string();
    let fail = |problem| of_file(file.clone(), problem);
    if let Some(dt) = options.dt.filter(|dt| !is_step(*dt)) {
        return Err(fail(Problem::BadStep(dt)));
    }
    let content = text::decode(bytes).map_err(fail)?;
    let text = Text { file: file.clone(), lines: content.lines().collect() };
    let format = options
        .format
        .or_else(|| Format::of(&text.lines, path))
        .ok_or_else(|| fail(Problem::UnknownFormat))?;
    let mut records = match format {
        Format::At2 => at2::read(&text, options),
        Format::Cosmos => cosmos::read(&text, options),
        Format::Csmip => csmip::read(&text, options),
        Format::Knet => knet::read(&text, options),
        Format::Esm => esm::read(&text, options),
        Format::Columns => columns::read(bytes, &text, options),
    }?;
    for r in &mut records {
        r.format = Some(format);
        if r.acceleration.len() < 2 {
            return Err(fail(Problem::TooShort(r.acceleration.len())));
        }
        if r.acceleration.len() > MOST_SAMPLES {
            return Err(fail(Problem::TooLong));
        }
        r.check_finite().map_err(|e| fail(e.into()))?;
    }
    Ok(records)
}

/// An error of a file as a whole.
fn of_file(file: String, problem: Problem) -> ReadError {
    ReadError { file, line: None, column: None, problem }
}

/// The one component that is asked for, or the only one.
///
/// # Errors
/// [`Problem::UnknownComponent`], [`Problem::SeveralComponents`].
pub fn select(
    mut records: Vec<Record>,
    component: Option<&Component>,
    path: impl AsRef<Path>,
) -> Result<Record, ReadError> {
    let names: Vec<String> = records.iter().map(|r| r.component.clone()).collect();
    let fail = |problem| of_file(path.as_ref().display().to_string(), problem);
    let unknown = |name: String| fail(Problem::UnknownComponent { name, all: names.clone() });
    let at = match component {
        None if records.len() == 1 => 0,
        None => return Err(fail(Problem::SeveralComponents(names))),
        Some(Component::Number(n)) => match n.checked_sub(1).filter(|i| *i < records.len()) {
            Some(i) => i,
            None => return Err(unknown(n.to_string())),
        },
        Some(Component::Name(name)) => {
            let wanted = name.to_lowercase();
            let lower: Vec<String> = names.iter().map(|n| n.to_lowercase()).collect();
            let parts: Vec<usize> =
                (0..lower.len()).filter(|i| lower[*i].contains(&wanted)).collect();
            match lower.iter().position(|n| *n == wanted) {
                Some(i) => i,
                None if parts.len() == 1 => parts[0],
                None => return Err(unknown(name.clone())),
            }
        }
    };
    Ok(records.swap_remove(at))
}

/// The unit that file and user agree on, m/s².
fn unit(
    text: &Text<'_>,
    line: Option<usize>,
    stated: Option<f64>,
    given: Option<f64>,
) -> Result<f64, ReadError> {
    match (stated, given) {
        (Some(a), Some(b)) if (a - b).abs() > 1e-3 * a.abs() => {
            Err(text.fail(line, Problem::UnitConflict { file: a, given: b }))
        }
        (Some(a), _) | (None, Some(a)) => Ok(a),
        (None, None) => Err(text.fail(line, Problem::NoUnit)),
    }
}

/// The time step that file and user agree on, s.
fn step(
    text: &Text<'_>,
    line: Option<usize>,
    stated: Option<f64>,
    given: Option<f64>,
) -> Result<f64, ReadError> {
    let dt = match (stated, given) {
        (Some(a), Some(b)) if (a - b).abs() > 1e-6 * a.abs() => {
            return Err(text.fail(line, Problem::StepConflict { file: a, given: b }));
        }
        (Some(a), _) | (None, Some(a)) => a,
        (None, None) => return Err(text.fail(line, Problem::NoStep)),
    };
    if !is_step(dt) {
        return Err(text.fail(line, Problem::BadStep(dt)));
    }
    Ok(dt)
}

fn is_step(dt: f64) -> bool {
    (SHORTEST_STEP..=LONGEST_STEP).contains(&dt)
}

/// Holds the data to the peak of the header: 2 %, or what the digits of the header leave open.
fn check_peak(
    text: &Text<'_>,
    line: Option<usize>,
    stated: f64,
    digit: f64,
    acceleration: &[f64],
) -> Result<(), ReadError> {
    history("acceleration", acceleration).map_err(|e| text.fail(line, e.into()))?;
    history("peak in the header", &[stated])
        .map_err(|e| text.fail(line, Problem::NotFinite(NotFinite { sample: None, ..e })))?;
    let (stated, found) = (stated.abs(), crate::measure::peak(acceleration));
    if (stated - found).abs() <= (0.02 * stated).max(1.01 * digit) {
        return Ok(());
    }
    Err(text.fail(line, Problem::Peak { stated, found }))
}
