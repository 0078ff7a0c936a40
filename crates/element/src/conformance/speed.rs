//! How long the answers of a law take, alone and over lanes.

use super::forms::{Batch, Case};
use super::path::Path;
use crate::lanes::{Arithmetic, LaneForm, Portable};
#[cfg(target_arch = "x86_64")]
use crate::lanes::{Avx2Lanes, Avx512Lanes};
use crate::{Energy, Link, Response};
use std::hint::black_box;
use std::time::{Duration, Instant};

/// How long a measurement goes on at least, and how many there are: the fastest counts.
const LONG: Duration = Duration::from_millis(5);
const ROUNDS: usize = 5;

/// How long the answers of a law take.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LaneSpeed {
    /// A whole answer of the law itself, s.
    pub alone: f64,
    /// A whole answer over lanes, for each of the analyses in them, s.
    pub in_lanes: f64,
    /// Number of lanes.
    pub width: usize,
}

impl LaneSpeed {
    /// What an analysis in lanes takes of the time of one alone. Near 1 and above it some function of the form is not
    /// inlined.
    #[must_use]
    pub fn share(&self) -> f64 {
        self.in_lanes / self.alone
    }
}

/// Along a path; none for a law without a form for lanes, or one that cannot be led along it.
pub(super) fn lane_speed(link: &dyn Link, path: &Path) -> Option<LaneSpeed> {
    let active: Vec<bool> = path.scale.iter().map(|s| *s > 0.0).collect();
    let form = link.lanes(&active)?;
    let cases = Case::along(link, path).ok()?;
    let (in_lanes, width) = widest(&form, &cases);
    Some(LaneSpeed { alone: alone(link, &cases), in_lanes, width })
}

/// Time of one of so many answers, s.
fn fastest(answers: usize, mut all: impl FnMut()) -> f64 {
    let mut best = f64::INFINITY;
    for _ in 0..ROUNDS {
        let (start, mut made) = (Instant::now(), 0);
        while start.elapsed() < LONG {
            all();
            made += answers;
        }
        best = best.min(start.elapsed().as_secs_f64() / made as f64);
    }
    best
}

fn alone(link: &dyn Link, cases: &[Case]) -> f64 {
    let (n, h) = (link.coordinates().len(), link.history().len());
    let (mut f, mut k, mut c) = (vec![0.0; n], vec![0.0; n * n], vec![0.0; n * n]);
    let mut trial = vec![0.0; h];
    fastest(cases.len(), || {
        for case in cases {
            k.fill(0.0);
            c.fill(0.0);
            f.fill(0.0);
            let mut energy = Energy::default();
            let mut out = Response { f: &mut f, k: &mut k, c: &mut c, energy: &mut energy };
            link.respond(black_box(&case.at()), &case.history, &mut trial, &mut out);
            black_box(energy);
        }
    })
}

fn over<A: Arithmetic>(with: A, form: &LaneForm, cases: &[Case]) -> (f64, usize) {
    let batches = cases.chunks(A::WIDTH).map(|cases| Batch::new(with, form, cases));
    let mut batches: Vec<_> = batches.collect();
    let time = fastest(batches.len() * A::WIDTH, || {
        for batch in &mut batches {
            batch.ask(with, form);
        }
        black_box(&mut batches);
    });
    (time, A::WIDTH)
}

/// Over the widest lanes of the machine.
fn widest(form: &LaneForm, cases: &[Case]) -> (f64, usize) {
    #[cfg(target_arch = "x86_64")]
    {
        if let Some(with) = Avx512Lanes::available() {
            return over(with, form, cases);
        }
        if let Some(with) = Avx2Lanes::available() {
            return over(with, form, cases);
        }
    }
    over(Portable, form, cases)
}
