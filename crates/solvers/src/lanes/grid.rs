//! The steps of a case: a grid of equal ones, and the output steps that loads cut otherwise.

use crate::march::Timeline;
use crate::run::peak;
use trilith_model::Side;
use trilith_system::{Channel, LoadSet};

/// The steps of a case.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Grid {
    pub dt: f64,
    pub steps: usize,
    pub substeps: usize,
}

impl Grid {
    /// The usual step, s.
    pub fn step(&self) -> f64 {
        self.dt / self.substeps as f64
    }

    /// A usual step by its number in its output step.
    pub fn usual(&self, step: usize, number: usize) -> Piece {
        let length = self.step();
        let start = step as f64 * self.dt + length * number as f64;
        Piece { start, end: start + length, length, jump: false }
    }
}

/// A piece of an output step, as a step starts on it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Piece {
    pub start: f64,
    pub end: f64,
    pub length: f64,
    /// A load jumps at its start.
    pub jump: bool,
}

/// Parts of an output step are not made shorter than this for the sake of all of them.
const MOST_PARTS: usize = 64;
/// The grid follows what cuts one output step in so many.
const USUAL: usize = 16;
/// A change of a load below this share of its peak is no jump.
const JUMPS: f64 = 1e-9;

/// The equal parts of an output step that hold its pieces, unless they would be too many.
fn parts(timeline: &Timeline, step: usize) -> Option<usize> {
    let shares: Vec<f64> = timeline.pieces(step).map(|p| p.length / timeline.dt).collect();
    if (shares.iter().sum::<f64>() - 1.0).abs() > 1e-9 {
        return None;
    }
    let whole = |x: f64| (x - x.round()).abs() < 1e-9 * x;
    (1..=MOST_PARTS).find(|n| shares.iter().all(|x| whole(x * *n as f64)))
}

/// Equal parts of every output step, such that few are cut otherwise: 1, unless loads cut many.
pub(super) fn common_parts(timeline: &Timeline) -> usize {
    let mut found = [0_usize; MOST_PARTS + 1];
    for step in timeline.cut_steps() {
        parts(timeline, step).into_iter().for_each(|n| found[n] += 1);
    }
    let usual = |n: &usize| found[*n] * USUAL >= timeline.steps;
    let common = |a: usize, b: usize| a / divisor(a, b) * b;
    let all = (2..=MOST_PARTS).filter(usual).fold(1, common);
    if all <= MOST_PARTS { all } else { 1 }
}

/// The greatest common divisor.
fn divisor(a: usize, b: usize) -> usize {
    if b == 0 { a } else { divisor(b, a % b) }
}

/// The output steps that are not so many whole parts, or between which a load jumps, with their steps.
pub(super) fn cuts(
    timeline: &Timeline,
    loads: &LoadSet,
    substeps: usize,
    common: usize,
) -> Vec<(usize, Vec<Piece>)> {
    let jumps = |t: f64| {
        let jump = |c: &Channel| {
            let change = c.track.at(t, Side::After) - c.track.at(t, Side::Before);
            change.abs() > JUMPS * peak(&c.track)
        };
        t > 0.0 && timeline.is_jump(t) && loads.channels.iter().any(jump)
    };
    let steps = timeline.cut_steps();
    let of_step = |step: usize| -> Vec<Piece> {
        let pieces = timeline.pieces(step).flat_map(|piece| {
            let jump = jumps(piece.start);
            let parts = piece.parts(substeps).enumerate();
            parts.map(move |(i, p)| Piece {
                start: p.start,
                end: p.end,
                length: p.length,
                jump: jump && i == 0,
            })
        });
        pieces.collect()
    };
    let is_cut = |step: usize| {
        let (start, end) = (timeline.time(step), timeline.time(step + 1));
        let as_usual = parts(timeline, step).is_some_and(|n| common.is_multiple_of(n));
        !as_usual || jumps(start) || jumps(end)
    };
    steps.into_iter().filter(|step| is_cut(*step)).map(|step| (step, of_step(step))).collect()
}
