//! Time functions: analytic pulses and tables.
//!
//! Times in s from the start of the case, frequencies in Hz, phases in rad.

use crate::{Custom, Table};
use std::f64::consts::{PI, TAU};
use std::sync::Arc;
pub use trilith_element::{Side, Stretch};

/// A bend of a table.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Corner {
    /// When, s.
    pub t: f64,
    /// Time to the nearer of the samples beside it, s.
    pub reach: f64,
}

/// Steps in the period of a sine: straight lines between them miss 1 − cos(π/16) = 1.9 % of its amplitude at most
/// and 1.3 % in the mean, as 1 − (sin(π/16)/(π/16))².
const STEPS_OF_A_PERIOD: f64 = 16.0;
/// A Ricker pulse is over where π·frequency·|t − center| is this: 4e-6 of its peak.
const RICKER_REACH: f64 = 4.0;

/// A function of time; zero before `start` and after its end. Frequencies in Hz.
#[derive(Clone, Debug, PartialEq)]
pub enum TimeFunction {
    /// The same value at all times.
    Constant(f64),
    /// `amplitude` from `start` to `end`.
    Step {
        /// Value.
        amplitude: f64,
        /// s.
        start: f64,
        /// s; `None`: never.
        end: Option<f64>,
    },
    /// Rises linearly from zero at `start` to `amplitude` within `rise`, then holds.
    Ramp {
        /// Final value.
        amplitude: f64,
        /// s.
        start: f64,
        /// s, positive.
        rise: f64,
    },
    /// `amplitude · sin(2π·frequency·(t − start) + phase)`.
    Sine(Harmonic),
    /// `amplitude · cos(2π·frequency·(t − start) + phase)`.
    Cosine(Harmonic),
    /// `amplitude · sin(π·(t − start)/duration)`, one half wave.
    HalfSine {
        /// Peak value.
        amplitude: f64,
        /// s, positive.
        duration: f64,
        /// s.
        start: f64,
    },
    /// `amplitude · (1 − 2a) · exp(−a)`, `a = (π·frequency·(t − center))²`.
    Ricker {
        /// Peak value, at the center.
        amplitude: f64,
        /// Frequency of the spectral peak, Hz.
        frequency: f64,
        /// s.
        center: f64,
    },
    /// Values at given times.
    Table(Arc<Table>),
    /// What another crate offers.
    Custom(Custom),
}

/// A harmonic of a number of cycles.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Harmonic {
    /// Amplitude.
    pub amplitude: f64,
    /// Hz, positive.
    pub frequency: f64,
    /// Full cycles, then zero; `None`: endless.
    pub cycles: Option<f64>,
    /// s.
    pub start: f64,
    /// Phase at the start, rad.
    pub phase: f64,
}

impl Harmonic {
    /// Time at which it ends, s; infinite where it is endless.
    #[must_use]
    pub fn end(&self) -> f64 {
        self.cycles.map_or(f64::INFINITY, |n| self.start + n / self.frequency)
    }

    /// The argument of a sine with this additional phase; none before and behind it.
    fn argument(&self, t: f64, side: Side, phase: f64) -> Option<f64> {
        let is_on = side.is_past(t, self.start) && !side.is_past(t, self.end());
        is_on.then_some(TAU * self.frequency * (t - self.start) + self.phase + phase)
    }

    fn value(&self, t: f64, side: Side, phase: f64) -> f64 {
        self.argument(t, side, phase).map_or(0.0, |x| self.amplitude * x.sin())
    }

    /// Value and first two derivatives.
    fn at(&self, t: f64, side: Side, phase: f64) -> [f64; 3] {
        let Some(x) = self.argument(t, side, phase) else { return [0.0; 3] };
        let w = TAU * self.frequency;
        let (sin, cos) = x.sin_cos();
        [self.amplitude * sin, self.amplitude * w * cos, -self.amplitude * w * w * sin]
    }

    /// As far as it comes up to a time.
    fn until(&self, end: f64) -> Self {
        if end <= self.start {
            return Self { amplitude: 0.0, ..*self };
        }
        let cycles = (end.min(self.end()) - self.start) * self.frequency;
        Self { cycles: cycles.is_finite().then_some(cycles), ..*self }
    }

