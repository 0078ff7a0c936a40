//! Takeda's rule, with unloading at the slope of the first line.

use super::branch::Branch;
use super::reloading::Rule;

/// Back with K₀, out again straight to the largest deformation.
pub(super) struct Takeda;

impl Rule for Takeda {
    fn elastic(&self, side: Branch<'_>, _: f64, _: f64) -> f64 {
        side.slope(0)
    }

    fn corner(&self, _: Branch<'_>, _: f64) -> Option<(f64, f64)> {
        None
    }
}
