//! Loads over a step.

use super::grid::Piece;
use super::plan::{Plan, Source, Varying};
use super::setup::LaneSetup;
use super::small::Aligned;
use super::way::Way;
use trilith_element::lanes::{Arithmetic, Real};
use trilith_model::Side;

/// Loads over a step.
pub(super) struct Loads<R, const M: usize> {
    pub start: Aligned<[R; M]>,
    pub end: Aligned<[R; M]>,
    /// Amplitudes at the end, where an output asks for accelerations.
    pub amplitudes: Vec<R>,
}

impl<R: Real, const M: usize, const L: usize, const N: usize> Plan<R, M, L, N> {
    pub fn no_loads<A: Arithmetic<Real = R>>(&self, with: A) -> Loads<R, M> {
        let zero = with.splat(0.0);
        let mut amplitudes = vec![with.splat(1.0); self.forces.len()];
        self.varying.iter().for_each(|v| amplitudes[v.channel] = zero);
        let start = Aligned::filled(zero);
        Loads { start, end: start, amplitudes }
    }

    /// Loads of the usual step with this index.
    #[inline(always)]
    pub fn loads<A: Arithmetic<Real = R>>(
        &self,
        with: A,
        setups: &[&LaneSetup],
        at: usize,
        out: &mut Loads<R, M>,
    ) {
        let (mut first, mut last) = (self.steady, self.steady);
        for Varying { channel, source, force } in &self.varying {
            let (start, end) = match source {
                Source::Shared(table, size) => {
                    let [x, y] = table.ends[at];
                    (with.splat(x) * *size, with.splat(y) * *size)
                }
                Source::Own => {
                    let of = |s: &LaneSetup, k: usize| match &s.tables[*channel] {
                        Some((table, size)) => table.ends[at][k] * size,
                        None => 1.0,
                    };
                    let last = setups.len() - 1;
                    let lanes = |k: usize| with.gather(|i| of(setups[i.min(last)], k));
                    (lanes(0), lanes(1))
                }
            };
            if self.accelerations {
                out.amplitudes[*channel] = end;
            }
            for j in 0..self.modes() {
                first[j] = start.mul_add(force[j], first[j]);
                last[j] = end.mul_add(force[j], last[j]);
            }
        }
        (out.start, out.end) = (first, last);
    }

    /// Loads of a piece of a step: one for each analysis. The amplitudes are those at its end.
    pub fn loads_of_pieces<A: Arithmetic<Real = R>>(
        &self,
        with: A,
        setups: &[&LaneSetup],
        pieces: &[Piece],
    ) -> Loads<R, M> {
        let mut out = self.no_loads(with);
        for c in 0..self.forces.len() {
            let start = amplitude(with, setups, pieces, c, |p| (p.start, Side::After));
            let end = amplitude(with, setups, pieces, c, |p| (p.end, Side::Before));
            out.amplitudes[c] = end;
            for j in 0..self.modes() {
                out.start[j] = start.mul_add(self.forces[c][j], out.start[j]);
                out.end[j] = end.mul_add(self.forces[c][j], out.end[j]);
            }
        }
        out
    }

    /// Amplitudes at the start of a piece.
    pub fn amplitudes_behind<A: Arithmetic<Real = R>>(
        &self,
        with: A,
        setups: &[&LaneSetup],
        pieces: &[Piece],
    ) -> Vec<R> {
        let start = |c: usize| amplitude(with, setups, pieces, c, |p| (p.start, Side::After));
        (0..self.forces.len()).map(start).collect()
    }
}

/// The amplitude of a channel, as the table of a usual step has it.
fn amplitude<A: Arithmetic>(
    with: A,
    setups: &[&LaneSetup],
    pieces: &[Piece],
    channel: usize,
    at: impl Fn(&Piece) -> (f64, Side),
) -> A::Real {
    let last = setups.len() - 1;
    with.gather(|i| {
        let ((track, size), piece) = (&setups[i.min(last)].tracks[channel], &pieces[i.min(last)]);
        let (t, side) = at(piece);
        track.at(t, side) * size
    })
}

/// Loads at the start, in the middle and at the end of the steps.
pub(super) struct Points<R, const M: usize> {
    pub whole: Loads<R, M>,
    pub halves: [Loads<R, M>; 2],
    /// Amplitudes at the start, where an output asks for accelerations.
    pub start: Vec<R>,
}

impl<R: Real, const M: usize> Points<R, M> {
    pub fn new<A: Arithmetic<Real = R>, const L: usize, const N: usize>(
        with: A,
        plan: &Plan<R, M, L, N>,
    ) -> Self {
        let none = || plan.no_loads(with);
        Self { whole: none(), halves: [none(), none()], start: none().amplitudes }
    }

    #[inline(always)]
    pub fn gather<A: Arithmetic<Real = R>, const L: usize, const N: usize>(
        &mut self,
        with: A,
        plan: &Plan<R, M, L, N>,
        ways: &[Way<'_>],
    ) {
        let last = ways.len() - 1;
        let mut points = [plan.steady; 3];
        for varying in &plan.varying {
            let channel = varying.channel;
            let of = |k: usize| with.gather(|i| ways[i.min(last)].amplitudes[channel][k]);
            let (start, middle, end) = (of(0), of(1), of(2));
            for j in 0..plan.modes() {
                let force = varying.force[j];
                points[0][j] = start.mul_add(force, points[0][j]);
                points[1][j] = middle.mul_add(force, points[1][j]);
                points[2][j] = end.mul_add(force, points[2][j]);
            }
            if plan.accelerations {
                self.start[channel] = start;
                self.halves[0].amplitudes[channel] = middle;
                self.halves[1].amplitudes[channel] = end;
            }
        }
        let [start, middle, end] = points;
        (self.whole.start, self.whole.end) = (start, end);
        (self.halves[0].start, self.halves[0].end) = (start, middle);
        (self.halves[1].start, self.halves[1].end) = (middle, end);
    }
}
