//! Damping by modes and by mass acts on what the structure does beside following its supports.

use trilith_model::{Model, SolverKind};
use trilith_solvers::Status;
use trilith_system::System;
use trilith_tests::{parse, trace};

const SOLVERS: [SolverKind; 3] = [SolverKind::Fna, SolverKind::Hht, SolverKind::FullNewton];
const MASS: [f64; 2] = [2.0, 1.0];
const K: [f64; 3] = [300.0, 200.0, 100.0];
const DURATION: f64 = 4.0;
const AMPLITUDE: f64 = 0.02;

/// A Ricker pulse of 1 Hz around 1.5 s and its first two derivatives.
fn pulse(t: f64) -> [f64; 3] {
    let w = std::f64::consts::PI;
    let x = w * (t - 1.5);
    let e = AMPLITUDE * (-x * x).exp();
    [
        (1.0 - 2.0 * x * x) * e,
        w * (4.0 * x * x - 6.0) * x * e,
        w * w * ((-8.0 * x * x + 24.0) * x * x - 6.0) * e,
    ]
}

/// Two masses in a row of three springs between two supports, which move by multiples of the pulse or not at all;
/// then the base is accelerated.
fn model(damping: &str, moved: Option<[f64; 2]>) -> (Model, System) {
    let case = match moved {
        Some([l, r]) => format!(
            r#"supports: [(node: "l", dof: Ux, displacement: "d", factor: {l}),
                (node: "r", dof: Ux, displacement: "d", factor: {r})]"#
        ),
        None => r#"base: [(direction: X, function: "a")]"#.into(),
    };
    let points = (0..=4000).map(|i| f64::from(i) * 1e-3);
    let points: Vec<String> = points.map(|t| format!("({t}, {:e})", pulse(t)[2])).collect();
    let text = format!(
        r#"(
        nodes: {{ "l": (0, 0, 0), "a": (0, 0, 1), "b": (0, 0, 2), "r": (0, 0, 3) }},
        supports: {{ "l": Fixed, "r": Fixed, "a": (Uy, Uz, Rx, Ry, Rz), "b": (Uy, Uz, Rx, Ry, Rz) }},
        damping: {damping},
        elements: {{
            "ma": Mass(node: "a", mass: {}), "mb": Mass(node: "b", mass: {}),
            "1": Spring(nodes: ("l", "a"), k2: {}, axis2: (1, 0, 0)),
            "2": Spring(nodes: ("a", "b"), k2: {}, axis2: (1, 0, 0)),
            "3": Spring(nodes: ("b", "r"), k2: {}, axis2: (1, 0, 0)),
        }},
        functions: {{
            "d": Ricker(amplitude: "{AMPLITUDE} m", frequency: 1, center: 1.5),
            "a": Points(points: [{}]),
        }},
        cases: {{ "move": Dynamic(duration: {DURATION}, dt: 0.002, step: Adaptive(tolerance: 1e-6), {case}) }},
        outputs: {{ "a": Displacement(node: "a", dof: Ux), "b": Displacement(node: "b", dof: Ux) }},
    )"#,
        MASS[0],
        MASS[1],
        K[0],
        K[1],
        K[2],
        points.join(", ")
    );
    parse(&text, &[])
}

type Pair = [f64; 2];
type Square = [Pair; 2];

fn times(a: &Square, x: Pair) -> Pair {
    a.map(|row| row[0] * x[0] + row[1] * x[1])
}

fn stiffness() -> Square {
    [[K[0] + K[1], -K[1]], [-K[1], K[1] + K[2]]]
}

