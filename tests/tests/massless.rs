//! Joints without mass: loads on them and links between springs and dampers.

use trilith_model::SolverKind;
use trilith_solvers::{Status, modes};
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
    // A dashpot from the massless place to the ground takes c u̇ of the force, u̇ = 2 ḟ/k, and ties it to the mass.
    let (model, system) = parse(text, &[("ground", "5".into())]);
    for solver in SolverKind::ALL {
        let (t, result) = trace(&model, &system, solver);
        assert!(result.warnings.is_empty(), "{:?}", result.warnings);
        let expected = (1.0 - 5.0 * 0.002) / 100.0;
        assert!((t.last[1] - expected).abs() < 2e-6, "{}: {}", solver.name(), t.last[1]);
    }
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

/// A mass on a spring, shaken, beside two things in a row without mass between them.
fn in_a_row(first: &str, second: &str) -> String {
    format!(
        r#"(
        nodes: {{ "m": (0, 0, 0), "j": (1, 0, 0), "w": (2, 0, 0) }},
        supports: {{ "m": (Uy, Uz, Rx, Ry, Rz), "j": (Uy, Uz, Rx, Ry, Rz), "w": Fixed }},
        elements: {{
            "spring": Spring(node: "m", k2: 4e5), "mass": Mass(node: "m", mass: "10 t"),
            "first": {first}, "second": {second},
        }},
        functions: {{ "a": Sine(amplitude: "1 m/s^2", frequency: "1 Hz", cycles: 5) }},
        cases: {{ "shake": Dynamic(duration: "6 s", dt: "5 ms", base: [(direction: X, function: "a")]) }},
        outputs: {{
            "u": Displacement(node: "m", dof: Ux), "joint": Displacement(node: "j", dof: Ux),
        }},
    )"#
    )
}

/// ẍ = −a − (k x + F)/m by Runge and Kutta, F of the row; the joint by its own equation.
fn shaken(rate: impl Fn(f64, f64, f64) -> [f64; 2]) -> [f64; 2] {
    let acceleration = |t: f64| if t < 5.0 { (std::f64::consts::TAU * t).sin() } else { 0.0 };
    // The state is x, ẋ, joint; the row gives its force and the rate of the joint.
    let all = |t: f64, [x, v, y]: [f64; 3]| {
        let [force, joint] = rate(x, v, y);
        [v, -acceleration(t) - (4e5 * x + force) / 1e4, joint]
    };
    let (mut s, h) = ([0.0; 3], 1e-4);
    let mut most = [0.0f64; 2];
    for i in 0..60_000 {
        let t = h * f64::from(i);
        let at = |k: [f64; 3], part: f64| std::array::from_fn(|i| s[i] + part * h * k[i]);
        let k1 = all(t, s);
        let k2 = all(t + 0.5 * h, at(k1, 0.5));
        let k3 = all(t + 0.5 * h, at(k2, 0.5));
        let k4 = all(t + h, at(k3, 1.0));
        s = std::array::from_fn(|i| s[i] + h / 6.0 * (k1[i] + 2.0 * (k2[i] + k3[i]) + k4[i]));
        most = [most[0].max(s[0].abs()), most[1].max(s[2].abs())];
    }
    most
}