    fn peak(&self, phase: f64) -> f64 {
        let from = self.phase + phase;
        let to = from + TAU * self.cycles.unwrap_or(1.0);
        // Crests are at π/2 + kπ.
        let crest = ((from / PI - 0.5).ceil() + 0.5) * PI;
        let share = if crest <= to { 1.0 } else { from.sin().abs().max(to.sin().abs()) };
        self.amplitude.abs() * share
    }
}

impl TimeFunction {
    /// Value at t (s), in SI.
    #[must_use]
    pub fn value(&self, t: f64, side: Side) -> f64 {
        match self {
            Self::Table(table) => table.value(t, side),
            Self::Sine(h) => h.value(t, side, 0.0),
            Self::Cosine(h) => h.value(t, side, PI / 2.0),
            _ => self.all(t, side)[0],
        }
    }

    /// First and second derivative at t (s), per s and per s².
    ///
    /// Exact; where a function jumps, the derivatives of the branch on that side. A linear table has
    /// the slope of its segment and no second derivative.
    #[must_use]
    pub fn derivatives(&self, t: f64, side: Side) -> (f64, f64) {
        let [_, first, second] = self.all(t, side);
        (first, second)
    }

    /// Times (s, sorted) at which the value, the slope or what defines the function may jump; a step must end
    /// there. Of tables the start and the end: between them there are [corners](Table::corners).
    #[must_use]
    pub fn breaks(&self) -> Vec<f64> {
        let mut times = match self {
            Self::Constant(_) | Self::Ricker { .. } => Vec::new(),
            Self::Step { start, end, .. } => vec![*start, end.unwrap_or(*start)],
            Self::Ramp { start, rise, .. } => vec![*start, start + rise],
            Self::Sine(h) | Self::Cosine(h) => vec![h.start, h.end()],
            Self::HalfSine { duration, start, .. } => vec![*start, start + duration],
            Self::Table(table) => vec![table.start(), table.end()],
            Self::Custom(custom) => custom.waveform.breaks(),
        };
        times.retain(|t| t.is_finite());
        times.sort_by(f64::total_cmp);
        times.dedup();
        times
    }

    /// Where straight lines need short steps to follow the function, and how short; none where any step will do
    /// that ends at the breaks and the corners.
    ///
    /// Between the ends of a step a load runs straight. A step h misses h²/8 · |y″| of a curved function then; this
    /// bounds it to 2 % of the peak: sixteen steps in a period of a sine, eight in a half sine, nearly twenty in 1/f
    /// of a Ricker pulse, whose crest is bent as a sine of 1.22 f.
    #[must_use]
    pub fn stretch(&self) -> Option<Stretch> {
        // √(|y″|/peak), rad/s.
        let (from, to, bend) = match self {
            Self::Sine(h) | Self::Cosine(h) => (h.start, h.end(), TAU * h.frequency),
            Self::HalfSine { duration, start, .. } => (*start, start + duration, PI / duration),
            Self::Ricker { frequency, center, .. } => {
                let reach = RICKER_REACH / (PI * frequency);
                (center - reach, center + reach, 6.0_f64.sqrt() * PI * frequency)
            }
            Self::Table(table) => (table.start(), table.end(), table.bend()),
            Self::Custom(custom) => {
                return custom.waveform.stretch().filter(|_| self.peak() > 0.0);
            }
            Self::Constant(_) | Self::Step { .. } | Self::Ramp { .. } => return None,
        };
        let step = TAU / (STEPS_OF_A_PERIOD * bend);
        (step.is_finite() && self.peak() > 0.0).then_some(Stretch { from, to, step })
    }

    /// Largest |value| over all times.
    #[must_use]
    pub fn peak(&self) -> f64 {
        match self {
            Self::Constant(amplitude)
            | Self::Step { amplitude, .. }
            | Self::Ramp { amplitude, .. }
            | Self::HalfSine { amplitude, .. }
            | Self::Ricker { amplitude, .. } => amplitude.abs(),
            Self::Sine(h) => h.peak(0.0),
            Self::Cosine(h) => h.peak(PI / 2.0),
            Self::Table(table) => table.peak(),
            Self::Custom(custom) => custom.peak_until(f64::INFINITY),
        }
    }

