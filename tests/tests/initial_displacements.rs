//! Links that are led beyond their elastic range to an initial displacement.

use trilith_model::{Solution, SolverKind, StepControl};
use trilith_solvers::{RunOptions, Status};
use trilith_tests::{output, parse, trace, trace_with};

fn oscillator(link: &str) -> String {
    format!(
        r#"(
        nodes: {{ "a": (0, 0, 0) }},
        supports: {{ "a": (Uy, Uz, Rx, Ry, Rz) }},
        elements: {{ "m": Mass(node: "a", mass: 10), "link": {link} }},
        cases: {{
            "free": Dynamic(
                duration: 0.1, dt: 0.002, initial: [(node: "a", dof: Ux, displacement: 0.03)],
            ),
        }},
        outputs: {{
            "u": Displacement(node: "a", dof: Ux),
            "f": LinkForce(link: "link", axis: U1),
        }},
    )"#
    )
}

/// The curve says 12 N at 0.03 m; from there unloading has the first slope, ω = 10 rad/s, until the doubled curve
/// bends at 20 N below.
#[test]
fn a_plastic_spring_has_yielded_before_it_lets_go() {
    let text = oscillator(
        "MultilinearPlastic(node: \"a\", axis1: (1, 0, 0), deformation: [-0.05, -0.01, 0, 0.01, 0.05], \
         force: [-14, -10, 0, 10, 14])",
    );
    let (model, system) = parse(&text, &[]);
    let (u, f) = (output(&model, "u"), output(&model, "f"));
    for solver in SolverKind::ALL {
        let (t, result) = trace(&model, &system, solver);
        assert_eq!(result.status, Status::Converged);
        assert!((t.history[0][f] - 12.0).abs() < 1e-9, "{}: {}", solver.name(), t.history[0][f]);
        for (time, row) in t.time.iter().zip(&t.history) {
            let expected = 0.03 - 0.012 * (1.0 - (10.0 * time).cos());
            assert!((row[u] - expected).abs() < 2e-6, "{} at {time}: {}", solver.name(), row[u]);
        }
    }
}

/// z of an exponent 2 is tanh(k d / f_y) on the way out.
#[test]
fn a_smooth_spring_has_yielded_before_it_lets_go() {
    let (k, fy, ratio, d) = (1000.0_f64, 10.0, 0.1, 0.03);
    let text = oscillator(
        "Wen(node: \"a\", axis1: (1, 0, 0), k: 1000, fy: 10, ratio: 0.1, exponent: 2, axis: U1)",
    );
    let (model, system) = parse(&text, &[]);
    let f = output(&model, "f");
    let expected = ratio * k * d + (1.0 - ratio) * fy * (k * d / fy).tanh();
    for solver in SolverKind::ALL {
        let (t, _) = trace(&model, &system, solver);
        let start = t.history[0][f];
        assert!((start - expected).abs() < 1e-4 * expected, "{}: {start}", solver.name());
    }
}

/// A joint without mass between a spring that has yielded, 10 N + 100 N/m (d₁ − 0.01 m), and an elastic one,
/// 1000 N/m d₂: with d₁ + d₂ = 0.03 m the force is 0.12/0.011 N. Both unload with 1000 N/m, ω² = 500/10.
#[test]
fn a_joint_between_links_starts_where_they_are_in_equilibrium() {
    let text = oscillator(
        "MultilinearPlastic(node: \"j\", axis1: (1, 0, 0), deformation: [-0.05, -0.01, 0, 0.01, 0.05], \
         force: [-14, -10, 0, 10, 14]), \
         \"other\": MultilinearElastic(nodes: (\"j\", \"a\"), deformation: [-0.05, 0, 0.05], \
         force: [-50, 0, 50], axis: U1)",
    );
    let text = text.replace("\"a\": (0, 0, 0)", "\"a\": (1, 0, 0), \"j\": (0, 0, 0)").replace(
        "\"a\": (Uy, Uz, Rx, Ry, Rz)",
        "\"a\": (Uy, Uz, Rx, Ry, Rz), \"j\": (Uy, Uz, Rx, Ry, Rz)",
    );
    let (model, system) = parse(&text, &[]);
    let (u, f) = (output(&model, "u"), output(&model, "f"));
    let (force, omega) = (0.12 / 0.011, 50.0_f64.sqrt());
    for solver in SolverKind::ALL {
        let (t, result) = trace(&model, &system, solver);
        assert_eq!(result.status, Status::Converged);
        let start = t.history[0][f];
        assert!((start - force).abs() < 1e-6 * force, "{}: {start}", solver.name());
        for (time, row) in t.time.iter().zip(&t.history) {
            let expected = 0.03 - force / 500.0 * (1.0 - (omega * time).cos());
            assert!((row[u] - expected).abs() < 3e-6, "{} at {time}: {}", solver.name(), row[u]);
        }
    }
}

/// A run that has spent what it was given says so, and where it stands.
#[test]
fn work_that_is_spent_ends_a_run() {
    let text = oscillator("Gap(node: \"a\", axis1: (1, 0, 0), k: 1e6, opening: 0)");
    let (model, system) = parse(&text.replace("0.03", "-0.03"), &[]);
    for solver in SolverKind::ALL {
        let options =
            RunOptions { solver: Some(solver), substeps: Some(8), ..RunOptions::default() };
        let (_, result) = trace_with(&model, &system, options);
        let Status::Spent { t, tried } = result.status else { panic!("{:?}", result.status) };
        assert!(t < 0.1 && tried >= 8, "{t} {tried}");
    }
}

/// The file may say how much, and no run is without a limit.
#[test]
fn a_case_limits_its_substeps() {
    let text = oscillator("Gap(node: \"a\", axis1: (1, 0, 0), k: 1e6, opening: 0)");
    let text = text.replace("0.03", "-0.03").replace("dt:", "substep_limit: 8, dt:");
    let (model, system) = parse(&text, &[]);
    let (_, result) = trace(&model, &system, SolverKind::Fna);
    let Status::Spent { tried, .. } = result.status else { panic!("{:?}", result.status) };
    assert!((8..20).contains(&tried), "{tried}");
    let plain = Solution::default();
    assert_eq!(plain.substep_limit(100), 1_000_000);
    assert_eq!(plain.substep_limit(100_000), 20_000_000);
    let fixed = Solution { step: StepControl::Fixed { substeps: 50 }, ..plain };
    assert_eq!(fixed.substep_limit(1_000), 10_000_000);
}
