//! Loads are followed whatever the output step: no sample of a table and no part of a pulse falls between steps.

use trilith_model::{Analysis, Model, SolverKind, StepControl};
use trilith_solvers::RunOptions;
use trilith_system::System;
use trilith_tests::{Trace, output, parse, set_step, shipped, trace, trace_with};

const SOLVERS: [SolverKind; 3] = [SolverKind::Fna, SolverKind::Hht, SolverKind::RitzHht];

/// An undamped mass on a spring, period 1 s, under a history of base acceleration.
fn oscillator(function: &str, dt: f64, duration: f64) -> (Model, System) {
    let text = format!(
        r#"(
        nodes: {{ "n": (0, 0, 0) }},
        supports: {{ "n": (Uy, Uz, Rx, Ry, Rz) }},
        elements: {{
            "mass": Mass(node: "n", mass: 1),
            "spring": Spring(node: "n", k2: 39.47841760435743),
            "stop": Gap(node: "n", axis: U2, k: 1000, opening: 10),
        }},
        functions: {{ "f": {function} }},
        cases: {{ "shake": Dynamic(duration: {duration}, dt: {dt},
            base: [(direction: X, function: "f")]) }},
        outputs: {{ "u": Displacement(node: "n", dof: Ux), "a": Acceleration(node: "n", dof: Ux) }},
    )"#
    );
    parse(&text, &[])
}

fn run(function: &str, dt: f64, solver: SolverKind, step: StepControl) -> Trace {
    let (mut model, system) = oscillator(function, dt, 2.0);
    set_step(&mut model, step);
    trace(&model, &system, solver).0
}

/// ü + ω² u = −a: from rest under an impulse I the mass swings to I/ω; a short triangle is one, and so is its
/// response but for (ω b)²/24 with half the base b.
#[test]
fn a_triangle_between_output_times_is_felt_in_full() {
    let omega = std::f64::consts::TAU;
    for (from, half, peak) in [(0.503, 0.002, 98.1), (1.02, 0.02, 10.0)] {
        let (top, to) = (from + half, from + 2.0 * half);
        let function = format!(
            "Points(points: [(0, 0), ({from}, 0), ({top}, {peak}), ({to}, 0)], after_end: Zero)"
        );
        let expected = peak * half / omega;
        for solver in SOLVERS {
            for dt in [0.01, 0.05, 0.1] {
                for step in [StepControl::default(), StepControl::Fixed { substeps: 1 }] {
                    let found = run(&function, dt, solver, step).peak(0);
                    let share = found / expected - 1.0;
                    // Between samples of a swing of 1 s its crest may be missed; direct integration shifts its period.
                    let missed = 1.0 - (omega * dt / 2.0).cos();
                    let what = format!("{} {dt} {step:?}: {share}", solver.name());
                    assert!(share < 0.003 && share > -0.01 - missed, "{what}");
                }
            }
        }
    }
}

/// A sine is zero at every output time.
#[test]
fn a_sine_whose_period_is_the_output_step_is_felt() {
    let function = r#"Sine(amplitude: 10, frequency: 10, cycles: 20)"#;
    let fine = run(function, 0.001, SolverKind::Fna, StepControl::default()).peak(0);
    for solver in SOLVERS {
        for dt in [0.1, 0.05, 0.2] {
            for step in [StepControl::default(), StepControl::Fixed { substeps: 1 }] {
                let found = run(function, dt, solver, step).peak(0);
                let what = format!("{} {dt} {step:?}: {found} {fine}", solver.name());
                assert!((found / fine - 1.0).abs() < 0.02, "{what}");
            }
        }
    }
}

