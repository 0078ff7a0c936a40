//! SoilSpring: soil beside a pile or behind a wall, pressed along a p–y curve, that keeps its dent: a gap opens.
//!
//! ```text
//!   p │        ___ backbone B(x)         a face on each side, x = ±d − opening:
//!     │    ●‾‾‾                          first pressing   p = B(x)
//!     │   /│ kᵤ                          back and again   p = max(0, B(y) − kᵤ (y − x)),  y: deepest x so far
//!     │  / │                             open, gap        p = 0,  x < e = y − B(y)/kᵤ
//!     └──────●───── x
//!     0     e    y                       f = p⁺ − p⁻ + q,  |q| ≤ p_d: drag along the sides
//!
//!   Hyperbolic  B = k x/(1 + k x/p_u)          half of p_u at p_u/k
//!   Sand        B = p_u tanh(k x/p_u)
//! ```
//!
//! Forces are those of the length of pile that the spring stands for: p–y curves give them by metre. Nothing caves in: soil that
//! stands, as in clay, keeps its face where it was pressed to. Water, cyclic loss of strength and radiation are not part of it; a `Dashpot` beside
//! it radiates.
//!
//! The force follows from the deepest points and from where the drag stuck, so that a step is exact however long.
//!
//! **Energy.** Stored p²/2kᵤ of each face and q²/2k_d, what they give back; hysteretic ∫B dx less what is stored, as a face is pressed
//! deeper, and p_d times the slip: neither ever falls, since B is nowhere steeper than kᵤ.
//!
//! Reference: \[Matlock, Foo & Bryant 1978\] (faces that part from the pile on each side, with side friction); \[Kondner 1963\] (hyperbola);
//! \[API RP 2GEO 2011, §8.5\] (sand); one face of it is OpenSees' `HyperbolicGapMaterial`. In \[Boulanger et al. 1999\] the gap
//! is a spring in series whose memory moves with what it carries, which leaves open where its energy goes; hence this one.

#[cfg(test)]
mod tests;

use crate::shared::written::{Written, answers_by_law};
use serde::Deserialize;
use std::borrow::Cow;
use trilith_element::lanes::{LaneAt, LaneForce, LaneLaw, LaneStep, Real};
use trilith_element::{
    Axis, Card, Category, Choices, Coordinates, Described, Exercise, Field, History, Link,
    NodeCount, ParameterError, Parameters, Stroke, history,
};

/// First pressing of a [`SoilSpring`].
#[derive(Clone, Copy, Debug, PartialEq, Eq, Deserialize, Choices)]
pub enum Backbone {
    /// Kondner's hyperbola.
    Hyperbolic,
    /// The hyperbolic tangent that API gives for sand.
    Sand,
}

/// Sides on which a [`SoilSpring`] has soil.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Deserialize, Choices)]
pub enum Sides {
    /// Both.
    Both,
    /// Where the deformation is positive.
    Positive,
    /// Where it is negative.
    Negative,
}

/// p–y spring with a gap.
#[derive(Clone, Debug, Deserialize, Parameters)]
#[serde(deny_unknown_fields)]
pub struct SoilSpring {
    /// stiffness where pressing begins
    #[parameter("k", unit = "N/m", range = Positive)]
    pub k: f64,
    /// ultimate resistance of a side
    #[parameter("p_u", unit = "N", range = Positive)]
    pub pu: f64,
    /// first pressing: Kondner's hyperbola, or API's hyperbolic tangent for sand
    #[parameter(choices = Backbone::NAMES, default = "Hyperbolic")]
    pub backbone: Backbone,
    /// stiffness back and again, at least `k`; none: `k`
    #[parameter("kᵤ", unit = "N/m", range = Positive)]
    pub ku: Option<f64>,
    /// clearance before the soil on each side
    #[parameter(unit = "m", range = NonNegative, default = 0.0)]
    pub opening: f64,
    /// where soil is: at which deformations it presses
    #[parameter(choices = Sides::NAMES, default = "Both")]
    pub sides: Sides,
    /// friction along the sides, in the gap as well
    #[parameter("p_d", unit = "N", range = NonNegative, default = 0.0)]
    pub drag: f64,
    /// stiffness before it slips; none: `k`
    #[parameter("k_d", unit = "N/m", range = Positive)]
    pub drag_stiffness: Option<f64>,
    /// local axis
    #[parameter(choices = ["U1", "U2", "U3"], default = "U2")]
    pub axis: Axis,
}

history! {
    /// History of a [`SoilSpring`].
    pub struct SoilHistory {
        /// How deep the face at positive deformations has been pressed.
        pub deepest_up: "m",
        /// How deep the other one has been.
        pub deepest_down: "m",
        /// Slip of the drag.
        pub slip: "m",
    }
}

impl Described for SoilSpring {
    const CARD: Card = Card::new(
        "SoilSpring",
        Category::Link,
        "Soil beside a pile or behind a wall: p–y curve, elastic return, a gap that opens, drag.",
    )
    .nodes(NodeCount::GROUND_OR_TWO)
    .parameters(Self::PARAMETERS)
    .law("each face, x = ±d − opening, deepest y: p = B(x) where x ≥ y, else max(0, B(y) − kᵤ (y − x))\n\
          Hyperbolic: B = k x/(1 + k x/p_u);  Sand: B = p_u tanh(k x/p_u)\n\
          f = p⁺ − p⁻ + q,  q = k_d (d − s), |q| ≤ p_d")
    .source("Matlock, Foo & Bryant 1978; Kondner 1963; API RP 2GEO 2011, §8.5")
    .example(r#""soil": SoilSpring(node: "pile", k: "20 MN/m", pu: "150 kN", drag: "15 kN")"#)
    .exercise(Exercise::new(0.5, &[Stroke::about(0.0, 0.03)]));

    fn check(&self) -> Result<(), ParameterError> {
        match self.ku {
            Some(ku) if ku < self.k => Err(ParameterError::inconsistent(
                "ku",
                format!(
                    "`ku` = {ku:.4e} N/m would give back more than was put in: must be at least `k` = {:.4e} N/m",
                    self.k
                ),
            )),
            _ => Ok(()),
        }
    }
}

const PARAMETERS: usize = 9;

impl SoilSpring {
    fn law(&self) -> Written {
        Written::of::<Law>().still()
    }

