//! TensionCompressionFriction: a sliding bearing that rubs in tension too, such as a restrained slider.
//!
//! ```text
//!   f₁ = min(0, kₙ (d₁ + g_c) + c ḋ₁)     where d₁ + g_c ≤ 0    pressed, N = −f₁
//!   f₁ = max(0, kₜ (d₁ − g_t) + c ḋ₁)     where d₁ − g_t ≥ 0    pulled,  N = f₁
//!   f  = 0                                between               open
//!   τ  = kₛ (u − a) + cₛ (u̇ − ȧ), |τ| ≤ μ N            u = (d₂, d₃); a slips at the limit, with the μ of the side
//!   fₜ = τ − f₁ u/R                       the surface pushes back in compression, out in tension
//!   μ  = μ_fast − (μ_fast − μ_slow) e^(−r x), x = |ȧ|, one set for compression, one for tension
//! ```
//!
//! Without any of the parameters of tension the friction is that of compression. Friction, separation
//! and touching are those of [`FrictionPendulum`](crate::FrictionPendulum): the contact has no memory of
//! its anchor once it has opened, also where it goes through from one side to the other in a step. In
//! tension the restoring force is negative, as follows from the slope of a surface that is pulled at:
//! a bearing that is lifted and displaced wants further out.
//!
//! Energy as in `FrictionPendulum`; the work of the restoring force is history.
//!
//! Reference: \[CSI Analysis Reference, T/C friction isolator\] for the parameters; \[Roussis &
//! Constantinou 2006\] for the negative stiffness in tension.

#[cfg(test)]
mod tests;

use crate::shared::sliding::{Axial, Bearing, Coefficient, Dish, Side, SlidingHistory, engaged};
use serde::Deserialize;
use std::borrow::Cow;
use trilith_element::lanes::LaneForm;
use trilith_element::{
    Axis, Card, Category, Contact, ContactUse, Coordinates, Described, Exercise, Field, History,
    Impact, Kinematics, Link, NodeCount, ParameterError, Parameters, Response, Stroke,
};

/// Sliding bearing with friction in compression and in tension.
#[derive(Clone, Debug, Deserialize, Parameters)]
#[serde(deny_unknown_fields)]
pub struct TensionCompressionFriction {
    /// stiffness in compression
    #[parameter("kₙ", unit = "N/m", range = Positive)]
    pub kn: f64,
    /// stiffness in tension
    #[parameter("kₜ", unit = "N/m", range = Positive)]
    pub kt: f64,
    /// clearance before compression
    #[parameter("g_c", unit = "m", range = NonNegative, default = 0.0)]
    pub gap_compression: f64,
    /// clearance before tension
    #[parameter("g_t", unit = "m", range = NonNegative, default = 0.0)]
    pub gap_tension: f64,
    /// dashpot along the axis, acts only while closed
    #[parameter("c", unit = "N·s/m", range = NonNegative, default = 0.0)]
    pub damping: f64,
    /// the dashpot may act against the contact force; N is that of the spring then
    #[parameter]
    pub pull: bool,
    /// stiffness before slip
    #[parameter("kₛ", unit = "N/m", range = Positive)]
    pub ks: f64,
    /// dashpot beside the spring `ks`: damps a bearing that sticks
    #[parameter("cₛ", unit = "N·s/m", range = NonNegative, default = 0.0)]
    pub cs: f64,
    /// effective radius; 0 is flat
    #[parameter("R", unit = "m", range = NonNegative, default = 0.0)]
    pub radius: f64,
    /// friction coefficient in compression; none: no friction
    #[parameter("μ", unit = "1", range = NonNegative)]
    pub mu: Option<f64>,
    /// instead of `mu`: friction coefficient at rest
    #[parameter("μ_slow", unit = "1", range = NonNegative)]
    pub mu_slow: Option<f64>,
    /// instead of `mu`: friction coefficient at speed
    #[parameter("μ_fast", unit = "1", range = NonNegative)]
    pub mu_fast: Option<f64>,
    /// how fast the friction coefficient goes from slow to fast
    #[parameter("r", unit = "s/m", range = NonNegative)]
    pub rate: Option<f64>,
    /// friction coefficient in tension; none: as compression
    #[parameter("μ", unit = "1", range = NonNegative)]
    pub mu_tension: Option<f64>,
    /// instead of `mu_tension`: at rest
    #[parameter("μ_slow", unit = "1", range = NonNegative)]
    pub mu_slow_tension: Option<f64>,
    /// instead of `mu_tension`: at speed
    #[parameter("μ_fast", unit = "1", range = NonNegative)]
    pub mu_fast_tension: Option<f64>,
    /// how fast it goes from slow to fast in tension
    #[parameter("r", unit = "s/m", range = NonNegative)]
    pub rate_tension: Option<f64>,
}

