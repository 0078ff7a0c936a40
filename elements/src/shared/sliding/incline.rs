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
use super::law::Rubs;
use crate::shared::plane::{self, M2, V2};
use trilith_element::lanes::Real;

/// Relative error of P that is rounding.
const ROUNDING: f64 = 1e-14;

/// Two rows over the three coordinates.
pub(super) type Rows<R> = [[R; 3]; 2];

/// Friction under a force normal to the surface. A closure in its place, as large as it is, would stay a call, and calls are
/// not compiled for registers.
pub(super) trait Friction<R: Real> {
    /// It must be `#[inline(always)]`.
    fn under(&self, normal: R) -> Rubs<R>;
}

/// The surface at one place.
#[derive(Clone, Copy, Debug)]
pub(super) struct Incline<R> {
    /// ∇h.
    slope: V2<R>,
    curvature: M2<R>,
    /// s.
    steep: R,
}

impl<R: Real> Incline<R> {
    /// Flat where `inclined` says no.
    #[inline(always)]
    pub(super) fn at(dish: &Dish<R>, inclined: R::Mask, u: V2<R>) -> Self {
        let (slope, curvature) = dish.lean(u);
        let slope = plane::only(slope, inclined);
        let curvature = [plane::only(curvature[0], inclined), plane::only(curvature[1], inclined)];
        let one = u[0].of(1.0);
        Self { slope, curvature, steep: (one + plane::dot(slope, slope)).sqrt() }
    }

    /// P under a vertical load, with this friction.
    #[inline(always)]
    pub(super) fn normal(&self, load: R, tau: V2<R>) -> R {
        self.steep * load + plane::dot(self.slope, tau)
    }

    /// S w.
    #[inline(always)]
    pub(super) fn along(&self, w: V2<R>) -> V2<R> {
        let part = plane::dot(self.slope, w) / (w[0].of(1.0) + self.steep);
        plane::add(w, plane::scaled(self.slope, part))
    }

    /// S.
    #[inline(always)]
    fn matrix(&self) -> M2<R> {
        let one = self.steep.of(1.0);
        let own = plane::outer(self.slope, self.slope);
        let below = one + self.steep;
        let mut m = plane::diagonal(one);
        for i in 0..2 {
            for j in 0..2 {
                m[i][j] = m[i][j] + own[i][j] / below;
            }
        }
        m
    }

    /// Derivative of S w by the place, for a constant w.
    #[inline(always)]
    fn along_by_place(&self, w: V2<R>) -> M2<R> {
        let (slope, one) = (self.slope, self.steep.of(1.0) + self.steep);
        let part = plane::dot(slope, w) / one;
        let turn = plane::outer(slope, w);
        let own = plane::of(&plane::outer(slope, slope), part / (self.steep * one));
        let mut by_slope = plane::diagonal(part);
        for i in 0..2 {
            for j in 0..2 {
                by_slope[i][j] = by_slope[i][j] + turn[i][j] / one - own[i][j];
            }
        }
        plane::product(&by_slope, &self.curvature)
    }

    /// The friction under a vertical load, from that under a normal force.
    #[inline(always)]
    pub(super) fn press(&self, load: R, friction: &impl Friction<R>) -> Rubs<R> {
        let (zero, half, one, two) = (load.of(0.0), load.of(0.5), load.of(1.0), load.of(2.0));
        let mut p = self.steep * load;
        let mut it = Rubs::none(load);
        let (mut low, mut high) = (zero, load.of(f64::INFINITY));
        let mut goes_on = zero.le(zero);
        // Newton's method needs two or three; halves of a bracket take the rest of what kinks may cost.
        for _ in 0..=100 {
            it = Rubs::select(goes_on, &friction.under(p), &it);
            let error = p - self.normal(load, it.tau);
            let rounding = load.of(ROUNDING) * (p + self.steep * load);
            goes_on = goes_on & !error.abs().le(rounding);
            if !zero.any(goes_on) {
                break;
            }
            let above = zero.lt(error);
            high = R::select(above, p, high);
            low = R::select(above, low, p);
            let newton = p - error / (one - plane::dot(self.slope, it.by_normal));
            let within = low.lt(newton) & newton.lt(high);
            let bounded = high.lt(load.of(f64::INFINITY));
            let aside = R::select(bounded, half * (low + high), two * p);
            p = R::select(goes_on, R::select(within, newton, aside), p);
        }
        it
    }
}

/// A step along the surface.
#[derive(Clone, Copy, Debug)]
pub(super) struct Climb<R> {
    /// Where it ends.
    pub(super) end: Incline<R>,
    /// Motion along the surface, by the mean of S, and its derivative by the place of the end.
    pub(super) way: V2<R>,
    pub(super) way_by_place: M2<R>,
    /// Speed along the surface at the end.
    pub(super) speed: V2<R>,
    speed_by_place: M2<R>,
}

