//! Surfaces in series: every surface carries the same force, the displacements add up.
//!
//! ```text
//!   F = gᵢ(wᵢ),  Σ wᵢ = d        gᵢ(w) = cᵢ w + kₛ (w − aᵢ) returned onto Lᵢ + stopᵢ(w)
//!   Lᵢ = μᵢ(v) N,  v = p q                 p: slip of the step, along the stretch; q = 1/Δt, times the tilt
//! ```
//!
//! For a given friction every gᵢ is the gradient of a strictly convex function, so the displacements are
//! the only minimum of the sum; friction that grows with speed only makes it steeper. Newton's method
//! with a search along each step, which always goes down, finds it.

use crate::shared::plane::M2;
use crate::shared::sliding::{Coefficient, Limit, Slide, Stop, Trial, radial_return};
use nalgebra::{Matrix2, Vector2};

/// Number of surfaces.
pub(super) const SURFACES: usize = 4;

/// One surface for the length of a solution.
#[derive(Clone, Copy, Debug)]
pub(super) struct Surface {
    /// Restoring stiffness N/R, N/m.
    pub(super) restoring: f64,
    /// Stiffness before slip, N/m.
    pub(super) ks: f64,
    pub(super) friction: Coefficient,
    /// Normal force N, N.
    pub(super) normal: f64,
    pub(super) speed: Speed,
    pub(super) stop: Option<Stop>,
    pub(super) anchor: Vector2<f64>,
}

/// Where the sliding speed comes from.
#[derive(Clone, Copy, Debug)]
pub(super) enum Speed {
    /// Known, m/s.
    Known(f64),
    /// The slip of the step times this, 1/s.
    PerSlip(f64),
}

/// What a surface does at a stretch x = w − a.
#[derive(Clone, Copy, Debug)]
pub(super) struct State {
    pub(super) stretch: Vector2<f64>,
    pub(super) displacement: Vector2<f64>,
    pub(super) force: Vector2<f64>,
    pub(super) stiffness: Matrix2<f64>,
    pub(super) tau: Vector2<f64>,
    /// Direction of the friction force by its limit; zero while it sticks.
    pub(super) along: Vector2<f64>,
    pub(super) slips: bool,
    pub(super) limit: Limit,
    pub(super) speed: f64,
    /// Stiffness by the displacement at a given stretch, and energy of the stop.
    pub(super) unrubbed: Matrix2<f64>,
    pub(super) stop_energy: f64,
}

/// Friction force of a stretch, and its derivatives by the stretch and by the limit.
struct Friction {
    slips: bool,
    tau: Vector2<f64>,
    by_stretch: Matrix2<f64>,
    by_limit: Vector2<f64>,
}

impl Friction {
    fn of(ks: f64, stretch: Vector2<f64>, limit: f64) -> Self {
        let it = radial_return(ks, stretch.into(), limit);
        Self {
            slips: it.slips,
            tau: it.tau.into(),
            by_stretch: matrix(it.by_stretch),
            by_limit: it.by_limit.into(),
        }
    }
}

/// A matrix from its rows.
pub(super) fn matrix(rows: M2<f64>) -> Matrix2<f64> {
    Matrix2::from(rows).transpose()
}

impl Surface {
    /// Friction of a stretch, its limit with the derivative by the normal force, and the speed.
    fn friction(&self, stretch: Vector2<f64>) -> (Friction, Limit, f64) {
        let (speed, per_slip) = match self.speed {
            Speed::Known(speed) => (speed, 0.0),
            Speed::PerSlip(q) => (0.0, q),
        };
        if per_slip == 0.0 || self.friction.is_constant() {
            let limit = self.friction.limit(self.normal, speed);
            return (Friction::of(self.ks, stretch, limit.force), limit, speed);
        }
        let length = stretch.norm();
        let slide = Slide::of(
            &self.friction.cone(self.normal, None),
            &Trial {
                size: self.ks * length,
                stiffness: self.ks,
                spring: self.ks,
                rate: 0.0,
                per_slip,
                since: 0.0,
            },
        );
        let mut it = Friction::of(self.ks, stretch, slide.limit);
        it.slips = !slide.sticks;
        let mut limit = Limit { force: slide.limit, ..Limit::default() };
        if it.slips {
            limit.by_normal = slide.by_normal;
            it.by_stretch += it.by_limit * it.by_limit.transpose() * (slide.by_size * self.ks);
        }
        (it, limit, slide.rate)
    }

    fn at(&self, stretch: Vector2<f64>) -> State {
        let displacement = self.anchor + stretch;
        let (it, limit, speed) = self.friction(stretch);
        let mut force = displacement * self.restoring + it.tau;
        let mut unrubbed = Matrix2::identity() * self.restoring;
        let mut stop_energy = 0.0;
        if let Some(stop) = self.stop {
            let (f, k, energy) = stop.force(displacement.into());
            let (f, k) = (Vector2::from(f), matrix(k));
            force += f;
            unrubbed += k;
            stop_energy = energy;
        }
        State {
            stretch,
            displacement,
            force,
            stiffness: unrubbed + it.by_stretch,
            tau: it.tau,
            along: it.by_limit,
            slips: it.slips,
            limit,
            speed,
            unrubbed,
            stop_energy,
        }
    }
}

