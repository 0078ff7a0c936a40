//! NLink: gap, friction and contact dashpot in one; the contact under a rigid block, a bearing, a foot.
//!
//! ```text
//!   p = −(d₁ + g)                     penetration; closed where p ≥ 0 (touching is closed)
//!   f₁ = −kₙ p + c ḋ₁                 closed, `pull`: the dashpot may hold the contact down
//!   f₁ = min(0, −kₙ p + c ḋ₁)         closed, otherwise: never pulls
//!   N  = kₙ p (`pull`),  −f₁ (otherwise)
//!   μ  = μ_fast − (μ_fast − μ_slow) e^(−r x) + (μ_static − μ_slow) (1 − s/D)⁺       D = max(s₀, 2 (μ_static − μ_slow) N/k_e)
//!   x  = |ȧ|                          slip rate;  s: slip since it last stuck
//!   τ  = k_e (dₜ − a) + cₛ (ḋₜ − ȧ), |τ| ≤ μ N      dₜ = (d₂, d₃);  k_e = kₛ − k_post;  a: anchor, slips at the limit
//!   fₜ = τ + k_post dₜ + kₙ p dₜ / R
//!   f  = 0                            open; the anchor goes with dₜ
//!   m  = r θ                          rotations about 1, 2, 3, open or closed
//! ```
//!
//! `d₁` is the extension of the link and `f₁` its tension: a closed contact has `f₁ ≤ 0` without `pull`.
//! Friction is elastic–perfectly plastic with radial return, not of Wen's type: it sticks fully below
//! the limit, and a separation wipes the anchor out. On closing, the anchor is the tangential position
//! at the moment of contact, linear in the step.
//!
//! The **slip rate** is the rate of the anchor: what the pre-slip spring stretches does not count. Where
//! friction falls with the rate (`mu_fast` < `mu_slow`) that would have no unique answer, as a spring without
//! mass lets go at any rate; there x = |ḋₜ|. **Breaking away** takes `mu_static`; it falls with the slip, to the
//! coefficient of slow slip after `static_slip`, and is back once the contact sticks. It falls no faster than half as
//! steeply as the spring behind it. The dashpot **`cs`** stretches with the spring: it damps a body that sticks, and
//! relaxes in cₛ/k_e once it slips; both together stay within μ N.
//!
//! The contact dashpot takes hold over the first nanometre of an approach, so that a joint without mass has an
//! equilibrium at the touch.
//!
//! With `restitution` the dashpot is c = 2 ζ(e) √(kₙ m), ζ(e) in closed form without gravity. The mass m
//! worked out is the share that this contact stops when all contacts of its body strike together (a flat
//! drop), or, where they cannot (stops on both sides), when it strikes alone.
//!
//! **Energy.** Stored: ½ kₙ p² + |τ|²/(2 k_e) + ½ r θ² + the work of the two restoring forces (k_post and
//! pendulum) so far. That work is history: with N changing, or with a separation while displaced, the
//! restoring forces of small displacements have no potential. Friction: ½ (τ₀ + τ₁)·Δa, which closes
//! the balance of a trapezoidal step to the last digit in stick, slip and separation alike; a step in
//! which slip reverses counts as zero at least. Dashpot: trapezoid of (f₁ + kₙ p) ḋ₁.
//!
//! Reference: \[Wilson 2002, ch. 18 and 21\]; velocity dependence \[Constantinou et al. 1990\]; static
//! friction that is lost over a length of slip \[Rabinowicz 1951\].

mod contact;
mod law;
#[cfg(test)]
mod motion;
#[cfg(test)]
mod tests;

pub(crate) use contact::{NLinkContact, PARAMETERS as CONTACT_PARAMETERS};
pub use law::{NLinkHistory, NLinkRubbing};

use serde::Deserialize;
use trilith_element::{
    Axis, Card, Category, Described, Exercise, NodeCount, ParameterError, Parameters, Stroke,
};

