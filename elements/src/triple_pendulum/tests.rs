use super::*;
use crate::shared::parameters::{numbers, read};
use crate::shared::paths::cycle;
use approx::assert_relative_eq;
use trilith_element::conformance::Kit;
use trilith_element::{Driver, Value};

const KN: f64 = 5e8;

fn new(mu: [f64; 4]) -> TriplePendulum {
    TriplePendulum {
        kn: KN,
        damping: 0.0,
        pull: false,
        ks: KN,
        radii: [1e-3, 2e-4, 2e-4, 1e-3],
        heights: None,
        capacities: None,
        stop_stiffness: None,
        mu: Some(mu),
        mu_slow: None,
        mu_fast: None,
        rate: None,
    }
}

/// On a small scale, so that it goes through its regimes and lifts on the paths of the kit.
fn small() -> TriplePendulum {
    new([0.2, 0.05, 0.05, 0.4])
}

fn by_speed() -> TriplePendulum {
    TriplePendulum {
        mu: None,
        mu_slow: Some([0.1, 0.02, 0.03, 0.2]),
        mu_fast: Some([0.2, 0.05, 0.06, 0.4]),
        rate: Some([20.0, 30.0, 30.0, 20.0]),
        ..small()
    }
}

fn with_rims(law: TriplePendulum) -> TriplePendulum {
    let capacities = Some([2e-4, 8e-5, 8e-5, 2e-4]);
    TriplePendulum { capacities, stop_stiffness: Some(0.3 * KN), ..law }
}

#[test]
fn conforms_with_and_without_rims_and_dashpot() {
    let scale = [1e-4, 4e-4, 3e-4];
    let kit = || Kit::new(&scale, 5.0).active().paths(3);
    kit().rate_independent().assert(&small());
    kit().rate_independent().assert(&with_rims(small()));
    for law in [small(), by_speed(), new([0.1; 4]), new([0.0; 4])] {
        kit().assert(&law);
        kit().assert(&with_rims(law.clone()));
        for pull in [false, true] {
            kit().assert(&TriplePendulum { damping: 1.3e6, pull, ..law.clone() });
        }
    }
}

/// A bearing of full size under 1 MN (0.1 mm of compression).
fn large() -> TriplePendulum {
    TriplePendulum {
        kn: 1e10,
        ks: 1e11,
        radii: [2.2, 0.4, 0.35, 2.5],
        heights: Some([0.1, 0.05, 0.05, 0.1]),
        capacities: Some([0.35, 0.06, 0.07, 0.40]),
        stop_stiffness: Some(1e12),
        ..new([0.05, 0.02, 0.03, 0.09])
    }
}

const W: f64 = 1e6;

/// Backbone of Fenz & Constantinou: (displacement, force) where the regimes change, from their
/// equations for loading.
fn backbone(law: &TriplePendulum) -> Vec<(f64, f64)> {
    let h = law.heights.unwrap_or_default();
    let [r1, r2, r3, r4] = [0, 1, 2, 3].map(|i| law.radii[i] - h[i]);
    let [m1, m2, m3, m4] = law.mu.unwrap().map(|m| m * W);
    let [d1, d2, d3, d4] = law.capacities.unwrap();
    assert!(m2 <= m3 && m3 <= m1 && m1 <= m4);
    // Sliding starts on 2, then on 3 as well; regime I.
    let mut all = vec![(0.0, m2), ((m3 - m2) * r2 / W, m3)];
    let mut go = |to: f64, sliding: f64| {
        let (u, f) = *all.last().unwrap();
        all.push((u + (to - f) * sliding / W, to));
    };
    go(m1, r2 + r3);
    // II: 1 and 3.
    go(m4, r1 + r3);
    // III: 1 and 4, until 1 meets its rim at F = W d₁/R₁ + F₁.
    go(W * d1 / r1 + m1, r1 + r4);
    // IV: 2 and 4, until 4 meets its rim.
    go(W * d4 / r4 + m4, r2 + r4);
    // V: 2 and 3, until the first of them does: they have moved (F₁ − F₂) R₂/W and (F₄ − F₃) R₃/W
    // before their neighbours slid.
    let two = W * d1 / r1 + m1 + (d2 - (m1 - m2) * r2 / W) * W / r2;
    let three = W * d4 / r4 + m4 + (d3 - (m4 - m3) * r3 / W) * W / r3;
    go(two.min(three), r2 + r3);
    all
}

