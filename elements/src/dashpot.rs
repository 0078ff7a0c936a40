//! Dashpot: a force that grows with a power of the rate, always or in contact only.
//!
//! ```text
//!   F(v) = c sgn(v) |v|^α                       |v| ≥ v₀ or α ≥ 1
//!   F(v) = c v₀^(α−1) v                         |v| < v₀ and α < 1   (the tangent at rest is finite)
//!   Always:     f = F(ḋ)
//!   InContact:  f = F(ḋ) + k (d + g)            where d < −g; else 0; without `pull` at most 0
//! ```
//!
//! `opening` to `pull` matter with `InContact` only. With `restitution`, which needs the `stiffness` and
//! α = 1, c = 2 ζ(e) √(k m): see [`NLink`](crate::NLink) for the mass. At v₀ the force is continuous; c v₀^α
//! is the force that the linear range spans, which should be small against the forces of interest. In contact F takes
//! hold over the first nanometre of an approach, so that a joint without mass has an equilibrium at the touch.
//!
//! Reference: \[Soong & Dargush 1997, ch. 6\]; contact variant \[Wilson 2002, ch. 21\].

use crate::shared::restitution::damping_ratio;
use crate::shared::touch::strike;
use crate::shared::written::{Written, answers_by_law};
use serde::Deserialize;
use trilith_element::lanes::{LaneAt, LaneForce, LaneLaw, LaneStep, Real};
use trilith_element::{
    Axis, Card, Category, Choices, Contact, ContactUse, Coordinates, Described, Exercise, Impact,
    Kinematics, Link, NodeCount, ParameterError, Parameters, Stroke,
};

/// When a [`Dashpot`] acts.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Deserialize, Choices)]
pub enum When {
    /// At all times.
    Always,
    /// While the link is shorter than its clearance allows.
    InContact,
}

/// Power-law dashpot, always or in contact only.
#[derive(Clone, Debug, Deserialize, Parameters)]
#[serde(deny_unknown_fields)]
pub struct Dashpot {
    /// coefficient along U1, U2 or U3
    #[parameter("c", unit = "N", per = "m/s", exponent = "exponent", range = Positive)]
    pub c: Option<f64>,
    /// instead of `c`: coefficient about R1, R2 or R3
    #[parameter("c", unit = "N·m", per = "rad/s", exponent = "exponent", range = Positive)]
    pub cr: Option<f64>,
    /// exponent of the rate
    #[parameter("α", unit = "1", range = Above(0.0, 2.0), default = 1.0)]
    pub exponent: f64,
    /// local axis
    #[parameter(choices = Axis::NAMES, default = "U1")]
    pub axis: Axis,
    /// when it acts
    #[parameter(choices = When::NAMES, default = "Always")]
    pub when: When,
    /// clearance of the contact
    #[parameter("g", unit = "m", default = 0.0)]
    pub opening: f64,
    /// spring of the contact
    #[parameter("k", unit = "N/m", range = NonNegative, default = 0.0)]
    pub stiffness: f64,
    /// instead of `c`, in contact: speed after over speed before an impact
    #[parameter("e", unit = "1", range = Above(0.0, 1.0))]
    pub restitution: Option<f64>,
    /// mass that strikes, for `restitution`; none: worked out from the structure
    #[parameter("m", unit = "kg", range = Positive)]
    pub impact_mass: Option<f64>,
    /// the total force may pull while closed
    #[parameter]
    pub pull: bool,
    /// rate below which α < 1 is linear (rad/s with `cr`)
    #[parameter("v₀", unit = "m/s", range = Positive, default = 1e-6)]
    pub linear_below: f64,
}

