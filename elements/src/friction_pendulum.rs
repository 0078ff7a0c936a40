//! FrictionPendulum: a bearing with one concave sliding surface, or a flat one.
//!
//! ```text
//!   ═══╤═════════╤═══   j        N = −f₁                 pressed together; N = 0: lifted, no friction
//!      ╲   ◡◡◡   ╱               τ = kₛ (u − a) + cₛ (u̇ − ȧ), |τ| ≤ μ N        u = (d₂, d₃); a slips at the limit
//!   ▔▔▔▔╲_______╱▔▔▔▔  i        f₁ = min(0, kₙ g + c ġ), g = d₁   (closed where g ≤ 0)
//!         R                      fₜ = τ + N ∇h(u) + kₛₜ (|u| − D)⁺ u/|u|
//!
//!   Shallow:    h = u²/(2R),  ∇h = u/R            Spherical:  h = R − √(R² − u²),  ∇h = u/√(R² − u²)
//!   `rise`:     g = d₁ − h(u): moving out lifts the load; N ∇h is then the reaction of the surface
//!   `inclined`: S τ in place of τ; stretch and slip along the surface, |τ| ≤ μ P, P = N √(1 + |∇h|²) + ∇h·τ
//!               S = I + ∇h ∇hᵀ/(1 + √(1 + |∇h|²))         so |fₜ| = N tan(θ ± arctan μ), tan θ = |∇h|
//!
//!   Coulomb            μ
//!   Velocity           μ = μ_fast − (μ_fast − μ_slow) e^(−r x), slip rate x = |ȧ|
//!   VelocityForce      the same with μ_slow = a_slow N^(n_slow−1), μ_fast = a_fast N^(n_fast−1), each at
//!                      most μ_max, and r = r₀ + r₁ N + r₂ N²
//!   VelocityPressure   the same with μ_fast = μ_f0 − Δμ tanh(α N/A), μ_f0 given as `mu_fast`
//! ```
//!
//! Friction is elastic–perfectly plastic with radial return (it sticks fully below the limit), the same
//! as that of [`NLink`](crate::NLink), and so are separation and touching: a lifted bearing forgets its
//! anchor, and finds a new one where it touches, linear in the step. **Beyond an `NLink` with a
//! `radius`** this bearing has friction that depends on the normal force or the pressure, the exact
//! spherical surface, the rise along it, and the rim. An `NLink` has what a bearing does not need: a
//! clearance, restitution, post-slip and rotational springs.
//!
//! Slip rate, `mu_static` and `cs` are those of [`NLink`](crate::NLink).
//!
//! The rim is a ring around the bearing: it acts on a lifted slider too. Beyond 0.95 R the slope of a
//! spherical surface goes on linearly. `rise` matters where the vertical motion does: at u = 0.2 R the
//! load has gone up by 0.02 R, and a mass on the bearing gains and loses that height in every cycle.
//!
//! **The exact slider** is `surface: Spherical, rise: true, inclined: true`: a point on a sphere, pressed along its normal
//! and rubbed along its tangent plane, with speeds along the surface. Without `inclined`, friction is horizontal and of
//! the vertical force: at u = 0.3 R and μ = 0.1 the force outwards is 3 % too small and that back 3 % too large. As a slope that is steep and
//! rough would lock, `inclined` takes coefficients up to 0.3 (`mu_max` too), and the normal leans no more than at 0.95 R.
//! Its anchor lies off u by the stretch along the surface.
//!
//! **Energy.** Stored: ½ kₙ g² + |τ|²/(2 kₛ) + the rim + (without `rise`) the work of the restoring force
//! so far, which is history: N u/R has no potential where N changes. With `rise` it has: the height of
//! the load. Friction: ½ (τ₀ + τ₁)·Δa.
//!
//! Reference: \[Zayas, Low & Mahin 1990\]; velocity dependence \[Constantinou, Mokha & Reinhorn 1990\];
//! pressure \[Tsopelas et al. 1994\]; checked with F = (W/R) u + μ W sgn(u̇).

mod card;
#[cfg(test)]
mod exact_slider;
#[cfg(test)]
mod tests;

use crate::shared::sliding::{
    Axial, Bearing, BreakAway, Coefficient, Dish, Side, SlidingHistory, Stop, engaged,
};
use serde::Deserialize;
use std::borrow::Cow;
use trilith_element::lanes::LaneForm;
use trilith_element::{
    Axis, Choices, Contact, ContactUse, Coordinates, Field, History, Impact, Kinematics, Link,
    Parameters, Response,
};

