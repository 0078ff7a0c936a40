//! Output times, and where loads jump between them.

/// Output times and, between them, the pieces that end where a load jumps.
pub(crate) struct Timeline {
    pub dt: f64,
    pub steps: usize,
    pub duration: f64,
    pub breaks: Vec<f64>,
}

impl Timeline {
    /// Time of an output step.
    pub(crate) fn time(&self, step: usize) -> f64 {
        (step as f64 * self.dt).min(self.duration)
    }

    /// (start, length) of the pieces of an output step.
    pub(crate) fn pieces(&self, step: usize) -> Vec<(f64, f64)> {
        let (t0, t1) = (self.time(step), self.time(step + 1));
        let near = 1e-9 * self.dt;
        let inside: Vec<f64> =
            self.breaks.iter().copied().filter(|t| *t > t0 + near && *t < t1 - near).collect();
        if inside.is_empty() && step + 1 < self.steps {
            return vec![(t0, self.dt)];
        }
        let mut ends = inside;
        ends.push(t1);
        let mut start = t0;
        ends.into_iter()
            .map(|end| {
                let piece = (start, end - start);
                start = end;
                piece
            })
            .collect()
    }
}