impl Described for TensionCompressionFriction {
    const CARD: Card = Card::new(
        "TensionCompressionFriction",
        Category::Link,
        "Sliding bearing with friction in compression and, of its own, in tension.",
    )
    .nodes(NodeCount::GROUND_OR_TWO)
    .parameters(Self::PARAMETERS)
    .law("pressed, d₁ + g_c ≤ 0: f₁ = min(0, kₙ (d₁ + g_c) + c ḋ₁)\n\
          pulled,  d₁ − g_t ≥ 0: f₁ = max(0, kₜ (d₁ − g_t) + c ḋ₁);  N = |f₁|\n\
          τ = kₛ (u − a) + cₛ (u̇ − ȧ), |τ| ≤ μ N (radial return), μ of the side;  u = (d₂, d₃)\n\
          μ = μ_fast − (μ_fast − μ_slow) e^(−r x), slip rate x = |ȧ| (|u̇| where μ falls with it)\n\
          fₜ = τ − f₁ u/R\n\
          open: f = 0, no memory of the anchor a")
    .source("CSI Analysis Reference, T/C friction isolator; Roussis & Constantinou 2006 for tension")
    .example(r#""bearing": TensionCompressionFriction(node: "base", kn: "2e9 N/m", kt: "5e8 N/m", gap_tension: "1 mm", ks: "1e8 N/m", mu: 0.06, mu_tension: 0.12)"#)
    .exercise(Exercise::new(0.5, &[
            Stroke::about(5e-4, 1e-3).with_phase(0.25),
            Stroke::about(0.0, 0.1),
            Stroke::about(0.0, 0.0),
        ]));

    fn check(&self) -> Result<(), ParameterError> {
        one_set(
            ["mu", "mu_slow", "mu_fast", "rate"],
            [self.mu, self.mu_slow, self.mu_fast, self.rate],
        )?;
        one_set(
            ["mu_tension", "mu_slow_tension", "mu_fast_tension", "rate_tension"],
            [self.mu_tension, self.mu_slow_tension, self.mu_fast_tension, self.rate_tension],
        )
    }
}

/// One coefficient, or the three of its dependence on speed.
fn one_set(names: [&'static str; 4], given: [Option<f64>; 4]) -> Result<(), ParameterError> {
    let [mu, slow, fast, rate] = names;
    let graded = given[1..].iter().filter(|x| x.is_some()).count();
    if graded > 0 && given[0].is_some() {
        let message = format!("`{mu}` excludes `{slow}`, `{fast}` and `{rate}`");
        return Err(ParameterError::inconsistent(mu, message));
    }
    if graded == 1 || graded == 2 {
        let message = format!("`{slow}`, `{fast}` and `{rate}` go together, or give `{mu}`");
        let missing = (1..4).find(|i| given[*i].is_none()).unwrap_or(1);
        return Err(ParameterError::inconsistent(names[missing], message));
    }
    Ok(())
}

/// The coefficient that a set gives; none where nothing is given.
fn set(
    mu: Option<f64>,
    slow: Option<f64>,
    fast: Option<f64>,
    rate: Option<f64>,
) -> Option<Coefficient> {
    match (slow, fast, rate) {
        (Some(slow), Some(fast), Some(rate)) => Some(Coefficient::Velocity { slow, fast, rate }),
        _ => mu.map(|mu| Coefficient::Constant { mu }),
    }
}

impl TensionCompressionFriction {
    /// A flat bearing without clearances and friction; set the other fields as needed. Stiffnesses in
    /// compression, in tension and before slip, N/m.
    #[must_use]
    pub fn new(kn: f64, kt: f64, ks: f64) -> Self {
        Self {
            kn,
            kt,
            gap_compression: 0.0,
            gap_tension: 0.0,
            damping: 0.0,
            pull: false,
            ks,
            cs: 0.0,
            radius: 0.0,
            mu: None,
            mu_slow: None,
            mu_fast: None,
            rate: None,
            mu_tension: None,
            mu_slow_tension: None,
            mu_fast_tension: None,
            rate_tension: None,
        }
    }

    fn bearing(&self) -> Bearing {
        let axial = |kn| Axial { kn, damping: self.damping, pull: self.pull };
        let pressed = set(self.mu, self.mu_slow, self.mu_fast, self.rate)
            .unwrap_or(Coefficient::Constant { mu: 0.0 });
        let pulled =
            set(self.mu_tension, self.mu_slow_tension, self.mu_fast_tension, self.rate_tension)
                .unwrap_or(pressed);
        Bearing {
            compression: Side {
                opening: self.gap_compression,
                axial: axial(self.kn),
                friction: pressed,
            },
            tension: Some(Side {
                opening: self.gap_tension,
                axial: axial(self.kt),
                friction: pulled,
            }),
            ks: self.ks,
            cs: self.cs,
            away: None,
            dish: Dish { radius: self.radius, spherical: false },
            inclined: false,
            rise: false,
            stop: None,
        }
    }
}

impl Link for TensionCompressionFriction {
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
        engaged(self.kn.max(self.kt), self.ks, k);
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
