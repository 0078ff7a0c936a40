//! β, γ and η, and unloading told by the direction of the motion.

use super::*;
use crate::Wen;
use crate::shared::parameters::{numbers, read};
use crate::shared::paths::evenly;
use approx::assert_relative_eq;
use std::f64::consts::TAU;
use trilith_element::conformance::Kit;
use trilith_element::{Driver, Value};

const K: f64 = 1e7;
const FY: f64 = 1e5;

fn given(
    coupling: &str,
    [beta, gamma, eta]: [f64; 3],
) -> Result<RubberIsolator, trilith_element::ParameterError> {
    let shape = [("beta", beta), ("gamma", gamma), ("eta", eta)];
    let mut all = numbers(&[("k2", K), ("fy2", FY), ("ratio2", 0.1), ("kv", 2e9)]);
    all.extend(numbers(&shape));
    all.push(("coupling", Value::Text(coupling.into())));
    read(&all)
}

fn law(coupling: &str, shape: [f64; 3]) -> RubberIsolator {
    given(coupling, shape).unwrap()
}

const SHAPES: [[f64; 3]; 4] = [[0.5, 0.5, 1.0], [0.5, 0.5, 2.0], [0.9, 0.1, 2.0], [0.7, -0.1, 3.0]];

#[test]
fn conforms_with_every_shape() {
    for coupling in ["Axes", "Direction"] {
        for shape in SHAPES {
            let law = law(coupling, shape);
            Kit::new(&[1e-3, 0.02, 0.03], 0.5).rate_independent().assert(&law);
            let unequal = RubberIsolator { k3: Some(4e6), fy3: Some(1.5e5), ..law };
            Kit::new(&[1e-3, 0.2, 0.1], 0.5).rate_independent().assert(&unequal);
        }
    }
}

#[test]
fn along_a_line_in_any_direction_it_is_a_wen_of_that_exponent() {
    for exponent in [1.0, 2.0, 5.0] {
        let wen: Wen =
            read(&numbers(&[("k", K), ("fy", FY), ("ratio", 0.1), ("exponent", exponent)]))
                .unwrap();
        let law = law("Direction", [0.5, 0.5, exponent]);
        for angle in [0.0_f64, 0.3, 0.25 * TAU, 2.0, 4.0] {
            let (mut one, mut two) = (Driver::new(&wen), Driver::new(&law));
            for d in [0.004, 0.03, 0.025, -0.02, -0.018, 0.1] {
                let f = one.to(&[d])[0];
                let g = two.to(&[0.0, d * angle.cos(), d * angle.sin()]);
                assert_relative_eq!(g[1], f * angle.cos(), epsilon = 1e-3 * FY);
                assert_relative_eq!(g[2], f * angle.sin(), epsilon = 1e-3 * FY);
            }
        }
    }
}

/// A path that turns and reverses.
fn path(t: f64) -> [f64; 2] {
    [0.03 * (2.0 * t).sin(), 0.04 * (3.0 * t).sin() + 0.01 * t]
}

#[test]
fn by_direction_the_plane_has_no_axes() {
    let law = law("Direction", [0.6, 0.4, 1.5]);
    let (sine, cosine) = 0.7_f64.sin_cos();
    let turned = |[x, y]: [f64; 2]| [cosine * x - sine * y, sine * x + cosine * y];
    let (mut one, mut two) = (Driver::new(&law), Driver::new(&law));
    for i in 1..=300 {
        let d = path(0.02 * f64::from(i));
        let [x, y] = turned(d);
        let f = evenly(&mut one, &[0.0, d[0], d[1]], 0.02);
        let g = evenly(&mut two, &[0.0, x, y], 0.02);
        let [expected2, expected3] = turned([f[1], f[2]]);
        assert_relative_eq!(g[1], expected2, epsilon = 1e-7 * FY);
        assert_relative_eq!(g[2], expected3, epsilon = 1e-7 * FY);
    }
}

/// The equation as OpenSees has it, by small steps in time along a circle.
#[test]
fn a_circle_is_that_of_the_differential_equation() {
    for [beta, gamma, eta] in SHAPES {
        let law = law("Direction", [beta, gamma, eta]);
        let (radius, w) = (0.05, 3.0);
        let d = |t: f64| [radius * (w * t).sin(), radius * (1.0 - (w * t).cos())];
        let rate = |t: f64, z: [f64; 2]| {
            let v = [radius * w * (w * t).cos(), radius * w * (w * t).sin()];
            let (along, size) = (z[0] * v[0] + z[1] * v[1], z[0].hypot(z[1]));
            let sign = if along > 0.0 { 1.0 } else { -1.0 };
            let held =
                if size > 0.0 { size.powf(eta - 2.0) * along * (gamma + beta * sign) } else { 0.0 };
            [K / FY * (v[0] - z[0] * held), K / FY * (v[1] - z[1] * held)]
        };
        let (steps, fine) = (2000, 10);
        let h = 1.5 * TAU / w / f64::from(steps * fine);
        let (mut z, mut driver) = ([0.0; 2], Driver::new(&law));
        for i in 0..steps {
            for j in 0..fine {
                let t = f64::from(i * fine + j) * h;
                let moved = |r: [f64; 2], h: f64| [z[0] + h * r[0], z[1] + h * r[1]];
                let a = rate(t, z);
                let b = rate(t + 0.5 * h, moved(a, 0.5 * h));
                let c = rate(t + 0.5 * h, moved(b, 0.5 * h));
                let e = rate(t + h, moved(c, h));
                z = [0, 1].map(|k| z[k] + h * (a[k] + 2.0 * b[k] + 2.0 * c[k] + e[k]) / 6.0);
            }
            let [x, y] = d(f64::from((i + 1) * fine) * h);
            evenly(&mut driver, &[0.0, x, y], f64::from(fine) * h);
            let error = (driver.history[0] - z[0]).hypot(driver.history[1] - z[1]);
            assert!(error < 2e-4, "{beta} {gamma} {eta}: {error} in step {i}");
        }
    }
}

#[test]
fn refuses_shapes_without_a_limit_and_those_that_give_energy() {
    let name = |shape| given("Direction", shape).unwrap_err().parameter().map(str::to_owned);
    assert_eq!(name([0.5, -0.5, 2.0]).as_deref(), Some("gamma"));
    assert_eq!(name([0.4, 0.6, 2.0]).as_deref(), Some("gamma"));
}
