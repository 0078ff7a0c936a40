//! Laws that are wrong on purpose. A test that cannot fail shows nothing: every one of them must be
//! caught, by the conformance kit where it breaks the contract of a link, by a closed form where it is
//! a sound law of something else.

use serde::Deserialize;
use std::borrow::Cow;
use trilith::element::conformance::{ConformanceError, Kit};
use trilith::element::{
    Card, Category, Contact, Coordinates, Described, Energy, Exercise, Field, Kinematics, Link,
    NodeCount, Parameters, Register, Response,
};
use trilith::elements::{Gap, NLink};
use trilith_validation::case::BOTH;
use trilith_validation::{Case, Check, Outcome, Unit, View, cases};

fn gap(k: f64, opening: f64) -> Gap {
    Gap { k, opening, axis: trilith::element::Axis::U1 }
}

/// A tangent half of what it should be.
#[derive(Debug)]
struct WrongTangent(Gap);

impl Link for WrongTangent {
    fn coordinates(&self) -> Coordinates {
        self.0.coordinates()
    }
    fn engaged_stiffness(&self, k: &mut [f64]) {
        self.0.engaged_stiffness(k);
    }
    fn respond(&self, at: &Kinematics<'_>, a: &[f64], b: &mut [f64], out: &mut Response<'_>) {
        self.0.respond(at, a, b, out);
        out.k[0] *= 0.5;
    }
}

/// Asks whether it is closed where the step began: a step late.
#[derive(Debug)]
struct StepLate(Gap);

impl Link for StepLate {
    fn coordinates(&self) -> Coordinates {
        self.0.coordinates()
    }
    fn engaged_stiffness(&self, k: &mut [f64]) {
        self.0.engaged_stiffness(k);
    }
    fn respond(&self, at: &Kinematics<'_>, a: &[f64], b: &mut [f64], out: &mut Response<'_>) {
        if at.d0[0] + self.0.opening < 0.0 {
            self.0.respond(at, a, b, out);
        }
    }
}

/// Closes a millimetre late: in itself a sound law, of another gap.
#[derive(Debug, Deserialize, Parameters)]
#[parameters(crate = trilith::element)]
#[serde(deny_unknown_fields)]
struct LateGap {
    /// stiffness
    #[parameter("k", unit = "N/m", range = Positive)]
    k: f64,
    /// clearance at rest
    #[parameter("g", unit = "m", default = 0.0)]
    opening: f64,
}

impl LateGap {
    fn law(&self) -> Gap {
        gap(self.k, self.opening + 1e-3)
    }
}

