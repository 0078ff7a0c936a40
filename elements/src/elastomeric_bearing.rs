//! ElastomericBearing: bearing with bilinear shear coupled in its plane, of plasticity theory.
//!
//! ```text
//!   f = r k d + q,   q = (1 − r) k (d − p),   |q| ≤ (1 − r) f_y         d, p, q, f along U2, U3
//!   ṗ = λ q,   λ ≥ 0,   λ > 0 only where |q| = (1 − r) f_y              p = 0 at rest
//!
//!     f │   ╱─────  r k            in the plane of d the circle |q| = (1 − r) f_y moves
//!   f_y │  ╱                       with the centre r k d (kinematic hardening)
//!       │ ╱ k
//!       └────────── d
//! ```
//!
//! The same in all directions of the plane, elastic up to f_y, and f_y does not depend on the axial force:
//! a lead–rubber or high-damping bearing, or with r = 0 a slider under constant load. It carries nothing
//! along its axis. A step returns the elastic trial force radially onto the circle: exact on straight paths through
//! the origin and where yielding goes on in one direction, first order in the step where the direction turns.
//!
//! **Energy.** Stored ½ r k d² + ½ q²/((1 − r) k), hysteretic ∫ q·dp ≥ 0.
//!
//! Reference: \[Simo & Hughes 1998, §3.3\] (the return); \[Naeim & Kelly 1999, ch. 4\] (bearings as bilinear).

use crate::shared::written::{Written, answers_by_law};
use serde::Deserialize;
use std::borrow::Cow;
use trilith_element::lanes::{LaneAt, LaneForce, LaneLaw, LaneStep, Real};
use trilith_element::{
    Axis, Card, Category, Coordinates, Described, Exercise, Field, History, Link, NodeCount,
    ParameterError, Parameters, Stroke, history,
};

/// Bearing with bilinear shear coupled in its plane.
#[derive(Clone, Debug, Deserialize, Parameters)]
#[serde(deny_unknown_fields)]
pub struct ElastomericBearing {
    /// shear stiffness before yielding
    #[parameter("k", unit = "N/m", range = Positive)]
    pub k: f64,
    /// shear force at which it yields
    #[parameter("f_y", unit = "N", range = Positive)]
    pub fy: f64,
    /// stiffness after yielding over `k`, below 1
    #[parameter("r", unit = "1", range = Within(0.0, 1.0), default = 0.0)]
    pub ratio: f64,
}

history! {
    /// History of an [`ElastomericBearing`].
    pub struct BearingHistory {
        /// Plastic deformation along U2.
        pub plastic2: "m",
        /// Plastic deformation along U3.
        pub plastic3: "m",
    }
}

impl Described for ElastomericBearing {
    const CARD: Card = Card::new(
        "ElastomericBearing",
        Category::Link,
        "Bearing with bilinear shear coupled in its plane, of plasticity theory.",
    )
    .nodes(NodeCount::GROUND_OR_TWO)
    .parameters(Self::PARAMETERS)
    .law("f = r k d + q,  q = (1 − r) k (d − p),  |q| ≤ (1 − r) f_y  (vectors along U2, U3)\n\
          ṗ = λ q, λ ≥ 0, λ > 0 only where |q| = (1 − r) f_y")
    .source("Simo & Hughes, Computational Inelasticity, 1998, §3.3; Naeim & Kelly, Design of Seismic Isolated Structures, 1999, ch. 4")
    .example(r#""bearing": ElastomericBearing(nodes: ("ground", "slab"), k: "10 MN/m", fy: "100 kN", ratio: 0.1)"#)
    .exercise(Exercise::new(0.5, &[Stroke::about(0.0, 0.15), Stroke::about(0.0, 0.1).with_phase(0.25)]));

    fn check(&self) -> Result<(), ParameterError> {
        if self.ratio < 1.0 {
            return Ok(());
        }
        let message = "`ratio` = 1 never yields: must be below 1, or use a `Spring`";
        Err(ParameterError::inconsistent("ratio", message))
    }
}

impl Link for ElastomericBearing {
    fn coordinates(&self) -> Coordinates {
        Coordinates::Local(vec![Axis::U2, Axis::U3])
    }

    fn history(&self) -> Cow<'static, [Field]> {
        BearingHistory::FIELDS.into()
    }

    fn uses_rates(&self) -> bool {
        false
    }

