//! Impact element with a Hertz spring and nonlinear damping, for pounding.
//!
//! ```text
//!   δ = −(d + g): penetration,  δ̇ = −ḋ;   f = −N,  N = 0 where δ ≤ 0, and never negative
//!   Hertzdamp:  N = k δⁿ (1 + ξ δ̇/s)              s: speed at first touch, s_min at least
//!   Jankowski:  N = k δⁿ + 2 ξ √(m k δⁿ⁻¹) δ̇      where δ̇ > 0, else k δⁿ
//! ```
//!
//! ξ(e) is the exact solution of the impact of a mass, for any n and speed:
//!
//! ```text
//!   Hertzdamp:  ξ (1 + e) = ln((1 + ξ)/(1 − ξ e))
//!   Jankowski:  ln e = −ζ acos(ζ)/√(1 − ζ²),  ξ = ζ √((n + 1)/2)
//! ```
//!
//! (v dv/dδ = −N/m separates for the first; with z = δ^((n+1)/2) the second is a linear oscillator.)
//! Near e = 1 the first is ξ = ¾ (1 − e²) \[Lankarani & Nikravesh 1990\]; OpenSees' `Hertzdamp` takes the
//! same ξ as a number, for which its manual has 8(1 − e)/(5e), and `JankowskiImpact` takes the second, in
//! an approximation.
//!
//! The dashpot of `Jankowski` grows linearly over the first nanometre.
//!
//! s is the speed at the moment the gap closes, as in the source, and stays for as long as it is closed; a new
//! touch has a speed of its own. A contact that never closed (at rest, or led together by a static case) has
//! s_min: where it is pressed together later, it damps as an impact at that speed does. Below `min_speed`
//! impacts return more than e. Where the gap closes within a step, s is that of a motion of constant
//! acceleration between its ends:
//!
//! ```text
//!   s² = (1 − r) δ̇₀² + r δ̇₁²,   r = δ₀/(δ₀ − δ₁)
//! ```
//!
//! Reference: \[Muthukumar & DesRoches 2006\], \[Jankowski 2005\].

use crate::shared::restitution::approach_ratio;
use crate::shared::touch::TOUCH;
use serde::Deserialize;
use std::borrow::Cow;
use std::sync::OnceLock;
use trilith_element::{
    Axis, Card, Category, Choices, Contact, ContactUse, Coordinates, Described, Exercise, Field,
    History, Impact, Kinematics, Link, NodeCount, ParameterError, Parameters, Response, Stroke,
    history,
};

/// How an [`ImpactHertz`] dissipates.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Deserialize, Choices)]
pub enum HertzModel {
    /// In proportion to the elastic force and the rate over the speed of approach.
    Hertzdamp,
    /// On approach only, as a dashpot that follows the tangent stiffness.
    Jankowski,
}

/// Hertz spring with nonlinear damping in contact.
#[derive(Clone, Debug, Deserialize, Parameters)]
#[serde(deny_unknown_fields)]
pub struct ImpactHertz {
    /// contact stiffness
    #[parameter("k", unit = "N", per = "m", exponent = "exponent", range = Positive)]
    pub k: f64,
    /// exponent of the penetration
    #[parameter("n", unit = "1", range = Within(1.0, 3.0), default = 1.5)]
    pub exponent: f64,
    /// how it dissipates
    #[parameter(choices = HertzModel::NAMES, default = "Hertzdamp")]
    pub model: HertzModel,
    /// speed after over speed before an impact
    #[parameter("e", unit = "1", range = Above(0.0, 1.0))]
    pub restitution: Option<f64>,
    /// instead of `restitution`: the damping itself
    #[parameter("ξ", unit = "1", range = NonNegative)]
    pub xi: Option<f64>,
    /// mass that strikes, for `restitution`; none: worked out from the structure
    #[parameter("m", unit = "kg", range = Positive)]
    pub impact_mass: Option<f64>,
    /// clearance at rest
    #[parameter("g", unit = "m", default = 0.0)]
    pub opening: f64,
    /// Hertzdamp: slower approaches damp as this one does
    #[parameter("s_min", unit = "m/s", range = Positive, default = 0.001)]
    pub min_speed: f64,
    /// local axis
    #[parameter(choices = ["U1", "U2", "U3"], default = "U1")]
    pub axis: Axis,
    /// ξ, worked out once.
    #[serde(skip)]
    damping: OnceLock<f64>,
}

history! {
    /// History of a contact that remembers its first touch.
    struct Approach {
        /// Speed at which this contact closed; 0 while open.
        speed: "m/s",
    }
}

