//! Long histories as short ones that look the same.

use super::data::{History, Numbers};
use super::units::shown;
use crate::draw::nearest;

/// Histories up to this length are kept as they are.
const WHOLE: usize = 3000;
/// Buckets of longer ones; of each the smallest and the largest value stay.
const BUCKETS: usize = 1000;
/// Steps of a number, of the largest magnitude.
const VALUE: f64 = 2e5;
const TIME: f64 = 1e8;

/// A quantity over time, reduced.
pub(crate) fn history(name: String, unit: &str, t: &[f64], y: &[f64]) -> History {
    let largest = y.iter().filter(|x| x.is_finite()).fold(0.0_f64, |a, x| a.max(x.abs()));
    let kept = extremes(y);
    History {
        name,
        kind: String::new(),
        shown: shown(unit, largest),
        t: steps(t, &kept),
        y: Numbers::new(kept.iter().map(|i| y[*i]), VALUE),
    }
}

/// Numbers of a loop.
pub(crate) fn numbers(values: impl Iterator<Item = f64> + Clone) -> Numbers {
    Numbers::new(values, VALUE)
}

/// Times at some of the output times: multiples of the output step where they are that, which makes short numbers.
fn steps(t: &[f64], kept: &[usize]) -> Numbers {
    let step = t.get(1).map_or(0.0, |second| second - t[0]);
    let even = |i: &usize| {
        let n = t[*i] / step;
        (n - nearest(n) as f64).abs() < 1e-6 && n.abs() < 1e9
    };
    if step > 0.0 && kept.iter().all(even) {
        return Numbers { step, n: kept.iter().map(|i| nearest(t[*i] / step) as i32).collect() };
    }
    times(kept.iter().map(|i| t[*i]))
}

/// Times.
pub(crate) fn times(values: impl Iterator<Item = f64> + Clone) -> Numbers {
    Numbers::new(values, TIME)
}

/// Indices of the first, the last, and the smallest and largest value of every bucket, rising.
fn extremes(y: &[f64]) -> Vec<usize> {
    if y.len() <= WHOLE {
        return (0..y.len()).collect();
    }
    let mut kept = Vec::with_capacity(2 * BUCKETS + 2);
    kept.push(0);
    for bucket in 0..BUCKETS {
        let range = bucket * y.len() / BUCKETS..(bucket + 1) * y.len() / BUCKETS;
        let (mut low, mut high) = (range.start, range.start);
        // Written out, as this crate is compiled quickly and histories are long.
        let mut i = range.start;
        while i < range.end {
            // What is no number is passed over.
            if y[i] < y[low] || y[low].is_nan() {
                low = i;
            }
            if y[i] >= y[high] || y[high].is_nan() {
                high = i;
            }
            i += 1;
        }
        kept.extend([low.min(high), low.max(high)]);
    }
    kept.push(y.len() - 1);
    kept.dedup();
    kept
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_long_history_keeps_its_spikes() {
        let t: Vec<f64> = (0..200_000).map(|i| 1e-3 * f64::from(i)).collect();
        let mut y: Vec<f64> = t.iter().map(|t| t.sin()).collect();
        (y[77_777], y[123_456]) = (9.0, -8.0);
        let h = history("y".into(), "m", &t, &y);
        assert!(h.t.n.len() <= 2 * BUCKETS + 2);
        for (at, value) in [(77.777, 9.0), (123.456, -8.0)] {
            let found = h.points().find(|(_, v)| (v - value).abs() < 5e-5);
            assert!(found.is_some_and(|(t, _)| (t - at).abs() < 1e-4), "{found:?}");
        }
        assert!((h.t.values().last().unwrap() - 199.999).abs() < 1e-5);
        assert_eq!(h.t.n.last(), Some(&199_999));
        // A last step that is cut short keeps its time.
        let odd = [0.0, 0.1, 0.2, 0.25];
        let h = history("y".into(), "m", &odd, &[0.0, 1.0, 2.0, 3.0]);
        assert!(h.t.values().zip(odd).all(|(a, b)| (a - b).abs() < 1e-8));
    }
}
