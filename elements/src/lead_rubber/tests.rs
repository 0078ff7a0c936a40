//! Closed forms, the differential equation by another method, energies.

use super::*;
use crate::RubberIsolator;
use crate::shared::parameters::{numbers, read};
use crate::shared::paths::evenly;
use approx::assert_relative_eq;
use std::f64::consts::TAU;
use trilith_element::conformance::Kit;
use trilith_element::{Driver, Value};

const BEARING: [(&str, f64); 6] = [
    ("kr", 1.5e6),
    ("lead_diameter", 0.16),
    ("lead_height", 0.3),
    ("yield_displacement", 0.01),
    ("shim_thickness", 0.06),
    ("kv", 1.5e9),
];

fn law(heating: bool, more: &[(&'static str, f64)]) -> LeadRubber {
    let kept = BEARING.into_iter().filter(|(name, _)| more.iter().all(|(n, _)| n != name));
    let mut all = numbers(&kept.chain(more.iter().copied()).collect::<Vec<_>>());
    all.push(("heating", Value::Flag(heating)));
    read(&all).unwrap()
}

#[test]
fn conforms_cold_and_hot() {
    for size in [0.02, 0.2] {
        let kit = Kit::new(&[1e-3, size, 0.7 * size], 0.5);
        kit.clone().rate_independent().assert(&law(false, &[]));
        kit.assert(&law(true, &[]));
        // A core that heats ten times as fast.
        kit.assert(&law(true, &[("lead_height", 0.03)]));
    }
}

#[test]
fn conforms_with_the_numbers_of_leadrubberx_and_by_direction() {
    let by_axes = law(true, &[("beta", 0.9), ("gamma", 0.1)]);
    let by_direction = LeadRubber { coupling: Coupling::Direction, eta: 1.5, ..law(true, &[]) };
    for law in [by_axes, by_direction] {
        Kit::new(&[1e-3, 0.02, 0.014], 0.5).assert(&law);
        Kit::new(&[1e-3, 0.2, 0.14], 0.5).assert(&law);
    }
}

#[test]
fn without_heating_it_is_a_rubber_isolator() {
    let q = 1e7 * PI * 0.08 * 0.08;
    let (k, fy) = (1.5e6 + q / 0.01, q + 1.5e6 * 0.01);
    let rubber: RubberIsolator =
        read(&numbers(&[("k2", k), ("fy2", fy), ("ratio2", 1.5e6 / k), ("kv", 1.5e9)])).unwrap();
    let law = law(false, &[]);
    let (mut one, mut two) = (Driver::new(&rubber), Driver::new(&law));
    for i in 0..200 {
        let t = 0.05 * f64::from(i);
        let d = [0.0, 0.2 * t.sin(), 0.1 * (2.3 * t).sin()];
        let (f, g) = (evenly(&mut one, &d, 0.05), evenly(&mut two, &d, 0.05));
        for i in 0..3 {
            assert_relative_eq!(f[i], g[i], epsilon = 1e-6 * q);
        }
    }
    assert_relative_eq!(one.heat(), two.heat(), max_relative = 1e-6);
}

/// Without conduction: E T = ln(1 + E σ₀ s/(ρ c h)) with the path s of slip.
#[test]
fn a_core_that_keeps_its_heat_warms_by_the_logarithm_of_its_path() {
    let law = law(true, &[("steel_conductivity", 1e-12), ("yield_displacement", 1e-6)]);
    let mut driver = Driver::new(&law);
    let (mut path, mut last) = (0.0, 0.0);
    for i in 1..=400 {
        let d = 0.3 * (0.05 * f64::from(i)).sin();
        evenly(&mut driver, &[0.0, d, 0.0], 0.05);
        path += f64::abs(d - last);
        last = d;
    }
    let expected = (0.0069 * 1e7 * path / (11_200.0 * 130.0 * 0.3)).ln_1p() / 0.0069;
    assert!(expected > 30.0);
    assert_relative_eq!(driver.history[2], expected, max_relative = 1e-3);
    // All that was dissipated is in the lead.
    assert_relative_eq!(driver.heat(), law.capacity() * driver.history[2], max_relative = 1e-3);
}

#[test]
fn an_orbit_is_that_of_the_differential_equations_to_second_order() {
    let law = law(true, &[]);
    let (q0, y, w) = (law.strength(), 0.01, 0.4 * TAU);
    let d = |t: f64| [0.2 * (w * t).sin(), 0.1 * (1.0 - (w * t).cos())];
    let [rate, diffusion, shims] = [7, 8, 9].map(|i| law.numbers()[i]);
    let cooling = super::cooling::Cooling { rate, diffusion, shims };
    let rate = |t: f64, s: [f64; 3]| {
        let o = [0.2 * w * (w * t).cos() / y, 0.1 * w * (w * t).sin() / y];
        let b = (o[0] * s[0]).max(0.0) + (o[1] * s[1]).max(0.0);
        let heat = q0 * (-0.0069 * s[2]).exp() * y * b * (s[0] * s[0] + s[1] * s[1]);
        let lost = if s[2] > 0.0 { cooling.at(t.max(1e-9)) * s[2] } else { 0.0 };
        [o[0] - s[0] * b, o[1] - s[1] * b, heat / law.capacity() - lost]
    };
    let error = |steps: u32| {
        let (end, fine) = (6.0, 64_000 / steps);
        let h = end / f64::from(steps * fine);
        let mut s = [0.0; 3];
        let mut driver = Driver::new(&law);
        for i in 0..steps {
            for j in 0..fine {
                let t = f64::from(i * fine + j) * h;
                let moved = |r: [f64; 3], h: f64| [0, 1, 2].map(|i| s[i] + h * r[i]);
                let a = rate(t, s);
                let b = rate(t + 0.5 * h, moved(a, 0.5 * h));
                let c = rate(t + 0.5 * h, moved(b, 0.5 * h));
                let e = rate(t + h, moved(c, h));
                s = [0, 1, 2].map(|i| s[i] + h * (a[i] + 2.0 * b[i] + 2.0 * c[i] + e[i]) / 6.0);
            }
            let t = f64::from((i + 1) * fine) * h;
            let [x, z] = d(t);
            evenly(&mut driver, &[0.0, x, z], f64::from(fine) * h);
        }
        assert!(s[2] > 25.0, "{s:?}");
        (driver.history[2] - s[2]).abs() / s[2]
    };
    let (coarse, fine) = (error(500), error(2000));
    assert!(fine < 1e-4, "{fine}");
    assert!(coarse / fine > 8.0, "{coarse} {fine}");
}

#[test]
fn cools_at_rest_and_grows_strong_again() {
    let law = law(true, &[]);
    let mut driver = Driver::new(&law);
    for i in 1..=2000 {
        evenly(&mut driver, &[0.0, 0.2 * (0.005 * f64::from(i) * TAU * 0.4).sin(), 0.0], 0.005);
    }
    let (hot, heat) = (driver.history[2], driver.heat());
    let d = driver.d.clone();
    for _ in 0..6000 {
        evenly(&mut driver, &d, 0.1);
    }
    assert!(hot > 50.0 && driver.history[2] < 0.5 * hot, "{hot} {}", driver.history[2]);
    assert_relative_eq!(driver.heat(), heat, max_relative = 1e-9);
    // A static step does not heat.
    driver.to(&[0.0, 0.4, 0.0]);
    assert!(driver.history[2] < 0.5 * hot);
}
