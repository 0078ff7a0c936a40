//! An `inclined` bearing against a slider on a sphere.

use super::*;
use crate::shared::parameters::{numbers, read};
use approx::assert_relative_eq;
use trilith_element::conformance::Kit;
use trilith_element::{Described, Driver, Value};

const R: f64 = 2.0;
const MU: f64 = 0.1;
const KN: f64 = 1e10;

fn slider() -> FrictionPendulum {
    FrictionPendulum {
        mu: Some(MU),
        radius: R,
        surface: Surface::Spherical,
        rise: true,
        inclined: true,
        ..FrictionPendulum::new(KN, KN)
    }
}

fn height(u: f64) -> f64 {
    R - (R * R - u * u).sqrt()
}

/// Slides along U2 under a constant load, in steps.
fn slide(driver: &mut Driver<'_>, load: f64, to: f64) {
    let from = driver.d[1];
    for i in 1..=200 {
        let u = from + (to - from) * f64::from(i) / 200.0;
        driver.to(&[height(u) - load / KN, u, 0.0]);
    }
}

#[test]
fn up_and_down_the_slope_its_force_is_that_of_the_friction_angle() {
    let (law, load, friction) = (slider(), 1e6, MU.atan());
    let mut driver = Driver::new(&law);
    for (u, sign) in [(0.3 * R, 1.0), (0.28 * R, -1.0), (-0.3 * R, -1.0), (-0.25 * R, 1.0)] {
        slide(&mut driver, load, u);
        let slope = (u / R).asin();
        let expected = load * (slope + sign * friction).tan();
        assert_relative_eq!(driver.f[0], -load, max_relative = 1e-9);
        assert_relative_eq!(driver.f[1], expected, max_relative = 1e-9);
        let normal = load * friction.cos() / (slope + sign * friction).cos();
        assert_relative_eq!(driver.contacts()[0].normal, normal, max_relative = 1e-9);
    }
    // Friction of the load alone is 3 % off at 0.3 R.
    let flat = FrictionPendulum { inclined: false, ..slider() };
    let mut driver = Driver::new(&flat);
    slide(&mut driver, load, 0.3 * R);
    let exact = load * (0.3_f64.asin() + friction).tan();
    assert!((driver.f[1] / exact - 1.0).abs() > 0.03, "{}", driver.f[1] / exact);
}

#[test]
fn around_the_sphere_friction_is_of_the_normal_force() {
    let (law, load, u) = (slider(), 1e6, 0.3 * R);
    let mut driver = Driver::new(&law);
    slide(&mut driver, load, u);
    let mut angle = 0.0_f64;
    for _ in 0..4000 {
        angle += 2.5e-4;
        driver.to(&[height(u) - load / KN, u * angle.cos(), u * angle.sin()]);
    }
    let (sine, cosine) = angle.sin_cos();
    let outwards = cosine * driver.f[1] + sine * driver.f[2];
    let onwards = cosine * driver.f[2] - sine * driver.f[1];
    let slope = 0.3_f64.asin();
    assert_relative_eq!(onwards, MU * load / slope.cos(), max_relative = 1e-3);
    assert_relative_eq!(outwards, load * slope.tan(), max_relative = 1e-3);
}

const MASS: f64 = 1e5;
const G: f64 = 9.81;

/// Time and place at which a mass on the bearing, let go at 0.3 R, turns: leapfrog on the force of the law.
fn turning(law: &FrictionPendulum) -> (f64, f64) {
    let (dt, sag) = (1e-4, MASS * G / KN);
    let mut driver = Driver::new(law);
    // Friction holds it up the slope to begin with.
    slide(&mut driver, MASS * G, 0.32 * R);
    slide(&mut driver, MASS * G, 0.3 * R);
    let mut d = [height(0.3 * R) - sag, 0.3 * R, 0.0];
    let mut v = [0.0; 3];
    let pull = |f: &[f64]| [-f[0] / MASS - G, -f[1] / MASS, -f[2] / MASS];
    let mut a = pull(&driver.f);
    for i in 1..=40_000 {
        let half = [0, 1, 2].map(|j| v[j] + 0.5 * dt * a[j]);
        d = [0, 1, 2].map(|j| d[j] + dt * half[j]);
        a = pull(driver.step(&d, &half, dt));
        v = [0, 1, 2].map(|j| half[j] + 0.5 * dt * a[j]);
        if v[1] > 0.0 {
            return (f64::from(i) * dt, d[1]);
        }
    }
    panic!("it has not turned: {d:?} {v:?}");
}

