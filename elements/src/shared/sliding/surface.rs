//! The surface that a slider moves on, and the rim that ends it.
//!
//! ```text
//!   shallow:    h = u²/(2R)             ∇h = u/R
//!   spherical:  h = R − √(R² − u²)      ∇h = u/√(R² − u²)
//!   stop:       f = kₛₜ (|u| − D) u/|u|   where |u| > D
//! ```

use nalgebra::{Matrix2, Vector2};

/// A concave surface; flat where the radius is 0.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Dish {
    /// Radius R, m.
    pub(crate) radius: f64,
    /// Spherical instead of shallow.
    pub(crate) spherical: bool,
}

/// Share of the radius at which the slope of a spherical surface goes on linearly: nothing slides up a
/// wall, and the root must stay real.
const STEEPEST: f64 = 0.95;

/// Height of a surface, its gradient and curvature.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Height {
    pub(crate) h: f64,
    pub(crate) slope: Vector2<f64>,
    pub(crate) curvature: Matrix2<f64>,
}

impl Dish {
    /// Height above the lowest point at displacement `u`.
    pub(crate) fn height(&self, u: Vector2<f64>) -> Height {
        let r = self.radius;
        if r == 0.0 {
            return Height { h: 0.0, slope: Vector2::zeros(), curvature: Matrix2::zeros() };
        }
        let length = u.norm();
        if !self.spherical || length == 0.0 {
            let curvature = Matrix2::identity() / r;
            return Height { h: 0.5 * length * length / r, slope: u / r, curvature };
        }
        let x = length.min(STEEPEST * r);
        let root = (r * r - x * x).sqrt();
        let rest = length - x;
        let steepening = r * r / root.powi(3);
        let s = x / root + steepening * rest;
        let along = u / length;
        let radial = along * along.transpose();
        Height {
            // R − root without the loss of digits near the centre.
            h: x * x / (r + root) + rest * (x / root + 0.5 * steepening * rest),
            slope: along * s,
            curvature: radial * steepening + (Matrix2::identity() - radial) * (s / length),
        }
    }
}

impl Dish {
    /// The largest slope of a normal to the surface, that of a sphere at 0.95 R.
    pub(crate) fn steepest() -> f64 {
        STEEPEST / (1.0 - STEEPEST * STEEPEST).sqrt()
    }

    /// Gradient and curvature by which the normal leans; farther out than at [`steepest`](Self::steepest) it leans no
    /// more.
    pub(crate) fn lean(&self, u: Vector2<f64>) -> (Vector2<f64>, Matrix2<f64>) {
        let height = self.height(u);
        let (slope, most) = (height.slope.norm(), Self::steepest());
        if slope <= most {
            return (height.slope, height.curvature);
        }
        let along = height.slope / slope;
        let across = Matrix2::identity() - along * along.transpose();
        (along * most, across * (most / u.norm()))
    }
}

/// An elastic rim.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Stop {
    /// Displacement D at which it is met, m.
    pub(crate) at: f64,
    /// Stiffness, N/m.
    pub(crate) stiffness: f64,
}

impl Stop {
    /// Force, stiffness and energy at displacement `u`.
    pub(crate) fn force(&self, u: Vector2<f64>) -> (Vector2<f64>, Matrix2<f64>, f64) {
        let length = u.norm();
        let over = length - self.at;
        if over <= 0.0 || length == 0.0 {
            return (Vector2::zeros(), Matrix2::zeros(), 0.0);
        }
        let k = self.stiffness;
        let along = u / length;
        let radial = along * along.transpose();
        let across = (Matrix2::identity() - radial) * (k * over / length);
        (along * (k * over), radial * k + across, 0.5 * k * over * over)
    }
}
