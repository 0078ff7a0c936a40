//! Derivatives of small models with yielding, a stop, friction and a Maxwell damper, against a small program that shares no
//! code with the solvers: HHT and the laws once more, and plain differences.

use super::text;
use trilith::SolverKind;

/// Two masses in a row: a spring and a yielding bar to the ground, a damper between them, a stop and a rubbing pad.
#[derive(Clone, Copy, Debug)]
struct Pair([f64; 8]);

const NAMES: [&str; 8] = ["mass", "ke", "fy", "c", "mu", "opening", "kd", "push"];
const K: f64 = 4e4;
const BETWEEN: f64 = 2.5e4;
const POST: f64 = 0.1;
const STOP: f64 = 3e5;
const STEM: f64 = 2e5;
const PRESS: f64 = 1e3;
const ALPHA: f64 = -0.1;
const DT: f64 = 0.004;
const STEPS: usize = 300;
const FREQUENCY: f64 = 1.7;

impl Pair {
    fn file(&self) -> String {
        let own: String =
            NAMES.iter().zip(self.0).map(|(n, x)| format!("\"{n}\": {x:?}, ")).collect();
        format!(
            r#"(
            plane: XZ,
            parameters: {{ {own} }},
            nodes: {{ "g": (0, 0, 0), "a": (1, 0, 0), "b": (2, 0, 0), "w": (3, 0, 0) }},
            supports: {{ "g": Fixed, "w": Fixed, "a": (Uz, Ry), "b": (Uz, Ry) }},
            elements: {{
                "ma": Mass(node: "a", mass: "mass"), "mb": Mass(node: "b", mass: "mass/2"),
                "first": Spring(nodes: ("g", "a"), k1: {K}), "second": Spring(nodes: ("a", "b"), k1: {BETWEEN}),
                "bar": MultilinearPlastic(
                    nodes: ("g", "a"), axis: U1, deformation: ["-1", "-fy/ke", 0, "fy/ke", "1"],
                    force: ["-fy - {POST}*ke*(1 - fy/ke)", "-fy", 0, "fy", "fy + {POST}*ke*(1 - fy/ke)"],
                ),
                "damper": MaxwellDamper(nodes: ("a", "b"), k: "kd", c: "c"),
                "stop": Gap(nodes: ("b", "w"), k: {STOP}, opening: "opening"),
                "pad": NLink(node: "b", kn: 1e6, opening: "-{}", ks: {STEM}, mu: "mu"),
            }},
            functions: {{ "wave": Sine(amplitude: "push", frequency: {FREQUENCY}, cycles: 20) }},
            loads: {{ "at b": [(node: "b", dof: Ux, force: 1)] }},
            cases: {{ "shake": Dynamic(
                duration: {}, dt: {DT}, forces: [(load: "at b", function: "wave")],
                solver: Hht, alpha: {ALPHA}, step: Fixed(substeps: 1), link_tolerance: 1e-13,
            ) }},
            outputs: {{
                "a": Displacement(node: "a", dof: Ux), "b": Displacement(node: "b", dof: Ux),
                "speed": Velocity(node: "b", dof: Ux), "kick": Acceleration(node: "a", dof: Ux),
                "bar": LinkForce(link: "bar", axis: U1), "damper": LinkForce(link: "damper", axis: U1),
            }},
        )"#,
            PRESS / 1e6,
            DT * STEPS as f64,
        )
    }

    /// Histories of the outputs.
    fn run(&self) -> Vec<[f64; 6]> {
        let [m, ke, fy, c, mu, opening, kd, push] = self.0;
        let (gamma, w) = (0.5 - ALPHA, 1.0 + ALPHA);
        let beta = 0.25 * (1.0 - ALPHA) * (1.0 - ALPHA);
        let mass = [m, 0.5 * m];
        let [mut u, mut v, mut a] = [[0.0_f64; 2]; 3];
        // Plastic deformation of the bar, slip of the pad, force of the damper.
        let (mut plastic, mut slip, mut held) = (0.0, 0.0, 0.0);
        let mut resisted = [0.0, 0.0];
        let slider = |k: f64, limit: f64, d: f64, gone: f64| -> (f64, f64, f64) {
            let f = k * (d - gone);
            if f.abs() <= limit {
                (f, k, gone)
            } else {
                (limit.copysign(f), 0.0, d - limit.copysign(f) / k)
            }
        };
        let mut all = vec![[0.0; 6]];
        for i in 1..=STEPS {
            let at = [u, v];
            let trial = |a1: [f64; 2], a: [f64; 2]| {
                let u1 = [0, 1].map(|j| {
                    at[0][j] + DT * at[1][j] + DT * DT * ((0.5 - beta) * a[j] + beta * a1[j])
                });
                let v1 = [0, 1].map(|j| at[1][j] + DT * ((1.0 - gamma) * a[j] + gamma * a1[j]));
                (u1, v1)
            };
            let laws = |u1: [f64; 2], v1: [f64; 2]| {
                let post = POST * ke;
                let (bar, bar_k, p) = slider(ke - post, (1.0 - POST) * fy, u1[0], plastic);
                let (pad, pad_k, s) = slider(STEM, mu * PRESS, u1[1], slip);
                let stop = if u1[1] > opening { STOP * (u1[1] - opening) } else { 0.0 };
                // A rate that runs straight, and moves the spring as far as the ends say.
                let x = DT * kd / c;
                let (phi1, decay) = ((1.0 - (-x).exp()) / x, (-x).exp());
                let phi2 = (1.0 - phi1) / x;
                let change = (v1[1] - v1[0]) - (at[1][1] - at[1][0]);
                let mean = ((u1[1] - u1[0]) - (at[0][1] - at[0][0])) / DT;
                let damper =
                    decay * held + kd * DT * ((mean - 0.5 * change) * phi1 + change * phi2);
                let bar = bar + post * u1[0];
                let inner = BETWEEN * (u1[1] - u1[0]) + damper;
                let f = [K * u1[0] + bar - inner, inner + pad + stop];
                let of_damper =
                    kd * phi1 * beta * DT * DT + kd * DT * (phi2 - 0.5 * phi1) * gamma * DT;
                let b2 = beta * DT * DT;
                let cross = -BETWEEN * b2 - of_damper;
                let stiff = if u1[1] > opening { STOP } else { 0.0 };
                let k = [
                    [(K + bar_k + post) * b2 - cross, cross],
                    [cross, (pad_k + stiff) * b2 - cross],
                ];
                (f, k, [bar, damper], (p, s))
            };
            let load = push * (std::f64::consts::TAU * FREQUENCY * DT * i as f64).sin();
            let before = push * (std::f64::consts::TAU * FREQUENCY * DT * (i - 1) as f64).sin();
            let mut a1 = a;
            for _ in 0..60 {
                let (u1, v1) = trial(a1, a);
                let (f, k, ..) = laws(u1, v1);
                let r = [0, 1].map(|j| {
                    let own = |load: f64| if j == 1 { load } else { 0.0 };
                    w * (own(load) - f[j]) - ALPHA * (own(before) - resisted[j]) - mass[j] * a1[j]
                });
                let j =
                    [[mass[0] + w * k[0][0], w * k[0][1]], [w * k[1][0], mass[1] + w * k[1][1]]];
                let det = j[0][0] * j[1][1] - j[0][1] * j[1][0];
                let x = [
                    (j[1][1] * r[0] - j[0][1] * r[1]) / det,
                    (j[0][0] * r[1] - j[1][0] * r[0]) / det,
                ];
                a1 = [a1[0] + x[0], a1[1] + x[1]];
            }
            let (u1, v1) = trial(a1, a);
            let (f, _, [bar, damper], (p, s)) = laws(u1, v1);
            (u, v, a, resisted, held, plastic, slip) = (u1, v1, a1, f, damper, p, s);
            all.push([u[0], u[1], v[1], a[0], bar, damper]);
        }
        all
    }

    fn with(mut self, i: usize, by: f64) -> Self {
        self.0[i] += by;
        self
    }
}

