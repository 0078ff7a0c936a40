//! Impact element of spring and dashpot (Kelvin–Voigt), for pounding.
//!
//! ```text
//!   i ●──┤  g  ├──/\/\/──● j      δ = −(d + g): penetration,  δ̇ = −ḋ
//!                └──[]───┘        N = k δ + c δ̇  where δ > 0, else 0;   f = −N
//!                  k, c           damps Approach: c acts where δ̇ > 0 only
//!                                 without `pull`: N ≥ 0
//! ```
//!
//! With `restitution` c = 2 ζ √(k m), and ζ(e) is exact for each variant:
//!
//! ```text
//!   Contact, pull:   ln e = −π ζ/√(1 − ζ²)                 Anagnostopoulos
//!   Contact:         ln e = −2 ζ acos(ζ)/√(1 − ζ²)
//!   Approach:        ln e = −ζ acos(ζ)/√(1 − ζ²)           (acosh and √(ζ² − 1) for ζ > 1)
//! ```
//!
//! `Contact` with `pull` is OpenSees' ViscoelasticGap; a gap beside a dashpot that never lets go, as
//! built in SAP2000, is a `Gap` and a `Dashpot`. In `Contact` without `pull` this is a
//! [`Dashpot`](crate::Dashpot) in contact with a stiffness. The dashpot takes hold over the first nanometre of an
//! approach, so that a joint without mass has an equilibrium at the touch.
//!
//! Reference: \[Anagnostopoulos 1988\]; damping on approach only as in \[Jankowski 2005\].

use crate::shared::restitution::{approach_ratio, damping_ratio};
use crate::shared::touch::strike;
use crate::shared::written::{Written, answers_by_law};
use serde::Deserialize;
use trilith_element::lanes::{LaneAt, LaneContact, LaneForce, LaneLaw, LaneStep, Real};
use trilith_element::{
    Axis, Card, Category, Choices, Contact, ContactUse, Coordinates, Described, Exercise, Impact,
    Kinematics, Link, NodeCount, ParameterError, Parameters, Stroke,
};

/// When the dashpot of an [`ImpactKelvin`] acts.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Deserialize, Choices)]
pub enum Damps {
    /// All the time in contact.
    Contact,
    /// In contact while the penetration grows.
    Approach,
}

/// Spring and dashpot in contact.
#[derive(Clone, Debug, Deserialize, Parameters)]
#[serde(deny_unknown_fields)]
pub struct ImpactKelvin {
    /// contact stiffness
    #[parameter("k", unit = "N/m", range = Positive)]
    pub k: f64,
    /// contact dashpot
    #[parameter("c", unit = "N·s/m", range = NonNegative)]
    pub damping: Option<f64>,
    /// instead of `damping`: speed after over speed before an impact
    #[parameter("e", unit = "1", range = Above(0.0, 1.0))]
    pub restitution: Option<f64>,
    /// mass that strikes, for `restitution`; none: worked out from the structure
    #[parameter("m", unit = "kg", range = Positive)]
    pub impact_mass: Option<f64>,
    /// clearance at rest
    #[parameter("g", unit = "m", default = 0.0)]
    pub opening: f64,
    /// all the time in contact, or until the penetration turns
    #[parameter(choices = Damps::NAMES, default = "Contact")]
    pub damps: Damps,
    /// the force may pull while closed
    #[parameter]
    pub pull: bool,
    /// local axis
    #[parameter(choices = ["U1", "U2", "U3"], default = "U1")]
    pub axis: Axis,
}

