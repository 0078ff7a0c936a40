//! Friction spring (ring spring): flag-shaped, self-centring, independent of rates.
//!
//! ```text
//!  f        ___ k      f = k (d − s),   s: slip of the rings, s ≥ 0 (for d > 0)
//!  |    k1 /  /        pushed in:   f = κ₁ (s + p)        κᵢ = k kᵢ/(k − kᵢ)
//!  |    __/  / k2      let go:      f = κ₂ (s + p)
//!  |   /   _/          between:     s stays
//!  |  / __/            that is f = k1 (d + u0) loading, k2 (d + u0) unloading, k d at first
//!  | k /                p = u0;  beyond d = us the rings are closed: stiffness k
//!  +--------- d
//! ```
//!
//! In `Both` the law is the same for negative d with the signs turned; in the others no force acts on
//! the inactive side. The force is zero at d = 0.
//!
//! Energies: `stored` is what comes back, f²/2k + ½ κ₂ ((s + p)² − p²); the rest of the work, done in
//! loading, is `hysteretic`: ½ (κ₁ − κ₂) ((s + p)² − p²).
//!
//! Reference: parameters and branches as in SAP2000's friction-spring damper; \[Filiatrault et al. 2000\].

use crate::shared::written::{Written, answers_by_law};
use serde::Deserialize;
use std::borrow::Cow;
use trilith_element::lanes::{LaneAt, LaneForce, LaneLaw, LaneStep, Real};
use trilith_element::{
    Axis, Card, Category, Choices, Coordinates, Described, Exercise, Field, Link, NodeCount,
    ParameterError, Parameters, Stroke,
};

/// Sides on which a [`FrictionSpring`] acts.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Deserialize, Choices)]
pub enum Direction {
    /// Both.
    Both,
    /// Positive deformation only.
    Tension,
    /// Negative deformation only.
    Compression,
}

/// Ring spring.
#[derive(Clone, Debug, Deserialize, Parameters)]
#[serde(deny_unknown_fields)]
pub struct FrictionSpring {
    /// stiffness before slip, and between the branches
    #[parameter("k", unit = "N/m", about = "N·m/rad", range = Positive)]
    pub k: f64,
    /// stiffness in slip, loading; below `k`
    #[parameter("k₁", unit = "N/m", about = "N·m/rad", range = Positive)]
    pub k1: f64,
    /// stiffness in slip, unloading; at most `k1`
    #[parameter("k₂", unit = "N/m", about = "N·m/rad", range = Positive)]
    pub k2: f64,
    /// precompression (SAP2000 writes it negative)
    #[parameter("u₀", unit = "m", about = "rad", range = NonNegative, default = 0.0)]
    pub u0: f64,
    /// deformation at which the rings are closed; none: they never are
    #[parameter("u_s", unit = "m", about = "rad", range = Positive)]
    pub us: Option<f64>,
    /// sides on which it acts
    #[parameter(choices = Direction::NAMES, default = "Both")]
    pub direction: Direction,
    /// local axis
    #[parameter(choices = Axis::NAMES, default = "U1")]
    pub axis: Axis,
}

impl Described for FrictionSpring {
    const CARD: Card = Card::new(
        "FrictionSpring",
        Category::Link,
        "Ring spring: flag-shaped, self-centring, independent of rates.",
    )
    .nodes(NodeCount::GROUND_OR_TWO)
    .parameters(Self::PARAMETERS)
    .law("f = k (d − s), s ≥ 0 for d > 0, s = const but\n\
          loading in slip:   f = k₁ (d + u₀)\n\
          unloading in slip: f = k₂ (d + u₀)\n\
          d beyond u_s:      s = const")
    .source("SAP2000 friction-spring damper; Filiatrault, Tremblay & Kar 2000")
    .example(r#""ring": FrictionSpring(nodes: ("a", "b"), k: "50 MN/m", k1: "6 MN/m", k2: "2 MN/m", u0: "5 mm", us: "60 mm")"#)
    .exercise(Exercise::new(1.0, &[Stroke::about(0.0, 0.05)]));

    fn check(&self) -> Result<(), ParameterError> {
        if self.k1 >= self.k {
            let message = "`k1` must be smaller than `k`, the stiffness before slip";
            return Err(ParameterError::inconsistent("k1", message));
        }
        if self.k2 > self.k1 {
            let message = "`k2` must not be larger than `k1`: unloading gives back less";
            return Err(ParameterError::inconsistent("k2", message));
        }
        if self.us.is_some_and(|us| self.k * us <= self.k1 * (us + self.u0)) {
            let message = "`us` must lie beyond the start of slip, k1 u0/(k − k1)";
            return Err(ParameterError::inconsistent("us", message));
        }
        Ok(())
    }
}

/// What the law takes of a [`FrictionSpring`].
#[derive(Clone, Copy)]
struct Of<R> {
    k: R,
    /// κ of loading and of unloading: force over slip + precompression in slip.
    kappa: [R; 2],
    /// 1/(k + κ) of both.
    per: [R; 2],
    u0: R,
    /// Slip at which the rings are closed.
    closed: R,
    /// 1 where it acts for positive d, and for negative d; else 0.
    acts: [R; 2],
}

impl<R: Real> Of<R> {
    #[inline(always)]
    fn read(p: &[R]) -> Self {
        let p: [R; PARAMETERS] = p.try_into().expect("parameters of a friction spring");
        let [k, loading, unloading, per_loading, per_unloading, u0, closed, tension, compression] =
            p;
        let (kappa, per) = ([loading, unloading], [per_loading, per_unloading]);
        Self { k, kappa, per, u0, closed, acts: [tension, compression] }
    }

