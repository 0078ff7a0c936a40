//! A smaller tolerance gives a smaller error, whatever the output step: closed forms of motions whose error the
//! energy of a step does not show.

use trilith_model::SolverKind;
use trilith_solvers::{RunOptions, Status};
use trilith_tests::{Trace, parse, trace, trace_with};

const G: f64 = 9.80665;

/// A block that slides out: let go with a speed on a rough floor.
fn slider(solver: SolverKind, set: &[(&str, f64)]) -> f64 {
    let text = r#"(
        parameters: {
            "mu": 0.5, "v0": "0.19 m/s", "ks": "1e11 N/m", "dt": "20 ms", "duration": 0.2, "tolerance": 1e-4,
        },
        nodes: { "m": (0, 0, 0) },
        supports: { "m": (Uy, Rx, Ry, Rz) },
        elements: {
            "mass": Mass(node: "m", mass: "1 t"),
            "friction": NLink(node: "m", kn: "1e9 N/m", ks: "ks", mu: "mu"),
        },
        cases: {
            "gravity": Static(loads: [Gravity]),
            "slide": Dynamic(
                after: "gravity", duration: "duration", dt: "dt", step: Adaptive(tolerance: "tolerance"),
                initial: [(node: "m", dof: Ux, velocity: "v0")],
            ),
        },
        outputs: { "u": Displacement(node: "m", dof: Ux) },
    )"#;
    let set: Vec<_> = set.iter().map(|(name, value)| (*name, value.to_string())).collect();
    let (model, system) = parse(text, &set);
    let (t, result) = trace(&model, &system, solver);
    assert_eq!(result.status, Status::Converged, "{}", solver.name());
    println!("    {} substeps {}", solver.name(), result.work.substeps);
    t.last[0]
}

/// The way is v₀²/(2 μ g), wherever in an output step the block comes to rest.
#[test]
fn a_block_slides_as_far_as_its_energy_goes() {
    for solver in [SolverKind::Fna, SolverKind::Hht] {
        for tolerance in [1e-4, 1e-6] {
            for v0 in [0.11, 0.13, 0.15, 0.17, 0.19, 0.21] {
                let mu = 0.5;
                let found = slider(solver, &[("v0", v0), ("mu", mu), ("tolerance", tolerance)]);
                let expected = v0 * v0 / (2.0 * mu * G);
                let error = (found / expected - 1.0).abs();
                // Before it slips the contact gives way by μ N/ks.
                let play = mu * 1000.0 * G / 1e11 / expected;
                println!("{} {tolerance:e} v0 {v0}: {error:.2e}, play {play:.2e}", solver.name());
                assert!(
                    error < 5.0 * tolerance + 2.0 * play,
                    "{} {tolerance:e} v0 {v0}: {error:.2e}",
                    solver.name()
                );
            }
        }
    }
}

/// Friction so little that a block slides for seconds, in output steps of one.
#[test]
fn a_block_on_ice_slides_as_far_as_its_energy_goes() {
    let (mu, v0) = (1e-4, 5.2e-3);
    let expected = v0 * v0 / (2.0 * mu * G);
    for solver in [SolverKind::Fna, SolverKind::Hht] {
        for tolerance in [1e-4, 1e-6] {
            let set = [("mu", mu), ("v0", v0), ("dt", 1.0), ("duration", 10.0)];
            let found = slider(solver, &[&set[..], &[("tolerance", tolerance)]].concat());
            let error = (found / expected - 1.0).abs();
            println!("{} {tolerance:e}: {error:.2e}", solver.name());
            assert!(error < 5.0 * tolerance, "{} {tolerance:e}: {error:.2e}", solver.name());
        }
    }
}

/// Free vibration from rest at −a on a spring ω₁, beyond g on a stiffer ω₂: displacement at t.
fn bilinear(a: f64, g: f64, w1: f64, w2: f64, t: f64) -> f64 {
    // From −a to the hook, from there to the turning point.
    let t1 = (-g / a).acos() / w1;
    let v = a * w1 * (w1 * t1).sin();
    // Beyond the hook: w₂² (u − c) with the force of the spring at g kept.
    let c = g - (w1 / w2).powi(2) * g;
    let t2 = (v / w2).atan2(g - c) / w2;
    let far = (g - c).hypot(v / w2);
    let half = t1 + t2;
    let mut t = t % (2.0 * half);
    if t > half {
        t = 2.0 * half - t;
    }
    if t < t1 { -a * (w1 * t).cos() } else { c + far * (w2 * (t - half)).cos() }
}

