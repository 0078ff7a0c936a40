//! Output times, and where loads jump between them.

use trilith_system::LoadSet;

/// Output times and, between them, the pieces that end where a load jumps.
pub(crate) struct Timeline {
    pub dt: f64,
    pub steps: usize,
    pub duration: f64,
    pub breaks: Vec<f64>,
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

    /// (start, length) of the pieces of an output step.
    pub(crate) fn pieces(&self, step: usize) -> impl Iterator<Item = (f64, f64)> + '_ {
        let (t0, t1) = (self.time(step), self.time(step + 1));
        let near = self.near();
        let inside = move |t: &f64| *t > t0 + near && *t < t1 - near;
        // The last step may be shorter; one that is not has the length of the others to the bit.
        let whole = (t1 - t0 - self.dt).abs() <= near && !self.breaks.iter().any(inside);
        let ends = self.breaks.iter().copied().filter(inside).chain([t1]);
        ends.scan(t0, move |start, end| {
            let piece = (*start, if whole { self.dt } else { end - *start });
            *start = end;
            Some(piece)
        })
    }

    /// Times closer than this are one.
    fn near(&self) -> f64 {
        1e-9 * self.dt
    }
}