/// `m` on two rows.
#[inline(always)]
fn on_rows<R: Real>(m: &M2<R>, rows: &Rows<R>) -> Rows<R> {
    let mut out = *rows;
    for i in 0..2 {
        for j in 0..3 {
            out[i][j] = m[i][0] * rows[0][j] + m[i][1] * rows[1][j];
        }
    }
    out
}

/// The horizontal coordinates of three get a matrix on top.
#[inline(always)]
pub(super) fn add_plane<R: Real>(rows: &mut Rows<R>, m: &M2<R>) {
    for i in 0..2 {
        for j in 0..2 {
            rows[i][1 + j] = rows[i][1 + j] + m[i][j];
        }
    }
}

impl<R: Real> Climb<R> {
    #[inline(always)]
    pub(super) fn new(
        dish: &Dish<R>,
        inclined: R::Mask,
        [from, to]: [V2<R>; 2],
        speed: V2<R>,
    ) -> Self {
        let start = Incline::at(dish, inclined, from);
        let end = Incline::at(dish, inclined, to);
        let (moved, half) = (plane::sub(to, from), to[0].of(0.5));
        let both = plane::add(start.along(moved), end.along(moved));
        let by_place = plane::plus(&start.matrix(), &end.matrix());
        let by_place = plane::plus(&by_place, &end.along_by_place(moved));
        Self {
            end,
            way: plane::scaled(both, half),
            way_by_place: plane::of(&by_place, half),
            speed: end.along(speed),
            speed_by_place: end.along_by_place(speed),
        }
    }

    /// Derivatives of the horizontal force S τ by deformations and by rates, from those of the stretch and of the
    /// vertical load.
    #[inline(always)]
    pub(super) fn tangents(
        &self,
        it: &Rubs<R>,
        stretch_by_d: &Rows<R>,
        load: R,
        load_by_d: &[R; 3],
        load_by_v: &[R; 3],
    ) -> (Rows<R>, Rows<R>) {
        let Incline { slope, curvature, steep } = self.end;
        let (zero, one) = (load.of(0.0), load.of(1.0));
        let turned = self.end.matrix();
        // What τ does while P stays.
        let mut by_d = on_rows(&it.by_stretch, stretch_by_d);
        add_plane(&mut by_d, &plane::product(&it.by_way, &self.way_by_place));
        add_plane(&mut by_d, &plane::product(&it.by_speed, &self.speed_by_place));
        let mut by_v = [[zero; 3]; 2];
        add_plane(&mut by_v, &plane::product(&it.by_speed, &turned));
        // P follows V, the slope and τ.
        let share = one / (one - plane::dot(slope, it.by_normal));
        let leant = plane::add(plane::scaled(slope, load / steep), it.tau);
        let bend = plane::times(&curvature, leant);
        for j in 0..3 {
            let bent = if j == 0 { zero } else { bend[j - 1] };
            let normal_by_d =
                load_by_d[j] * steep + bent + (by_d[0][j] * slope[0] + by_d[1][j] * slope[1]);
            let normal_by_v =
                load_by_v[j] * steep + (by_v[0][j] * slope[0] + by_v[1][j] * slope[1]);
            for i in 0..2 {
                by_d[i][j] = by_d[i][j] + it.by_normal[i] * (normal_by_d * share);
                by_v[i][j] = by_v[i][j] + it.by_normal[i] * (normal_by_v * share);
            }
        }
        let mut rows = on_rows(&turned, &by_d);
        add_plane(&mut rows, &self.end.along_by_place(it.tau));
        (rows, on_rows(&turned, &by_v))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use approx::assert_relative_eq;

    const DISH: Dish = Dish { radius: 2.0, spherical: true };
    const PLACE: V2<f64> = [0.5, -0.3];

    fn incline(u: V2<f64>) -> Incline<f64> {
        Incline::at(&DISH, true, u)
    }

    #[test]
    fn lengths_are_those_along_the_surface() {
        let it = incline(PLACE);
        let w = [0.2, 0.7];
        let climbed = plane::dot(DISH.height(PLACE).slope, w);
        let length = (plane::dot(w, w) + climbed * climbed).sqrt();
        assert_relative_eq!(plane::norm(it.along(w)), length, max_relative = 1e-14);
        let twice = plane::sub(plane::times(&it.matrix(), w), it.along(w));
        assert!(plane::norm(twice) < 1e-15);
    }

    #[test]
    fn its_derivative_is_that_of_the_surface() {
        let w = [0.2, 0.7];
        let by_place = incline(PLACE).along_by_place(w);
        let h = 1e-6;
        for (j, by) in [[1.0, 0.0], [0.0, 1.0]].into_iter().enumerate() {
            let to = |s: f64| incline(plane::add(PLACE, plane::scaled(by, s * h))).along(w);
            let quotient = plane::scaled(plane::sub(to(1.0), to(-1.0)), 0.5 / h);
            let off = plane::sub(plane::times(&by_place, by), quotient);
            assert!(plane::norm(off) < 1e-9, "{j}: {by_place:?} {quotient:?}");
        }
    }
}
