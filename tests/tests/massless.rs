//! Joints without mass: loads on them and links between springs and dampers.

use trilith_model::SolverKind;
use trilith_solvers::Status;
use trilith_tests::{output, parse, trace};

/// A force on the free end of two springs in a row, the mass between them.
#[test]
fn a_loaded_place_without_mass_moves_as_its_spring_says() {
    let text = r#"(
        nodes: { "a": (0, 0, 0), "b": (1, 0, 0), "w": (2, 0, 0) },
        supports: {
            "a": (Uy, Uz, Rx, Ry, Rz), "b": (Uy, Uz, Rx, Ry, Rz), "w": Fixed,
        },
        elements: {
            "k1": Spring(nodes: ("a", "b"), k1: 100, c1: "across"),
            "c": Spring(node: "a", c2: "ground"),
            "k2": Spring(nodes: ("b", "w"), k1: 100),
            "m": Mass(node: "b", mass: 1),
        },
        parameters: { "across": "0 N*s/m", "ground": "0 N*s/m" },
        loads: { "push": [(node: "a", dof: Ux, force: 1)] },
        functions: { "f": Ramp(amplitude: 1, rise: 10) },
        cases: {
            "push": Dynamic(duration: 10, dt: 0.1, forces: [(load: "push", function: "f")]),
        },
        outputs: {
            "a": Displacement(node: "a", dof: Ux),
            "stretch": Displacement(
                terms: [(node: "a", dof: Ux), (node: "b", dof: Ux, factor: -1)],
            ),
        },
    )"#;
    // b follows the ramp with m/k² of its rate in amplitude about it, a is f/k ahead.
    let (model, system) = parse(text, &[]);
    for solver in SolverKind::ALL {
        let (t, result) = trace(&model, &system, solver);
        assert_eq!(result.status, Status::Converged);
        assert!((t.last[1] - 0.01).abs() < 1e-9, "{}: {}", solver.name(), t.last[1]);
        assert!((t.last[0] - 0.02).abs() < 1.1e-4, "{}: {}", solver.name(), t.last[0]);
    }
    // A dashpot across that spring lets its stretch lag, the same under all solvers: f/k − c ḟ/k².
    let (model, system) = parse(text, &[("across", "5".into())]);
    for solver in SolverKind::ALL {
        let (t, _) = trace(&model, &system, solver);
        assert!((t.last[1] - 0.01 + 5.0 * 0.1 / 1e4).abs() < 1e-7, "{}", t.last[1]);
    }
    // A dashpot from the massless place to the ground couples it with the mass: FNA has no shape for it
    // and says so.
    let (model, system) = parse(text, &[("ground", "5".into())]);
    let (_, result) = trace(&model, &system, SolverKind::Fna);
    assert!(result.warnings.iter().any(|w| w.contains("static response")), "{:?}", result.warnings);
}

/// A damper behind a brace, shaken; the joint between them has no mass.
#[test]
fn a_damper_behind_a_brace_works_under_every_solver() {
    let text = r#"(
        parameters: { "exponent": 1 },
        nodes: { "m": (0, 0, 0), "end": (1, 0, 0), "wall": (2, 0, 0) },
        supports: {
            "m": (Uy, Uz, Rx, Ry, Rz), "end": (Uy, Uz, Rx, Ry, Rz), "wall": Fixed,
        },
        elements: {
            "mass": Mass(node: "m", mass: "100 t"),
            "spring": Spring(node: "m", k2: "8e6 N/m"),
            "brace": Spring(nodes: ("m", "end"), k1: "2e7 N/m"),
            "damper": Dashpot(nodes: ("end", "wall"), c: 2e5, exponent: "exponent"),
        },
        functions: { "a": Sine(amplitude: "3 m/s^2", frequency: "1.4 Hz", cycles: 3) },
        cases: {
            "shake": Dynamic(
                duration: "4 s", dt: "5 ms", base: [(direction: X, function: "a")],
            ),
        },
        outputs: {
            "u": Displacement(node: "m", dof: Ux),
            "brace": Displacement(
                terms: [(node: "end", dof: Ux), (node: "m", dof: Ux, factor: -1)],
            ),
            "force": LinkForce(link: "damper", axis: U1),
        },
    )"#;
    for exponent in [0.35, 0.5, 1.0, 2.0] {
        let (model, system) = parse(text, &[("exponent", exponent.to_string())]);
        let runs: Vec<_> = SolverKind::ALL
            .iter()
            .map(|solver| {
                let (t, result) = trace(&model, &system, *solver);
                assert_eq!(result.status, Status::Converged, "{} {exponent}", solver.name());
                assert!(result.warnings.is_empty(), "{:?}", result.warnings);
                t
            })
            .collect();
        for (t, solver) in runs.iter().zip(SolverKind::ALL) {
            for i in 0..3 {
                let off = t.peak(i) / runs[1].peak(i) - 1.0;
                assert!(off.abs() < 5e-3, "{} {exponent} output {i}: {off}", solver.name());
            }
            let brace = t.peak(output(&model, "brace"));
            assert!(brace > 5e-3, "the brace deforms: {brace}");
        }
    }
}
