//! Tables of time and value, interpolated linearly or by a natural cubic spline.

use crate::{Corner, Side};

/// Interpolation between the samples of a table.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Interpolation {
    /// Straight lines; for accelerograms and forces.
    #[default]
    Linear,
    /// Natural cubic spline, twice continuously differentiable; for displacement histories.
    Cubic,
}

/// What holds after the last sample of a table.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum AfterEnd {
    /// No case may last longer than the table.
    #[default]
    Error,
    /// Zero.
    Zero,
    /// The last value.
    Hold,
}

/// Why samples make no table.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum TableError {
    /// Fewer than two samples.
    #[error("a table needs at least two samples, this one has {0}")]
    TooShort(usize),
    /// Times and values differ in number.
    #[error("{0} times and {1} values")]
    Lengths(usize, usize),
    /// Time does not increase.
    #[error("time must increase: sample {index} at {time} s follows {before} s")]
    Order {
        /// Index of the sample, from 0.
        index: usize,
        /// Its time, s.
        time: f64,
        /// Time of the sample before, s.
        before: f64,
    },
    /// A time or value is not finite.
    #[error("sample {0} is not finite")]
    NotFinite(usize),
}

/// Distance from a straight line, as a share of the peak, that is rounding.
const STRAIGHT: f64 = 1e-9;

/// Share of a segment within which a time is guessed to be that of a sample.
const LEAN: f64 = 1e-6;

/// Share of a distance between samples, or of a step, that is rounding.
const ROUNDED: f64 = 1e-9;

/// Samples of a function of time; zero before the first one.
#[derive(Clone, Debug, PartialEq)]
pub struct Table {
    times: Vec<f64>,
    values: Vec<f64>,
    /// Second derivatives of the spline at the samples; empty for linear interpolation.
    curvatures: Vec<f64>,
    /// Mean number of segments in a second.
    per_time: f64,
    /// True where all are as long, but for rounding.
    is_even: bool,
    after_end: AfterEnd,
}

impl Table {
    /// A table of times (s, increasing) and values (SI).
    ///
    /// # Errors
    /// [`TableError`] for fewer than two samples, times that do not increase, and numbers that are
    /// not finite.
    pub fn new(
        times: Vec<f64>,
        values: Vec<f64>,
        interpolation: Interpolation,
        after_end: AfterEnd,
    ) -> Result<Self, TableError> {
        if times.len() != values.len() {
            return Err(TableError::Lengths(times.len(), values.len()));
        }
        if times.len() < 2 {
            return Err(TableError::TooShort(times.len()));
        }
        if let Some(i) =
            (0..times.len()).find(|&i| !(times[i].is_finite() && values[i].is_finite()))
        {
            return Err(TableError::NotFinite(i));
        }
        if let Some(i) = (1..times.len()).find(|&i| times[i] <= times[i - 1]) {
            return Err(TableError::Order { index: i, time: times[i], before: times[i - 1] });
        }
        let curvatures = match interpolation {
            Interpolation::Linear => Vec::new(),
            Interpolation::Cubic => natural_spline(&times, &values),
        };
        let last = times.len() - 1;
        let per_time = last as f64 / (times[last] - times[0]);
        let off = |(i, t): (usize, &f64)| ((t - times[0]) * per_time - i as f64).abs();
        let is_even = times.iter().enumerate().map(off).all(|off| off <= ROUNDED);
        Ok(Self { times, values, curvatures, per_time, is_even, after_end })
    }

    /// Times of the samples, s.
    #[must_use]
    pub fn times(&self) -> &[f64] {
        &self.times
    }

    /// Values of the samples, SI.
    #[must_use]
    pub fn values(&self) -> &[f64] {
        &self.values
    }

    /// Time of the first sample, s.
    #[must_use]
    pub fn start(&self) -> f64 {
        self.times[0]
    }

    /// Time of the last sample, s.
    #[must_use]
    pub fn end(&self) -> f64 {
        self.times[self.times.len() - 1]
    }

    /// How it is interpolated.
    #[must_use]
    pub fn interpolation(&self) -> Interpolation {
        if self.curvatures.is_empty() { Interpolation::Linear } else { Interpolation::Cubic }
    }

    /// What holds after the last sample.
    #[must_use]
    pub fn after_end(&self) -> AfterEnd {
        self.after_end
    }

    /// The table with its values times a factor.
    #[must_use]
    pub fn scaled(&self, factor: f64) -> Self {
        let by = |all: &[f64]| all.iter().map(|y| factor * y).collect();
        Self { values: by(&self.values), curvatures: by(&self.curvatures), ..self.clone() }
    }