impl Described for ImpactKelvin {
    const CARD: Card = Card::new(
        "ImpactKelvin",
        Category::Link,
        "Pounding: spring and dashpot in contact after a clearance.",
    )
    .nodes(NodeCount::GROUND_OR_TWO)
    .parameters(Self::PARAMETERS)
    .law("δ = −(d + g), δ̇ = −ḋ\n\
          f = −(k δ + c δ̇) where δ > 0, else 0; without `pull` at most 0\n\
          damps Approach: c acts where δ̇ > 0 only\n\
          with `restitution`: c = 2 ζ(e) √(k m)")
    .source("Anagnostopoulos 1988; Jankowski 2005 (approach only)")
    .example(r#""joint": ImpactKelvin(nodes: ("a", "b"), k: "100 MN/m", restitution: 0.6, impact_mass: "50 t", opening: "20 mm")"#)
    .exercise(Exercise::new(1.0, &[Stroke::about(0.0, 0.03)]));

    fn check(&self) -> Result<(), ParameterError> {
        let (name, message) = if self.damping.is_some() == self.restitution.is_some() {
            ("damping", "give either `damping` or `restitution`")
        } else if self.impact_mass.is_some() && self.restitution.is_none() {
            ("impact_mass", "`impact_mass` belongs to `restitution`: give both, or `damping`")
        } else if self.pull && self.damps == Damps::Approach {
            ("pull", "a dashpot that acts on approach only never pulls: leave `pull` out")
        } else {
            return Ok(());
        };
        Err(ParameterError::inconsistent(name, message))
    }
}

/// The law over lanes; parameters k, c, g. `APPROACH`: the dashpot acts on approach only; `PULLS`: the total may pull.
struct Pounding<const APPROACH: bool, const PULLS: bool>;

impl<const APPROACH: bool, const PULLS: bool> Pounding<APPROACH, PULLS> {
    /// Force, its derivatives by d and ḋ, and the force of the spring in it.
    #[inline(always)]
    fn total<R: Real>(p: &[R], d: R, v: R) -> [R; 4] {
        let c = if APPROACH { p[1].only(v.lt(v.of(0.0))) } else { p[1] };
        strike::<R, PULLS>(p[0], [c * v, c], d + p[2], v)
    }
}

impl<const APPROACH: bool, const PULLS: bool> LaneLaw for Pounding<APPROACH, PULLS> {
    const COORDINATES: usize = 1;
    const HISTORY: usize = 0;
    const PARAMETERS: usize = 3;
    const CONTACTS: usize = 1;

    #[inline(always)]
    fn respond<R: Real>(
        at: &LaneAt<'_, R>,
        out: &mut LaneForce<'_, R>,
        _: &mut [R],
    ) -> LaneStep<R> {
        let [f0, _, _, spring0] = Self::total(at.parameters, at.d0[0], at.v0[0]);
        let [f, k, c, spring] = Self::total(at.parameters, at.d[0], at.v[0]);
        (out.f[0], out.k[0], out.c[0]) = (f, k, c);
        let stored = f.of(0.5) * spring * spring / at.parameters[0];
        let viscous = at.viscous_work(0, f0 - spring0, f - spring);
        LaneStep { viscous, ..LaneStep::elastic(stored) }
    }

    #[inline(always)]
    fn contacts<R: Real>(at: &LaneAt<'_, R>, f: &[R], out: &mut [LaneContact<R>]) -> R {
        let zero = f[0].of(0.0);
        out[0] = LaneContact::smooth(at.d[0] + at.parameters[2], (-f[0]).max(zero));
        zero
    }
}

impl ImpactKelvin {
    fn law(&self) -> Written {
        match (self.damps, self.pull) {
            (Damps::Approach, _) => Written::of::<Pounding<true, false>>(),
            (Damps::Contact, true) => Written::of::<Pounding<false, true>>(),
            (Damps::Contact, false) => Written::of::<Pounding<false, false>>(),
        }
    }

    fn numbers(&self) -> [f64; 3] {
        [self.k, self.damping.unwrap_or(0.0), self.opening]
    }
}

impl Link for ImpactKelvin {
    fn coordinates(&self) -> Coordinates {
        Coordinates::Local(vec![self.axis])
    }

    fn engaged_stiffness(&self, k: &mut [f64]) {
        k[0] = self.k;
    }

    answers_by_law!();

    fn impact(&self) -> Option<Impact> {
        Some(
            Impact::new(0, self.k, self.damping.unwrap_or(0.0))
                .restituting(self.restitution, self.impact_mass),
        )
    }

