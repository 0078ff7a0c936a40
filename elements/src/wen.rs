//! Wen: smooth plastic spring along or about one axis.
//!
//! ```text
//!   f = r k d + (1 − r) f_y z
//!   ż = (k/f_y) ḋ (1 − |z|ⁿ)      ḋ z > 0   (loading)
//!   ż = (k/f_y) ḋ                 otherwise (unloading is elastic)        |z| ≤ 1, z = 0 at rest
//! ```
//!
//! The path within a step is straight, and on it z is exact (see `wen/transition.rs`): the force depends
//! neither on speed nor on the step. In the notation of Bouc and Wen it is A = 1, β = γ = ½.
//!
//! **Energy.** A spring r k beside a spring (1 − r) k in series with a slider: stored ½ r k d² +
//! (1 − r) f_y² z²/(2k), hysteretic (1 − r) f_y ∫ z (ḋ − ż f_y/k) dt, which never falls.
//!
//! Reference: \[Wen 1976\]; exponent and unloading as in \[CSI Analysis Reference Manual, link properties\].

mod transition;

use crate::shared::written::{Written, answers_by_law};
use serde::Deserialize;
use transition::{ANY, ONE, TWO};
use trilith_element::lanes::{LaneAt, LaneForce, LaneLaw, LaneStep, Real};
use trilith_element::{
    Axis, Card, Category, Coordinates, Described, Exercise, History, Link, NodeCount, Parameters,
    Stroke, history,
};

/// Smooth plastic spring.
#[derive(Clone, Debug, Deserialize, Parameters)]
#[serde(deny_unknown_fields)]
pub struct Wen {
    /// stiffness at rest
    #[parameter("k", unit = "N/m", about = "N·m/rad", range = Positive)]
    pub k: f64,
    /// force at which it yields
    #[parameter("f_y", unit = "N", about = "N·m", range = Positive)]
    pub fy: f64,
    /// stiffness after yielding over `k`
    #[parameter("r", unit = "1", range = Within(0.0, 1.0))]
    pub ratio: f64,
    /// sharpness of yielding; above 20 nearly bilinear
    #[parameter("n", unit = "1", range = Within(1.0, 1000.0), default = 2.0)]
    pub exponent: f64,
    /// local axis
    #[parameter(choices = Axis::NAMES, default = "U1")]
    pub axis: Axis,
}

history! {
    /// History of a [`Wen`].
    pub struct WenHistory {
        /// Share of the yield force, −1 … 1.
        pub z: "1",
    }
}

impl Described for Wen {
    const CARD: Card = Card::new(
        "Wen",
        Category::Link,
        "Plastic spring with a smooth yield (Wen).",
    )
    .nodes(NodeCount::GROUND_OR_TWO)
    .parameters(Self::PARAMETERS)
    .law(
        "f = r k d + (1 − r) f_y z\n\
              ż = (k/f_y) ḋ (1 − |z|ⁿ) where ḋ z > 0, else (k/f_y) ḋ",
    )
    .source("Wen, Method for Random Vibration of Hysteretic Systems, 1976")
    .example(
        r#""isolator": Wen(nodes: ("a", "b"), axis: U2, k: "80 MN/m", fy: "120 kN", ratio: 0.08)"#,
    )
    .exercise(Exercise::new(0.5, &[Stroke::about(0.0, 0.01)]));
}

impl Link for Wen {
    fn coordinates(&self) -> Coordinates {
        Coordinates::Local(vec![self.axis])
    }

    fn history(&self) -> std::borrow::Cow<'static, [trilith_element::Field]> {
        WenHistory::FIELDS.into()
    }

    fn engaged_stiffness(&self, k: &mut [f64]) {
        k[0] = self.k;
    }

    fn damps(&self) -> bool {
        false
    }

    answers_by_law!();
}

impl Wen {
    fn law(&self) -> Written {
        match transition::closed_form(self.exponent) {
            ONE => Written::of::<Law<ONE>>(),
            TWO => Written::of::<Law<TWO>>(),
            _ => Written::of::<Law<ANY>>(),
        }
    }

    /// Parameters of the law: k, f_y, r, exponent.
    fn numbers(&self) -> [f64; 3 + transition::NUMBERS] {
        let [n, middle, reach] = transition::numbers(self.exponent);
        [self.k, self.fy, self.ratio, n, middle, reach]
    }
}

/// The law over lanes, for one form of the exponent.
struct Law<const FORM: u8>;

impl<const FORM: u8> LaneLaw for Law<FORM> {
    const COORDINATES: usize = 1;
    const HISTORY: usize = 1;
    const PARAMETERS: usize = 3 + transition::NUMBERS;
    const IS_LONG: bool = true;