    fn engaged_stiffness(&self, k: &mut [f64]) {
        (k[0], k[3]) = (self.k, self.k);
    }

    answers_by_law!();
}

impl ElastomericBearing {
    fn law(&self) -> Written {
        Written::of::<BearingLaw>().still()
    }

    /// Parameters of the law: r k, (1 − r) k, (1 − r) f_y, 1/((1 − r) k).
    fn numbers(&self) -> [f64; 4] {
        let elastic = (1.0 - self.ratio) * self.k;
        [self.ratio * self.k, elastic, (1.0 - self.ratio) * self.fy, elastic.recip()]
    }
}

/// The law over lanes; history p.
struct BearingLaw;

/// The return of the elastic trial force onto the circle.
struct Returned<R: Real> {
    slips: R::Mask,
    /// q.
    tau: [R; 2],
    /// Direction of the trial force; anything where it is zero.
    along: [R; 2],
    /// Limit over elastic stretch; anything where that is zero.
    ratio: R,
}

impl<R: Real> Returned<R> {
    #[inline(always)]
    fn of(at: &LaneAt<'_, R>) -> Self {
        let (elastic, limit) = (at.parameters[1], at.parameters[2]);
        let (x, y) = (at.d[0] - at.history[0], at.d[1] - at.history[1]);
        let length = x.mul_add(x, y * y).sqrt();
        let slips = limit.lt(elastic * length);
        let inverse = length.of(1.0) / length;
        let along = [x * inverse, y * inverse];
        let tau = [
            R::select(slips, limit * along[0], elastic * x),
            R::select(slips, limit * along[1], elastic * y),
        ];
        Self { slips, tau, along, ratio: limit * inverse }
    }
}

impl LaneLaw for BearingLaw {
    const COORDINATES: usize = 2;
    const HISTORY: usize = 2;
    const PARAMETERS: usize = 4;