const HOOKED: &str = r#"(
    parameters: { "tolerance": 1e-4, "duration": 20, "dt": "20 ms" },
    nodes: { "m": (0, 0, 0) },
    supports: { "m": (Uy, Uz, Rx, Ry, Rz) },
    elements: {
        "mass": Mass(node: "m", mass: 1),
        "spring": Spring(node: "m", k1: 40, axis1: (1, 0, 0)),
        "hook": Hook(node: "m", k: 360, opening: 0.02, axis1: (1, 0, 0)),
    },
    cases: {
        "free": Dynamic(
            duration: "duration", dt: "dt", step: Adaptive(tolerance: "tolerance"),
            initial: [(node: "m", dof: Ux, displacement: -0.1)],
        ),
    },
    outputs: { "u": Displacement(node: "m", dof: Ux), "f": LinkForce(link: "hook", axis: U1) },
)"#;

/// Errors of displacement and force over their peaks.
fn hooked(solver: SolverKind, tolerance: f64) -> [f64; 2] {
    let (model, system) = parse(HOOKED, &[("tolerance", tolerance.to_string())]);
    let (found, result) = trace(&model, &system, solver);
    assert_eq!(result.status, Status::Converged);
    let mut errors = [0.0f64; 2];
    for (t, row) in found.time.iter().zip(&found.history) {
        let u = bilinear(0.1, 0.02, 40f64.sqrt(), 20.0, *t);
        let f = 360.0 * (u - 0.02).max(0.0);
        for ((error, x), y) in errors.iter_mut().zip(row).zip([u, f]) {
            *error = error.max((x - y).abs());
        }
    }
    println!("{} {tolerance:e} substeps {}", solver.name(), result.work.substeps);
    [errors[0] / found.peak(0), errors[1] / found.peak(1)]
}

/// A hook that engages twenty times or more: the phase is kept.
#[test]
fn an_oscillator_on_a_hook_keeps_its_phase() {
    assert!((bilinear(0.1, 0.02, 40f64.sqrt(), 20.0, 0.0) + 0.1).abs() < 1e-15);
    for solver in [SolverKind::Fna, SolverKind::Hht, SolverKind::FullNewton] {
        for tolerance in [1e-3, 1e-4] {
            let [u, f] = hooked(solver, tolerance);
            println!("{} {tolerance:e}: {u:.2e} {f:.2e}", solver.name());
            // The phase after 25 periods; a force that rises within a sixth of one shows it three times as large.
            assert!(u < 30.0 * tolerance, "{} {tolerance:e}: {u:.2e}", solver.name());
            assert!(f < 100.0 * tolerance, "{} {tolerance:e}: {f:.2e}", solver.name());
        }
    }
}

/// Numbers that look random, from 0 to 1.
struct Numbers(u64);

impl Numbers {
    fn next(&mut self) -> f64 {
        self.0 =
            self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (self.0 >> 11) as f64 / (1u64 << 53) as f64
    }

    fn between(&mut self, low: f64, high: f64) -> f64 {
        low * (high / low).powf(self.next())
    }
}

/// A chain of masses on springs and sliders, shaken or let go.
fn chain(seed: u64) -> String {
    let mut r = Numbers(seed.wrapping_mul(0x9e37_79b9_7f4a_7c15) | 1);
    (0..8).for_each(|_| {
        r.next();
    });
    let n = 1 + (3.0 * r.next()) as usize;
    let (mut nodes, mut supports, mut elements) = (String::new(), String::new(), String::new());
    let mut initial = String::new();
    for i in 0..n {
        nodes += &format!("\"n{i}\": ({i}, 0, 0), ");
        supports += &format!("\"n{i}\": (Uy, Rx, Ry, Rz), ");
        let mass = r.between(100.0, 10_000.0);
        elements += &format!("\"mass{i}\": Mass(node: \"n{i}\", mass: {mass}), ");
        let (ks, mu) = (r.between(1e6, 1e8), r.between(0.02, 0.4));
        elements += &format!("\"foot{i}\": NLink(node: \"n{i}\", kn: 1e9, ks: {ks}, mu: {mu}), ");
        if i > 0 {
            let w = r.between(5.0, 60.0);
            elements += &format!(
                "\"spring{i}\": Spring(nodes: (\"n{}\", \"n{i}\"), k1: {}), ",
                i - 1,
                mass * w * w
            );
        }
        let v = r.between(0.1, 2.0);
        initial += &format!("(node: \"n{i}\", dof: Ux, velocity: {v}), ");
    }
    let (a, f) = (r.between(1.0, 12.0), r.between(0.5, 5.0));
    let dt = r.between(0.002, 0.05);
    format!(
        r#"(
        parameters: {{ "tolerance": 1e-4 }},
        nodes: {{ {nodes} }}, supports: {{ {supports} }}, elements: {{ {elements} }},
        functions: {{ "shaking": Sine(amplitude: {a}, frequency: {f}) }},
        cases: {{
            "gravity": Static(loads: [Gravity]),
            "shaking": Dynamic(
                after: "gravity", duration: 0.5, dt: {dt}, step: Adaptive(tolerance: "tolerance"),
                initial: [{initial}], base: [(direction: X, function: "shaking")],
            ),
        }},
        outputs: {{ {} }},
    )"#,
        (0..n)
            .map(|i| format!("\"u{i}\": Displacement(node: \"n{i}\", dof: Ux), "))
            .collect::<String>()
    )
}

