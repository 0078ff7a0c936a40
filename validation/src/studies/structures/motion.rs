//! Ground motions that are shipped with the program.

use crate::oracle::spec::Function;

const FIRST: &str = include_str!("../../../../models/records/synthetic_1.csv");
const SECOND: &str = include_str!("../../../../models/records/synthetic_2.csv");

/// A column of a record.
#[derive(Clone, Copy)]
pub(super) enum Along {
    X = 1,
    Y = 2,
    Z = 3,
}

/// A record times so many g.
fn record(text: &str, along: Along, g: f64) -> Function {
    let row = |line: &str| {
        let mut cells = line.split(',').map(str::parse::<f64>);
        let t = cells.next()?.ok()?;
        Some((t, 9.80665 * g * cells.nth(along as usize - 1)?.ok()?))
    };
    Function::Points(text.lines().filter_map(row).collect())
}

/// The first synthetic motion times so many g.
pub(super) fn first(along: Along, g: f64) -> Function {
    record(FIRST, along, g)
}

/// The second.
pub(super) fn second(along: Along, g: f64) -> Function {
    record(SECOND, along, g)
}
