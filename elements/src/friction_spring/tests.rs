use super::*;
use crate::shared::parameters::{numbers, read};
use approx::assert_relative_eq;
use trilith_element::conformance::Kit;
use trilith_element::{Driver, Value};

fn law(u0: f64, us: Option<f64>, direction: &str) -> FrictionSpring {
    let mut all = numbers(&[("k", 5e7), ("k1", 6e6), ("k2", 2e6), ("u0", u0)]);
    all.extend(us.map(|us| ("us", Value::Number(us))));
    all.push(("direction", Value::Text(direction.into())));
    read(&all).unwrap()
}

#[test]
fn conforms_with_precompression_stops_and_on_one_side() {
    for direction in ["Both", "Tension", "Compression"] {
        for u0 in [0.0, 0.005] {
            for us in [None, Some(0.03)] {
                let law = law(u0, us, direction);
                Kit::new(&[0.04], 1.0).rate_independent().assert(&law);
            }
        }
    }
}

/// Straight from d to d in small steps.
fn lead(it: &mut Driver<'_>, from: f64, to: f64) {
    for i in 1..=1000 {
        it.step(&[from + (to - from) * f64::from(i) / 1000.0], &[0.0], 1e-3);
    }
}

#[test]
fn the_flag_has_the_given_branches() {
    for sign in [1.0, -1.0] {
        let law = law(0.005, None, "Both");
        let mut it = Driver::new(&law);
        let path = [
            (0.0, 3e-4, 5e7 * 3e-4),
            (3e-4, 0.04, 6e6 * 0.045),
            (0.04, 0.039, 6e6 * 0.045 - 5e7 * 0.001),
            (0.039, 0.01, 2e6 * 0.015),
            (0.01, 0.0101, 2e6 * 0.015 + 5e7 * 1e-4),
            (0.0101, 0.02, 6e6 * 0.025),
            (0.02, 1e-4, 5e7 * 1e-4),
            (1e-4, 0.0, 0.0),
        ];
        for (from, to, f) in path {
            lead(&mut it, sign * from, sign * to);
            assert_relative_eq!(it.f[0], sign * f, max_relative = 1e-9, epsilon = 1e-6);
        }
        assert_relative_eq!(it.energy.stored, 0.0, epsilon = 1e-9);
        assert_relative_eq!(it.energy.hysteretic, it.work, max_relative = 1e-4);
    }
}

#[test]
fn a_cycle_costs_the_area_of_the_flag() {
    let (u0, d) = (0.005, 0.04);
    let law = law(u0, None, "Tension");
    let mut it = Driver::new(&law);
    lead(&mut it, 0.0, d);
    lead(&mut it, d, -0.04);
    assert_eq!(it.f[0], 0.0);
    // Area by its corners: start of slip, top, end of the drop, and where unloading slip ends.
    let (a, b) = (6e6 * u0 / (5e7 - 6e6), 2e6 * u0 / (5e7 - 2e6));
    let drop = (5e7 * d - 6e6 * (d + u0) + 2e6 * u0) / (5e7 - 2e6);
    let corners = [(a, 5e7 * a), (d, 6e6 * (d + u0)), (drop, 2e6 * (drop + u0)), (b, 5e7 * b)];
    let area: f64 = (0..4)
        .map(|i| {
            let ((x0, y0), (x1, y1)) = (corners[i], corners[(i + 1) % 4]);
            0.5 * (x1 * y0 - x0 * y1)
        })
        .sum();
    assert_relative_eq!(it.energy.hysteretic, area, max_relative = 1e-9);
}

#[test]
fn closed_rings_are_as_stiff_as_before_slip() {
    let law = law(0.005, Some(0.03), "Compression");
    let mut it = Driver::new(&law);
    lead(&mut it, 0.0, -0.031);
    assert_relative_eq!(it.f[0], -(6e6 * 0.035 + 5e7 * 0.001), max_relative = 1e-9);
    assert_relative_eq!(it.k[0], 5e7, max_relative = 1e-12);
    lead(&mut it, -0.031, -0.02);
    assert_relative_eq!(it.f[0], -2e6 * 0.025, max_relative = 1e-9);
    lead(&mut it, -0.02, 0.1);
    assert_eq!(it.f[0], 0.0);
}

#[test]
fn refuses_slopes_in_the_wrong_order_and_a_stop_before_slip() {
    let refused = |k1: f64, k2: f64, us: f64| {
        let given = [("k", 10.0), ("k1", k1), ("k2", k2), ("u0", 1.0), ("us", us)];
        let error = read::<FrictionSpring>(&numbers(&given)).unwrap_err();
        error.parameter().unwrap_or_default().to_owned()
    };
    assert_eq!(refused(10.0, 1.0, 5.0), "k1");
    assert_eq!(refused(2.0, 3.0, 5.0), "k2");
    assert_eq!(refused(2.0, 1.0, 0.1), "us");
}
