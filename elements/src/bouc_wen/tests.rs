use super::integration::{STEPS, advance};
use super::*;
use crate::Wen;
use crate::shared::parameters::{numbers, read};
use crate::shared::paths::{finely, through};
use approx::assert_relative_eq;
use trilith_element::conformance::Kit;
use trilith_element::{Driver, Value};

/// n, β, γ, A₀, δ_A, δ_ν, δ_η.
type Shape = [f64; 7];

const NAMES: [&str; 7] = ["n", "beta", "gamma", "a0", "delta_a", "delta_nu", "delta_eta"];

const SHAPES: [Shape; 9] = [
    [1.0, 0.5, 0.5, 1.0, 0.0, 0.0, 0.0],
    [1.0, 0.8, 0.1, 1.0, 0.01, 0.05, 0.1],
    [1.5, 0.8, 0.2, 1.0, 0.0, 0.02, 0.08],
    [2.0, 0.5, 0.5, 1.0, 0.0, 0.0, 0.0],
    [2.0, 1.0, -0.9, 1.0, 0.02, 0.0, 0.0],
    [2.0, 0.5, 0.5, 2.0, 0.0, 0.3, 0.0],
    [3.0, 0.6, 0.4, 1.0, 0.05, 0.05, 0.5],
    [5.0, 0.5, 0.0, 0.7, 0.0, 0.0, 0.2],
    [20.0, 0.5, 0.5, 1.0, 0.0, 0.02, 0.02],
];

fn law_of(k: f64, dy: f64, alpha: f64, shape: Shape) -> BoucWen {
    let mut given = vec![("k", k), ("dy", dy), ("alpha", alpha)];
    given.extend(NAMES.into_iter().zip(shape));
    read(&numbers(&given)).unwrap()
}

/// z and ε by Runge-Kutta's method on the equation of the header.
fn integrated(law: &BoucWen, (z, work): (f64, f64), u: f64, steps: u32) -> (f64, f64) {
    let h = u / f64::from(steps);
    let rate = |(z, work): (f64, f64)| {
        let a = (law.a0 - law.delta_a * work).max(0.01 * law.a0);
        let (nu, eta) = (1.0 + law.delta_nu * work, 1.0 + law.delta_eta * work);
        let sign = if z * u > 0.0 { 1.0 } else { -1.0 };
        ((a - nu * z.abs().powf(law.n) * (law.gamma + law.beta * sign)) / eta, z)
    };
    let mut it = (z, work);
    for _ in 0..steps {
        let add = |k: (f64, f64), h: f64| (it.0 + h * k.0, it.1 + h * k.1);
        let a = rate(it);
        let b = rate(add(a, 0.5 * h));
        let c = rate(add(b, 0.5 * h));
        let d = rate(add(c, h));
        let mean = |a: f64, b: f64, c: f64, d: f64| h * (a + 2.0 * (b + c) + d) / 6.0;
        it = (it.0 + mean(a.0, b.0, c.0, d.0), it.1 + mean(a.1, b.1, c.1, d.1));
    }
    it
}

#[test]
fn conforms_for_many_shapes_and_sizes() {
    for (i, shape) in SHAPES.into_iter().enumerate() {
        let law = law_of(8e7, 0.002, [0.05, 0.0, 1.0, 0.1][i % 4], shape);
        for reach in [0.5, 6.0] {
            Kit::new(&[0.002 * reach], 1.0).paths(3).rate_independent().assert(&law);
        }
    }
}

#[test]
fn is_that_of_wen_without_degradation() {
    for n in [1.0, 1.5, 2.0, 5.0] {
        let ours = law_of(100.0, 0.5, 0.1, [n, 0.5, 0.5, 1.0, 0.0, 0.0, 0.0]);
        let theirs: Wen =
            read(&numbers(&[("k", 100.0), ("fy", 50.0), ("ratio", 0.1), ("exponent", n)])).unwrap();
        let path = [0.2, 0.7, 0.1, 0.9, 3.0, 2.2, -0.4, -2.0, 1.0];
        let (mut a, mut b) = (Driver::new(&ours), Driver::new(&theirs));
        for (f, g) in finely(&mut a, &path, 0.05).iter().zip(finely(&mut b, &path, 0.05)) {
            assert_relative_eq!(*f, g, epsilon = 50.0 * 1e-8);
        }
        assert_relative_eq!(a.heat(), b.heat(), max_relative = 1e-7);
        assert_relative_eq!(a.energy.stored, b.energy.stored, max_relative = 1e-7);
    }
}