    /// Largest |value|, between the samples of a spline too.
    #[must_use]
    pub fn peak(&self) -> f64 {
        let samples = self.values.iter().fold(0.0_f64, |a, y| a.max(y.abs()));
        if self.curvatures.is_empty() {
            return samples;
        }
        (0..self.times.len() - 1)
            .flat_map(|i| self.turning_points(i))
            .fold(samples, |a, t| a.max(self.at(t, Side::Before)[0].abs()))
    }

    /// Largest |value| up to a time.
    pub(crate) fn peak_until(&self, end: f64) -> f64 {
        if end >= self.end() {
            return self.peak();
        }
        let before = self.times.partition_point(|t| *t <= end);
        let samples = self.values[..before].iter().fold(0.0_f64, |a, y| a.max(y.abs()));
        let turns = if self.curvatures.is_empty() { 0..0 } else { 0..before };
        turns
            .flat_map(|i| self.turning_points(i))
            .filter(|t| *t < end)
            .chain([end])
            .fold(samples, |a, t| a.max(self.at(t, Side::Before)[0].abs()))
    }

    /// True where all samples lie on multiples of a time (s), but for rounding.
    #[must_use]
    pub fn lies_on(&self, dt: f64) -> bool {
        let off = |x: f64| (x - x.round()).abs();
        let steps = (self.per_time * dt).recip();
        let is_multiple = steps > 0.5 && off(steps) * self.times.len() as f64 <= ROUNDED;
        self.is_even && is_multiple && off(self.start() / dt) <= ROUNDED
    }

    /// Samples at which the table bends: those of a spline, and of straight lines those that do not lie on the line
    /// through the two before.
    #[must_use]
    pub fn corners(&self) -> Vec<Corner> {
        let (t, y) = (&self.times, &self.values);
        let corner = |around: &[f64]| {
            let reach = (around[1] - around[0]).min(around[2] - around[1]);
            Corner { t: around[1], reach }
        };
        let all = t.windows(3).map(corner);
        if !self.curvatures.is_empty() {
            return all.collect();
        }
        let slope = |i: usize| (y[i + 1] - y[i]) / (t[i + 1] - t[i]);
        let allowed = STRAIGHT * self.peak();
        // Sample from which on a line goes on, and its slope.
        let mut line = (0, slope(0));
        let mut corners = Vec::new();
        for (i, corner) in (1..).zip(all) {
            let (from, rise) = line;
            if (y[i + 1] - (y[from] + rise * (t[i + 1] - t[from]))).abs() > allowed {
                corners.push(corner);
                line = (i, slope(i));
            }
        }
        corners
    }

    /// √(largest |y″| / peak), rad/s: how a spline is bent between its samples; 0 of straight lines.
    pub(crate) fn bend(&self) -> f64 {
        let largest = self.curvatures.iter().fold(0.0_f64, |a, m| a.max(m.abs()));
        if largest > 0.0 { (largest / self.peak()).sqrt() } else { 0.0 }
    }

    /// Value and first two derivatives at t.
    pub(crate) fn at(&self, t: f64, side: Side) -> [f64; 3] {
        if !side.is_past(t, self.start()) {
            return [0.0; 3];
        }
        let last = self.times.len() - 1;
        if side.is_past(t, self.end()) {
            // A case that lasts exactly as long as the table still meets its last value.
            let held = if self.after_end == AfterEnd::Zero { 0.0 } else { self.values[last] };
            return [held, 0.0, 0.0];
        }
        let i = self.segment(t, side);
        let (times, values) =
            ([self.times[i], self.times[i + 1]], [self.values[i], self.values[i + 1]]);
        if self.curvatures.is_empty() {
            let (value, slope) = within(times, values, t);
            return [value, slope, 0.0];
        }
        let (h, x) = (times[1] - times[0], t - times[0]);
        let [b, c, d] = self.coefficients(i);
        let inside = values[0] + x * (b + x * (c + x * d));
        let value = if x == h { values[1] } else { inside };
        [value, b + x * (2.0 * c + 3.0 * x * d), 2.0 * c + 6.0 * x * d]
    }

    /// Value at t.
    #[inline]
    pub(crate) fn value(&self, t: f64, side: Side) -> f64 {
        // Mostly t lies in the segment that is guessed, or at its end.
        let i = self.guess(t, side).min(self.times.len());
        if self.curvatures.is_empty()
            && let (Some([t0, t1]), Some([y0, y1])) =
                (self.times.get(i..i + 2), self.values.get(i..i + 2))
            && side.is_past(t, *t0)
            && !side.is_past(t, *t1)
        {
            return within([*t0, *t1], [*y0, *y1], t).0;
        }
        self.at(t, side)[0]
    }

