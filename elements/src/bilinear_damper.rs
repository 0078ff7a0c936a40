//! Bilinear damper: a spring in series with an oil damper that has a relief valve.
//!
//! ```text
//!   i ●──/\/\/──[]──● j      f = k d_k = F(w),   d = d_k + ∫ w dt
//!         k     c, c_y
//!   F(w) = c w                            |w| ≤ f_l/c
//!   F(w) = sgn(w) f_l + c_y (w − sgn(w) f_l/c)      beyond: the valve is open
//! ```
//!
//! Integrated inside the step as a [`MaxwellDamper`](crate::MaxwellDamper) is. With c_y = 0 the force is
//! capped at f_l.
//!
//! Reference: the law with `c`, `cy` and a force limit is that of SAP2000's bilinear damper; with a
//! ratio p = c_y/c that of oil dampers in \[JSSI 2003\].

use crate::shared::series::{Series, SeriesHistory, Split, Viscous};
use crate::shared::written::{Written, answers_by_law};
use serde::Deserialize;
use std::borrow::Cow;
use trilith_element::lanes::Real;
use trilith_element::{
    Axis, Card, Category, Coordinates, Described, Exercise, Field, History, Link, NodeCount,
    Parameters, Stroke,
};

/// Spring in series with an oil damper with a relief valve.
#[derive(Clone, Debug, Deserialize, Parameters)]
#[serde(deny_unknown_fields)]
pub struct BilinearDamper {
    /// stiffness of the spring
    #[parameter("k", unit = "N/m", range = Positive)]
    pub k: f64,
    /// coefficient up to the relief force
    #[parameter("c", unit = "N·s/m", range = Positive)]
    pub c: f64,
    /// coefficient beyond the relief force
    #[parameter("c_y", unit = "N·s/m", range = NonNegative)]
    pub cy: f64,
    /// relief force
    #[parameter("f_l", unit = "N", range = Positive)]
    pub fl: f64,
    /// local axis
    #[parameter(choices = ["U1", "U2", "U3"], default = "U1")]
    pub axis: Axis,
}

impl Described for BilinearDamper {
    const CARD: Card = Card::new(
        "BilinearDamper",
        Category::Link,
        "Spring in series with an oil damper that has a relief valve.",
    )
    .nodes(NodeCount::GROUND_OR_TWO)
    .parameters(Self::PARAMETERS)
    .law("f = k d_k = F(w), d = d_k + ∫ w dt\n\
          F(w) = c w where |w| ≤ f_l/c, else sgn(w) f_l + c_y (w − sgn(w) f_l/c)")
    .source("SAP2000 bilinear damper; JSSI manual of passive control, oil damper, 2003")
    .example(r#""damper": BilinearDamper(nodes: ("a", "b"), k: "50 MN/m", c: "1 MN*s/m", cy: "70 kN*s/m", fl: "200 kN")"#)
    .exercise(Exercise::new(1.0, &[Stroke::about(0.0, 0.08)]));
}

/// The oil damper; parameters k, c, c_y, f_l.
struct Relieved;

impl Viscous for Relieved {
    const PARAMETERS: usize = 4;
    const IS_LONG: bool = false;

    #[inline(always)]
    fn split_positive<R: Real>(parameters: &[R], known: R, a: R) -> Split<R> {
        let (c, cy, fl) = (parameters[1], parameters[2], parameters[3]);
        let (relief, closed) = (fl / c, known / (c + a));
        let open = (known - fl + cy * relief) / (cy + a);
        let is_closed = closed.le(relief);
        let (c, rate) = (R::select(is_closed, c, cy), R::select(is_closed, closed, open));
        let force = R::select(is_closed, c * rate, fl + c * (rate - relief));
        Split { force, rate, slope: c / (c + a) }
    }
}

impl Link for BilinearDamper {
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

impl BilinearDamper {
    fn law(&self) -> Written {
        Written::of::<Series<Relieved>>()
    }

    fn numbers(&self) -> [f64; 4] {
        [self.k, self.c, self.cy, self.fl]
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::shared::parameters::{numbers, read};
    use crate::shared::paths::led;
    use approx::assert_relative_eq;
    use std::f64::consts::TAU;
    use trilith_element::conformance::Kit;

    fn law(k: f64, cy: f64) -> BilinearDamper {
        read(&numbers(&[("k", k), ("c", 1e6), ("cy", cy), ("fl", 1e5)])).unwrap()
    }

    #[test]
    fn conforms_with_relief_without_and_capped() {
        for k in [1e6, 5e7] {
            for cy in [0.0, 7e4, 1e6] {
                Kit::new(&[0.05], 1.0).assert(&law(k, cy));
            }
        }
    }

    /// A constant rate V from rest: exponentials with the time constants c/k and c_y/k, the change where
    /// the force is f_l.
    #[test]
    fn a_constant_rate_gives_one_exponential_after_the_other() {
        let (k, c, cy, fl, v) = (2e7, 1e6, 1e5, 1e5, 0.3);
        let law = law(k, cy);
        let opens = -c / k * (1.0 - fl / (c * v)).ln();
        let exact = |t: f64| {
            if t < opens {
                return c * v * (1.0 - (-t * k / c).exp());
            }
            let last = fl + cy * (v - fl / c);
            last + (fl - last) * (-(t - opens) * k / cy).exp()
        };
        for time in [0.01, 0.03, 0.05] {
            let error = |steps| {
                let it = led(&law, time, steps, |t| (v * t, v));
                (it.f[0] / exact(time) - 1.0).abs()
            };
            assert!(error(4000) < 2e-6, "{time}: {}", error(4000));
            // Second order where the step that opens the valve lies far behind.
            if time < opens {
                let order = (error(100) / error(400)).log2() / 2.0;
                assert!(order > 1.9, "{order}");
            }
        }
    }

    #[test]
    fn behind_a_stiff_spring_a_cycle_costs_what_the_dashpot_alone_costs() {
        // ∫ F v dt for v = V cos ωt, by the midpoint rule on the law itself.
        let (cy, x, w) = (1e5, 0.1, TAU);
        let law = law(1e11, cy);
        let n = 100_000;
        let heat: f64 = (0..n)
            .map(|i| {
                let v = x * w * (TAU * (f64::from(i) + 0.5) / f64::from(n)).cos().abs();
                let f = if v <= 0.1 { 1e6 * v } else { 1e5 + cy * (v - 0.1) };
                f * v * TAU / w / f64::from(n)
            })
            .sum();
        let after = |cycles: f64| {
            let motion = |t: f64| (x * (w * t).sin(), x * w * (w * t).cos());
            led(&law, cycles, 2000 * cycles as usize, motion).energy.viscous
        };
        assert_relative_eq!(after(2.0) - after(1.0), heat, max_relative = 1e-4);
    }

    #[test]
    fn without_slope_beyond_it_the_relief_force_is_a_cap() {
        let law = law(5e7, 0.0);
        let it = led(&law, 0.5, 500, |t| (t, 1.0));
        assert_relative_eq!(it.f[0], 1e5, max_relative = 1e-12);
        assert!(read::<BilinearDamper>(&numbers(&[("k", 1.0), ("c", 1.0)])).is_err());
    }
}