/// Gap, friction and contact dashpot in one; the law is in `law.rs` beside this file.
#[derive(Clone, Debug, Deserialize, Parameters)]
#[serde(deny_unknown_fields)]
pub struct NLink {
    /// contact stiffness
    #[parameter("kₙ", unit = "N/m", range = Positive)]
    pub kn: f64,
    /// clearance at rest (negative: interference)
    #[parameter("g", unit = "m", default = 0.0)]
    #[serde(default)]
    pub opening: f64,
    /// contact dashpot, acts only while closed
    #[parameter("c", unit = "N·s/m", range = NonNegative, default = 0.0)]
    #[serde(default)]
    pub damping: f64,
    /// instead of `damping`: speed after over speed before an impact
    #[parameter("e", unit = "1", range = Above(0.0, 1.0))]
    pub restitution: Option<f64>,
    /// mass that strikes, for `restitution`; none: worked out from the structure
    #[parameter("m", unit = "kg", range = Positive)]
    pub impact_mass: Option<f64>,
    /// the dashpot may pull while the gap is closed
    #[parameter]
    #[serde(default)]
    pub pull: bool,
    /// friction coefficient; none: no friction
    #[parameter("μ", unit = "1", range = NonNegative)]
    pub mu: Option<f64>,
    /// instead of `mu`: friction coefficient at rest
    #[parameter("μ_slow", unit = "1", range = NonNegative)]
    pub mu_slow: Option<f64>,
    /// instead of `mu`: friction coefficient at speed
    #[parameter("μ_fast", unit = "1", range = NonNegative)]
    pub mu_fast: Option<f64>,
    /// rate at which μ goes from slow to fast
    #[parameter("r", unit = "s/m", range = NonNegative)]
    pub rate: Option<f64>,
    /// friction coefficient before it breaks away; none: that of slow slip
    #[parameter("μ_static", unit = "1", range = NonNegative)]
    pub mu_static: Option<f64>,
    /// slip over which `mu_static` is gone; 0: as soon as the spring `ks` can follow
    #[parameter("s₀", unit = "m", range = NonNegative, default = 0.0)]
    #[serde(default)]
    pub static_slip: f64,
    /// pre-slip stiffness; required with friction
    #[parameter("kₛ", unit = "N/m", range = Positive)]
    pub ks: Option<f64>,
    /// dashpot beside the spring `ks`: damps a contact that sticks
    #[parameter("cₛ", unit = "N·s/m", range = NonNegative, default = 0.0)]
    #[serde(default)]
    pub cs: f64,
    /// post-slip stiffness, less than `ks`
    #[parameter("k_post", unit = "N/m", range = NonNegative, default = 0.0)]
    #[serde(default)]
    pub k_post: f64,
    /// radius of a pendulum surface; 0 is flat
    #[parameter("R", unit = "m", range = NonNegative, default = 0.0)]
    #[serde(default)]
    pub radius: f64,
    /// linear rotational spring, open or closed
    #[parameter("r₁", unit = "N·m/rad", range = NonNegative, default = 0.0)]
    #[serde(default)]
    pub r1: f64,
    /// linear rotational spring, open or closed
    #[parameter("r₂", unit = "N·m/rad", range = NonNegative, default = 0.0)]
    #[serde(default)]
    pub r2: f64,
    /// linear rotational spring, open or closed
    #[parameter("r₃", unit = "N·m/rad", range = NonNegative, default = 0.0)]
    #[serde(default)]
    pub r3: f64,
}

