//! The rules beside closed forms, many small steps, and rest.

use super::*;

fn single(omega2: &[f64]) -> Coupled<'_> {
    Coupled { modes: 1, omega2, damping: Dense::zeros(1, 1) }
}

/// Five modes from at rest to fast and two first-order unknowns, damped by all that may be, against many small steps of the equations.
#[test]
fn random_systems_that_damping_couples_move_as_their_equations_say() {
    const MODES: usize = 5;
    const ALL: usize = 7;
    let mut seed = 0x9e37_79b9_7f4a_7c15_u64;
    let mut random = || {
        seed ^= seed << 13;
        seed ^= seed >> 7;
        seed ^= seed << 17;
        (seed >> 11) as f64 / (1u64 << 52) as f64 - 1.0
    };
    for dt in [1e-3, 0.02, 0.1] {
        let omega2 = [0.0, 4.0, 300.0, 2e4, 9e4, 30.0, 700.0];
        // D = D₀ + E G⁻¹ Eᵀ: nothing gains energy.
        let mut damping = Dense::zeros(ALL, ALL);
        for y in MODES..ALL {
            damping[(y, y)] = 2.0 + random();
            for i in 0..MODES {
                damping[(i, y)] = random();
                damping[(y, i)] = damping[(i, y)];
            }
        }
        let root: [[f64; MODES]; MODES] = [(); MODES].map(|()| [(); MODES].map(|()| random()));
        for i in 0..MODES {
            for j in 0..MODES {
                let own: f64 = (0..MODES).map(|k| root[i][k] * root[j][k]).sum();
                let tied =
                    (MODES..ALL).map(|y| damping[(i, y)] * damping[(j, y)] / damping[(y, y)]);
                damping[(i, j)] = own + tied.sum::<f64>();
            }
        }
        let numbers = [(); 4].map(|()| [(); ALL].map(|()| random()));
        let [q0, v0, s0, s1] = &numbers;
        // ∫q, q and q̇, of first-order unknowns their rates in the place of q̇.
        let rate = |t: f64, x: &[[f64; ALL]; 3]| {
            let source = |j: usize| s0[j] + (s1[j] - s0[j]) * t / dt;
            let mut v = x[2];
            for y in MODES..ALL {
                let tie: f64 = (0..MODES).map(|i| damping[(y, i)] * v[i]).sum();
                v[y] = (source(y) - omega2[y] * x[1][y] - tie) / damping[(y, y)];
            }
            let mut a = [0.0; ALL];
            for i in 0..MODES {
                let damped: f64 = (0..ALL).map(|j| damping[(i, j)] * v[j]).sum();
                a[i] = source(i) - omega2[i] * x[1][i] - damped;
            }
            [x[1], v, a]
        };
        let add = |x: &[[f64; ALL]; 3], r: &[[f64; ALL]; 3], h: f64| {
            let mut sum = *x;
            for (x, r) in sum.iter_mut().flatten().zip(r.iter().flatten()) {
                *x += h * r;
            }
            sum
        };
        let (mut x, steps) = ([[0.0; ALL], *q0, *v0], 20_000);
        let h = dt / f64::from(steps);
        for i in 0..steps {
            let t = h * f64::from(i);
            let k1 = rate(t, &x);
            let k2 = rate(t + 0.5 * h, &add(&x, &k1, 0.5 * h));
            let k3 = rate(t + 0.5 * h, &add(&x, &k2, 0.5 * h));
            let k4 = rate(t + h, &add(&x, &k3, h));
            for (k, share) in [(k1, 1.0), (k2, 2.0), (k3, 2.0), (k4, 1.0)] {
                x = add(&x, &k, share * h / 6.0);
            }
        }
        x[2] = rate(dt, &x)[1];
        let found = Coupled { modes: MODES, omega2: &omega2, damping: damping.clone() }.exact(dt);
        for (row, (found, expected)) in found.iter().zip(&x).enumerate() {
            let most = expected.iter().fold(0.0_f64, |most, x| most.max(x.abs()));
            let mut y = vec![0.0; ALL];
            for (block, x) in found.iter().zip(&numbers) {
                block.mul_add(1.0, x, &mut y);
            }
            for (j, (y, x)) in y.iter().zip(expected).enumerate() {
                assert!((y - x).abs() < 1e-9 * most, "Δt {dt}, row {row}, {j}: {y} {x}");
            }
        }
    }
}