impl Described for Dashpot {
    const CARD: Card = Card::new(
        "Dashpot",
        Category::Link,
        "Dashpot with a power of the rate, acting always or in contact only.",
    )
    .nodes(NodeCount::GROUND_OR_TWO)
    .parameters(Self::PARAMETERS)
    .law(
        "F(v) = c sgn(v) |v|^α; for α < 1 and |v| < v₀: c v₀^(α−1) v\n\
              Always:    f = F(ḋ)\n\
              InContact: f = F(ḋ) + k (d + g) where d < −g, else 0; without `pull` at most 0\n\
              with `restitution`: c = 2 ζ(e) √(k m)",
    )
    .source("Soong & Dargush, Passive Energy Dissipation Systems, 1997, ch. 6; Wilson 2002, ch. 21")
    .example(r#""damper": Dashpot(nodes: ("a", "b"), c: "20 kN*s/m")"#)
    .exercise(Exercise::new(1.0, &[Stroke::about(0.0, 0.05)]));

    fn check(&self) -> Result<(), ParameterError> {
        let rotational = self.axis.index() > 2;
        let (wanted, other) = if rotational { ("cr", self.c) } else { ("c", self.cr) };
        if self.restitution.is_some() {
            self.check_restitution()?;
        } else if self.impact_mass.is_some() {
            let message = "`impact_mass` belongs to `restitution`: give both, or `c`";
            return Err(ParameterError::inconsistent("impact_mass", message));
        } else if other.is_some() || self.coefficient().is_none() {
            let message =
                format!("a dashpot along {} takes `{wanted}` and nothing else", self.axis.name());
            return Err(ParameterError::inconsistent(wanted, message));
        }
        if self.when == When::InContact && rotational {
            let message = "a dashpot in contact needs a translational axis: U1, U2 or U3";
            return Err(ParameterError::inconsistent("axis", message));
        }
        if self.when == When::Always && (self.stiffness != 0.0 || self.opening != 0.0 || self.pull)
        {
            let message =
                "`stiffness`, `opening` and `pull` belong to a contact: add `when: InContact`";
            return Err(ParameterError::inconsistent("when", message));
        }
        Ok(())
    }
}

impl Dashpot {
    fn check_restitution(&self) -> Result<(), ParameterError> {
        let message = if self.c.is_some() || self.cr.is_some() {
            "`restitution` sets the coefficient: leave `c` out, or `restitution`"
        } else if self.when != When::InContact {
            "`restitution` belongs to a contact: add `when: InContact`"
        } else if self.stiffness == 0.0 || self.exponent != 1.0 {
            "`restitution` needs the contact's `stiffness` in this dashpot, and exponent 1"
        } else {
            return Ok(());
        };
        Err(ParameterError::inconsistent("restitution", message))
    }

    fn coefficient(&self) -> Option<f64> {
        if self.axis.index() > 2 { self.cr } else { self.c }
    }

    fn law(&self) -> Written {
        let is_power = self.exponent != 1.0;
        match (self.when, self.pull) {
            (When::Always, _) => of_power::<ALWAYS>(is_power),
            (When::InContact, true) => of_power::<PULLS>(is_power),
            (When::InContact, false) => of_power::<PRESSES>(is_power),
        }
    }

    /// Parameters of the law.
    fn numbers(&self) -> [f64; 6] {
        let (c, alpha) = (self.coefficient().unwrap_or(0.0), self.exponent);
        let by = if self.stiffness > 0.0 { self.stiffness.recip() } else { 0.0 };
        let below = if alpha < 1.0 { self.linear_below } else { 0.0 };
        [c, self.stiffness, self.opening, by, alpha, below]
    }
}

fn of_power<const WHEN: u8>(is_power: bool) -> Written {
    if is_power { Written::of::<Law<WHEN, true>>() } else { Written::of::<Law<WHEN, false>>() }
}

/// The law over lanes; parameters c, k, g, 1/k (0 without k), and where it has a power of the rate α, v₀ (0 where α is not
/// below 1).
struct Law<const WHEN: u8, const POWER: bool>;

const ALWAYS: u8 = 0;
const PULLS: u8 = 1;
const PRESSES: u8 = 2;

impl<const WHEN: u8, const POWER: bool> Law<WHEN, POWER> {
    /// F(v) and its derivative.
    #[inline(always)]
    fn of_rate<R: Real>(p: &[R], v: R) -> [R; 2] {
        let (c, zero, one) = (p[0], p[0].of(0.0), p[0].of(1.0));
        if !POWER {
            return [c * v, c];
        }
        let (alpha, below, size) = (p[4], p[5], v.abs());
        let some = zero.lt(size);
        let power = (c * R::select(some, size, one).powf(alpha)).only(some);
        let steep = (alpha * power / R::select(some, size, one)).only(some);
        let is_slow = size.lt(below);
        let force = R::select(v.lt(zero), -power, power);
        if !v.any(is_slow) {
            return [force, steep];
        }
        let gentle = c * R::select(is_slow, below, one).powf(alpha - one);
        [R::select(is_slow, gentle * v, force), R::select(is_slow, gentle, steep)]
    }

