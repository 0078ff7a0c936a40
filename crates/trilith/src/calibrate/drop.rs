//! A flat drop.

use super::body::Pose;
use super::root::falling_root;
use super::{CalibrationError, Calibrator, check_restitution};
use crate::Error;

/// What came out of a flat drop.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Drop {
    /// Height of the fall, m: the smallest gap at the start.
    pub height: f64,
    /// Height of the first rebound, m.
    pub rebound: f64,
}

impl Drop {
    /// Speed after over speed before the impact: √(rebound / height).
    #[must_use]
    pub fn restitution(&self) -> f64 {
        (self.rebound / self.height).sqrt()
    }
}

impl Calibrator {
    /// Drops the body flat from a height (m) and measures its first rebound.
    ///
    /// # Errors
    /// [`CalibrationError`] for a height that is not positive or a body without flat drop, and where
    /// the run fails.
    pub fn drop(&mut self, height: f64) -> Result<Drop, Error> {
        if !(height > 0.0 && height.is_finite()) {
            return Err(CalibrationError::Range { what: "height", value: height }.into());
        }
        if !self.body.flat {
            return Err(CalibrationError::NoFlatDrop.into());
        }
        // The lowest foot starts `height` above its contact.
        let lowest = self.body.feet.iter().map(|f| f.opening).fold(f64::INFINITY, f64::min);
        let fall = (2.0 * height / self.body.gravity).sqrt();
        // A rebound with e = 1 is over after three times the fall; its top comes after two.
        let pose = Pose { lift: height - lowest, ..Pose::default() };
        let gaps = self.release(pose, 2.5 * fall)?;
        let smallest = |g: &[f64]| g.iter().copied().fold(f64::INFINITY, f64::min);
        let mut struck = false;
        let mut open = false;
        let mut rebound: f64 = 0.0;
        for (_, g) in &gaps.seen {
            let gap = smallest(g);
            struck |= gap <= 0.0;
            open |= struck && gap > 0.0;
            // The second impact ends the first rebound.
            if open && gap <= 0.0 {
                break;
            }
            if struck {
                rebound = rebound.max(gap);
            }
        }
        Ok(Drop { height, rebound })
    }

    /// Finds and sets the dashpots with which a drop from a height (m) has a restitution, weight
    /// included, and returns them (N·s/m) with the drop.
    ///
    /// # Errors
    /// As [`drop`](Self::drop), and [`CalibrationError::Unreachable`].
    pub fn tune_drop(&mut self, e: f64, height: f64) -> Result<(Vec<f64>, Drop), Error> {
        check_restitution(e)?;
        self.set_restitution(1.0)?;
        let without = self.drop(height)?.restitution();
        if without < e {
            let what = "a restitution of";
            return Err(CalibrationError::Unreachable { what, wanted: e, without }.into());
        }
        // The nominal restitution without weight is a little above what is wanted.
        let nominal = falling_root(0.0, 1.0 - e, |loss| {
            self.set_restitution((1.0 - loss).max(1e-6))?;
            Ok::<_, Error>(self.drop(height)?.restitution() - e)
        })?;
        let dashpots = self.set_restitution((1.0 - nominal).max(1e-6))?;
        Ok((dashpots, self.drop(height)?))
    }
}