/// Penetration at which the stiffness of the dummies is taken, m.
const TYPICAL: f64 = 1e-3;

impl Described for ImpactHertz {
    const CARD: Card = Card::new(
        "ImpactHertz",
        Category::Link,
        "Pounding: Hertz spring with nonlinear damping after a clearance.",
    )
    .nodes(NodeCount::GROUND_OR_TWO)
    .parameters(Self::PARAMETERS)
    .law("δ = −(d + g), δ̇ = −ḋ; f = −N where δ > 0, else 0; N ≥ 0\n\
          Hertzdamp: N = k δⁿ (1 + ξ δ̇/s), ξ (1 + e) = ln((1 + ξ)/(1 − ξ e)), s: δ̇ at first touch, s_min at least\n\
          Jankowski: N = k δⁿ + 2 ξ √(m k δⁿ⁻¹) δ̇ where δ̇ > 0, else k δⁿ")
    .source("Muthukumar & DesRoches 2006; Jankowski 2005; Lankarani & Nikravesh 1990")
    .example(r#""joint": ImpactHertz(nodes: ("a", "b"), k: "2000 MN/m^1.5", restitution: 0.65, opening: "20 mm")"#)
    .exercise(Exercise::new(1.0, &[Stroke::about(0.0, 0.03)]));

    fn check(&self) -> Result<(), ParameterError> {
        let (name, message) = if self.restitution.is_some() == self.xi.is_some() {
            ("restitution", "give either `restitution` or `xi`")
        } else if self.model == HertzModel::Hertzdamp && self.impact_mass.is_some() {
            ("impact_mass", "`Hertzdamp` needs no mass: leave `impact_mass` out")
        } else if self.model == HertzModel::Jankowski
            && self.xi.is_some()
            && self.impact_mass.is_none()
        {
            ("impact_mass", "`Jankowski` with `xi` needs the `impact_mass`")
        } else {
            return Ok(());
        };
        Err(ParameterError::inconsistent(name, message))
    }
}

/// ξ of `Hertzdamp` at which a mass returns with e.
fn hertz_damping(e: f64) -> f64 {
    if e >= 1.0 {
        return 0.0;
    }
    // Negative up to the root, which lies beyond 1.5 (1 − e²)/(1 + e³)/2 and below the pole 1/e.
    let excess = |x: f64| ((1.0 + x) / (1.0 - x * e)).ln() - x * (1.0 + e);
    let (mut low, mut high) = (0.75 * (1.0 - e * e) / (1.0 + e * e * e), 1.0 / e);
    loop {
        let middle = 0.5 * (low + high);
        if middle <= low || middle >= high {
            return middle;
        }
        if excess(middle) < 0.0 { low = middle } else { high = middle }
    }
}

/// ξ of `Jankowski` at which a mass returns with e.
fn approach_damping(e: f64, n: f64) -> f64 {
    approach_ratio(e) * (0.5 * (n + 1.0)).sqrt()
}

/// Speed at first touch, as far as it is known, and how it depends on the end of a step in which it happens.
#[derive(Clone, Copy)]
struct Touch {
    speed: f64,
    by_depth: f64,
    by_rate: f64,
}

impl Touch {
    /// Known from before; 0: none.
    fn known(speed: f64) -> Self {
        Self { speed, by_depth: 0.0, by_rate: 0.0 }
    }

    /// Within a step from an open gap (depth ≤ 0) to a closed one, each with its rate.
    fn within([depth0, rate0]: [f64; 2], [depth, rate]: [f64; 2]) -> Self {
        let way = depth - depth0;
        let share = -depth0 / way;
        let speed = ((1.0 - share) * rate0 * rate0 + share * rate * rate).sqrt();
        if speed == 0.0 {
            return Self::known(0.0);
        }
        let by_depth = 0.5 * share * (rate0 * rate0 - rate * rate) / (way * speed);
        Self { speed, by_depth, by_rate: share * rate / speed }
    }

    /// No slower than this.
    fn at_least(self, speed: f64) -> Self {
        if self.speed > speed { self } else { Self::known(speed) }
    }
}

/// Normal force and what it depends on.
struct Normal {
    force: f64,
    by_depth: f64,
    by_rate: f64,
    elastic: f64,
}

impl ImpactHertz {
    fn xi(&self) -> f64 {
        *self.damping.get_or_init(|| match (self.xi, self.restitution) {
            (Some(xi), _) => xi,
            (None, Some(e)) if self.model == HertzModel::Hertzdamp => hertz_damping(e),
            (None, Some(e)) => approach_damping(e, self.exponent),
            _ => 0.0,
        })
    }