/// Numbers from 0 to 1 in a fixed order.
fn numbers(seed: u64) -> impl FnMut() -> f64 {
    let mut state = seed.wrapping_mul(0x9e37_79b9_7f4a_7c15) | 1;
    move || {
        state ^= state << 13;
        state ^= state >> 7;
        state ^= state << 17;
        (state >> 11) as f64 / (1_u64 << 53) as f64
    }
}

#[test]
fn random_pairs_move_as_a_program_of_their_own_says() {
    for seed in 1..=4 {
        let mut next = numbers(seed);
        let typical = [300.0, 6e4, 900.0, 3e3, 0.3, 0.02, 8e4, 2.5e3];
        let pair = Pair(typical.map(|x| x * (0.8 + 0.4 * next())));
        let case = super::Case::new(&text(&pair.file(), "pair.ron"), SolverKind::Hht, &[], &NAMES);
        let base = pair.run();
        let found = &case.found;
        for (o, output) in found.outputs.iter().enumerate() {
            assert_eq!(output.history.len(), base.len(), "{pair:?}");
            let most = base.iter().fold(0.0_f64, |m, x| m.max(x[o].abs()));
            for (given, own) in output.history.iter().zip(&base) {
                let apart = (given - own[o]).abs();
                assert!(apart < 1e-9 * most, "{pair:?} {}: {given} for {}", output.name, own[o]);
            }
        }
        for (j, name) in NAMES.iter().enumerate() {
            let h = 1e-7 * pair.0[j];
            let (low, high) = (pair.with(j, -h).run(), pair.with(j, h).run());
            for (o, output) in found.outputs.iter().enumerate() {
                let quotient: Vec<f64> =
                    low.iter().zip(&high).map(|(a, b)| (b[o] - a[o]) / (2.0 * h)).collect();
                let most = quotient.iter().fold(0.0_f64, |m, x| m.max(x.abs()));
                for (i, (given, own)) in output.by[j].iter().zip(&quotient).enumerate() {
                    assert!(
                        (given - own).abs() < 1e-6 * most,
                        "{pair:?} {} by {name}, step {i}: {given} for {own}",
                        output.name
                    );
                }
            }
        }
    }
}
