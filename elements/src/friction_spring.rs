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
//! loading, is `hysteretic`.
//!
//! Reference: parameters and branches as in SAP2000's friction-spring damper; \[Filiatrault et al. 2000\].

use serde::Deserialize;
use std::borrow::Cow;
use trilith_element::{
    Axis, Card, Category, Choices, Coordinates, Described, Exercise, Field, Kinematics, Link,
    NodeCount, ParameterError, Parameters, Response, Stroke,
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

/// Slip, and its derivative by d.
struct Slip {
    slip: f64,
    by_d: f64,
}

impl FrictionSpring {
    /// Force over slip + precompression, on the branch of stiffness `slope`.
    fn branch(&self, slope: f64) -> f64 {
        self.k * slope / (self.k - slope)
    }

    /// On the side of positive d.
    fn pushed(&self, d: f64, slip0: f64) -> Slip {
        let (k, p) = (self.k, self.u0);
        let on = |kappa: f64| (k * d - kappa * p) / (k + kappa);
        let (loading, unloading) = (self.branch(self.k1), self.branch(self.k2));
        let closed = self.us.map_or(f64::INFINITY, |us| (k * us - loading * p) / (k + loading));
        // Slip lies between the two branches, and between zero and closed rings.
        let (low, high) = (on(loading).clamp(0.0, closed), on(unloading).clamp(0.0, closed));
        let moves = |kappa: f64| Slip { slip: on(kappa), by_d: k / (k + kappa) };
        let stays = |slip: f64| Slip { slip, by_d: 0.0 };
        if slip0 < low {
            if low < closed { moves(loading) } else { stays(closed) }
        } else if slip0 > high {
            if high > 0.0 { moves(unloading) } else { stays(0.0) }
        } else {
            stays(slip0)
        }
    }

    /// Energy of the rings at a slip, with `kappa` for the branch that takes or gives it.
    fn rings(&self, kappa: f64, slip: f64) -> f64 {
        0.5 * kappa * slip * (slip + 2.0 * self.u0)
    }

    fn acts(&self, d: f64) -> bool {
        match self.direction {
            Direction::Both => true,
            Direction::Tension => d >= 0.0,
            Direction::Compression => d <= 0.0,
        }
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

    fn respond(
        &self,
        at: &Kinematics<'_>,
        committed: &[f64],
        trial: &mut [f64],
        out: &mut Response<'_>,
    ) {
        let d = at.d[0];
        let (sign, slip0) = (1.0_f64.copysign(d), committed[0]);
        trial[0] = 0.0;
        if self.acts(d) {
            // The rings of the other side have been let go on the way.
            let it = self.pushed(d.abs(), (sign * slip0).max(0.0));
            trial[0] = sign * it.slip;
            out.f[0] = self.k * (d - trial[0]);
            out.k[0] = self.k * (1.0 - it.by_d);
        }
        let (before, after) = (slip0.abs(), trial[0].abs());
        let (loading, unloading) = (self.branch(self.k1), self.branch(self.k2));
        let heat = |slip: f64| self.rings(loading, slip) - self.rings(unloading, slip);
        out.energy.stored = 0.5 * out.f[0] * out.f[0] / self.k + self.rings(unloading, after);
        let same_side = trial[0] * slip0 >= 0.0;
        let from = if same_side { before } else { 0.0 };
        out.energy.hysteretic = (heat(after) - heat(from)).max(0.0);
    }
}

#[cfg(test)]
mod tests;