/// M Φ diag(2 ζ ω) Φᵀ M of the two masses: C = 2 ζ M^½ (M^-½ K M^-½)^½ M^½, and √A = (A + √det A)/√(tr A + 2 √det A).
fn modal(ratio: f64) -> Square {
    let k = stiffness();
    let root = MASS.map(f64::sqrt);
    let mut a = [[0.0; 2]; 2];
    for i in 0..2 {
        for j in 0..2 {
            a[i][j] = k[i][j] / (root[i] * root[j]);
        }
    }
    let s = (a[0][0] * a[1][1] - a[0][1] * a[1][0]).sqrt();
    let t = (a[0][0] + a[1][1] + 2.0 * s).sqrt();
    let mut c = [[0.0; 2]; 2];
    for i in 0..2 {
        for j in 0..2 {
            let whole = (a[i][j] + if i == j { s } else { 0.0 }) / t;
            c[i][j] = 2.0 * ratio * root[i] * root[j] * whole;
        }
    }
    c
}

/// α M + β K.
fn rayleigh(of_mass: f64, of_stiffness: f64) -> Square {
    let mut c = stiffness().map(|row| row.map(|k| of_stiffness * k));
    (0..2).for_each(|i| c[i][i] += of_mass * MASS[i]);
    c
}

/// M ü + C (u̇ − ι u̇ₛ) + K u = −K_fs uₛ by the method of Runge and Kutta, in steps of 0.2 ms; every 2 ms.
fn exact(c: &Square, factors: Pair) -> Vec<Pair> {
    let k = stiffness();
    let det = k[0][0] * k[1][1] - k[0][1] * k[1][0];
    // −K⁻¹ K_fs times the motion of the supports.
    let push = |us: f64| [K[0] * factors[0] * us, K[2] * factors[1] * us];
    let follow = |us: f64| {
        let p = push(us);
        [(k[1][1] * p[0] - k[0][1] * p[1]) / det, (k[0][0] * p[1] - k[1][0] * p[0]) / det]
    };
    let rate = |t: f64, y: [f64; 4]| {
        let [us, vs, _] = pulse(t);
        let (u, v) = ([y[0], y[1]], [y[2], y[3]]);
        let drag = follow(vs);
        let (p, d, s) = (push(us), times(c, [v[0] - drag[0], v[1] - drag[1]]), times(&k, u));
        let a = |i: usize| (p[i] - d[i] - s[i]) / MASS[i];
        [v[0], v[1], a(0), a(1)]
    };
    let h = 2e-4;
    let mut y = [0.0; 4];
    let mut all = vec![[0.0; 2]];
    let add = |y: [f64; 4], s: f64, k: [f64; 4]| std::array::from_fn(|i| y[i] + s * k[i]);
    for i in 0..(DURATION / h).round() as usize {
        let t = i as f64 * h;
        let k1 = rate(t, y);
        let k2 = rate(t + h / 2.0, add(y, h / 2.0, k1));
        let k3 = rate(t + h / 2.0, add(y, h / 2.0, k2));
        let k4 = rate(t + h, add(y, h, k3));
        y = std::array::from_fn(|i| y[i] + h / 6.0 * (k1[i] + 2.0 * k2[i] + 2.0 * k3[i] + k4[i]));
        if (i + 1) % 10 == 0 {
            all.push([y[0], y[1]]);
        }
    }
    all
}

fn history(model: &(Model, System), solver: SolverKind) -> Vec<Pair> {
    let (found, result) = trace(&model.0, &model.1, solver);
    assert_eq!(result.status, Status::Converged, "{}", solver.name());
    found.history.iter().map(|row| [row[0], row[1]]).collect()
}

/// Largest difference over the largest value.
fn apart(a: &[Pair], b: &[Pair]) -> f64 {
    assert_eq!(a.len(), b.len());
    let size = b.iter().flatten().fold(0.0_f64, |m, x| m.max(x.abs()));
    let off =
        a.iter().flatten().zip(b.iter().flatten()).fold(0.0_f64, |m, (x, y)| m.max((x - y).abs()));
    off / size
}

