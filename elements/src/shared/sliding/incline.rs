//! Friction along a slope: it lies in the surface, and the force normal to the surface makes it.
//!
//! ```text
//!   s = √(1 + |∇h|²) = 1/cos θ            of the slope ∇h at u
//!   S = I + ∇h ∇hᵀ/(1 + s)                horizontal motion to motion along the surface: |S u̇|² = u̇² + (∇h·u̇)²
//!   τ = kₛ e,  ė = S u̇ − slip,  |τ| ≤ L(P)     friction, stretch and slip along the surface
//!   P = s V + ∇h·τ                        force normal to the surface under the vertical load V
//!   f = S τ                               what a horizontal motion feels of the friction
//! ```
//!
//! τ has the directions of U2 and U3, turned into the surface by the shortest way. That P holds is
//! the equilibrium of the slider: V = P cos θ − τ sin θ where it moves up the slope. P grows with V and has one value
//! as long as the slope and the friction do not lock, |∇h| dL/dP < 1.

use super::Dish;
use super::bearing::Rubs;
use nalgebra::{Matrix2, Matrix2x3, Vector2, Vector3};

/// Relative error of P that is rounding.
const ROUNDING: f64 = 1e-14;

/// The surface at one place.
#[derive(Clone, Copy, Debug)]
pub(super) struct Incline {
    /// ∇h.
    slope: Vector2<f64>,
    curvature: Matrix2<f64>,
    /// s.
    steep: f64,
}

impl Incline {
    pub(super) fn at(dish: &Dish, u: Vector2<f64>) -> Self {
        let (slope, curvature) = dish.lean(u);
        Self { slope, curvature, steep: (1.0 + slope.norm_squared()).sqrt() }
    }

    /// P under a vertical load, with this friction.
    pub(super) fn normal(&self, load: f64, tau: Vector2<f64>) -> f64 {
        self.steep * load + self.slope.dot(&tau)
    }

    /// S w.
    pub(super) fn along(&self, w: Vector2<f64>) -> Vector2<f64> {
        w + self.slope * (self.slope.dot(&w) / (1.0 + self.steep))
    }

    /// S.
    fn matrix(&self) -> Matrix2<f64> {
        Matrix2::<f64>::identity() + self.slope * self.slope.transpose() / (1.0 + self.steep)
    }

    /// Derivative of S w by the place, for a constant w.
    fn along_by_place(&self, w: Vector2<f64>) -> Matrix2<f64> {
        let (slope, one) = (self.slope, 1.0 + self.steep);
        let part = slope.dot(&w) / one;
        let by_slope = Matrix2::<f64>::identity() * part + slope * w.transpose() / one
            - slope * slope.transpose() * (part / (self.steep * one));
        by_slope * self.curvature
    }

    /// The friction under a vertical load, from that under a normal force.
    pub(super) fn press(&self, load: f64, friction: impl Fn(f64) -> Rubs) -> Rubs {
        let mut p = self.steep * load;
        let mut it = friction(p);
        let (mut low, mut high) = (0.0, f64::INFINITY);
        // Newton's method needs two or three; halves of a bracket take the rest of what kinks may cost.
        for _ in 0..100 {
            let error = p - self.normal(load, it.tau);
            if error.abs() <= ROUNDING * (p + self.steep * load) {
                break;
            }
            if error > 0.0 {
                high = p;
            } else {
                low = p;
            }
            let newton = p - error / (1.0 - self.slope.dot(&it.by_normal));
            p = if newton > low && newton < high {
                newton
            } else if high.is_finite() {
                0.5 * (low + high)
            } else {
                2.0 * p
            };
            it = friction(p);
        }
        it
    }
}

/// The horizontal coordinates of three.
fn plane(m: &Matrix2<f64>) -> Matrix2x3<f64> {
    Matrix2x3::new(0.0, m.m11, m.m12, 0.0, m.m21, m.m22)
}

/// A step along the surface.
#[derive(Clone, Copy, Debug)]
pub(super) struct Climb {
    /// Where it ends.
    pub(super) end: Incline,
    /// Motion along the surface, by the mean of S, and its derivative by the place of the end.
    pub(super) way: Vector2<f64>,
    pub(super) way_by_place: Matrix2<f64>,
    /// Speed along the surface at the end.
    pub(super) speed: Vector2<f64>,
    speed_by_place: Matrix2<f64>,
}

impl Climb {
    pub(super) fn new(
        dish: &Dish,
        from: Vector2<f64>,
        to: Vector2<f64>,
        speed: Vector2<f64>,
    ) -> Self {
        let (start, end) = (Incline::at(dish, from), Incline::at(dish, to));
        let moved = to - from;
        Self {
            end,
            way: (start.along(moved) + end.along(moved)) * 0.5,
            way_by_place: (start.matrix() + end.matrix() + end.along_by_place(moved)) * 0.5,
            speed: end.along(speed),
            speed_by_place: end.along_by_place(speed),
        }
    }

    /// Derivatives of the horizontal force S τ by deformations and by rates, from those of the stretch and of the
    /// vertical load.
    pub(super) fn tangents(
        &self,
        it: &Rubs,
        stretch_by_d: &Matrix2x3<f64>,
        load: f64,
        load_by_d: &Vector3<f64>,
        load_by_v: &Vector3<f64>,
    ) -> (Matrix2x3<f64>, Matrix2x3<f64>) {
        let Incline { slope, curvature, steep } = self.end;
        let turned = self.end.matrix();
        // What τ does while P stays.
        let by_d = it.by_stretch * stretch_by_d
            + it.by_way * plane(&self.way_by_place)
            + it.by_speed * plane(&self.speed_by_place);
        let by_v = it.by_speed * plane(&turned);
        // P follows V, the slope and τ.
        let share = 1.0 / (1.0 - slope.dot(&it.by_normal));
        let bend = curvature * (slope * (load / steep) + it.tau);
        let normal_by_d =
            load_by_d * steep + Vector3::new(0.0, bend.x, bend.y) + by_d.transpose() * slope;
        let normal_by_v = load_by_v * steep + by_v.transpose() * slope;
        let rows = turned * (by_d + it.by_normal * (normal_by_d * share).transpose())
            + plane(&self.end.along_by_place(it.tau));
        let rates = turned * (by_v + it.by_normal * (normal_by_v * share).transpose());
        (rows, rates)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use approx::assert_relative_eq;

    const DISH: Dish = Dish { radius: 2.0, spherical: true };
    const PLACE: Vector2<f64> = Vector2::new(0.5, -0.3);

    #[test]
    fn lengths_are_those_along_the_surface() {
        let it = Incline::at(&DISH, PLACE);
        let w = Vector2::new(0.2, 0.7);
        let climbed = DISH.height(PLACE).slope.dot(&w);
        let length = (w.norm_squared() + climbed * climbed).sqrt();
        assert_relative_eq!(it.along(w).norm(), length, max_relative = 1e-14);
        assert!((it.matrix() * w - it.along(w)).norm() < 1e-15);
    }

    #[test]
    fn its_derivative_is_that_of_the_surface() {
        let w = Vector2::new(0.2, 0.7);
        let by_place = Incline::at(&DISH, PLACE).along_by_place(w);
        let h = 1e-6;
        for (j, by) in [Vector2::x(), Vector2::y()].into_iter().enumerate() {
            let to = |sign: f64| Incline::at(&DISH, PLACE + by * (sign * h)).along(w);
            let quotient = (to(1.0) - to(-1.0)) / (2.0 * h);
            assert!((by_place * by - quotient).norm() < 1e-9, "{j}: {by_place} {quotient}");
        }
    }
}
