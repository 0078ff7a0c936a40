//! Where an analysis with adaptive steps is, and what it does next.

use super::grid::Piece;
use super::setup::LaneSetup;
use crate::march::DEPTH;
use trilith_model::Side;

/// Ticks of a piece.
pub(super) const FULL: u32 = 1 << DEPTH;

/// A step to be tried.
#[derive(Clone, Copy, Debug)]
pub(super) struct Next {
    pub start: f64,
    pub middle: f64,
    pub length: f64,
    /// Loads jump at its start, and nobody has looked at that yet.
    pub jump: bool,
}

/// The way of an analysis through the pieces of its output steps, each in steps of its length over powers of two.
pub(super) struct Way<'a> {
    setup: &'a LaneSetup,
    /// The piece that it is in; none at the end.
    piece: Option<Piece>,
    /// Its place in the tables of loads, where it is a step of the grid.
    place: Option<usize>,
    /// Output step; pieces of it that were taken up; entry of `cut` that comes next.
    pub step: usize,
    taken: usize,
    cut: usize,
    at: u32,
    /// Number of halvings.
    pub level: u32,
    /// Steps that were tried, as the ordinary march counts them.
    tried: usize,
    /// Amplitude of each channel at the start, in the middle and at the end of the next step.
    pub amplitudes: Vec<[f64; 3]>,
    seen: bool,
    /// The step before was halved: the next ends in its middle.
    halved: bool,
    /// Time at which it was given up, s.
    pub lost: Option<f64>,
    /// Where a body has overturned: time, s, and index of its link.
    pub fallen: Option<(f64, usize)>,
}

impl<'a> Way<'a> {
    pub fn new(setup: &'a LaneSetup) -> Self {
        let mut way = Self {
            setup,
            piece: None,
            place: None,
            step: 0,
            taken: 0,
            cut: 0,
            at: 0,
            level: setup.adaptive.as_ref().map_or(0, |a| a.control.level),
            tried: 0,
            amplitudes: vec![[1.0; 3]; setup.tracks.len()],
            seen: false,
            halved: false,
            lost: None,
            fallen: None,
        };
        way.take_up();
        way
    }

    /// Tolerance of the steps.
    pub fn tolerance(&self) -> f64 {
        self.setup.adaptive.as_ref().map_or(0.0, |a| a.tolerance)
    }

    fn budget(&self) -> usize {
        self.setup.adaptive.as_ref().map_or(0, |a| a.budget)
    }

    /// Goes to the next piece.
    fn take_up(&mut self) {
        let (grid, cut) = (self.setup.shape.grid, &self.setup.cut);
        (self.at, self.seen, self.piece, self.place) = (0, false, None, None);
        while self.step < grid.steps {
            let own = cut.get(self.cut).filter(|(step, _)| *step == self.step);
            let (piece, place) = match own {
                Some((_, pieces)) => (pieces.get(self.taken).copied(), None),
                None if self.taken < grid.substeps => {
                    let place = self.step * grid.substeps + self.taken;
                    (Some(grid.usual(self.step, self.taken)), Some(place))
                }
                None => (None, None),
            };
            if piece.is_some() {
                (self.piece, self.place) = (piece, place);
                self.taken += 1;
                return;
            }
            self.cut += usize::from(own.is_some());
            (self.step, self.taken) = (self.step + 1, 0);
        }
    }

    /// What comes next, with its amplitudes; none at the end.
    pub fn next(&mut self) -> Option<Next> {
        let piece = self.piece?;
        if self.tried >= self.budget() {
            self.give_up(piece.start);
            return None;
        }
        while !self.at.is_multiple_of(FULL >> self.level) {
            self.level += 1;
        }
        let ticks = FULL >> self.level;
        let time = |at: u32| match at {
            FULL => piece.end,
            at => piece.start + piece.length * (f64::from(at) / f64::from(FULL)),
        };
        let (first, middle, last) = (self.at, self.at + ticks / 2, self.at + ticks);
        let halved = std::mem::take(&mut self.halved);
        let Self { setup, place, amplitudes, .. } = self;
        let tables = setup.tables.iter().zip(&setup.tracks);
        for ((table, (track, size)), amplitude) in tables.zip(amplitudes) {
            let Some((table, _)) = table else { continue };
            let at = |tick: u32, side: Side| {
                let known = place.and_then(|place| table.at(place, tick));
                known.unwrap_or_else(|| track.at(time(tick), side)) * size
            };
            if halved {
                amplitude[2] = amplitude[1];
            } else {
                // Otherwise it is the end of the step before.
                if first == 0 {
                    amplitude[0] = at(0, Side::After);
                }
                amplitude[2] = at(last, Side::Before);
            }
            amplitude[1] = at(middle, Side::Before);
        }
        let jump = piece.jump && first == 0 && !self.seen;
        self.seen = true;
        let [start, middle] = [first, middle].map(time);
        let length = piece.length / f64::from(1_u32 << self.level);
        Some(Next { start, middle, length, jump })
    }

    /// Behind the step that was tried; the next may be twice as long where it is so small that it may `grow`.
    pub fn advance(&mut self, grow: bool) {
        self.tried += 2;
        self.at += FULL >> self.level;
        self.amplitudes.iter_mut().for_each(|[start, _, end]| *start = *end);
        if grow && self.level > 0 {
            self.level -= 1;
        }
        if self.at == FULL {
            self.take_up();
        }
    }

    /// Back to `t` where the step began, with half of it.
    pub fn halve(&mut self, t: f64) {
        self.tried += 1;
        if self.level + 2 >= DEPTH {
            self.give_up(t);
        }
        self.level += 1;
        self.halved = true;
    }

    /// Ends with the output step before, where the body of a link has overturned.
    pub fn fall(&mut self, link: usize) {
        let t = self.step as f64 * self.setup.shape.grid.dt;
        (self.piece, self.fallen) = (None, Some((t, link)));
    }

    /// Goes no further than `t`.
    pub fn give_up(&mut self, t: f64) {
        (self.piece, self.lost) = (None, Some(t));
    }
}
