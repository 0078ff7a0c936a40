//! Laws that are called, with functions in this language.

use crate::{
    Declaration, DeclarationError, DeclaredField, DeclaredParameter, DeclaredRange, DeclaredValue,
    Kind, LawFunction, NoAnswer,
};
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::sync::Arc;
use trilith_element::conformance::{ConformanceError, Kit};
use trilith_element::{
    Answer, Driver, Kinematics, LawFailed, Link, ParameterError, ReadLink, Register, Response,
    Value, Values,
};

/// An elastic–plastic spring beside a dashpot and a cubic spring; parameters k, f_y, c, and a deformation where it is torn.
#[derive(Debug, Default)]
struct Slider {
    /// Fails there instead of being torn.
    fails: bool,
}

const CUBE: f64 = 4e6;

impl LawFunction for Slider {
    fn respond(
        &self,
        p: &[f64],
        at: &Kinematics<'_>,
        committed: &[f64],
        trial: &mut [f64],
        out: &mut Response<'_>,
    ) -> Result<(), NoAnswer> {
        let [k, fy, c, torn] = *p else { return Err(NoAnswer::Failed("four numbers".into())) };
        let d = at.d[0];
        if d > torn {
            let why = format!("torn at {torn} m");
            let no = if self.fails { NoAnswer::Failed(why) } else { NoAnswer::Refused(why) };
            return Err(no);
        }
        let elastic = k * (d - committed[0]);
        let q = elastic.clamp(-fy, fy);
        trial[0] = d - q / k;
        out.f[0] = q + CUBE * d.powi(3) + c * at.v[0];
        out.k[0] = (if q == elastic { k } else { 0.0 }) + 3.0 * CUBE * d * d;
        out.c[0] = c;
        out.energy.stored = 0.5 * q * q / k + 0.25 * CUBE * d.powi(4);
        out.energy.hysteretic = q * (trial[0] - committed[0]);
        out.energy.viscous = at.viscous_work(0, c * at.v0[0], c * at.v[0]);
        Ok(())
    }

    fn check(&self, p: &[f64]) -> Result<(), String> {
        if p[1] / p[0] < p[3] { Ok(()) } else { Err("it tears before it yields".into()) }
    }
}

fn parameter(name: &str, unit: &str) -> DeclaredParameter {
    DeclaredParameter {
        name: name.into(),
        unit: unit.into(),
        meaning: String::new(),
        range: DeclaredRange::Positive,
        default: None,
        example: None,
    }
}

fn slider(tangent: bool, energy: bool) -> Declaration {
    let mut torn = parameter("torn", "m");
    torn.default = Some(DeclaredValue::Text("2 m".into()));
    Declaration {
        kind: "Slider".into(),
        summary: "A slider.".into(),
        axes: vec!["U2".into()],
        parameters: vec![
            parameter("k", "N/m"),
            parameter("fy", "N"),
            parameter("c", "N*s/m"),
            torn,
        ],
        history: vec![DeclaredField { name: "slip".into(), unit: "m".into() }],
        rates: true,
        tangent,
        energy,
        ..Declaration::default()
    }
}

/// Takes one kind.
#[derive(Default)]
struct One(Option<ReadLink>);