    /// Largest |value| from 0 up to a time (s).
    #[must_use]
    pub fn peak_until(&self, end: f64) -> f64 {
        let at = |t: f64| self.value(t.min(end), Side::Before).abs();
        match self {
            Self::Constant(_) => self.peak(),
            Self::Step { start, .. } | Self::HalfSine { start, .. } if *start >= end => 0.0,
            Self::Step { .. } => self.peak(),
            Self::Ramp { start, rise, .. } => at(start + rise),
            Self::HalfSine { start, duration, .. } => at(start + 0.5 * duration),
            Self::Sine(h) => h.until(end).peak(0.0),
            Self::Cosine(h) => h.until(end).peak(PI / 2.0),
            Self::Ricker { frequency, center, .. } => {
                // Crest and troughs, at x² = 3/2.
                let away = 1.5_f64.sqrt() / (PI * frequency);
                let turns = [center - away, *center, center + away];
                turns.iter().fold(at(0.0).max(at(end)), |most, t| most.max(at(t.max(0.0))))
            }
            Self::Table(table) => table.peak_until(end),
            Self::Custom(custom) => custom.peak_until(end),
        }
    }

    /// The function times a factor.
    #[must_use]
    pub fn scaled(&self, factor: f64) -> Self {
        let mut scaled = self.clone();
        match &mut scaled {
            Self::Constant(amplitude)
            | Self::Step { amplitude, .. }
            | Self::Ramp { amplitude, .. }
            | Self::Sine(Harmonic { amplitude, .. })
            | Self::Cosine(Harmonic { amplitude, .. })
            | Self::HalfSine { amplitude, .. }
            | Self::Ricker { amplitude, .. } => *amplitude *= factor,
            Self::Table(table) => *table = Arc::new(table.scaled(factor)),
            Self::Custom(custom) => custom.amplitude *= factor,
        }
        scaled
    }

    /// The table that this function reads, if it does.
    #[must_use]
    pub fn table(&self) -> Option<&Table> {
        match self {
            Self::Table(table) => Some(table),
            _ => None,
        }
    }

