//! RubberIsolator: bearing with plastic shear coupled in its plane and a linear axial spring.
//!
//! ```text
//!   fᵢ = rᵢ kᵢ dᵢ + (1 − rᵢ) f_yᵢ zᵢ                      i = 2, 3
//!   ż  = A (k₂ ḋ₂/f_y2, k₃ ḋ₃/f_y3)ᵀ                      |z| ≤ 1, z = 0 at rest
//!        ⎡ 1 − a₂ z₂²   −a₃ z₂ z₃  ⎤
//!   A  = ⎣ −a₂ z₂ z₃    1 − a₃ z₃² ⎦                      aᵢ = 1 where ḋᵢ zᵢ > 0, else 0
//!   f₁ = k_v d₁
//!
//!   in general:  żᵢ = ωᵢ − zᵢ |z|^(η−2) Σⱼ ωⱼ zⱼ (γ + β sⱼ),  ωⱼ = kⱼ ḋⱼ/f_yⱼ
//!   Axes         sⱼ = sgn(ωⱼ zⱼ); the law above with β = γ = ½, η = 2, the defaults
//!   Direction    sⱼ = sgn(ω·z)
//! ```
//!
//! Along one axis it is a [`Wen`](crate::Wen) with exponent η where β = γ = ½. The path in a step is straight, and on
//! it z is exact for the defaults (see `biaxial.rs`) and integrated otherwise (see `bouc_wen_plane.rs`). With equal
//! parameters the response to straight paths is the same in all directions of the plane; on curved paths it is
//! so with `Direction`, and nearly so with `Axes`, since unloading is judged axis by axis. |z| comes to
//! (β + γ)^(−1/η), and the force at yielding with it.
//!
//! `Direction` is the rule of OpenSees' *elastomericBearingBoucWen*, whose η is 1 unless given, with *A* = 1; its
//! *alpha1* is `ratio2`, its *qd* (1 − `ratio2`) `fy2`. *LeadRubberX* has `Axes` with `beta: 0.9, gamma: 0.1`.
//!
//! **Energy.** For each axis as for [`Wen`](crate::Wen): stored ½ r k d² + (1 − r) f_y² z²/(2k), hysteretic
//! (1 − r) (f_y²/k) ∫ zᵢ² |z|^(η−2) Σⱼ ωⱼ zⱼ (γ + β sⱼ) du ≥ 0; axially ½ k_v d₁².
//!
//! Reference: \[Park, Wen & Ang 1986\], \[Casciati 1989\] (`Direction`); as in \[CSI Analysis Reference Manual,
//! rubber isolator property\].

use crate::shared::bouc_wen_plane::{self, Coupling, Shape, Shaped};
use crate::shared::written::{Written, answers_by_law};
use serde::Deserialize;
use std::borrow::Cow;
use trilith_element::lanes::{LaneAt, LaneForce, LaneLaw, LaneStep, Real};
use trilith_element::{
    Axis, Card, Category, Coordinates, Described, Exercise, Field, History, Link, NodeCount,
    ParameterError, Parameters, Stroke, history,
};

/// Bearing with coupled plastic shear.
#[derive(Clone, Debug, Deserialize, Parameters)]
#[serde(deny_unknown_fields)]
pub struct RubberIsolator {
    /// shear stiffness at rest
    #[parameter("k₂", unit = "N/m", range = Positive)]
    pub k2: f64,
    /// the same along U3 (k₂)
    #[parameter("k₃", unit = "N/m", range = Positive)]
    pub k3: Option<f64>,
    /// yield force in shear
    #[parameter("f_y2", unit = "N", range = Positive)]
    pub fy2: f64,
    /// the same along U3 (f_y2)
    #[parameter("f_y3", unit = "N", range = Positive)]
    pub fy3: Option<f64>,
    /// stiffness after yielding over `k2`
    #[parameter("r₂", unit = "1", range = Within(0.0, 1.0))]
    pub ratio2: f64,
    /// the same along U3 (r₂)
    #[parameter("r₃", unit = "1", range = Within(0.0, 1.0))]
    pub ratio3: Option<f64>,
    /// axial stiffness, both ways
    #[parameter("k_v", unit = "N/m", range = NonNegative, default = 0.0)]
    pub kv: f64,
    /// how unloading is told: axis by axis, or by the direction of the motion
    #[parameter(choices = Coupling::NAMES, default = "Axes")]
    pub coupling: Coupling,
    /// shape: loading against β + γ, return with γ − β
    #[parameter("β", unit = "1", range = Positive, default = 0.5)]
    pub beta: f64,
    /// shape, −β < γ ≤ β; at γ = β the return is elastic
    #[parameter("γ", unit = "1", default = 0.5)]
    pub gamma: f64,
    /// sharpness of yielding
    #[parameter("η", unit = "1", range = Within(1.0, 20.0), default = 2.0)]
    pub eta: f64,
}