/// The same of R θ̈ = −g sin θ + μ (g cos θ + R θ̇²), by Runge-Kutta's method.
fn exact_turning() -> (f64, f64) {
    let rate = |[x, w]: [f64; 2]| [w, -G / R * x.sin() + MU * (G / R * x.cos() + w * w)];
    let (h, mut s, mut t) = (1e-4, [0.3_f64.asin(), 0.0], 0.0);
    while s[1] <= 0.0 {
        let moved = |r: [f64; 2], h: f64| [s[0] + h * r[0], s[1] + h * r[1]];
        let a = rate(s);
        let b = rate(moved(a, 0.5 * h));
        let c = rate(moved(b, 0.5 * h));
        let e = rate(moved(c, h));
        s = [0, 1].map(|i| s[i] + h * (a[i] + 2.0 * b[i] + 2.0 * c[i] + e[i]) / 6.0);
        t += h;
    }
    (t, R * s[0].sin())
}

#[test]
fn a_mass_on_it_swings_as_a_pendulum_with_friction() {
    let law = FrictionPendulum { damping: 2e7, ..slider() };
    let (time, place) = exact_turning();
    let (t, u) = turning(&law);
    assert_relative_eq!(t, time, max_relative = 2e-3);
    assert_relative_eq!(u, place, max_relative = 1e-3);
    let (_, flat) = turning(&FrictionPendulum { inclined: false, ..law });
    assert!((flat / place - 1.0).abs() > 0.01, "{flat} {place}");
}

#[test]
fn conforms_on_a_slope_with_every_friction_model() {
    let coulomb = FrictionPendulum {
        mu: Some(0.3),
        radius: 3e-3,
        inclined: true,
        rise: true,
        ..FrictionPendulum::new(5e8, 5e8)
    };
    let by_speed = FrictionPendulum {
        friction_model: FrictionModel::Velocity,
        mu: None,
        mu_slow: Some(0.05),
        mu_fast: Some(0.3),
        rate: Some(20.0),
        ..coulomb.clone()
    };
    let by_pressure = FrictionPendulum {
        friction_model: FrictionModel::VelocityPressure,
        area: Some(1e-3),
        delta_mu: Some(0.2),
        pressure_rate: Some(1e-8),
        ..by_speed.clone()
    };
    let by_force = FrictionPendulum {
        friction_model: FrictionModel::VelocityForce,
        mu: None,
        a_slow: Some(0.5),
        n_slow: Some(0.85),
        a_fast: Some(1.5),
        n_fast: Some(0.8),
        rate_0: Some(20.0),
        mu_max: 0.3,
        ..coulomb.clone()
    };
    for law in [coulomb, by_speed, by_pressure, by_force] {
        for surface in [Surface::Shallow, Surface::Spherical] {
            let law = FrictionPendulum { surface, ..law.clone() };
            let kit = || Kit::new(&[1e-4, 2e-4, 1.5e-4], 5.0);
            kit().assert(&law);
            kit().assert(&FrictionPendulum { damping: 1e5, cs: 1e6, ..law.clone() });
            kit().active().assert(&FrictionPendulum { rise: false, ..law });
        }
    }
}

#[test]
fn refuses_a_slope_that_is_none_and_friction_that_locks() {
    let flat = FrictionPendulum { radius: 0.0, surface: Surface::Shallow, rise: false, ..slider() };
    assert_eq!(flat.check().unwrap_err().parameter(), Some("inclined"));
    let rough = FrictionPendulum { mu: Some(0.35), ..slider() };
    let error = rough.check().unwrap_err();
    assert_eq!(error.parameter(), Some("mu"));
    assert!(error.to_string().contains("at most 0.3, not 0.35"), "{error}");
    let mut all = numbers(&[("kn", 1e9), ("ks", 1e8), ("mu", 0.1), ("radius", 2.0)]);
    all.push(("inclined", Value::Flag(true)));
    assert!(read::<FrictionPendulum>(&all).unwrap().inclined);
}
