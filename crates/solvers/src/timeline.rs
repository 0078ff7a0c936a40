//! Output times, and where loads jump between them.

use trilith_system::LoadSet;

/// Output times and, between them, the pieces that end where a load jumps.
pub(crate) struct Timeline {
    pub dt: f64,
    pub steps: usize,
    pub duration: f64,
    pub breaks: Vec<f64>,
}

/// A piece of an output step; its length is that of other steps to the bit where it is a whole one.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Piece {
    pub start: f64,
    pub end: f64,
    pub length: f64,
}

impl Piece {
    /// Time at a share of it; the end to the bit.
    pub(crate) fn time(&self, share: f64) -> f64 {
        if share == 1.0 { self.end } else { self.start + self.length * share }
    }

    /// Equal parts of it.
    pub(crate) fn parts(self, count: usize) -> impl Iterator<Item = Self> {
        let length = self.length / count as f64;
        let time =
            move |i: usize| if i == count { self.end } else { self.start + length * i as f64 };
        (0..count).map(move |i| Self { start: time(i), end: time(i + 1), length })
    }
}

impl Timeline {
    pub(crate) fn new(dt: f64, duration: f64, loads: &LoadSet) -> Self {
        let steps = ((duration / dt) - 1e-9).ceil().max(1.0) as usize;
        Self { dt, steps, duration, breaks: loads.breaks(duration) }
    }

    /// Time of an output step.
    pub(crate) fn time(&self, step: usize) -> f64 {
        (step as f64 * self.dt).min(self.duration)
    }

    /// True for a time at which a load may jump.
    pub(crate) fn is_break(&self, t: f64) -> bool {
        self.breaks.iter().any(|b| (b - t).abs() <= self.near())
    }

    /// The pieces of an output step.
    pub(crate) fn pieces(&self, step: usize) -> impl Iterator<Item = Piece> + '_ {
        let (t0, t1) = (self.time(step), self.time(step + 1));
        let near = self.near();
        let inside = move |t: &f64| *t > t0 + near && *t < t1 - near;
        // The last step may be shorter; one that is not has the length of the others to the bit.
        let whole = (t1 - t0 - self.dt).abs() <= near && !self.breaks.iter().any(inside);
        let ends = self.breaks.iter().copied().filter(inside).chain([t1]);
        ends.scan(t0, move |start, end| {
            let length = if whole { self.dt } else { end - *start };
            let piece = Piece { start: *start, end, length };
            *start = end;
            Some(piece)
        })
    }

    /// Times closer than this are one.
    fn near(&self) -> f64 {
        1e-9 * self.dt
    }
}