/// Steps of an output time that a sample ends are those that they were.
#[test]
fn samples_at_output_times_change_no_bit() {
    let points = |spacing: f64| {
        let y = |i: usize| [0.0, 3.0, -2.0, 5.0, 1.0, -4.0][i % 6];
        let count = (2.0 / spacing).round() as usize;
        let all = (0..=count).map(|i| format!("({}, {})", i as f64 * spacing, y(i)));
        format!("Points(points: [{}])", all.collect::<Vec<_>>().join(", "))
    };
    for solver in SOLVERS {
        let (model, system) = oscillator(&points(0.02), 0.01, 2.0);
        let (_, result) = trace(&model, &system, solver);
        let fine = result.work.substeps;
        let (model, system) = oscillator(&points(0.02), 0.04, 2.0);
        let (_, result) = trace(&model, &system, solver);
        assert!(fine > 0 && result.work.substeps > 0);
        // Two lengths at most: of the pieces and their halves, not one of each piece.
        if solver == SolverKind::Hht {
            assert!(result.work.factorizations <= 12, "{}", result.work.factorizations);
        }
    }
}

/// The block of the benchmark slides and rocks, however rarely it is looked at.
#[test]
fn the_rigid_block_moves_at_any_output_step() {
    for solver in [SolverKind::Fna, SolverKind::Hht] {
        let set = [("duration", "1.2".to_owned())];
        let (model, system) = shipped("rigid_block.ron", &set);
        let at = |dt: f64| {
            let options =
                RunOptions { solver: Some(solver), dt: Some(dt), ..RunOptions::default() };
            trace_with(&model, &system, options).0
        };
        let fine = at(0.001);
        for dt in [0.05, 0.15, 0.2, 0.4] {
            let coarse = at(dt);
            for name in ["slide", "uplift_right"] {
                let i = output(&model, name);
                let share = coarse.peak(i) / fine.peak(i) - 1.0;
                assert!(share.abs() < 0.02, "{} {dt} {name}: {share}", solver.name());
            }
        }
    }
}

/// A step of acceleration is met behind its jump: at rest on a spring the mass answers with all of it at once.
#[test]
fn the_acceleration_behind_a_jump_is_seen() {
    for solver in SOLVERS {
        for start in [0.0, 0.3, 0.5] {
            let function = format!("Step(amplitude: 10, start: {start})");
            let seen = run(&function, 0.25, solver, StepControl::Fixed { substeps: 1 });
            let (lowest, highest) = (seen.min[1], seen.max[1]);
            assert!((lowest + 10.0).abs() < 1e-9, "{} {start}: {lowest}", solver.name());
            assert!(highest < 10.0 + 1e-9, "{} {start}: {highest}", solver.name());
        }
    }
}

/// The absolute acceleration of a mass that its base lets go is zero, also at the start.
#[test]
fn a_case_starts_behind_the_jump_of_its_loads() {
    let (model, system) = oscillator("Step(amplitude: 10)", 0.01, 0.1);
    let mut model = model;
    for o in &mut model.outputs {
        if let trilith_model::Quantity::Acceleration { absolute, .. } = &mut o.quantity {
            *absolute = true;
        }
    }
    assert!(model.cases.iter().any(|c| matches!(c.analysis, Analysis::Dynamic(_))));
    for solver in SOLVERS {
        let (seen, _) = trace(&model, &system, solver);
        assert!(seen.history[0][1].abs() < 1e-9, "{}: {}", solver.name(), seen.history[0][1]);
    }
}

