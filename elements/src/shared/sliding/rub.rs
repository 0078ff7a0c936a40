//! Friction that looks at more than where it is: at the slip rate, at whether it has broken away, and with a dashpot
//! beside the spring that it stretches before it slips.
//!
//! ```text
//!   τ = kₛ e + q n,  |τ| ≤ L(x, s)       e: stretch of the spring; q = cₛ ė: dashpot beside it
//!   sticks:  ė = ḋ,  x = 0                slips:  ė = ḋ − p/Δt along τ,  x = n·(ḋ − Δe/Δt);  p: slip of the step
//! ```
//!
//! So the slip rate is the rate of the deformation less that of the stretch. Where friction falls with the rate there would
//! be no unique slip behind a spring without mass: there x is the rate of the deformation. At the start
//! of a step, where nothing has moved, x and q are those of the history.

use super::slip::{Cone, Slide, Trial};
use trilith_element::lanes::Real;

/// What the friction remembers beside its anchor.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Worn<R, const T: usize> {
    /// Slip rate.
    pub(crate) rate: R,
    /// Slip since it last stuck.
    pub(crate) since: R,
    /// Force of the dashpot.
    pub(crate) damped: [R; T],
}

/// A step of a contact that is closed at its end.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Rubbing<R, const T: usize> {
    /// kₛ and cₛ.
    pub(crate) spring: R,
    pub(crate) dashpot: R,
    /// Stretch if nothing slips, motion in the step, rate at its end.
    pub(crate) stretch: [R; T],
    pub(crate) way: [R; T],
    pub(crate) speed: [R; T],
    pub(crate) dt: R,
    pub(crate) was: Worn<R, T>,
}

/// The friction at the end of the step.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Rubbed<R: Real, const T: usize> {
    pub(crate) sticks: R::Mask,
    pub(crate) tau: [R; T],
    /// Slip of the step, along the friction force.
    pub(crate) slip: [R; T],
    pub(crate) worn: Worn<R, T>,
    /// Derivatives of τ by stretch, by motion and by rate, and by the normal force.
    pub(crate) by_stretch: [[R; T]; T],
    pub(crate) by_way: [[R; T]; T],
    pub(crate) by_speed: [[R; T]; T],
    pub(crate) by_normal: [R; T],
}

#[inline(always)]
fn dot<R: Real, const T: usize>(a: &[R; T], b: &[R; T]) -> R {
    let mut sum = a[0] * b[0];
    for i in 1..T {
        sum = sum + a[i] * b[i];
    }
    sum
}

#[inline(always)]
fn length<R: Real, const T: usize>(a: &[R; T]) -> R {
    if T == 1 { a[0].abs() } else { dot(a, a).sqrt() }
}

impl<R: Real, const T: usize> Rubbing<R, T> {
    #[inline(always)]
    pub(crate) fn on(&self, cone: &Cone<R>) -> Rubbed<R, T> {
        let (zero, one) = (self.dt.of(0.0), self.dt.of(1.0));
        let mut moved = length(&self.way);
        moved = moved + self.dt;
        let stands = moved.le(zero);
        let per_time = (one / self.dt).only(zero.lt(self.dt));
        let dashpot = self.dashpot.only(!stands);

        let (mut full, mut damped) = ([zero; T], [zero; T]);
        for i in 0..T {
            damped[i] = R::select(stands, self.was.damped[i], dashpot * self.speed[i]);
            full[i] = self.stretch[i] * self.spring + damped[i];
        }
        let size = length(&full);
        let nowhere = size.le(zero);
        let mut along = [zero; T];
        for i in 0..T {
            along[i] = R::select(nowhere, zero, full[i] / size);
        }

        // The slip rate if nothing slips, and how it turns with the force.
        let grows = !cone.less[0].lt(zero);
        let (forward, speed) = (dot(&along, &self.speed), length(&self.speed));
        let apart = forward - dot(&along, &self.way) * per_time;
        let rate = R::select(stands, self.was.rate, R::select(grows, apart, speed));
        let stiffness = self.spring + dashpot * per_time;
        let slide = Slide::of(
            cone,
            &Trial {
                size,
                stiffness,
                spring: self.spring,
                rate,
                per_slip: per_time.only(grows),
                since: self.was.since,
            },
        );
        let Slide { sticks, limit, .. } = slide;
        let slips = !sticks;

        let mut out = Rubbed {
            sticks,
            tau: [zero; T],
            slip: [zero; T],
            worn: Worn {
                rate: slide.rate,
                since: (self.was.since + slide.slip).only(slips | stands),
                damped,
            },
            by_stretch: [[zero; T]; T],
            by_way: [[zero; T]; T],
            by_speed: [[zero; T]; T],
            by_normal: [zero; T],
        };
        let aside = {
            let mut aside = [zero; T];
            let mut relative = [zero; T];
            for i in 0..T {
                relative[i] = self.speed[i] - self.way[i] * per_time;
            }
            let straight = dot(&along, &relative);
            for i in 0..T {
                aside[i] = (relative[i] - along[i] * straight).only(slips & grows & !stands) / size;
                aside[i] = R::select(nowhere, zero, aside[i]);
            }
            aside
        };
        let turn = R::select(nowhere, zero, limit / size);
        for i in 0..T {
            out.tau[i] = R::select(sticks, full[i], along[i] * limit);
            out.slip[i] = along[i] * slide.slip;
            out.worn.damped[i] = damped[i] - dashpot * per_time * out.slip[i];
            out.by_normal[i] = (along[i] * slide.by_normal).only(slips);
            for j in 0..T {
                let own = self.dt.of(f64::from(u8::from(i == j)));
                let across = if T == 1 { zero } else { (own - along[i] * along[j]) * turn };
                // By the force that would be if nothing slipped.
                let by_full = along[i] * (along[j] * slide.by_size + aside[j] * slide.by_rate);
                let by_full = R::select(sticks, own, across + by_full);
                let by_rate = (along[i] * slide.by_rate).only(slips & !stands);
                let known = R::select(nowhere | speed.le(zero), zero, self.speed[j] / speed);
                let ahead = R::select(grows, along[j], known);
                out.by_stretch[i][j] = by_full * self.spring;
                out.by_way[i][j] = -(by_rate * along[j] * per_time).only(grows);
                out.by_speed[i][j] = by_full * dashpot + by_rate * ahead;
            }
        }
        out
    }
}
