//! Peaks at the output times.

use crate::size::Peaks;
use trilith::solvers::{Observer, Sample};

/// Watches the outputs of a [`Subject`](crate::Subject) and keeps their peaks only.
#[derive(Clone, Debug, Default)]
pub struct Gauge {
    isolator: f64,
    roof: f64,
    /// The roof drift last seen, m.
    pub last: f64,
}

impl Gauge {
    /// What was seen.
    #[must_use]
    pub fn peaks(&self) -> Peaks {
        Peaks { isolator: self.isolator.sqrt(), roof: self.roof }
    }
}

impl Observer for Gauge {
    fn sample(&mut self, s: &Sample<'_>) {
        let (Some(_), [roof, isolators @ ..]) = (s.output_step, s.values) else { return };
        for pair in isolators.chunks_exact(2) {
            self.isolator = self.isolator.max(pair[0] * pair[0] + pair[1] * pair[1]);
        }
        self.roof = self.roof.max(roof.abs());
        self.last = *roof;
    }

    fn wants_rates(&self) -> bool {
        false
    }
}