impl Register for One {
    fn add_linear(&mut self, _: &'static trilith_element::Card, _: trilith_element::ReadLinear) {}
    fn add_constraint(
        &mut self,
        _: &'static trilith_element::Card,
        _: trilith_element::ReadConstraint,
    ) {
    }
    fn add_link(&mut self, _: &'static trilith_element::Card, read: ReadLink) {
        self.0 = Some(read);
    }
    fn add_function(
        &mut self,
        _: &'static trilith_element::Card,
        _: trilith_element::ReadFunction,
    ) {
    }
    fn add_output(&mut self, _: &'static trilith_element::Card, _: trilith_element::ReadOutput) {}
    fn add_solver(&mut self, _: &'static trilith_element::Card, _: trilith_element::ReadSolver) {}
}

fn made(
    declaration: &Declaration,
    function: Slider,
    torn: f64,
) -> Result<Box<dyn Link>, ParameterError> {
    let kind = Kind::new(declaration, Arc::new(function)).expect("a declaration");
    let mut one = One::default();
    kind.register(&mut one);
    let values = [("k", 1e5), ("fy", 500.0), ("c", 200.0), ("torn", torn)];
    let values = values.map(|(name, x)| (name.to_owned(), Value::Number(x)));
    one.0.expect("a kind")(&Values(values.to_vec()))
}

fn link(tangent: bool, energy: bool) -> Box<dyn Link> {
    made(&slider(tangent, energy), Slider::default(), 2.0).expect("a law")
}

#[test]
fn a_called_law_conforms_whatever_it_tells() {
    for (tangent, energy) in [(true, true), (false, true), (true, false), (false, false)] {
        let law = link(tangent, energy);
        let report = Kit::new(&[0.01], 1.0).check(&*law).expect("a law");
        assert!(report.tangents > 100 && report.energy_error < 2e-3, "{report:?}");
        assert_eq!(law.accounts(), energy);
        let mut k = [0.0];
        law.engaged_stiffness(&mut k);
        assert!((k[0] / 1e5 - 1.0).abs() < 1e-8, "{k:?}");
    }
}

#[test]
fn differences_are_the_tangents_to_a_billionth() {
    let (own, differences) = (link(true, true), link(false, true));
    let still = Driver::new(&*own);
    for d in [-0.03, -0.004, 1e-4, 0.0041, 0.02] {
        for v in [-0.3, 0.0, 0.1] {
            let (d, v) = ([d], [v]);
            let at = still.toward(&d, &v, 0.01);
            let [own, other] =
                [&own, &differences].map(|law| Answer::of(&**law, &at, &still.history));
            assert_eq!((&own.f, &own.trial), (&other.f, &other.trial));
            let size = 1e5;
            assert!((own.k[0] - other.k[0]).abs() < 2e-9 * size, "{} {}", own.k[0], other.k[0]);
            assert!((own.c[0] - other.c[0]).abs() < 2e-9 * size, "{} {}", own.c[0], other.c[0]);
        }
    }
}

#[test]
fn work_that_nobody_accounts_for_is_heat() {
    let driver_of = |law: &dyn Link| {
        let mut driver = Driver::new(law);
        for i in 1..=200 {
            let t = 0.01 * f64::from(i);
            driver.step(&[0.02 * t.sin()], &[0.02 * t.cos()], 0.01);
        }
        (driver.work, driver.energy)
    };
    let (work, energy) = driver_of(&*link(true, false));
    assert!((work - energy.hysteretic).abs() < 1e-12 * work && energy.stored == 0.0, "{energy:?}");
    let (own, told) = driver_of(&*link(true, true));
    assert_eq!(work, own);
    assert!(told.stored > 0.0 && told.viscous > 0.0);
}

#[test]
fn a_law_that_ends_says_why_and_one_that_fails_unwinds() {
    let law = made(&slider(false, false), Slider::default(), 0.05).expect("a law");
    let still = Driver::new(&*law);
    let beyond = still.toward(&[0.051], &[0.0], 0.01);
    assert!(still.ask(&beyond).f[0].is_nan());
    assert_eq!(still.refusal(&beyond).as_deref(), Some("torn at 0.05 m"));
    // At the very end the side that is there alone counts.
    let edge = still.toward(&[0.05], &[0.0], 0.01);
    let slope = 3.0 * CUBE * 0.05 * 0.05;
    assert!((still.ask(&edge).k[0] / slope - 1.0).abs() < 1e-5, "{:?}", still.ask(&edge));
    assert_eq!(still.refusal(&edge), None);
    let told = Kit::new(&[0.1], 1.0).check(&*law);
    assert!(matches!(told, Err(ConformanceError::Refuses { .. })), "{told:?}");

    let law = made(&slider(true, true), Slider { fails: true }, 0.05).expect("a law");
    let still = Driver::new(&*law);
    let unwound = catch_unwind(AssertUnwindSafe(|| still.ask(&still.toward(&[1.0], &[0.0], 0.0))));
    let payload = unwound.expect_err("it unwinds");
    assert_eq!(payload.downcast_ref(), Some(&LawFailed("torn at 0.05 m".into())));
}

#[test]
fn parameters_that_do_not_go_together_are_refused() {
    let told = made(&slider(true, true), Slider::default(), 1e-3).expect_err("it tears at once");
    assert_eq!(told.to_string(), "it tears before it yields");
}

#[test]
fn equal_declarations_have_one_card() {
    let kind = |d: &Declaration| Kind::new(d, Arc::new(Slider::default())).expect("a declaration");
    let (one, two) = (kind(&slider(true, true)), kind(&slider(true, true)));
    assert!(std::ptr::eq(one.card(), two.card()));
    assert!(!std::ptr::eq(one.card(), kind(&slider(true, false)).card()));
    let card = one.card();
    assert_eq!(card.parameters[3].default, trilith_element::Default::Number(2.0));
    assert_eq!(card.parameters[1].range, trilith_element::Range::Positive);
    assert_eq!((card.exercise.frequency, card.exercise.strokes[0].amplitude), (1.0, 0.01));
}

#[test]
fn declarations_that_cannot_be_say_why() {
    let told = |change: fn(&mut Declaration)| {
        let mut d = slider(true, true);
        change(&mut d);
        let wrong: Result<_, DeclarationError> = Kind::new(&d, Arc::new(Slider::default()));
        wrong.expect_err("it cannot be").to_string()
    };
    type Change = fn(&mut Declaration);
    let all: &[(Change, &str)] = &[
        (|d| d.kind = "slider".into(), "`slider` is no name of a kind"),
        (|d| d.kind = "Slíder".into(), "`Slíder` is no name of a kind"),
        (|d| d.kind = "Some".into(), "`Some` is a word of model files"),
        (|d| d.axes.clear(), "its coordinates `` must be one or more of U1"),
        (|d| d.axes = vec!["U4".into()], "its coordinates `U4` must be"),
        (|d| d.axes = vec!["U2".into(); 2], "the axis `U2` is there twice"),
        (|d| d.parameters[0].unit = "kN/m".into(), "the unit `kN/m` of `k` is none of SI"),
        (|d| d.parameters[0].unit = String::new(), "the unit `` of `k` is none of SI"),
        (|d| d.parameters[0].name = "2k".into(), "`2k` is no name of a parameter"),
        (|d| d.parameters[0].name = "axis1".into(), "must not be called `axis1`"),
        (|d| d.parameters[0].name = "node".into(), "must not be called `node`"),
        (|d| d.parameters[0].name = "c".into(), "the parameter `c` is there twice"),
        (|d| d.history[0].unit = "furlong".into(), "the unit `furlong` of `slip`"),
        (
            |d| d.parameters[0].default = Some(DeclaredValue::Text("1 kN".into())),
            "the value \"1 kN\" of `k`: this is in N: must be in N/m",
        ),
        (
            |d| d.parameters[0].example = Some(DeclaredValue::Number(-1.0)),
            "the value -1.0 of `k`: must be > 0",
        ),
        (
            |d| d.parameters[0].range = DeclaredRange::Within(2.0, 1.0),
            "the range of `k` goes from 2 to 1",
        ),
        (|d| d.amplitude = vec![1.0, 2.0], "must be 1 positive numbers"),
        (|d| d.frequency = f64::NAN, "its frequency positive"),
    ];
    for (change, words) in all {
        let text = told(*change);
        assert!(text.contains(words), "{words} in: {text}");
    }
}
