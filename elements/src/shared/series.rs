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

use crate::shared::relaxation::{Followed, rates};
use trilith_element::{History, Kinematics, Response, history};

/// Parts of a step; fixed, so that the force is smooth in d and ḋ.
const PARTS: usize = 4;

history! {
    /// History of a spring in series with a dashpot.
    pub(crate) struct SeriesHistory {
        /// Force.
        pub(crate) force: "N",
    }
}

/// Writes what a spring in series with a dashpot did.
pub(crate) fn answer(k: f64, end: &Followed, trial: &mut [f64], out: &mut Response<'_>) {
    SeriesHistory { force: end.f }.store(trial);
    (out.f[0], out.k[0], out.c[0]) = (end.f, end.f_d, end.f_v);
    out.energy.stored = 0.5 * end.f * end.f / k;
    out.energy.viscous = end.viscous;
}

/// What a dashpot does where F(w) + a w is known.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Split {
    /// Force F(w), N.
    pub force: f64,
    /// Rate w, m/s.
    pub rate: f64,
    /// Derivative of the force by the known sum.
    pub slope: f64,
}

/// A law F(w) of a dashpot that rises, with F(−w) = −F(w).
pub(crate) trait Viscous {
    /// Force and rate where F(w) + a w = `known` > 0, `a` > 0.
    fn split_positive(&self, known: f64, a: f64) -> Split;

    /// The same for any sign.
    fn split(&self, known: f64, a: f64) -> Split {
        // Where nothing acts, only the slope of a vanishing force matters.
        let it = self.split_positive(known.abs().max(f64::MIN_POSITIVE), a);
        let sign = if known == 0.0 { 0.0 } else { 1.0_f64.copysign(known) };
        Split { force: sign * it.force, rate: sign * it.rate, slope: it.slope }
    }
}

/// A number, and its derivatives by d and ḋ.
type Graded = [f64; 3];

fn mix<const N: usize>(terms: [(f64, Graded); N]) -> Graded {
    std::array::from_fn(|i| terms.iter().map(|(c, x)| c * x[i]).sum())
}

/// Leads spring `k` (N/m) and dashpot from force `f0` through the step.
pub(crate) fn follow(k: f64, law: &impl Viscous, f0: f64, at: &Kinematics<'_>) -> Followed {
    if at.dt <= 0.0 {
        return Followed::unchanged(f0);
    }
    let gamma = 1.0 - std::f64::consts::FRAC_1_SQRT_2;
    let (mean, change) = rates(at);
    let rate = |s: f64| [mean + change * (s - 0.5), 1.0 / at.dt, s - 0.5];
    let h = at.dt / PARTS as f64;
    let a = gamma * h * k;
    let stage = |known: Graded| {
        let it = law.split(known[0], a);
        ([it.force, it.slope * known[1], it.slope * known[2]], it.force * it.rate)
    };
    let (mut f, mut viscous) = ([f0, 0.0, 0.0], 0.0);
    for part in 0..PARTS {
        let s = |c: f64| (part as f64 + c) / PARTS as f64;
        let (inner, power) = stage(mix([(1.0, f), (a, rate(s(gamma)))]));
        viscous += (1.0 - gamma) * h * power;
        let ahead = (1.0 - gamma) / gamma;
        let (end, power) = stage(mix([(1.0 - ahead, f), (ahead, inner), (a, rate(s(1.0)))]));
        viscous += gamma * h * power;
        f = end;
    }
    Followed { f: f[0], f_d: f[1], f_v: f[2], viscous }
}
