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

use crate::shared::relaxation::{Followed, relax};
use crate::shared::series::{self, Series, SeriesHistory, Split, Viscous};
use crate::shared::written::{Written, answers_by_law};
use serde::Deserialize;
use std::borrow::Cow;
use trilith_element::lanes::{LaneAt, Real};
use trilith_element::{
    Axis, Card, Category, Coordinates, Described, Exercise, Field, History, Link, NodeCount,
    Parameters, Stroke,
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

/// The dashpot; parameters k, c, α. `FORM`: whether α is 1, below or above it.
struct Power<const FORM: u8>;

const ONE: u8 = 0;
const BELOW: u8 = 1;
const ABOVE: u8 = 2;

impl<const FORM: u8> Viscous for Power<FORM> {
    const PARAMETERS: usize = 3;
    const IS_LONG: bool = FORM != ONE;

    #[inline(always)]
    fn split_positive<R: Real>(parameters: &[R], known: R, a: R) -> Split<R> {
        let (c, alpha) = (parameters[1], parameters[2]);
        match FORM {
            ONE => {
                let rate = known / (c + a);
                Split { force: c * rate, rate, slope: c / (c + a) }
            }
            BELOW => by_force(known, a, c, alpha),
            _ => by_rate(known, a, c, alpha),
        }
    }

    #[inline(always)]
    fn follow<R: Real>(at: &LaneAt<'_, R>) -> Followed<R> {
        if FORM == ONE {
            let (k, c) = (at.parameters[0], at.parameters[1]);
            return relax(k, c / k, at.history[0], at);
        }
        series::follow::<Self, R>(at)
    }
}

// Both equations are convex and start above their root: Newton's method falls to it and ends, in every lane, where it no
// longer falls. A step from the root, which nothing moves, has its derivatives.

/// f + a (f/c)^(1/α) = known, for α < 1.
#[inline(always)]
fn by_force<R: Real>(known: R, a: R, c: R, alpha: R) -> Split<R> {
    let (zero, one) = (known.of(0.0), known.of(1.0));
    let p = one / alpha;
    let bound = c * (known / a).powf(alpha);
    // A quotient too small for a number says nothing.
    let mut f = R::select(zero.lt(bound), known.min(bound), known);
    let mut falls = zero.le(zero);
    loop {
        let rate = (f / c).powf(p);
        let slope = one / (one + a * p * rate / f);
        let next = f - (f + a * rate - known) * slope;
        falls = falls & next.lt(f) & zero.lt(next);
        if !f.any(falls) {
            if R::DERIVATIVES {
                let moved = f.fixed() - (f.fixed() + a * (f.fixed() / c).powf(p) - known) * slope;
                return Split { force: moved, rate: (moved / c).powf(p), slope };
            }
            return Split { force: f, rate, slope };
        }
        f = R::select(falls, next, f);
    }
}

/// c w^α + a w = known, for α > 1.
#[inline(always)]
fn by_rate<R: Real>(known: R, a: R, c: R, alpha: R) -> Split<R> {
    let (zero, one) = (known.of(0.0), known.of(1.0));
    let mut w = (known / a).min((known / c).powf(one / alpha));
    let mut falls = zero.le(zero);
    loop {
        let force = c * w.powf(alpha);
        let some = zero.lt(w);
        let rise = (alpha * force / R::select(some, w, one)).only(some);
        let next = w - (force + a * w - known) / (rise + a);
        falls = falls & next.lt(w) & zero.lt(next);
        if !w.any(falls) {
            let slope = rise / (rise + a);
            if R::DERIVATIVES {
                let still = w.fixed();
                let moved = still - (c * still.powf(alpha) + a * still - known) / (rise + a);
                return Split { force: c * moved.powf(alpha), rate: moved, slope };
            }
            return Split { force, rate: w, slope };
        }
        w = R::select(falls, next, w);
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

    answers_by_law!();
}

impl MaxwellDamper {
    fn law(&self) -> Written {
        match self.exponent {
            1.0 => Written::of::<Series<Power<ONE>>>(),
            below if below < 1.0 => Written::of::<Series<Power<BELOW>>>(),
            _ => Written::of::<Series<Power<ABOVE>>>(),
        }
    }

    fn numbers(&self) -> [f64; 3] {
        [self.k, self.c, self.exponent]
    }
}

#[cfg(test)]
mod tests;
