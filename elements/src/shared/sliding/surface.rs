//! The surface that a slider moves on, and the rim that ends it.
//!
//! ```text
//!   shallow:    h = u²/(2R)             ∇h = u/R
//!   spherical:  h = R − √(R² − u²)      ∇h = u/√(R² − u²)
//!   stop:       f = kₛₜ (|u| − D) u/|u|   where |u| > D
//! ```

use crate::shared::plane::{self, M2, V2};
use trilith_element::lanes::Real;

/// A concave surface; flat where the radius is 0.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Dish<R: Real = f64> {
    /// Radius R, m.
    pub(crate) radius: R,
    /// Spherical instead of shallow.
    pub(crate) spherical: R::Mask,
}

/// Share of the radius at which the slope of a spherical surface goes on linearly: nothing slides up a
/// wall, and the root must stay real.
const STEEPEST: f64 = 0.95;

/// Height of a surface, its gradient and curvature.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Height<R> {
    pub(crate) h: R,
    pub(crate) slope: V2<R>,
    pub(crate) curvature: M2<R>,
}

impl<R: Real> Dish<R> {
    /// Height above the lowest point at displacement `u`.
    #[inline(always)]
    pub(crate) fn height(&self, u: V2<R>) -> Height<R> {
        let r = self.radius;
        let (zero, half, one) = (r.of(0.0), r.of(0.5), r.of(1.0));
        let curved = zero.lt(r);
        let length = plane::norm(u);
        let mut it = Height {
            h: (half * length * length / r).only(curved),
            slope: [(u[0] / r).only(curved), (u[1] / r).only(curved)],
            curvature: plane::diagonal((one / r).only(curved)),
        };
        let deep = self.spherical & curved & zero.lt(length);
        if zero.any(deep) {
            let x = length.min(r.of(STEEPEST) * r);
            let root = (r * r - x * x).sqrt();
            let rest = length - x;
            let steepening = r * r / (root * root * root);
            let s = x / root + steepening * rest;
            let along = [u[0] / length, u[1] / length];
            let radial = plane::outer(along, along);
            let across = plane::less(&plane::diagonal(one), &radial);
            // R − root without the loss of digits near the centre.
            let h = x * x / (r + root) + rest * (x / root + half * steepening * rest);
            let bent =
                plane::plus(&plane::of(&radial, steepening), &plane::of(&across, s / length));
            it.h = R::select(deep, h, it.h);
            it.slope = plane::select(deep, plane::scaled(along, s), it.slope);
            it.curvature = plane::select_matrix(deep, &bent, &it.curvature);
        }
        it
    }

    /// Gradient and curvature by which the normal leans; farther out than at [`steepest`](Dish::steepest) it leans no
    /// more.
    #[inline(always)]
    pub(crate) fn lean(&self, u: V2<R>) -> (V2<R>, M2<R>) {
        let height = self.height(u);
        let one = self.radius.of(1.0);
        let (slope, most) = (plane::norm(height.slope), one.of(Dish::steepest()));
        let beyond = most.lt(slope);
        let along = [height.slope[0] / slope, height.slope[1] / slope];
        let across = plane::less(&plane::diagonal(one), &plane::outer(along, along));
        let turned = plane::of(&across, most / plane::norm(u));
        (
            plane::select(beyond, plane::scaled(along, most), height.slope),
            plane::select_matrix(beyond, &turned, &height.curvature),
        )
    }
}

impl Dish {
    /// The largest slope of a normal to the surface, that of a sphere at 0.95 R.
    pub(crate) fn steepest() -> f64 {
        STEEPEST / (1.0 - STEEPEST * STEEPEST).sqrt()
    }
}

/// An elastic rim.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Stop<R = f64> {
    /// Displacement D at which it is met, m.
    pub(crate) at: R,
    /// Stiffness, N/m.
    pub(crate) stiffness: R,
}

impl<R: Real> Stop<R> {
    /// Force, stiffness and energy at displacement `u`.
    #[inline(always)]
    pub(crate) fn force(&self, u: V2<R>) -> (V2<R>, M2<R>, R) {
        let (k, length) = (self.stiffness, plane::norm(u));
        let (zero, half, one) = (k.of(0.0), k.of(0.5), k.of(1.0));
        let over = length - self.at;
        let met = zero.lt(over) & zero.lt(length);
        let along = plane::only([u[0] / length, u[1] / length], met);
        let radial = plane::outer(along, along);
        let around = plane::less(&plane::diagonal(one), &radial);
        let across = plane::of(&around, (k * over / length).only(met));
        let force = plane::scaled(along, (k * over).only(met));
        let stiffness = plane::plus(&plane::of(&radial, k), &across);
        (force, stiffness, (half * k * over * over).only(met))
    }
}
