//! PMMHinge: plastic hinge of a beam or column in which axial force and both bending moments interact.
//!
//! ```text
//!   f = r k d + q,   q = (1 − r) k (d − p)              d, p, f along U1, about R2 and R3; k diagonal
//!   Φ(q) = |x₁|^a + |x₂|^b + |x₃|^c ≤ 1,   xᵢ = qᵢ/((1 − r) Sᵢ),   S = (P_y, M_p2, M_p3)
//!   ṗ = λ ∂Φ/∂q,   λ ≥ 0,   λ > 0 only where Φ = 1                   p = 0 at rest
//! ```
//!
//! The surface is a superellipsoid: convex with any exponents from 1 on, smooth but for ridges at 1, and made of one
//! term for each force, so that sections are told apart by three numbers that tests of plastic sections give. A solid
//! rectangle about one axis is p² + m = 1 (a = 2, c → 1), a thin round tube nearly an ellipsoid (2, 2, 2). Orbison's
//! polynomial is for one family of I-shapes alone, and is not convex everywhere it is asked about.
//! The strength is the same in tension and compression.
//!
//! A step is the closest-point projection of the elastic trial force on the surface in the norm of the elastic energy (implicit
//! Euler), with its consistent tangent. With one unknown λ each force follows from xᵢ + λ κᵢ ∂Φ/∂xᵢ = tᵢ, of which the logarithm is
//! solved by Newton's method from above; λ from Φ^(−½) = 1, which is straight where the forces shrink alike.
//!
//! **Energy.** Stored ½ r d·k d + ½ q·q/((1 − r) k), hysteretic ½ (q₀ + q)·Δp: the trapezoid of the step, so that work and energies
//! agree to the last digit at any step. It is never negative, as q·Δp is the largest of all forces within the surface, −q₀ among them.
//!
//! Reference: \[Simo & Hughes 1998, §3.6\] (projection, tangent); \[Orbison, McGuire & Abel 1982\], \[Powell & Chen 1986\] (hinges of
//! this kind in frames).

mod project;
#[cfg(test)]
mod tests;

use crate::shared::written::{Written, answers_by_law};
use project::Projected;
use serde::Deserialize;
use std::borrow::Cow;
use trilith_element::lanes::{LaneAt, LaneForce, LaneLaw, LaneStep, Real};
use trilith_element::{
    Axis, Card, Category, Coordinates, Described, Exercise, Field, History, Link, NodeCount,
    ParameterError, Parameters, Stroke, history,
};

/// Plastic hinge with interaction of axial force and both moments.
#[derive(Clone, Debug, Deserialize, Parameters)]
#[serde(deny_unknown_fields)]
pub struct PMMHinge {
    /// elastic, along U1
    #[parameter("k₁", unit = "N/m", range = Positive)]
    pub axial: f64,
    /// elastic, about R2
    #[parameter("k₂", unit = "N·m/rad", range = Positive)]
    pub bending2: f64,
    /// elastic, about R3
    #[parameter("k₃", unit = "N·m/rad", range = Positive)]
    pub bending3: f64,
    /// axial strength without moments
    #[parameter("P_y", unit = "N", range = Positive)]
    pub py: f64,
    /// strength about R2 alone
    #[parameter("M_p2", unit = "N·m", range = Positive)]
    pub mp2: f64,
    /// strength about R3 alone
    #[parameter("M_p3", unit = "N·m", range = Positive)]
    pub mp3: f64,
    /// exponent of the axial force
    #[parameter("a", unit = "1", range = Within(1.2, 8.0), default = 2.0)]
    pub exponent_p: f64,
    /// exponent of the moment about R2
    #[parameter("b", unit = "1", range = Within(1.2, 8.0), default = 2.0)]
    pub exponent_m2: f64,
    /// exponent of the moment about R3
    #[parameter("c", unit = "1", range = Within(1.2, 8.0), default = 2.0)]
    pub exponent_m3: f64,
    /// stiffness after yielding over elastic stiffness, below 1
    #[parameter("r", unit = "1", range = Within(0.0, 1.0), default = 0.0)]
    pub ratio: f64,
}

history! {
    /// History of a [`PMMHinge`].
    pub struct PMMHistory {
        /// Plastic elongation.
        pub plastic1: "m",
        /// Plastic rotation about R2.
        pub plastic2: "rad",
        /// Plastic rotation about R3.
        pub plastic3: "rad",
    }
}

