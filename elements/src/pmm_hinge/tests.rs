use super::*;
use crate::ElastomericBearing;
use crate::shared::parameters::{numbers, read};
use crate::shared::paths::along;
use approx::assert_relative_eq;
use trilith_element::Driver;
use trilith_element::conformance::Kit;

const K: [f64; 3] = [2e9, 4e7, 1.2e8];
const S: [f64; 3] = [4e6, 2.5e5, 6e5];

fn law(exponents: [f64; 3], ratio: f64) -> PMMHinge {
    let [a, b, c] = exponents;
    let given = [
        ("axial", K[0]),
        ("bending2", K[1]),
        ("bending3", K[2]),
        ("py", S[0]),
        ("mp2", S[1]),
        ("mp3", S[2]),
        ("exponent_p", a),
        ("exponent_m2", b),
        ("exponent_m3", c),
        ("ratio", ratio),
    ];
    read(&numbers(&given)).unwrap()
}

const SHAPES: [[f64; 3]; 4] = [[2.0, 2.0, 2.0], [1.3, 2.0, 1.2], [4.0, 1.5, 3.0], [8.0, 1.2, 8.0]];

fn surface(f: &[f64], exponents: [f64; 3]) -> f64 {
    (0..3).map(|i| (f[i] / S[i]).abs().powf(exponents[i])).sum()
}

#[test]
fn conforms_on_every_shape_with_and_without_hardening() {
    for shape in SHAPES {
        for ratio in [0.0, 0.1] {
            for size in [0.5, 3.0, 20.0] {
                let d = [0, 1, 2].map(|i| size * S[i] / K[i]);
                Kit::new(&d, 0.5).rate_independent().assert(&law(shape, ratio));
            }
        }
    }
}

#[test]
fn forces_lie_on_the_surface_and_plastic_flow_along_its_normal() {
    for shape in SHAPES {
        let law = law(shape, 0.0);
        for (i, direction) in
            [[1.0, 2.0, -0.5], [-3.0, 0.1, 1.0], [0.0, -1.0, 1.0], [5.0, 0.0, 0.0]]
                .iter()
                .enumerate()
        {
            let mut driver = Driver::new(&law);
            let d = [0, 1, 2].map(|i| 4.0 * direction[i] * S[i] / K[i]);
            driver.to(&d);
            assert_relative_eq!(surface(&driver.f, shape), 1.0, max_relative = 1e-13);
            // λ from each force that is there.
            let normal = |i: usize| {
                let x = driver.f[i] / S[i];
                shape[i] * x.abs().powf(shape[i] - 1.0).copysign(x) / S[i]
            };
            let there = (0..3).filter(|j| direction[*j] != 0.0);
            let lambda: Vec<f64> = there.map(|j| driver.history[j] / normal(j)).collect();
            for l in &lambda {
                assert_relative_eq!(*l, lambda[0], max_relative = 1e-9);
                assert!(*l > 0.0, "{i}");
            }
        }
    }
}

/// The moment that a column can take under a load that was there first, on the surface p² + m^1.2 = 1 (plastic theory
/// of a solid rectangle has p² + m = 1; exponents begin at 1.2).
#[test]
fn a_column_under_load_takes_the_moment_of_its_surface() {
    let exponents = [2.0, 2.0, 1.2];
    let law = law(exponents, 0.0);
    for p in [0.0, 0.3, 0.6, 0.9] {
        let mut driver = Driver::new(&law);
        // The axial force is held by following the plastic elongation.
        let mut u = -p * S[0] / K[0];
        driver.to(&[u, 0.0, 0.0]);
        for i in 1..=400 {
            let turn = 1e-4 * f64::from(i);
            for _ in 0..60 {
                let answer = driver.ask(&driver.toward(&[u, 0.0, turn], &[0.0; 3], 0.0));
                let lack = -p * S[0] - answer.f[0];
                if lack.abs() < 1e-9 * S[0] {
                    break;
                }
                u += lack / answer.k[0];
            }
            driver.to(&[u, 0.0, turn]);
        }
        let m = driver.f[2] / S[2];
        assert_relative_eq!(m, (1.0 - p * p).powf(1.0 / 1.2), max_relative = 1e-6);
    }
}

/// With exponents of 2, like proportions and no axial force it is the circle of the bearing.
#[test]
fn a_round_section_bends_like_the_bearing_that_yields_on_a_circle() {
    let (k, s, ratio) = (4e7, 2.5e5, 0.05);
    let mut hinge = law([2.0; 3], ratio);
    (hinge.bending3, hinge.mp3) = (k, s);
    let bearing: ElastomericBearing =
        read(&numbers(&[("k", k), ("fy", s), ("ratio", ratio)])).unwrap();
    let (mut one, mut two) = (Driver::new(&hinge), Driver::new(&bearing));
    for i in 1..=2000 {
        let t = 0.01 * f64::from(i);
        let (a, b) = (0.002 * t * t.sin(), 0.001 * t * (1.7 * t).cos());
        one.to(&[0.0, a, b]);
        two.to(&[a, b]);
        for j in 0..2 {
            assert!((one.f[1 + j] - two.f[j]).abs() < 1e-9 * s, "{i}: {:?} {:?}", one.f, two.f);
        }
    }
    assert_relative_eq!(one.heat(), two.heat(), max_relative = 1e-9);
}

/// Bending back and forth under compression shortens the hinge: by the normal of the surface, Δu = (∂Φ/∂P)/(∂Φ/∂M) Δθ.
#[test]
fn a_hinge_shortens_as_it_bends_under_compression() {
    let law = law([2.0; 3], 0.0);
    let mut driver = Driver::new(&law);
    let p = 0.5;
    let mut u = -p * S[0] / K[0];
    driver.to(&[u, 0.0, 0.0]);
    let held = |driver: &mut Driver<'_>, u: &mut f64, turn: f64| {
        for _ in 0..60 {
            let answer = driver.ask(&driver.toward(&[*u, 0.0, turn], &[0.0; 3], 0.0));
            *u += (-p * S[0] - answer.f[0]) / answer.k[0];
        }
        driver.to(&[*u, 0.0, turn]);
    };
    for i in 1..=200 {
        held(&mut driver, &mut u, 1e-4 * f64::from(i));
    }
    let m = (1.0 - p * p).sqrt();
    let turned = driver.history[2];
    let shorter = -(p / S[0]) / (m / S[2]) * turned;
    assert_relative_eq!(driver.history[0], shorter, max_relative = 1e-3);
}

#[test]
fn energies_agree_to_the_last_digit_on_any_step() {
    let law = law([1.3, 2.0, 1.6], 0.03);
    let mut driver = Driver::new(&law);
    for d in [[-0.01, 0.02, 0.05], [0.004, -0.03, 0.01], [0.0, 0.0, -0.06], [0.0; 3]] {
        driver.to(&d);
        assert_relative_eq!(driver.work, driver.accounted(), max_relative = 1e-12);
    }
    along(&mut driver, &[0.01, 0.05, -0.05], 100);
    assert_relative_eq!(driver.work, driver.accounted(), max_relative = 1e-12);
}

#[test]
fn a_ratio_of_one_is_refused() {
    let mut it = law([2.0; 3], 0.0);
    it.ratio = 1.0;
    assert_eq!(it.check().unwrap_err().parameter(), Some("ratio"));
}