history! {
    /// History of a [`RubberIsolator`].
    pub struct RubberHistory {
        /// Share of the yield force along U2.
        pub z2: "1",
        /// Share of the yield force along U3.
        pub z3: "1",
    }
}

impl Described for RubberIsolator {
    const CARD: Card = Card::new(
        "RubberIsolator",
        Category::Link,
        "Bearing with plastic shear coupled in its plane and a linear axial spring.",
    )
    .nodes(NodeCount::GROUND_OR_TWO)
    .parameters(Self::PARAMETERS)
    .law("fᵢ = rᵢ kᵢ dᵢ + (1 − rᵢ) f_yᵢ zᵢ, i = 2, 3;  f₁ = k_v d₁\n\
          żᵢ = ωᵢ − zᵢ |z|^(η−2) Σⱼ ωⱼ zⱼ (γ + β sⱼ),  ωⱼ = kⱼ ḋⱼ/f_yⱼ\n\
          Axes: sⱼ = sgn(ωⱼ zⱼ);  Direction: sⱼ = sgn(ω·z)")
    .source("Park, Wen & Ang, Random Vibration of Hysteretic Systems under Bi-directional Ground Motions, 1986; \
             Casciati 1989 for Direction, as in OpenSees' elastomericBearingBoucWen")
    .example(r#""bearing": RubberIsolator(nodes: ("ground", "slab"), k2: "10 MN/m", fy2: "100 kN", ratio2: 0.1, kv: "2000 MN/m")"#)
    .exercise(Exercise::new(0.5, &[
            Stroke::about(-0.0005, 0.0),
            Stroke::about(0.0, 0.15),
            Stroke::about(0.0, 0.1).with_phase(0.25),
        ]));

    fn check(&self) -> Result<(), ParameterError> {
        self.shape().check()
    }
}

impl RubberIsolator {
    fn shape(&self) -> Shape {
        let by_direction = self.coupling == Coupling::Direction;
        Shape { by_direction, beta: self.beta, gamma: self.gamma, eta: self.eta }
    }

    /// k, f_y and r of U2 and U3.
    fn shear(&self) -> [[f64; 3]; 2] {
        let second = [self.k2, self.fy2, self.ratio2];
        let third = [self.k3, self.fy3, self.ratio3];
        [second, [0, 1, 2].map(|i| third[i].unwrap_or(second[i]))]
    }
}

impl Link for RubberIsolator {
    fn coordinates(&self) -> Coordinates {
        Coordinates::Local(vec![Axis::U1, Axis::U2, Axis::U3])
    }

    fn history(&self) -> Cow<'static, [Field]> {
        RubberHistory::FIELDS.into()
    }

    fn engaged_stiffness(&self, k: &mut [f64]) {
        let [[k2, ..], [k3, ..]] = self.shear();
        (k[0], k[4], k[8]) = (self.kv, k2, k3);
    }

    fn damps(&self) -> bool {
        false
    }

    answers_by_law!();
}

impl RubberIsolator {
    fn law(&self) -> Written {
        if self.shape().is_closed() {
            Written::of::<Law<true>>()
        } else {
            Written::of::<Law<false>>()
        }
    }
}

/// Where the shape begins among the parameters of the law.
const SHAPE: usize = 7;