fn line(points: &[(f64, f64)], u: f64) -> f64 {
    let i = points.windows(2).position(|p| u <= p[1].0).unwrap();
    let ((a, f), (b, g)) = (points[i], points[i + 1]);
    f + (g - f) * (u - a) / (b - a)
}

#[test]
fn follows_the_five_regimes_and_their_transitions() {
    let law = large();
    let points = backbone(&law);
    // The transition to regime II in its published form: u* = (μ₁ − μ₂) R₂* + (μ₁ − μ₃) R₃*.
    assert_relative_eq!(points[2].0, 0.03 * 0.35 + 0.02 * 0.30, max_relative = 1e-12);
    // u** = u* + (μ₄ − μ₁)(R₁* + R₃*).
    assert_relative_eq!(points[3].0, points[2].0 + 0.04 * (2.1 + 0.3), max_relative = 1e-12);
    for steps in [7, 50, 400] {
        let mut driver = Driver::new(&law);
        driver.to(&[-1e-4, 0.0, 0.0]);
        let end = points.last().unwrap().0;
        for i in 1..=steps {
            let u = end * f64::from(i) / f64::from(steps);
            // Any direction.
            driver.to(&[-1e-4, 0.6 * u, 0.8 * u]);
            let f = 0.6 * driver.f[1] + 0.8 * driver.f[2];
            assert_relative_eq!(f, line(&points, u), max_relative = 2e-4);
            assert!((0.8 * driver.f[1] - 0.6 * driver.f[2]).abs() < 1e-6 * W);
        }
    }
}

/// Four real surfaces: slide plates tilt, so 2 sees the inclination of 1 and 3 that of 4. Force
/// controlled, rigid–plastic, without rims: displacement of each surface for a history of forces.
fn real_surfaces(law: &TriplePendulum, forces: &[f64]) -> Vec<f64> {
    let h = law.heights.unwrap_or_default();
    let r = [0, 1, 2, 3].map(|i| law.radii[i] - h[i]);
    let limit = law.mu.unwrap().map(|m| m * W);
    let mut u = [0.0_f64; 4];
    let mut all = Vec::new();
    for &f in forces {
        for (i, outer) in [(0, None), (3, None), (1, Some(0)), (2, Some(3))] {
            let tilt = outer.map_or(0.0, |o: usize| u[o] / r[o]);
            // |F − W (u/R + tilt)| ≤ μ W holds on every surface.
            let friction = f - W * (u[i] / r[i] + tilt);
            let over = friction - friction.clamp(-limit[i], limit[i]);
            u[i] += over * r[i] / W;
        }
        all.push(u.iter().sum());
    }
    all
}

#[test]
fn cycles_follow_four_real_surfaces_that_tilt() {
    let law = TriplePendulum { capacities: None, stop_stiffness: None, ks: 1e12, ..large() };
    let forces: Vec<f64> = (1..=4000)
        .map(|i| {
            let t = f64::from(i) / 4000.0;
            1.8e5 * (1.0 - 0.4 * t) * (7.0 * std::f64::consts::TAU * t).sin()
        })
        .collect();
    let places = real_surfaces(&law, &forces);
    let mut driver = Driver::new(&law);
    driver.to(&[-1e-4, 0.0, 0.0]);
    let (mut worst, mut compared, mut before) = (0.0_f64, 0, 0.0);
    for (u, f) in places.iter().zip(&forces) {
        driver.to(&[-1e-4, *u, 0.0]);
        // Where all stick, the rigid surfaces do not say where in the friction the force is.
        if (u - before).abs() > 1e-6 {
            worst = worst.max((driver.f[1] - f).abs());
            compared += 1;
        }
        before = *u;
    }
    assert!(compared > 2000 && worst < 2e-3 * W, "{worst} of {compared}");
}

