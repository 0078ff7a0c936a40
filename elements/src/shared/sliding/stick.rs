//! Stick and slip: an elastic stretch that is returned radially onto the circle of the friction limit.
//!
//! ```text
//!   τ = kₑ ξ                 kₑ |ξ| ≤ L   (sticks)
//!   τ = L ξ / |ξ|            otherwise    (slips)
//! ```

use crate::shared::plane::{self, M2, V2};
use trilith_element::lanes::Real;

/// Friction force of an elastic stretch, and its derivatives.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Friction<R: Real = f64> {
    pub(crate) slips: R::Mask,
    pub(crate) tau: V2<R>,
    /// By the stretch ξ.
    pub(crate) by_stretch: M2<R>,
    /// By the limit L; zero while it sticks.
    pub(crate) by_limit: V2<R>,
}

/// Returns the elastic force kₑ ξ onto the circle of radius `limit`.
#[inline(always)]
pub(crate) fn radial_return<R: Real>(ke: R, stretch: V2<R>, limit: R) -> Friction<R> {
    let (zero, one) = (ke.of(0.0), ke.of(1.0));
    let length = plane::norm(stretch);
    let sticks = (ke * length).le(limit) & zero.lt(limit);
    let slips = !sticks;
    let somewhere = slips & !length.le(zero);
    let inverse = one / length;
    let along = plane::only(plane::scaled(stretch, inverse), somewhere);
    let across = plane::less(&plane::diagonal(one), &plane::outer(along, along));
    let turn = (limit * inverse).only(somewhere);
    let stiff = plane::diagonal(ke);
    Friction {
        slips,
        tau: plane::select(sticks, plane::scaled(stretch, ke), plane::scaled(along, limit)),
        by_stretch: plane::select_matrix(sticks, &stiff, &plane::of(&across, turn)),
        by_limit: along,
    }
}

/// Share of a step before a gap closes that is linear in the step, and its derivative by the gap at the
/// end: `before` > 0 ≥ `after`.
#[inline(always)]
pub(crate) fn share_before<R: Real>(before: R, after: R) -> (R, R) {
    let share = before / (before - after);
    (share, share / (before - after))
}