/// What ties a joint without mass to the structure, a spring, a dashpot or a link, is an unknown of its own order
/// under every solver.
#[test]
fn joints_of_springs_and_dashpots_are_those_of_their_equations() {
    let brace = r#"Spring(nodes: ("m", "j"), k1: 1e6)"#;
    let (near, far) =
        (r#"Spring(nodes: ("m", "j"), c1: 8e4)"#, r#"Spring(nodes: ("j", "w"), c1: 8e4)"#);
    let cases = [
        // k (x − y) = c ẏ
        (in_a_row(brace, far), shaken(|x, _, y| [1e6 * (x - y), 1e6 * (x - y) / 8e4])),
        // Two dashpots, nothing else at the joint: half the rate each.
        (in_a_row(near, far), shaken(|_, v, _| [4e4 * v, 0.5 * v])),
    ];
    for (text, expected) in cases {
        let (model, system) = parse(&text, &[]);
        for solver in SolverKind::ALL {
            let (t, result) = trace(&model, &system, solver);
            assert_eq!(result.status, Status::Converged);
            assert!(result.warnings.is_empty(), "{:?}", result.warnings);
            for (i, most) in expected.iter().enumerate() {
                let off = t.peak(i) / most - 1.0;
                assert!(off.abs() < 1e-3, "{} output {i}: {off}", solver.name());
            }
        }
    }
}

/// Links alone hold the joint: both carry the force of the weaker one.
#[test]
fn links_in_a_row_carry_one_force() {
    let link = |nodes: &str, fy: &str| {
        format!(r#"Wen(nodes: {nodes}, axis: U1, k: "400 kN/m", fy: "{fy}", ratio: 0.05)"#)
    };
    let text = in_a_row(&link(r#"("m", "j")"#, "500 N"), &link(r#"("j", "w")"#, "100 kN"));
    let text = text.replace(
        r#""u": Displ"#,
        r#""f": LinkForce(link: "first", axis: U1), "g": LinkForce(link: "second", axis: U1), "u": Displ"#,
    );
    let (model, system) = parse(&text, &[]);
    let runs: Vec<_> = SolverKind::ALL
        .iter()
        .map(|solver| {
            let (t, result) = trace(&model, &system, *solver);
            assert_eq!(result.status, Status::Converged);
            assert!(result.warnings.is_empty(), "{:?}", result.warnings);
            let apart = t.history.iter().map(|h| (h[0] - h[1]).abs()).fold(0.0, f64::max);
            assert!(apart < 1e-6 * t.peak(0), "{}: {apart}", solver.name());
            t
        })
        .collect();
    for t in &runs {
        assert!((t.peak(2) / runs[1].peak(2) - 1.0).abs() < 1e-3);
        assert!(t.peak(0) > 500.0);
    }
}

/// A force that jumps on the free end of a spring: it moves F/k at once, and of the work F²/k that it does there
/// one half is in no spring; all solvers book it as what the rule for time took. From then on the end goes with the
/// mass.
#[test]
fn a_load_that_jumps_where_there_is_no_mass_is_accounted_for() {
    let text = r#"(
        nodes: { "a": (0, 0, 0), "b": (1, 0, 0), "w": (2, 0, 0) },
        supports: {
            "a": (Uy, Uz, Rx, Ry, Rz), "b": (Uy, Uz, Rx, Ry, Rz), "w": Fixed,
        },
        elements: {
            "k1": Spring(nodes: ("a", "b"), k1: 50),
            "k2": Spring(nodes: ("b", "w"), k1: 100),
            "m": Mass(node: "b", mass: 1),
            "stop": Gap(nodes: ("b", "w"), k: 1000, opening: 10, axis: U1),
        },
        loads: { "push": [(node: "a", dof: Ux, force: 10)] },
        functions: { "f": Step(amplitude: 1, start: 0.1) },
        cases: {
            "push": Dynamic(duration: 1, dt: 0.01, forces: [(load: "push", function: "f")]),
        },
        outputs: {
            "of a": Velocity(node: "a", dof: Ux), "of b": Velocity(node: "b", dof: Ux),
            "stretch": Displacement(
                terms: [(node: "a", dof: Ux), (node: "b", dof: Ux, factor: -1)],
            ),
        },
    )"#;
    // Links that look at rates to tell loading from unloading, but have no damping.
    let spring = "Spring(nodes: (\"a\", \"b\"), k1: 50)";
    let plastic = r#"MultilinearPlastic(
        nodes: ("a", "b"), deformation: [-1, 0, 1], force: [-50, 0, 50], rule: Kinematic, axis: U1,
    )"#;
    let wen = r#"Wen(nodes: ("a", "b"), k: 50, fy: 1e6, ratio: 0.5, exponent: 2, axis: U1)"#;
    for (first, solver) in
        [spring, plastic, wen].into_iter().flat_map(|first| SolverKind::ALL.map(|s| (first, s)))
    {
        let (model, system) = parse(&text.replace(spring, first), &[]);
        let (t, result) = trace(&model, &system, solver);
        let name = format!("{first} {}", solver.name());
        assert_eq!(result.status, Status::Converged, "{name}");
        let lost = result.energy.algorithmic;
        assert!((lost - 1.0).abs() < 1e-6, "{name}: {lost}");
        assert!(result.energy.error_relative < 1e-6, "{name}: {}", result.energy.error_relative);
        for (time, row) in t.time.iter().zip(&t.history).filter(|(time, _)| **time > 0.125) {
            assert!((row[2] - 0.2).abs() < 1e-9, "{name} at {time}: {}", row[2]);
            assert!((row[0] - row[1]).abs() < 0.01, "{name} at {time}: {} {}", row[0], row[1]);
        }
    }
}

/// Two dashpots in a row and nothing else hold the joint between them: c₁c₂/(c₁ + c₂) brakes the mass.
#[test]
fn a_joint_that_dashpots_alone_hold_is_held() {
    let text = r#"(
        nodes: { "a": (0, 0, 0), "j": (1, 0, 0) },
        supports: { "a": (Uy, Uz, Rx, Ry, Rz), "j": (Uy, Uz, Rx, Ry, Rz) },
        elements: {
            "m": Mass(node: "a", mass: 2),
            "first": Dashpot(nodes: ("a", "j"), c: 30, exponent: 1, axis: U1),
            "second": Dashpot(node: "j", axis1: (1, 0, 0), c: 60, exponent: 1, axis: U1),
        },
        cases: {
            "free": Dynamic(
                duration: 0.5, dt: 0.01, initial: [(node: "a", dof: Ux, velocity: 1)],
            ),
        },
        outputs: { "v": Velocity(node: "a", dof: Ux) },
    )"#;
    let (model, system) = parse(text, &[]);
    for solver in SolverKind::ALL {
        let (t, result) = trace(&model, &system, solver);
        assert_eq!(result.status, Status::Converged, "{}", solver.name());
        for (time, row) in t.time.iter().zip(&t.history) {
            let expected = (-10.0 * time).exp();
            assert!((row[0] - expected).abs() < 3e-4, "{} {time}: {}", solver.name(), row[0]);
        }
    }
}

/// A spring whose ends hang on links alone holds no mass: modes of the structure without links move freely, so modal
/// damping brakes nothing.
#[test]
fn a_spring_between_links_takes_no_part_in_modes() {
    let (model, system) = parse(
        r#"(
        plane: XZ,
        nodes: { "a": (0, 0, 0), "i": (1, 0, 0), "j": (2, 0, 0), "b": (3, 0, 0) },
        supports: {
            "a": (Uz, Ry), "i": (Uz, Ry), "j": (Uz, Ry), "b": (Uz, Ry),
        },
        elements: {
            "ma": Mass(node: "a", mass: 2), "mb": Mass(node: "b", mass: 3),
            "first": Wen(nodes: ("a", "i"), k: 400, fy: 5, ratio: 0.1, axis: U1),
            "spring": Spring(nodes: ("i", "j"), k1: 300),
            "second": Gap(nodes: ("j", "b"), k: 1000, opening: 0.1, axis: U1),
            "ground": Spring(node: "b", axis1: (1, 0, 0), k1: 12),
        },
        damping: Modal(ratio: 0.1),
        cases: {
            "free": Dynamic(
                duration: 1, dt: 0.01, initial: [(node: "a", dof: Ux, velocity: -1)],
            ),
        },
    )"#,
        &[],
    );
    let omega = modes(&model, &system, None).unwrap().omega;
    assert_eq!(omega.len(), 2, "{omega:?}");
    assert!(omega[0] < 1e-6 && (omega[1] - 2.0).abs() < 1e-9, "{omega:?}");
}

