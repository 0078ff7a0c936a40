//! Links whose every direction is prescribed: they are led, and their forces are the answer.

use trilith_model::{SolverKind, read_text};
use trilith_solvers::{SolveError, Status, assemble, modes};
use trilith_tests::{parse, registry, trace};

const SOLVERS: [SolverKind; 4] =
    [SolverKind::Fna, SolverKind::Hht, SolverKind::RitzHht, SolverKind::FullNewton];

/// Two links between nodes that do not move but as the case says.
fn text(link: &str) -> String {
    format!(
        r#"(
        nodes: {{ "a": (0, 0, 0), "b": (1, 0, 0) }},
        supports: {{ "a": Fixed, "b": Fixed }},
        elements: {{
            "cable": Hook(nodes: ("a", "b"), k: 1e6, opening: 2e-3),
            "steel": Wen(nodes: ("a", "b"), k: 1e6, fy: 4e3, ratio: 0.1, exponent: 1),
            {link}
        }},
        functions: {{ "pull": Points(points: [(0, 0), (0.5, 5e-3), (1, 0.01)], interpolation: Cubic) }},
        cases: {{ "pull": Dynamic(
            duration: 1, dt: 0.01, supports: [(node: "b", dof: Ux, displacement: "pull")],
        ) }},
        outputs: {{
            "d": Displacement(node: "b", dof: Ux),
            "cable": LinkForce(link: "cable", axis: U1),
            "steel": LinkForce(link: "steel", axis: U1),
        }},
    )"#
    )
}

#[test]
fn they_have_the_forces_of_their_laws_with_every_solver() {
    let (model, system) = parse(&text(""), &[]);
    for solver in SOLVERS {
        let (trace, result) = trace(&model, &system, solver);
        assert_eq!(result.status, Status::Converged, "{solver:?}");
        let steel = 0.1 * 1e4 + 0.9 * 4e3 * (1.0 - (-2.5f64).exp());
        for (value, expected) in trace.last.iter().zip([0.01, 8e3, steel]) {
            assert!((value / expected - 1.0).abs() < 1e-7, "{solver:?}: {:?}", trace.last);
        }
        assert!(result.basis.is_none(), "{solver:?}");
    }
}

#[test]
fn they_have_no_modes() {
    let (model, system) = parse(&text(""), &[]);
    assert_eq!(modes(&model, &system, None), Err(SolveError::NoMass));
}

#[test]
fn a_restitution_needs_a_mass_of_its_own() {
    let assembled = |more: &str| {
        let stop = format!(
            "\"stop\": ImpactKelvin(nodes: (\"a\", \"b\"), k: 1e6, restitution: 0.5, opening: 1{more}),"
        );
        let model = read_text(&text(&stop), "led.ron", &registry(), &[]).unwrap();
        assemble(&model).map(|_| ())
    };
    let error = assembled("").unwrap_err().to_string();
    assert!(error.contains("`impact_mass`"), "{error}");
    assert_eq!(assembled(", impact_mass: 1e3"), Ok(()));
}

#[test]
fn where_nothing_is_free_and_nothing_led_there_is_nothing_to_run() {
    let led = ", supports: [(node: \"b\", dof: Ux, displacement: \"pull\")],";
    let still = text("").replace(led, ",");
    let model = read_text(&still, "still.ron", &registry(), &[]).unwrap();
    let error = assemble(&model).unwrap_err().to_string();
    assert!(error.contains("no case moves a support"), "{error}");
}
