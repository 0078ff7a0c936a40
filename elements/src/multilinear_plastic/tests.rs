//! First loading, reversals worked out by hand, energies, refusals.

use super::*;
use crate::shared::parameters::read;
use crate::shared::paths::{finely, through};
use approx::assert_relative_eq;
use trilith_element::conformance::Kit;
use trilith_element::{Driver, Value};

type Points = (&'static [f64], &'static [f64]);

/// 10 up to 1, then 1.
const BILINEAR: Points = (&[-6.0, -1.0, 0.0, 1.0, 6.0], &[-15.0, -10.0, 0.0, 10.0, 15.0]);
const PERFECT: Points = (&[-6.0, -1.0, 0.0, 1.0, 6.0], &[-10.0, -10.0, 0.0, 10.0, 10.0]);
const SEVERAL: Points =
    (&[-9.0, -3.0, -1.0, 0.0, 1.0, 3.0, 9.0], &[-20.0, -14.0, -8.0, 0.0, 8.0, 14.0, 20.0]);
/// Other slopes, other corners and another number of them below.
const UNLIKE: Points = (&[-4.0, -2.0, 0.0, 1.0, 3.0, 9.0], &[-9.0, -6.0, 0.0, 8.0, 14.0, 20.0]);
/// Falls to what remains.
const FALLING: Points = (
    &[-9.0, -5.0, -2.0, -1.0, 0.0, 1.0, 2.0, 5.0, 9.0],
    &[-2.0, -2.0, -10.0, -8.0, 0.0, 8.0, 10.0, 2.0, 2.0],
);

fn list(x: &[f64]) -> Value {
    Value::List(x.iter().map(|x| Value::Number(*x)).collect())
}

