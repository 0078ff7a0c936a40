//! One side of the curve, turned so that deformation and force are positive.

use crate::shared::multilinear::Curve;
use trilith_element::ParameterError;

/// The curve on the side of `sign`, from the origin outwards.
#[derive(Clone, Copy, Debug)]
pub(super) struct Branch<'a> {
    pub(super) curve: Curve<'a>,
    /// Index of the point (0, 0).
    pub(super) origin: usize,
    pub(super) sign: f64,
}

impl Branch<'_> {
    /// Number of lines; the last goes on.
    pub(super) fn lines(self) -> usize {
        if self.sign > 0.0 { self.curve.d.len() - 1 - self.origin } else { self.origin }
    }

    /// Point `i`, 0 being the origin.
    pub(super) fn point(self, i: usize) -> (f64, f64) {
        let at = if self.sign > 0.0 { self.origin + i } else { self.origin - i };
        (self.sign * self.curve.d[at], self.sign * self.curve.f[at])
    }

    /// Slope of line `i`, 0 being the one from the origin; beyond the last that of the last.
    pub(super) fn slope(self, i: usize) -> f64 {
        let i = i.min(self.lines() - 1);
        let ((a, f), (b, g)) = (self.point(i), self.point(i + 1));
        (g - f) / (b - a)
    }

    /// The line at `x` ≥ 0; at a point the one outwards.
    pub(super) fn line(self, x: f64) -> usize {
        (1..self.lines()).take_while(|&i| self.point(i).0 <= x).last().unwrap_or(0)
    }

    /// Force and slope at `x` ≥ 0.
    pub(super) fn at(self, x: f64) -> (f64, f64) {
        let i = self.line(x);
        let ((a, f), slope) = (self.point(i), self.slope(i));
        (f + slope * (x - a), slope)
    }

    /// ∫ f dd from 0 to `x` ≥ 0.
    pub(super) fn area(self, x: f64) -> f64 {
        self.curve.area(self.sign * x)
    }

    /// Refuses a line that is steeper than the first.
    pub(super) fn no_steeper_than_at_first(self) -> Result<(), ParameterError> {
        match (1..self.lines()).find(|&i| self.slope(i) > self.slope(0) * (1.0 + 1e-9)) {
            Some(i) => Err(self.too_steep(i, "the line at the origin, whose slope unloading has")),
            None => Ok(()),
        }
    }

    /// Refuses a line that is steeper than the one before it, for the rule of this name.
    pub(super) fn no_steeper_outwards(self, rule: &str) -> Result<(), ParameterError> {
        let steeper = |i: &usize| self.slope(*i) > self.slope(i - 1) + 1e-9 * self.slope(0);
        match (1..self.lines()).find(steeper) {
            Some(i) => {
                Err(self.too_steep(i, &format!("the one before it, which {rule} cannot have")))
            }
            None => Ok(()),
        }
    }

    /// The point before line `i`, that before the last line where there are fewer.
    pub(super) fn corner_before(self, i: usize) -> (f64, f64) {
        self.point(i.min(self.lines() - 1))
    }

    /// The outer end of line `i`, as the file gives it.
    pub(super) fn outer_end(self, i: usize) -> (f64, f64) {
        let (d, f) = self.point(i + 1);
        (self.sign * d, self.sign * f)
    }

    /// The refusal of line `i`.
    pub(super) fn too_steep(self, i: usize, than: &str) -> ParameterError {
        let (d, f) = self.point(i);
        let message = format!(
            "the line that leaves ({}, {}) outwards is steeper than {than}: make it softer, or choose another `rule`",
            self.sign * d,
            self.sign * f
        );
        ParameterError::inconsistent("force", message)
    }
}