/// Twenty chains: what a run with a finer tolerance finds is nearer to that of the finest.
#[test]
fn the_error_falls_with_the_tolerance() {
    for solver in [SolverKind::Fna] {
        let mut all = Vec::new();
        for seed in 0..20 {
            let text = chain(seed);
            let run = |tolerance: f64| -> Trace {
                let (model, system) = parse(&text, &[("tolerance", tolerance.to_string())]);
                let (t, result) = trace(&model, &system, solver);
                assert_eq!(result.status, Status::Converged, "{seed} {}", solver.name());
                t
            };
            let finest = run(1e-8);
            let n = finest.last.len();
            let error = |t: f64| {
                let t = run(t);
                (0..n).map(|i| t.difference(&finest, i)).fold(0.0, f64::max)
            };
            let errors = [1e-3, 1e-4, 1e-5, 1e-6].map(error);
            println!("{} {seed}: {errors:?}", solver.name());
            all.push((seed, errors));
        }
        for (seed, errors) in all {
            // Where a slider stops within its play is a matter of chance: two may come out in the wrong order.
            for (coarse, fine) in errors.iter().zip(&errors[1..]) {
                assert!(
                    *fine < 1.6f64.mul_add(*coarse, 2e-6),
                    "{} {seed}: {errors:?}",
                    solver.name()
                );
            }
            for (error, tolerance) in errors.iter().zip([1e-3, 1e-4, 1e-5, 4e-6]) {
                assert!(*error < 5.0 * tolerance, "{} {seed}: {errors:?}", solver.name());
            }
            assert!(errors[3] < 0.1 * errors[0], "{} {seed}: {errors:?}", solver.name());
        }
    }
}

/// Links that carry nothing but rounding until one closes, and a structure that rests for ever: steps are not
/// measured by it.
#[test]
fn rounding_halves_no_steps() {
    let text = r#"(
        nodes: { "a": (1, 0, 0), "j": (2, 0, 0), "b": (3, 0, 0) },
        supports: {
            "a": (Uy, Uz, Rx, Ry, Rz), "j": (Uy, Uz, Rx, Ry, Rz), "b": (Uy, Uz, Rx, Ry, Rz),
        },
        elements: {
            "ground": Spring(node: "a", axis1: (1, 0, 0), k1: "k"),
            "mass a": Mass(node: "a", mass: 235.5),
            "aj": Wen(nodes: ("a", "j"), k: 168100, fy: 717.3, ratio: 0.1623, axis: U1),
            "hook": Hook(nodes: ("j", "b"), k: 4548000, opening: 0.003139, axis: U1),
            "mass b": Mass(node: "b", mass: 209.4),
        },
        parameters: { "k": "114100 N/m" },
        cases: {
            "free": Dynamic(
                duration: 1, dt: 0.1321, initial: [(node: "a", dof: Ux, displacement: 0.002015)],
            ),
        },
        outputs: { "a": Displacement(node: "a", dof: Ux) },
    )"#;
    for k in [114_100.0, 0.0] {
        let (model, system) = parse(text, &[("k", k.to_string())]);
        for solver in [SolverKind::Fna, SolverKind::Hht] {
            let options = RunOptions {
                solver: Some(solver),
                substeps: Some(20_000),
                ..RunOptions::default()
            };
            let (_, result) = trace_with(&model, &system, options);
            assert_eq!(result.status, Status::Converged, "{} {k}", solver.name());
        }
    }
}