    /// Total force, its derivatives by d and ḋ, and the force of the spring in it.
    #[inline(always)]
    fn total<R: Real>(p: &[R], d: R, v: R) -> [R; 4] {
        let [force, slope] = Self::of_rate(p, v);
        match WHEN {
            ALWAYS => [force, p[0].of(0.0), slope, p[0].of(0.0)],
            PULLS => strike::<R, true>(p[1], [force, slope], d + p[2], v),
            _ => strike::<R, false>(p[1], [force, slope], d + p[2], v),
        }
    }
}

impl<const WHEN: u8, const POWER: bool> LaneLaw for Law<WHEN, POWER> {
    const COORDINATES: usize = 1;
    const HISTORY: usize = 0;
    const PARAMETERS: usize = if POWER { 6 } else { 4 };

    #[inline(always)]
    fn respond<R: Real>(
        at: &LaneAt<'_, R>,
        out: &mut LaneForce<'_, R>,
        _: &mut [R],
    ) -> LaneStep<R> {
        let [f0, _, _, spring0] = Self::total(at.parameters, at.d0[0], at.v0[0]);
        let [f, k, c, spring] = Self::total(at.parameters, at.d[0], at.v[0]);
        (out.f[0], out.k[0], out.c[0]) = (f, k, c);
        let stored = f.of(0.5) * spring * spring * at.parameters[3];
        let viscous = at.viscous_work(0, f0 - spring0, f - spring);
        LaneStep { viscous, ..LaneStep::elastic(stored) }
    }
}

impl Link for Dashpot {
    fn coordinates(&self) -> Coordinates {
        Coordinates::Local(vec![self.axis])
    }

    fn engaged_stiffness(&self, k: &mut [f64]) {
        k[0] = if self.when == When::InContact { self.stiffness } else { 0.0 };
    }

    answers_by_law!();

    fn damping_constant(&self) -> Option<f64> {
        let linear = self.when == When::Always && self.exponent == 1.0;
        self.coefficient().filter(|_| linear)
    }

    fn impact(&self) -> Option<Impact> {
        let bears = self.when == When::InContact && self.stiffness > 0.0 && self.exponent == 1.0;
        bears.then(|| {
            Impact::new(0, self.stiffness, self.c.unwrap_or(0.0))
                .restituting(self.restitution, self.impact_mass)
        })
    }

    fn restituting(&self, restitution: f64, mass: f64) -> Option<Box<dyn Link>> {
        self.impact()?;
        let ratio = damping_ratio(restitution, self.pull);
        let c = Some(2.0 * ratio * (self.stiffness * mass).sqrt());
        Some(Box::new(Self { c, restitution: None, impact_mass: None, ..self.clone() }))
    }

    fn contact_use(&self) -> ContactUse {
        ContactUse::Stop
    }

