//! Maxwell damper: a spring in series with a dashpot of a power of the rate.
//!
//! ```text
//!   i ●──/\/\/──[]──● j        f = k d_k = c sgn(w) |w|^α,   d = d_k + ∫ w dt
//!         k    c, α            ḟ = k (ḋ − sgn(f) (|f|/c)^(1/α))
//! ```
//!
//! The point between spring and dashpot needs neither node nor mass. For α = 1 a step is exact for a
//! rate that is linear in it; other exponents are integrated inside the step by an implicit method of
//! second order. In a static analysis the dashpot follows, and the force stays as it was.
//!
//! Reference: \[Soong & Dargush 1997, ch. 6\].

use crate::shared::relaxation::relax;
use crate::shared::series::{SeriesHistory, Split, Viscous, answer, follow};
use serde::Deserialize;
use std::borrow::Cow;
use trilith_element::{
    Axis, Card, Category, Coordinates, Described, Exercise, Field, History, Kinematics, Link,
    NodeCount, Parameters, Response, Stroke,
};

/// Spring in series with a power-law dashpot.
#[derive(Clone, Debug, Deserialize, Parameters)]
#[serde(deny_unknown_fields)]
pub struct MaxwellDamper {
    /// stiffness of the spring
    #[parameter("k", unit = "N/m", range = Positive)]
    pub k: f64,
    /// coefficient of the dashpot
    #[parameter("c", unit = "N", per = "m/s", exponent = "exponent", range = Positive)]
    pub c: f64,
    /// exponent of the rate
    #[parameter("α", unit = "1", range = Within(0.1, 2.0), default = 1.0)]
    pub exponent: f64,
    /// local axis
    #[parameter(choices = ["U1", "U2", "U3"], default = "U1")]
    pub axis: Axis,
}

impl Described for MaxwellDamper {
    const CARD: Card = Card::new(
        "MaxwellDamper",
        Category::Link,
        "Spring in series with a dashpot of a power of the rate.",
    )
    .nodes(NodeCount::GROUND_OR_TWO)
    .parameters(Self::PARAMETERS)
    .law("f = k d_k = c sgn(w) |w|^α, d = d_k + ∫ w dt\n\
          ḟ = k (ḋ − sgn(f) (|f|/c)^(1/α))")
    .source("Soong & Dargush, Passive Energy Dissipation Systems, 1997, ch. 6")
    .example(r#""damper": MaxwellDamper(nodes: ("a", "b"), k: "20 MN/m", c: "200 kN*(s/m)^0.35", exponent: 0.35)"#)
    .exercise(Exercise::new(1.0, &[Stroke::about(0.0, 0.05)]));
}

impl Viscous for MaxwellDamper {
    fn split_positive(&self, known: f64, a: f64) -> Split {
        let (c, alpha) = (self.c, self.exponent);
        // Both equations are convex and start above their root: Newton's method falls to it and ends
        // where it no longer falls.
        if alpha < 1.0 {
            let p = 1.0 / alpha;
            let bound = c * (known / a).powf(alpha);
            // A quotient too small for a number says nothing.
            let mut f = if bound > 0.0 { known.min(bound) } else { known };
            loop {
                let w = (f / c).powf(p);
                let next = f - (f + a * w - known) / (1.0 + a * p * w / f);
                if !(next < f && next > 0.0) {
                    return Split { force: f, rate: w, slope: 1.0 / (1.0 + a * p * w / f) };
                }
                f = next;
            }
        }
        let mut w = (known / a).min((known / c).powf(1.0 / alpha));
        loop {
            let f = c * w.powf(alpha);
            let rise = if w > 0.0 { alpha * f / w } else { 0.0 };
            let next = w - (f + a * w - known) / (rise + a);
            if !(next < w && next > 0.0) {
                return Split { force: f, rate: w, slope: rise / (rise + a) };
            }
            w = next;
        }
    }
}

impl Link for MaxwellDamper {
    fn coordinates(&self) -> Coordinates {
        Coordinates::Local(vec![self.axis])
    }

    fn history(&self) -> Cow<'static, [Field]> {
        Cow::Borrowed(SeriesHistory::FIELDS)
    }

    fn engaged_stiffness(&self, k: &mut [f64]) {
        k[0] = self.k;
    }

    // A spring lies before all that is viscous: the force follows the deformation at once.
    fn damps(&self) -> bool {
        false
    }

    fn respond(
        &self,
        at: &Kinematics<'_>,
        committed: &[f64],
        trial: &mut [f64],
        out: &mut Response<'_>,
    ) {
        let f0 = SeriesHistory::load(committed).force;
        let end = if self.exponent == 1.0 {
            relax(self.k, self.c / self.k, f0, at)
        } else {
            follow(self.k, self, f0, at)
        };
        answer(self.k, &end, trial, out);
    }
}

#[cfg(test)]
mod tests;
