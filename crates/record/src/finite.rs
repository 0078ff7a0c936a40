//! Bounds of a motion: how many samples it has at most, and that what follows from it is finite.

use crate::Record;
use crate::measure::{arias, cav, displacement, velocity};
use std::fmt;

/// Most samples of a motion, read or made.
pub const MOST_SAMPLES: usize = 2_000_000;

/// Shortest time step of a motion, s.
pub(crate) const SHORTEST_STEP: f64 = 1e-9;
/// Longest time step of a motion, s.
pub(crate) const LONGEST_STEP: f64 = 1e6;

/// What of a motion is beyond all numbers.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct NotFinite {
    /// The quantity, such as `velocity`.
    pub quantity: &'static str,
    /// The first sample of which it is so, from 1.
    pub sample: Option<usize>,
}

impl fmt::Display for NotFinite {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "the {} is not finite", self.quantity)?;
        match self.sample {
            Some(sample) => write!(f, ", first at sample {sample}"),
            None => Ok(()),
        }
    }
}

impl std::error::Error for NotFinite {}

/// Holds all of a history to be finite.
pub(crate) fn history(quantity: &'static str, values: &[f64]) -> Result<(), NotFinite> {
    match values.iter().position(|x| !x.is_finite()) {
        Some(i) => Err(NotFinite { quantity, sample: Some(i + 1) }),
        None => Ok(()),
    }
}

impl Record {
    /// Holds acceleration, velocity, displacement, Arias intensity and cumulative absolute velocity to be finite.
    ///
    /// # Errors
    /// [`NotFinite`] with the first of them that is not.
    pub fn check_finite(&self) -> Result<(), NotFinite> {
        let (a, dt) = (&self.acceleration, self.dt);
        history("acceleration", a)?;
        history("velocity", &velocity(a, dt))?;
        history("displacement", &displacement(a, dt))?;
        let one = |quantity, value: f64| {
            if value.is_finite() { Ok(()) } else { Err(NotFinite { quantity, sample: None }) }
        };
        one("duration", self.duration())?;
        one("Arias intensity", arias(a, dt))?;
        one("cumulative absolute velocity", cav(a, dt))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_first_quantity_that_overflows_is_named() {
        let told = |a: &[f64], dt: f64| match Record::new(a.to_vec(), dt).check_finite() {
            Ok(()) => "finite".to_owned(),
            Err(e) => e.to_string(),
        };
        assert_eq!(told(&[0.0, 1.0, -1.0], 0.01), "finite");
        let text = told(&[0.0, f64::INFINITY], 0.01);
        assert_eq!(text, "the acceleration is not finite, first at sample 2");
        let text = told(&[0.0, 1e308, 1e308], 1e3);
        assert_eq!(text, "the velocity is not finite, first at sample 2");
        let text = told(&[0.0, 1e300, 0.0], 1e5);
        assert_eq!(text, "the displacement is not finite, first at sample 2");
        assert_eq!(told(&[0.0, 1e160, 0.0], 0.01), "the Arias intensity is not finite");
    }
}