fn given(
    points: Points,
    rule: &str,
    more: &[(&'static str, f64)],
) -> Result<MultilinearPlastic, ParameterError> {
    let mut all = vec![
        ("deformation", list(points.0)),
        ("force", list(points.1)),
        ("rule", Value::Text(rule.into())),
    ];
    all.extend(more.iter().map(|(n, x)| (*n, Value::Number(*x))));
    read(&all)
}

fn law(points: Points, rule: &str) -> MultilinearPlastic {
    given(points, rule, &[]).unwrap()
}

fn all() -> Vec<MultilinearPlastic> {
    let mut all = Vec::new();
    for rule in ["Kinematic", "Iwan", "Isotropic", "Takeda", "Pivot"] {
        for points in [BILINEAR, PERFECT, SEVERAL, UNLIKE] {
            all.push(law(points, rule));
        }
        if !matches!(rule, "Kinematic" | "Iwan") {
            all.push(law(FALLING, rule));
        }
    }
    for (alpha, beta) in [(1.0, 0.2), (3.0, 0.0), (3.0, 1.0), (50.0, 0.5)] {
        for points in [BILINEAR, UNLIKE, FALLING] {
            let more = [("alpha1", alpha), ("beta1", beta), ("alpha2", 2.0 * alpha)];
            all.push(given(points, "Pivot", &more).unwrap());
        }
    }
    all
}

#[test]
fn every_rule_conforms() {
    for law in all() {
        for size in [1.5, 6.0] {
            Kit::new(&[size], 1.0).rate_independent().assert(&law);
        }
    }
}

#[test]
fn the_first_loading_is_the_curve() {
    for law in all() {
        for sign in [1.0, -1.0] {
            let mut driver = Driver::new(&law);
            for i in 1..40 {
                let d = sign * 0.3 * f64::from(i);
                let f = driver.to(&[d])[0];
                assert_relative_eq!(f, law.curve().at(d).0, epsilon = 1e-12);
            }
        }
    }
}

#[test]
fn large_steps_have_the_force_and_the_energy_of_small_ones() {
    let path = [5.0, -3.0, 2.0, 1.2, 2.5, -7.0, -6.5, -6.8, 7.5, 7.2, 0.3, 0.9, -1.0];
    for law in all() {
        let (mut one, mut many) = (Driver::new(&law), Driver::new(&law));
        for d in path {
            let (a, b) = (through(&mut one, &[d])[0], finely(&mut many, &[d], 1e-3)[0]);
            assert_relative_eq!(a, b, epsilon = 1e-9);
            assert_relative_eq!(one.energy.stored, many.energy.stored, epsilon = 1e-8);
            assert_relative_eq!(one.heat(), many.heat(), epsilon = 1e-8);
            assert_relative_eq!(many.work, many.heat() + many.energy.stored, epsilon = 2e-4);
        }
    }
}

/// What is called stored comes back on the way to zero force.
#[test]
fn unloading_returns_what_is_stored() {
    for law in all() {
        for peak in [0.7, 2.0, 5.0, -3.0] {
            let mut driver = Driver::new(&law);
            through(&mut driver, &[-0.5 * peak, peak]);
            let (stored, work, sign) = (driver.energy.stored, driver.work, peak.signum());
            let mut d = peak;
            while driver.f[0] * sign > 1e-3 && d * sign > -3.0 {
                d -= 1e-4 * sign;
                through(&mut driver, &[d]);
            }
            let back = work - driver.work;
            // In parallel elements some are stretched the other way by then.
            let kept = if matches!(law.rule, Rule::Kinematic | Rule::Iwan) {
                driver.energy.stored + driver.heat()
            } else {
                0.0
            };
            assert!(back <= stored + 1e-3, "{law:?}: {back} of {stored}");
            assert!(kept > 0.0 || (back - stored).abs() < 2e-3, "{law:?}: {back} of {stored}");
        }
    }
}

#[test]
fn kinematic_doubles_the_curve_and_closes_its_cycles() {
    let law = law(SEVERAL, "Kinematic");
    let (a, b) = (7.0, -4.0);
    let mut driver = Driver::new(&law);
    let top = through(&mut driver, &[a])[0];
    let half = |d: f64| law.curve().at(d).0;
    for i in 1..=110 {
        let d = a - 0.1 * f64::from(i);
        assert_relative_eq!(
            through(&mut driver, &[d])[0],
            top - 2.0 * half(0.5 * (a - d)),
            epsilon = 1e-12
        );
    }
    let bottom = driver.f[0];
    for i in 1..=110 {
        let d = b + 0.1 * f64::from(i);
        assert_relative_eq!(
            through(&mut driver, &[d])[0],
            bottom + 2.0 * half(0.5 * (d - b)),
            epsilon = 1e-12
        );
    }
    // An inner cycle leaves no trace.
    let before = driver.f[0];
    through(&mut driver, &[3.0, 6.0, a]);
    assert_relative_eq!(driver.f[0], before, epsilon = 1e-12);
    assert_relative_eq!(before, top, epsilon = 1e-12);
}

/// Up: 10 to 1, then 2. Down: 5 to −2, then 1. Range of the element: 1 above, 2 below.
#[test]
fn iwan_takes_each_side_in_turn() {
    let points: Points = (&[-4.0, -2.0, 0.0, 1.0, 3.0], &[-12.0, -10.0, 0.0, 10.0, 14.0]);
    let law = law(points, "Iwan");
    // From (3, 14) back by 1 with slope 10, by 2 with slope 2 + 4 = 6 (the end spring still being above
    // zero), then with 2 down to zero and with 1 below.
    let forces = through(&mut Driver::new(&law), &[3.0, 2.0, 1.0, 0.0, -1.0]);
    for (f, expected) in forces.iter().zip([14.0, 4.0, -2.0, -8.0, -9.0]) {
        assert_relative_eq!(*f, expected, epsilon = 1e-12);
    }
}

/// The curve and the path of CSI's verification problem 6-009, in and kip: 25, 5 and 1 up; 40, 2 and 0.5 down.
const KINEMATIC: Points =
    (&[-16.0, -6.0, -1.0, 0.0, 2.0, 6.0, 16.0], &[-55.0, -50.0, -40.0, 0.0, 50.0, 70.0, 80.0]);

#[test]
fn kinematic_goes_back_along_the_lines_it_loaded_and_their_counterparts() {
    let law = law(KINEMATIC, "Kinematic");
    // Back by 2 with 25 and by 1 with 40, by 4 with 5 and by 5 with 2, by the 6 that were loaded with 1: on the curve.
    let mut driver = Driver::new(&law);
    let forces = through(&mut driver, &[12.0, 10.0, 9.0, 5.0, 0.0, -6.0, -12.0]);
    for (f, expected) in forces.iter().zip([76.0, 26.0, -14.0, -34.0, -44.0, -50.0, -53.0]) {
        assert_relative_eq!(*f, expected, epsilon = 1e-12);
    }
    // Up again: by 1 with 40, by 2 with 25, by 5 with 2, by 4 with 5, by the 6 with 0.5: on the curve.
    let forces = through(&mut driver, &[-11.0, -9.0, -4.0, 0.0, 6.0, 12.0]);
    for (f, expected) in forces.iter().zip([-13.0, 37.0, 47.0, 67.0, 70.0, 76.0]) {
        assert_relative_eq!(*f, expected, epsilon = 1e-12);
    }
    // An inner cycle leaves no trace.
    through(&mut driver, &[8.0, 11.0, 3.0, 12.0]);
    assert_relative_eq!(driver.f[0], 76.0, epsilon = 1e-12);
}

#[test]
fn kinematic_does_the_work_of_its_cycle_as_heat() {
    let law = law(KINEMATIC, "Kinematic");
    Kit::new(&[1.0], 1.0).rate_independent().assert(&law);
    Kit::new(&[10.0], 1.0).rate_independent().assert(&law);
    let mut driver = Driver::new(&law);
    let corners = [12.0, 10.0, 9.0, 5.0, 0.0, -6.0, -12.0, -11.0, -9.0, -4.0, 0.0, 6.0, 12.0];
    through(&mut driver, &corners[..1]);
    let (work, heat, stored) = (driver.work, driver.heat(), driver.energy.stored);
    through(&mut driver, &corners[1..]);
    // Straight between its corners, so the trapezoidal rule is exact.
    assert_relative_eq!(driver.work - work, driver.heat() - heat, max_relative = 1e-12);
    assert_relative_eq!(driver.energy.stored, stored, max_relative = 1e-12);
    assert!(driver.heat() - heat > 1500.0, "{}", driver.heat() - heat);
}

#[test]
fn kinematic_and_iwan_are_one_where_both_sides_are_alike() {
    for points in [BILINEAR, PERFECT, SEVERAL] {
        let (one, two) = (law(points, "Kinematic"), law(points, "Iwan"));
        let (mut one, mut two) = (Driver::new(&one), Driver::new(&two));
        for d in [5.0, -3.0, 2.0, 1.2, 2.5, -7.0, -6.5, -6.8, 7.5, 7.2, 0.3, 0.9, -1.0] {
            assert_relative_eq!(one.to(&[d])[0], two.to(&[d])[0], epsilon = 1e-12);
            assert_relative_eq!(one.k[0], two.k[0], epsilon = 1e-12);
            assert_relative_eq!(one.energy.stored, two.energy.stored, epsilon = 1e-11);
            assert_relative_eq!(one.heat(), two.heat(), epsilon = 1e-11);
        }
    }
}

/// 10, then 2 up; 51, then 50 down: around a cycle to ±1 there would come out more than went in.
#[test]
fn kinematic_refuses_sides_that_would_give_energy() {
    let points: Points = (&[-2.0, -1.0, 0.0, 1.0, 2.0], &[-101.0, -51.0, 0.0, 10.0, 12.0]);
    let error = given(points, "Kinematic", &[]).unwrap_err();
    assert_eq!(error.parameter(), Some("force"));
    let text = error.to_string();
    assert!(text.contains("(-2, -101)") && text.contains("(1, 10)"), "{text}");
    assert!(text.contains("`rule: Iwan`"), "{text}");
    let iwan = law(points, "Iwan");
    Kit::new(&[1.5], 1.0).rate_independent().assert(&iwan);
}

#[test]
fn isotropic_grows_on_both_sides() {
    let points: Points = (&[-6.0, -1.0, 0.0, 1.0, 6.0], &[-20.0, -10.0, 0.0, 10.0, 20.0]);
    let law = law(points, "Isotropic");
    let forces = through(&mut Driver::new(&law), &[3.0, 0.2, -0.8, 2.4, 3.4]);
    for (f, expected) in forces.iter().zip([14.0, -14.0, -16.0, 16.0, 18.0]) {
        assert_relative_eq!(*f, expected, epsilon = 1e-12);
    }
}

#[test]
fn takeda_reloads_towards_the_largest_deformation() {
    let law = law(BILINEAR, "Takeda");
    // (5, 14); zero at 3.6; towards (−1, −10), at 1.3 half way; zero at 1.8; towards (5, 14), at 3.4
    // half way; a little back and out again; on along the curve.
    let forces = through(
        &mut Driver::new(&law),
        &[5.0, 3.6, 1.3, 1.8, 3.4, 3.0, 3.4, 5.0, 6.0, 4.5, -1.0, -2.0],
    );
    let expected = [14.0, 0.0, -5.0, 0.0, 7.0, 3.0, 7.0, 14.0, 15.0, 0.0, -10.0, -11.0];
    for (f, expected) in forces.iter().zip(expected) {
        assert_relative_eq!(*f, expected, epsilon = 1e-12);
    }
}

#[test]
fn pivot_unloads_to_its_pivot_and_pinches() {
    let law = given(BILINEAR, "Pivot", &[("alpha1", 3.0), ("beta1", 0.5)]).unwrap();
    let mut driver = Driver::new(&law);
    // Towards (−3, −30); through (−0.5, −5) to (−1, −10) and on; towards (3, 30); through (0.5, 5)
    // to (5, 14).
    let down = 5.0 - 14.0 / (44.0 / 8.0);
    let up = -2.0 + 11.0 / (41.0 / 5.0);
    let path = [5.0, down, 0.5 * (down - 0.5), -0.5, -0.75, -1.0, -2.0, up, 0.5, 2.75, 5.0, 6.0];
    let expected = [14.0, 0.0, -2.5, -5.0, -7.5, -10.0, -11.0, 0.0, 5.0, 9.5, 14.0, 15.0];
    for (f, expected) in through(&mut driver, &path).iter().zip(expected) {
        assert_relative_eq!(*f, expected, epsilon = 1e-12);
    }
}

#[test]
fn a_stiff_pivot_without_pinching_unloads_like_takeda() {
    let pivot = given(BILINEAR, "Pivot", &[("alpha1", 1e12), ("beta1", 1.0)]).unwrap();
    let takeda = law(BILINEAR, "Takeda");
    let (mut one, mut two) = (Driver::new(&pivot), Driver::new(&takeda));
    for d in [3.0, 2.2, 1.9, -1.0, -3.0, -2.0] {
        assert_relative_eq!(through(&mut one, &[d])[0], through(&mut two, &[d])[0], epsilon = 1e-9);
    }
}

#[test]
fn refuses_what_a_rule_cannot_follow() {
    let name = |points, rule, more: &[(&'static str, f64)]| {
        given(points, rule, more).unwrap_err().parameter().unwrap_or_default().to_owned()
    };
    let stiffening: Points = (&[-1.0, 0.0, 1.0, 2.0], &[-1.0, 0.0, 1.0, 4.0]);
    for rule in ["Kinematic", "Iwan", "Isotropic", "Takeda", "Pivot"] {
        assert_eq!(name(stiffening, rule, &[]), "force");
        assert_eq!(name((&[0.0, 1.0, 2.0], &[0.0, 1.0, 1.5]), rule, &[]), "deformation");
        assert_eq!(name((&[-1.0, 1.0, 2.0], &[-1.0, 1.0, 1.5]), rule, &[]), "deformation");
        assert_eq!(name((&[-1.0, 0.0, 1.0, 2.0], &[0.0, 0.0, 1.0, 1.0]), rule, &[]), "force");
    }
    assert_eq!(name(FALLING, "Kinematic", &[]), "force");
    assert_eq!(name(FALLING, "Iwan", &[]), "force");
    assert_eq!(name(BILINEAR, "Takeda", &[("beta2", 0.5)]), "beta2");
}
