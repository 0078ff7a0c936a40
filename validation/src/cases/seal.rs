//! A rotor in a seal with cross-coupled stiffness.

use crate::case::BOTH;
use crate::unit::{JOULE, METRE};
use crate::{Case, Check, Curve, View};

/// m z̈ + c ż + (k − i q) z = 0 with z = x + i y.
const SEAL: &str = r#"(
    title: "Rotor in a seal with cross-coupled stiffness",
    parameters: { "c": 500 },
    nodes: { "rotor": (0, 0, 0) },
    supports: { "rotor": (Uz, Rx, Ry, Rz) },
    elements: {
        "rotor": Mass(node: "rotor", mass: "100 kg"),
        // local 2 and 3 of a node are X and Y
        "seal": LinearLink(
            node: "rotor",
            stiffness: [
                [0, 0, 0, 0, 0, 0], [0, 1e6, 1e5, 0, 0, 0], [0, -1e5, 1e6, 0, 0, 0],
                [0, 0, 0, 0, 0, 0], [0, 0, 0, 0, 0, 0], [0, 0, 0, 0, 0, 0],
            ],
            damping: [
                [0, 0, 0, 0, 0, 0], [0, "c", 0, 0, 0, 0], [0, 0, "c", 0, 0, 0],
                [0, 0, 0, 0, 0, 0], [0, 0, 0, 0, 0, 0], [0, 0, 0, 0, 0, 0],
            ],
        ),
    },
    cases: {
        "whirl": Dynamic(
            duration: "0.5 s", dt: "0.25 ms",
            initial: [(node: "rotor", dof: Ux, displacement: "1 mm")],
        ),
    },
    outputs: {
        "x": Displacement(node: "rotor", dof: Ux),
        "y": Displacement(node: "rotor", dof: Uy),
    },
)"#;

type Complex = [f64; 2];

fn times(a: Complex, b: Complex) -> Complex {
    [a[0] * b[0] - a[1] * b[1], a[0] * b[1] + a[1] * b[0]]
}

/// Displacement and velocity of the rotor, let go at z = 1 mm.
fn whirl(c: f64) -> impl Fn(f64) -> [Complex; 2] + Copy {
    let (m, k, q) = (100.0, 1e6, 1e5);
    // λ = −c/2m ± √((c/2m)² − (k − i q)/m)
    let h = c / (2.0 * m);
    let (re, im) = (h * h - k / m, q / m);
    let size = f64::hypot(re, im);
    let root = [((size + re) / 2.0).sqrt(), ((size - re) / 2.0).sqrt().copysign(im)];
    let (one, two) = ([root[0] - h, root[1]], [-root[0] - h, -root[1]]);
    move |t: f64| {
        let wave = |l: Complex| {
            let size = (l[0] * t).exp();
            [size * (l[1] * t).cos(), size * (l[1] * t).sin()]
        };
        let (a, b) = (wave(one), wave(two));
        // z = (λ₂ e^(λ₁t) − λ₁ e^(λ₂t))/(λ₂ − λ₁), ż = λ₁ λ₂ (e^(λ₁t) − e^(λ₂t))/(λ₂ − λ₁)
        let d = [two[0] - one[0], two[1] - one[1]];
        let n = d[0] * d[0] + d[1] * d[1];
        let over = [d[0] / n, -d[1] / n];
        let (p, r) = (times(two, a), times(one, b));
        let z = times([p[0] - r[0], p[1] - r[1]], over);
        let v = times(times(times(one, two), [a[0] - b[0], a[1] - b[1]]), over);
        [[1e-3 * z[0], 1e-3 * z[1]], [1e-3 * v[0], 1e-3 * v[1]]]
    }
}

pub(super) fn cases() -> Vec<Case> {
    // The whirl grows where q > c ω = 1e5 N/m: c = 1000 N·s/m is the border.
    [("LL-1", "Rotor in a seal, unstable", 500.0), ("LL-2", "Rotor in a seal, stable", 2000.0)]
        .map(|(id, title, c)| {
            let exact = whirl(c);
            let energy = |t: f64| {
                let [z, v] = exact(t);
                let square = |a: Complex| a[0] * a[0] + a[1] * a[1];
                50.0 * square(v) + 5e5 * square(z)
            };
            let mut checks: Vec<Check> = Vec::new();
            let peak = (exact(0.5)[0][0].hypot(exact(0.5)[0][1])).max(1e-4);
            for t in [0.1, 0.3, 0.5] {
                let z = exact(t)[0];
                let near = 2e-3 * z[0].hypot(z[1]).min(peak);
                checks.push(Check::at("x", METRE, t, z[0], near).absolute());
                checks.push(Check::at("y", METRE, t, z[1], near).absolute());
            }
            let given = energy(0.0) - energy(0.5);
            checks.push(Check::new("energy taken by the seal", JOULE, given, 2e-3, |r| {
                r.heat("seal")
            }));
            Case {
                id,
                title,
                source: "m z̈ + c ż + (k − i q) z = 0, z = x + i y",
                text: SEAL.into(),
                set: vec![super::set("c", c)],
                solvers: BOTH,
                checks,
                view: View::histories([
                    Curve::new("x", METRE).against(move |t| exact(t)[0][0]),
                    Curve::new("y", METRE).against(move |t| exact(t)[0][1]),
                ]),
            }
        })
        .into()
}