/// n = 1 without degradation: exponentials on every branch.
#[test]
fn branches_of_exponent_one_are_exponentials() {
    let (a0, beta, gamma) = (1.3, 0.7, 0.2);
    let law = law_of(1e6, 0.01, 0.2, [1.0, beta, gamma, a0, 0.0, 0.0, 0.0]);
    let limit = a0 / (beta + gamma);
    let loaded = |z0: f64, u: f64| limit - (limit - z0) * (-(beta + gamma) * u).exp();
    // The return: dz/du = −(A + (β − γ) z).
    let rest = a0 / (beta - gamma);
    let returned = |z0: f64, u: f64| (z0 + rest) * (-(beta - gamma) * u).exp() - rest;
    let z1 = loaded(0.0, 3.0);
    let home = ((z1 + rest) / rest).ln() / (beta - gamma);
    let expected = [
        (0.5, loaded(0.0, 0.5)),
        (3.0, z1),
        (2.6, returned(z1, 0.4)),
        (-1.0, -loaded(0.0, 4.0 - home)),
        (-40.0, -limit),
    ];
    let path: Vec<f64> = expected.iter().map(|(u, _)| 0.01 * u).collect();
    // One large step to each, and small steps.
    let one = through(&mut Driver::new(&law), &path);
    let many = finely(&mut Driver::new(&law), &path, 2e-4);
    for (((u, z), f), g) in expected.iter().zip(one).zip(many) {
        let force = 1e6 * 0.01 * (0.2 * u + 0.8 * z);
        assert_relative_eq!(f, force, epsilon = 2e-5 * 1e4);
        assert_relative_eq!(g, force, epsilon = 1e-9 * 1e4);
    }
}

#[test]
fn loops_are_those_of_the_differential_equation() {
    let turns = [3.0, -3.0, 4.0, 2.5, 5.0, -6.0, 0.0, 6.0];
    for shape in SHAPES {
        let law = law_of(4e7, 0.005, 0.05, shape);
        let mut driven = Driver::new(&law);
        let (mut state, mut u) = ((0.0, 0.0), 0.0);
        for turn in turns {
            for i in 1..=20 {
                let from = driven.d[0] / 0.005;
                let to = u + (turn - u) * f64::from(i) / 20.0;
                driven.to(&[0.005 * to]);
                state = integrated(&law, state, to - from, 500);
                // As sharp as n = 20 is a corner within a step of 0.6.
                let close = if shape[0] > 10.0 { 2e-3 } else { 2e-5 };
                assert_relative_eq!(driven.history[0], state.0, epsilon = close);
                assert_relative_eq!(driven.history[1], state.1, epsilon = 20.0 * close);
            }
            u = turn;
        }
        let size = 0.95 * 4e7 * 0.005 * 0.005;
        let spring = 0.5 * 0.05 * 4e7 * driven.d[0] * driven.d[0];
        let work = driven.energy.stored - spring + driven.heat();
        assert_relative_eq!(work, size * state.1, max_relative = 1e-3);
    }
}

/// Where n is no integer, |z|ⁿ has no fourth derivative at z = 0 and the first step from there is of less.
#[test]
fn the_scheme_is_of_order_four() {
    for shape in SHAPES.into_iter().filter(|s| s[0] <= 5.0) {
        let law = law_of(1.0, 1.0, 0.0, shape);
        for (start, u) in [((0.0, 0.0), 1.7), ((0.4, 2.0), 1.0)] {
            let (z, work) = integrated(&law, start, u, 40_000);
            let error = |steps: usize| {
                let end = advance(&law, start.0, start.1, u, 0.0, steps);
                (end.z - z).abs() + (end.work - work).abs()
            };
            let (coarse, fine) = (error(8), error(16));
            assert!(coarse < 1e-4, "{shape:?} {coarse:e}");
            let factor = if start.0 == 0.0 && shape[0].fract() != 0.0 { 5.0 } else { 11.0 };
            assert!(fine < coarse / factor + 1e-11, "{shape:?} {coarse:e} {fine:e}");
        }
    }
}