/// A mass m on a spring k and a dashpot c in a row (unit mass, κ = k, E = −c e, …) against many small steps of the
/// equations themselves, for both rules.
#[test]
fn a_first_order_unknown_tied_to_a_mode_moves_as_its_equations_say() {
    // q̈ = s − ω² q − d q̇ − e ẏ,  g ẏ = r − κ y − e q̇; s and r linear in time.
    let (w2, k, d, e, g, dt) = (40.0, 30.0, 0.9, -0.6, 0.8, 0.37);
    let damping = Dense::from_columns(2, 2, vec![d, e, e, g]);
    let omega2 = [w2, k];
    let system = Coupled { modes: 1, omega2: &omega2, damping };
    let (s, r) = ([0.3, -1.1], [2.0, 0.7]);
    let rate = |t: f64, [q, v, y]: [f64; 3]| {
        let at = |x: [f64; 2]| x[0] + (x[1] - x[0]) * t / dt;
        let dy = (at(r) - k * y - e * v) / g;
        [v, at(s) - w2 * q - d * v - e * dy, dy]
    };
    let start = [0.05, -0.4, 0.11];
    let (mut x, steps) = (start, 4000);
    let h = dt / f64::from(steps);
    let mut sum = [0.0; 2];
    for i in 0..steps {
        let t = h * f64::from(i);
        let add = |a: [f64; 3], b: [f64; 3], h: f64| std::array::from_fn(|i| a[i] + h * b[i]);
        let k1 = rate(t, x);
        let k2 = rate(t + 0.5 * h, add(x, k1, 0.5 * h));
        let k3 = rate(t + 0.5 * h, add(x, k2, 0.5 * h));
        let k4 = rate(t + h, add(x, k3, h));
        let y: [f64; 3] =
            std::array::from_fn(|i| x[i] + h / 6.0 * (k1[i] + 2.0 * k2[i] + 2.0 * k3[i] + k4[i]));
        sum[0] += 0.5 * h * (x[0] + y[0]);
        sum[1] += 0.5 * h * (x[2] + y[2]);
        x = y;
    }
    let apply = |rows: &[Dense; 4], i: usize| -> f64 {
        let inputs = [[start[0], start[2]], [start[1], 99.0], [s[0], r[0]], [s[1], r[1]]];
        let terms = rows.iter().zip(inputs);
        terms.map(|(b, x)| b[(i, 0)] * x[0] + b[(i, 1)] * x[1]).sum()
    };
    let [integral, q, v] = system.exact(dt);
    let expected = [x[0], x[2], x[1], rate(dt, x)[2], sum[0], sum[1]];
    let found = [
        apply(&q, 0),
        apply(&q, 1),
        apply(&v, 0),
        apply(&v, 1),
        apply(&integral, 0),
        apply(&integral, 1),
    ];
    for (a, b) in found.iter().zip(expected) {
        assert!((a - b).abs() < 1e-8, "{found:?} {expected:?}");
    }
    // The other rule comes to the same at second order.
    let error = |n: i32| {
        let (mut at, h) = (start, dt / f64::from(n));
        let [_, q, v] = system.average(h);
        for i in 0..n {
            let load = |x: [f64; 2], i: i32| x[0] + (x[1] - x[0]) * f64::from(i) / f64::from(n);
            let inputs = [
                [at[0], at[2]],
                [at[1], 99.0],
                [load(s, i), load(r, i)],
                [load(s, i + 1), load(r, i + 1)],
            ];
            let apply = |rows: &[Dense; 4], i: usize| -> f64 {
                let terms = rows.iter().zip(inputs);
                terms.map(|(b, x)| b[(i, 0)] * x[0] + b[(i, 1)] * x[1]).sum()
            };
            at = [apply(&q, 0), apply(&v, 0), apply(&q, 1)];
        }
        (at[0] - x[0]).abs() + (at[2] - x[2]).abs()
    };
    let (coarse, fine) = (error(20), error(40));
    assert!(coarse < 1e-3 && (coarse / fine - 4.0).abs() < 0.3, "{coarse} {fine}");
}

/// Modes that damping could couple but does not, a slow one and one of 6 kHz, beside the closed form of each.
#[test]
fn a_fast_mode_beside_a_slow_one_is_as_exact_as_alone() {
    let (omega2, rates, dt) = ([40.0_f64, 1.5e9], [0.3, 150.0], 0.1);
    let damping = Dense::from_columns(2, 2, vec![rates[0], 0.0, 0.0, rates[1]]);
    let together = Coupled { modes: 2, omega2: &omega2, damping }.exact(dt);
    for i in 0..2 {
        let alone = single_mode::exact(omega2[i], rates[i], dt);
        let w = omega2[i].sqrt();
        for ((row, blocks), of_row) in alone.iter().zip(&together).zip([w, 1.0, w.recip()]) {
            let of_column = [1.0, w, w * w, w * w];
            for ((x, block), of_column) in row.iter().zip(blocks).zip(of_column) {
                let off = (block[(i, i)] - x).abs() * of_row * of_column;
                assert!(off < 1e-10, "mode {i}: {} {x} {off}", block[(i, i)]);
            }
        }
    }
}