    fn restituting(&self, restitution: f64, mass: f64) -> Option<Box<dyn Link>> {
        let ratio = match self.damps {
            Damps::Contact => damping_ratio(restitution, self.pull),
            Damps::Approach => approach_ratio(restitution),
        };
        let damping = Some(2.0 * ratio * (self.k * mass).sqrt());
        Some(Box::new(Self { damping, restitution: None, impact_mass: None, ..self.clone() }))
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
mod tests {
    use super::*;
    use crate::shared::parameters::{numbers, read};
    use crate::shared::paths::rebound;
    use approx::assert_relative_eq;
    use trilith_element::conformance::Kit;
    use trilith_element::{Answer, Value};

    const VARIANTS: [(&str, bool); 3] =
        [("Contact", false), ("Contact", true), ("Approach", false)];

    fn law(given: &[(&str, f64)], (damps, pull): (&str, bool)) -> ImpactKelvin {
        let mut all = numbers(given);
        all.push(("k", Value::Number(1e8)));
        all.push(("damps", Value::Text(damps.into())));
        all.push(("pull", Value::Flag(pull)));
        read(&all).unwrap()
    }

    #[test]
    fn conforms_in_every_variant() {
        for variant in VARIANTS {
            for c in [0.0, 1e5, 2e6] {
                for opening in [0.0, 0.01, -0.005] {
                    let law = law(&[("damping", c), ("opening", opening)], variant);
                    Kit::new(&[0.03], 1.0).assert(&law);
                }
            }
        }
    }

    #[test]
    fn an_impact_returns_the_restitution() {
        for variant in VARIANTS {
            for e in [0.1, 0.4, 0.65, 0.9, 1.0] {
                let waiting = law(&[("restitution", e)], variant);
                let law = waiting.restituting(e, 5e4).unwrap();
                for speed in [0.01, 1.0] {
                    let got = rebound(law.as_ref(), 5e4, speed, 2e-6);
                    assert_relative_eq!(got, e, max_relative = 2e-3);
                }
            }
        }
    }

    /// Force, and its derivatives by d and ḋ.
    fn total(law: &ImpactKelvin, d: f64, v: f64) -> [f64; 3] {
        let it = Answer::of(law, &Kinematics::still(&[d], &[v]), &[]);
        [it.f[0], it.k[0], it.c[0]]
    }

    #[test]
    fn in_contact_it_is_a_dashpot_with_a_stiffness() {
        let force = |variant: usize, v: f64| {
            let law = law(&[("damping", 1e6), ("opening", 0.01)], VARIANTS[variant]);
            total(&law, -0.0101, v)[0]
        };
        assert_relative_eq!(force(1, 0.5), -1e4 + 5e5, max_relative = 1e-9);
        assert_eq!(force(0, 0.5), 0.0);
        assert_relative_eq!(force(2, 0.5), -1e4, max_relative = 1e-9);
        assert_relative_eq!(force(2, -0.5), -5.1e5, max_relative = 1e-9);
    }

    #[test]
    fn the_force_has_no_jump_at_the_touch() {
        for variant in VARIANTS {
            let law = law(&[("damping", 1e6), ("opening", 0.01)], variant);
            let [f, k, c] = total(&law, -0.01 - 2.5e-10, -0.5);
            assert_relative_eq!(f, -0.025 - 0.25 * 5e5, max_relative = 1e-6);
            assert_relative_eq!(k, 1e8 + 5e5 / 1e-9, max_relative = 1e-6);
            assert_relative_eq!(c, 0.25e6, max_relative = 1e-6);
        }
    }

    #[test]
    fn refuses_both_or_none_and_a_mass_alone() {
        let k = ("k", 1.0);
        let refused = |given: &[(&str, f64)]| {
            let error = read::<ImpactKelvin>(&numbers(given)).unwrap_err();
            error.parameter().unwrap_or_default().to_owned()
        };
        assert_eq!(refused(&[k]), "damping");
        assert_eq!(refused(&[k, ("damping", 1.0), ("restitution", 0.5)]), "damping");
        assert_eq!(refused(&[k, ("damping", 1.0), ("impact_mass", 0.5)]), "impact_mass");
    }
}