#[test]
fn the_outer_surfaces_alone_make_a_loop_of_known_area() {
    // Regimes I to III through a full cycle: area of the polygon between loading and unloading, whose
    // transitions are twice as far (Masing).
    let law = TriplePendulum { capacities: None, stop_stiffness: None, ..large() };
    let mut points = backbone(&large());
    points.truncate(4);
    let (r1, r4) = (2.1, 2.4);
    let last = points[3];
    points.push((last.0 + 1.0, last.1 + W / (r1 + r4)));
    let amplitude = 0.3;
    let mut driver = Driver::new(&law);
    driver.to(&[-1e-4, 0.0, 0.0]);
    cycle(&mut driver, -1e-4, amplitude, 4000);
    let area = cycle(&mut driver, -1e-4, amplitude, 4000);
    // Loading curve from −amplitude: F = −F(a) + 2 F((u + a)/2); the loop is 2 ∫ (that) du.
    let n = 20_000;
    let step = 2.0 * amplitude / f64::from(n);
    let top = line(&points, amplitude);
    let expected: f64 = (0..n)
        .map(|i| 2.0 * step * (2.0 * line(&points, 0.5 * step * (f64::from(i) + 0.5)) - top))
        .sum();
    assert_relative_eq!(area, expected, max_relative = 1e-3);
}

#[test]
fn equilibrium_holds_on_every_surface_whatever_the_step() {
    let law = with_rims(small());
    let mut driver = Driver::new(&law);
    for i in 1..2000 {
        let t = 1.7 * f64::from(i);
        let size = 10f64.powf(-2.0 * (1.0 + (0.37 * t).sin()));
        let d = [-1e-4 * (1.1 + (1.3 * t).sin()), 1e-3 * size * t.sin(), 1e-3 * (0.7 * t).cos()];
        driver.to(&d);
        let n = -driver.f[0];
        let (radii, stops) = (law.radii_in_series(), law.stops());
        let mut sum = nalgebra::Vector2::zeros();
        for j in 0..4 {
            let h = &driver.history[4 + 5 * j..];
            let w = nalgebra::Vector2::new(h[0], h[1]);
            let a = nalgebra::Vector2::new(h[2], h[3]);
            let stop: nalgebra::Vector2<f64> = stops[j].unwrap().force(w.into()).0.into();
            let f = w * (n / radii[j]) + (w - a) * law.ks + stop;
            let off = (f - nalgebra::Vector2::new(driver.f[1], driver.f[2])).norm();
            assert!(off < 1e-9 * (n + f.norm()), "surface {j} at {i}: {off} of {f}");
            sum += w;
        }
        assert!((sum - nalgebra::Vector2::new(d[1], d[2])).norm() < 1e-15);
    }
}

#[test]
fn a_lifted_bearing_has_no_shear_up_to_its_rims() {
    let law = with_rims(small());
    let mut driver = Driver::new(&law);
    driver.to(&[-1e-4, 1e-4, 0.0]);
    driver.to(&[1e-4, 4e-4, 1e-4]);
    assert_eq!(driver.f, [0.0; 3]);
    driver.to(&[1e-4, 0.0, 6e-4]);
    // 0.56 mm in all; four rims in series.
    assert_relative_eq!(driver.f[2], 0.3 * KN / 4.0 * 0.4e-4, max_relative = 1e-9);
    driver.to(&[1e-4, 0.0, 5e-4]);
    driver.to(&[-1e-4, 0.0, 5e-4]);
    let back = driver.f[2];
    assert!(back > 0.0 && back < KN * 1e-4 * (5e-4 / 2e-3 + 0.4), "{back}");
}

