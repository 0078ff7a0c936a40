//! A law that holds up to a deformation only, and says so: a spring that tears, f = k d while |d| ≤ the limit.

use serde::Deserialize;
use trilith::element::conformance::{ConformanceError, Kit};
use trilith::element::lanes::{LaneAt, LaneForce, LaneForm, LaneLaw, LaneStep, Real};
use trilith::element::{
    Axis, Card, Category, Coordinates, Described, Exercise, Kinematics, Link, NodeCount,
    Parameters, Response, Stroke,
};
use trilith::exercise::Specimen;
use trilith::sweep::{Engine, Sweep};
use trilith::{Analysis, Register, Registry, RunOptions, SolverKind};

#[derive(Debug, Deserialize, Parameters)]
#[parameters(crate = trilith::element)]
#[serde(deny_unknown_fields)]
struct Strip {
    /// stiffness
    #[parameter("k", unit = "N/m", range = Positive)]
    k: f64,
    /// where it tears
    #[parameter("l", unit = "m", range = Positive)]
    limit: f64,
}

struct StripLaw;

impl LaneLaw for StripLaw {
    const COORDINATES: usize = 1;
    const HISTORY: usize = 0;
    const PARAMETERS: usize = 2;

    #[inline(always)]
    fn respond<R: Real>(
        at: &LaneAt<'_, R>,
        out: &mut LaneForce<'_, R>,
        _: &mut [R],
    ) -> LaneStep<R> {
        let (k, d) = (at.parameters[0], at.d[0]);
        let holds = d.abs().le(at.parameters[1]);
        out.f[0] = R::select(holds, k * d, k.of(f64::NAN));
        out.k[0] = k;
        out.c[0] = k.of(0.0);
        LaneStep::elastic(k.of(0.5) * k * d * d)
    }
}

impl Described for Strip {
    const CARD: Card = Card::new("Strip", Category::Link, "A spring that tears.")
        .nodes(NodeCount::GROUND_OR_TWO)
        .parameters(Self::PARAMETERS)
        .law("f = k d")
        .source("elementary")
        .example(r#""s": Strip(node: "m", k: "1 kN/m", limit: "50 mm")"#)
        .exercise(Exercise::new(1.0, &[Stroke::about(0.0, 0.1)]));
}

impl Link for Strip {
    fn coordinates(&self) -> Coordinates {
        Coordinates::Local(vec![Axis::U1])
    }

    fn uses_rates(&self) -> bool {
        false
    }

    fn engaged_stiffness(&self, k: &mut [f64]) {
        k[0] = self.k;
    }

    fn respond(&self, at: &Kinematics<'_>, _: &[f64], _: &mut [f64], out: &mut Response<'_>) {
        let numbers = [self.k, self.limit];
        let asked = LaneAt::new(at, &[], &numbers);
        let mut force = LaneForce { f: out.f, k: out.k, c: out.c };
        *out.energy = StripLaw::respond(&asked, &mut force, &mut []).into();
    }

    fn refusal(&self, at: &Kinematics<'_>, _: &[f64]) -> Option<String> {
        // It is asked of where it has no answer, and of nothing else.
        assert!(at.d[0].abs() > self.limit && at.v[0].is_nan(), "{at:?}");
        Some(format!("torn at {} mm", 1e3 * self.limit))
    }

    fn lanes(&self, _: &[bool]) -> Option<LaneForm> {
        Some(LaneForm::of::<StripLaw>(vec![0], vec![self.k, self.limit]).without_rate())
    }
}

/// A mass of 1 t thrown at `v` m/s on two strips of 50 kN/m that tear at 50 mm: sin(10 t) = 0.5/v.
const MODEL: &str = r#"(
    parameters: { "v": 1, "force": 1000 },
    nodes: { "m": (0, 0, 0) },
    supports: { "m": (Ux, Uy, Rx, Ry, Rz) },
    elements: {
        "mass": Mass(node: "m", mass: 1000),
        "one": Strip(node: "m", k: 5e4, limit: 0.06),
        "two": Strip(node: "m", k: 5e4, limit: 0.05),
    },
    loads: { "push": [(node: "m", dof: Uz, force: "force")] },
    cases: {
        "push": Static(loads: ["push"]),
        "throw": Dynamic(
            duration: 0.3, dt: 0.01, initial: [(node: "m", dof: Uz, velocity: "v")],
        ),
        "fixed": Dynamic(
            duration: 0.3, dt: 0.01, initial: [(node: "m", dof: Uz, velocity: "v")],
            step: Fixed(substeps: 2),
        ),
        "pushed": Dynamic(after: "push", duration: 0.1, dt: 0.01),
    },
    outputs: { "u": Displacement(node: "m", dof: Uz) },
)"#;

