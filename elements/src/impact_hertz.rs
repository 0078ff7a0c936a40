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
use crate::shared::written::{Written, answers_by_law};
use serde::Deserialize;
use std::borrow::Cow;
use std::sync::OnceLock;
use trilith_element::lanes::{LaneAt, LaneContact, LaneForce, LaneLaw, LaneStep, Real};
use trilith_element::{
    Axis, Card, Category, Choices, Contact, ContactUse, Coordinates, Described, Exercise, Field,
    History, Impact, Kinematics, Link, NodeCount, ParameterError, Parameters, Stroke, history,
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
struct Touch<R> {
    speed: R,
    by_depth: R,
    by_rate: R,
}

impl<R: Real> Touch<R> {
    /// Known from before; 0: none.
    #[inline(always)]
    fn known(speed: R) -> Self {
        let zero = speed.of(0.0);
        Self { speed, by_depth: zero, by_rate: zero }
    }

    #[inline(always)]
    fn select(mask: R::Mask, yes: Self, no: Self) -> Self {
        Self {
            speed: R::select(mask, yes.speed, no.speed),
            by_depth: R::select(mask, yes.by_depth, no.by_depth),
            by_rate: R::select(mask, yes.by_rate, no.by_rate),
        }
    }

    /// Within a step from an open gap (depth ≤ 0) to a closed one, each with its rate; elsewhere it is no number.
    #[inline(always)]
    fn within([depth0, rate0]: [R; 2], [depth, rate]: [R; 2]) -> Self {
        let (zero, one, half) = (depth.of(0.0), depth.of(1.0), depth.of(0.5));
        let way = depth - depth0;
        let share = -depth0 / way;
        let speed = ((one - share) * rate0 * rate0 + share * rate * rate).sqrt();
        let by_depth = half * share * (rate0 * rate0 - rate * rate) / (way * speed);
        let it = Self { speed, by_depth, by_rate: share * rate / speed };
        Self::select(speed.le(zero), Self::known(zero), it)
    }

    /// No slower than this.
    #[inline(always)]
    fn at_least(self, speed: R) -> Self {
        Self::select(speed.lt(self.speed), self, Self::known(speed))
    }
}

/// Normal force and what it depends on.
struct Normal<R> {
    force: R,
    by_depth: R,
    by_rate: R,
    elastic: R,
}

/// The law over lanes; parameters k, n, ξ, g, s_min, m. `APPROACH`: it is that of Jankowski.
struct Law<const APPROACH: bool>;

impl<const APPROACH: bool> Law<APPROACH> {
    /// At penetration `depth` and its `rate`, after a touch.
    #[inline(always)]
    fn normal<R: Real>(p: &[R], depth: R, rate: R, touch: Touch<R>) -> Normal<R> {
        let (k, n, xi, zero, one) = (p[0], p[1], p[2], p[0].of(0.0), p[0].of(1.0));
        let closed = zero.lt(depth);
        let depth = R::select(closed, depth, one);
        let elastic = k * depth.powf(n);
        let stiffness = n * elastic / depth;
        let (acts, force, by_depth, by_rate);
        if APPROACH {
            let comes = zero.lt(rate);
            // Just at the touch the slope has no bound for n < 3: there it is linear.
            let least = k.of(TOUCH);
            let grows = depth.lt(least);
            let share = R::select(grows, depth * k.of(TOUCH.recip()), one);
            let slope = R::select(grows, one, k.of(0.5) * (n - one));
            let root = (p[5] * k * depth.max(least).powf(n - one)).sqrt();
            let c = (k.of(2.0) * xi * share * root).only(comes);
            acts = closed;
            force = elastic + c * rate;
            by_depth = stiffness + slope * c * rate / depth;
            by_rate = c;
        } else {
            let touch = touch.at_least(p[4]);
            let share = xi * rate / touch.speed;
            let by_touch = -elastic * share / touch.speed;
            acts = closed & (-one).le(share);
            force = elastic * (one + share);
            by_depth = stiffness * (one + share) + by_touch * touch.by_depth;
            by_rate = elastic * xi / touch.speed + by_touch * touch.by_rate;
        }
        Normal {
            force: force.only(acts),
            by_depth: by_depth.only(acts),
            by_rate: by_rate.only(acts),
            elastic: elastic.only(closed),
        }
    }
}

impl<const APPROACH: bool> LaneLaw for Law<APPROACH> {
    const COORDINATES: usize = 1;
    const HISTORY: usize = 1;
    const PARAMETERS: usize = 6;
    const CONTACTS: usize = 1;

    #[inline(always)]
    fn respond<R: Real>(
        at: &LaneAt<'_, R>,
        out: &mut LaneForce<'_, R>,
        trial: &mut [R],
    ) -> LaneStep<R> {
        let (p, zero) = (at.parameters, at.dt.of(0.0));
        let (depth, depth0) = (-(at.d[0] + p[3]), -(at.d0[0] + p[3]));
        let (rate, rate0) = (-at.v[0], -at.v0[0]);
        let known = Touch::known(at.history[0]);
        let first = Touch::within([depth0, rate0], [depth, rate]);
        let touch = Touch::select(zero.lt(depth0), known, first);
        let touch = Touch::select(zero.lt(depth), touch, Touch::known(zero));
        let now = Self::normal(p, depth, rate, touch);
        let start = Self::normal(p, depth0, rate0, known);
        trial[0] = touch.speed;
        (out.f[0], out.k[0], out.c[0]) = (-now.force, now.by_depth, now.by_rate);
        let (before, after) = (start.elastic - start.force, now.elastic - now.force);
        LaneStep {
            viscous: at.viscous_work(0, before, after),
            ..LaneStep::elastic(now.elastic * depth.max(zero) / (p[1] + zero.of(1.0)))
        }
    }

    #[inline(always)]
    fn contacts<R: Real>(at: &LaneAt<'_, R>, f: &[R], out: &mut [LaneContact<R>]) -> R {
        let zero = f[0].of(0.0);
        out[0] = LaneContact::smooth(at.d[0] + at.parameters[3], (-f[0]).max(zero));
        zero
    }
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

    fn law(&self) -> Written {
        match self.model {
            HertzModel::Hertzdamp => Written::of::<Law<false>>(),
            HertzModel::Jankowski => Written::of::<Law<true>>(),
        }
    }

    fn numbers(&self) -> [f64; 6] {
        let mass = self.impact_mass.unwrap_or(0.0);
        [self.k, self.exponent, self.xi(), self.opening, self.min_speed, mass]
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

    answers_by_law!();

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
