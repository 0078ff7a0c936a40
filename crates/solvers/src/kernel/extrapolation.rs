//! The residual that predictors of steps leave: it comes again, a little changed.
//!
//! The predictor goes along the tangents at the start of the step; what it misses is of second order, such as the
//! turn of a sliding friction force, and changes smoothly from step to step. For the next step it is extrapolated by
//! the polynomial through the last steps, by backward differences ∇ of as many orders p as would have brought the last
//! step nearest:
//!
//! ```text
//! e(n+1) ≈ e(n) + ∇e(n) + … + ∇ᵖ⁻¹e(n),      which misses by ∇ᵖe(n+1)
//! ```
//!
//! and by nothing where no order would have: after a link has changed its regime.

use super::affine::StepKey;
use crate::vector::add;
use serde::{Deserialize, Serialize};
use trilith_linalg::{ORDERS, Panel, extrapolate};

/// An expectation that leaves more than this share of what it is about is not worth it.
const WORTH: f64 = 0.5;

/// Residuals of the active link coordinates that the forces along the tangents left.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub(crate) struct Extrapolation {
    /// The steps that they are about.
    key: StepKey,
    /// What each order expects of the next step, order by order; of so many coordinates each that they fill whole
    /// vectors.
    expected: Vec<f64>,
    /// How many steps they come from, as far as that counts.
    known: usize,
    /// The order that the next step goes by; 0 where it expects nothing.
    order: usize,
}

impl Extrapolation {
    /// Adds what the next step expects; false where it expects nothing.
    pub fn expect(&self, key: &StepKey, residual: &mut [f64]) -> bool {
        let extrapolated = self.extrapolated(residual.len()).filter(|_| self.key == *key);
        extrapolated.map(|extrapolated| add(residual, extrapolated)).is_some()
    }

    fn extrapolated(&self, n: usize) -> Option<&[f64]> {
        let filled = n.next_multiple_of(Panel::GRAIN);
        let start = self.order.checked_sub(1)? * filled;
        self.expected.get(start..start + n)
    }

    /// Becomes what the step after this one knows: `from` is what this one knew, and `residual` what its guess
    /// left; `expected`: whether the guess held what was to be expected.
    pub fn note(&mut self, from: &Self, key: &StepKey, residual: &[f64], expected: bool) {
        let n = residual.len();
        let filled = n.next_multiple_of(Panel::GRAIN);
        self.key.clone_from(key);
        (self.known, self.order) = (1, 0);
        self.expected.resize(ORDERS * filled, 0.0);
        let last = &mut self.expected[..n];
        match from.extrapolated(n).filter(|_| expected) {
            Some(extrapolated) => {
                for i in 0..n {
                    last[i] = residual[i] + extrapolated[i];
                }
            }
            None => last.copy_from_slice(residual),
        }
        if from.key != *key || from.expected.len() != self.expected.len() || n == 0 {
            self.expected[filled..].fill(0.0);
            return;
        }
        self.known = from.known.saturating_add(1).min(ORDERS + 1);
        let mut sizes = [0.0; ORDERS + 1];
        extrapolate(&from.expected, &mut self.expected, &mut sizes);
        sizes[self.known..].fill(f64::INFINITY);
        let (mut order, mut least) = (0, WORTH * sizes[0]);
        for p in 1..=ORDERS {
            // Chosen, not branched on: nobody could predict which it is.
            order = if sizes[p] < least { p } else { order };
            least = if sizes[p] < least { sizes[p] } else { least };
        }
        self.order = order;
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Leads it through steps that leave these remainders; gives back what each guess left of them.
    fn lead(remainders: &[f64]) -> (Extrapolation, Vec<f64>) {
        let mut known = Extrapolation::default();
        let left = remainders.iter().map(|e| {
            let mut extrapolated = [0.0];
            let expected = known.expect(&StepKey::exact(0.01), &mut extrapolated);
            let left = e - extrapolated[0];
            let mut next = Extrapolation::default();
            next.note(&known, &StepKey::exact(0.01), &[left], expected);
            known = next;
            left
        });
        let left = left.collect();
        (known, left)
    }

    #[test]
    fn a_remainder_that_changes_like_a_polynomial_is_expected() {
        let cubic = |i: usize| (i as f64).mul_add(0.1, 1.0).powi(3);
        let remainders: Vec<f64> = (0..8).map(cubic).collect();
        let (_, left) = lead(&remainders);
        assert_eq!(left[0], 1.0);
        assert!(left[1..4].iter().all(|x| x.abs() > 1e-3), "{left:?}");
        assert!(left[5..].iter().all(|x| x.abs() < 1e-14), "{left:?}");
    }

    #[test]
    fn the_order_is_that_which_would_have_missed_least() {
        // What alternates is extrapolated worse by every higher order.
        let (known, left) = lead(&[1.0, 1.1, 1.0, 1.1, 1.0, 1.1]);
        assert!(left[2..].iter().all(|x| (x.abs() - 0.1).abs() < 1e-14), "{left:?}");
        assert_eq!(known.order, 1);
        assert_eq!(known.extrapolated(1), Some(&[1.1][..]));
    }

    #[test]
    fn a_sudden_remainder_is_not() {
        let (_, left) = lead(&[0.1, 0.1, 0.1, 9.0, 0.1, 0.1, 0.1, 0.1]);
        // 9 came suddenly; after it nothing is extrapolated until two steps agree again.
        let sizes: Vec<f64> = left.iter().map(|x| (x * 1e9).round() / 1e9).collect();
        assert_eq!(sizes[3..6], [8.9, 0.1, 0.1]);
        assert!(sizes[6..].iter().all(|x| x.abs() < 1e-9), "{left:?}");
    }

    #[test]
    fn steps_of_another_length_start_anew() {
        let (known, _) = lead(&[1.0, 1.0, 1.0]);
        let mut extrapolated = [0.0];
        assert!(known.expect(&StepKey::exact(0.01), &mut extrapolated) && extrapolated == [1.0]);
        assert!(!known.expect(&StepKey::exact(0.005), &mut extrapolated) && extrapolated == [1.0]);
    }
}