fn kinds() -> Registry {
    let mut kinds = trilith::registry();
    kinds.link::<Strip>();
    kinds
}

fn set(name: &str, value: f64) -> Vec<(String, String)> {
    vec![(name.to_owned(), value.to_string())]
}

/// How a case ends, and in a word.
fn end(case: &str, solver: Option<SolverKind>, given: &[(String, String)]) -> (String, String) {
    let model = trilith::read_text(MODEL, "strip.ron", &kinds(), given).expect("a model");
    let analysis = Analysis::new(&model).expect("a structure");
    let case = model.case(case).expect("a case");
    match analysis.run(RunOptions { case, solver, ..RunOptions::default() }) {
        Ok(run) => (run.result.status.word().to_owned(), run.result.status.text()),
        Err(e) => (String::new(), e.to_string()),
    }
}

const WORDS: &str = ": torn at 50 mm (force of U1 is no number there)";

#[test]
fn a_law_ends_a_run_with_words_of_its_own() {
    for solver in SolverKind::ALL {
        for case in ["throw", "fixed"] {
            let (word, text) = end(case, Some(solver), &[]);
            assert_eq!(word, "refused", "{}: {text}", solver.name());
            let told = text.strip_prefix("the law of \"two\" has no answer at t = ");
            let (t, words) = told.expect(&text).split_once(" s").expect(&text);
            assert_eq!(words, WORDS);
            // Shorter steps have led there; those of a method that dissipates stray a little.
            let t: f64 = t.parse().expect("a time");
            assert!((t - 0.052_360).abs() < 5e-4, "{}, {case}: {text}", solver.name());
        }
        assert_eq!(end("throw", Some(solver), &set("v", 0.3)).0, "converged");
    }
}

#[test]
fn so_it_does_where_no_time_goes_on_and_in_a_case_before() {
    // Two strips of 50 kN/m hold 5 kN at 50 mm.
    let expected = format!(
        "the law of \"two\" has no answer beyond 62.5 % of the loads of static case \"push\"{WORDS}"
    );
    assert_eq!(end("push", None, &set("force", 8000.0)).1, expected);
    assert_eq!(end("pushed", None, &set("force", 8000.0)).1, expected);
    assert_eq!(end("pushed", None, &set("force", 4000.0)).0, "converged");
}

#[test]
fn a_sweep_carries_the_same_words() {
    let speeds = [0.2, 0.7, 0.3, 1.0, 0.4];
    let combinations: Vec<_> = speeds.iter().map(|v| set("v", *v)).collect();
    let sweep = Sweep::new(MODEL, "strip.ron", kinds()).case("throw");
    for (v, outcome) in speeds.iter().zip(sweep.run(&combinations)) {
        let outcome = outcome.expect("an outcome");
        let alone = end("throw", None, &set("v", *v));
        assert_eq!((outcome.status.word(), outcome.status.text()), (&*alone.0, alone.1));
        let torn = *v > 0.5;
        assert_eq!(outcome.engine, if torn { Engine::Rerun } else { Engine::Lanes });
        assert_eq!(outcome.status.text().ends_with(WORDS), torn);
    }
}

#[test]
fn the_kit_and_an_exercise_tell_them_too() {
    let strip = Strip { k: 5e4, limit: 0.05 };
    Kit::new(&[0.02], 1.0).rate_independent().assert(&strip);
    let found = Kit::new(&[0.2], 1.0).check(&strip);
    let Err(ConformanceError::Refuses { why, .. }) = &found else { panic!("{found:?}") };
    assert_eq!(why, "torn at 50 mm");
    let specimen = Specimen::new(&kinds(), "Strip", &[]).expect("a specimen");
    let told = specimen.exercise(&specimen.motion().expect("strokes")).expect_err("torn");
    assert!(told.to_string().ends_with("s: torn at 50 mm"), "{told}");
}