impl Described for LateGap {
    const CARD: Card = Card::new("LateGap", Category::Link, "A gap that closes a millimetre late.")
        .nodes(NodeCount::GROUND_OR_TWO)
        .parameters(Self::PARAMETERS)
        .law("f = k (d + g + 1 mm) where that is below zero")
        .source("wrong on purpose")
        .example(r#""stop": LateGap(node: "a", k: "1 MN/m")"#)
        .exercise(Exercise::NONE);
}

impl Link for LateGap {
    fn coordinates(&self) -> Coordinates {
        self.law().coordinates()
    }
    fn engaged_stiffness(&self, k: &mut [f64]) {
        self.law().engaged_stiffness(k);
    }
    fn respond(&self, at: &Kinematics<'_>, a: &[f64], b: &mut [f64], out: &mut Response<'_>) {
        self.law().respond(at, a, b, out);
    }
    fn contacts(&self, at: &Kinematics<'_>, a: &[f64], f: &[f64], out: &mut Vec<Contact>) {
        self.law().contacts(at, a, f, out);
    }
}

/// Friction whose limit is that of a constant weight, whatever presses on it.
#[derive(Debug, Deserialize, Parameters)]
#[parameters(crate = trilith::element)]
#[serde(deny_unknown_fields)]
struct Uncoupled {
    /// contact stiffness
    #[parameter("kₙ", unit = "N/m", range = Positive)]
    kn: f64,
    /// pre-slip stiffness
    #[parameter("kₛ", unit = "N/m", range = Positive)]
    ks: f64,
    /// friction coefficient
    #[parameter("μ", unit = "1", range = NonNegative)]
    mu: f64,
    /// constant normal force
    #[parameter("W", unit = "N", range = Positive)]
    weight: f64,
}

impl Uncoupled {
    fn law(&self) -> NLink {
        NLink { ks: Some(self.ks), mu: Some(self.mu), ..NLink::new(self.kn) }
    }
}

impl Described for Uncoupled {
    const CARD: Card = Card::new(
        "UncoupledNLink",
        Category::Link,
        "A contact whose friction does not know the normal force.",
    )
    .nodes(NodeCount::GROUND_OR_TWO)
    .parameters(Self::PARAMETERS)
    .law("|τ| ≤ μ W")
    .source("wrong on purpose")
    .example(r#""foot": UncoupledNLink(node: "a", kn: 1e6, ks: 1e6, mu: 0.1, weight: 10)"#)
    .exercise(Exercise::NONE);
}

impl Link for Uncoupled {
    fn coordinates(&self) -> Coordinates {
        self.law().coordinates()
    }
    fn history(&self) -> Cow<'static, [Field]> {
        self.law().history()
    }
    fn at_rest(&self, at: &mut [f64]) {
        self.law().at_rest(at);
    }
    fn engaged_stiffness(&self, k: &mut [f64]) {
        self.law().engaged_stiffness(k);
    }
    fn respond(&self, at: &Kinematics<'_>, a: &[f64], b: &mut [f64], out: &mut Response<'_>) {
        // The friction of the sound law, pressed by the weight at all times.
        let pressed = -self.weight / self.kn;
        let (mut d, mut d0) = ([0.0; 3], [0.0; 3]);
        d.copy_from_slice(at.d);
        d0.copy_from_slice(at.d0);
        (d[0], d0[0]) = (pressed, pressed);
        self.law().respond(&Kinematics::new([&d, at.v], [&d0, at.v0], at.dt), a, b, out);
        for i in [1, 2, 3, 6] {
            out.k[i] = 0.0;
        }
        out.energy.stored -= 0.5 * self.kn * pressed * pressed;
        // And the normal force of the real penetration.
        let (mut f, mut k, mut c, mut energy) = ([0.0], [0.0], [0.0], Energy::default());
        let mut normal = Response::new(&mut f, &mut k, &mut c, &mut energy);
        let one = Kinematics::new([&at.d[..1], &at.v[..1]], [&at.d0[..1], &at.v0[..1]], at.dt);
        gap(self.kn, 0.0).respond(&one, &[], &mut [], &mut normal);
        (out.f[0], out.k[0]) = (f[0], k[0]);
        out.energy.stored += energy.stored;
    }
}

/// The verdict of a case with one kind in the place of another.
fn verdict(mut case: Case, kind: &str, by: &str) -> Outcome {
    assert!(case.text.contains(kind), "{} has no {kind}", case.id);
    case.text = case.text.replace(kind, by);
    let mut kinds = trilith::registry();
    kinds.link::<LateGap>();
    kinds.link::<Uncoupled>();
    case.run_with(&kinds)
}

fn case(id: &str) -> Case {
    cases::all().into_iter().find(|c| c.id == id).unwrap_or_else(|| panic!("no case {id}"))
}

/// No value is missing: it fails by what it gave, not because it could not be run.
fn fails_by_value(outcome: &Outcome) -> bool {
    !outcome.pass() && outcome.rows.iter().all(|r| r.value.is_some())
}

/// A mass under a push that is less than its friction, until the normal force has fallen far enough:
/// from tₛ = T (1 − P/μN₀) on it moves by μN₀ (t − tₛ)³/(6 m T) while N = N₀ (1 − t/T).
fn unloading() -> Case {
    let (mass, normal, mu, push, end) = (1.0, 10.0, 0.5, 3.0, 1.0);
    let start = end * (1.0 - push / (mu * normal));
    let u = move |t: f64| mu * normal * (t - start).powi(3) / (6.0 * mass * end);
    let metre = Unit::si("m");
    Case {
        id: "unloading",
        title: "Friction under a normal force that falls",
        source: "m ü = P − μ N(t)",
        text: r#"(
            nodes: { "m": (0, 0, 0) },
            supports: { "m": (Uy, Rx, Ry, Rz) },
            elements: {
                "mass": Mass(node: "m", mass: 1),
                "contact": NLink(node: "m", kn: 1e7, ks: 1e7, mu: 0.5),
            },
            loads: {
                "press": [(node: "m", dof: Uz, force: -10), (node: "m", dof: Ux, force: 3)],
                "lift": [(node: "m", dof: Uz, force: 10)],
            },
            functions: { "ramp": Ramp(amplitude: 1, rise: 1) },
            cases: {
                "press": Static(loads: ["press"]),
                "lift": Dynamic(
                    after: "press", duration: 0.9, dt: 0.005,
                    forces: [(load: "lift", function: "ramp")],
                ),
            },
            outputs: { "u": Displacement(node: "m", dof: Ux) },
        )"#
        .into(),
        set: Vec::new(),
        solvers: BOTH,
        checks: [0.6, 0.75, 0.9].map(|t| Check::at("u", metre, t, u(t), 2e-3)).into(),
        view: View::default(),
    }
}

#[test]
fn the_kit_catches_a_wrong_tangent() {
    let kit = Kit::new(&[0.05], 1.0).rate_independent();
    kit.assert(&gap(2e8, 0.02));
    let found = kit.check(&WrongTangent(gap(2e8, 0.02)));
    assert!(matches!(found, Err(ConformanceError::Tangent { which: "k", .. })), "{found:?}");
}

#[test]
fn the_kit_catches_a_gap_that_closes_a_step_late() {
    let found = Kit::new(&[0.05], 1.0).check(&StepLate(gap(2e8, 0.02)));
    assert!(matches!(found, Err(ConformanceError::Restart { .. })), "{found:?}");
}

#[test]
fn closed_forms_catch_a_gap_that_closes_a_millimetre_late() {
    // It keeps the contract of a link, so the kit has nothing to say.
    Kit::new(&[0.05], 1.0).rate_independent().assert(&LateGap { k: 2e8, opening: 0.02 });
    for id in ["IM-3", "IM-4"] {
        assert!(case(id).run().pass(), "{id} with the sound law");
        let outcome = verdict(case(id), "Gap(", "LateGap(");
        assert!(fails_by_value(&outcome), "{id}: {:#?}", outcome.rows);
    }
}

#[test]
fn closed_forms_catch_friction_that_does_not_know_the_normal_force() {
    let law = Uncoupled { kn: 1e6, ks: 1e6, mu: 0.3, weight: 100.0 };
    Kit::new(&[1e-3; 3], 1.0).rate_independent().assert(&law);
    let broken =
        |case, weight: f64| verdict(case, "NLink(", &format!("UncoupledNLink(weight: {weight}, "));
    assert!(unloading().run().pass(), "{:#?}", unloading().run().rows);
    let outcome = broken(unloading(), 10.0);
    assert!(fails_by_value(&outcome), "{:#?}", outcome.rows);
    // Under a constant normal force nothing shows: such cases alone would not be enough.
    assert!(broken(case("SL-1"), 10.0).pass());
}
