//! How far two histories are apart.

use super::Outcome;

/// Points of the common grid at most; what a lag is found on.
const POINTS: usize = 4000;
/// Largest lag looked for, as share of the duration.
const LAG: f64 = 0.1;
/// What the farthest shift must be better than none by, as share of full correlation.
const NEAR: f64 = 0.05;
/// A quantity smaller than this share of the largest with its unit is left out: it is rounding.
const ROUNDING: f64 = 1e-6;

/// How far an output of one run is from that of another, the first.
#[derive(Clone, Debug, PartialEq)]
pub struct Difference {
    /// Index of the output.
    pub output: usize,
    /// Its name.
    pub name: String,
    /// Difference of the largest magnitude, as share of the first's.
    pub peak: f64,
    /// Root mean square of the difference over time, as share of the first's.
    pub rms: f64,
    /// How much later it comes, s: the shift with the best correlation.
    pub lag: f64,
    /// Difference of the last value, as share of the largest magnitude of the first.
    pub residual: f64,
}

/// Differences of all outputs that are more than rounding.
pub(crate) fn differences<'a>(
    names: impl Iterator<Item = &'a str>,
    first: &Outcome,
    other: &Outcome,
) -> Vec<Difference> {
    let size = |i: usize| magnitude(&first.histories[i]);
    let units: Vec<&str> = first.summary.outputs.0.iter().map(|(_, o)| o.unit.as_str()).collect();
    let largest = |unit: &str| {
        let same = units.iter().enumerate().filter(|(_, u)| **u == unit);
        same.map(|(i, _)| size(i)).fold(0.0, f64::max)
    };
    names
        .enumerate()
        .filter(|(i, _)| {
            size(*i) > ROUNDING * largest(units[*i]) && !other.histories[*i].is_empty()
        })
        .map(|(i, name)| Difference { name: name.to_owned(), ..difference(i, first, other) })
        .collect()
}

/// Difference of one output over the time that both runs cover.
pub(crate) fn difference(output: usize, first: &Outcome, other: &Outcome) -> Difference {
    let peak = |o: &Outcome| {
        let peak = o.summary.outputs.0.get(output).and_then(|(_, o)| o.peak);
        peak.map_or(0.0, |p| p.max.abs().max(p.min.abs()))
    };
    let (a, b) = (&first.histories[output], &other.histories[output]);
    let last = |o: &Outcome| o.time.last().copied().unwrap_or(0.0);
    let end = last(first).min(last(other));
    // At the output times of the coarser run: the finer one then needs next to no interpolation.
    let coarse = if first.time.len() <= other.time.len() { first } else { other };
    let stride = coarse.time.len().div_ceil(POINTS).max(1);
    let times: Vec<f64> =
        coarse.time.iter().copied().step_by(stride).filter(|t| *t <= end * (1.0 + 1e-9)).collect();
    let (x, y) = (at(&first.time, a, &times), at(&other.time, b, &times));
    let square = |v: &[f64]| v.iter().map(|x| x * x).sum::<f64>();
    let apart: f64 = x.iter().zip(&y).map(|(x, y)| (x - y) * (x - y)).sum();
    let size = peak(first);
    let share = |x: f64| if size > 0.0 { x / size } else { 0.0 };
    let step = if times.len() > 1 { times[1] - times[0] } else { 0.0 };
    let rms = if square(&x) > 0.0 { (apart / square(&x)).sqrt() } else { 0.0 };
    Difference {
        output,
        name: String::new(),
        peak: share(peak(other) - size),
        rms,
        lag: if rms > 1e-6 { lag(&x, &y) * step } else { 0.0 },
        residual: share(y.last().unwrap_or(&0.0) - x.last().unwrap_or(&0.0)),
    }
}

fn magnitude(y: &[f64]) -> f64 {
    y.iter().fold(0.0, |a: f64, y| a.max(y.abs()))
}

/// Values at rising times, linear between points.
fn at(t: &[f64], y: &[f64], times: &[f64]) -> Vec<f64> {
    let mut i = 0;
    let one = |time: &f64| {
        while i + 2 < t.len() && t[i + 1] <= *time {
            i += 1;
        }
        let (Some(t1), Some(y1)) = (t.get(i + 1), y.get(i + 1)) else {
            return y.first().copied().unwrap_or(0.0);
        };
        let share = ((time - t[i]) / (t1 - t[i])).clamp(0.0, 1.0);
        y[i] + share * (y1 - y[i])
    };
    times.iter().map(one).collect()
}

/// Steps by which `y` comes later than `x`: where their correlation is largest, by a parabola between
/// steps.
fn lag(x: &[f64], y: &[f64]) -> f64 {
    let most = (LAG * x.len() as f64) as isize;
    let mean = |v: &[f64]| v.iter().sum::<f64>() / v.len().max(1) as f64;
    let (mx, my) = (mean(x), mean(y));
    // As a share of what both hold where they overlap, or a shorter overlap would count as less alike.
    let correlation = |shift: isize| -> f64 {
        let pairs = (0..x.len() as isize).filter_map(|i| {
            let j = usize::try_from(i + shift).ok().filter(|j| *j < y.len())?;
            Some((x[i as usize] - mx, y[j] - my))
        });
        let [mut both, mut of_x, mut of_y] = [0.0; 3];
        for (x, y) in pairs {
            both += x * y;
            of_x += x * x;
            of_y += y * y;
        }
        if of_x * of_y > 0.0 { both / (of_x * of_y).sqrt() } else { 0.0 }
    };
    let all: Vec<f64> = (-most..=most).map(correlation).collect();
    // Of a wave every period is as good: the near ones count more.
    let near = |i: usize| all[i] - NEAR * (i as f64 - most as f64).abs() / most.max(1) as f64;
    let mut best = (0..all.len()).fold(0, |a, i| if near(i) > near(a) { i } else { a });
    while best > 0 && all[best - 1] > all[best] {
        best -= 1;
    }
    while best + 1 < all.len() && all[best + 1] > all[best] {
        best += 1;
    }
    let middle = best as f64 - most as f64;
    let (Some(before), Some(after)) = (best.checked_sub(1).map(|i| all[i]), all.get(best + 1))
    else {
        return middle;
    };
    let curve = before - 2.0 * all[best] + after;
    if curve < 0.0 { middle + 0.5 * (before - after) / curve } else { middle }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_delayed_wave_lags_by_its_delay() {
        let wave = |delay: f64| -> Vec<f64> {
            (0..2000)
                .map(|i| {
                    (0.02 * (f64::from(i) - delay)).sin()
                        * (-((f64::from(i) - 1000.0) / 400.0).powi(2)).exp()
                })
                .collect()
        };
        for delay in [0.0, 7.0, -12.5] {
            let found = lag(&wave(0.0), &wave(delay));
            assert!((found - delay).abs() < 0.3, "{delay}: {found}");
        }
    }

    #[test]
    fn values_between_points_are_linear() {
        let (t, y) = ([0.0, 1.0, 2.0], [0.0, 2.0, 0.0]);
        assert_eq!(at(&t, &y, &[0.0, 0.5, 1.0, 1.5, 2.0]), [0.0, 1.0, 2.0, 1.0, 0.0]);
    }
}