/// The heat of a cycle by its own rate equation.
#[test]
fn heat_is_that_of_its_rate() {
    for shape in SHAPES {
        let law = law_of(1.0, 1.0, 0.0, shape);
        let mut driven = Driver::new(&law);
        let (mut heat, mut d) = (0.0, 0.0);
        for i in 1..=8000 {
            let to = 4.0 * (0.0015 * f64::from(i)).sin();
            let before = driven.history.clone();
            driven.to(&[to]);
            let u: f64 = to - d;
            d = to;
            let z = 0.5 * (before[0] + driven.history[0]);
            let work = 0.5 * (before[1] + driven.history[1]);
            let old = 0.5 * (before[2] + driven.history[2]);
            let a = |e: f64| (law.a0 - law.delta_a * e).max(0.01 * law.a0);
            let eta = |e: f64| 1.0 + law.delta_eta * e;
            let yielding = law.beta * u.abs() + law.gamma * u * z.signum();
            heat += eta(old) / a(old) * (1.0 + law.delta_nu * work) / eta(work)
                * z.abs().powf(law.n + 1.0)
                * yielding;
        }
        assert_relative_eq!(driven.heat(), heat, max_relative = 1e-4);
    }
}

#[test]
fn a_kept_hundredth_of_a_is_where_degradation_ends() {
    let law = law_of(1.0, 1.0, 0.0, [1.0, 0.5, 0.5, 1.0, 0.1, 0.0, 0.0]);
    let mut driven = Driver::new(&law);
    let path: Vec<f64> = (1..=3000).map(|i| 5.0 * (0.1 * f64::from(i)).sin()).collect();
    let f = through(&mut driven, &path);
    let last = f[2900..].iter().fold(0.0_f64, |a, b| a.max(b.abs()));
    assert!(driven.history[1] > 9.9, "{}", driven.history[1]);
    assert!(last > 0.0 && last < 0.05, "{last}");
}

#[test]
fn never_fails_and_passes_its_limit_by_little() {
    for shape in SHAPES {
        let law = law_of(1.0, 1.0, 0.0, shape);
        let limit = (law.a0 / (law.beta + law.gamma)).powf(1.0 / law.n);
        for z0 in [-1.0, -0.3, 0.0, 1e-12, 0.7, 1.0] {
            for work in [0.0, 0.6, 300.0] {
                let mut before = z0 * limit;
                for u in [1e-300, 1e-12, 1e-4, 0.1, 1.0, 3.0, 10.0, 100.0, 1e3, 1e6, 1e12] {
                    let end = advance(&law, z0 * limit, work, u, 0.0, STEPS);
                    assert!(end.z.is_finite() && end.work.is_finite() && end.slope.is_finite());
                    assert!(end.z.abs() <= 1.05 * limit, "{shape:?} {z0} {work} {u} {end:?}");
                    assert!(law.heat(0.0, end.work, end.z) >= 0.0);
                    if law.delta_a + law.delta_nu == 0.0 {
                        assert!(end.z >= before - 0.05 * limit, "{shape:?} {z0} {u} {end:?}");
                    }
                    before = end.z;
                }
            }
        }
    }
}

#[test]
fn refuses_what_would_give_energy_and_says_what_would_be_right() {
    let given = |beta: f64, gamma: f64| {
        let all = [("k", 1.0), ("dy", 1.0), ("alpha", 0.1), ("beta", beta), ("gamma", gamma)];
        read::<BoucWen>(&numbers(&all)).map_err(|e| e.to_string())
    };
    assert!(given(0.5, 0.5).is_ok() && given(0.5, -0.4).is_ok());
    assert!(given(0.5, -0.5).unwrap_err().contains("above −`beta` = -0.5"));
    assert!(given(0.5, 0.6).unwrap_err().contains("at most `beta`"));
    for (name, wrong) in
        [("n", 0.9), ("beta", 0.0), ("a0", 0.0), ("delta_nu", -0.1), ("alpha", 1.1)]
    {
        assert!(!BoucWen::CARD.parameter(name).unwrap().range.contains(wrong), "{name}");
    }
    let about = [
        numbers(&[("k", 1.0), ("dy", 1.0), ("alpha", 0.5)]),
        vec![("axis", Value::Text("R3".into()))],
    ]
    .concat();
    assert_eq!(read::<BoucWen>(&about).unwrap().axis, Axis::R3);
}
