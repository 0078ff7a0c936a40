//! Stick and slip: an elastic stretch that is returned radially onto the circle of the friction limit.
//!
//! ```text
//!   τ = kₑ ξ                 kₑ |ξ| ≤ L   (sticks)
//!   τ = L ξ / |ξ|            otherwise    (slips)
//! ```

use nalgebra::{Matrix2, Vector2};

/// Friction force of an elastic stretch, and its derivatives.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Friction {
    pub(crate) slips: bool,
    pub(crate) tau: Vector2<f64>,
    /// By the stretch ξ.
    pub(crate) by_stretch: Matrix2<f64>,
    /// By the limit L; zero while it sticks.
    pub(crate) by_limit: Vector2<f64>,
}

/// Returns the elastic force kₑ ξ onto the circle of radius `limit`.
#[inline]
pub(crate) fn radial_return(ke: f64, stretch: Vector2<f64>, limit: f64) -> Friction {
    let length = stretch.norm();
    if ke * length <= limit && limit > 0.0 {
        return Friction {
            slips: false,
            tau: stretch * ke,
            by_stretch: Matrix2::identity() * ke,
            by_limit: Vector2::zeros(),
        };
    }
    if length == 0.0 {
        let (tau, by_limit) = (Vector2::zeros(), Vector2::zeros());
        return Friction { slips: true, tau, by_stretch: Matrix2::zeros(), by_limit };
    }
    let inverse = length.recip();
    let along = stretch * inverse;
    let across = Matrix2::identity() - along * along.transpose();
    Friction {
        slips: true,
        tau: along * limit,
        by_stretch: across * (limit * inverse),
        by_limit: along,
    }
}

/// Share of a step before a gap closes that is linear in the step, and its derivative by the gap at the
/// end: `before` > 0 ≥ `after`.
pub(crate) fn share_before(before: f64, after: f64) -> (f64, f64) {
    let share = before / (before - after);
    (share, share / (before - after))
}
