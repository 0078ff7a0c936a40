//! What several threads are worth, on a machine whose cores change their pace.

use crate::clock::{least, median};
use serde::{Deserialize, Serialize};
use std::panic::resume_unwind;
use std::time::Instant;

/// The same work on one thread, on all, and as separate pieces, many times in turn.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Threads {
    /// Threads of the machine.
    pub count: usize,
    /// The fastest run on one thread and the fastest on all, wall-clock time, s.
    pub fastest_s: [f64; 2],
    /// How much faster all threads are than one: median of the runs that followed each other.
    pub median: f64,
    /// Rate of the work on all threads over the sum of the rates of separate pieces at once, one to a thread: 1 where
    /// sharing out costs nothing, whatever the paces of the cores. Median.
    pub of_separate: f64,
}

impl Threads {
    /// The figures of several rounds on so many threads.
    pub(crate) fn of(count: usize, rounds: &[Round]) -> Self {
        let of = |read: fn(&Round) -> f64| rounds.iter().map(read).collect::<Vec<_>>();
        Self {
            count,
            fastest_s: [least(&of(|r| r.one)), least(&of(|r| r.all))],
            median: median(of(|r| r.one / r.all)),
            of_separate: median(of(Round::of_separate)),
        }
    }

    /// How much faster all threads are than one: the fastest run of each.
    #[must_use]
    pub fn speedup(&self) -> f64 {
        self.fastest_s[0] / self.fastest_s[1]
    }

    /// The fastest of several measurements, and the medians of their medians.
    pub(crate) fn among(all: &[&Self]) -> Option<Self> {
        let of = |read: fn(&Self) -> f64| all.iter().map(|t| read(t)).collect::<Vec<_>>();
        Some(Self {
            count: all.first()?.count,
            fastest_s: [least(&of(|t| t.fastest_s[0])), least(&of(|t| t.fastest_s[1]))],
            median: median(of(|t| t.median)),
            of_separate: median(of(|t| t.of_separate)),
        })
    }
}

/// Wall-clock times of one round, s.
pub(crate) struct Round {
    /// On one thread.
    pub one: f64,
    /// On all.
    pub all: f64,
    /// Of separate pieces at once: the share of the work and the time of each.
    pub separate: Vec<(f64, f64)>,
}

impl Round {
    fn of_separate(&self) -> f64 {
        self.all.recip() / self.separate.iter().map(|(share, time)| share / time).sum::<f64>()
    }
}

/// Works on equal pieces at once, each on a thread of its own: the share of each and its wall-clock time, s.
pub(crate) fn separately<T: Sync>(
    items: &[T],
    count: usize,
    work: impl Fn(&[T]) + Sync,
) -> Vec<(f64, f64)> {
    let one = |piece: &[T]| {
        let start = Instant::now();
        work(piece);
        (piece.len() as f64 / items.len() as f64, start.elapsed().as_secs_f64())
    };
    std::thread::scope(|scope| {
        let pieces = items.chunks(items.len().div_ceil(count).max(1));
        let running: Vec<_> = pieces.map(|piece| scope.spawn(|| one(piece))).collect();
        running.into_iter().map(|w| w.join().unwrap_or_else(|e| resume_unwind(e))).collect()
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn separate_pieces_of_unequal_pace_do_not_change_what_sharing_out_costs() {
        // One thread does 10 a second, the other 5; half the work each; together 15 a second where nothing is lost.
        let separate = vec![(0.5, 0.05), (0.5, 0.1)];
        let round = |all: f64| Round { one: 0.1, all, separate: separate.clone() };
        let found = Threads::of(2, &[round(1.0 / 15.0), round(1.0 / 15.0), round(0.08)]);
        assert!((found.of_separate - 1.0).abs() < 1e-12, "{found:?}");
        assert!((found.median - 1.5).abs() < 1e-12 && found.speedup() == found.median);
        let slower = Threads { fastest_s: [0.09, 0.08], median: 1.2, ..found.clone() };
        let both = Threads::among(&[&found, &slower]).expect("two");
        assert!((both.speedup() - 1.35).abs() < 1e-12 && (both.median - 1.35).abs() < 1e-12);
    }

    #[test]
    fn the_shares_of_separate_pieces_are_the_whole() {
        let pieces = separately(&[1, 2, 3, 4, 5], 2, |p| assert!(!p.is_empty()));
        assert_eq!(pieces.len(), 2);
        assert!((pieces.iter().map(|(share, _)| share).sum::<f64>() - 1.0).abs() < 1e-15);
    }
}
