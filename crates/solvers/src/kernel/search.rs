//! How far a Newton correction of the link forces goes.

/// Plain Newton iterations before the first line search.
const SEARCH_FROM: usize = 2;
/// Halvings of a correction at most.
const HALVINGS: usize = 6;
/// A correction that leaves more than this share of the residual went too far.
const ENOUGH: f64 = 0.9;

/// Line search of a Newton iteration that does not settle: a force like |v|^α with α < ½ throws Newton's
/// method to the other side of zero, farther than it came from.
#[derive(Default)]
pub(crate) struct Search {
    /// The last correction.
    pub step: Vec<f64>,
    /// Part of it that is taken back next.
    share: f64,
    /// Largest residual before the last correction.
    before: f64,
    /// Halvings of the last correction.
    halvings: usize,
}

impl Search {
    /// Before a new step.
    pub fn reset(&mut self) {
        self.step.clear();
        (self.share, self.before, self.halvings) = (0.0, 0.0, 0);
    }

    /// Where the residual did not fall, the part of the last correction that is to be taken back: half of
    /// what is left of it.
    pub fn shortens(&mut self, iteration: usize, size: f64) -> Option<f64> {
        let grew =
            iteration >= SEARCH_FROM && size > ENOUGH * self.before && self.halvings < HALVINGS;
        if !grew {
            self.before = size;
            return None;
        }
        self.share *= 0.5;
        self.halvings += 1;
        Some(self.share)
    }

    /// Takes note of a correction about to be made; nobody comes back to the first of a step.
    pub fn goes(&mut self, step: &[f64]) {
        self.step.clear();
        self.step.extend_from_slice(step);
        (self.share, self.halvings) = (1.0, 0);
    }
}