    /// Index of the segment in which t lies if samples are evenly spaced, or more than there are.
    fn guess(&self, t: f64, side: Side) -> usize {
        // A sample seen from before belongs to the segment that ends there.
        let lean = if side == Side::Before { -LEAN } else { LEAN };
        // Of 32 bits, which takes far fewer instructions.
        ((t - self.start()) * self.per_time + lean) as u32 as usize
    }

    /// Index of the segment that holds t. Samples are mostly evenly spaced, so it is guessed first.
    fn segment(&self, t: f64, side: Side) -> usize {
        let last = self.times.len() - 1;
        let guess = self.guess(t, side).min(last - 1);
        let holds = |i: usize| {
            (i == 0 || side.is_past(t, self.times[i]))
                && (i + 1 == last || !side.is_past(t, self.times[i + 1]))
        };
        for i in [guess, guess.saturating_sub(1), (guess + 1).min(last - 1)] {
            if holds(i) {
                return i;
            }
        }
        self.times.partition_point(|&x| side.is_past(t, x)).clamp(1, last) - 1
    }

    /// Coefficients of x, x², x³ in segment i of the spline.
    fn coefficients(&self, i: usize) -> [f64; 3] {
        let h = self.times[i + 1] - self.times[i];
        let slope = (self.values[i + 1] - self.values[i]) / h;
        let (m0, m1) = (self.curvatures[i], self.curvatures[i + 1]);
        [slope - h * (2.0 * m0 + m1) / 6.0, m0 / 2.0, (m1 - m0) / (6.0 * h)]
    }

    /// Times within segment i at which the spline has slope zero.
    fn turning_points(&self, i: usize) -> Vec<f64> {
        let [b, c, d] = self.coefficients(i);
        let h = self.times[i + 1] - self.times[i];
        let root = c * c - 3.0 * b * d;
        if root < 0.0 {
            return Vec::new();
        }
        // 3d x² + 2c x + b = 0 without cancellation; a vanishing divisor gives no finite root.
        let q = -(c + c.signum() * root.sqrt());
        [q / (3.0 * d), b / q]
            .into_iter()
            .filter(|x| (0.0..=h).contains(x))
            .map(|x| self.times[i] + x)
            .collect()
    }
}

/// Value and slope within a straight segment. The value at a sample is the same from both sides, to the bit.
fn within([t0, t1]: [f64; 2], [y0, y1]: [f64; 2], t: f64) -> (f64, f64) {
    let (h, x) = (t1 - t0, t - t0);
    let slope = (y1 - y0) / h;
    (if x == h { y1 } else { y0 + slope * x }, slope)
}

/// Second derivatives at the samples of a natural cubic spline (Thomas algorithm).
fn natural_spline(t: &[f64], y: &[f64]) -> Vec<f64> {
    let n = t.len();
    let mut m = vec![0.0; n];
    let mut upper = vec![0.0; n];
    for i in 1..n - 1 {
        let (h0, h1) = (t[i] - t[i - 1], t[i + 1] - t[i]);
        let right = 6.0 * ((y[i + 1] - y[i]) / h1 - (y[i] - y[i - 1]) / h0);
        let pivot = 2.0 * (h0 + h1) - h0 * upper[i - 1];
        upper[i] = h1 / pivot;
        m[i] = (right - h0 * m[i - 1]) / pivot;
    }
    for i in (1..n - 1).rev() {
        m[i] -= upper[i] * m[i + 1];
    }
    m
}

#[cfg(test)]
mod tests {
    use super::*;

    fn sine(n: usize) -> Table {
        let times: Vec<f64> = (0..=n).map(|i| std::f64::consts::PI * i as f64 / n as f64).collect();
        let values = times.iter().map(|t| t.sin()).collect();
        Table::new(times, values, Interpolation::Cubic, AfterEnd::Zero).unwrap()
    }

    #[test]
    fn a_value_alone_is_that_which_comes_with_derivatives() {
        let times = [0.5, 1.0, 1.7, 1.75, 3.0, 4.5];
        for interpolation in [Interpolation::Linear, Interpolation::Cubic] {
            for after_end in [AfterEnd::Zero, AfterEnd::Hold] {
                let values = vec![3.0, -1.0, 2.0, 5.0, 4.0, 7.0];
                let table = Table::new(times.to_vec(), values, interpolation, after_end).unwrap();
                let between = (0..600).map(|i| 0.01 * f64::from(i));
                for t in between.chain(times).chain([-1e300, -1.0, 1e300]) {
                    for side in [Side::Before, Side::After] {
                        let [value, ..] = table.at(t, side);
                        assert_eq!(table.value(t, side).to_bits(), value.to_bits(), "{t}");
                    }
                }
            }
        }
    }