    /// At penetration `depth` and its `rate`, after a touch.
    fn normal(&self, depth: f64, rate: f64, touch: Touch) -> Normal {
        if depth <= 0.0 {
            return Normal { force: 0.0, by_depth: 0.0, by_rate: 0.0, elastic: 0.0 };
        }
        let (n, xi) = (self.exponent, self.xi());
        let elastic = self.k * depth.powf(n);
        let stiffness = n * elastic / depth;
        match self.model {
            HertzModel::Hertzdamp => {
                let touch = touch.at_least(self.min_speed);
                let share = xi * rate / touch.speed;
                if share < -1.0 {
                    return Normal { force: 0.0, by_depth: 0.0, by_rate: 0.0, elastic };
                }
                let by_touch = -elastic * share / touch.speed;
                let by_depth = stiffness * (1.0 + share) + by_touch * touch.by_depth;
                let by_rate = elastic * xi / touch.speed + by_touch * touch.by_rate;
                Normal { force: elastic * (1.0 + share), by_depth, by_rate, elastic }
            }
            HertzModel::Jankowski if rate > 0.0 => {
                let mass = self.impact_mass.unwrap_or(0.0);
                // Just at the touch the slope has no bound for n < 3: there it is linear.
                let (share, slope) =
                    if depth < TOUCH { (depth / TOUCH, 1.0) } else { (1.0, 0.5 * (n - 1.0)) };
                let root = (mass * self.k * depth.max(TOUCH).powf(n - 1.0)).sqrt();
                let c = 2.0 * xi * share * root;
                let by_depth = stiffness + slope * c * rate / depth;
                Normal { force: elastic + c * rate, by_depth, by_rate: c, elastic }
            }
            HertzModel::Jankowski => {
                Normal { force: elastic, by_depth: stiffness, by_rate: 0.0, elastic }
            }
        }
    }
}

impl Link for ImpactHertz {
    fn coordinates(&self) -> Coordinates {
        Coordinates::Local(vec![self.axis])
    }

    fn history(&self) -> Cow<'static, [Field]> {
        Cow::Borrowed(Approach::FIELDS)
    }

    fn engaged_stiffness(&self, k: &mut [f64]) {
        k[0] = self.exponent * self.k * TYPICAL.powf(self.exponent - 1.0);
    }

    fn respond(
        &self,
        at: &Kinematics<'_>,
        committed: &[f64],
        trial: &mut [f64],
        out: &mut Response<'_>,
    ) {
        let (depth, depth0) = (-(at.d[0] + self.opening), -(at.d0[0] + self.opening));
        let known = Touch::known(Approach::load(committed).speed);
        let touch = if depth <= 0.0 {
            Touch::known(0.0)
        } else if depth0 > 0.0 {
            known
        } else {
            Touch::within([depth0, -at.v0[0]], [depth, -at.v[0]])
        };
        let now = self.normal(depth, -at.v[0], touch);
        let start = self.normal(depth0, -at.v0[0], known);
        Approach { speed: touch.speed }.store(trial);
        (out.f[0], out.k[0], out.c[0]) = (-now.force, now.by_depth, now.by_rate);
        out.energy.stored = now.elastic * depth.max(0.0) / (self.exponent + 1.0);
        let (before, after) = (start.elastic - start.force, now.elastic - now.force);
        out.energy.viscous = at.viscous_work(0, before, after);
    }

    fn impact(&self) -> Option<Impact> {
        // Only a law that waits for a mass takes part: there is no linear stiffness to speak of.
        let waits = self.model == HertzModel::Jankowski && self.restitution.is_some();
        waits.then_some(Impact::new(0, self.k, 0.0).restituting(self.restitution, self.impact_mass))
    }

    fn restituting(&self, restitution: f64, mass: f64) -> Option<Box<dyn Link>> {
        self.impact()?;
        let xi = Some(approach_damping(restitution, self.exponent));
        let (restitution, impact_mass, damping) = (None, Some(mass), OnceLock::new());
        Some(Box::new(Self { xi, restitution, impact_mass, damping, ..self.clone() }))
    }

    fn contact_use(&self) -> ContactUse {
        ContactUse::Stop
    }

    fn contacts(&self, at: &Kinematics<'_>, _: &[f64], f: &[f64], out: &mut Vec<Contact>) {
        let gap = at.d[0] + self.opening;
        out.push(Contact::new(gap, (-f[0]).max(0.0)));
    }
}

#[cfg(test)]
mod tests;
