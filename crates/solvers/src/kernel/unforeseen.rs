//! What the first guess of a step left over in the steps before: it comes again, a little changed.
//!
//! The guess goes along the tangents at the start of the step; what it misses is of second order, such as the
//! turn of a sliding friction force, and changes slowly from step to step. The next step therefore expects
//!
//! ```text
//! e(n+1) = 2 e(n) − e(n−1)
//! ```
//!
//! where that would have brought the last step nearer: not after a link has changed its regime.

use crate::propagator::StepKey;
use serde::{Deserialize, Serialize};

/// An expectation that leaves more than this share of what it is about is not worth it.
const WORTH: f64 = 0.5;

/// Residuals of the active link coordinates that the forces along the tangents left.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub(crate) struct Unforeseen {
    /// The steps that they are about.
    key: StepKey,
    /// Of the last step, and of the one before.
    last: Vec<f64>,
    before: Vec<f64>,
    trusted: bool,
}

impl Unforeseen {
    /// Adds what the next step expects; false where it expects nothing.
    pub fn expect(&self, key: StepKey, residual: &mut [f64]) -> bool {
        if !self.trusted || self.key != key {
            return false;
        }
        for (r, (last, before)) in residual.iter_mut().zip(self.last.iter().zip(&self.before)) {
            *r += 2.0 * last - before;
        }
        true
    }

    /// Becomes what the step after this one knows: `from` is what this one knew, and `residual` what its guess
    /// left; `expected`: whether the guess held what was to be expected.
    pub fn note(&mut self, from: &Self, key: StepKey, residual: &[f64], expected: bool) {
        let n = residual.len();
        self.key = key;
        self.last.resize(n, 0.0);
        if from.key != key || from.last.len() != n {
            self.last.copy_from_slice(residual);
            self.before.clone_from(&self.last);
            self.trusted = false;
            return;
        }
        self.before.clone_from(&from.last);
        let (mut left, mut whole) = (0.0, 0.0);
        let own = self.last.iter_mut().zip(residual);
        for ((now, r), (last, before)) in own.zip(from.last.iter().zip(&from.before)) {
            let hoped = 2.0 * last - before;
            *now = if expected { r + hoped } else { *r };
            let (miss, size) = ((*now - hoped).abs(), now.abs());
            left = if miss > left { miss } else { left };
            whole = if size > whole { size } else { whole };
        }
        self.trusted = left < WORTH * whole;
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const KEY: StepKey = StepKey { dt: 0.01, average: 0 };

    /// Leads it through steps that leave these remainders; gives back what each guess left of them.
    fn lead(remainders: &[f64]) -> (Unforeseen, Vec<f64>) {
        let mut known = Unforeseen::default();
        let left = remainders.iter().map(|e| {
            let mut hope = [0.0];
            let expected = known.expect(KEY, &mut hope);
            let left = e - hope[0];
            let mut next = Unforeseen::default();
            next.note(&known, KEY, &[left], expected);
            known = next;
            left
        });
        let left = left.collect();
        (known, left)
    }

    #[test]
    fn a_remainder_that_changes_steadily_is_expected() {
        let (_, left) = lead(&[1.0, 1.1, 1.2, 1.3, 1.4]);
        assert_eq!(left[..2], [1.0, 1.1]);
        assert!(left[2..].iter().all(|x| x.abs() < 1e-15), "{left:?}");
    }

    #[test]
    fn a_sudden_remainder_is_not() {
        let (_, left) = lead(&[0.1, 0.1, 0.1, 9.0, 0.1, 0.1, 0.1, 0.1]);
        // 9 was unforeseen; after it nothing is expected until two steps agree again.
        let sizes: Vec<f64> = left.iter().map(|x| (x * 1e9).round() / 1e9).collect();
        assert_eq!(sizes[3..7], [8.9, 0.1, 0.1, 0.1]);
        assert!(sizes[7].abs() < 1e-9, "{left:?}");
    }

    #[test]
    fn steps_of_another_length_start_anew() {
        let (known, _) = lead(&[1.0, 1.0, 1.0]);
        let mut hope = [0.0];
        assert!(known.expect(KEY, &mut hope) && hope == [1.0]);
        assert!(!known.expect(StepKey { dt: 0.005, ..KEY }, &mut hope) && hope == [1.0]);
    }
}