/// The surfaces in equilibrium.
#[derive(Clone, Copy, Debug)]
pub(super) struct Series {
    pub(super) states: [State; SURFACES],
    pub(super) force: Vector2<f64>,
    /// ∂F/∂d.
    pub(super) stiffness: Matrix2<f64>,
    pub(super) compliances: [Matrix2<f64>; SURFACES],
}

/// Steps of Newton's method at most; a handful is usual.
const MOST_STEPS: usize = 100;
/// Difference of the surfaces' forces that counts as none, of the largest.
const CLOSE: f64 = 1e-13;

/// Inverse of a matrix of positive determinant.
fn inverse(m: Matrix2<f64>) -> Matrix2<f64> {
    let determinant = m[(0, 0)] * m[(1, 1)] - m[(0, 1)] * m[(1, 0)];
    Matrix2::new(m[(1, 1)], -m[(0, 1)], -m[(1, 0)], m[(0, 0)]) / determinant
}

/// The surfaces at a total displacement, searched from stretches `start`.
pub(super) fn solve(
    surfaces: &[Surface; SURFACES],
    total: Vector2<f64>,
    start: [Vector2<f64>; SURFACES],
) -> Series {
    let sum = surfaces.iter().fold(total, |rest, s| rest - s.anchor);
    let mut now = series(surfaces, &start);
    let mut step = newton(&now, sum);
    // The first step only makes the displacements add up: there is nothing to go down from.
    now = moved(surfaces, &now, &step.by, 1.0);
    for _ in 0..MOST_STEPS {
        step = newton(&now, sum);
        let largest = now.states.iter().map(|s| s.force.norm()).fold(0.0, f64::max);
        if step.unbalanced <= CLOSE * largest {
            break;
        }
        // Nothing below within rounding: a stiff rim makes much force of the last digit.
        let Some(share) = search(surfaces, &now, &step) else { break };
        now = moved(surfaces, &now, &step.by, share);
    }
    now.force = step.force;
    now
}

struct Step {
    by: [Vector2<f64>; SURFACES],
    force: Vector2<f64>,
    unbalanced: f64,
}

fn series(surfaces: &[Surface; SURFACES], stretches: &[Vector2<f64>; SURFACES]) -> Series {
    let states = std::array::from_fn(|i| surfaces[i].at(stretches[i]));
    let compliances: [_; SURFACES] = std::array::from_fn(|i| {
        let state: &State = &states[i];
        inverse(state.stiffness)
    });
    let stiffness = inverse(compliances.iter().fold(Matrix2::zeros(), |sum, c| sum + c));
    Series { states, force: Vector2::zeros(), stiffness, compliances }
}

fn newton(at: &Series, sum: Vector2<f64>) -> Step {
    let mut rest = sum;
    for (s, c) in at.states.iter().zip(&at.compliances) {
        rest += c * s.force - s.stretch;
    }
    let force = at.stiffness * rest;
    let unbalanced = at.states.iter().map(|s| (force - s.force).norm()).fold(0.0, f64::max);
    let by = std::array::from_fn(|i| at.compliances[i] * (force - at.states[i].force));
    Step { by, force, unbalanced }
}

fn moved(
    surfaces: &[Surface; SURFACES],
    from: &Series,
    by: &[Vector2<f64>; SURFACES],
    share: f64,
) -> Series {
    series(surfaces, &std::array::from_fn(|i| from.states[i].stretch + by[i] * share))
}

/// Share of the step that goes down far enough: all of it, or about where the slope along it is zero.
/// None where the step is one of rounding.
fn search(surfaces: &[Surface; SURFACES], from: &Series, step: &Step) -> Option<f64> {
    let by = &step.by;
    let digits = |i: usize| 4.0 * f64::EPSILON * from.states[i].stretch.norm();
    if (0..SURFACES).all(|i| by[i].norm() <= digits(i)) {
        return None;
    }
    // The common force does no work on the step; without it no digits are lost.
    let slope = |share: f64| -> f64 {
        (0..SURFACES)
            .map(|i| {
                let at = surfaces[i].at(from.states[i].stretch + by[i] * share);
                (at.force - step.force).dot(&by[i])
            })
            .sum()
    };
    let start = slope(0.0);
    if start >= 0.0 {
        return None;
    }
    let enough = -0.1 * start;
    let (mut low, mut high) = ((0.0, start), (1.0, slope(1.0)));
    if high.1 <= enough {
        return Some(1.0);
    }
    // The slope grows along the step: the zero stays between the two.
    for i in 0..60 {
        let cut = low.0 + (high.0 - low.0) * low.1 / (low.1 - high.1);
        let share = if i % 2 == 0 { cut } else { 0.5 * (low.0 + high.0) };
        let at = slope(share);
        if at.abs() <= enough {
            return Some(share);
        }
        if at < 0.0 { low = (share, at) } else { high = (share, at) }
    }
    Some(low.0)
}
