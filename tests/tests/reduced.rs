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
    let case = model.cases.len() - 1;
    let options =
        RunOptions { case, solver: Some(solver), step_errors: true, ..RunOptions::default() };
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

/// A plane frame on friction pendulums that are stiff upwards, between stops: what a stop sets in motion is not in the chains of
/// the loads.
fn on_pendulums(basis: &str) -> Model {
    let text = r#"(
        plane: XZ,
        nodes: {
            "{i} {k}": For(i: "0 to 4", k: "0 to 8", of: ("6*i", 0, "3.3*k")),
            "column {i} {k}": For(i: "0 to 4", k: "1 to 8", of: ("6*i", 0, "3.3*k - 1.65")),
            "beam {i} {k}": For(i: "1 to 4", k: "0 to 8", of: ("6*i - 3", 0, "3.3*k")),
        },
        properties: {
            "column": Beam(young: "30 GPa", poisson: 0.2, width: 0.7, depth: 0.7, density: 2500),
            "beam": Beam(young: "30 GPa", poisson: 0.2, width: 0.4, depth: 0.7, density: 2500),
        },
        elements: {
            "mass {i} {k}": For(i: "0 to 4", k: "0 to 8", of: Mass(node: "{i} {k}", mass: "20 t")),
            "lower {i} {k}": For(i: "0 to 4", k: "1 to 8", of: Beam(nodes: ("{i} {k-1}", "column {i} {k}"), use: "column")),
            "upper {i} {k}": For(i: "0 to 4", k: "1 to 8", of: Beam(nodes: ("column {i} {k}", "{i} {k}"), use: "column")),
            "left {i} {k}": For(i: "1 to 4", k: "0 to 8", of: Beam(nodes: ("{i-1} {k}", "beam {i} {k}"), use: "beam")),
            "right {i} {k}": For(i: "1 to 4", k: "0 to 8", of: Beam(nodes: ("beam {i} {k}", "{i} {k}"), use: "beam")),
            "pendulum {i}": For(i: "0 to 4", of: NLink(node: "{i} 0", kn: "1e9 N/m", ks: "20 MN/m", radius: 2,
                mu_slow: 0.03, mu_fast: 0.06, rate: "50 s/m")),
            "stop left": Gap(node: "0 0", axis1: (1, 0, 0), axis2: (0, 0, 1), k: "30 MN/m", opening: "12 cm"),
            "stop right": Gap(node: "4 0", axis1: (-1, 0, 0), axis2: (0, 0, 1), k: "30 MN/m", opening: "12 cm"),
        },
        damping: RayleighAt(ratio: 0.02, f1: "0.5 Hz", f2: "10 Hz"),
        functions: { "pulse": Ricker(amplitude: "0.3 g", frequency: "0.6 Hz", center: "1.5 s") },
        cases: {
            "gravity": Static(loads: [Gravity]),
            "pulse": Dynamic(after: "gravity", duration: "3.3 s", dt: "5 ms", step: Fixed(substeps: 4), basis: BASIS,
                base: [(direction: X, function: "pulse")]),
        },
        outputs: {
            "roof": Displacement(node: "0 8", dof: Ux),
            "shear": LinkForce(link: "pendulum 0", axis: U2),
            "weight": LinkForce(link: "pendulum 0", axis: U1),
        },
    )"#;
    parse(&text.replace("BASIS", basis), &[]).0
}

#[test]
fn what_link_forces_set_in_motion_is_told_where_the_basis_lacks_it() {
    let run = |basis: &str| run(&on_pendulums(basis), SolverKind::Fna);
    let whole = run("Ritz(vectors: 300, tolerance: 0.5)");
    for vectors in [50, 60, 90] {
        let found = run(&format!("Ritz(vectors: {vectors}, tolerance: 0.5)"));
        assert!(found.result.basis.as_ref().unwrap().vectors <= vectors, "it is not enlarged");
        for (output, error) in ["roof", "shear", "weight"].into_iter().zip(&found.result.errors) {
            let (truth, told) = (apart(&whole, &found, output), error.reduction);
            let size = whole.peak(output).unwrap().magnitude();
            assert!(truth <= told + 1e-4 * size, "{vectors} {output}: {truth} {told} of {size}");
            assert!(told <= 10.0 * truth + 1e-3 * size, "{vectors} {output}: {truth} {told}");
        }
    }
}

/// More stops than the chain of the one load has vectors: their shapes are found beside it, and are those that one thread
/// finds after it.
#[test]
fn shapes_of_many_links_are_the_same_on_any_number_of_threads() {
    const FIRST: usize = 60;
    let of_stops = |of: &dyn Fn(usize) -> String| (FIRST..120).map(of).collect::<String>();
    let text = cantilever(r#"duration: "0.3 s", base: [(direction: Z, function: "a")]"#)
        .replace("nodes: {", &format!("nodes: {{ {}", of_stops(&|i| {
            format!("\"w{i}\": ({}, 0, -0.1), ", 0.05 * i as f64)
        })))
        .replace("supports: {", &format!("supports: {{ {}", of_stops(&|i| format!("\"w{i}\": Fixed, "))))
        .replace("elements: {", &format!("elements: {{ {}", of_stops(&|i| {
            format!("\"s{i}\": Gap(nodes: (\"n{i}\", \"w{i}\"), axis: U1, k: \"1 MN/m\", opening: \"5 mm\"), ")
        })));
    let model = parse(&text, &[]).0;
    let many = run(&model, SolverKind::Fna);
    let one = trilith_solvers::alone(|| run(&model, SolverKind::Fna));
    assert!(many.result.basis.as_ref().unwrap().vectors > 80);
    for o in &model.outputs {
        assert_eq!(many.history(&o.name).unwrap(), one.history(&o.name).unwrap(), "{}", o.name);
    }
    let direct = run(&model, SolverKind::Hht);
    for output in ["tip", "middle"] {
        let off = apart(&many, &direct, output) / many.peak(output).unwrap().magnitude();
        assert!(off < 0.005, "{output}: {off}");
    }
}