    #[inline(always)]
    fn respond<R: Real>(
        at: &LaneAt<'_, R>,
        out: &mut LaneForce<'_, R>,
        trial: &mut [R],
    ) -> LaneStep<R> {
        let p = at.parameters;
        let (k, fy, ratio, d) = (p[0], p[1], p[2], at.d[0]);
        let u = k / fy * (d - at.d0[0]);
        let t = transition::advance::<FORM, R>(at.history[0], u, at.v[0], &p[3..]);
        trial[0] = t.z;
        let plastic = k.of(1.0) - ratio;
        out.f[0] = ratio * k * d + plastic * fy * t.z;
        out.k[0] = k * (ratio + plastic * t.slope);
        out.c[0] = k.of(0.0);
        let size = plastic * fy * fy / k;
        let stored = k.of(0.5) * (ratio * k * d * d + size * t.z * t.z);
        LaneStep { hysteretic: size * t.loss, ..LaneStep::elastic(stored) }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::shared::parameters::{numbers, read};
    use crate::shared::paths::{finely, through};
    use approx::assert_relative_eq;
    use trilith_element::conformance::Kit;
    use trilith_element::{Driver, Value};

    fn law(k: f64, fy: f64, ratio: f64, exponent: f64) -> Wen {
        read(&numbers(&[("k", k), ("fy", fy), ("ratio", ratio), ("exponent", exponent)])).unwrap()
    }

    #[test]
    fn conforms_for_exponents_and_ratios() {
        for exponent in [1.0, 1.5, 2.0, 5.0, 20.0, 50.0] {
            for ratio in [0.0, 0.1, 1.0] {
                Kit::new(&[0.004], 1.0)
                    .rate_independent()
                    .assert(&law(8e7, 1.2e5, ratio, exponent));
            }
        }
    }

    /// Forces of CSI Software Verification 6-008 (n = 1; kip, in) and of the closed forms.
    #[test]
    fn follows_the_loading_and_the_reversal_of_the_published_example() {
        let path = [0.25, 0.5, 1.0, 2.0, 10.0, 9.75, 9.5, 9.0, 8.0, 0.0, -10.0];
        let expected = [
            (
                1.0,
                [
                    20.20612, 33.44543, 48.90991, 64.17580, 145.0, 120.0, 95.0, 61.55457, 37.24042,
                    -45.0, -145.0,
                ],
            ),
            (
                2.0,
                [
                    23.29527, 39.27174, 53.38124, 64.96982, 145.0, 120.0, 95.0, 55.72826, 35.22254,
                    -45.0, -145.0,
                ],
            ),
            (20.0, [25.0, 48.51015, 55.0, 65.0, 145.0, 120.0, 95.0, 46.48985, 35.0, -45.0, -145.0]),
        ];
        for (n, forces) in expected {
            let law = law(100.0, 50.0, 0.1, n);
            let one = through(&mut Driver::new(&law), &path);
            let many = finely(&mut Driver::new(&law), &path, 0.003);
            for ((a, b), f) in one.iter().zip(&many).zip(forces) {
                assert_relative_eq!(*a, f, max_relative = 1e-6);
                assert_relative_eq!(*a, *b, max_relative = 1e-11);
            }
        }
    }

    #[test]
    fn a_large_step_has_the_energy_of_its_path() {
        for n in [1.0, 2.0, 9.0] {
            let law = law(100.0, 50.0, 0.1, n);
            let (mut one, mut many) = (Driver::new(&law), Driver::new(&law));
            through(&mut one, &[3.0, -2.0]);
            finely(&mut many, &[3.0, -2.0], 1e-3);
            assert_relative_eq!(one.heat(), many.heat(), max_relative = 1e-9);
            assert_relative_eq!(many.work, many.heat() + many.energy.stored, max_relative = 1e-5);
        }
    }

    #[test]
    fn refuses_numbers_out_of_range_and_takes_any_axis() {
        let r2 = [
            numbers(&[("k", 1.0), ("fy", 1.0), ("ratio", 0.5)]),
            vec![("axis", Value::Text("R2".into()))],
        ]
        .concat();
        assert_eq!(read::<Wen>(&r2).unwrap().axis, Axis::R2);
        assert!(read::<Wen>(&numbers(&[("k", 1.0), ("fy", 1.0)])).is_err());
        let range = Wen::CARD.parameter("exponent").unwrap().range;
        assert!(!range.contains(0.9) && range.contains(25.0));
    }
}
