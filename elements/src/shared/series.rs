//! A spring in series with a nonlinear dashpot over one step.
//!
//! ```text
//!   ḟ = k (ḋ(t) − w),   f = F(w),   w: rate of the dashpot,   F rises
//! ```
//!
//! Integrated by the L-stable, stiffly accurate SDIRK method of two stages and second order,
//! γ = 1 − 1/√2 \[Alexander 1977\], in a fixed number of equal parts of the step, with the rate of
//! deformation linear in the step (see [`relaxation`](super::relaxation)). Each stage is one equation
//! F(w) + a w = known with one root. The heat ∫ f w dt is a third unknown of the same method: its
//! weights are positive, so it never falls. Derivatives are those of the method itself.

use crate::shared::relaxation::{Followed, length, rates};
use std::marker::PhantomData;
use trilith_element::history;
use trilith_element::lanes::{LaneAt, LaneForce, LaneLaw, LaneStep, Real};

/// Parts of a step; fixed, so that the force is smooth in d and ḋ.
const PARTS: usize = 4;

history! {
    /// History of a spring in series with a dashpot.
    pub(crate) struct SeriesHistory {
        /// Force.
        pub(crate) force: "N",
    }
}

/// What a dashpot does where F(w) + a w is known.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Split<R> {
    /// Force F(w), N.
    pub force: R,
    /// Rate w, m/s.
    pub rate: R,
    /// Derivative of the force by the known sum.
    pub slope: R,
}

/// A law F(w) of a dashpot that rises, with F(−w) = −F(w).
pub(crate) trait Viscous: 'static {
    /// Number of parameters of the link, of which the stiffness of its spring is the first.
    const PARAMETERS: usize;
    /// As [`LaneLaw::IS_LONG`].
    const IS_LONG: bool;

    /// Force and rate where F(w) + a w = `known` > 0, `a` ≥ 0.
    fn split_positive<R: Real>(parameters: &[R], known: R, a: R) -> Split<R>;

    /// The same for any sign.
    #[inline(always)]
    fn split<R: Real>(parameters: &[R], known: R, a: R) -> Split<R> {
        let (zero, one) = (known.of(0.0), known.of(1.0));
        // Where nothing acts, only the slope of a vanishing force matters.
        let size = known.abs().max(known.of(f64::MIN_POSITIVE));
        let it = Self::split_positive(parameters, size, a);
        let sign = R::select(known.lt(zero), -one, R::select(zero.lt(known), one, known));
        Split { force: sign * it.force, rate: sign * it.rate, slope: it.slope }
    }

    /// Where the links go from their force through the step.
    #[inline(always)]
    fn follow<R: Real>(at: &LaneAt<'_, R>) -> Followed<R> {
        follow::<Self, R>(at)
    }
}

/// A number, and its derivatives by d and ḋ.
type Graded<R> = [R; 3];

/// Leads spring and dashpot through the step.
#[inline(always)]
pub(crate) fn follow<V: Viscous + ?Sized, R: Real>(at: &LaneAt<'_, R>) -> Followed<R> {
    let (parameters, f0, dt) = (at.parameters, at.history[0], length(at));
    let (zero, one) = (dt.of(0.0), dt.of(1.0));
    let gamma = 1.0 - std::f64::consts::FRAC_1_SQRT_2;
    let ahead = (1.0 - gamma) / gamma;
    let [mean, change] = rates(at);
    let h = dt * dt.of(1.0 / PARTS as f64);
    let a = dt.of(gamma) * h * parameters[0];
    let a_per_dt = a * (one / dt);
    let (mut f, mut viscous) = ([f0, zero, zero], zero);
    let mut inner = f;
    // The inner stage and the end of every part, in one loop: the equation of the dashpot is long.
    for stage in 0..2 * PARTS {
        let is_end = stage % 2 == 1;
        let (reached, weight) = if is_end { (1.0, gamma) } else { (gamma, 1.0 - gamma) };
        let of_inner = if is_end { ahead } else { 0.0 };
        let s = dt.of(((stage / 2) as f64 + reached) / PARTS as f64 - 0.5);
        let (share, rest) = (dt.of(of_inner), dt.of(1.0 - of_inner));
        let mut known: Graded<R> = [a * change.mul_add(s, mean), a_per_dt, a * s];
        for i in 0..3 {
            known[i] = rest.mul_add(f[i], share.mul_add(inner[i], known[i]));
        }
        let it = V::split(parameters, known[0], a);
        viscous = viscous + dt.of(weight) * h * (it.force * it.rate);
        let now = [it.force, it.slope * known[1], it.slope * known[2]];
        if is_end {
            f = now;
        } else {
            inner = now;
        }
    }
    Followed { f: f[0], f_d: f[1], f_v: f[2], viscous }.where_time_goes_on(at, f0)
}

/// A spring in series with a dashpot, over lanes.
pub(crate) struct Series<V>(PhantomData<V>);

impl<V: Viscous> LaneLaw for Series<V> {
    const COORDINATES: usize = 1;
    const HISTORY: usize = 1;
    const PARAMETERS: usize = V::PARAMETERS;
    const IS_LONG: bool = V::IS_LONG;

    #[inline(always)]
    fn respond<R: Real>(
        at: &LaneAt<'_, R>,
        out: &mut LaneForce<'_, R>,
        trial: &mut [R],
    ) -> LaneStep<R> {
        let end = V::follow(at);
        (trial[0], out.f[0], out.k[0], out.c[0]) = (end.f, end.f, end.f_d, end.f_v);
        let stored = end.f.of(0.5) * end.f * end.f / at.parameters[0];
        LaneStep { viscous: end.viscous, ..LaneStep::elastic(stored) }
    }
}