/// An oscillator of two masses of very different periods, let go: no step is too long for its extremes.
#[test]
fn extremes_inside_long_steps_are_those_of_the_motion() {
    let text = |damping: &str, dt: f64| {
        format!(
            r#"(
        nodes: {{ "a": (0, 0, 1), "b": (0, 0, 2) }},
        supports: {{ "a": (Uy, Uz, Rx, Ry, Rz), "b": (Uy, Uz, Rx, Ry, Rz) }},
        damping: {damping},
        elements: {{
            "ma": Mass(node: "a", mass: 2), "mb": Mass(node: "b", mass: 1),
            "low": Spring(node: "a", k2: 2000, c2: 2),
            "high": Spring(nodes: ("a", "b"), k2: 1500, axis2: (1, 0, 0)),
            "stop": Gap(nodes: ("a", "b"), axis: U2, k: 1000, opening: 10),
        }},
        functions: {{ "f": Points(points: [(0, 0), (1, 10), (3, -5)]) }},
        cases: {{ "free": Dynamic(duration: 3, dt: {dt}, base: [(direction: X, function: "f")],
            initial: [(node: "b", dof: Ux, displacement: 0.02), (node: "a", dof: Ux, velocity: 0.1)]) }},
        outputs: {{
            "u": Displacement(node: "b", dof: Ux), "v": Velocity(node: "a", dof: Ux),
            "a": Acceleration(node: "b", dof: Ux, absolute: true),
            "gap": LinkDeformation(link: "stop", axis: U2),
            "drift": Norm(terms: ["u", "gap"]),
        }},
    )"#
        )
    };
    for damping in ["None", "Modal(ratio: 0.01)", "Rayleigh(mass: 0.1, stiffness: 0.0001)"] {
        let peaks = |dt: f64, step: StepControl| {
            let (mut model, _) = parse(&text(damping, dt), &[]);
            set_step(&mut model, step);
            let analysis = trilith::Analysis::new(&model).unwrap();
            let options = RunOptions { solver: Some(SolverKind::Fna), ..RunOptions::default() };
            let run = analysis.run(options).unwrap();
            let peaks = run.record.peaks().to_vec();
            (peaks, run.result.work.substeps)
        };
        let (fine, _) = peaks(0.001, StepControl::default());
        for dt in [0.02, 0.1, 0.5] {
            for step in [StepControl::default(), StepControl::Fixed { substeps: 1 }] {
                let (found, _) = peaks(dt, step);
                for (i, (a, b)) in found.iter().zip(&fine).enumerate() {
                    let allowed = if i == 2 { 0.06 } else { 0.004 } * b.magnitude();
                    // A norm has an edge where it is smallest, which no samples find.
                    let lower = if i == 4 { 0.0 } else { (a.min - b.min).abs() };
                    let off = (a.max - b.max).abs().max(lower);
                    assert!(off < allowed, "{damping} {dt} {step:?} {i}: {a:?} {b:?}");
                }
            }
        }
    }
}

/// ü + ω² u = −a under a base acceleration that is straight between samples: exact from sample to sample.
fn exactly(times: &[f64], values: &[f64], omega: f64, t: f64) -> f64 {
    let (mut u, mut v) = (0.0, 0.0);
    for i in 1..times.len() {
        let (from, to) = (times[i - 1], times[i].min(t));
        if to <= from {
            break;
        }
        let slope = (values[i] - values[i - 1]) / (times[i] - from);
        let h = to - from;
        // u = A cos + B sin − (a + slope τ)/ω².
        let w2 = omega * omega;
        let (a, b) = (u + values[i - 1] / w2, (v + slope / w2) / omega);
        let (sin, cos) = (omega * h).sin_cos();
        u = a * cos + b * sin - (values[i - 1] + slope * h) / w2;
        v = omega * (b * cos - a * sin) - slope / w2;
    }
    u
}

/// Samples that are nearly, but not quite, where steps could end: the program may put the end of a piece beside them,
/// and the motion must not notice.
#[test]
fn samples_a_little_beside_the_grid_cost_nothing() {
    for (off, allowed) in [(4e-5, 1e-7), (4e-6, 1e-5)] {
        let mut times: Vec<f64> = (0..=40).map(|i| 0.05 * f64::from(i)).collect();
        let shift = |i: usize| off * ((i * 7919 % 101) as f64 / 50.0 - 1.0);
        times.iter_mut().enumerate().take(40).skip(1).for_each(|(i, t)| *t += shift(i));
        let values: Vec<f64> =
            (0..times.len()).map(|i| (i * 104_729 % 97) as f64 / 48.0 - 1.0).collect();
        let points: Vec<String> =
            times.iter().zip(&values).map(|(t, a)| format!("({t:?}, {a:?})")).collect();
        let function = format!("Points(points: [{}])", points.join(", "));
        for dt in [0.1, 0.0125] {
            let found =
                run(&function, dt, SolverKind::Fna, StepControl::Adaptive { tolerance: 1e-7 });
            for (t, row) in found.time.iter().zip(&found.history).filter(|(t, _)| **t < 1.99) {
                let expected = exactly(&times, &values, std::f64::consts::TAU, *t);
                let share = (row[0] - expected).abs() / found.peak(0);
                assert!(share < allowed, "{off} {dt} at {t}: {share:e}");
            }
        }
    }
}