    /// Value and first two derivatives.
    fn all(&self, t: f64, side: Side) -> [f64; 3] {
        match *self {
            Self::Constant(c) => [c, 0.0, 0.0],
            Self::Step { amplitude, start, end } => {
                let on = side.is_past(t, start) && !end.is_some_and(|e| side.is_past(t, e));
                [if on { amplitude } else { 0.0 }, 0.0, 0.0]
            }
            Self::Ramp { amplitude, start, rise } => {
                if !side.is_past(t, start) {
                    [0.0; 3]
                } else if side.is_past(t, start + rise) {
                    [amplitude, 0.0, 0.0]
                } else {
                    [amplitude * (t - start) / rise, amplitude / rise, 0.0]
                }
            }
            Self::Sine(h) => h.at(t, side, 0.0),
            Self::Cosine(h) => h.at(t, side, PI / 2.0),
            Self::HalfSine { amplitude, duration, start } => {
                if !side.is_past(t, start) || side.is_past(t, start + duration) {
                    return [0.0; 3];
                }
                let w = PI / duration;
                let (sin, cos) = (w * (t - start)).sin_cos();
                [amplitude * sin, amplitude * w * cos, -amplitude * w * w * sin]
            }
            Self::Ricker { amplitude, frequency, center } => {
                // With x = π f (t − center): y = (1 − 2x²) e^(−x²).
                let w = PI * frequency;
                let x = w * (t - center);
                let e = amplitude * (-x * x).exp();
                let first = (4.0 * x * x - 6.0) * x;
                let second = (-8.0 * x * x + 24.0) * x * x - 6.0;
                [(1.0 - 2.0 * x * x) * e, w * first * e, w * w * second * e]
            }
            Self::Table(ref table) => table.at(t, side),
            Self::Custom(ref custom) => custom.at(t, side),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn pulse() -> Harmonic {
        Harmonic { amplitude: 3.0, frequency: 2.0, cycles: Some(1.5), start: 0.25, phase: 0.3 }
    }

    fn analytic() -> Vec<TimeFunction> {
        vec![
            TimeFunction::Ramp { amplitude: 2.0, start: 0.1, rise: 0.7 },
            TimeFunction::Sine(pulse()),
            TimeFunction::Cosine(pulse()),
            TimeFunction::HalfSine { amplitude: 2.0, duration: 0.8, start: 0.1 },
            TimeFunction::Ricker { amplitude: 1.5, frequency: 1.2, center: 0.5 },
            TimeFunction::Sine(pulse()).scaled(-2.0),
        ]
    }

    #[test]
    fn derivatives_agree_with_difference_quotients() {
        let (t, h) = (0.4321, 1e-5);
        for f in analytic() {
            let y = |t| f.value(t, Side::Before);
            let (first, second) = f.derivatives(t, Side::Before);
            assert!((first - (y(t + h) - y(t - h)) / (2.0 * h)).abs() < 1e-5, "{f:?}");
            let quotient = (y(t + h) - 2.0 * y(t) + y(t - h)) / (h * h);
            assert!((second - quotient).abs() < 2e-2, "{f:?}: {second} {quotient}");
        }
    }

    #[test]
    fn a_pulse_jumps_between_its_sides_and_is_zero_outside() {
        let f = TimeFunction::Cosine(Harmonic { phase: 0.0, ..pulse() });
        assert_eq!(f.breaks(), [0.25, 1.0]);
        assert_eq!(f.value(0.25, Side::Before), 0.0);
        assert_eq!(f.value(0.25, Side::After), 3.0);
        assert!((f.value(1.0, Side::Before) + 3.0).abs() < 1e-12);
        assert_eq!(f.value(1.0, Side::After), 0.0);
    }

    #[test]
    fn straight_lines_over_the_longest_step_miss_two_per_cent() {
        let short = TimeFunction::Sine(Harmonic { cycles: None, phase: 0.0, ..pulse() });
        for f in analytic().into_iter().chain([short]) {
            let Some(Stretch { from, to, step }) = f.stretch() else {
                assert!(matches!(f, TimeFunction::Ramp { .. }));
                continue;
            };
            let mut worst: f64 = 0.0;
            let mut t = from;
            while t + step <= to.min(5.0) {
                // Not where a pulse may jump in.
                for i in 1..=16 {
                    let share = f64::from(i) / 16.0;
                    let (a, b) = (f.value(t, Side::After), f.value(t + step, Side::Before));
                    let line = a + share * (b - a);
                    worst = worst.max((line - f.value(t + share * step, Side::Before)).abs());
                }
                t += 0.01 * step;
            }
            let share = worst / f.peak();
            assert!(share > 0.018 && share < 0.02, "{f:?}: {share}");
            // Outside there is nothing that steps could miss.
            assert!(f.value(from - 1e-9, Side::Before).abs() < 5e-6 * f.peak(), "{f:?}");
        }
        assert_eq!(TimeFunction::Sine(pulse()).scaled(0.0).stretch(), None);
    }

    #[test]
    fn the_peak_is_the_largest_value_met() {
        let short = Harmonic { cycles: Some(0.1), phase: 0.0, ..pulse() };
        for f in analytic().into_iter().chain([TimeFunction::Sine(short)]) {
            let met = (0..=20_000).map(|i| f.value(f64::from(i) * 1e-4, Side::Before).abs());
            let met = met.fold(0.0, f64::max);
            assert!((f.peak() - met).abs() < 1e-5 * met, "{f:?}: {} {met}", f.peak());
        }
    }

    #[test]
    fn the_peak_up_to_a_time_is_the_largest_value_met_by_then() {
        let short = Harmonic { cycles: Some(0.1), phase: 0.0, ..pulse() };
        for f in analytic().into_iter().chain([TimeFunction::Sine(short)]) {
            for end in [0.05, 0.21, 0.4, 0.77, 1.3, 2.0] {
                let met = (0..=20_000).map(|i| f.value(f64::from(i) * 5e-5 * end, Side::Before));
                let met = met.fold(0.0, |a: f64, x| a.max(x.abs()));
                let peak = f.peak_until(end);
                // Samples miss the start of what jumps.
                assert!((peak - met).abs() <= 1e-3 * f.peak(), "{f:?} {end}: {peak} {met}");
            }
        }
    }
}