impl Described for PMMHinge {
    const CARD: Card = Card::new(
        "PMMHinge",
        Category::Link,
        "Plastic hinge with interaction of axial force and both moments (P-M2-M3), by return mapping.",
    )
    .nodes(NodeCount::GROUND_OR_TWO)
    .parameters(Self::PARAMETERS)
    .law("f = r k d + q,  q = (1 − r) k (d − p)  (along U1, about R2, R3)\n\
          Φ = |x₁|^a + |x₂|^b + |x₃|^c ≤ 1,  xᵢ = qᵢ/((1 − r) Sᵢ),  S = (P_y, M_p2, M_p3)\n\
          ṗ = λ ∂Φ/∂q, λ ≥ 0, λ > 0 only where Φ = 1")
    .source("Simo & Hughes, Computational Inelasticity, 1998, §3.6; Orbison, McGuire & Abel 1982; Powell & Chen 1986")
    .example(r#""hinge": PMMHinge(nodes: ("a", "b"), axial: "2 GN/m", bending2: "40 MN*m/rad", bending3: "120 MN*m/rad", py: "4 MN", mp2: "250 kN*m", mp3: "600 kN*m", exponent_p: 1.6, ratio: 0.02)"#)
    .exercise(Exercise::new(0.5, &[
            Stroke::about(-1e-3, 1e-3),
            Stroke::about(0.0, 0.02).with_phase(0.25),
            Stroke::about(0.0, 0.03),
        ]));

    fn check(&self) -> Result<(), ParameterError> {
        if self.ratio < 1.0 {
            return Ok(());
        }
        let message = "`ratio` = 1 never yields: must be below 1, or use a `LinearLink`";
        Err(ParameterError::inconsistent("ratio", message))
    }
}

impl Link for PMMHinge {
    fn coordinates(&self) -> Coordinates {
        Coordinates::Local(vec![Axis::U1, Axis::R2, Axis::R3])
    }

    fn history(&self) -> Cow<'static, [Field]> {
        PMMHistory::FIELDS.into()
    }

    fn uses_rates(&self) -> bool {
        false
    }

    fn engaged_stiffness(&self, k: &mut [f64]) {
        (k[0], k[4], k[8]) = (self.axial, self.bending2, self.bending3);
    }

    answers_by_law!();
}

const PARAMETERS: usize = 13;

impl PMMHinge {
    fn law(&self) -> Written {
        Written::of::<Law>().still()
    }

    /// r, (1 − r) k, (1 − r) S, exponents, κ.
    fn numbers(&self) -> [f64; PARAMETERS] {
        let k = [self.axial, self.bending2, self.bending3];
        let s = [self.py, self.mp2, self.mp3];
        let e = [self.exponent_p, self.exponent_m2, self.exponent_m3];
        let weight = |i: usize| k[i] / (s[i] * s[i]);
        let most = weight(0).max(weight(1)).max(weight(2));
        let left = 1.0 - self.ratio;
        let mut all = [self.ratio; PARAMETERS];
        for i in 0..3 {
            (all[1 + i], all[4 + i], all[7 + i]) = (left * k[i], left * s[i], e[i]);
            all[10 + i] = weight(i) / most;
        }
        all
    }
}

/// The law over lanes.
struct Law;

impl Law {
    #[inline(always)]
    fn answer<R: Real>(at: &LaneAt<'_, R>, out: &mut LaneForce<'_, R>) -> Projected<R> {
        let p = at.parameters;
        let share = p[0] / (p[0].of(1.0) - p[0]);
        let three = |place: usize| [p[place], p[place + 1], p[place + 2]];
        let (k, s) = (three(1), three(4));
        let trial = [0, 1, 2].map(|i| k[i] * (at.d[i] - at.history[i]) / s[i]);
        let it = Projected::of(trial, three(7), three(10));
        for i in 0..3 {
            // r k d, with the stiffness of which 1 − r is kept.
            out.f[i] = (share * k[i]).mul_add(at.d[i], s[i] * it.x[i]);
            for j in 0..3 {
                out.k[3 * i + j] = s[i] * it.by[i][j] * k[j] / s[j];
            }
            out.k[4 * i] = share.mul_add(k[i], out.k[4 * i]);
        }
        out.c.fill(share.of(0.0));
        it
    }

    #[inline(always)]
    fn step<R: Real>(at: &LaneAt<'_, R>, it: &Projected<R>, trial: &mut [R]) -> LaneStep<R> {
        let p = at.parameters;
        let (zero, half) = (p[0].of(0.0), p[0].of(0.5));
        let share = p[0] / (p[0].of(1.0) - p[0]);
        let (mut stored, mut heat) = (zero, zero);
        for i in 0..3 {
            let (k, q, before) = (p[1 + i], p[4 + i] * it.x[i], at.history[i]);
            let now = R::select(it.yields, at.d[i] - q / k, before);
            stored = stored + share * k * at.d[i] * at.d[i] + q * q / k;
            heat = (k * (at.d0[i] - before) + q).mul_add(now - before, heat);
            trial[i] = now;
        }
        LaneStep { hysteretic: (half * heat).max(zero), ..LaneStep::elastic(half * stored) }
    }
}

impl LaneLaw for Law {
    const COORDINATES: usize = 3;
    const HISTORY: usize = 3;
    const PARAMETERS: usize = PARAMETERS;
    const IS_LONG: bool = true;

    #[inline(always)]
    fn respond<R: Real>(
        at: &LaneAt<'_, R>,
        out: &mut LaneForce<'_, R>,
        trial: &mut [R],
    ) -> LaneStep<R> {
        let it = Self::answer(at, out);
        Self::step(at, &it, trial)
    }
}
