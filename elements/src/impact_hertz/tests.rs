use super::*;
use crate::shared::parameters::{numbers, read};
use crate::shared::paths::{led, rebound};
use approx::assert_relative_eq;
use trilith_element::conformance::Kit;
use trilith_element::{Driver, Value};

fn law(model: &str, given: &[(&str, f64)]) -> ImpactHertz {
    let mut all = numbers(given);
    all.push(("k", Value::Number(2e9)));
    all.push(("model", Value::Text(model.into())));
    read(&all).unwrap()
}

#[test]
fn conforms_for_exponents_and_both_models() {
    for n in [1.0, 1.5, 3.0] {
        for opening in [0.0, 0.01, -0.005] {
            for xi in [0.4, 3.0] {
                let given = [("exponent", n), ("opening", opening), ("xi", xi)];
                Kit::new(&[0.03], 1.0).assert(&law("Hertzdamp", &given));
                let given = [&given[..], &[("impact_mass", 1e4)]].concat();
                Kit::new(&[0.03], 1.0).assert(&law("Jankowski", &given));
            }
        }
    }
}

#[test]
fn an_impact_returns_the_restitution() {
    for n in [1.0, 1.5, 2.0] {
        for e in [0.1, 0.4, 0.65, 0.9, 1.0] {
            for speed in [0.05, 2.0] {
                let given = [("exponent", n), ("restitution", e)];
                let got = rebound(&law("Hertzdamp", &given), 5e4, speed, 2e-6);
                assert_relative_eq!(got, e, max_relative = 3e-3);
                let waiting = law("Jankowski", &given);
                let settled = waiting.restituting(e, 5e4).unwrap();
                let got = rebound(settled.as_ref(), 5e4, speed, 2e-6);
                assert_relative_eq!(got, e, max_relative = 3e-3);
            }
        }
    }
}

#[test]
fn the_damping_has_the_known_limit_and_neighbours() {
    // Lankarani & Nikravesh near e = 1; the next term is 1.5 (1 − e).
    for e in [0.9, 0.95, 0.99] {
        let limit = 0.75 * (1.0 - e * e);
        assert_relative_eq!(hertz_damping(e), limit, max_relative = 2.0 * (1.0 - e));
    }
    // Jankowski 2006: ξ = (9√5/2)(1 − e²)/(e (e (9π − 16) + 16)), an approximation for n = 1.5.
    for e in [0.5_f64, 0.65, 0.8] {
        let pi = std::f64::consts::PI;
        let near = 4.5 * 5.0_f64.sqrt() * (1.0 - e * e) / (e * (e * (9.0 * pi - 16.0) + 16.0));
        assert_relative_eq!(approach_damping(e, 1.5), near, max_relative = 0.05);
    }
    assert_eq!((hertz_damping(1.0), approach_damping(1.0, 1.5)), (0.0, 0.0));
    assert!(hertz_damping(1e-6).is_finite());
}

#[test]
fn a_contact_at_rest_is_a_spring_and_a_later_push_is_damped() {
    let law = law("Hertzdamp", &[("xi", 0.5)]);
    let at_rest = Law::<false>::normal(&law.numbers(), 1e-3, 0.0, Touch::known(0.0));
    assert_relative_eq!(at_rest.force, 2e9 * 1e-3_f64.powf(1.5), max_relative = 1e-14);
    // As an impact at the least speed, 1 mm/s.
    let pushed = Law::<false>::normal(&law.numbers(), 1e-3, 0.2, Touch::known(0.0));
    assert_relative_eq!(pushed.force, (1.0 + 0.5 * 200.0) * at_rest.force, max_relative = 1e-14);
}

#[test]
fn the_speed_is_that_at_which_the_gap_closes_however_long_the_step() {
    let law = law("Hertzdamp", &[("xi", 0.5), ("opening", 0.01)]);
    // d = −½ a t² closes the gap at √(2 g a) and goes on faster.
    let a: f64 = 2.0;
    for steps in [1, 2, 7, 50] {
        let driver = led(&law, 0.2, steps, |t| (-0.5 * a * t * t, -a * t));
        let (depth, rate, s) = (0.03_f64, 0.4, (2.0 * 0.01 * a).sqrt());
        let force = 2e9 * depth.powf(1.5) * (1.0 + 0.5 * rate / s);
        assert_relative_eq!(-driver.f[0], force, max_relative = 1e-12);
    }
}

#[test]
fn a_second_touch_has_a_speed_of_its_own() {
    let law = law("Hertzdamp", &[("xi", 0.5)]);
    let mut driver = Driver::starting_at(&law, &[1e-3], &[-0.4]);
    driver.step(&[-1e-3], &[-0.4], 5e-3);
    driver.step(&[1e-3], &[0.1], 1e-2);
    let force = -driver.step(&[-1e-3], &[-0.1], 2e-2)[0];
    assert_relative_eq!(force, 1.5 * 2e9 * 1e-3_f64.powf(1.5), max_relative = 1e-12);
}

#[test]
fn refuses_both_or_none_and_a_damping_without_its_mass() {
    let refused = |model: &str, given: &[(&str, f64)]| {
        let mut all = numbers(given);
        all.push(("k", Value::Number(1.0)));
        all.push(("model", Value::Text(model.into())));
        read::<ImpactHertz>(&all).unwrap_err().parameter().unwrap_or_default().to_owned()
    };
    assert_eq!(refused("Hertzdamp", &[]), "restitution");
    assert_eq!(refused("Hertzdamp", &[("xi", 1.0), ("restitution", 0.5)]), "restitution");
    assert_eq!(refused("Hertzdamp", &[("xi", 1.0), ("impact_mass", 0.5)]), "impact_mass");
    assert_eq!(refused("Jankowski", &[("xi", 1.0)]), "impact_mass");
}
