//! Coefficients where every analysis makes steps of its own length.

use super::plan::Plan;
use super::rules::Rules;
use super::setup::LaneSetup;
use super::way::Next;
use crate::modal::Mode;
use trilith_element::lanes::{Arithmetic, Real};

/// The rules of the whole steps and of the halves.
pub(super) struct Sizes<R: Real, const M: usize, const L: usize> {
    rules: [Rules<R, M, L>; 2],
    /// Length of the whole step of each analysis, s.
    lengths: Vec<f64>,
    /// What was made so far of each analysis.
    known: Vec<Known>,
}

/// Lengths whose coefficients are kept.
const KEPT: usize = 128;

impl<R: Real, const M: usize, const L: usize> Sizes<R, M, L> {
    pub fn new<A: Arithmetic<Real = R>>(with: A, setups: &[&LaneSetup]) -> Self {
        let rules = [Rules::new(with.splat(0.0)), Rules::new(with.splat(0.0))];
        let lengths = vec![f64::NAN; setups.len()];
        Self { rules, lengths, known: vec![Known::default(); setups.len()] }
    }

    /// Another analysis goes in this lane.
    pub fn forget(&mut self, lane: usize) {
        (self.lengths[lane], self.known[lane]) = (f64::NAN, Known::default());
    }

    /// Rules for what comes next; those who have nothing to do go on with what they had.
    #[inline(always)]
    pub fn choose<A: Arithmetic<Real = R>, const N: usize>(
        &mut self,
        with: A,
        setups: &[&LaneSetup],
        plan: &Plan<R, M, L, N>,
        next: &[Option<Next>],
    ) -> &mut [Rules<R, M, L>; 2] {
        let Self { rules, lengths, known } = self;
        let mut same = true;
        for i in 0..lengths.len() {
            let Some(next) = &next[i] else { continue };
            if lengths[i] != next.length {
                (lengths[i], same) = (next.length, false);
                known[i].add(next.length, setups[i]);
                // Lanes without an analysis repeat the last.
                let until = if i + 1 == lengths.len() { A::WIDTH } else { i + 1 };
                for (rules, share) in rules.iter_mut().zip([1.0, 0.5]) {
                    if let Some(size) = known[i].of(share * next.length) {
                        rules.set(i..until, size);
                    }
                }
            }
        }
        if !same {
            rules[0].renew(with, plan);
            rules[1].renew(with, plan);
        }
        rules
    }
}

/// A step size of an analysis: coefficients of its modes, and the largest eigenvalue of G k of its engaged links.
#[derive(Clone)]
pub(super) struct Size {
    pub length: f64,
    pub modes: Vec<Mode>,
    pub ratio: f64,
}

/// The step sizes that an analysis has had.
#[derive(Clone, Default)]
struct Known(Vec<Size>);

impl Known {
    /// Makes those of a length and of its half, where they are not there.
    #[inline]
    fn add(&mut self, length: f64, setup: &LaneSetup) {
        if self.of(length).is_none() || self.of(0.5 * length).is_none() {
            self.make(length, setup);
        }
    }

    #[cold]
    fn make(&mut self, length: f64, setup: &LaneSetup) {
        if self.0.len() >= KEPT {
            // A table with samples at any times asks for lengths that never come again.
            self.0.clear();
        }
        for length in [length, 0.5 * length] {
            if self.of(length).is_none() {
                let modes = setup.modes_of(length);
                let ratio = setup.stiffness_ratio(&modes);
                self.0.push(Size { length, modes, ratio });
            }
        }
    }

    /// That of a length, where it was made.
    #[inline]
    fn of(&self, length: f64) -> Option<&Size> {
        self.0.iter().find(|size| size.length == length)
    }
}
