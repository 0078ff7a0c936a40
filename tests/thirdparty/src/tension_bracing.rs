//! Tension bracing: two slender diagonals that take tension only, yield and slacken.
//!
//! ```text
//!            ╲ 1     2 ╱               f
//!              ╲     ╱             F_y ┤        ╭──────   α k
//!        d →    ╲  ╱                   │       ╱
//!               ╱╲                ─────┼──────╱────── d    slack s + p₁: no force until the
//!             ╱    ╲                   │     ╱             diagonal is taut again
//!
//!   diagonal 1 is stretched by d > 0, diagonal 2 by d < 0; f = T₁ − T₂
//!   eᵢ = ±d − s − pᵢ          stretch, less what has become permanent
//!   Tᵢ = k max(eᵢ, 0)         while below the limit Yᵢ = F_y + H pᵢ,  H = α k / (1 − α)
//!   Tᵢ = Yᵢ beyond:           pᵢ grows, never falls
//! ```
//!
//! The two history variables are the permanent elongations p₁, p₂: between them the bracing hangs
//! loose, and a second excursion to the same deformation dissipates nothing. Stored energy is that of
//! the taut diagonals, T²/(2k); yielding turns F_y Δp + ½ H Δ(p²) into heat. Both are exact for any step.
//!
//! Reference: the slip model of tension-only bracing, e.g. \[Bruneau, Uang & Sabelli 2011, ch. 9\].

use serde::Deserialize;
use std::borrow::Cow;
use trilith_element::{
    Axis, Card, Category, Coordinates, Described, Exercise, Field, History, Kinematics, Link,
    NodeCount, ParameterError, Parameters, Response, Stroke, history,
};

/// A pair of tension-only diagonals. The fields are the parameters of model files.
#[derive(Clone, Debug, Deserialize, Parameters)]
#[serde(deny_unknown_fields)]
pub struct TensionBracing {
    /// stiffness of one taut diagonal along the axis
    #[parameter("k", unit = "N/m", range = Positive)]
    pub k: f64,
    /// force along the axis at which a diagonal yields
    #[parameter("F_y", unit = "N", range = Positive)]
    pub fy: f64,
    /// stiffness while yielding over `k`
    #[parameter("α", unit = "1", range = Within(0.0, 0.5), default = 0.0)]
    pub hardening: f64,
    /// motion until a diagonal is taut; < 0: pretension −ks
    #[parameter("s", unit = "m", default = 0.0)]
    pub slack: f64,
    /// local axis
    #[parameter(choices = ["U1", "U2", "U3"], default = "U2")]
    pub axis: Axis,
}

history! {
    /// What a tension bracing remembers.
    pub struct TensionBracingHistory {
        /// Permanent elongation p₁ of the diagonal that d > 0 stretches.
        pub elongation1: "m",
        /// Permanent elongation p₂ of the other.
        pub elongation2: "m",
    }
}

impl Described for TensionBracing {
    const CARD: Card = Card::new(
        "TensionBracing",
        Category::Link,
        "Two diagonals that take tension only, yield and slacken.",
    )
    .nodes(NodeCount::GROUND_OR_TWO)
    .parameters(Self::PARAMETERS)
    .law("f = T₁ − T₂,  eᵢ = ±d − s − pᵢ\n\
          Tᵢ = k max(eᵢ, 0), at most F_y + H pᵢ with H = α k/(1 − α)\n\
          beyond that pᵢ grows so that Tᵢ stays at the limit")
    .source("Bruneau, Uang & Sabelli, Ductile Design of Steel Structures, 2011, ch. 9")
    .example(r#""bracing": TensionBracing(nodes: ("base", "floor"), k: "20 MN/m", fy: "200 kN", hardening: 0.02)"#)
    .exercise(Exercise::new(1.0, &[Stroke::about(0.0, 0.04)]));

    fn check(&self) -> Result<(), ParameterError> {
        let pretension = -self.k * self.slack;
        if pretension >= self.fy {
            let message = format!(
                "a `slack` of {} m is a pretension of {pretension} N, which must be less than `fy` = {} N",
                self.slack, self.fy
            );
            return Err(ParameterError::inconsistent("slack", message));
        }
        Ok(())
    }
}

/// What one diagonal does.
struct Diagonal {
    tension: f64,
    tangent: f64,
    elongation: f64,
    dissipated: f64,
}

impl TensionBracing {
    /// A diagonal stretched by `stretch` that had yielded by `elongation` at the start of the step.
    fn diagonal(&self, stretch: f64, elongation: f64) -> Diagonal {
        let trial = self.k * (stretch - self.slack - elongation);
        if trial <= 0.0 {
            return Diagonal { tension: 0.0, tangent: 0.0, elongation, dissipated: 0.0 };
        }
        let hardening = self.hardening * self.k / (1.0 - self.hardening);
        let beyond = trial - (self.fy + hardening * elongation);
        if beyond <= 0.0 {
            return Diagonal { tension: trial, tangent: self.k, elongation, dissipated: 0.0 };
        }
        let more = beyond / (self.k + hardening);
        Diagonal {
            tension: trial - self.k * more,
            tangent: self.hardening * self.k,
            elongation: elongation + more,
            dissipated: more * (self.fy + hardening * (elongation + 0.5 * more)),
        }
    }
}

impl Link for TensionBracing {
    fn coordinates(&self) -> Coordinates {
        Coordinates::Local(vec![self.axis])
    }

    fn history(&self) -> Cow<'static, [Field]> {
        TensionBracingHistory::FIELDS.into()
    }

