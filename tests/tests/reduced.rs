//! Reduced runs of larger structures: what they start from, and what they say of their errors.

use trilith::{Analysis, Run, RunOptions};
use trilith_model::{Model, SolverKind};
use trilith_solvers::Status;
use trilith_tests::parse;

/// A steel cantilever of 120 beams, 6 m long, with a mass at its tip and a stop below it: 360 equations.
fn cantilever(case: &str) -> String {
    const BEAMS: usize = 120;
    let node = |i: usize| format!("\"n{i}\": ({}, 0, 0), ", 0.05 * i as f64);
    let nodes: String = (0..=BEAMS).map(node).collect();
    let plane: String = (1..=BEAMS).map(|i| format!("\"n{i}\": (Uy, Rx, Rz), ")).collect();
    let beam = |i: usize| {
        let next = i + 1;
        format!("\"b{i}\": Beam(nodes: (\"n{i}\", \"n{next}\"), use: \"steel\"), ")
    };
    let beams: String = (0..BEAMS).map(beam).collect();
    format!(
        r#"(
        nodes: {{ {nodes} "w": (6, 0, -0.1) }},
        supports: {{ "n0": Fixed, "w": Fixed, {plane} }},
        properties: {{ "steel": Beam(
            young: "210 GPa", poisson: 0.3, area: 4e-3, i2: 8e-6, i3: 8e-6, torsion: 1e-6, density: 7850,
        ) }},
        elements: {{
            {beams}
            "tip": Mass(node: "n120", mass: "500 kg"),
            "stop": Gap(nodes: ("n120", "w"), axis: U1, k: "10 MN/m", opening: "10 mm"),
        }},
        functions: {{ "a": Sine(amplitude: "3 m/s^2", frequency: "9 Hz", cycles: 4) }},
        cases: {{ "go": Dynamic(dt: "1 ms", {case}) }},
        outputs: {{
            "tip": Displacement(node: "n120", dof: Uz), "middle": Displacement(node: "n60", dof: Uz),
            "rest": Velocity(node: "n30", dof: Uz),
        }},
    )"#
    )
}

fn run(model: &Model, solver: SolverKind) -> Run {
    let options = RunOptions { solver: Some(solver), step_errors: true, ..RunOptions::default() };
    Analysis::new(model).unwrap().run(options).unwrap()
}

/// Largest difference of an output over time.
fn apart(a: &Run, b: &Run, output: &str) -> f64 {
    let pairs = a.history(output).unwrap().iter().zip(b.history(output).unwrap());
    pairs.map(|(x, y)| (x - y).abs()).fold(0.0, f64::max)
}

/// A missile, a velocity all along, a displacement let go: the basis holds what a run starts from, and all of its energy.
#[test]
fn a_basis_holds_what_the_run_starts_from() {
    let tip = r#"(node: "n120", dof: Uz, velocity: "-5 m/s")"#;
    let bent: Vec<String> = (1..=120)
        .map(|i| {
            let x = f64::from(i) / 120.0;
            let u = -0.009 * x * x * (3.0 - x) / 2.0;
            format!(r#"(node: "n{i}", dof: Uz, displacement: {u})"#)
        })
        .collect();
    for (initial, energy) in [(tip.to_owned(), Some(0.5 * 500.0 * 25.0)), (bent.join(", "), None)] {
        let case = |basis: &str| {
            let text =
                cantilever(&format!("duration: \"0.1 s\", initial: [{initial}], basis: {basis}"));
            parse(&text, &[]).0
        };
        let whole = run(&case("Complete"), SolverKind::Fna);
        let found = run(&case("Ritz"), SolverKind::Fna);
        assert_eq!(found.result.status, Status::Converged);
        let vectors = found.result.basis.as_ref().unwrap().vectors;
        assert!(vectors < 200, "of 240 modes: {vectors}");
        let put_in = |run: &Run| {
            let energy = &run.result.energy;
            energy.start.kinetic + energy.start.strain + energy.input
        };
        let (a, b) = (put_in(&whole), put_in(&found));
        assert!((a - b).abs() < 1e-4 * a.abs().max(1.0), "{a} {b}");
        // The beam's share of the mass at the tip has the velocity too.
        assert!(energy.is_none_or(|e| (b / e - 1.0).abs() < 2e-3), "{b}");
        for output in ["tip", "middle"] {
            let off = apart(&whole, &found, output) / whole.peak(output).unwrap().magnitude();
            assert!(off < 2e-3, "{output}: {off}");
        }
    }
}

/// What a run says of the errors of its outputs holds, and is no more than some times the truth; a basis that is too
/// small is enlarged, or the run does not end well.
#[test]
fn errors_of_the_reduction_are_told_and_kept_within_their_limit() {
    let load = r#"duration: "0.6 s", base: [(direction: Z, function: "a")]"#;
    let with = |basis: &str| parse(&cantilever(&format!("{load}, basis: {basis}")), &[]).0;
    let whole = run(&with("Complete"), SolverKind::Fna);
    let mut failed = 0;
    for vectors in [2, 3, 4, 6, 10, 20] {
        let model = with(&format!("Ritz(vectors: {vectors}, enrich: false, tolerance: 0.01)"));
        let found = run(&model, SolverKind::Fna);
        let mut worst: f64 = 0.0;
        for (o, error) in model.outputs.iter().zip(&found.result.errors) {
            let truth = apart(&whole, &found, &o.name);
            let size = whole.peak(&o.name).unwrap().magnitude();
            worst = worst.max(truth / size);
            assert!(
                truth <= error.total() + 2e-4 * size,
                "{vectors} {}: {truth} {error:?} of {size}",
                o.name
            );
        }
        let fine = found.result.status == Status::Converged;
        assert!(fine || matches!(found.result.status, Status::Inadequate { .. }));
        assert!(!fine || worst < 0.01, "{vectors}: {worst}");
        failed += usize::from(!fine);
    }
    assert!(failed > 0, "the smallest are too small");
    let model = with("Ritz(vectors: 2, tolerance: 0.01)");
    let enlarged = run(&model, SolverKind::Fna);
    assert_eq!(enlarged.result.status, Status::Converged);
    assert!(enlarged.result.basis.as_ref().unwrap().vectors > 2);
    assert!(enlarged.result.warnings.iter().any(|w| w.contains("enlarged")));
    for o in &model.outputs {
        let off = apart(&whole, &enlarged, &o.name) / whole.peak(&o.name).unwrap().magnitude();
        assert!(off < 0.01, "{}: {off}", o.name);
    }
}