/// How the friction of a [`FrictionPendulum`] depends on speed and normal force.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Deserialize, Choices)]
pub enum FrictionModel {
    /// Not at all.
    Coulomb,
    /// On the speed.
    Velocity,
    /// On speed and normal force, as a power.
    VelocityForce,
    /// On speed and pressure.
    VelocityPressure,
}

/// Shape of the surface of a [`FrictionPendulum`].
#[derive(Clone, Copy, Debug, PartialEq, Eq, Deserialize, Choices)]
pub enum Surface {
    /// Small slopes: restoring force N u/R.
    Shallow,
    /// Exact sphere: N u/√(R² − u²).
    Spherical,
}

/// Sliding bearing with one concave surface; its card is in `card.rs` beside this file.
#[derive(Clone, Debug, Deserialize, Parameters)]
#[serde(deny_unknown_fields)]
pub struct FrictionPendulum {
    /// stiffness in compression
    #[parameter("kₙ", unit = "N/m", range = Positive)]
    pub kn: f64,
    /// dashpot along the axis, acts only while closed
    #[parameter("c", unit = "N·s/m", range = NonNegative, default = 0.0)]
    pub damping: f64,
    /// the dashpot may pull while closed; friction is of kₙ g then
    #[parameter]
    pub pull: bool,
    /// stiffness before slip
    #[parameter("kₛ", unit = "N/m", range = Positive)]
    pub ks: f64,
    /// dashpot beside the spring `ks`: damps a bearing that sticks
    #[parameter("cₛ", unit = "N·s/m", range = NonNegative, default = 0.0)]
    pub cs: f64,
    /// before it breaks away; none: as at rest
    #[parameter("μ_static", unit = "1", range = NonNegative)]
    pub mu_static: Option<f64>,
    /// slip over which `mu_static` is gone; 0: as soon as the spring `ks` can follow
    #[parameter("s₀", unit = "m", range = NonNegative, default = 0.0)]
    pub static_slip: f64,
    /// effective radius; 0 is flat
    #[parameter("R", unit = "m", range = NonNegative, default = 0.0)]
    pub radius: f64,
    /// restoring force of small slopes, or exact
    #[parameter(choices = Surface::NAMES, default = "Shallow")]
    pub surface: Surface,
    /// moving out lifts the load
    #[parameter]
    pub rise: bool,
    /// friction lies in the surface, of the force normal to it; exact with `Spherical` and `rise`
    #[parameter]
    pub inclined: bool,
    /// what the friction coefficient depends on
    #[parameter(choices = FrictionModel::NAMES, default = "Coulomb")]
    pub friction_model: FrictionModel,
    /// Coulomb: friction coefficient
    #[parameter("μ", unit = "1", range = NonNegative)]
    pub mu: Option<f64>,
    /// Velocity, VelocityPressure: coefficient at rest
    #[parameter("μ_slow", unit = "1", range = NonNegative)]
    pub mu_slow: Option<f64>,
    /// Velocity, VelocityPressure: coefficient at speed
    #[parameter("μ_fast", unit = "1", range = NonNegative)]
    pub mu_fast: Option<f64>,
    /// Velocity, VelocityPressure: how fast it goes from slow to fast
    #[parameter("r", unit = "s/m", range = NonNegative)]
    pub rate: Option<f64>,
    /// VelocityForce: factor at rest
    #[parameter("a_slow", unit = "N", per = "N", exponent = "n_slow", range = NonNegative)]
    pub a_slow: Option<f64>,
    /// VelocityForce: exponent at rest; 1 is no dependence
    #[parameter("n_slow", unit = "1", range = Above(0.0, 1.0))]
    pub n_slow: Option<f64>,
    /// VelocityForce: factor at speed
    #[parameter("a_fast", unit = "N", per = "N", exponent = "n_fast", range = NonNegative)]
    pub a_fast: Option<f64>,
    /// VelocityForce: exponent at speed
    #[parameter("n_fast", unit = "1", range = Above(0.0, 1.0))]
    pub n_fast: Option<f64>,
    /// VelocityForce: rate from slow to fast
    #[parameter("r₀", unit = "s/m", range = NonNegative)]
    pub rate_0: Option<f64>,
    /// VelocityForce: growth of the rate with N
    #[parameter("r₁", unit = "s/(m·N)", range = NonNegative, default = 0.0)]
    pub rate_1: f64,
    /// VelocityForce: growth of the rate with N²
    #[parameter("r₂", unit = "s/(m·N²)", range = NonNegative, default = 0.0)]
    pub rate_2: f64,
    /// VelocityForce: most that the coefficient becomes at small N
    #[parameter("μ_max", unit = "1", range = Positive, default = 1.0)]
    pub mu_max: f64,
    /// VelocityPressure: area of the slider
    #[parameter("A", unit = "m²", range = Positive)]
    pub area: Option<f64>,
    /// VelocityPressure: fall of the coefficient at speed
    #[parameter("Δμ", unit = "1", range = NonNegative)]
    pub delta_mu: Option<f64>,
    /// VelocityPressure: how fast it falls with the pressure
    #[parameter("α", unit = "1/Pa", range = NonNegative)]
    pub pressure_rate: Option<f64>,
    /// displacement at which the rim is met; none: no rim
    #[parameter("D", unit = "m", range = Positive)]
    pub stop: Option<f64>,
    /// stiffness of the rim
    #[parameter("kₛₜ", unit = "N/m", range = Positive)]
    pub stop_stiffness: Option<f64>,
}