    fn engaged_stiffness(&self, k: &mut [f64]) {
        k[0] = self.k;
    }

    fn respond(
        &self,
        at: &Kinematics<'_>,
        committed: &[f64],
        trial: &mut [f64],
        out: &mut Response<'_>,
    ) {
        let was = TensionBracingHistory::load(committed);
        let one = self.diagonal(at.d[0], was.elongation1);
        let two = self.diagonal(-at.d[0], was.elongation2);
        out.f[0] = one.tension - two.tension;
        out.k[0] = one.tangent + two.tangent;
        out.energy.stored = 0.5 * (one.tension.powi(2) + two.tension.powi(2)) / self.k;
        out.energy.hysteretic = one.dissipated + two.dissipated;
        TensionBracingHistory { elongation1: one.elongation, elongation2: two.elongation }
            .store(trial);
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use trilith_element::conformance::Kit;
    use trilith_element::{Driver, Value, Values};

    /// The law as a model file would make it.
    fn read(given: &[(&str, f64)]) -> Result<TensionBracing, ParameterError> {
        let mut all = vec![("k", 2e7), ("fy", 2e5), ("hardening", 0.0), ("slack", 0.0)];
        for (name, x) in given {
            match all.iter_mut().find(|(n, _)| n == name) {
                Some(entry) => entry.1 = *x,
                None => all.push((name, *x)),
            }
        }
        let numbers = all.into_iter().map(|(n, x)| (n.to_owned(), Value::Number(x)));
        let axis = ("axis".to_owned(), Value::Text("U2".into()));
        let law: TensionBracing = Values(numbers.chain([axis]).collect()).read()?;
        law.check()?;
        Ok(law)
    }

    /// Leads the law through deformations; the forces there, and the law at the end.
    fn through<'a>(law: &'a TensionBracing, path: &[f64]) -> (Vec<f64>, Driver<'a>) {
        let mut driver = Driver::new(law);
        (path.iter().map(|d| driver.to(&[*d])[0]).collect(), driver)
    }

    fn assert_close(a: f64, b: f64) {
        assert!((a - b).abs() <= 1e-12 * a.abs().max(b.abs()).max(1e-12), "{a} {b}");
    }

    #[test]
    fn conforms_slack_taut_and_hardening() {
        for given in [
            &[][..],
            &[("hardening", 0.05)],
            &[("slack", 5e-3), ("hardening", 0.3)],
            &[("slack", -6e-3), ("hardening", 0.02)],
        ] {
            Kit::new(&[0.03], 1.0).rate_independent().assert(&read(given).unwrap());
        }
    }

    /// Yields at 10 mm; pulled to 30 mm a diagonal is 20 mm longer for good and has turned F_y · 20 mm into
    /// heat. Then it hangs loose down to where the other one is taut.
    #[test]
    fn yields_slackens_and_is_loose_on_the_way_back() {
        let law = read(&[]).unwrap();
        let (f, driver) = through(&law, &[5e-3, 0.03, 0.025, 0.02, 0.0, -5e-3]);
        let expected = [1e5, 2e5, 1e5, 0.0, 0.0, -1e5];
        f.iter().zip(expected).for_each(|(f, e)| assert!((f - e).abs() < 1e-6, "{f} {e}"));
        assert_close(driver.energy.hysteretic, 2e5 * 0.02);
        assert_close(driver.energy.stored, 1e5_f64.powi(2) / (2.0 * 2e7));
        let history = TensionBracingHistory::load(&driver.history);
        assert_close(history.elongation1, 0.02);
        assert_eq!(history.elongation2, 0.0);
    }

    #[test]
    fn a_second_excursion_dissipates_nothing() {
        let law = read(&[("hardening", 0.1)]).unwrap();
        let once = through(&law, &[0.03, -0.03, 0.0]).1.energy.hysteretic;
        let twice = through(&law, &[0.03, -0.03, 0.0, 0.03, -0.03, 0.0]).1.energy.hysteretic;
        assert_close(once, twice);
    }

    /// With hardening the force beyond yield is F_y + α k (d − F_y/k).
    #[test]
    fn hardens_along_the_second_line_of_its_skeleton() {
        let law = read(&[("hardening", 0.1)]).unwrap();
        assert_close(through(&law, &[0.03]).0[0], 2e5 + 0.1 * 2e7 * 0.02);
        // The same in many steps.
        let steps: Vec<f64> = (1..=300).map(|i| 1e-4 * f64::from(i)).collect();
        let (f, driver) = through(&law, &steps);
        assert_close(f[299], 2e5 + 0.1 * 2e7 * 0.02);
        // Work under the skeleton: triangle, rectangle, triangle.
        let work = 0.5 * 2e5 * 0.01 + 2e5 * 0.02 + 0.5 * 0.1 * 2e7 * 0.02 * 0.02;
        assert!((driver.accounted() - work).abs() < 1e-9 * work);
    }

    #[test]
    fn pretension_doubles_the_stiffness_until_a_diagonal_is_loose() {
        let law = read(&[("slack", -5e-3)]).unwrap();
        let (f, ..) = through(&law, &[1e-3, 6e-3]);
        assert_close(f[0], 2.0 * 2e7 * 1e-3);
        assert!((f[1] - 2e5).abs() < 1e-6, "the taut one has just yielded at 5 mm, {}", f[1]);
    }

    #[test]
    fn refuses_pretension_beyond_yield_and_unknown_parameters() {
        assert_eq!(read(&[("slack", -0.02)]).unwrap_err().parameter(), Some("slack"));
        assert!(read(&[("sag", 0.02)]).is_err());
    }
}
