//! The pivot rule.
//!
//! ```text
//!   Kᵤ = (f + α f_y)/(d + α f_y/K₀)    right of the line f = K₀ d: towards its point at −α f_y
//!   Kᵤ = K₀                            left of it (reloading that has not come as far)
//!   corner of the way out: f = β* f_y on the line f = K₀ d
//!   β* = β f(reach)/max f              less pinching force once the curve has begun to fall
//! ```
//!
//! f_y is the force at the first corner of the curve.

use super::MultilinearPlastic;
use super::branch::Branch;
use super::reloading::Rule;
use trilith_element::ParameterError;

/// α and β of the two sides.
pub(super) struct Pivot {
    up: (f64, f64),
    down: (f64, f64),
}

impl Pivot {
    pub(super) fn of(law: &MultilinearPlastic) -> Self {
        let up = (law.alpha1.unwrap_or(10.0), law.beta1.unwrap_or(0.7));
        Self { up, down: (law.alpha2.unwrap_or(up.0), law.beta2.unwrap_or(up.1)) }
    }

    fn of_side(&self, side: Branch<'_>) -> (f64, f64) {
        if side.sign > 0.0 { self.up } else { self.down }
    }

    /// No line may be steeper than unloading where it begins, nor lie above the first.
    pub(super) fn check(&self, side: Branch<'_>) -> Result<(), ParameterError> {
        side.no_steeper_than_at_first()?;
        let steeper = |i: &usize| {
            let (d, f) = side.point(*i);
            side.slope(*i) > self.elastic(side, d, f) * (1.0 + 1e-9)
        };
        match (1..side.lines()).find(steeper) {
            Some(i) => Err(side.too_steep(i, "unloading there; a larger α makes that steeper")),
            None => Ok(()),
        }
    }
}

impl Rule for Pivot {
    fn elastic(&self, side: Branch<'_>, x: f64, f: f64) -> f64 {
        let (k0, anchor) = (side.slope(0), self.of_side(side).0 * side.point(1).1);
        if f > k0 * x { k0 } else { (f + anchor) / (x + anchor / k0) }
    }

    fn corner(&self, side: Branch<'_>, reach: f64) -> Option<(f64, f64)> {
        let at_points = (1..=side.lines()).map(|i| side.point(i));
        let passed = at_points.filter(|p| p.0 <= reach).map(|p| p.1);
        let now = side.at(reach).0;
        let largest = passed.fold(now, f64::max);
        let force = self.of_side(side).1 * side.point(1).1 * now / largest;
        Some((force / side.slope(0), force))
    }
}