    #[test]
    fn a_spline_through_a_sine_has_its_derivatives() {
        let [y, first, second] = sine(40).at(1.0, Side::Before);
        assert!((y - 1.0_f64.sin()).abs() < 1e-6);
        assert!((first - 1.0_f64.cos()).abs() < 1e-5);
        assert!((second + 1.0_f64.sin()).abs() < 2e-3);
    }

    #[test]
    fn the_peak_of_a_spline_lies_between_samples() {
        let table = sine(5); // no sample at π/2
        assert!((table.peak() - 1.0).abs() < 5e-3 && table.peak() > table.values()[2]);
        assert_eq!(table.peak_until(100.0), table.peak());
        assert_eq!(table.peak_until(0.7), table.at(0.7, Side::Before)[0]);
        assert_eq!(table.peak_until(1.7), table.peak());
    }

    #[test]
    fn a_linear_table_meets_its_samples_from_both_sides() {
        let table = Table::new(
            vec![0.0, 1.0, 2.0],
            vec![0.0, 2.0, 1.0],
            Interpolation::Linear,
            AfterEnd::Zero,
        )
        .unwrap();
        assert_eq!(table.at(1.0, Side::Before), [2.0, 2.0, 0.0]);
        assert_eq!(table.at(1.0, Side::After), [2.0, -1.0, 0.0]);
        assert_eq!(table.at(2.0, Side::Before)[0], 1.0);
        assert_eq!(table.at(2.0, Side::After)[0], 0.0);
    }

    #[test]
    fn a_table_bends_where_its_samples_leave_the_line() {
        let times: Vec<f64> = (0..8).map(|i| 0.1 * f64::from(i)).collect();
        let values = vec![0.0, 0.1, 0.2, 0.3, 0.1, 0.0, 0.0, 0.0];
        let table = |interpolation| {
            Table::new(times.clone(), values.clone(), interpolation, AfterEnd::Zero).unwrap()
        };
        let at = |table: Table| table.corners().iter().map(|c| c.t).collect::<Vec<_>>();
        assert_eq!(at(table(Interpolation::Linear)), [times[3], times[4], times[5]]);
        assert_eq!(at(table(Interpolation::Cubic)), times[1..7]);
        // A bend that no sample shows against its neighbours is not lost.
        let n = 200_000;
        let fine: Vec<f64> = (0..=n).map(|i| f64::from(i) / f64::from(n)).collect();
        let arch: Vec<f64> = fine.iter().map(|t| t * (1.0 - t)).collect();
        let arch = Table::new(fine, arch, Interpolation::Linear, AfterEnd::Zero).unwrap();
        let kept = arch.corners();
        assert!(kept.len() > 1000, "{}", kept.len());
    }

    #[test]
    fn samples_lie_on_steps_that_are_fractions_of_their_distance() {
        let from = |start: f64, spacing: f64, late: f64| {
            let time = |i: i32| start + spacing * f64::from(i) + if i == 7 { late } else { 0.0 };
            let times: Vec<f64> = (0..4000).map(time).collect();
            Table::new(times, vec![1.0; 4000], Interpolation::Linear, AfterEnd::Zero).unwrap()
        };
        for dt in [0.02, 0.01, 0.005, 0.02 / 3.0] {
            assert!(from(0.0, 0.02, 0.0).lies_on(dt) && from(3.0 * dt, 0.02, 0.0).lies_on(dt));
            assert!(!from(0.0, 0.02, 1e-6).lies_on(dt) && !from(0.4 * dt, 0.02, 0.0).lies_on(dt));
        }
        // What is off by little is off by a step after some thousands.
        for dt in [0.04, 0.013, 0.02 * 1.0001, 0.02 * 3999.0 / 4000.0] {
            assert!(!from(0.0, 0.02, 0.0).lies_on(dt));
        }
    }

    #[test]
    fn times_that_do_not_increase_are_refused() {
        let order = Table::new(vec![0.0, 0.0], vec![1.0; 2], Interpolation::Linear, AfterEnd::Zero);
        assert!(matches!(order, Err(TableError::Order { index: 1, .. })));
    }
}