impl RubberIsolator {
    /// Parameters of the law: k_v, k, f_y and r of U2 and of U3, shape.
    fn numbers(&self) -> [f64; SHAPE + bouc_wen_plane::NUMBERS] {
        let [[k2, fy2, r2], [k3, fy3, r3]] = self.shear();
        let [how, beta, gamma, eta, limit] = self.shape().numbers();
        [self.kv, k2, fy2, r2, k3, fy3, r3, how, beta, gamma, eta, limit]
    }
}

/// The law over lanes, with z in closed form or by steps.
struct Law<const CLOSED: bool>;

/// k, f_y and r along U2 (0) or U3 (1).
#[inline(always)]
fn shear<R: Real>(at: &LaneAt<'_, R>, i: usize) -> [R; 3] {
    [at.parameters[1 + 3 * i], at.parameters[2 + 3 * i], at.parameters[3 + 3 * i]]
}

impl<const CLOSED: bool> LaneLaw for Law<CLOSED> {
    const COORDINATES: usize = 3;
    const HISTORY: usize = 2;
    const PARAMETERS: usize = SHAPE + bouc_wen_plane::NUMBERS;
    const IS_LONG: bool = true;

    #[inline(always)]
    fn respond<R: Real>(
        at: &LaneAt<'_, R>,
        out: &mut LaneForce<'_, R>,
        trial: &mut [R],
    ) -> LaneStep<R> {
        let kv = at.parameters[0];
        let (zero, half, one) = (kv.of(0.0), kv.of(0.5), kv.of(1.0));
        let mut omega = [zero; 2];
        for (i, omega) in omega.iter_mut().enumerate() {
            let [k, fy, _] = shear(at, i);
            *omega = k / fy * (at.d[i + 1] - at.d0[i + 1]);
        }
        let z0 = [at.history[0], at.history[1]];
        let shape = Shaped::of(&at.parameters[SHAPE..]);
        let moved = shape.advance::<0, CLOSED>(z0, omega, [at.v[1], at.v[2]]);
        out.k.fill(zero);
        out.c.fill(zero);
        out.f[0] = kv * at.d[0];
        out.k[0] = kv;
        let mut stored = half * kv * at.d[0] * at.d[0];
        let mut heat = zero;
        for i in 0..2 {
            let ([k, fy, ratio], z, d) = (shear(at, i), moved.z[i], at.d[i + 1]);
            out.f[i + 1] = ratio * k * d + (one - ratio) * fy * z.x;
            for j in 0..2 {
                let [kj, fyj, _] = shear(at, j);
                out.k[3 * (i + 1) + j + 1] = (one - ratio) * fy * z.by[j] * kj / fyj;
            }
            out.k[4 * (i + 1)] = out.k[4 * (i + 1)] + ratio * k;
            let size = (one - ratio) * fy * fy / k;
            stored = stored + half * (ratio * k * d * d + size * z.x * z.x);
            heat = heat + size * moved.loss[i].x;
            trial[i] = z.x;
        }
        LaneStep { hysteretic: heat, ..LaneStep::elastic(stored) }
    }
}