/// What stands under a constant load does not move, however fast the fastest mode is.
#[test]
fn what_stands_goes_on_standing() {
    let omega2 = [40.0, 1.5e9, 3e4];
    let damping =
        Dense::from_columns(3, 3, vec![0.3, 5.0, 2.0, 5.0, 150.0, 30.0, 2.0, 30.0, 900.0]);
    let [_, q, v] = Coupled { modes: 2, omega2: &omega2, damping }.exact(0.1);
    let s = [0.2, 700.0, 11.0];
    for i in 0..3 {
        let sum = |b: &[Dense; 4]| -> f64 {
            (0..3)
                .map(|j| b[0][(i, j)] * s[j] / omega2[j] + (b[2][(i, j)] + b[3][(i, j)]) * s[j])
                .sum()
        };
        let stands = s[i] / omega2[i];
        assert!((sum(&q) - stands).abs() < 1e-12 * stands.max(5e-3), "{i}: {} {stands}", sum(&q));
        assert!(sum(&v).abs() < 1e-13, "{i}: {}", sum(&v));
    }
}

#[test]
fn a_fast_first_order_unknown_does_not_ring() {
    let damping = Dense::from_columns(2, 2, vec![0.1, 0.0, 0.0, 1e-12]);
    let [_, q, _] = Coupled { modes: 1, omega2: &[4.0, 1.0], damping }.average(0.1);
    assert!(q[0][(1, 1)].abs() < 1e-6 && (q[3][(1, 1)] - 1.0).abs() < 1e-6);
}

/// u = p/k (1 − cos ωt) under a constant load; (p/k)(t/t₁ − sin ωt / ωt₁) under a ramp.
#[test]
fn constant_and_linear_loads_are_exact() {
    let (w, dt) = (3.0, 0.7);
    let c = single(&[w * w]).exact(dt);
    let x = w * dt;
    let both = c[1][2][(0, 0)] + c[1][3][(0, 0)];
    assert!((both - (1.0 - x.cos()) / (w * w)).abs() < 1e-15);
    assert!((c[1][3][(0, 0)] - (1.0 - x.sin() / x) / (w * w)).abs() < 1e-15);
    assert!((c[1][0][(0, 0)] - x.cos()).abs() < 1e-14);
}

/// c q̇ + q = s: q = 1 − e^(−t/c) under a constant load, t − c (1 − e^(−t/c)) under a rising one.
#[test]
fn a_damped_static_shape_follows_constant_and_rising_loads() {
    let (c, dt) = (0.3, 0.7);
    let [integral, q, v] = static_rule(c, 1.0, dt);
    let decay = f64::exp(-dt / c);
    assert!((q[2] + q[3] - (1.0 - decay)).abs() < 1e-15);
    assert!((q[3] * dt - (dt - c * (1.0 - decay))).abs() < 1e-15);
    assert!((v[2] + v[3] - decay / c).abs() < 1e-14);
    assert!((integral[2] + integral[3] - (dt - c * (1.0 - decay))).abs() < 1e-15);
    // Little damping and none are the same for a load that did not jump.
    let (little, none) = (static_rule(1e-8 * dt, 1.0, dt), static_rule(0.0, 1.0, dt));
    for (a, b) in little.iter().zip(&none) {
        let at = |r: &[f64; 4]| [r[0] + r[2], r[3]];
        for (x, y) in at(a).iter().zip(at(b)) {
            assert!((x - y).abs() < 1e-6, "{little:?} {none:?}");
        }
    }
}

#[test]
fn a_free_mass_moves_as_under_constant_and_rising_force() {
    let c = single(&[0.0]).exact(2.0);
    assert!((c[1][2][(0, 0)] - 4.0 / 3.0).abs() < 1e-14);
    assert!((c[1][3][(0, 0)] - 4.0 / 6.0).abs() < 1e-14);
    assert!((c[2][3][(0, 0)] - 1.0).abs() < 1e-14);
}

/// With constant acceleration both rules are exact; with a spring the average one keeps the energy.
#[test]
fn average_acceleration_keeps_the_energy_of_a_free_oscillator() {
    let (w, dt) = (3.0, 0.9);
    let [sum, q, v] = single(&[w * w]).average(dt);
    let at = |b: &Dense| b[(0, 0)];
    let (q1, v1) = (at(&q[0]) * 0.3 + at(&q[1]) * 1.1, at(&v[0]) * 0.3 + at(&v[1]) * 1.1);
    let energy = |q: f64, v: f64| v * v + w * w * q * q;
    assert!((energy(q1, v1) / energy(0.3, 1.1) - 1.0).abs() < 1e-14);
    assert!((at(&sum[0]) * 0.3 + at(&sum[1]) * 1.1 - 0.5 * dt * (0.3 + q1)).abs() < 1e-15);
    let free = single(&[0.0]).average(dt);
    assert!((at(&free[1][2]) + at(&free[1][3]) - 0.5 * dt * dt).abs() < 1e-15);
    assert!((at(&free[2][2]) + at(&free[2][3]) - dt).abs() < 1e-15);
}