fn dampings() -> [(&'static str, Square); 3] {
    [
        ("Modal(ratio: 0.2)", modal(0.2)),
        ("Rayleigh(mass: 1.5, stiffness: 0)", rayleigh(1.5, 0.0)),
        ("Rayleigh(mass: 1, stiffness: 0.01)", rayleigh(1.0, 0.01)),
    ]
}

#[test]
fn supports_that_move_apart_are_followed_without_drag() {
    for (text, c) in dampings() {
        for factors in [[1.0, -0.5], [0.0, 1.0]] {
            let (moved, expected) = (model(text, Some(factors)), exact(&c, factors));
            for solver in SOLVERS {
                let off = apart(&history(&moved, solver), &expected);
                assert!(off < 2e-3, "{} {text} {factors:?}: {off}", solver.name());
            }
        }
    }
}

#[test]
fn supports_that_move_together_are_a_base_that_is_accelerated() {
    for (text, _) in dampings() {
        let (moved, base) = (model(text, Some([1.0, 1.0])), model(text, None));
        for solver in SOLVERS {
            let against: Vec<Pair> = history(&moved, solver)
                .iter()
                .enumerate()
                .map(|(i, u)| u.map(|x| x - pulse(i as f64 * 2e-3)[0]))
                .collect();
            let off = apart(&against, &history(&base, solver));
            assert!(off < 1e-3, "{} {text}: {off}", solver.name());
        }
    }
}

/// What only a link holds follows the support of the link: ẅ + α ẇ + k/m w = −üₛ of the distance w.
#[test]
fn a_mass_on_a_link_follows_its_support() {
    let (mass, k, of_mass) = (2.0, 200.0, 3.0);
    let text = format!(
        r#"(
        nodes: {{ "g": (0, 0, 0), "m": (0, 0, 1) }},
        supports: {{ "g": Fixed, "m": (Uy, Uz, Rx, Ry, Rz) }},
        damping: Rayleigh(mass: {of_mass}, stiffness: 0),
        elements: {{
            "mass": Mass(node: "m", mass: {mass}),
            "bearing": ElastomericBearing(nodes: ("g", "m"), k: {k}, fy: 1e9, ratio: 0.5, axis2: (1, 0, 0)),
        }},
        functions: {{ "d": Ricker(amplitude: "{AMPLITUDE} m", frequency: 1, center: 1.5) }},
        cases: {{ "move": Dynamic(duration: {DURATION}, dt: 0.002, step: Adaptive(tolerance: 1e-6),
            supports: [(node: "g", dof: Ux, displacement: "d")]) }},
        outputs: {{ "u": Displacement(node: "m", dof: Ux) }},
    )"#
    );
    let (model, system) = parse(&text, &[]);
    let h = 2e-4;
    let rate = |t: f64, [w, v]: Pair| [v, -pulse(t)[2] - of_mass * v - k / mass * w];
    let mut y = [0.0; 2];
    let mut expected = vec![0.0];
    let add = |y: Pair, s: f64, k: Pair| [y[0] + s * k[0], y[1] + s * k[1]];
    for i in 0..(DURATION / h).round() as usize {
        let t = i as f64 * h;
        let k1 = rate(t, y);
        let k2 = rate(t + h / 2.0, add(y, h / 2.0, k1));
        let k3 = rate(t + h / 2.0, add(y, h / 2.0, k2));
        let k4 = rate(t + h, add(y, h, k3));
        y = std::array::from_fn(|i| y[i] + h / 6.0 * (k1[i] + 2.0 * k2[i] + 2.0 * k3[i] + k4[i]));
        if (i + 1) % 10 == 0 {
            expected.push(y[0] + pulse(t + h)[0]);
        }
    }
    for solver in SOLVERS {
        let (found, _) = trace(&model, &system, solver);
        let off =
            found.history.iter().zip(&expected).fold(0.0_f64, |m, (x, y)| m.max((x[0] - y).abs()));
        let size = expected.iter().fold(0.0_f64, |m, x| m.max(x.abs()));
        assert!(off < 2e-3 * size, "{}: {}", solver.name(), off / size);
    }
}
