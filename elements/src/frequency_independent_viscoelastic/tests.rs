use super::*;
use crate::shared::parameters::{numbers, read};
use crate::shared::paths::led;
use approx::assert_relative_eq;
use std::f64::consts::{PI, TAU};
use trilith_element::conformance::Kit;
use trilith_element::{Driver, Value};

type Law = FrequencyIndependentViscoelastic;

fn fitted(loss: f64, low: f64, high: f64) -> Law {
    read(&numbers(&[("k", 5e6), ("loss_factor", loss), ("f_min", low), ("f_max", high)])).unwrap()
}

fn list(values: &[f64]) -> Value {
    Value::List(values.iter().map(|x| Value::Number(*x)).collect())
}

fn given(k_inf: f64, stiffness: &[f64], time: &[f64]) -> Law {
    read(&[("k_inf", Value::Number(k_inf)), ("stiffness", list(stiffness)), ("time", list(time))])
        .unwrap()
}

#[test]
fn conforms_fitted_and_given() {
    for law in [
        fitted(0.1, 0.1, 10.0),
        fitted(0.4, 0.1, 10.0),
        fitted(1.5, 0.5, 2.0),
        given(0.0, &[3e6], &[0.05]),
        given(1e6, &[2e6, 3e6, 0.0], &[1e-5, 0.1, 10.0]),
    ] {
        Kit::new(&[0.02], 1.0).assert(&law);
    }
}

#[test]
fn in_the_band_the_fit_is_a_springpot() {
    let (mut worst_k, mut worst_loss) = (0.0_f64, 0.0_f64);
    for loss in [0.02, 0.1, 0.4, 1.0, 2.0] {
        for (low, high) in [(0.1_f64, 10.0_f64), (0.5, 2.0), (0.01, 100.0), (0.3, 7.7)] {
            let law = fitted(loss, low, high);
            for i in 0..=200 {
                let f = low * (high / low).powf(f64::from(i) / 200.0);
                let [storage, heat] = law.moduli(f);
                let exact = 5e6 * (f / (low * high).sqrt()).powf(2.0 / PI * f64::atan(loss));
                worst_k = worst_k.max((storage / exact - 1.0).abs());
                worst_loss = worst_loss.max((heat / storage / loss - 1.0).abs());
            }
        }
    }
    assert!(worst_k < 0.002, "{worst_k}");
    assert!(worst_loss < 0.002, "{worst_loss}");
}

#[test]
fn harmonic_motion_shows_both_moduli() {
    let law = fitted(0.4, 0.2, 5.0);
    for f in [0.2, 1.0, 5.0] {
        // Two cycles in a thousandth of a step each: heat of the last one is π K'' X².
        let after = |cycles: f64| {
            let w = TAU * f;
            let motion = |t: f64| (0.01 * (w * t).cos(), -0.01 * w * (w * t).sin());
            led(&law, cycles / f, (2000.0 * cycles) as usize, motion).energy.viscous
        };
        let heat = after(41.0) - after(40.0);
        let [_, loss] = law.moduli(f);
        // The slowest branches have not seen all of their transient: it does not turn to heat.
        assert_relative_eq!(heat, PI * loss * 1e-4, max_relative = 1e-3);
        assert_relative_eq!(loss, 0.4 * law.moduli(f)[0], max_relative = 0.002);
    }
}

#[test]
fn a_step_relaxes_as_a_sum_of_exponentials() {
    let law = given(1e6, &[2e6, 3e6], &[0.02, 0.5]);
    let mut it = Driver::new(&law);
    it.step(&[0.01], &[0.0], 1e-9);
    assert_relative_eq!(it.f[0], 6e4, max_relative = 1e-6);
    for _ in 0..10 {
        it.step(&[0.01], &[0.0], 0.03);
    }
    let exact = 1e4 + 2e4 * (-0.3_f64 / 0.02).exp() + 3e4 * (-0.3_f64 / 0.5).exp();
    assert_relative_eq!(it.f[0], exact, max_relative = 1e-6);
    assert_relative_eq!(it.energy.stored + it.energy.viscous, it.work, max_relative = 1e-6);
}

#[test]
fn refuses_mixed_and_incomplete_parameters() {
    let refused = |given: &[(&str, Value)]| {
        read::<Law>(given).unwrap_err().parameter().unwrap_or_default().to_owned()
    };
    let band = numbers(&[("k", 1.0), ("loss_factor", 0.4), ("f_min", 1.0), ("f_max", 10.0)]);
    assert_eq!(refused(&band[..3]), "f_max");
    let mut mixed = band.clone();
    mixed.push(("k_inf", Value::Number(1.0)));
    assert_eq!(refused(&mixed), "k");
    let mut reversed = band;
    reversed[3].1 = Value::Number(0.5);
    assert_eq!(refused(&reversed), "f_max");
    assert_eq!(refused(&[("stiffness", list(&[1.0]))]), "stiffness");
    assert_eq!(refused(&[("stiffness", list(&[1.0])), ("time", list(&[1.0, 2.0]))]), "time");
    assert_eq!(refused(&[("stiffness", list(&[1.0])), ("time", list(&[0.0]))]), "time");
}
