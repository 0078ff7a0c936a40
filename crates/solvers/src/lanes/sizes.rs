//! Coefficients where every analysis makes steps of its own length.

use super::coefficients::Rule;
use super::plan::Plan;
use super::setup::LaneSetup;
use super::way::Next;
use crate::single_mode::Mode;
use trilith_element::lanes::{Arithmetic, Real};

/// The rules of the whole steps and of the halves.
pub(super) struct Sizes<R, const M: usize, const L: usize> {
    rules: Option<[Rule<R, M, L>; 2]>,
    lengths: Vec<f64>,
    /// What was made so far of each analysis.
    known: Vec<Known>,
}

/// Lengths whose coefficients are kept.
const KEPT: usize = 128;

impl<R: Real, const M: usize, const L: usize> Sizes<R, M, L> {
    pub fn new(setups: &[&LaneSetup]) -> Self {
        let lengths = setups.iter().map(|s| s.shape.grid.step()).collect();
        Self { rules: None, lengths, known: vec![Known::default(); setups.len()] }
    }

    /// Rules for what comes next; those who have nothing to do go on with what they had.
    #[inline(always)]
    pub fn choose<A: Arithmetic<Real = R>, const N: usize>(
        &mut self,
        with: A,
        setups: &[&LaneSetup],
        plan: &Plan<R, M, L, N>,
        next: &[Option<Next>],
    ) -> &[Rule<R, M, L>; 2] {
        let Self { rules, lengths, known } = self;
        let mut same = true;
        for (length, next) in lengths.iter_mut().zip(next) {
            if let Some(next) = next {
                same &= *length == next.length;
                *length = next.length;
            }
        }
        if !same {
            rules.take();
        }
        rules.get_or_insert_with(|| {
            for ((length, known), setup) in lengths.iter().zip(&mut *known).zip(setups) {
                known.add(*length, setup);
            }
            let sizes = |share: f64| -> Vec<(f64, &[Mode])> {
                let sizes = lengths.iter().zip(&*known);
                sizes.map(|(x, known)| (share * x, known.of(share * x))).collect()
            };
            [Rule::new(with, plan, &sizes(1.0)), Rule::new(with, plan, &sizes(0.5))]
        })
    }
}

/// Coefficients of the lengths that an analysis has had.
#[derive(Clone, Default)]
struct Known(Vec<(f64, Vec<Mode>)>);

impl Known {
    /// Makes those of a length and of its half, where they are not there.
    #[inline]
    fn add(&mut self, length: f64, setup: &LaneSetup) {
        if self.of(length).is_empty() || self.of(0.5 * length).is_empty() {
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
            if self.of(length).is_empty() {
                self.0.push((length, setup.modes_of(length)));
            }
        }
    }

    /// Of a length that was made; nothing of others.
    #[inline]
    fn of(&self, length: f64) -> &[Mode] {
        self.0.iter().find(|(x, _)| *x == length).map_or(&[], |(_, modes)| modes)
    }
}