#[test]
fn speed_raises_the_friction_of_the_surfaces_that_slide() {
    let law = TriplePendulum {
        mu: None,
        mu_slow: Some([0.05, 0.02, 0.02, 0.09]),
        mu_fast: Some([0.10, 0.03, 0.03, 0.12]),
        rate: Some([50.0; 4]),
        capacities: None,
        stop_stiffness: None,
        ..large()
    };
    let mut driver = Driver::new(&law);
    driver.to(&[-1e-4, 0.0, 0.0]);
    let dt = 1e-3;
    for i in 1..=600 {
        let u = 1e-3 * f64::from(i);
        driver.step(&[-1e-4, u, 0.0], &[0.0, 1.0, 0.0], dt);
    }
    // Regime III: 1 and 4 slide as their radii, 2 and 3 only in the series.
    let (r1, r2, r3, r4) = (2.1, 0.35, 0.30, 2.4);
    let mu = |slow: f64, fast: f64, v: f64| W * (fast - (fast - slow) * f64::exp(-50.0 * v));
    let m1 = mu(0.05, 0.10, r1 / (r1 + r4));
    let m4 = mu(0.09, 0.12, r4 / (r1 + r4));
    let m2 = mu(0.02, 0.03, r2 / (r1 + r4));
    let m3 = mu(0.02, 0.03, r3 / (r1 + r4));
    let rest = (m1 * (r1 - r2) + m2 * r2 + m3 * r3 + m4 * (r4 - r3)) / (r1 + r4);
    assert_relative_eq!(driver.f[1], W * 0.6 / (r1 + r4) + rest, max_relative = 1e-4);
}

#[test]
fn the_contact_slips_where_a_surface_does() {
    let law = large();
    let mut driver = Driver::new(&law);
    let mut tell = |d: [f64; 3]| {
        driver.to(&d);
        let all = driver.contacts();
        (all[0].normal, all[0].slipping)
    };
    assert_eq!(tell([-1e-4, 0.0, 0.0]), (1e6, false));
    assert_eq!(tell([-1e-4, 1e-3, 0.0]), (1e6, true));
    assert_eq!(tell([1e-4, 1e-2, 0.0]), (0.0, false));
}

#[test]
fn refuses_surfaces_out_of_order() {
    let list = |x: [f64; 4]| Value::List(x.map(Value::Number).to_vec());
    let name = |given: &[(&'static str, [f64; 4])], stop: Option<f64>| {
        let mut all = numbers(&[("kn", 1e9), ("ks", 1e8)]);
        all.extend(stop.map(|k| ("stop_stiffness", Value::Number(k))));
        all.extend(given.iter().map(|(name, x)| (*name, list(*x))));
        let read = read::<TriplePendulum>(&all);
        read.err().map(|e| e.parameter().unwrap_or("?").to_owned())
    };
    let radii = ("radii", [2.0, 0.4, 0.4, 2.0]);
    let mu = ("mu", [0.05, 0.02, 0.02, 0.09]);
    assert_eq!(name(&[radii, mu], None), None);
    assert_eq!(name(&[radii], None).as_deref(), Some("mu"));
    assert_eq!(name(&[radii, mu, ("rate", [1.0; 4])], None).as_deref(), Some("mu"));
    assert_eq!(name(&[("radii", [1.0; 4]), mu], None).as_deref(), Some("radii"));
    assert_eq!(name(&[radii, mu, ("heights", [0.5; 4])], None).as_deref(), Some("radii"));
    assert_eq!(name(&[radii, ("mu", [0.05, 0.06, 0.02, 0.09])], None).as_deref(), Some("mu"));
    assert_eq!(name(&[radii, ("mu", [-0.05; 4])], None).as_deref(), Some("mu"));
    let capacities = ("capacities", [0.3, 0.05, 0.05, 0.3]);
    assert_eq!(name(&[radii, mu, capacities], None).as_deref(), Some("stop_stiffness"));
    assert_eq!(name(&[radii, mu, capacities], Some(1e8)), None);
    let tight = ("capacities", [0.3, 0.05, 0.02, 0.3]);
    assert_eq!(name(&[radii, mu, tight], Some(1e8)).as_deref(), Some("capacities"));
}