    fn contacts(&self, at: &Kinematics<'_>, _: &[f64], f: &[f64], out: &mut Vec<Contact>) {
        let gap = at.d[0] + self.opening;
        if self.when == When::InContact && self.stiffness > 0.0 {
            out.push(Contact::new(gap, (-f[0]).max(0.0)));
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::shared::parameters::read;
    use approx::assert_relative_eq;
    use trilith_element::conformance::assert_conforms;
    use trilith_element::{Answer, Value};

    fn dashpot(given: &[(&str, Value)]) -> Dashpot {
        let mut all = vec![("c", Value::Number(2e4))];
        all.extend(given.iter().cloned());
        read(&all).unwrap()
    }

    fn contact(given: &[(&str, Value)]) -> Dashpot {
        let mut all = vec![("when", Value::Text("InContact".into()))];
        all.extend(given.iter().cloned());
        dashpot(&all)
    }

    #[test]
    fn conforms_for_every_exponent_and_in_contact() {
        for exponent in [0.3, 0.5, 1.0, 1.7, 2.0] {
            let exponent = ("exponent", Value::Number(exponent));
            assert_conforms(&dashpot(std::slice::from_ref(&exponent)), &[0.05], 1.0);
            let k = ("stiffness", Value::Number(1e6));
            assert_conforms(&contact(&[exponent.clone(), k.clone()]), &[0.05], 1.0);
            let pull = ("pull", Value::Flag(true));
            assert_conforms(&contact(&[exponent.clone(), k, pull.clone()]), &[0.05], 1.0);
            assert_conforms(&contact(&[exponent, pull]), &[0.05], 1.0);
        }
    }

    /// Force, and its derivatives by d and ḋ.
    fn total(law: &Dashpot, d: f64, v: f64) -> [f64; 3] {
        let it = Answer::of(law, &Kinematics::still(&[d], &[v]), &[]);
        [it.f[0], it.k[0], it.c[0]]
    }

    #[test]
    fn the_force_is_a_signed_power_and_continuous_at_the_linear_range() {
        let law = dashpot(&[("exponent", Value::Number(0.5))]);
        let force = |v: f64| total(&law, 0.0, v);
        assert_relative_eq!(force(0.04)[0], 2e4 * 0.2, max_relative = 1e-14);
        assert_relative_eq!(force(-0.04)[0], -2e4 * 0.2, max_relative = 1e-14);
        let (inside, outside) = (force(1e-6 * (1.0 - 1e-12)), force(1e-6));
        assert_relative_eq!(inside[0], outside[0], max_relative = 1e-10);
        assert_eq!(force(0.0)[0], 0.0);
        assert!(force(0.0)[2].is_finite());
    }

    #[test]
    fn a_dashpot_in_contact_neither_acts_in_flight_nor_pulls() {
        let law = contact(&[]);
        let force = |d: f64, v: f64| total(&law, d, v)[0];
        assert_eq!(force(1e-6, -1.0), 0.0);
        assert_eq!(force(-1e-6, -1.0), -2e4);
        assert_eq!(force(-1e-6, 1.0), 0.0);
        let with_spring = contact(&[("stiffness", Value::Number(1e6))]);
        assert_eq!(total(&with_spring, -0.1, 1.0)[0], 2e4 - 1e5);
        assert_eq!(total(&with_spring, -0.01, 1.0)[0], 0.0);
    }

    #[test]
    fn a_dashpot_in_contact_takes_hold_without_a_jump() {
        for exponent in [1.0, 1.5] {
            let law = contact(&[("exponent", Value::Number(exponent))]);
            let [f, k, c] = total(&law, -2.5e-10, -1.0);
            assert_relative_eq!(f, -0.25 * 2e4, max_relative = 1e-9);
            assert_relative_eq!(k, 2e4 / 1e-9, max_relative = 1e-9);
            assert_relative_eq!(c, 0.25 * exponent * 2e4, max_relative = 1e-9);
        }
    }

    #[test]
    fn refuses_a_coefficient_of_the_wrong_kind_and_a_contact_about_an_axis() {
        let r2 = ("axis", Value::Text("R2".into()));
        let c = ("c", Value::Number(1.0));
        let err = read::<Dashpot>(&[c.clone(), r2.clone()]).unwrap_err();
        assert_eq!(err.parameter(), Some("cr"));
        let cr = ("cr", Value::Number(1.0));
        assert!(read::<Dashpot>(&[cr.clone(), r2.clone()]).is_ok());
        let when = ("when", Value::Text("InContact".into()));
        assert!(read::<Dashpot>(&[cr, r2, when]).is_err());
        let e = ("restitution", Value::Number(0.5));
        let k = ("stiffness", Value::Number(1e6));
        let in_contact = ("when", Value::Text("InContact".into()));
        let whole = [e.clone(), k.clone(), in_contact.clone()];
        assert!(read::<Dashpot>(&whole).is_ok());
        for wrong in [
            vec![e.clone(), k.clone(), in_contact.clone(), c.clone()],
            vec![e.clone(), k.clone()],
            vec![e.clone(), in_contact],
        ] {
            assert_eq!(read::<Dashpot>(&wrong).unwrap_err().parameter(), Some("restitution"));
        }
        let stray = [c, ("stiffness", Value::Number(1.0))];
        assert_eq!(read::<Dashpot>(&stray).unwrap_err().parameter(), Some("when"));
    }
}