impl Described for NLink {
    const CARD: Card = Card::new(
        "NLink",
        Category::Link,
        "Contact: gap with dashpot along local 1, coupled friction along local 2 and 3.",
    )
    .nodes(NodeCount::GROUND_OR_TWO)
    .parameters(Self::PARAMETERS)
    .law("p = −(d₁ + g), closed where p ≥ 0\n\
          f₁ = −kₙ p + c ḋ₁, without `pull` at most 0\n\
          N = kₙ p with `pull`, −f₁ without\n\
          with `restitution`: c = 2 ζ(e) √(kₙ m)\n\
          μ = μ_fast − (μ_fast − μ_slow) e^(−r x) + (μ_static − μ_slow) (1 − s/D)⁺,  D = max(s₀, 2 (μ_static − μ_slow) N/kₑ)\n\
          x: slip rate |ȧ| (|ḋₜ| where μ_fast < μ_slow), s: slip since it last stuck\n\
          τ = kₑ (dₜ − a) + cₛ (ḋₜ − ȧ), |τ| ≤ μ N, kₑ = kₛ − k_post (radial return)\n\
          fₜ = τ + k_post dₜ + kₙ p dₜ/R\n\
          open: f = 0, no memory of the anchor a")
    .source("Wilson, Static and Dynamic Analysis of Structures, 2002, ch. 18 and 21; \
             Constantinou, Mokha, Reinhorn 1990 for μ(v); \
             Rabinowicz 1951 for static friction lost over a slip")
    .example(r#""left": NLink(node: "left", kn: "5e8 N/m", ks: "5e8 N/m", mu: 0.4)"#)
    .exercise(Exercise::new(1.0, &[
            Stroke::about(-1e-3, 0.0),
            Stroke::about(0.0, 2e-3),
            Stroke::about(0.0, 0.0),
        ]));

    fn check(&self) -> Result<(), ParameterError> {
        if self.restitution.is_some() && self.damping != 0.0 {
            let message = "`restitution` sets the dashpot: leave `damping` out, or `restitution`";
            return Err(ParameterError::inconsistent("restitution", message));
        }
        if self.impact_mass.is_some() && self.restitution.is_none() {
            let message = "`impact_mass` belongs to `restitution`: give both, or `damping`";
            return Err(ParameterError::inconsistent("impact_mass", message));
        }
        let graded = [self.mu_slow, self.mu_fast, self.rate];
        if graded.iter().any(Option::is_some) {
            if self.mu.is_some() {
                let message =
                    "`mu` excludes `mu_slow`, `mu_fast` and `rate`: give one or the others";
                return Err(ParameterError::inconsistent("mu", message));
            }
            if !graded.iter().all(Option::is_some) {
                let message =
                    "`mu_slow`, `mu_fast` and `rate` go together: give all three, or `mu`";
                let name = if self.mu_slow.is_some() { "mu_slow" } else { "mu_fast" };
                return Err(ParameterError::inconsistent(name, message));
            }
        }
        let slow = self.mu_slow.or(self.mu).unwrap_or(0.0);
        match self.mu_static {
            Some(mu) if mu < slow => {
                let message = format!("a contact breaks away at least at the {slow} of slow slip");
                return Err(ParameterError::inconsistent("mu_static", message));
            }
            None if self.static_slip > 0.0 => {
                let message = "`static_slip` belongs to `mu_static`: give both, or none";
                return Err(ParameterError::inconsistent("static_slip", message));
            }
            _ => {}
        }
        if self.cs > 0.0 && self.ks.is_none() {
            let message = "the dashpot `cs` is beside the pre-slip spring: give `ks` as well";
            return Err(ParameterError::inconsistent("cs", message));
        }
        match self.ks {
            None if self.has_friction() => Err(ParameterError::inconsistent(
                "ks",
                "a link with friction needs the pre-slip stiffness `ks`, such as the value of `kn`",
            )),
            Some(ks) if self.k_post >= ks => Err(ParameterError::inconsistent(
                "k_post",
                format!("`k_post` = {} N/m must be less than `ks` = {ks} N/m", self.k_post),
            )),
            _ => Ok(()),
        }
    }
}

impl NLink {
    /// A frictionless contact of stiffness `kn` (N/m); set the other fields as needed.
    #[must_use]
    pub fn new(kn: f64) -> Self {
        Self {
            kn,
            opening: 0.0,
            damping: 0.0,
            restitution: None,
            impact_mass: None,
            pull: false,
            mu: None,
            mu_slow: None,
            mu_fast: None,
            rate: None,
            mu_static: None,
            static_slip: 0.0,
            ks: None,
            cs: 0.0,
            k_post: 0.0,
            radius: 0.0,
            r1: 0.0,
            r2: 0.0,
            r3: 0.0,
        }
    }

    fn has_friction(&self) -> bool {
        [self.mu, self.mu_slow, self.mu_fast, self.mu_static]
            .iter()
            .any(|m| m.is_some_and(|m| m > 0.0))
    }

    /// The rotational springs that exist.
    fn rotational(&self) -> impl Iterator<Item = (Axis, f64)> {
        [(Axis::R1, self.r1), (Axis::R2, self.r2), (Axis::R3, self.r3)]
            .into_iter()
            .filter(|(_, r)| *r > 0.0)
    }
}
