//! A link law of another crate, by its name in a model file.

use trilith_model::SolverKind;
use trilith_tests::{parse, trace};

/// The Duffing oscillator m ü + k1 u + k3 u³ = 0 released from A: T = 4 K(k) / √((k1 + k3 A²)/m) with
/// k² = k3 A² / (2 (k1 + k3 A²)). For k1 = 2, k3 = 4, A = 1, m = 2.588e-3: 0.1440439 s.
#[test]
fn a_third_party_spring_swings_with_the_period_of_the_duffing_oscillator() {
    let text = r#"(
        nodes: { "m": (0, 0, 0) },
        supports: { "m": (Uy, Uz, Rx, Ry, Rz) },
        elements: {
            "mass": Mass(node: "m", mass: 2.588e-3),
            "spring": CubicSpring(node: "m", k1: 2, k3: 4, axis1: (1, 0, 0), axis2: (0, 0, 1)),
        },
        cases: { "swing": Dynamic(
            duration: 0.1440439, dt: 0.0001440439,
            initial: [(node: "m", dof: Ux, displacement: 1)],
            step: Adaptive(tolerance: 1e-6),
        ) },
        outputs: { "u": Displacement(node: "m", dof: Ux), "v": Velocity(node: "m", dof: Ux) },
    )"#;
    let (model, system) = parse(text, &[]);
    for solver in SolverKind::ALL {
        let (t, _) = trace(&model, &system, solver);
        assert!((t.last[0] - 1.0).abs() < 1e-3, "{}: {} after a period", solver.name(), t.last[0]);
        assert!(t.last[1].abs() < 0.02 * t.peak(1), "{}", solver.name());
        assert!((t.history[500][0] + 1.0).abs() < 1e-3, "{}: half a period", solver.name());
    }
}