    /// k, kᵤ, p_u, opening, soil upwards, soil downwards, sand, k_d, p_d.
    fn numbers(&self) -> [f64; PARAMETERS] {
        let one = |yes: bool| f64::from(u8::from(yes));
        [
            self.k,
            self.ku.unwrap_or(self.k),
            self.pu,
            self.opening,
            one(self.sides != Sides::Negative),
            one(self.sides != Sides::Positive),
            one(self.backbone == Backbone::Sand),
            self.drag_stiffness.unwrap_or(self.k),
            self.drag,
        ]
    }
}

impl Link for SoilSpring {
    fn coordinates(&self) -> Coordinates {
        Coordinates::Local(vec![self.axis])
    }

    fn history(&self) -> Cow<'static, [Field]> {
        SoilHistory::FIELDS.into()
    }

    fn uses_rates(&self) -> bool {
        false
    }

    fn engaged_stiffness(&self, k: &mut [f64]) {
        let drag = if self.drag > 0.0 { self.drag_stiffness.unwrap_or(self.k) } else { 0.0 };
        k[0] = self.ku.unwrap_or(self.k) + drag;
    }

    answers_by_law!();
}

/// The first pressing of a face.
#[derive(Clone, Copy)]
struct Pressing<R> {
    k: R,
    pu: R,
    sand: R,
}

impl<R: Real> Pressing<R> {
    /// Force and slope at x ≥ 0.
    #[inline(always)]
    fn at(&self, x: R) -> [R; 2] {
        let (zero, one) = (x.of(0.0), x.of(1.0));
        let sand = zero.lt(self.sand);
        let s = self.k * x / self.pu;
        let part = one / (one + s);
        let mut share = s * part;
        let mut slope = part * part;
        if x.any(sand) {
            let tanh = s.map(f64::tanh);
            share = R::select(sand, tanh, share);
            slope = R::select(sand, one - tanh * tanh, slope);
        }
        [self.pu * share, self.k * slope]
    }

    /// ∫ of the force from 0 to x ≥ 0, J.
    #[inline(always)]
    fn area(&self, x: R) -> R {
        let sand = x.of(0.0).lt(self.sand);
        let s = self.k * x / self.pu;
        let mut area = s - s.map(f64::ln_1p);
        if x.any(sand) {
            // ln cosh s, where cosh may overflow.
            let curved = s.map(|s| s + (-2.0 * s).exp().ln_1p() - std::f64::consts::LN_2);
            area = R::select(sand, curved, area);
        }
        self.pu * self.pu / self.k * area
    }
}

/// What a face does.
struct Face<R> {
    p: R,
    slope: R,
    deepest: R,
    stored: R,
    heat: R,
}

impl<R: Real> Face<R> {
    /// `d` counted towards the soil.
    #[inline(always)]
    fn of(p: &[R], there: R, d: R, deepest: R) -> Self {
        let (zero, half) = (d.of(0.0), d.of(0.5));
        let (ku, soil) = (p[1], zero.lt(there));
        let pressing = Pressing { k: p[0], pu: p[2], sand: p[6] };
        let x = d - p[3];
        let deeper = deepest.lt(x) & soil;
        let y = R::select(deeper, x, deepest);
        let [top, slope] = pressing.at(y);
        let back = top - ku * (y - x);
        let touches = zero.lt(back) & soil;
        let force = back.only(touches);
        let slope = R::select(deeper, slope, ku.only(touches));
        let elastic = |f: R| half * f * f / ku;
        let mut heat = zero;
        if d.any(deeper) {
            let before = pressing.at(deepest)[0];
            let work = pressing.area(y) - pressing.area(deepest);
            heat = (work - (elastic(top) - elastic(before))).max(zero).only(deeper);
        }
        Self { p: force, slope, deepest: y, stored: elastic(force), heat }
    }
}

/// The law over lanes.
struct Law;

impl LaneLaw for Law {
    const COORDINATES: usize = 1;
    const HISTORY: usize = 3;
    const PARAMETERS: usize = PARAMETERS;
    const IS_LONG: bool = true;

    #[inline(always)]
    fn respond<R: Real>(
        at: &LaneAt<'_, R>,
        out: &mut LaneForce<'_, R>,
        trial: &mut [R],
    ) -> LaneStep<R> {
        let (p, h, d) = (at.parameters, at.history, at.d[0]);
        let (zero, half) = (d.of(0.0), d.of(0.5));
        let up = Face::of(p, p[4], d, h[0]);
        let down = Face::of(p, p[5], -d, h[1]);
        let (kd, pd) = (p[7], p[8]);
        let elastic = kd * (d - h[2]);
        let sticks = elastic.abs().lt(pd);
        let q = elastic.min(pd).max(-pd);
        let slip = R::select(sticks, h[2], d - q / kd);
        out.f[0] = up.p - down.p + q;
        out.k[0] = up.slope + down.slope + kd.only(sticks);
        out.c[0] = zero;
        (trial[0], trial[1], trial[2]) = (up.deepest, down.deepest, slip);
        LaneStep {
            hysteretic: up.heat + down.heat + pd * (slip - h[2]).abs(),
            ..LaneStep::elastic(up.stored + down.stored + half * q * q / kd)
        }
    }
}