impl FrictionPendulum {
    /// A flat bearing without friction: stiffness in compression `kn` and before slip `ks` (N/m); set
    /// the other fields as needed.
    #[must_use]
    pub fn new(kn: f64, ks: f64) -> Self {
        Self {
            kn,
            damping: 0.0,
            pull: false,
            ks,
            cs: 0.0,
            mu_static: None,
            static_slip: 0.0,
            radius: 0.0,
            surface: Surface::Shallow,
            rise: false,
            inclined: false,
            friction_model: FrictionModel::Coulomb,
            mu: Some(0.0),
            mu_slow: None,
            mu_fast: None,
            rate: None,
            a_slow: None,
            n_slow: None,
            a_fast: None,
            n_fast: None,
            rate_0: None,
            rate_1: 0.0,
            rate_2: 0.0,
            mu_max: 1.0,
            area: None,
            delta_mu: None,
            pressure_rate: None,
            stop: None,
            stop_stiffness: None,
        }
    }

    fn friction(&self) -> Coefficient {
        let given = |x: Option<f64>| x.unwrap_or(0.0);
        let (slow, fast, rate) = (given(self.mu_slow), given(self.mu_fast), given(self.rate));
        match self.friction_model {
            FrictionModel::Coulomb => Coefficient::Constant { mu: given(self.mu) },
            FrictionModel::Velocity => Coefficient::Velocity { slow, fast, rate },
            FrictionModel::VelocityForce => Coefficient::Force {
                slow: (given(self.a_slow), self.n_slow.unwrap_or(1.0)),
                fast: (given(self.a_fast), self.n_fast.unwrap_or(1.0)),
                most: self.mu_max,
                rate: [given(self.rate_0), self.rate_1, self.rate_2],
            },
            FrictionModel::VelocityPressure => Coefficient::Pressure {
                slow,
                fast,
                rate,
                drop: given(self.delta_mu),
                per_force: given(self.pressure_rate) / self.area.unwrap_or(1.0),
            },
        }
    }

    fn bearing(&self) -> Bearing {
        let axial = Axial { kn: self.kn, damping: self.damping, pull: self.pull };
        let stop = self.stop.zip(self.stop_stiffness);
        Bearing {
            compression: Side { opening: 0.0, axial, friction: self.friction() },
            tension: None,
            ks: self.ks,
            cs: self.cs,
            away: self.mu_static.map(|mu| BreakAway { mu, over: self.static_slip }),
            dish: Dish { radius: self.radius, spherical: self.surface == Surface::Spherical },
            rise: self.rise,
            inclined: self.inclined,
            stop: stop.map(|(at, stiffness)| Stop { at, stiffness }),
        }
    }
}

impl Link for FrictionPendulum {
    fn coordinates(&self) -> Coordinates {
        Coordinates::Local(vec![Axis::U1, Axis::U2, Axis::U3])
    }

    fn history(&self) -> Cow<'static, [Field]> {
        SlidingHistory::FIELDS.into()
    }

    fn at_rest(&self, at: &mut [f64]) {
        self.bearing().at_rest().store(at);
    }

    fn engaged_stiffness(&self, k: &mut [f64]) {
        engaged(self.kn, self.ks, k);
    }

    fn respond(
        &self,
        at: &Kinematics<'_>,
        committed: &[f64],
        trial: &mut [f64],
        out: &mut Response<'_>,
    ) {
        self.bearing().respond(at, committed, trial, out);
    }

    fn lanes(&self, _: &[bool]) -> Option<LaneForm> {
        Some(self.bearing().lanes())
    }

    fn contact_use(&self) -> ContactUse {
        ContactUse::Bearing
    }

    fn contacts(&self, at: &Kinematics<'_>, history: &[f64], _: &[f64], out: &mut Vec<Contact>) {
        out.push(self.bearing().contact(at, history));
    }

    fn impact(&self) -> Option<Impact> {
        let (stiffness, damping) = (self.kn, self.damping);
        Some(Impact::new(0, stiffness, damping))
    }
}