    /// Slip on the branch of loading (0) or of unloading (1), between zero and closed rings.
    #[inline(always)]
    fn slip(&self, branch: usize, d: R) -> R {
        let Self { k, kappa, per, u0, closed, .. } = *self;
        ((k * d - kappa[branch] * u0) * per[branch]).max(k.of(0.0)).min(closed)
    }

    /// ½ κ ((s + p)² − p²).
    #[inline(always)]
    fn rings(&self, kappa: R, slip: R) -> R {
        let half = slip.of(0.5);
        half * kappa * slip * (slip + self.u0 + self.u0)
    }
}

const PARAMETERS: usize = 9;

struct FrictionSpringLaw;

impl LaneLaw for FrictionSpringLaw {
    const COORDINATES: usize = 1;
    const HISTORY: usize = 1;
    const PARAMETERS: usize = PARAMETERS;

    #[inline(always)]
    fn respond<R: Real>(
        at: &LaneAt<'_, R>,
        out: &mut LaneForce<'_, R>,
        trial: &mut [R],
    ) -> LaneStep<R> {
        let it = Of::read(at.parameters);
        let (k, d, slip) = (it.k, at.d[0], at.history[0]);
        let (zero, one, half) = (k.of(0.0), k.of(1.0), k.of(0.5));
        // On the side of negative d signs are turned; at d = 0 it is on the side that acts.
        let turned = d.lt(zero) | (d.le(zero) & !zero.lt(it.acts[0]));
        let acts = zero.lt(R::select(turned, it.acts[1], it.acts[0]));
        // The rings of the other side have been let go on the way.
        let before = R::select(turned, -slip, slip).max(zero);
        let (low, high) = (it.slip(0, d.abs()), it.slip(1, d.abs()));
        let after = before.max(low).min(high).only(acts);
        let loads = before.lt(low) & low.lt(it.closed);
        let unloads = high.lt(before) & zero.lt(high);
        let by_d = (k * it.per[0]).only(loads) + (k * it.per[1]).only(unloads);
        let f = (k * (d.abs() - after)).only(acts);
        trial[0] = R::select(turned, -after, after);
        out.f[0] = R::select(turned, -f, f);
        out.k[0] = (k * (one - by_d)).only(acts);
        out.c[0] = zero;
        let lost = it.kappa[0] - it.kappa[1];
        let heat = it.rings(lost, after) - it.rings(lost, before);
        LaneStep {
            stored: half * f * f / k + it.rings(it.kappa[1], after),
            hysteretic: heat.max(zero),
            viscous: zero,
        }
    }
}

impl FrictionSpring {
    /// Force over slip + precompression, on the branch of stiffness `slope`.
    fn branch(&self, slope: f64) -> f64 {
        self.k * slope / (self.k - slope)
    }

    fn law(&self) -> Written {
        Written::of::<FrictionSpringLaw>().still()
    }

    /// The parameters of the law.
    fn numbers(&self) -> [f64; PARAMETERS] {
        let (k, p) = (self.k, self.u0);
        let kappa = [self.k1, self.k2].map(|slope| self.branch(slope));
        let per = kappa.map(|kappa| (k + kappa).recip());
        let closed = |us: f64| (k * us - kappa[0] * p) * per[0];
        // Farther than anything slips, and yet a number that can be taken from another.
        let closed = self.us.map_or(f64::MAX, closed);
        let acts = match self.direction {
            Direction::Both => [1.0, 1.0],
            Direction::Tension => [1.0, 0.0],
            Direction::Compression => [0.0, 1.0],
        };
        [k, kappa[0], kappa[1], per[0], per[1], p, closed, acts[0], acts[1]]
    }
}

impl Link for FrictionSpring {
    fn coordinates(&self) -> Coordinates {
        Coordinates::Local(vec![self.axis])
    }

    fn history(&self) -> Cow<'static, [Field]> {
        let unit = if self.axis.index() > 2 { "rad" } else { "m" };
        vec![Field::new("slip", unit)].into()
    }

    fn uses_rates(&self) -> bool {
        false
    }

    fn engaged_stiffness(&self, k: &mut [f64]) {
        k[0] = self.k;
    }

    answers_by_law!();
}

#[cfg(test)]
mod tests;