/// A stop with a dashpot on a joint without mass: the touch gives the joint no impulse, it stops and creeps on under
/// what the springs have left. The numbers are those of c ḃ = k₁ (a − b) − k₂ b − k (b − g) in small steps.
#[test]
fn a_joint_without_mass_comes_to_a_damped_stop() {
    let text = r#"(
        nodes: { "a": (0, 0, 0), "b": (1, 0, 0), "c": (2, 0, 0) },
        supports: { "a": (Uy, Uz, Rx, Ry, Rz), "b": (Uy, Uz, Rx, Ry, Rz), "c": Fixed },
        elements: {
            "m": Mass(node: "a", mass: 100),
            "s": Spring(nodes: ("a", "b"), k1: 1e4),
            "h": Spring(nodes: ("b", "c"), k1: 1e4),
            "stop": ImpactKelvin(
                nodes: ("b", "c"), k: 2e4, damping: 500, opening: 0.02, damps: Approach,
            ),
        },
        cases: {
            "motion": Dynamic(
                duration: 0.6, dt: 0.01,
                initial: [(node: "a", dof: Ux, displacement: 0, velocity: 1)],
            ),
        },
        outputs: {
            "f": LinkForce(link: "stop", axis: U1),
            "a": Displacement(node: "a", dof: Ux),
            "b": Displacement(node: "b", dof: Ux),
        },
    )"#;
    let (model, system) = parse(text, &[]);
    let (t, result) = trace(&model, &system, SolverKind::Fna);
    assert_eq!(result.status, Status::Converged);
    assert!((t.last[1] + 0.13869).abs() < 5e-5, "{}", t.last[1]);
    assert!((t.last[2] + 0.069345).abs() < 2.5e-5, "{}", t.last[2]);
    assert!((t.peak(0) - 435.99).abs() < 1.0, "{}", t.peak(0));
    assert!((t.peak(1) - 0.13869).abs() < 5e-5, "{}", t.peak(1));
}
