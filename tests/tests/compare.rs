//! Comparisons name the cause of a difference where one known cause dominates.

use trilith::compare::{Cause, Compared, Comparison, Variant};
use trilith::{Model, SolverKind, read, read_text};
use trilith_tests::{registry, root};

/// A mass on a spring with a stop far away, let go; `HOW` is the rest of the case.
const SWING: &str = r#"(
    plane: XZ,
    nodes: { "m": (0, 0, 0) },
    supports: { "m": (Uz, Ry) },
    elements: {
        "mass": Mass(node: "m", mass: "1 kg"),
        "spring": Spring(node: "m", k2: "39.4784 N/m"),
        "stop": Gap(node: "m", k: "1 kN/m", opening: "1 m", axis1: (1, 0, 0)),
    },
    cases: { "swing": Dynamic(
        duration: "10 s", dt: "0.02 s", initial: [(node: "m", dof: Ux, displacement: "2 cm")], HOW
    ) },
    outputs: { "x": Displacement(node: "m", dof: Ux) },
)"#;

fn swing(how: &str) -> Model {
    read_text(&SWING.replace("HOW", how), "swing.ron", &registry(), &[]).unwrap()
}

fn shipped(name: &str, set: &[(&str, &str)]) -> Model {
    let set: Vec<_> = set.iter().map(|(n, v)| ((*n).to_owned(), (*v).to_owned())).collect();
    read(root().join("models").join(name), &registry(), &set).unwrap()
}

fn second(mut model: Model, variants: &[Variant]) -> Compared {
    let case = model.cases.len() - 1;
    Comparison::new(&mut model, case, |_| {}).run(variants, true).unwrap().remove(1)
}

fn cause(model: Model, variants: &[Variant]) -> Cause {
    let found = second(model, variants).finding.unwrap();
    println!("{found}");
    found.cause
}

fn hht_and_fna() -> [Variant; 2] {
    [SolverKind::Hht, SolverKind::Fna].map(Variant::new)
}

#[test]
fn a_long_fixed_step_is_found() {
    let model = swing("step: Fixed(substeps: 1)");
    // Average acceleration makes the period longer by (ω Δt)²/12: later by 10 s · 0.0157 / 12 at the end.
    let both = second(model, &hht_and_fna());
    assert_eq!(both.finding.as_ref().unwrap().cause, Cause::Step, "{:?}", both.finding);
    let d = &both.differences[0];
    let mean = 0.5 * 10.0 * (2.0 * std::f64::consts::PI * 0.02_f64).powi(2) / 12.0;
    assert!((d.lag + mean).abs() < 0.3 * mean, "{} {mean}", d.lag);
}

#[test]
fn numerical_damping_is_found() {
    let hht = |alpha| Variant { alpha: Some(alpha), ..Variant::new(SolverKind::Hht) };
    let both = second(swing("step: Fixed(substeps: 1)"), &[hht(0.0), hht(-0.3)]);
    assert_eq!(both.finding.as_ref().unwrap().cause, Cause::Algorithm, "{:?}", both.finding);
    assert!(both.differences[0].residual < 0.0, "{:?}", both.differences);
}

#[test]
fn solvers_that_agree_are_said_to_agree() {
    assert_eq!(cause(swing("step: Adaptive(tolerance: 1e-6)"), &hht_and_fna()), Cause::None);
}

#[test]
fn a_basis_that_is_too_small_is_found() {
    let mut variants = hht_and_fna();
    variants[1].vectors = Some(9);
    let model = shipped("isolated_frame.ron", &[("duration", "4 s")]);
    assert_eq!(cause(model, &variants), Cause::Basis);
}

#[test]
fn a_response_that_cannot_be_repeated_is_found() {
    // Thrown up twice its weight the block begins to rock by what rounding leaves.
    let set = [("ah", "0"), ("av", "2"), ("cycles_v", "15")];
    assert_eq!(cause(shipped("rigid_block.ron", &set), &hht_and_fna()), Cause::Sensitive);
}

#[test]
fn the_model_is_as_before_after_a_comparison() {
    let mut model = shipped("rigid_block.ron", &[("duration", "0.3 s")]);
    let before = trilith::model::resolved(&model);
    let dummies =
        |k| Variant { dummies: Some(k), vectors: Some(2), ..Variant::new(SolverKind::Fna) };
    let case = model.cases.len() - 1;
    Comparison::new(&mut model, case, |_| {}).run(&[dummies(1e-3), dummies(0.1)], true).unwrap();
    assert_eq!(trilith::model::resolved(&model), before);
}
