use super::*;
use crate::shared::parameters::{numbers, read};
use crate::shared::paths::{finely, through};
use approx::assert_relative_eq;
use trilith_element::conformance::Kit;
use trilith_element::{Driver, Value};

const K: f64 = 6e7;
const FY: f64 = 3e5;
const UY: f64 = FY / K;
/// Hardening, c = 1.1 over 0.02.
const KS: f64 = 0.1 * FY / 0.02;
/// Softening: c f_y over 0.1.
const KPC: f64 = 1.1 * FY / 0.1;
const UC: f64 = UY + 0.02;

fn law(more: &[(&'static str, f64)]) -> IbarraMedinaKrawinkler {
    let basic = [("k", K), ("fy", FY), ("capping", 1.1), ("plastic", 0.02), ("post_capping", 0.1)];
    let mut all = numbers(&basic);
    all.extend(numbers(more));
    if more.iter().any(|(name, _)| *name == "kappa_f") {
        all.push(("form", Value::Text("Pinching".into())));
    }
    read(&all).unwrap()
}

const PINCHED: [(&str, f64); 2] = [("kappa_f", 0.3), ("kappa_d", 0.4)];

#[test]
fn conforms_in_both_forms_sound_and_spent() {
    for form in [&[][..], &PINCHED] {
        for lambda in [f64::INFINITY, 2.0, 0.2] {
            let mut set = form.to_vec();
            if lambda.is_finite() {
                set.extend(["lambda_s", "lambda_c", "lambda_a", "lambda_k"].map(|n| (n, lambda)));
            }
            for residual in [0.0, 0.3] {
                let set: Vec<_> = set.iter().copied().chain([("residual", residual)]).collect();
                let mut law = law(&set);
                (law.fy_negative, law.plastic_negative) = (Some(0.7 * FY), Some(0.03));
                for size in [0.02, 0.1] {
                    Kit::new(&[size], 1.0).rate_independent().assert(&law);
                }
            }
        }
    }
}

#[test]
fn the_first_loading_is_the_backbone() {
    let law = law(&[("residual", 0.2)]);
    for sign in [1.0, -1.0] {
        let mut driver = Driver::new(&law);
        let path = [0.5 * UY, UY, 0.015, UC, 0.06, 0.12, 0.3];
        let f = through(&mut driver, &path.map(|d| sign * d));
        let fall = |d: f64| 1.1 * FY - KPC * (d - UC);
        let backbone =
            [0.5 * FY, FY, FY + KS * (0.015 - UY), 1.1 * FY, fall(0.06), 0.2 * FY, 0.2 * FY];
        for (f, b) in f.iter().zip(backbone) {
            assert_relative_eq!(*f, sign * b, max_relative = 1e-12);
        }
        // Once more in fine steps: the same heat.
        let mut fine = Driver::new(&law);
        finely(&mut fine, &[sign * 0.3], 1e-4);
        let one = driver.energy.hysteretic;
        assert_relative_eq!(fine.energy.hysteretic, one, max_relative = 1e-9);
    }
}

/// Without deterioration: loops of Clough's model, by their corners.
#[test]
fn a_peak_oriented_loop_goes_from_peak_to_peak() {
    let law = law(&[]);
    let mut driver = Driver::new(&law);
    let a = 0.015;
    let top = FY + KS * (a - UY);
    let zero = a - top / K;
    let f = through(&mut driver, &[a, zero, -0.5 * UY, -UY, -a, 0.0]);
    // From the zero crossing straight to the yield point of the other side.
    let half = -FY * (zero + 0.5 * UY) / (zero + UY);
    let reload = -FY + KS * (UY - a);
    for (f, b) in f.iter().zip([top, 0.0, half, -FY, reload]) {
        assert_relative_eq!(*f, b, max_relative = 1e-9, epsilon = 1e-6);
    }
    // Now on the way to the first peak.
    assert_relative_eq!(f[5], top * zero / (zero + a), max_relative = 1e-9);
    driver.to(&[a]);
    assert_relative_eq!(driver.f[0], top, max_relative = 1e-12);
    // A whole loop from peak to peak: two triangles over the zero crossings.
    let before = driver.energy.hysteretic;
    through(&mut driver, &[-a, a]);
    assert_relative_eq!(driver.energy.hysteretic - before, 2.0 * zero * top, max_relative = 1e-9);
}

#[test]
fn a_pinched_loop_goes_through_the_break_point() {
    let law = law(&PINCHED);
    let mut driver = Driver::new(&law);
    let a = 0.015;
    let top = FY + KS * (a - UY);
    let zero = a - top / K;
    through(&mut driver, &[a, -a, 0.6 * zero]);
    // From zero force at −zero with 0.3 times the slope to the peak.
    let at_break = 0.3 * top / (a + zero) * 1.6 * zero;
    assert_relative_eq!(driver.f[0], at_break, max_relative = 1e-9);
    let half = 0.5 * (0.6 * zero + a);
    assert_relative_eq!(driver.to(&[half])[0], 0.5 * (at_break + top), max_relative = 1e-9);
    assert_relative_eq!(driver.to(&[a])[0], top, max_relative = 1e-9);
}

/// One excursion, then what is left of the other side, by the rules in their words.
#[test]
fn each_mode_of_deterioration_takes_its_share() {
    let a = 0.03;
    let cap = 1.1 * FY;
    let top = cap - KPC * (a - UC);
    let area = 0.5 * FY * UY + 0.5 * (FY + cap) * 0.02 + 0.5 * (cap + top) * (a - UC);
    let led = |set: &[(&'static str, f64)], to: &[f64]| {
        let law = law(set);
        let mut driver = Driver::new(&law);
        driver.to(&[a]);
        // Zero force.
        let back = a - driver.f[0] / driver.history[law::STIFFNESS];
        driver.to(&[back - 1e-6]);
        let f = through(&mut driver, to);
        (back, driver.energy.hysteretic, f)
    };
    // The strength: all of the work of the excursion is spent where the force crosses zero.
    for (lambda, c) in [(1.0, 1.0), (0.2, 1.0), (0.2, 1.5)] {
        let spent = area - 0.5 * top * top / K;
        let left = 1.0 - (spent / (lambda * FY - spent)).powf(c);
        let (_, _, f) = led(&[("lambda_s", lambda), ("c_s", c)], &[-0.02]);
        let (fy, ks) = (left * FY, left * KS);
        assert_relative_eq!(f[0], -(fy + ks * (0.02 - fy / K)), max_relative = 1e-9);
    }
    // The capping line moves in; its slope stays.
    let spent = area - 0.5 * top * top / K;
    let left = 1.0 - spent / (0.2 * FY - spent);
    let (_, _, f) = led(&[("lambda_c", 0.2)], &[-0.05]);
    let intercept = cap + KPC * UC;
    assert_relative_eq!(f[0], -(left * intercept - KPC * 0.05), max_relative = 1e-9);
    // Reloading aims farther: on the line to it.
    let (zero, _, f) = led(&[("lambda_a", 0.2)], &[-UY]);
    let u = UY * (1.0 + spent / (0.2 * FY - spent));
    let b = FY + KS * (u - UY);
    assert_relative_eq!(f[0], -b * (zero + UY) / (zero + u), max_relative = 1e-9);
    // The stiffness of unloading and the energy spent belong together.
    let (zero, heat, _) = led(&[("lambda_k", 0.2)], &[]);
    let k = K * (1.0 - heat / (0.2 * FY - heat));
    assert_relative_eq!(heat, area - 0.5 * top * top / k, max_relative = 1e-4);
    assert_relative_eq!(zero, a - top / k, max_relative = 1e-4);
    assert!(k < 0.9 * K, "{k}");
}

#[test]
fn reloading_goes_through_the_last_peak_where_that_is_higher() {
    let law = law(&[]);
    let mut driver = Driver::new(&law);
    let a = 0.02;
    // A large peak, then an inner one on the way back to it, and an excursion below.
    through(&mut driver, &[a, -0.004, 0.012]);
    let peak = driver.f[0];
    through(&mut driver, &[0.012 - peak / K - 2e-4]);
    let zero = driver.d[0] - driver.f[0] / K;
    let half = 0.5 * (zero + 0.012);
    assert_relative_eq!(driver.to(&[half])[0], 0.5 * peak, max_relative = 1e-9);
    assert_relative_eq!(driver.to(&[0.012])[0], peak, max_relative = 1e-9);
    let top = FY + KS * (a - UY);
    assert_relative_eq!(driver.to(&[0.016])[0], 0.5 * (peak + top), max_relative = 1e-9);
}

#[test]
fn a_spent_spring_has_its_residual_strength_and_gives_nothing_back() {
    for residual in [0.0, 0.25] {
        let set = ["lambda_s", "lambda_c", "lambda_k"].map(|n| (n, 0.05));
        let law = law(&[&set[..], &[("residual", residual)]].concat());
        let mut driver = Driver::new(&law);
        let mut last = 0.0;
        for _ in 0..20 {
            for d in [0.04, -0.04] {
                finely(&mut driver, &[d], 1e-3);
                assert!(driver.energy.hysteretic >= last);
                last = driver.energy.hysteretic;
            }
        }
        assert_relative_eq!(driver.f[0], -residual * FY, epsilon = 1e-6);
        let e = driver.energy;
        assert_relative_eq!(driver.work, e.stored + e.hysteretic, max_relative = 0.02);
    }
}

#[test]
fn parameters_that_do_not_go_together_are_refused() {
    let basic = [("k", K), ("fy", FY), ("capping", 1.1), ("plastic", 0.02), ("post_capping", 0.1)];
    let refused = |change: &[(&'static str, f64)], form: &str| {
        let kept = basic.iter().filter(|(n, _)| change.iter().all(|(m, _)| n != m));
        let all: Vec<_> = kept.copied().chain(change.iter().copied()).collect();
        let mut all = numbers(&all);
        all.push(("form", Value::Text(form.into())));
        let error = read::<IbarraMedinaKrawinkler>(&all).unwrap_err();
        error.parameter().unwrap_or_default().to_owned()
    };
    assert_eq!(refused(&[("capping", 5.0)], "PeakOriented"), "capping");
    assert_eq!(refused(&[("plastic_negative", 5e-4)], "PeakOriented"), "capping_negative");
    assert_eq!(refused(&[("kappa_f", 0.5)], "PeakOriented"), "kappa_f");
    assert_eq!(refused(&[("kappa_d", 0.5)], "PeakOriented"), "kappa_d");
    assert_eq!(refused(&[("kappa_f", 0.5)], "Pinching"), "kappa_d");
    assert_eq!(refused(&[], "Pinching"), "kappa_f");
}
