//! Functions of time with two derivatives, and where they bend.

use super::spec::Function;
use std::f64::consts::{PI, TAU};

impl Function {
    /// Value and first two derivatives at t; `after`: where it jumps, the value after the jump.
    #[must_use]
    pub fn at(&self, t: f64, after: bool) -> [f64; 3] {
        let past = |x: f64| {
            let near = 1e-12 * x.abs().max(1e-9);
            if after { t >= x - near } else { t > x + near }
        };
        match *self {
            Self::Step(a, start) => [if past(start) { a } else { 0.0 }, 0.0, 0.0],
            Self::Ramp(a, start, rise) => {
                if !past(start) {
                    [0.0; 3]
                } else if past(start + rise) {
                    [a, 0.0, 0.0]
                } else {
                    [a * (t - start) / rise, a / rise, 0.0]
                }
            }
            Self::Sine(a, f, cycles) => {
                if !past(0.0) || past(cycles / f) {
                    return [0.0; 3];
                }
                let w = TAU * f;
                let (s, c) = (w * t).sin_cos();
                [a * s, a * w * c, -a * w * w * s]
            }
            Self::HalfSine(a, start, length) => {
                if !past(start) || past(start + length) {
                    return [0.0; 3];
                }
                let w = PI / length;
                let (s, c) = (w * (t - start)).sin_cos();
                [a * s, a * w * c, -a * w * w * s]
            }
            Self::Ricker(a, f, centre) => {
                // (1 − 2x²) e^(−x²) and its derivatives by x = π f (t − centre).
                let w = PI * f;
                let x = w * (t - centre);
                let e = a * (-x * x).exp();
                [
                    e * (1.0 - 2.0 * x * x),
                    e * w * x * (4.0 * x * x - 6.0),
                    e * w * w * (-6.0 + 24.0 * x * x - 8.0 * x.powi(4)),
                ]
            }
            Self::Points(ref points) => {
                let (first, last) = (points[0].0, points[points.len() - 1].0);
                if !past(first) || past(last) {
                    return [0.0; 3];
                }
                let i = points.partition_point(|p| past(p.0)).clamp(1, points.len() - 1);
                let ((ta, a), (tb, b)) = (points[i - 1], points[i]);
                let slope = (b - a) / (tb - ta);
                [a + slope * (t - ta), slope, 0.0]
            }
        }
    }

    /// The same with jumps that take this long, s; a sine that stops within a half wave jumps all the same.
    #[must_use]
    pub fn without_jumps(&self, rise: f64) -> Self {
        match self {
            _ if rise == 0.0 => self.clone(),
            Self::Step(a, start) => Self::Ramp(*a, *start, rise),
            Self::Points(points) => {
                let mut points = points.clone();
                if points[0].1 != 0.0 {
                    let first = points[0].0;
                    points[0].0 += rise;
                    points.insert(0, (first, 0.0));
                }
                let last = points[points.len() - 1];
                if last.1 != 0.0 {
                    points.push((last.0 + rise, 0.0));
                }
                Self::Points(points)
            }
            _ => self.clone(),
        }
    }

    /// Shortest period that it has in any strength, s.
    #[must_use]
    pub fn period(&self) -> f64 {
        match self {
            Self::Sine(_, f, _) => f.recip(),
            Self::HalfSine(_, _, length) => 2.0 * length,
            Self::Ricker(_, f, _) => 0.4 / f,
            Self::Step(..) | Self::Ramp(..) | Self::Points(_) => f64::INFINITY,
        }
    }

    /// Times at which the value or the slope jumps.
    #[must_use]
    pub fn breaks(&self) -> Vec<f64> {
        match self {
            Self::Step(_, start) => vec![*start],
            Self::Ramp(_, start, rise) => vec![*start, start + rise],
            Self::Sine(_, f, cycles) => vec![cycles / f],
            Self::HalfSine(_, start, length) => vec![*start, start + length],
            Self::Ricker(..) => Vec::new(),
            Self::Points(points) => points.iter().map(|p| p.0).collect(),
        }
    }
}