#[cfg(test)]
mod coupling;

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Wen;
    use crate::shared::parameters::{numbers, read};
    use crate::shared::paths::evenly;
    use approx::assert_relative_eq;
    use std::f64::consts::TAU;
    use trilith_element::Driver;
    use trilith_element::conformance::Kit;

    fn law(more: &[(&'static str, f64)]) -> RubberIsolator {
        let equal = [("k2", 1e7), ("fy2", 1e5), ("ratio2", 0.1), ("kv", 2e9)];
        read(&numbers(&[&equal, more].concat())).unwrap()
    }

    #[test]
    fn conforms_with_equal_and_with_unequal_axes() {
        let unequal = law(&[("k3", 4e6), ("fy3", 1.5e5), ("ratio3", 0.3)]);
        let yielding = law(&[("ratio3", 0.0)]);
        for law in [law(&[]), unequal, yielding] {
            Kit::new(&[1e-3, 0.02, 0.03], 0.5).rate_independent().assert(&law);
            Kit::new(&[1e-3, 0.2, 0.1], 0.5).seed(7).rate_independent().assert(&law);
        }
    }

    #[test]
    fn along_a_line_in_any_direction_it_is_a_wen_of_exponent_two() {
        let wen: Wen =
            read(&numbers(&[("k", 1e7), ("fy", 1e5), ("ratio", 0.1), ("exponent", 2.0)])).unwrap();
        let law = law(&[]);
        for angle in [0.0_f64, 0.3, 0.25 * TAU, 2.0, 4.0] {
            let (mut one, mut two) = (Driver::new(&wen), Driver::new(&law));
            for d in [0.004, 0.03, 0.025, -0.02, -0.018, 0.1] {
                let f = one.to(&[d])[0];
                let g = two.to(&[0.0, d * angle.cos(), d * angle.sin()]);
                assert_relative_eq!(g[1], f * angle.cos(), epsilon = 1e-6);
                assert_relative_eq!(g[2], f * angle.sin(), epsilon = 1e-6);
                assert_relative_eq!(one.heat(), two.heat(), max_relative = 1e-9, epsilon = 1e-9);
            }
        }
    }

    /// The matrix A of the manual, integrated with respect to time along an orbit.
    #[test]
    fn an_orbit_is_that_of_the_differential_equation() {
        let law = law(&[("k3", 8e6), ("fy3", 1.2e5)]);
        let (radius, w) = (0.05, 3.0);
        let d = |t: f64| [radius * (w * t).sin(), radius * (1.0 - (w * t).cos())];
        let rate = |t: f64, z: [f64; 2]| {
            let v = [radius * w * (w * t).cos(), radius * w * (w * t).sin()];
            let a = [0, 1].map(|i| f64::from(v[i] * z[i] > 0.0));
            let s = [1e7 / 1e5 * v[0], 8e6 / 1.2e5 * v[1]];
            [
                (1.0 - a[0] * z[0] * z[0]) * s[0] - a[1] * z[0] * z[1] * s[1],
                -a[0] * z[0] * z[1] * s[0] + (1.0 - a[1] * z[1] * z[1]) * s[1],
            ]
        };
        let error = |steps: u32| {
            let end = 1.5 * TAU / w;
            let (fine, mut z, mut worst) = (20_000 / steps, [0.0; 2], 0.0_f64);
            let h = end / f64::from(steps * fine);
            let mut driver = Driver::new(&law);
            for i in 0..steps {
                for j in 0..fine {
                    let t = f64::from(i * fine + j) * h;
                    let moved = |r: [f64; 2], h: f64| [z[0] + h * r[0], z[1] + h * r[1]];
                    let a = rate(t, z);
                    let b = rate(t + 0.5 * h, moved(a, 0.5 * h));
                    let c = rate(t + 0.5 * h, moved(b, 0.5 * h));
                    let e = rate(t + h, moved(c, h));
                    z = [0, 1].map(|i| z[i] + h * (a[i] + 2.0 * b[i] + 2.0 * c[i] + e[i]) / 6.0);
                }
                let [x, y] = d(f64::from((i + 1) * fine) * h);
                evenly(&mut driver, &[0.0, x, y], f64::from(fine) * h);
                worst = worst.max((driver.history[0] - z[0]).hypot(driver.history[1] - z[1]));
            }
            worst
        };
        // Only the chords of the orbit are in the way: second order.
        let errors = [250, 1000, 4000].map(error);
        for pair in errors.windows(2) {
            assert!((12.0..20.0).contains(&(pair[0] / pair[1])), "{errors:?}");
        }
        assert!(errors[2] < 5e-6, "{errors:?}");
    }

    #[test]
    fn carries_along_its_axis_only_what_it_is_given() {
        let mut none = law(&[]);
        none.kv = 0.0;
        assert_eq!(Driver::new(&none).to(&[0.1, 0.0, 0.0]), [0.0; 3]);
        assert_eq!(Driver::new(&law(&[])).to(&[-1e-3, 0.0, 0.0])[0], -2e6);
        assert!(read::<RubberIsolator>(&numbers(&[("k2", 1.0), ("fy2", 1.0)])).is_err());
    }
}