    #[inline(always)]
    fn respond<R: Real>(
        at: &LaneAt<'_, R>,
        out: &mut LaneForce<'_, R>,
        trial: &mut [R],
    ) -> LaneStep<R> {
        let (after, elastic, flexibility) = (at.parameters[0], at.parameters[1], at.parameters[3]);
        let it = Returned::of(at);
        let (zero, half, one) = (after.of(0.0), after.of(0.5), after.of(1.0));
        out.c.fill(zero);
        let (mut stored, mut heat) = (zero, zero);
        for i in 0..2 {
            out.f[i] = after.mul_add(at.d[i], it.tau[i]);
            // Slipping, the force turns but does not grow.
            let across = it.ratio * (one - it.along[i] * it.along[i]);
            out.k[3 * i] = after + R::select(it.slips, across, elastic);
            out.k[1 + i] = (-(it.ratio * it.along[0] * it.along[1])).only(it.slips);
            let plastic = at.history[i];
            let now = R::select(it.slips, at.d[i] - it.tau[i] * flexibility, plastic);
            stored = stored + after * at.d[i] * at.d[i] + it.tau[i] * it.tau[i] * flexibility;
            heat = ((at.d0[i] - plastic) * elastic + it.tau[i]).mul_add(now - plastic, heat);
            trial[i] = now;
        }
        // The return is along q: never negative but for rounding.
        LaneStep { hysteretic: (half * heat).max(zero), ..LaneStep::elastic(half * stored) }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::shared::parameters::{numbers, read};
    use approx::assert_relative_eq;
    use std::f64::consts::TAU;
    use trilith_element::Driver;
    use trilith_element::conformance::Kit;

    const K: f64 = 1e7;
    const FY: f64 = 1e5;

    fn law(ratio: f64) -> ElastomericBearing {
        read(&numbers(&[("k", K), ("fy", FY), ("ratio", ratio)])).unwrap()
    }

    #[test]
    fn conforms_with_and_without_hardening() {
        for ratio in [0.0, 0.1, 0.7] {
            Kit::new(&[0.02, 0.03], 0.5).rate_independent().assert(&law(ratio));
            Kit::new(&[0.2, 0.1], 0.5).seed(7).rate_independent().assert(&law(ratio));
        }
    }

    /// Along a line it is the one-dimensional law, here with a back force instead of a parallel spring.
    #[test]
    fn along_a_line_in_any_direction_it_is_bilinear() {
        for ratio in [0.0, 0.3] {
            let law = law(ratio);
            for angle in [0.0_f64, 0.3, 0.25 * TAU, 2.0, 4.0] {
                let mut driver = Driver::new(&law);
                let (mut plastic, hardening) = (0.0_f64, ratio * K / (1.0 - ratio));
                for d in [0.004_f64, 0.03, 0.025, -0.02, -0.018, 0.1, 0.1, -0.3] {
                    let trial = K * (d - plastic) - hardening * plastic;
                    let over = (trial.abs() - FY).max(0.0);
                    plastic += trial.signum() * over / (K + hardening);
                    let f = K * (d - plastic);
                    let g = driver.to(&[d * angle.cos(), d * angle.sin()]);
                    assert_relative_eq!(g[0], f * angle.cos(), epsilon = 1e-6);
                    assert_relative_eq!(g[1], f * angle.sin(), epsilon = 1e-6);
                }
            }
        }
    }

    #[test]
    fn a_loop_encloses_the_parallelogram_and_balances_to_the_last_digit() {
        let (ratio, amplitude) = (0.1, 0.15);
        let law = law(ratio);
        let mut driver = Driver::new(&law);
        driver.to(&[amplitude, 0.0]);
        let before = driver.energy.hysteretic;
        // The corners of the loop: a yield range of 2 f_y/k, then along the slope after yielding.
        for d in [amplitude - 2.0 * FY / K, -amplitude, -amplitude + 2.0 * FY / K, amplitude] {
            driver.to(&[d, 0.0]);
        }
        let area = 4.0 * (1.0 - ratio) * FY * (amplitude - FY / K);
        assert_relative_eq!(driver.energy.hysteretic - before, area, max_relative = 1e-12);
        driver.to(&[0.05, 0.2]);
        driver.to(&[-0.05, 0.1]);
        let e = driver.energy;
        assert_relative_eq!(driver.work, e.stored + e.hysteretic, max_relative = 1e-12);
    }

    /// Yielding along X, then pushed along Y: with the angle β between force and motion,
    /// β' = −(k/f_y) sin β, so tan(β/2) = tan(β₀/2) exp(−k s/f_y) at the distance s.
    #[test]
    fn the_force_turns_into_a_new_direction_as_the_closed_form_says() {
        let law = law(0.0);
        let s = 0.02;
        let beta = 2.0 * (-K * s / FY).exp().atan();
        let error = |steps: u32| {
            let mut driver = Driver::new(&law);
            driver.to(&[0.1, 0.0]);
            for i in 1..=steps {
                driver.to(&[0.1, s * f64::from(i) / f64::from(steps)]);
            }
            assert_relative_eq!(driver.f[0].hypot(driver.f[1]), FY, max_relative = 1e-12);
            (driver.f[0] - FY * beta.sin()).hypot(driver.f[1] - FY * beta.cos()) / FY
        };
        let errors = [50, 200, 800].map(error);
        for pair in errors.windows(2) {
            assert!((3.8..4.2).contains(&(pair[0] / pair[1])), "{errors:?}");
        }
        assert!(errors[2] < 1e-3, "{errors:?}");
    }

    #[test]
    fn the_centre_of_the_yield_circle_moves_with_hardening() {
        let ratio = 0.2;
        let law = law(ratio);
        let mut driver = Driver::new(&law);
        let force = driver.to(&[0.1, 0.0]).to_vec();
        assert_relative_eq!(force[0], FY + ratio * K * (0.1 - FY / K), max_relative = 1e-12);
        // A diameter of the circle back: elastic; what follows yields.
        let history = driver.history.clone();
        let back = driver.to(&[0.1 - 2.0 * FY / K, 0.0])[0];
        assert_relative_eq!(back, force[0] - 2.0 * FY, max_relative = 1e-12);
        assert_relative_eq!(driver.history[0], history[0], max_relative = 1e-12);
        driver.to(&[-0.1, 0.0]);
        assert!(driver.history[0] < history[0] - 0.1);
    }

    #[test]
    fn a_ratio_of_one_is_refused() {
        let given = [("k", K), ("fy", FY), ("ratio", 1.0)];
        let error = read::<ElastomericBearing>(&numbers(&given)).unwrap_err().to_string();
        assert!(error.contains("below 1"), "{error}");
        assert!(read::<ElastomericBearing>(&numbers(&[("k", K)])).is_err());
        assert_eq!(law(0.0).ratio, 0.0);
    }
}
