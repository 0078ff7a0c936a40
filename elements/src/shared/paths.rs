//! Paths that tests lead a [`Driver`] along.

use trilith_element::{Driver, Link};

/// Static steps of one coordinate through these deformations; the forces there.
pub(crate) fn through(driver: &mut Driver<'_>, path: &[f64]) -> Vec<f64> {
    path.iter().map(|d| driver.to(&[*d])[0]).collect()
}

/// The same in steps of at most `step`.
pub(crate) fn finely(driver: &mut Driver<'_>, path: &[f64], step: f64) -> Vec<f64> {
    let mut to = |end: f64| {
        let count = ((end - driver.d[0]).abs() / step).ceil().max(1.0) as u32;
        along(driver, &[end], count);
        driver.f[0]
    };
    path.iter().map(|d| to(*d)).collect()
}

/// A straight static path in equal steps.
pub(crate) fn along(driver: &mut Driver<'_>, end: &[f64], steps: u32) {
    let start = driver.d.clone();
    for i in 1..=steps {
        let s = f64::from(i) / f64::from(steps);
        let d: Vec<f64> = start.iter().zip(end).map(|(a, b)| a + s * (b - a)).collect();
        driver.to(&d);
    }
}

/// A step at constant rate; the force at its end.
pub(crate) fn evenly(driver: &mut Driver<'_>, d: &[f64], dt: f64) -> Vec<f64> {
    let v: Vec<f64> = d.iter().zip(&driver.d).map(|(a, b)| (a - b) / dt).collect();
    driver.step(d, &v, dt).to_vec()
}

/// One cycle of u₂ = amplitude sin 2πt under constant compression, in `steps` steps; heat of it, J.
pub(crate) fn cycle(driver: &mut Driver<'_>, d1: f64, amplitude: f64, steps: u32) -> f64 {
    let before = driver.energy.hysteretic;
    let w = std::f64::consts::TAU;
    let dt = 1.0 / f64::from(steps);
    for i in 1..=steps {
        let (s, c) = (w * f64::from(i) / f64::from(steps)).sin_cos();
        driver.step(&[d1, amplitude * s, 0.0], &[0.0, amplitude * w * c, 0.0], dt);
    }
    driver.energy.hysteretic - before
}

/// A law of one coordinate from rest at the first point of a motion to its end, in equal steps.
pub(crate) fn led(
    law: &dyn Link,
    time: f64,
    steps: usize,
    motion: impl Fn(f64) -> (f64, f64),
) -> Driver<'_> {
    let (d, v) = motion(0.0);
    let mut driver = Driver::starting_at(law, &[d], &[v]);
    let dt = time / steps as f64;
    for i in 1..=steps {
        let (d, v) = motion(dt * i as f64);
        driver.step(&[d], &[v], dt);
    }
    driver
}

/// Speed of a mass after it has struck a contact at `speed`, as share of it; by the midpoint rule on the
/// force of the law.
pub(crate) fn rebound(law: &dyn Link, mass: f64, speed: f64, dt: f64) -> f64 {
    let (mut d, mut v) = (0.0, -speed);
    let mut driver = Driver::starting_at(law, &[d], &[v]);
    loop {
        let (middle, half) = (d + 0.5 * dt * v, v - 0.5 * dt * driver.f[0] / mass);
        let f = driver.step(&[middle], &[half], 0.5 * dt)[0];
        v -= dt * f / mass;
        d += dt * half;
        let f = driver.step(&[d], &[v], 0.5 * dt)[0];
        if d > 0.0 || v > 0.0 && f == 0.0 {
            return v / speed;
        }
    }
}
