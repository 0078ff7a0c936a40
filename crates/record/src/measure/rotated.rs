//! Measures of two horizontal components that do not depend on how the instrument was turned: RotDnn
//! \[Boore 2010\].
//!
//! The peak in direction θ is the largest |x cos θ + y sin θ|, θ = 0°, 1° … 179°. It lies on the convex hull of
//! the points (x, y), so that only its corners are looked at.

use super::{Oscillator, steps_per_sample};

/// Percentiles over all directions.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Rotated {
    /// Least.
    pub d00: f64,
    /// Median.
    pub d50: f64,
    /// Largest.
    pub d100: f64,
    /// Direction of the largest, degrees from the first component to the second.
    pub angle: f64,
    /// Geometric mean of the two components as recorded.
    pub geometric_mean: f64,
}

/// Percentiles of the peaks of two histories over all directions.
#[must_use]
pub fn rotated_peak(x: &[f64], y: &[f64]) -> Rotated {
    let points: Vec<(f64, f64)> = x.iter().copied().zip(y.iter().copied()).collect();
    let corners = hull(points);
    let at = |degrees: usize| {
        let (s, c) = (degrees as f64).to_radians().sin_cos();
        corners.iter().fold(0.0_f64, |m, (x, y)| m.max((x * c + y * s).abs()))
    };
    let mut all: Vec<(f64, usize)> = (0..180).map(|d| (at(d), d)).collect();
    all.sort_by(|a, b| a.0.total_cmp(&b.0).then(a.1.cmp(&b.1)));
    Rotated {
        d00: all[0].0,
        d50: 0.5 * (all[89].0 + all[90].0),
        d100: all[179].0,
        angle: all[179].1 as f64,
        geometric_mean: (super::peak(x) * super::peak(y)).sqrt(),
    }
}

/// Pseudo-accelerations (m/s²) of two components over all directions, for each period.
#[must_use]
pub fn rotated(x: &[f64], y: &[f64], dt: f64, periods: &[f64], damping: f64) -> Vec<Rotated> {
    let n = x.len().min(y.len());
    periods
        .iter()
        .map(|&period| {
            if period <= 0.0 {
                return rotated_peak(&x[..n], &y[..n]);
            }
            let o = Oscillator { period, damping };
            let (parts, tail) = (steps_per_sample(dt, period), period);
            let [u, v] =
                [x, y].map(|a| o.displacement(&finer(&a[..n], dt, parts, tail), dt / parts as f64));
            let w2 = o.omega().powi(2);
            let r = rotated_peak(&u, &v);
            Rotated {
                d00: w2 * r.d00,
                d50: w2 * r.d50,
                d100: w2 * r.d100,
                angle: r.angle,
                geometric_mean: w2 * r.geometric_mean,
            }
        })
        .collect()
}

/// The straight pieces cut into parts, with zeros for a time behind them.
fn finer(a: &[f64], dt: f64, parts: usize, tail: f64) -> Vec<f64> {
    let mut all = Vec::with_capacity(a.len() * parts);
    for p in a.windows(2) {
        let slope = (p[1] - p[0]) / parts as f64;
        all.extend((0..parts).map(|k| p[0] + slope * k as f64));
    }
    all.extend(a.last());
    all.resize(all.len() + (tail / dt * parts as f64).ceil().min(1e7) as usize, 0.0);
    all
}

/// Corners of the convex hull, by Andrew's monotone chain.
fn hull(mut points: Vec<(f64, f64)>) -> Vec<(f64, f64)> {
    points.sort_by(|a, b| a.0.total_cmp(&b.0).then(a.1.total_cmp(&b.1)));
    points.dedup();
    if points.len() < 3 {
        return points;
    }
    let turn = |o: (f64, f64), a: (f64, f64), b: (f64, f64)| {
        (a.0 - o.0) * (b.1 - o.1) - (a.1 - o.1) * (b.0 - o.0)
    };
    let chain = |points: &mut dyn Iterator<Item = (f64, f64)>| {
        let mut side: Vec<(f64, f64)> = Vec::new();
        for p in points {
            while side.len() > 1 && turn(side[side.len() - 2], side[side.len() - 1], p) <= 0.0 {
                side.pop();
            }
            side.push(p);
        }
        side.pop();
        side
    };
    let mut all = chain(&mut points.iter().copied());
    all.extend(chain(&mut points.iter().rev().copied()));
    all
}

#[cfg(test)]
mod tests {
    use super::*;

    fn pair() -> [Vec<f64>; 2] {
        let of = |p: f64, q: f64| {
            (0..400).map(|i| (p * i as f64).sin() + 0.5 * (q * i as f64).cos() - 0.5).collect()
        };
        [of(0.31, 0.11), of(0.17, 0.43)]
    }

    #[test]
    fn the_hull_gives_what_every_direction_by_itself_gives() {
        let [x, y] = pair();
        let r = rotated_peak(&x, &y);
        let mut brute: Vec<f64> = (0..180)
            .map(|d| {
                let (s, c) = f64::from(d).to_radians().sin_cos();
                x.iter().zip(&y).fold(0.0_f64, |m, (x, y)| m.max((x * c + y * s).abs()))
            })
            .collect();
        brute.sort_by(f64::total_cmp);
        assert!((r.d00 - brute[0]).abs() < 1e-14 && (r.d100 - brute[179]).abs() < 1e-14);
        assert!((r.d50 - 0.5 * (brute[89] + brute[90])).abs() < 1e-14);
        let sum = super::super::peak(&x) * super::super::peak(&y);
        assert!((r.geometric_mean - sum.sqrt()).abs() < 1e-14);
    }

    /// One motion along a line at 30°: RotD100 is that of the line, RotD50 its cos 45°.
    #[test]
    fn a_motion_along_a_line_has_the_percentiles_of_a_cosine() {
        let along: Vec<f64> = (0..300).map(|i| (0.2 * f64::from(i)).sin()).collect();
        let (s, c) = 30f64.to_radians().sin_cos();
        let x: Vec<f64> = along.iter().map(|a| a * c).collect();
        let y: Vec<f64> = along.iter().map(|a| a * s).collect();
        let whole = super::super::spectrum(&along, 0.01, &[0.0, 0.5], 0.05).psa();
        for (r, one) in rotated(&x, &y, 0.01, &[0.0, 0.5], 0.05).iter().zip(whole) {
            assert!((r.d100 / one - 1.0).abs() < 2e-3, "{} {one}", r.d100);
            assert!((r.d50 / r.d100 - 45f64.to_radians().cos()).abs() < 1e-2);
            assert_eq!(r.angle, 30.0);
        }
    }
}
